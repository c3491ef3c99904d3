"""Whether intervals are of use: they hold the truth, and are no wider than their errors ask for."""

from __future__ import annotations

from typing import Any

import numpy as np

from ridgeback.numeric.arrays import Array


def excess(low: Array, high: Array, truth: Array | float) -> float:
    """Half width over the rms distance of the middle from the truth, rms both: 2 at 95 %, infinite for "anything"."""
    middle = 0.5 * (low + high)
    return float(np.sqrt(np.mean((0.5 * (high - low)) ** 2) / np.mean((middle - truth) ** 2)))


def assert_holds(interval: Any, truth: Array | float, *, share: float, within: float) -> None:
    """At least a share of the intervals of one record hold, which are within a share of the truth half of the time."""
    assert np.mean(interval.holds(truth)) > share
    assert np.median(0.5 * (interval.high - interval.low) / truth) < within
