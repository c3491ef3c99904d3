"""Series products in blocks against the plain ones, and whole recursions in blocks against their slow twins."""

from __future__ import annotations

from dataclasses import replace

import pytest
from flint import fmpq, fmpq_poly
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.symbolic.expansion.limit_cycle import cycle_recursion
from ridgeback.symbolic.expansion.lindstedt import conservative_recursion
from ridgeback.symbolic.series.block_products import products
from ridgeback.symbolic.series.integral_parts import add_product, total
from ridgeback.symbolic.series.online_sums import BASE, sums_of_products, weighted_sums
from ridgeback.symbolic.series.ring import TrigRing
from ridgeback.symbolic.series.spaces import Rationals
from ridgeback.symbolic.series.triangular import back_substitute, solve_rational
from ridgeback.symbolic.series.trigonometric import Trig, harmonic
from ridgeback.symbolic.systems.any_form import as_oscillator
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator

LAST = 5 * BASE + 3
small = st.fractions(-3, 3, max_denominator=7).map(lambda x: fmpq(x.numerator, x.denominator))
polynomials = st.lists(small, max_size=3).map(lambda c: fmpq_poly(c) if c else None)
elements = st.tuples(polynomials, polynomials, polynomials, polynomials)


@st.composite
def grown(draw):
    """A series of a few different coefficients in some order, with zeros in front and between."""
    kinds = [(None,) * 4, *draw(st.lists(elements, min_size=1, max_size=3))]
    zeros = draw(st.integers(0, BASE + 2))
    picks = draw(st.lists(st.integers(0, len(kinds) - 1), min_size=LAST + 1 - zeros, max_size=LAST + 1 - zeros))
    return [Trig(Rationals(), kinds[k]) for k in [0] * zeros + picks]


@settings(deadline=None, max_examples=8)
@given(grown(), grown(), st.booleans())
def test_blocks_say_what_all_pairs_say(x, y, same):
    y = x if same else y
    ring, left, right = TrigRing(Rationals()), [], []
    right = left if same else right
    sums = sums_of_products(Rationals(LAST), left, right, LAST)
    for n in range(LAST + 1):
        left.append(x[n])
        if not same:
            right.append(y[n])
        assert sums(n, 0, n) == sums(n, 0, n) == ring.dot(x[: n + 1], y[n::-1])


@settings(deadline=None, max_examples=5)
@given(st.lists(small, min_size=LAST + 1, max_size=LAST + 1), grown())
def test_weights_are_blocks_of_numbers(weights, series):
    plain, blocks = (weighted_sums(Rationals(last), weights, series) for last in (None, LAST))
    assert all(plain(n, 1, n) == blocks(n, 1, n) for n in range(1, LAST + 1))


@settings(deadline=None, max_examples=40)
@given(st.lists(small, min_size=1, max_size=9), st.integers(0, 1), st.integers(0, 1))
def test_the_oscillator_is_solved_in_integers(coefficients, odd, shift):
    p = fmpq_poly(coefficients)
    expected, left = back_substitute(list(p.coeffs()), odd=odd, shift=shift)
    found, own = solve_rational(p, odd=odd, shift=shift)
    assert (found or fmpq_poly([])) == fmpq_poly(expected)
    assert own == left
    parts = tuple(p if k == 2 * shift + odd else None for k in range(4))
    if (odd, shift) in ((1, 0), (0, 1)):  # what is left is the first harmonic
        assert harmonic(Trig(Rationals(), parts), 1)[shift] == left


def block(parts, size, *, seed):
    """Rows that hold these parts, in turn; several parts of one entry together."""
    own = [fmpq_poly([fmpq(seed + n, 3 + n % 4), fmpq(-n, 5), seed]) for n in range(size)]
    return [tuple((i, own[n].numer(), own[n].denom()) for i in parts[n % len(parts)]) for n in range(size)]


KINDS = (
    [(1,), (2,)],
    [(2,), (1,)],
    [(0,), (3,)],
    [(3,), (0,)],
    [(0, 1)],
    [(2, 3)],
    [(0, 1), (2, 3)],
    [(0, 1, 2, 3), ()],
)


@pytest.mark.parametrize("left", KINDS, ids=str)
@pytest.mark.parametrize("right", KINDS, ids=str)
def test_parts_are_multiplied_together_as_they_are_apart(left, right):
    x, y = block(left, 6, seed=1), block(right, 5, seed=2)
    for n in range(10):
        apart, together = {}, {}
        for j in range(max(0, n - 4), min(n, 5) + 1):
            add_product(apart, x[j], y[n - j])
        for order, key, value in products(x, y):
            if order == n:
                together.setdefault(key, []).append(value)
        assert total(apart) == total(together)


@pytest.mark.parametrize(
    "equation",
    [
        "u'' + sin(u) = 0",
        "u'' + u + u**2 - u**3 = 0",
        "u'' + u*u' + u = 0",
        "(1 + u**2)*u'' + u*u'**2 + sin(u)*cosh(u) = 0",
        "u'' + tan(u)*exp(u) + u**2/(1 - u)**(1/2) = 0",
        "u'' + log(1 + u)*tanh(u) + u = 0",
    ],
)
def test_a_family_in_blocks_is_the_slow_one(equation):
    own, order = as_oscillator(equation), 4 * BASE + 2
    slow, fast = (conservative_recursion(own, order, "peak", Rationals(last)) for last in (None, order + 1))
    assert slow.omega == fast.omega
    assert slow.u == fast.u


MIXED = replace(
    Oscillator.from_equation("u'' - eps*(1 - u'**2/3 + u*u' - eps*u**2)*u' + u + eps*u**2 = 0", name="mixed"),
    small="eps",
)


@pytest.mark.parametrize("own", [find("van-der-pol"), MIXED], ids=lambda own: own.name)
@pytest.mark.parametrize("amplitude", ["peak", "fundamental"])
def test_a_limit_cycle_in_blocks_is_the_slow_one(own, amplitude):
    order = 2 * BASE + 5
    slow, fast = (cycle_recursion(own, order, amplitude, Rationals(last)) for last in (None, order + 1))
    assert slow.omega == fast.omega
    assert slow.u == fast.u
