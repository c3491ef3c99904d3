r"""Changes of variable that move a singularity out of the way, each with its inverse as an exact series.

``x = X^step`` is the variable of a series (X the amplitude or eps/k) and w the new one, w = 0 at x = 0, increasing on
the real range of x.  ``vanishing`` is a polynomial in w that falls like x^(-rate) as x grows, so that a known power of
x at infinity can be taken out of a series in w.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Protocol

import sympy
from flint import arb, fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic import truncated
from ridgeback.symbolic.arithmetic.balls import ball, rational

Coefficients = list[fmpq]


class Mapping(Protocol):
    """A change of variable w(x)."""

    @property
    def name(self) -> str:
        """What the change of variable is called."""

    @property
    def vanishing(self) -> tuple[int, ...]:
        """Coefficients of the polynomial in w that falls like x^(-rate)."""

    @property
    def rate(self) -> Fraction:
        """See ``vanishing``."""

    def image(self, x: arb) -> arb:
        """Return w(x)."""

    def preimage(self, w: arb) -> arb:
        """Return x(w) for w in the image of x > 0."""

    def series(self, length: int) -> Coefficients:
        """Return the first coefficients of x as a power series in w."""

    def expression(self, x: sympy.Expr) -> sympy.Expr:
        """Return w(x) for printing."""


@dataclass(frozen=True)
class Identity:
    """w = x.

    >>> Identity().series(3)
    [0, 1, 0]
    """

    name = ""
    vanishing = (1,)
    rate = Fraction(0)

    def image(self, x: arb) -> arb:
        return x

    def preimage(self, w: arb) -> arb:
        return w

    def series(self, length: int) -> Coefficients:
        return padded([0, 1], length)

    def expression(self, x: sympy.Expr) -> sympy.Expr:
        return x


@dataclass(frozen=True)
class Euler:
    """Euler's transformation w = x/(x + x0), or with another rate than 1 its power w = 1 - (1 + x/x0)^(-rate).

    The singularity x = -x0 goes to infinity and x = infinity to w = 1, where a function of x^(-rate) becomes analytic.

    >>> Euler(Fraction(1)).series(4)
    [0, 1, 1, 1]
    """

    x0: Fraction
    rate: Fraction = Fraction(1)

    vanishing = (1, -1)

    def __post_init__(self) -> None:
        for name, value in (("x0", self.x0), ("rate", self.rate)):
            if value <= 0:
                raise InputError(f"{name} = {value} of an Euler transformation is not positive; use e.g. 1")

    @property
    def name(self) -> str:
        return "Euler transformation" if self.rate == 1 else f"Euler transformation of rate {self.rate}"

    def image(self, x: arb) -> arb:
        return 1 - (1 + x / ball(self.x0)) ** ball(-self.rate)

    def preimage(self, w: arb) -> arb:
        return ball(self.x0) * ((1 - w) ** ball(-1 / self.rate) - 1)

    def series(self, length: int) -> Coefficients:
        scaled = power(padded(self.vanishing, length), -1 / self.rate)
        return [fmpq(0), *(rational(self.x0) * c for c in scaled[1:])]

    def expression(self, x: sympy.Expr) -> sympy.Expr:
        x0 = sympy.Rational(self.x0)
        return x / (x + x0) if self.rate == 1 else 1 - (1 + x / x0) ** sympy.Rational(-self.rate)


@dataclass(frozen=True)
class CutPlane:
    """The plane cut from x_c outwards along the real axis, mapped to the unit disc (Koebe's function).

    x = 4 |x_c| w / (1 + s w)^2 with s the sign of x_c: every x off the cut has |w| < 1, and x_c itself w = s.

    >>> CutPlane(Fraction(-1)).series(4)
    [0, 4, 8, 12]
    """

    x_c: Fraction

    name = "cut-plane map"
    vanishing = (1, -1)
    rate = Fraction(1, 2)

    def __post_init__(self) -> None:
        if self.x_c == 0:
            raise InputError("x_c = 0 is the origin, and the cut must start elsewhere; give the singularity's place")

    @property
    def _sign(self) -> int:
        return 1 if self.x_c > 0 else -1

    def image(self, x: arb) -> arb:
        root = (1 - x / ball(self.x_c)).sqrt()
        return self._sign * (1 - root) / (1 + root)

    def preimage(self, w: arb) -> arb:
        return 4 * ball(abs(self.x_c)) * w / (1 + self._sign * w) ** 2

    def series(self, length: int) -> Coefficients:
        return [4 * rational(abs(self.x_c)) * n * (-self._sign) ** (n + 1) for n in range(length)]

    def expression(self, x: sympy.Expr) -> sympy.Expr:
        root = sympy.sqrt(1 - x / sympy.Rational(self.x_c))
        return self._sign * (1 - root) / (1 + root)


@dataclass(frozen=True)
class Pair:
    """w = x / sqrt(x^2 - 2 R cos(beta) x + R^2): sends the pair x = R exp(+-i beta) to infinity, x = infinity to w = 1.

    Andersen and Geer, SIAM J. Appl. Math. 42 (1982) 678, for the van der Pol oscillator.  ``half_sum`` is R cos(beta);
    it must not be positive, or w would pass its greatest value before x is at infinity.

    >>> Pair(Fraction(2), Fraction(-1)).series(4)
    [0, 2, 1, 5/4]
    """

    modulus: Fraction
    half_sum: Fraction

    name = "Andersen-Geer map"
    vanishing = (1, 0, -1)
    rate = Fraction(1)

    def __post_init__(self) -> None:
        if not -self.modulus < self.half_sum <= 0:
            raise InputError(
                f"a pair of modulus {self.modulus} and real part {self.half_sum} is not a complex pair in the left "
                "half plane, where this map helps; use pade"
            )

    def image(self, x: arb) -> arb:
        return x / (x * x - 2 * ball(self.half_sum) * x + ball(self.modulus) ** 2).sqrt()

    def preimage(self, w: arb) -> arb:
        # x^2 (1 - w^2) + 2 h w^2 x - R^2 w^2 = 0 with h = R cos(beta)
        h, square = ball(self.half_sum), ball(self.modulus) ** 2
        return w * ((h * h * w * w + square * (1 - w * w)).sqrt() - h * w) / (1 - w * w)

    def series(self, length: int) -> Coefficients:
        h, R = rational(self.half_sum), rational(self.modulus)
        root = truncated.square_root(padded([1, 0, (h / R) ** 2 - 1], length))
        top = [fmpq(0)] + [R * c for c in root]
        top[2:3] = [c - h for c in top[2:3]]
        return truncated.multiply(top[:length], padded([1, 0] * length, length))

    def expression(self, x: sympy.Expr) -> sympy.Expr:
        h, R = sympy.Rational(self.half_sum), sympy.Rational(self.modulus)
        return x / sympy.sqrt(x**2 - 2 * h * x + R**2)


def padded(values: Sequence[int | fmpq], length: int) -> Coefficients:
    """Return the values as rationals, cut or filled with zeros to a length.

    >>> padded([1], 2)
    [1, 0]
    """
    return [fmpq(v) for v in values[:length]] + [fmpq(0)] * (length - len(values))


def power(series: Coefficients, exponent: Fraction) -> Coefficients:
    """Return the power of a series that starts with 1, by n y_n = sum_j (p j - (n - j)) s_j y_(n-j) (Euler).

    >>> power([fmpq(1), fmpq(-1), fmpq(0)], Fraction(-1))
    [1, 1, 1]
    """
    p, result = rational(exponent), [fmpq(1)]
    for n in range(1, len(series)):
        total = sum(((p * j - (n - j)) * series[j] * result[n - j] for j in range(1, n + 1)), fmpq(0))
        result.append(total / n)
    return result
