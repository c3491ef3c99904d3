"""Time of the frequency estimators on one record, by length."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from ridgeback.numeric.estimators.estimate import METHODS, estimate

RATE = 32.0


def chirp(size: int) -> np.ndarray:
    t = np.arange(size) / RATE
    return np.cos(2 * np.pi * (1.0 * t + 0.2 * t**2 / t[-1]))


@pytest.mark.parametrize("size", [640, 2048])
@pytest.mark.parametrize("method", METHODS)
def test_estimator(benchmark: Any, method: str, size: int) -> None:
    track = benchmark.pedantic(estimate, args=(chirp(size), RATE), kwargs={"method": method}, rounds=3, warmup_rounds=1)
    inside = track.inside()
    assert np.median(np.abs(inside.frequency_hz - 1.0 - 0.4 * inside.time / (size / RATE))) < 0.02
