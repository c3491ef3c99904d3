"""Trigonometric polynomials in both bases against Fourier sums in exact complex rationals, the slow obvious twin."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import pytest
import sympy
from flint import arb, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.symbolic.series.harmonic_basis import Balls
from ridgeback.symbolic.series.ring import TrigRing
from ridgeback.symbolic.series.spaces import Space, space_for
from ridgeback.symbolic.series.trigonometric import (
    Trig,
    at_zero,
    constant,
    cosine,
    degree,
    harmonic,
    sine,
    solve_oscillator,
)

Fourier = dict[int, tuple[Fraction, Fraction]]
"""Multiple to the coefficients of its cosine and its sine."""
SPACES: dict[str, Space] = {"powers": space_for(()), "harmonics": Balls(64)}
waves = st.dictionaries(
    st.integers(0, 5), st.tuples(*[st.fractions(-3, 3, max_denominator=7)] * 2), min_size=1, max_size=4
).map(lambda wave: {m: (c, s if m else Fraction(0)) for m, (c, s) in wave.items()})


def exact(value: Fraction) -> fmpq:
    return fmpq(value.numerator, value.denominator)


def multiples(space: Space, m: int) -> tuple[Trig, Trig]:
    """cos m tau and sin m tau by the addition theorem."""
    c, s = constant(space, fmpq(1)), constant(space, fmpq(0))
    for _ in range(m):
        c, s = c * cosine(space) - s * sine(space), s * cosine(space) + c * sine(space)
    return c, s


def made(space: Space, wave: Fourier) -> Trig:
    total = constant(space, fmpq(0))
    for m, (a, b) in wave.items():
        c, s = multiples(space, m)
        total = total + c.scale(exact(a)) + s.scale(exact(b))
    return total


def product(p: Fourier, q: Fourier) -> Fourier:
    """By cos a cos b, cos a sin b, sin a sin b as sums, one pair after the other."""
    found: Fourier = {}

    def add(m: int, c: Fraction, s: Fraction) -> None:
        sign = -1 if m < 0 else 1
        a, b = found.get(abs(m), (Fraction(0), Fraction(0)))
        found[abs(m)] = (a + c, b + sign * s if m else Fraction(0))

    for m, (a, b) in p.items():
        for n, (c, d) in q.items():
            add(m - n, (a * c + b * d) / 2, (b * c - a * d) / 2)
            add(m + n, (a * c - b * d) / 2, (b * c + a * d) / 2)
    return found


def same(p: Trig, wave: Fourier, *, free: tuple[int, ...] = ()) -> bool:
    """Each harmonic but the free ones, up to well beyond both, is the exact one or a narrow ball around it."""
    for m in (m for m in range(16) if m not in free):
        for found, wanted in zip(harmonic(p, m), wave.get(m, (Fraction(0), Fraction(0))), strict=True):
            if isinstance(found, arb):
                if not (found.overlaps(arb(exact(wanted))) and found.rad() < arb("1e-9")):
                    return False
            elif found != exact(wanted):
                return False
    return True


@pytest.mark.parametrize("basis", SPACES)
@settings(deadline=None, max_examples=10)
@given(p=waves, q=waves)
def test_products_and_sums_are_those_of_fourier_sums(basis: str, p: Fourier, q: Fourier) -> None:
    space = SPACES[basis]
    assert same(made(space, p) * made(space, q), product(p, q))
    both = {m: tuple(x + y for x, y in zip(p.get(m, (0, 0)), q.get(m, (0, 0)), strict=True)) for m in {*p, *q}}
    assert same(made(space, p) + made(space, q), both)


@pytest.mark.parametrize("basis", SPACES)
@settings(deadline=None, max_examples=10)
@given(p=waves)
def test_derivative_and_oscillator_divide_and_multiply_each_harmonic(basis: str, p: Fourier) -> None:
    space = SPACES[basis]
    wave = made(space, p)
    assert same(wave.derivative(), {m: (m * s, -m * c) for m, (c, s) in p.items()})
    found, resonant_cosine, resonant_sine = solve_oscillator(wave)
    assert same(found, {m: (c / (1 - m * m), s / (1 - m * m)) for m, (c, s) in p.items() if m != 1}, free=(1,))
    left = p.get(1, (Fraction(0), Fraction(0)))
    for value, wanted in zip((resonant_cosine, resonant_sine), left, strict=True):
        assert value.overlaps(arb(exact(wanted))) if isinstance(value, arb) else value == exact(wanted)


@settings(deadline=None, max_examples=10)
@given(p=waves)
def test_value_and_degree_are_read_off(p: Fourier) -> None:
    wave = made(SPACES["powers"], p)
    assert at_zero(wave) == exact(sum((c for c, _ in p.values()), Fraction(0)))
    assert degree(wave) == max((m for m, pair in p.items() if any(pair)), default=0)


def test_a_wrong_sign_would_be_seen() -> None:
    space = SPACES["powers"]
    wave = made(space, {2: (Fraction(1), Fraction(1, 3))})
    assert same(wave, {2: (Fraction(1), Fraction(1, 3))})
    assert not same(-wave, {2: (Fraction(1), Fraction(1, 3))})


FUNCTIONS = ("sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "asin", "atan", "asinh", "atanh", "log")


@pytest.mark.parametrize("name", FUNCTIONS)
def test_functions_of_the_one_constant_where_they_are_rational(name: str) -> None:
    at = int(name == "log")
    expected = int(getattr(sympy, name)(at))
    ring = TrigRing(SPACES["powers"])
    assert at_zero(ring.function(name, ring.rational(at, 1))) == fmpq(expected)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda ring, _: ring.number(sympy.sqrt(2)), "2.* is not rational, and the derivation is exact"),
        (lambda ring, c: ring.invert(c), "no reciprocal: a parameter"),
        (lambda ring, _: ring.invert(ring.rational(0)), "nonzero rational number at the equilibrium"),
        (lambda ring, c: ring.function("sin", c), "sin is taken of a parameter"),
        (lambda ring, _: ring.function("log", ring.rational(2)), "not 1 at the equilibrium"),
        (lambda ring, _: ring.power(ring.rational(2), 1, 2), "the power 1/2 of 2 is not rational"),
    ],
)
def test_what_is_not_rational_is_no_element(call: Callable[[TrigRing, Trig], object], words: str) -> None:
    ring = TrigRing(space_for(("c",)))
    with pytest.raises(InputError, match=words):
        call(ring, ring.parameter("c"))
    wave = cosine(ring.space)
    with pytest.raises(InputError, match="no reciprocal"):
        ring.invert(wave)
    assert at_zero(ring.power(ring.rational(9, 4), -1, 2)) == fmpq(2, 3)
