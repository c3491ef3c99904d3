"""A mode that a weaker hum outlasts is the oscillation; a hum that has more energy than any decay is."""

from __future__ import annotations

import numpy as np
import pytest

from ridgeback.numeric.estimators.estimate import estimate

RATE, TIME = 40.0, np.arange(360) / 40.0


def record(hum: float, seed: int, growth: float = -0.9) -> np.ndarray:
    """A mode of 19.3 rad/s and a steady tone of 16.3 rad/s, in noise of 0.5 %."""
    rng = np.random.default_rng(seed)
    mode = np.exp(growth * TIME) * np.cos(19.3 * TIME + rng.uniform(0.0, 6.0))
    return mode + hum * np.cos(16.3 * TIME + rng.uniform(0.0, 6.0)) + 0.005 * rng.normal(size=TIME.size)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_hum_with_a_higher_line_is_beside_the_mode_of_more_energy(seed: int) -> None:
    track = estimate(record(0.12, seed), RATE)
    assert track.interval is not None
    held = track.interval.holds(np.full(track.time.size, 19.3))[track.valid]
    assert held.mean() > 0.5
    assert track.time[track.valid][-1] > 3.0
    assert any(abs(tone.omega - 16.3) < 0.02 and tone.growth == 0.0 for tone in track.used.tones)


def test_a_hum_of_more_energy_is_the_oscillation() -> None:
    track = estimate(2.0 * np.cos(16.3 * TIME) + 0.5 * record(0.0, 1), RATE)
    assert np.abs(track.omega[track.valid] - 16.3).max() < 0.1


@pytest.mark.parametrize("seed", [1, 2, 3, 4])
def test_a_small_jump_is_no_mode_above_a_hum(seed: int) -> None:
    """Before it the motion is that after it and beats that end there."""
    rng, t = np.random.default_rng(seed), np.arange(800) / 40.0
    ratio, at = 1.0 + rng.uniform(0.002, 0.03), rng.uniform(6.0, 14.0)
    x = np.cos(6.0 * np.pi * (np.minimum(t, at) + ratio * np.maximum(t - at, 0.0)))
    assert estimate(x + 0.01 * rng.normal(size=t.size), 40.0).interval is None
