"""An exact number and the one floating-point number that stands for it in generated code."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Final, TypeAlias

from flint import arb, ctx, fmpq
from sympy import Expr

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import number_ball

Exact: TypeAlias = "fmpq | Expr"
"""A rational, or a closed real number such as sqrt(2)."""


@dataclass(frozen=True)
class Real:
    """A binary floating-point format of IEEE 754: ``digits`` of the significand, exponents from ``low`` to ``high``.

    The largest number is just below 2^high, the smallest positive one is 2^low.
    """

    name: str
    digits: int
    low: int
    high: int

    @property
    def unit(self) -> Fraction:
        """u, the unit roundoff: half the distance from 1 to the next number."""
        return Fraction(1, 2**self.digits)

    @property
    def largest(self) -> float:
        """The largest finite number."""
        return float((2 - Fraction(2, 2**self.digits)) * Fraction(2) ** (self.high - 1))


FLOAT64: Final = Real("float64", 53, -1074, 1024)
FLOAT32: Final = Real("float32", 24, -149, 128)
REALS: Final = {real.name: real for real in (FLOAT64, FLOAT32)}
DECIDED: Final = 4096
"""Bits at which the rounding of an irrational number is given up."""


def rounded(exact: Fraction, real: Real = FLOAT64) -> float:
    """The number of the format nearest to a rational (half to even); infinite beyond the largest.

    >>> rounded(Fraction(1, 3072)).hex(), rounded(Fraction(1, 3), FLOAT32).hex()
    ('0x1.5555555555555p-12', '0x1.5555560000000p-2')
    >>> rounded(Fraction(10) ** 400)
    inf
    """
    if real is FLOAT64:
        try:
            return exact.numerator / exact.denominator  # Python's division of integers rounds correctly
        except OverflowError:
            return math.inf if exact > 0 else -math.inf
    if exact == 0:
        return 0.0
    spacing = Fraction(2) ** max(magnitude(exact) - real.digits, real.low)
    value = round(exact / spacing) * spacing  # half to even
    if abs(value) > Fraction(real.largest):
        return math.inf if value > 0 else -math.inf
    return float(value)


def magnitude(exact: Fraction) -> int:
    """e with 2^(e-1) <= |exact| < 2^e.

    >>> magnitude(Fraction(1)), magnitude(Fraction(1, 3)), magnitude(Fraction(7))
    (1, -1, 3)
    """
    size = abs(exact)
    e = size.numerator.bit_length() - size.denominator.bit_length()
    return e + 1 if size >= Fraction(2) ** e else e


def fraction(exact: fmpq) -> Fraction:
    """FLINT's rational as Python's.

    >>> fraction(fmpq(-1, 16))
    Fraction(-1, 16)
    """
    return Fraction(int(exact.p), int(exact.q))


@dataclass(frozen=True)
class Number:
    """An exact constant; ``real`` is the format it is rounded to.

    >>> Number(fmpq(1, 3)).nearest, str(Number(fmpq(1, 3)))
    (0.3333333333333333, '1/3')
    """

    exact: Exact
    real: Real = FLOAT64

    @cached_property
    def nearest(self) -> float:
        """The nearest number of the format.

        Raises InputError when that is infinite, or zero for a number that is not.
        """
        value = self._rounded() if isinstance(self.exact, fmpq) else self._decided()
        if not math.isfinite(value) or (value == 0 and self.exact != 0):
            raise InputError(
                f"a coefficient of about 10^{self.decimal_exponent} has no {self.real.name}; generate code for a "
                "lower order, or scale the unknown"
            )
        return value

    def _rounded(self) -> float:
        """A rational; doubles by one division of whole numbers, which FLINT has no common factor of."""
        if self.real is not FLOAT64:
            return rounded(fraction(self.exact), self.real)
        try:
            return int(self.exact.p) / int(self.exact.q)
        except OverflowError:
            return math.inf

    @property
    def representable(self) -> bool:
        """Whether the nearest number of the format is the number itself."""
        return isinstance(self.exact, fmpq) and bool(fmpq(*self.nearest.as_integer_ratio()) == self.exact)

    def _decided(self) -> float:
        """An irrational number, enclosed ever more tightly until both ends round alike."""
        bits = 2 * self.real.digits
        while bits <= DECIDED:
            with ctx.workprec(bits):
                held = number_ball(self.exact)
                low, high = (rounded(fraction(end.fmpq()), self.real) for end in (held.lower(), held.upper()))
            if low == high:
                return low
            bits *= 2
        raise InputError(f"the rounding of {self.exact} is not decided in {DECIDED} bits; give it as a decimal")

    @property
    def ball(self) -> arb:
        """The exact number at FLINT's working precision."""
        return arb(self.exact) if isinstance(self.exact, fmpq) else number_ball(self.exact)

    @property
    def decimal_exponent(self) -> int:
        """Decimal exponent, to within one; 0 for 0."""
        if not isinstance(self.exact, fmpq):
            return math.floor(math.log10(abs(float(self.ball))))
        return round((int(self.exact.p).bit_length() - int(self.exact.q).bit_length()) * math.log10(2))

    @cached_property
    def text(self) -> str:
        """The exact number as it is written; FLINT prints integers of any length."""
        return str(self.exact)

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        """In hexadecimal digits, which long numbers are written in quickly; the hash of a form is of them."""
        exact = f"{int(self.exact.p):x}/{int(self.exact.q):x}" if isinstance(self.exact, fmpq) else self.text
        return f"Number({exact}, {self.real.name})"
