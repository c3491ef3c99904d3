"""Recursions in balls: every exact coefficient inside its ball, the same balls after an interrupt, no wrong file."""

from __future__ import annotations

import json
import time
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from flint import arb, arb_poly, ctx, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.common.hashed_lines import write_signed
from ridgeback.common.progress import Progress
from ridgeback.symbolic.arithmetic.balls import number_ball
from ridgeback.symbolic.expansion.ball_expansion import BallExpansion, holds, missing_bits
from ridgeback.symbolic.expansion.cost import Budget, predict
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.high_order import checkpoint as checkpoint_file
from ridgeback.symbolic.high_order import in_balls as in_balls_module
from ridgeback.symbolic.high_order.checkpoint import ball_from, ball_text
from ridgeback.symbolic.high_order.in_balls import lindstedt_in_balls
from ridgeback.symbolic.series import harmonic_basis as basis_module
from ridgeback.symbolic.series import laurent as laurent_module
from ridgeback.symbolic.series import relaxed_product as relaxed_module
from ridgeback.symbolic.series.harmonic_basis import Balls
from ridgeback.symbolic.series.laurent import products
from ridgeback.symbolic.series.relaxed_product import blocks
from ridgeback.symbolic.series.spaces import Parts, Space, space_for
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
from ridgeback.symbolic.singularities.settled import settled_limits
from ridgeback.symbolic.systems.any_form import as_oscillator
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator

VDP = "van-der-pol"


def exact_text(found: BallExpansion) -> list[str]:
    return [ball_text(c) for c in (*found.coefficients, *(found.amplitude_coefficients or ()))]


@pytest.mark.parametrize("name", ["pendulum", "duffing", "helmholtz-duffing", VDP, "rayleigh"])
@pytest.mark.parametrize("amplitude", ["peak", "fundamental"])
def test_every_exact_coefficient_lies_in_its_ball(name: str, amplitude: str) -> None:
    found = lindstedt_in_balls(find(name), 20, amplitude=amplitude, digits=25)
    assert found.misses(lindstedt(find(name), 20, amplitude=amplitude)) == []
    assert missing_bits((*found.coefficients, *(found.amplitude_coefficients or ())), 25) == 0


@pytest.mark.parametrize(
    ("equation", "place"),
    [
        ("u'' - 2 + u**3 = 0", "2**(1/3)"),
        ("u'' - 1 + u**5 + u = 0", "0.7549"),  # a root that radicals do not give
        ("u'' + sin(u) - 1/2 = 0", "pi/6"),
        ("u'' + 2*u + u**2 = 0", None),
    ],
)
def test_irrational_coefficients_lie_in_their_balls(equation: str, place: str | None) -> None:
    own = Oscillator.from_equation(equation) if place is None else as_oscillator(equation, about=place)
    exact, found = lindstedt(own, 8), lindstedt_in_balls(own, 8, digits=30)
    assert missing_bits(found.coefficients, 30) == 0
    with ctx.workprec(200):
        for n, c in enumerate(exact.frequency):
            assert found.frequency[n].overlaps(number_ball(c)), n
    assert settled_limits(own, exact).radius == pytest.approx(settled_limits(own, found).radius)


def test_van_der_pol_to_order_40_keeps_its_digits_and_needs_a_predicted_precision() -> None:
    found = lindstedt_in_balls(find(VDP), 40)
    assert found.misses(lindstedt(find(VDP), 40)) == []
    assert all(c.is_zero() or c.rel_accuracy_bits() > 100 for c in found.coefficients)
    assert all(found.coefficients[n].is_zero() for n in range(1, 40, 2))  # omega0 is even in eps


def test_the_published_coefficients_are_met() -> None:
    # Andersen and Geer, SIAM J. Appl. Math. 42 (1982) 678.
    found = lindstedt_in_balls(find(VDP), 6)
    assert [holds(found.coefficients[n], c) for n, c in ((2, fmpq(-1, 16)), (4, fmpq(17, 3072)))] == [True, True]
    assert found.amplitude_coefficients is not None
    assert holds(found.amplitude_coefficients[4], fmpq(-1033, 552960))


def test_the_coefficients_oscillate_as_the_singularities_at_modulus_3_42_demand() -> None:
    # A pair rho exp(+-i t) gives c_(n+1) c_(n-1) - c_n^2 ~ -rho^(-2n) (per eps^2), so ratios of it tend to rho^-2.
    c = lindstedt_in_balls(find(VDP), 40).coefficients[::2]
    defects = [c[n + 1] * c[n - 1] - c[n] * c[n] for n in range(16, 20)]
    moduli = [(a / b).sqrt() for a, b in pairwise(defects)]
    assert all(abs(m - arb(3.42)) < 0.35 for m in moduli)


def test_units_travel_with_the_balls() -> None:
    fast = find(VDP).with_parameters({"k": 3})
    exact, found = lindstedt(fast, 6), lindstedt_in_balls(fast, 6)
    for ball, value in zip(found.frequency, exact.frequency, strict=True):
        assert holds(ball, fmpq(int(value.p), int(value.q)))
    with ctx.workprec(200):
        assert found.in_balls(arb(0.5)).overlaps(exact.in_balls(arb(0.5)))


def test_the_public_form_prints_digits_that_are_certain() -> None:
    rows = lindstedt_in_balls(find(VDP), 4, digits=12).to_dict()["frequency"]
    assert isinstance(rows, list)
    assert [row["powers"] for row in rows] == [{"eps": 0}, {"eps": 2}, {"eps": 4}]
    assert rows[2]["coefficient"] == "0.00553385416667"  # 17/3072
    json.dumps(rows)


# --- what a wrong computation looks like ---


def test_a_ball_beside_the_truth_is_detected() -> None:
    found = lindstedt_in_balls(find(VDP), 6)
    nudged = list(found.coefficients)
    with ctx.workprec(found.bits):
        nudged[4] = nudged[4] + arb(1e-25)
    assert replace(found, coefficients=tuple(nudged)).misses(lindstedt(find(VDP), 6)) == [4]


def test_an_error_in_the_products_breaks_solvability(monkeypatch: pytest.MonkeyPatch) -> None:
    real = laurent_module._folded

    def wrong(window: list[arb], *, sine: bool, sign: int) -> arb_poly:
        return real(window, sine=sine, sign=sign) * (1 + arb(2) ** -100)

    monkeypatch.setattr(laurent_module, "_folded", wrong)
    with pytest.raises(AssertionError, match="secular sine left"):
        lindstedt_in_balls(find(VDP), 8)


def test_an_error_in_the_solution_is_detected(monkeypatch: pytest.MonkeyPatch) -> None:
    real = basis_module._divided

    def wrong(p: arb_poly, lowest: int) -> arb_poly | None:
        found = real(p, lowest)
        return None if found is None else found * (1 + arb(2) ** -100)

    monkeypatch.setattr(basis_module, "_divided", wrong)
    assert lindstedt_in_balls(find(VDP), 8).misses(lindstedt(find(VDP), 8)) != []


def test_another_expansion_is_no_reference() -> None:
    with pytest.raises(InputError, match="one oscillator in one amplitude"):
        lindstedt_in_balls(find(VDP), 4).misses(lindstedt(find("rayleigh"), 4))


# --- precision ---


def test_too_few_bits_are_made_up_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(in_balls_module, "predicted_bits", lambda _: 90)
    found = lindstedt_in_balls(find(VDP), 16)
    assert found.bits > 90
    assert missing_bits(found.coefficients, 30) == 0
    assert found.misses(lindstedt(find(VDP), 16)) == []


def test_dropping_bits_on_the_way_costs_no_accuracy(monkeypatch: pytest.MonkeyPatch) -> None:
    lean = lindstedt_in_balls(find(VDP), 36)
    monkeypatch.setattr(in_balls_module, "GUARD", 10_000)
    full = in_balls_module._Run(in_balls_module.Task(find(VDP), 36, "peak", 30), lean.bits, None, None).result()
    assert all(x.rad() <= y.rad() * 1.01 for x, y in zip(lean.coefficients, full.coefficients, strict=True))


def test_the_precision_of_the_caller_is_left_alone() -> None:
    before = ctx.prec
    lindstedt_in_balls(find(VDP), 6)
    assert ctx.prec == before


# --- interrupt and resume ---


def interrupted_at(order: int) -> Progress:
    def progress(_: float, step: str) -> None:
        if step.startswith(f"order {order} of "):
            raise KeyboardInterrupt

    return progress


@pytest.mark.parametrize("name", [VDP, "duffing-softening", "pendulum"])
@pytest.mark.parametrize("order", [2, 9, 24, 25])
def test_a_resumed_recursion_gives_the_same_balls_bit_by_bit(name: str, order: int, tmp_path: Path) -> None:
    path = tmp_path / "recursion"
    with pytest.raises(KeyboardInterrupt):
        lindstedt_in_balls(find(name), 24, checkpoint=path, progress=interrupted_at(order))
    assert checkpoint_file.read(path, {}).order == order
    resumed = lindstedt_in_balls(find(name), 24, checkpoint=path)
    assert exact_text(resumed) == exact_text(lindstedt_in_balls(find(name), 24))
    assert list(tmp_path.iterdir()) == [path]  # the caller's to remove; no temporary file is left
    again = lindstedt_in_balls(find(name), 24, checkpoint=path)
    assert exact_text(again) == exact_text(resumed)


def test_an_interrupt_in_the_middle_of_an_order_falls_back_to_its_beginning(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path, calls = tmp_path / "recursion", iter(range(10**6))

    def products_until(left: Sequence[Parts], right: Sequence[Parts]) -> list[Parts]:
        if next(calls) == 57:
            raise KeyboardInterrupt
        return products(left, right)

    with monkeypatch.context() as patched:
        patched.setattr(relaxed_module, "products", products_until)
        with pytest.raises(KeyboardInterrupt):
            lindstedt_in_balls(find(VDP), 24, checkpoint=path)
    assert exact_text(lindstedt_in_balls(find(VDP), 24, checkpoint=path)) == exact_text(
        lindstedt_in_balls(find(VDP), 24)
    )


def test_a_resumed_recursion_does_not_repeat_its_products(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path, calls = tmp_path / "recursion", list[int]()

    def counted(left: Sequence[Parts], right: Sequence[Parts]) -> list[Parts]:
        calls.append(len(left))
        return products(left, right)

    monkeypatch.setattr(relaxed_module, "products", counted)
    with pytest.raises(KeyboardInterrupt):
        lindstedt_in_balls(find(VDP), 24, checkpoint=path, progress=interrupted_at(20))
    first = len(calls)
    lindstedt_in_balls(find(VDP), 24, checkpoint=path)
    assert len(calls) - first < first


def test_a_recursion_is_saved_now_and_then(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(in_balls_module, "SAVE_EVERY", 0.0)
    seen: list[bool] = []
    path = tmp_path / "recursion"
    lindstedt_in_balls(find(VDP), 6, checkpoint=path, progress=lambda *_: seen.append(path.exists()))
    assert seen == [True] * 7


@pytest.fixture
def saved(tmp_path: Path) -> Path:
    path = tmp_path / "recursion"
    with pytest.raises(KeyboardInterrupt):
        lindstedt_in_balls(find(VDP), 12, checkpoint=path, progress=interrupted_at(8))
    return path


@pytest.mark.parametrize(
    ("name", "order", "digits", "amplitude", "named"),
    [
        ("rayleigh", 12, 30, "peak", "oscillator"),
        (VDP, 14, 30, "peak", "order"),
        (VDP, 12, 31, "peak", "precision"),
        (VDP, 12, 30, "fundamental", "amplitude"),
    ],
)
def test_a_checkpoint_of_another_computation_is_refused(
    saved: Path, name: str, order: int, digits: int, amplitude: str, named: str
) -> None:
    before = saved.read_bytes()
    with pytest.raises(InputError, match=f"belongs to the {named}") as caught:
        lindstedt_in_balls(find(name), order, digits=digits, amplitude=amplitude, checkpoint=saved)
    assert "\n" not in str(caught.value)
    assert saved.read_bytes() == before


def test_another_equation_under_the_same_name_is_another_computation(saved: Path) -> None:
    other = Oscillator.from_equation("u'' - eps*(1 - u**4)*u' + u", parameters={"eps": 1}, name=VDP)
    with pytest.raises(InputError, match="belongs to the equation"):
        lindstedt_in_balls(other, 12, checkpoint=saved)


@given(data=st.data())
@settings(max_examples=40, deadline=None)
def test_no_damaged_checkpoint_is_used(data: st.DataObject, tmp_path_factory: pytest.TempPathFactory) -> None:
    path = tmp_path_factory.mktemp("damage") / "recursion"
    with pytest.raises(KeyboardInterrupt):
        lindstedt_in_balls(find(VDP), 4, checkpoint=path, progress=interrupted_at(4))
    text = path.read_bytes()
    place = data.draw(st.integers(0, len(text) - 1))
    cut = data.draw(st.booleans())
    path.write_bytes(text[:place] if cut else text[:place] + bytes([text[place] ^ 1]) + text[place + 1 :])
    with pytest.raises(InputError, match=r"damaged|not a checkpoint"):
        lindstedt_in_balls(find(VDP), 4, checkpoint=path)


def test_a_checkpoint_of_another_version_is_refused(saved: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checkpoint_file, "VERSION", 2)
    with pytest.raises(InputError, match="version 2"):
        lindstedt_in_balls(find(VDP), 12, checkpoint=saved)


def forged(path: Path, **claims: Any) -> None:
    """Change what the head of a checkpoint claims, and sign it again."""
    head, *lines, _ = path.read_text().splitlines(keepends=True)
    claimed = json.loads(head)
    for name, value in claims.items():
        (claimed["identity"] if name in claimed["identity"] else claimed)[name] = value
    write_signed(path, [json.dumps(claimed) + "\n", *lines])


@pytest.mark.parametrize(
    ("claims", "order", "digits", "what"),
    [
        ({"order": "40"}, 40, 30, "order"),  # the waiting blocks are cut at 25
        ({"order": "20"}, 20, 30, "order"),
        ({"precision": "300 digits"}, 24, 300, "precision"),
        ({"precision": "300 digits", "bits": 1293}, 24, 300, "precision"),  # bits that its balls do not have
        ({"bits": 200}, 24, 30, "precision"),
    ],
)
@pytest.mark.parametrize("name", [VDP, "helmholtz-duffing"])
def test_a_forged_claim_is_caught_by_the_numbers(
    name: str, claims: dict[str, Any], order: int, digits: int, what: str, tmp_path: Path
) -> None:
    path = tmp_path / "recursion"
    with pytest.raises(KeyboardInterrupt):
        lindstedt_in_balls(find(name), 24, checkpoint=path, progress=interrupted_at(18))
    forged(path, **claims)
    with pytest.raises(InputError, match=f"claims another {what}"):
        lindstedt_in_balls(find(name), order, digits=digits, checkpoint=path)


def test_a_forged_place_or_content_is_refused(saved: Path) -> None:
    lines = saved.read_text().splitlines(keepends=True)[:-1]
    head = json.loads(lines[0])
    for wrong in ({**head, "order": 11}, {**head, "order": 99}, {**head, "products": 7}, {**head, "bits": "many"}):
        write_signed(saved, [json.dumps(wrong) + "\n", *lines[1:]])
        with pytest.raises(InputError, match="start again"):
            lindstedt_in_balls(find(VDP), 12, checkpoint=saved)


def test_the_pace_of_saving_counts_the_order_that_is_coming(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Orders of 25 s each on a clock of our own: saved after two of them, since a third would end beyond 60 s."""
    begun = time.monotonic()
    clock, at = [begun], list[float]()
    monkeypatch.setattr(in_balls_module.time, "monotonic", lambda: clock[0])
    monkeypatch.setattr(in_balls_module.file, "write", lambda *_: at.append(clock[0]))

    def order_done(*_: object) -> None:
        clock[0] += 25.0

    lindstedt_in_balls(find(VDP), 12, checkpoint=tmp_path / "recursion", progress=order_done)
    assert max(b - a for a, b in pairwise([begun, *at])) < 61.0
    assert len(at) <= 8


def test_a_failed_write_leaves_the_old_checkpoint(saved: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before, old = saved.read_bytes(), checkpoint_file.read(saved, {})

    def full(_: object) -> list[str | None]:
        raise OSError("no space left")

    monkeypatch.setattr(checkpoint_file, "_row", full)
    with pytest.raises(OSError, match="no space"):
        checkpoint_file.write(saved, old)
    assert saved.read_bytes() == before
    assert list(saved.parent.iterdir()) == [saved]


@given(st.integers(-(2**400), 2**400), st.integers(-900, 900), st.integers(0, 2**30 - 1), st.integers(-5000, 5000))
@settings(max_examples=300, deadline=None)
def test_a_ball_is_written_and_read_exactly(mid: int, exponent: int, radius: int, scale: int) -> None:
    x = arb((mid, exponent), (radius, scale))
    y = ball_from(ball_text(x))
    assert (y.mid().man_exp(), y.rad().man_exp()) == (x.mid().man_exp(), x.rad().man_exp())


# --- refused at the door ---


def test_what_balls_cannot_do_is_refused_in_one_line() -> None:
    with pytest.raises(InputError, match="c is no number; balls need one"):
        lindstedt_in_balls(Oscillator.from_equation("u'' + u + c*u**3"), 4)
    with pytest.raises(InputError, match="digits 0"):
        lindstedt_in_balls(find(VDP), 4, digits=0)
    with pytest.raises(InputError, match="no family"):
        lindstedt_in_balls(Oscillator.from_equation("u'' + 2*mu*u' + u + u**3", parameters={"mu": "0.01"}), 4)


def test_a_family_that_only_exact_arithmetic_can_prove_is_refused_as_such() -> None:
    centre = Oscillator.from_equation("u'' + u + u*u'")
    assert len(lindstedt(centre, 4).terms()) == 3
    with pytest.raises(InputError, match="balls cannot prove"):
        lindstedt_in_balls(centre, 4)


@pytest.mark.parametrize(("order", "gigabytes"), [(100, 0.023), (200, 0.127), (300, 0.252), (859, 3.6)])
def test_the_memory_of_a_limit_cycle_is_predicted_as_it_was_measured(order: int, gigabytes: float) -> None:
    assert predict("balls", order).gigabytes == pytest.approx(gigabytes, rel=0.5)


def test_order_859_is_within_an_hour_by_prediction_but_not_within_ten_minutes() -> None:
    assert predict("balls", 859).within(Budget(seconds=3600.0))
    with pytest.raises(InputError, match=r"order 859 by balls would take about .* fits"):
        lindstedt_in_balls(find(VDP), 859)


# --- the basis and the blocks, against slow twins ---


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


def test_a_checkpoint_whose_numbers_contradict_the_equation_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A re-signed forgery is balls that solve no equation: the recursion finds a secular term left over."""
    path = tmp_path / "balls.state"
    lindstedt_in_balls(find("van-der-pol"), 6, digits=10, checkpoint=path)

    def contradicted(*_: object, **__: object) -> None:
        raise AssertionError("secular sine left at order 3")

    monkeypatch.setattr("ridgeback.symbolic.high_order.in_balls.cycle_recursion", contradicted)
    with pytest.raises(InputError, match=r"balls\.state holds numbers that contradict the equation"):
        lindstedt_in_balls(find("van-der-pol"), 6, digits=10, checkpoint=path)
    path.unlink()
    with pytest.raises(AssertionError):
        lindstedt_in_balls(find("van-der-pol"), 6, digits=10)
