"""Balls as the ring of power series whose values are wanted, not their radii: the fast way to many digits."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

from flint import arb, ctx

from ridgeback.common.errors import InputError
from ridgeback.common.number_ring import FUNCTIONS, NumberRing
from ridgeback.symbolic.arithmetic.balls import number_ball

GUARD: Final = 16
"""Bits beyond the precision that is asked for, for the roundings of one series."""


class _RealBalls(NumberRing):
    """Only what is exactly 0 is 0, and what may be 0 divides nothing."""

    def absent(self, element: arb) -> bool:
        return bool(element == 0)  # also of the whole 0 of an empty sum

    def invert(self, element: arb) -> arb:
        if arb(element).contains(0):
            raise InputError("a denominator, log or root is 0 here, where its power series is not analytic")
        return 1 / element


def _real(name: str) -> Callable[[arb], arb]:
    """An elementary function that raises ValueError where it is not real."""

    def value(x: arb) -> arb:
        found: arb = getattr(x, name)()
        if not found.is_finite():
            raise ValueError(name)
        return found

    return value


REAL_BALLS: Final = _RealBalls(whole=arb, functions={name: _real(name) for name in FUNCTIONS}, number=number_ball)


def at_bits(bits: int) -> Any:
    """A context in which balls are computed to so many bits and a little more."""
    return ctx.workprec(bits + GUARD)


def midpoint(ball: arb) -> tuple[int, int]:
    """The middle of a ball as a whole number times a power of two.

    >>> midpoint(arb(3) / 4)
    (3, -2)
    """
    mantissa, exponent = ball.mid().man_exp()
    return int(mantissa), int(exponent)
