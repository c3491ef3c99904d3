"""A frequency that runs away from where the spectrum is strongest: followed to its end."""

from __future__ import annotations

import numpy as np
import pytest

from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.tracking.followed import lengthened

T = np.arange(700) / 140.0
LEFT = 1.0 - T / 5.05
OMEGA = 4.0 * np.pi * LEFT**-0.6


@pytest.mark.parametrize("growing", [0.0, 0.36])
def test_a_chirp_that_rises_to_fifteen_times_is_followed_to_its_end(growing: float) -> None:
    noise = 0.002 * np.random.default_rng(3).normal(size=T.size)
    track = estimate(0.3 * LEFT**-growing * np.cos(50.5 * np.pi * (1.0 - LEFT**0.4)) + noise, 140.0)
    assert track.interval is not None
    assert track.time.size > 650
    truth = OMEGA[: track.time.size]
    assert np.abs(track.omega / truth - 1.0).max() < 0.05
    assert np.mean(track.interval.holds(truth)) > 0.9


def test_following_ends_where_there_is_nothing() -> None:
    x = np.where(T < 3.0, np.cos(50.5 * np.pi * (1.0 - LEFT**0.4)), 0.0)
    guide, stretch = lengthened(x, 140.0, np.minimum(OMEGA, 20.0), slice(0, 300))
    assert stretch.start == 0
    assert 380 < stretch.stop < 480
    assert np.abs(guide / OMEGA - 1.0)[20:380].max() < 0.15
