"""What begins a series: its reciprocal, power and functions, where they are rational."""

from __future__ import annotations

from collections.abc import Callable

import pytest
import sympy
from flint import fmpq_poly

from ridgeback.common.errors import InputError
from ridgeback.symbolic.series.harmonic_basis import Balls
from ridgeback.symbolic.series.ring import TrigRing
from ridgeback.symbolic.series.spaces import space_for
from ridgeback.symbolic.series.trigonometric import Trig

PLAIN, NAMED, BALLS = TrigRing(space_for(())), TrigRing(space_for(("c",))), TrigRing(Balls(4))
COSINE = Trig(PLAIN.space, (None, fmpq_poly([1]), None, None))


def number(ring: TrigRing, value: int) -> Trig:
    return ring.number(sympy.Integer(value))


@pytest.mark.parametrize("ring", [PLAIN, NAMED, BALLS])
def test_reciprocals_and_powers_of_numbers_are_exact_in_every_space(ring: TrigRing) -> None:
    four = number(ring, 4)
    assert ring.power(four, 3, 2) == number(ring, 8)
    assert ring.power(four, -1, 2) == ring.rational(1, 2) == ring.power(ring.invert(four), 1, 2)
    assert hash(number(PLAIN, 2) + number(PLAIN, 2)) == hash(number(PLAIN, 4))


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: PLAIN.invert(number(PLAIN, 0)), "does not start from a nonzero rational number"),
        (lambda: PLAIN.invert(COSINE), "starts with what has no reciprocal"),
        (lambda: NAMED.invert(NAMED.parameter("c")), "starts with what has no reciprocal"),
        (lambda: PLAIN.power(number(PLAIN, 2), 1, 2), "the power 1/2 of 2 is not rational"),
        (lambda: BALLS.power(number(BALLS, 2), 1, 2), "the power 1/2 of 2 is not rational"),
        (lambda: NAMED.power(NAMED.parameter("c"), 1, 2), "the power 1/2 is taken of a parameter"),
        (lambda: PLAIN.function("sin", COSINE), "sin is taken of a parameter, or of what oscillates"),
        (lambda: PLAIN.function("sin", number(PLAIN, 1)), "sin is taken of something that is not 0"),
    ],
)
def test_what_has_no_rational_start_is_refused(call: Callable[[], object], said: str) -> None:
    with pytest.raises(InputError, match=said):
        call()
