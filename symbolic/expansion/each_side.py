r"""omega0(A) of a force that is analytic on each side of rest, and may begin with any power of u there.

At the distance u on one side let f = a w^P (1 + ...), u = w^d.  With m = P + d the potential is
V = a (d/m) y^m,  y = w (1 + ...)^(1/m),  and u = sum of u_n y^n from n = d on, u_d = 1.  From rest at the distance A,
where y = Y, to u = 0 takes

    t = sqrt(m / (2 a d)) * sum_n n u_n I_n Y^(n - m/2),
    I_n = integral of x^(n-1) (1 - x^m)^(-1/2) over 0 < x < 1 = B(n/m, 1/2) / m

(Landau and Lifshitz, Mechanics, section 11; DLMF 5.12.1), with I_(n+m) = I_n 2n / (2n + m), so that the coefficients
are rational in I_n / I_d of 0 < n - d < m; where the force begins linearly, d = 1 and m = 2, that is I_2/I_1 = 2/pi
alone.  On the other side Y' = rho Y with a' rho^m = a, for the energy is the same, and

    omega0 = pi / (t + t') = A^(P/(2d) - 1/2) * (a power series in A^(1/d)).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy
from flint import fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic import truncated
from ridgeback.symbolic.expansion.amplitude import check_amplitude
from ridgeback.symbolic.expansion.cost import Budget, check
from ridgeback.symbolic.expansion.expansion import Expansion, check_order
from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
from ridgeback.symbolic.series.program import Program
from ridgeback.symbolic.series.ring import TrigRing
from ridgeback.symbolic.series.spaces import Scalar, space_for
from ridgeback.symbolic.series.trigonometric import constant
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.natural_units import over_leading
from ridgeback.symbolic.systems.oscillator import Oscillator, U, V
from ridgeback.symbolic.systems.sides import Half
from ridgeback.symbolic.systems.structure import free_names

RATIO = "rho*"
SHARE = "share*"
BETA = "beta"
"""Names of symbols that stand for rho, 1/(1 + rho^d) and I_n / I_d."""


METHOD = "energy-integral"
ALLOWED = ("peak", "trough")


def energy_on_each_side(
    oscillator: OscillatorLike, order: int, *, amplitude: str = "peak", budget: Budget | None = None
) -> Expansion | PowerExpansion:
    """Expand omega0 of a force f(u) that need be analytic on each side of u = 0 only, and may begin with any power.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        Any form of an oscillator whose force does not depend on u'.
    order : int
        Highest power of the amplitude that is kept, relative to the leading one.
    amplitude : str, optional
        ``peak`` (default) or ``trough``.
    budget : Budget, optional
        What the derivation may cost; 10 minutes and 4 GB by default.

    Returns
    -------
    Expansion or PowerExpansion
        A power series in A where the force begins linearly and holds no broken powers, else one in rational powers.

    Raises
    ------
    InputError
        For a bad order or definition, for terms in u', for a force that does not restore on both sides or begins with
        another power on each, and when the predicted cost exceeds the budget.

    References
    ----------
    Landau and Lifshitz, Mechanics, sections 11 and 12.

    Examples
    --------
    >>> energy_on_each_side("u'' + u + u*abs(u) = 0", 1).frequency
    (1, 4/(3*pi))
    >>> energy_on_each_side("u'' + 4*max(u, 0) + min(u, 0) = 0", 2).frequency
    (4/3, 0, 0)
    """
    oscillator = as_oscillator(oscillator)
    order = check_order(order)
    check_amplitude(oscillator, amplitude, ALLOWED)
    found = sided(oscillator, order, trough=amplitude == "trough", budget=budget or Budget())
    if found.growth != 0 or found.root != 1:
        return PowerExpansion(
            system=oscillator.name,
            method=METHOD,
            amplitude=amplitude,
            order=order,
            lead=found.lead,
            growth=found.growth,
            root=found.root,
            coefficients=found.coefficients,
            names=found.names,
            constants=found.constants,
        )
    return Expansion(
        system=oscillator.name,
        method=METHOD,
        variable="A",
        amplitude=amplitude,
        order=order,
        scale=oscillator.natural_frequency,
        scaled_variable=False,
        coefficients=found.coefficients,
        waveform=None,
        amplitude_coefficients=None,
        residual_of=None,
        names=found.names,
        constants=found.constants,
    )


@dataclass(frozen=True)
class Sided:
    """omega0 = lead * x^growth * (1 + c_1 x + ...), x = A^(1/root): c_n as polynomials in ``names``."""

    lead: sympy.Expr
    growth: sympy.Rational
    root: int
    coefficients: tuple[Scalar, ...]
    names: tuple[str, ...]
    constants: Mapping[str, sympy.Expr]


@dataclass(frozen=True)
class _Side:
    """One side over the rationals: its force over its leading coefficient, and what its names stand for."""

    half: Half
    force: sympy.Expr
    values: Mapping[str, sympy.Expr]


def sided(oscillator: Oscillator, order: int, *, trough: bool = False, budget: Budget | None = None) -> Sided:
    """Expand omega0 in a turning point of a force that need be analytic on each side only.

    Parameters
    ----------
    oscillator : Oscillator
        Its force depends on u alone.
    order : int
        Highest power of A relative to the leading one.
    trough : bool, optional
        Whether A is the size of the turning point at u < 0.
    budget : Budget, optional
        What the derivation may cost.

    Returns
    -------
    Sided
        The series.

    Raises
    ------
    InputError
        For terms in u', for a force that does not restore on both sides, and for one that begins with another power on
        each.

    Examples
    --------
    >>> own = Oscillator.from_equation("u'' + u + u*abs(u) = 0")
    >>> found = sided(own, 2)
    >>> found.coefficients[1], found.constants
    (2/3*beta2*, {'beta2*': 2/pi})
    """
    near, far = _restoring(oscillator, trough)
    first, second = _named(near, "p"), _named(far, "q")
    d, m = near.root, near.power + near.root
    same = first.force == _like(second, first)
    space = _Space(d, m, first, None if same else second)
    check(METHOD, order * d, budget or Budget(), parameters=len(space.names) - len(space.betas) + 1)
    order = order * d
    here = space.times(first, order)
    there = here if same else space.times(second, order)
    ratio, share = space.ratio, space.share
    powers = [ratio**n for n in range(order + 1)]
    total = [share * x + (1 - share) * r * y for x, r, y in zip(here.travel, powers, there.travel, strict=True)]
    travel = truncated.compose(total, here.stretched)
    rising = truncated.power(here.stretch, fmpq(m - 2 * d, 2))
    coefficients = truncated.multiply(rising, truncated.reciprocal(travel))
    return Sided(
        lead=_lead(near, space.exact_ratio),
        growth=sympy.Rational(m - 2 * d, 2 * d),
        root=d,
        coefficients=tuple(coefficients),
        names=space.names,
        constants=space.known,
    )


def _restoring(oscillator: Oscillator, trough: bool) -> tuple[Half, Half]:
    """The side of the amplitude and the other one."""
    name = oscillator.name
    if oscillator.substituted_force.has(V):
        raise InputError(
            f"{name} has terms in u', so its energy is not conserved in this form; "
            "use --method multiple-scales or lindstedt, or set its damping to 0"
        )
    right, left = oscillator.halves
    if right is None or left is None or right.sign == -1 or left.sign == -1:
        raise InputError(f"{name}: the force does not restore on both sides of u = 0, so nothing oscillates")
    if right.exponent != left.exponent:
        raise InputError(
            f"{name}: the force begins like u^({right.exponent}) for u > 0 and like |u|^({left.exponent}) for u < 0, "
            "and only a series in one power of A is known; derive --at A encloses omega0"
        )
    return (left, right) if trough else (right, left)


def _named(half: Half, mark: str) -> _Side:
    found = over_leading(half.force, half.coefficient)
    renamed = {name: f"{mark}{name}" for name in found.values}
    swap = {sympy.Symbol(a, real=True): sympy.Symbol(b, real=True) for a, b in renamed.items()}
    return _Side(half, found.force.xreplace(swap), {renamed[name]: value for name, value in found.values.items()})


def _like(side: _Side, other: _Side) -> sympy.Expr | None:
    """The force of a side in the names of another one with the same leading coefficient; None where it has others."""
    if side.half.coefficient != other.half.coefficient or [*side.values.values()] != [*other.values.values()]:
        return None
    pairs = zip(side.values, other.values, strict=True)
    return side.force.xreplace({sympy.Symbol(a, real=True): sympy.Symbol(b, real=True) for a, b in pairs})


def _lead(near: Half, ratio: sympy.Expr) -> sympy.Expr:
    """pi / (sqrt(m/(2 a d)) I_d d (1 + rho^d)), with I_d = B(d/m, 1/2)/m."""
    d, m = near.root, near.power + near.root
    share = sympy.Rational(d, m)
    beta = sympy.gamma(share) * sympy.sqrt(sympy.pi) / sympy.gamma(share + sympy.Rational(1, 2)) / m
    root = sympy.sqrt(sympy.Rational(2 * d, m)) * _positive_root(near.coefficient)
    return sympy.pi * root / (beta * d * (1 + ratio**d))


def _positive_root(value: sympy.Expr) -> sympy.Expr:
    return sympy.powdenest(sympy.sqrt(value), force=True)


@dataclass(frozen=True)
class _Travel:
    """One side through some order: the time in powers of y over its first term, and y/x and y itself in powers of x."""

    travel: list[Scalar]
    stretch: list[Scalar]

    @property
    def stretched(self) -> list[Scalar]:
        return [fmpq(0), *self.stretch[:-1]]


class _Space:
    """The polynomials that all coefficients of one derivation live in, and the constants among their variables."""

    def __init__(self, d: int, m: int, first: _Side, second: _Side | None) -> None:
        self.d, self.m = d, m
        sides = [first] if second is None else [first, second]
        values = {name: value for side in sides for name, value in side.values.items()}
        self.exact_ratio = sympy.S.One if second is None else _ratio(first.half, second.half, m)
        if not self.exact_ratio.is_Rational:
            share = 1 / (1 + self.exact_ratio**d)
            values |= {RATIO: self.exact_ratio, SHARE: sympy.radsimp(share) if share.is_number else share}
        self.betas = {f"{BETA}{n}*": _beta(n, d, m) for n in range(d + 1, d + m)}
        self.known = {**values, **{name: value for name, value in self.betas.items() if not value.is_Rational}}
        own = {name for side in sides for name in free_names(side.force)}
        self.names = tuple(sorted(own | set(self.known)))
        self.space = space_for(self.names)
        self.ring = TrigRing(self.space)

    @property
    def ratio(self) -> Scalar:
        """rho."""
        return self._scalar(RATIO, self.exact_ratio)

    @property
    def share(self) -> Scalar:
        """1 / (1 + rho^d)."""
        return self._scalar(SHARE, 1 / (1 + self.exact_ratio**self.d))

    def _scalar(self, name: str, value: sympy.Expr) -> Scalar:
        return fmpq(int(value.p), int(value.q)) if value.is_Rational else self.parameter(name)

    def parameter(self, name: str) -> Scalar:
        """A named constant as a member."""
        return self.ring.parameter(name).coefficients(0)[0]

    def times(self, side: _Side, order: int) -> _Travel:
        """The time of a side over its first term, in powers of y, and y over x."""
        d, m, length = self.d, self.m, order + 1
        force = self.taylor(side, length)
        rising = [f * fmpq(m, m + j) for j, f in enumerate(force)]
        stretch = truncated.power(rising, fmpq(1, m))
        x_of_y = truncated.revert([fmpq(0), *stretch])[1:]
        u_of_y = truncated.power(x_of_y, fmpq(d))
        return _Travel([u * fmpq(d + j, d) * self.beta(d + j) for j, u in enumerate(u_of_y)], stretch)

    def taylor(self, side: _Side, length: int) -> list[Scalar]:
        """f / (a w^P): the coefficients from the leading one on, which is 1."""
        names = free_names(side.force)
        fixed = {sympy.Symbol(name, real=True): [self.ring.parameter(name)] for name in names}
        w = [constant(self.space, fmpq(0)), constant(self.space, fmpq(1))]
        program = Program(side.force, self.ring, {}, U, V, fixed={**fixed, U: w})
        start = side.half.power
        found = [program.root.get(n).coefficients(0) for n in range(start + length)][start + 1 :]
        return [fmpq(1), *(value[0] if value else fmpq(0) for value in found)]

    def beta(self, n: int) -> Scalar:
        """I_n / I_d."""
        if n == self.d:
            return fmpq(1)
        if n >= self.d + self.m:
            return self.beta(n - self.m) * fmpq(2 * (n - self.m), 2 * n - self.m)
        return self._scalar(f"{BETA}{n}*", self.betas[f"{BETA}{n}*"])


def _ratio(near: Half, far: Half, m: int) -> sympy.Expr:
    """rho = (a/a')^(1/m)."""
    quotient = sympy.cancel(near.coefficient / far.coefficient)
    return sympy.powdenest(sympy.root(quotient, m), force=True)


def _beta(n: int, d: int, m: int) -> sympy.Expr:
    """I_n / I_d as an exact number."""
    half = sympy.Rational(1, 2)
    one, other = sympy.Rational(n, m), sympy.Rational(d, m)
    ratio = sympy.gamma(one) * sympy.gamma(other + half) / (sympy.gamma(one + half) * sympy.gamma(other))
    return sympy.expand_func(ratio)
