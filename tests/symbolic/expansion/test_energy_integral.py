"""The energy integral beside the closed forms that are arithmetic-geometric means, and its two ways of reversion."""

import math

import pytest
from flint import fmpq
from hypothesis import given
from hypothesis import strategies as st

from ridgeback.symbolic.arithmetic import truncated
from ridgeback.symbolic.expansion.amplitude import DEFINITIONS
from ridgeback.symbolic.expansion.energy_integral import ALLOWED, _even_reversion, _reversion, energy_integral
from ridgeback.symbolic.expansion.lindstedt import lindstedt

SMALL = st.builds(fmpq, st.integers(-9, 9), st.integers(1, 7))


def mean(a: list[fmpq], b: list[fmpq]) -> list[fmpq]:
    """M(a, b) of power series that begin with 1: what they agree in doubles from step to step."""
    while a != b:
        root = truncated.square_root(truncated.multiply(a, b))
        a, b = [(x + y) / 2 for x, y in zip(a, b, strict=True)], root
    return a


def test_the_pendulum_is_a_mean_of_power_series() -> None:
    half = 40
    cosine = [fmpq((-1) ** n, 4**n * math.factorial(2 * n)) for n in range(half + 1)]  # cos(A/2) in A^2
    found = energy_integral("u'' + sin(u) = 0", 2 * half)
    assert list(found.coefficients[::2]) == mean([fmpq(1)] + [fmpq(0)] * half, cosine)
    assert not any(found.coefficients[1::2])


@pytest.mark.parametrize("e", [fmpq(1), fmpq(-2, 3)])
def test_duffing_is_a_mean_of_power_series(e: fmpq) -> None:
    length = 31
    larger, smaller = (truncated.square_root([fmpq(1), s, *[fmpq(0)] * (length - 2)]) for s in (e, e / 2))
    found = energy_integral(f"u'' + u + ({e})*u**3 = 0", 2 * length - 2)
    assert list(found.coefficients[::2]) == mean(larger, smaller)


@given(st.lists(SMALL, min_size=1, max_size=7))
def test_both_ways_of_reversion_agree(even: list[fmpq]) -> None:
    potential = [fmpq(1), *(c for value in even for c in (fmpq(0), value)), fmpq(0)]
    assert _even_reversion(potential) == _reversion(potential)


@pytest.mark.parametrize("amplitude", ALLOWED)
@pytest.mark.parametrize("equation", ["u'' + u + c*u**3 + u**5 = 0", "u'' + u + c*u**2 = 0"])
def test_every_definition_agrees_with_lindstedt(equation: str, amplitude: str) -> None:
    assert amplitude in DEFINITIONS
    for order in (0, 5, 6):
        ours, theirs = energy_integral(equation, order, amplitude=amplitude), lindstedt(equation, order)
        assert ours.coefficients == (theirs if amplitude == "peak" else theirs.convert(amplitude)).coefficients
