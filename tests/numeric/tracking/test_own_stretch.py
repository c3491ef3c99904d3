"""A frequency that runs away from where the spectrum is strongest: followed to its end."""

from __future__ import annotations

import math
from itertools import groupby
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.tracking.clear_stretch import FOLLOWED, TURN, followed_stretch
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


@pytest.mark.parametrize(
    "runs", [(60, 140), (140, 60), (30, 90, 80), (30, 80, 90), (40, 62, 50, 48), (59, 47, 45, 49), (200,), (61, 61, 78)]
)
def test_the_longest_run_of_slow_changes_is_followed(runs: tuple[int, ...]) -> None:
    """Between jumps of a guide that else keeps its frequency: the twin asks sample by sample."""
    guide = np.repeat(6.0 * 1.5 ** np.arange(len(runs)), runs)
    slope = [0.5 * (math.log(guide[min(i + 1, 199)]) - math.log(guide[max(i - 1, 0)])) for i in range(200)]
    slow = [abs(8.0 * change) * 2.0 * math.pi / omega <= TURN for change, omega in zip(slope, guide, strict=True)]
    found, begin = list[tuple[int, int]](), 0
    for good, part in groupby(slow):
        size = len(list(part))
        found += [(size, -begin)] if good else []
        begin += size
    size, begin = max(found)
    request: Any = SimpleNamespace(signal=SimpleNamespace(search=SimpleNamespace(guide=guide), rate=8.0))
    enough = FOLLOWED * 200 <= size < 200
    assert followed_stretch(request) == (slice(-begin, size - begin) if enough else None)
