r"""omega0 of the pendulum and the Duffing oscillator through the elliptic nome.

Both frequencies are arithmetic-geometric means, omega0 = k agm(a, b), of square roots of simple functions of A:

    u'' + k^2 sin(c u)/c = 0:      a = 1,                 b = cos(c A/2)
    u'' + k^2 (u + e u^3) = 0:     a = sqrt(1 + e A^2),   b = sqrt(1 + e A^2/2)

After d steps (a, b) -> ((a + b)/2, sqrt(a b)), which leave the mean alone (Landen, DLMF 19.8.12), the mean is

    agm(a, b) = a / theta_3(q)^2,  theta_3(q) = 1 + 2 q + 2 q^4 + 2 q^9 + ...    (DLMF 19.8.5, 20.2.3, 22.2.2)
    q = l + 8 l^2 + 84 l^3 + 992 l^4 + ...,  l = m/16,  m = 1 - b^2/a^2          (DLMF 19.5.5)

and l is of the order A^(2^(d+1)), so that few terms serve: the sums are cut after the powers of l that the order asks
for.  With d = 2 it is Jacobi's form of DLMF 22.2, l = ((1 - sqrt(k'))/(1 + sqrt(k')))^4/16.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import isqrt
from typing import Protocol

import sympy
from flint import arb, fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic import truncated
from ridgeback.symbolic.arithmetic.balls import ball, polynomial_at, whole_power
from ridgeback.symbolic.arithmetic.rational_function import Coefficients, as_expression
from ridgeback.symbolic.expansion.expansion import check_order
from ridgeback.symbolic.resummation.mapping import padded
from ridgeback.symbolic.resummation.resummation import Resummation
from ridgeback.symbolic.systems.elliptic import cubic_force, sine_force
from ridgeback.symbolic.systems.oscillator import Oscillator


class Means(Protocol):
    """The two numbers whose arithmetic-geometric mean is omega0/k."""

    def in_balls(self, x: arb) -> tuple[arb, arb]:
        """Return a and b at A = x; not finite, or b not positive, where there is no oscillation."""

    def expressions(self, x: sympy.Expr) -> tuple[sympy.Expr, sympy.Expr]:
        """Return a and b for printing."""


@dataclass(frozen=True)
class PendulumMeans:
    """1 and cos(c A/2), for the force sin(c u)/c.

    >>> PendulumMeans(Fraction(1)).expressions(sympy.Symbol("A"))
    (1, cos(A/2))
    """

    c: Fraction

    def in_balls(self, x: arb) -> tuple[arb, arb]:
        half = ball(self.c) * x / 2
        inside = abs(half) < arb.pi() / 2  # beyond it cos comes back, but the pendulum turns over
        return arb(1), half.cos() if inside else arb.nan()

    def expressions(self, x: sympy.Expr) -> tuple[sympy.Expr, sympy.Expr]:
        return sympy.S.One, sympy.cos(sympy.Rational(self.c) * x / 2)


@dataclass(frozen=True)
class DuffingMeans:
    """sqrt(1 + e A^2) and sqrt(1 + e A^2/2), for the force u + e u^3.

    >>> DuffingMeans(Fraction(-1)).expressions(sympy.Symbol("A"))
    (sqrt(1 - A**2), sqrt(1 - A**2/2))
    """

    e: Fraction

    def in_balls(self, x: arb) -> tuple[arb, arb]:
        square = ball(self.e) * x * x
        return (1 + square).sqrt(), (1 + square / 2).sqrt()

    def expressions(self, x: sympy.Expr) -> tuple[sympy.Expr, sympy.Expr]:
        square = sympy.Rational(self.e) * x**2
        return sympy.sqrt(1 + square), sympy.sqrt(1 + square / 2)


@dataclass(frozen=True, repr=False)
class NomeForm(Resummation):
    """k a / theta_3(q)^2 with both sums cut.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> nome(find("pendulum"), 16).nome_series
    (0, 1, 8)
    """

    means: Means
    steps: int
    """d, the number of Landen steps."""
    nome_series: Coefficients
    """q in powers of l."""

    def normalised(self, x: arb) -> arb:
        a, b = self.means.in_balls(x)
        m = 1 - whole_power(b / a, 2)
        for _ in range(self.steps):
            m = whole_power((a - b) / (a + b), 2)  # DLMF 19.8.12, k_1 = (1 - k')/(1 + k'): no cancellation
            a, b = (a + b) / 2, (a * b).sqrt()
        return a / whole_power(polynomial_at(self._theta_3, polynomial_at(self.nome_series, m / 16)), 2)

    def formula(self, x: sympy.Expr) -> sympy.Expr:
        a, b = self.means.expressions(x)
        m = 1 - b**2 / a**2
        for _ in range(self.steps):
            m = ((a - b) / (a + b)) ** 2
            a, b = (a + b) / 2, sympy.sqrt(a * b)
        return a / as_expression(self._theta_3, as_expression(self.nome_series, m / 16)) ** 2

    @property
    def _theta_3(self) -> Coefficients:
        return theta_3(len(self.nome_series) - 1)

    def latex(self) -> str:
        r"""LaTeX by stages, for in one line it cannot be read: mean, sum, nome, its argument, Landen steps, start."""
        q, ell = sympy.symbols(r"q \ell")
        a, b = (sympy.latex(value) for value in self.means.expressions(sympy.Symbol("A")))
        k, d = "" if self.scale == 1 else sympy.latex(self.scale), self.steps
        theta = sympy.latex(as_expression(self._theta_3, q))
        stages = [
            rf"\omega_0(A) = \frac{{{k} a_{{{d}}}}}{{\left({theta}\right)^{{2}}}}",
            rf"q = {sympy.latex(as_expression(self.nome_series, ell))}",
            rf"\ell = \frac{{1}}{{16}} \left(1 - \frac{{b_{{{d}}}^{{2}}}}{{a_{{{d}}}^{{2}}}}\right)",
            r"a_{n+1} = \frac{a_n + b_n}{2}",
            r"b_{n+1} = \sqrt{a_n b_n}",
            rf"a_0 = {a}",
            rf"b_0 = {b}",
        ]
        return r",\quad ".join(stages)


def nome(oscillator: Oscillator, order: int, *, steps: int = 2) -> NomeForm:
    """Return the nome form of omega0(A), peak amplitude, cut so that it agrees with the series through A^order.

    Parameters
    ----------
    oscillator : Oscillator
        Recognised by its force, whatever it is called.
    order : int
        Power of A through which form and series agree.
    steps : int, optional
        Number of Landen steps, 0 to 6.

    Returns
    -------
    NomeForm
        The formula.

    Raises
    ------
    InputError
        For forces other than k^2 sin(c u)/c and k^2 u + e u^3 with numbers in them, and for a bad order.

    References
    ----------
    DLMF 19.5.5, 19.8.5, 19.8.12 and 22.2.2.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> round(nome(find("pendulum"), 40)(1.0), 12)  # agm(1, cos(1/2))
    0.937792258051
    """
    order = check_order(order)
    if isinstance(steps, bool) or not isinstance(steps, int) or not 0 <= steps <= 6:
        raise InputError(f"steps {steps!r} is not a whole number from 0 to 6; use 2")
    natural = oscillator.normalised
    means = _means(natural.bound)
    if means is None:
        raise InputError(
            f"{oscillator.name} is neither k^2 sin(c u)/c nor k^2 u + e u^3 with numbers for its parameters, the "
            "forces with an elliptic frequency known here; use pade or a mapping"
        )
    terms = order // 2 ** (steps + 1)
    return NomeForm(
        system=oscillator.name,
        method=f"elliptic nome after {steps} Landen steps",
        variable="A",
        amplitude="peak",
        order=order,
        scale=natural.scale,
        scaled_variable=False,
        means=means,
        steps=steps,
        nome_series=nome_series(terms),
    )


def nome_series(terms: int) -> Coefficients:
    """Return q through l^terms: the inverse of l = (theta_2/theta_3)^4/16, DLMF 22.2.2 (1, 8, 84, 992, 12514, ...).

    >>> nome_series(5)
    (0, 1, 8, 84, 992, 12514)
    """
    length = terms + 1
    theta_2 = padded([int(_is_square(4 * n + 1)) for n in range(length)], length)  # over 2 q^(1/4)
    ratio = truncated.multiply(theta_2, truncated.reciprocal(padded(theta_3(terms), length)))
    squared = truncated.multiply(ratio, ratio)
    l_of_q = [fmpq(0), *truncated.multiply(squared, squared)]
    return tuple(truncated.revert(l_of_q)[:length])


def theta_3(terms: int) -> Coefficients:
    """Return theta_3(q) = 1 + 2 sum q^(n^2) through q^terms.

    >>> theta_3(5)
    (1, 2, 0, 0, 2)
    """
    top = isqrt(terms) ** 2
    return tuple(fmpq(2 if n else 1) if _is_square(n) else fmpq(0) for n in range(top + 1))


def _is_square(n: int) -> bool:
    return isqrt(n) ** 2 == n


def _means(force: sympy.Expr) -> Means | None:
    """The means of sin(c u)/c or of u + e u^3 with rational c, e; None for any other force."""
    sine, cubic = sine_force(force), cubic_force(force)
    if sine is not None and sine.rate.is_Rational and sine.factor * sine.rate == 1:
        return PendulumMeans(Fraction(int(sine.rate.p), int(sine.rate.q)))
    if cubic is not None and cubic.linear == 1 and cubic.cubic.is_Rational and cubic.cubic != 0:
        return DuffingMeans(Fraction(int(cubic.cubic.p), int(cubic.cubic.q)))
    return None
