"""Stamps that a printer rounded are those of an even clock; missing samples and jitter are not taken for rounding."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from ridgeback.numeric.recording.recording import Recording
from ridgeback.numeric.recording.rounded_stamps import unrounded
from ridgeback.numeric.recording.stretches import Stamped


def stamped(time: np.ndarray, row: np.ndarray | None = None) -> Stamped:
    return Stamped(time, np.cos(time), np.arange(time.size) if row is None else row, 0)


@pytest.mark.parametrize("rate", [80.0, 60.0, 30.0, 64.0, 29.97, 90.0])
@pytest.mark.parametrize("written", [lambda t: np.round(t, 2), lambda t: np.floor(100.0 * t + 1e-9) / 100.0])
def test_the_clock_behind_rounded_stamps_is_found(rate: float, written: Callable[[np.ndarray], np.ndarray]) -> None:
    time = 0.123 + np.arange(600) / rate
    found, note = unrounded(stamped(written(time)))
    assert note
    assert np.diff(found.time) == pytest.approx(1.0 / rate, rel=1e-9)
    assert np.abs(found.time - time).max() < 0.0075


@pytest.mark.parametrize(
    "time",
    [
        np.delete(np.arange(500) / 100.0, 250),
        (np.arange(500) / 100.0)[np.sort(np.random.default_rng(1).choice(500, 470, replace=False))],
        np.round(np.arange(500) / 30.0 + 1e-3 * np.random.default_rng(2).standard_normal(500), 3),
        np.sort(np.random.default_rng(3).uniform(0.0, 10.0, 500)),
        np.arange(500) / 80.0,
    ],
    ids=["a gap", "missing at random", "jitter", "uneven", "even"],
)
def test_what_rounding_does_not_explain_is_left_alone(time: np.ndarray) -> None:
    assert unrounded(stamped(time))[1] == ""


def test_rows_without_a_value_are_missing_and_not_rounded() -> None:
    rows = np.sort(np.random.default_rng(4).choice(800, 760, replace=False))
    assert unrounded(stamped(rows / 80.0, rows))[1] == ""
    found, note = unrounded(stamped(np.round(rows / 80.0, 2), rows))
    assert note
    assert found.time == pytest.approx(rows / 80.0, abs=1e-9)


def test_a_recording_says_what_was_taken_for_even() -> None:
    time = np.arange(400) / 80.0
    made = Recording.from_arrays(np.cos(6.0 * time), time=np.round(time, 2))
    assert made.rate == pytest.approx(80.0, rel=1e-9)
    assert made.values.size == 400
    assert any(note.startswith("Time stamps are rounded to 0.01") for note in made.notes)
