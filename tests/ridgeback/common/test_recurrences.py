"""The recurrences of power series over rationals, against closed forms and a slow twin, and what they refuse."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.elementary import Function, Logarithm, Power, Tangent, powers, wave_pair
from ridgeback.common.errors import InputError
from ridgeback.common.number_ring import FLOATS, NumberRing
from ridgeback.common.recurrences import Combination, Fixed, Input, Product, Quotient, solution

RATIONALS = NumberRing(
    Fraction,
    {name: {0: Fraction(0), 1: Fraction(1)}.__getitem__ for name in ("sin", "tan")}
    | {"exp": lambda x: Fraction(1 + int(x)), "cos": lambda x: Fraction(1 - int(x)), "log": lambda x: x - 1},
    root=lambda base, _: base,
)
LENGTH = 7
coefficients = st.lists(st.fractions(-2, 2, max_denominator=5), min_size=LENGTH, max_size=LENGTH)


def series(values):
    return Input(RATIONALS, [Fraction(x) for x in values])


def first(node, count=LENGTH):
    return [node.get(n) for n in range(count)]


def times(x, y):
    return [sum((x[j] * y[n - j] for j in range(n + 1)), Fraction(0)) for n in range(len(x))]


def test_the_variable_itself_gives_the_textbook_series():
    t = series([0, 1] + [0] * 5)
    one_more = series([1, 1] + [0] * 5)
    assert first(Function(RATIONALS, "exp", t)) == [Fraction(1, math.factorial(n)) for n in range(LENGTH)]
    assert first(Logarithm(RATIONALS, one_more))[1:] == [Fraction((-1) ** (n + 1), n) for n in range(1, LENGTH)]
    assert first(Tangent(RATIONALS, "tan", t)) == [0, 1, 0, Fraction(1, 3), 0, Fraction(2, 15), 0]
    root = first(Power(RATIONALS, one_more, 1, 2))
    assert root[:4] == [1, Fraction(1, 2), Fraction(-1, 8), Fraction(1, 16)]


@settings(deadline=None, max_examples=30)
@given(coefficients, coefficients)
def test_identities_hold_coefficient_by_coefficient(a, b):
    x, y = series([0, *a[1:]]), series([1, *b[1:]])
    sine, cosine = wave_pair(RATIONALS, x)
    assert [
        p + q for p, q in zip(times(first(sine), first(sine)), times(first(cosine), first(cosine)), strict=True)
    ] == [
        1,
        *[0] * (LENGTH - 1),
    ]
    assert first(Tangent(RATIONALS, "tan", x)) == first(Quotient(RATIONALS, sine, cosine))
    assert times(first(Quotient(RATIONALS, x, y)), first(y)) == first(x)
    assert times(first(Power(RATIONALS, y, 1, 2)), first(Power(RATIONALS, y, 1, 2))) == first(y)
    assert first(Function(RATIONALS, "exp", Logarithm(RATIONALS, y))) == first(y)


@settings(deadline=None, max_examples=30)
@given(coefficients)
def test_powers_and_combinations_are_what_repeated_products_say(a):
    x = series(a)
    square = times(a, a)
    tower = powers(RATIONALS, x, 4)
    assert [first(node) for node in tower[2:]] == [square, times(square, a), times(square, square)]
    mixed = Combination(RATIONALS, [Fraction(2), Fraction(-1, 3)], [tower[3], tower[0]])
    assert first(mixed)[1:] == [2 * c for c in times(square, a)[1:]]


def test_a_factor_without_a_constant_term_lets_the_other_lag():
    late = Input(FLOATS, [1.0])  # its coefficient 1 is not known yet
    assert Product(FLOATS, Fixed(FLOATS, 0.0, 3.0), late).get(1) == 3.0


def test_a_corrected_coefficient_is_used_from_then_on():
    x = series([0, 1, 5, 0])
    wave = Function(RATIONALS, "exp", x)
    assert wave.get(2) == Fraction(11, 2)
    x.correct(2, Fraction(-5))
    wave.forget(2)
    assert wave.get(2) == Fraction(1, 2)


def test_the_oscillator_in_floats_is_the_cosine():
    u, v = Input(FLOATS, [1.0]), Input(FLOATS, [0.0])
    assert sum(solution(u, u, v, 20)) == pytest.approx(math.cos(1.0), rel=1e-15)


@pytest.mark.parametrize(
    ("build", "start", "words"),
    [
        (lambda x: Quotient(FLOATS, x, x), 0.0, "not analytic"),
        (lambda x: Power(FLOATS, x, 1, 2), -1.0, "power 1/2 is not analytic at -1"),
        (lambda x: Logarithm(FLOATS, x), -2.0, "log is not analytic at -2"),
        (lambda x: Function(FLOATS, "asin", x), 2.0, "asin is not analytic at 2"),
        (lambda x: Function(FLOATS, "gamma", x), 0.0, "gamma has no power series here"),
    ],
)
def test_what_has_no_series_is_named(build, start, words):
    with pytest.raises(InputError, match=words):
        build(Input(FLOATS, [start]))
