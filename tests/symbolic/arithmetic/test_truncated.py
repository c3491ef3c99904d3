"""Truncated series by their identities: inverses undo what they invert, and composition is evaluation."""

from __future__ import annotations

from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.symbolic.arithmetic.truncated import compose, multiply, reciprocal, revert, square_root

LENGTH = 7
RATIONALS = st.builds(fmpq, st.integers(-9, 9), st.integers(1, 9))
NONZERO = RATIONALS.filter(lambda value: value != 0)
REST = st.lists(RATIONALS, min_size=LENGTH - 1, max_size=LENGTH - 1)
UNIT = [fmpq(1), *[fmpq(0)] * (LENGTH - 1)]
VARIABLE = [fmpq(0), fmpq(1), *[fmpq(0)] * (LENGTH - 2)]


@given(NONZERO, REST)
@settings(max_examples=60, deadline=None)
def test_a_series_times_its_reciprocal_is_one(first: fmpq, rest: list[fmpq]) -> None:
    series = [first, *rest]
    assert multiply(series, reciprocal(series)) == UNIT


@given(REST)
@settings(max_examples=60, deadline=None)
def test_a_square_root_squared_is_the_series(rest: list[fmpq]) -> None:
    series = [fmpq(1), *rest]
    root = square_root(series)
    assert multiply(root, root) == series


@given(NONZERO, REST)
@settings(max_examples=60, deadline=None)
def test_a_reverted_series_composed_with_the_series_is_the_variable(slope: fmpq, rest: list[fmpq]) -> None:
    series = [fmpq(0), slope, *rest[:-1]]
    assert compose(series, revert(series)) == VARIABLE
    assert compose(revert(series), series) == VARIABLE


@given(REST, REST)
@settings(max_examples=60, deadline=None)
def test_composition_is_the_sum_of_powers(outer: list[fmpq], rest: list[fmpq]) -> None:
    inner = [fmpq(0), *rest[:-1]]
    power, total = [fmpq(1), *[fmpq(0)] * (len(outer) - 1)], [fmpq(0)] * len(outer)
    for coefficient in outer:
        total = [a + coefficient * b for a, b in zip(total, power, strict=True)]
        power = multiply(power, inner)
    assert compose(outer, inner) == total
