"""What a value of a formula costs: wall time of this machine in this run."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

from ridgeback.numeric.arrays import Array

REPEATS = 7
TIMED = 2**15
"""Values in a timed call: enough that the call itself costs nothing."""


def nanoseconds(function: Callable[[Array], object], x: Array, *, values: int = TIMED, repeats: int = REPEATS) -> float:
    """Median wall time of a call over the array, per value, repeated to ``values``; one call is not counted."""
    x = np.resize(x, max(values, x.size))
    function(x)
    laps = []
    for _ in range(repeats):
        began = time.perf_counter_ns()
        function(x)
        laps.append(time.perf_counter_ns() - began)
    return float(np.median(laps)) / x.size
