"""Tops that are cut off are seen though they hold one or two samples each; those of whole signals are left alone."""

from __future__ import annotations

import numpy as np
import pytest

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.recording.clipping import clipped

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
