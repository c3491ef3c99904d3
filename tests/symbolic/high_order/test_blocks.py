"""The harmonic basis and its packed products, against slow twins."""

from __future__ import annotations

import pytest
from flint import arb, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.symbolic.expansion.ball_expansion import holds
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.high_order.in_balls import lindstedt_in_balls
from ridgeback.symbolic.series import laurent as laurent_module
from ridgeback.symbolic.series.harmonic_basis import Balls
from ridgeback.symbolic.series.laurent import products
from ridgeback.symbolic.series.relaxed_product import blocks
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
from ridgeback.symbolic.systems.catalogue import find

VDP = "van-der-pol"


def build(space: Space, rows: list[int]) -> Trig:
    """A polynomial from whole numbers, by products and sums of cos and sin alone."""
    c, s = cosine(space), sine(space)
    powers = [constant(space, fmpq(1)), c, s, s * c, c * c, c * c * c, s * c * c, s * c * c * c]
    total = constant(space, fmpq(0))
    for power, factor in zip(powers, rows, strict=True):
        if factor:
            total = total + power.scale(fmpq(factor))
    return total


def agree(balls: Trig, exact: Trig) -> bool:
    pairs = [
        (x, y)
        for multiple in range(max(degree(balls), degree(exact)) + 1)
        for x, y in zip(harmonic(balls, multiple), harmonic(exact, multiple), strict=True)
    ]
    return all(holds(arb(x), y) for x, y in pairs) and holds(arb(at_zero(balls)), at_zero(exact))


whole = st.lists(st.integers(-9, 9), min_size=8, max_size=8)


@given(whole, whole)
@settings(max_examples=60, deadline=None)
def test_the_harmonic_basis_obeys_the_rules_of_the_exact_one(left: list[int], right: list[int]) -> None:
    balls, exact = Balls(1), space_for(())
    (x, y), (p, q) = [(build(space, left), build(space, right)) for space in (balls, exact)]
    assert agree(x * y, p * q)
    assert agree(x.derivative(), p.derivative())
    (u, a, b), (w, c, d) = solve_oscillator(x), solve_oscillator(p)
    first = harmonic(w, 1)  # the exact basis leaves cos tau in what it calls a power; only the equation is common
    assert holds(arb(a), c)
    assert holds(arb(b), d)
    assert agree(u, w - cosine(exact).scale(first[0]) - sine(exact).scale(first[1]))


@given(st.lists(whole, min_size=1, max_size=5), st.lists(whole, min_size=1, max_size=5), st.booleans())
@settings(max_examples=40, deadline=None)
def test_a_packed_block_holds_the_products_one_by_one(a: list[list[int]], b: list[list[int]], sparse: bool) -> None:
    balls, exact = Balls(1), space_for(())
    if sparse:
        a = [row if n % 2 == 0 else [0] * 8 for n, row in enumerate(a)]
    found = products([build(balls, x).parts for x in a], [build(balls, y).parts for y in b])
    for n, parts in enumerate(found):
        total = constant(exact, fmpq(0))
        for i in range(max(0, n - len(b) + 1), min(n + 1, len(a))):
            total = total + build(exact, a[i]) * build(exact, b[n - i])
        assert agree(Trig(balls, parts), total)


@given(
    st.lists(st.integers(1, 9), min_size=2, max_size=6),
    st.lists(st.integers(1, 9), min_size=2, max_size=6),
    st.tuples(*[st.integers(0, 1)] * 4),
)
@settings(max_examples=60, deadline=None)
def test_cosines_and_sines_in_turn_are_multiplied_as_one(a: list[int], b: list[int], kinds: tuple[int, ...]) -> None:
    def row(space: Space, factor: int, n: int, sine_first: int, odd: int) -> Trig:
        c, s = cosine(space), sine(space)
        wave = s if (n + sine_first) % 2 else c
        return (wave + wave * c * c).scale(fmpq(factor)) if odd else (wave * c).scale(fmpq(factor))

    balls, exact = Balls(1), space_for(())
    x, p = ([row(space, v, n, kinds[0], kinds[1]) for n, v in enumerate(a)] for space in (balls, exact))
    y, q = ([row(space, v, n, kinds[2], kinds[3]) for n, v in enumerate(b)] for space in (balls, exact))
    blocks_of = [[t.parts for t in rows] for rows in (x, y)]
    assert all(laurent_module.alternating(block) is not None for block in blocks_of)
    for n, parts in enumerate(products(*blocks_of)):
        total = constant(exact, fmpq(0))
        for i in range(max(0, n - len(b) + 1), min(n + 1, len(a))):
            total = total + p[i] * q[n - i]
        assert agree(Trig(balls, parts), total)


def test_blocks_too_large_to_pack_are_cut(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = lindstedt_in_balls(find(VDP), 30)
    monkeypatch.setattr(laurent_module, "TILE", 3)
    cut = lindstedt_in_balls(find(VDP), 30)
    assert all(x.overlaps(y) for x, y in zip(whole.coefficients, cut.coefficients, strict=True))
    assert cut.misses(lindstedt(find(VDP), 30)) == []


def test_the_blocks_meet_every_pair_once_and_in_time() -> None:
    seen: dict[tuple[int, int], int] = {}
    for n in range(1, 200):
        for length, alone in blocks(n):
            for i in range(length, 2 * length):
                for j in range(n - length, n):
                    for pair in {(i, j)} if alone else {(i, j), (j, i)}:
                        assert max(pair) < n  # only final orders are used
                        seen[pair] = seen.get(pair, 0) + 1
        assert all(seen.get((j, n - j)) == 1 for j in range(1, n))
    assert set(seen.values()) == {1}
