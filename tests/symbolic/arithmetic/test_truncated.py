"""Truncated series by their identities: inverses undo what they invert, and composition is evaluation."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.symbolic.arithmetic.truncated import compose, multiply, power, reciprocal, revert, square_root
from ridgeback.symbolic.series.spaces import Parametric

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


@pytest.mark.parametrize(
    ("operation", "start"),
    [
        (lambda x: multiply(x, x[::-1]), fmpq(2)),
        (reciprocal, fmpq(1)),
        (square_root, fmpq(1)),
        *((lambda x, r=r: power(x, r), fmpq(1)) for r in (fmpq(1, 3), fmpq(-5, 2), fmpq(3), fmpq(0))),
        (lambda x: compose(x, [fmpq(0), *x[1:]]), fmpq(5)),
        (lambda x: revert([fmpq(0), *x[:-1]]), fmpq(1)),
    ],
)
def test_with_a_parameter_the_series_is_that_of_its_values(
    operation: Callable[[Sequence[Any]], list[Any]], start: fmpq
) -> None:
    """Polynomials in mu, worked with and then evaluated, and rationals, worked with by FLINT."""
    space, value = Parametric(("mu",)), fmpq(-2, 3)
    rows = [(fmpq(n + 1, 2), fmpq(3 - n, n + 2)) for n in range(LENGTH - 1)]
    symbolic = [start, *(space.constant(c) + space.gen("mu") * d for c, d in rows)]
    found = operation([space.constant(x) for x in symbolic])
    assert [x if isinstance(x, fmpq) else fmpq(x(fmpq(0), value)) for x in found] == operation(
        [start, *(c + d * value for c, d in rows)]
    )


@pytest.mark.parametrize("exponent", [fmpq(1, 2), fmpq(-1, 3), fmpq(7, 4)])
def test_powers_multiply_as_their_exponents_add(exponent: fmpq) -> None:
    series = [fmpq(1), *(fmpq(n - 3, n) for n in range(1, LENGTH))]
    assert multiply(power(series, exponent), power(series, 2 - exponent)) == multiply(series, series)
