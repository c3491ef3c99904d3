"""Oscillators that tests of enclosures write down."""

import mpmath
from flint import arb, ctx

from ridgeback.symbolic.systems.oscillator import Oscillator


def own(text: str, **parameters: str) -> Oscillator:
    return Oscillator.from_equation(text, parameters=parameters)


def to_ball(value: mpmath.mpf, digits: int) -> arb:
    """The value with an uncertainty of one unit in its last digit but a few."""
    with ctx.workprec(600):
        centre = arb(mpmath.nstr(value, digits + 5))
        return centre + arb(0, abs(centre) * arb(10) ** -digits)


def near(ball: arb, other: arb, bits: int) -> bool:
    """Overlap, and the ball is tight."""
    return ball.overlaps(other) and ball.rel_accuracy_bits() >= bits
