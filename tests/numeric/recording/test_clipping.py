"""Tops that are cut off and values that stand still are seen; tops of whole signals and rests are left alone."""

from __future__ import annotations

import numpy as np
import pytest

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.recording.clipping import clipped, standing_still

N = np.arange(400.0)


def decay(per_cycle: float, growth: float = -2e-3) -> Array:
    """A decay in a little noise."""
    noise = 0.003 * np.random.default_rng(1).normal(size=N.size)
    return np.asarray(np.exp(growth * N) * np.cos(2 * np.pi * N / per_cycle) + noise)


@pytest.mark.parametrize("per_cycle", [5.3, 7.5])
def test_short_tops_that_are_cut_off_are_seen(per_cycle: float) -> None:
    x = np.clip(decay(per_cycle), -0.8, 0.8)
    assert np.array_equal(clipped(x), np.abs(x) == 0.8)


@pytest.mark.parametrize("step", [0.0, 1e-3, 0.05, 0.34])
@pytest.mark.parametrize("growth", [0.0, -2e-3])
@pytest.mark.parametrize("per_cycle", [7.5, 16.0, 31.7])
def test_whole_tops_are_left_alone(step: float, growth: float, per_cycle: float) -> None:
    x = decay(per_cycle, growth)
    assert not clipped(step * np.rint(x / step) if step else x).any()


def test_a_steady_tone_without_noise_on_few_phases_is_not_clipped() -> None:
    assert not clipped(np.cos(2 * np.pi * N / 16.0)).any()
    assert not clipped(np.sin(2 * np.pi * N / 12.0 + 0.1)).any()


@pytest.mark.parametrize("digits", [2, 7])
@pytest.mark.parametrize(("first", "last", "value"), [(120, 155, None), (90, 100, 0.0), (300, 330, 0.0)])
def test_values_that_stand_still_are_seen(digits: int, first: int, last: int, value: float | None) -> None:
    x = decay(19.3)
    x[first:last] = x[first] if value is None else value
    assert np.array_equal(np.flatnonzero(standing_still(np.round(x, digits))), np.arange(first, last))


@pytest.mark.parametrize("step", [1e-6, 0.05, 0.34])
@pytest.mark.parametrize("growth", [0.0, -2e-2])
@pytest.mark.parametrize("per_cycle", [7.5, 31.7, 90.0])
def test_steps_of_whole_signals_do_not_stand_still(step: float, growth: float, per_cycle: float) -> None:
    x = decay(per_cycle, growth)
    assert not standing_still(step * np.rint(x / step)).any()
    assert not standing_still(np.repeat(step * np.rint(x / step), 5)).any()  # each value held


def test_what_rests_before_and_between_motions_does_not_stand_still() -> None:
    held = np.where(N < 80, 1.0, np.cos(0.2 * (N - 80)) * np.exp(-0.02 * (N - 80)))
    struck = held + np.where(N > 300, np.sin(0.3 * (N - 300)), 0.0)
    for x in (held, struck, np.where(N > 380, 0.0, held)):
        assert not standing_still(np.round(x, 2)).any()
