"""A recursion that is interrupted goes on from its file, and from no file that does not fit."""

from __future__ import annotations

import json
import time
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from flint import arb
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.common.hashed_lines import write_signed
from ridgeback.common.progress import Progress
from ridgeback.symbolic.expansion.ball_expansion import BallExpansion
from ridgeback.symbolic.high_order import checkpoint as checkpoint_file
from ridgeback.symbolic.high_order import in_balls as in_balls_module
from ridgeback.symbolic.high_order.checkpoint import ball_from, ball_text
from ridgeback.symbolic.high_order.in_balls import lindstedt_in_balls
from ridgeback.symbolic.series import relaxed_product as relaxed_module
from ridgeback.symbolic.series.laurent import products
from ridgeback.symbolic.series.spaces import Parts
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator

VDP = "van-der-pol"


def exact_text(found: BallExpansion) -> list[str]:
    return [ball_text(c) for c in (*found.coefficients, *(found.amplitude_coefficients or ()))]


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
