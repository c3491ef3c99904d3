r"""Cosine and sine in the operations that IEEE 754 defines, so that they too are the same in every language.

    theta = n pi + r,   n = floor(theta/pi + 1/2),   |r| <= pi/2,   cos theta = (-1)^n cos r,   sin theta = (-1)^n sin r

with pi in three parts, the first two short enough that n times them is exact for |n| below 2^20 (W. J. Cody and
W. Waite, Software Manual for the Elementary Functions, Prentice-Hall, 1980, chapter 8), and Taylor's series of cos and
sin cut where the next term is below an eighth of the unit roundoff.  Sums over harmonics go by Clenshaw's recurrence.
"""

from __future__ import annotations

from fractions import Fraction
from math import factorial
from typing import Final

from flint import arb, ctx, fmpq

from ridgeback.symbolic.codegen.number import Number, Real, fraction
from ridgeback.symbolic.codegen.program import Operand, Operation, Steps

TURNS: Final = 20
"""Binary digits of n for which the reduction is exact."""
QUARTER: Final = Fraction(8, 5)
"""A little above pi/2."""


def pi_parts(real: Real) -> tuple[Number, Number, Number]:
    """Three numbers of the format whose sum is pi, the first two with ``TURNS`` binary digits to spare.

    >>> from ridgeback.symbolic.codegen.number import FLOAT64
    >>> [part.nearest for part in pi_parts(FLOAT64)]
    [3.1415926534682512, 1.2154201012607932e-10, 4.044532497591901e-21]
    """
    digits = real.digits - TURNS
    with ctx.workprec(400):
        rest, parts = fraction(arb.pi().mid().fmpq()), []
        for _ in range(2):
            spacing = Fraction(2) ** (_exponent(rest) - digits)
            parts.append(rest // spacing * spacing)
            rest -= parts[-1]
    return tuple(Number(fmpq(p.numerator, p.denominator), real) for p in (*parts, rest))  # type: ignore[return-value]


def _exponent(value: Fraction) -> int:
    e = value.numerator.bit_length() - value.denominator.bit_length()
    return e + 1 if value >= Fraction(2) ** e else e


def taylor(first: int, real: Real) -> list[fmpq]:
    """Coefficients of r^2 in cos r (``first`` 0) or sin r / r (``first`` 1), as many as |r| <= 1.6 needs.

    >>> from ridgeback.symbolic.codegen.number import FLOAT32
    >>> taylor(0, FLOAT32)
    [1, -1/2, 1/24, -1/720, 1/40320, -1/3628800, 1/479001600, -1/87178291200]
    """
    found: list[fmpq] = []
    while not found or QUARTER ** (2 * len(found)) / factorial(2 * len(found) + first) > real.unit / 8:
        n = len(found)
        found.append(fmpq((-1) ** n, factorial(2 * n + first)))
    return found


def reduced(steps: Steps, angle: str) -> tuple[str, str]:
    """r and the sign (-1)^n of an angle."""
    half, one, two = steps.number(fmpq(1, 2)), steps.number(1), steps.number(2)
    with ctx.workprec(400):
        inverse = steps.number((1 / arb.pi()).mid().fmpq())
    shifted = steps.assign("turn", Operation.MULTIPLY, inverse, angle)
    shifted = steps.add("turn", shifted, half)
    turns = steps.assign("turn", Operation.FLOOR, shifted)
    rest = angle
    for part in pi_parts(steps.real):
        taken = steps.multiply("taken", part, turns)
        rest = steps.subtract("rest", rest, taken)
    pairs = steps.assign("pairs", Operation.FLOOR, steps.multiply("pairs", half, turns))
    odd = steps.subtract("odd", turns, steps.multiply("pairs", two, pairs))
    sign = steps.subtract("sign", one, steps.multiply("odd", two, odd))
    return rest, sign


def cosine_to_quarter(steps: Steps, name: str, angle: str) -> Operand:
    """cos h = sin(pi/2 - |h|) for |h| <= pi/2, in relative precision up to the zero at its end."""
    high, low, lowest = (steps.number(fmpq(1, 2) * part.exact) for part in pi_parts(steps.real))
    size = steps.assign(f"{name}_size", Operation.ABSOLUTE, angle)
    rest = steps.subtract(f"{name}_rest", high, size)
    rest = steps.add(f"{name}_rest", steps.add(f"{name}_rest", rest, low), lowest)
    return sine_of_small(steps, name, rest)


def sine_of_small(steps: Steps, name: str, angle: str) -> Operand:
    """sin of an angle of at most 1.6 in size."""
    return steps.horner(name, angle, {2 * n + 1: steps.number(c) for n, c in enumerate(taylor(1, steps.real))})


def cosine_and_sine(steps: Steps, angle: str) -> tuple[str, str]:
    """cos and sin of any angle."""
    rest, sign = reduced(steps, angle)
    even = steps.horner("even", rest, {2 * n: steps.number(c) for n, c in enumerate(taylor(0, steps.real))})
    odd = sine_of_small(steps, "uneven", rest)
    return steps.multiply("cosine", sign, even), steps.multiply("sine", sign, odd)


def clenshaw(steps: Steps, prefix: str, twice: str, values: dict[int, Operand]) -> tuple[Operand, Operand]:
    """b_1 and b_2 of b_m = values[m] + 2 cos(theta) b_(m+1) - b_(m+2), from above (C. W. Clenshaw, 1955)."""
    zero: Operand = steps.number(0)
    above, first = zero, zero
    for m in range(max(values, default=0), 0, -1):
        value: Operand = values.get(m, zero)
        if first != zero:
            value = steps.assign(f"{prefix}{m}", Operation.MULTIPLY_ADD, twice, first, value)
            if above != zero:
                value = steps.subtract(f"{prefix}{m}", value, above)
        above, first = first, value
    return first, above
