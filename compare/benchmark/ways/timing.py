"""What a value of a formula costs: wall time of this machine in this run, and the code that is timed."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager

import numpy as np

from ridgeback.compare.binding.compiled_code import NotCompiled, OfAmplitude, Vectorised, compiled
from ridgeback.compare.binding.generated_code import python_module
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


@contextmanager
def in_languages(formula: OfAmplitude) -> Iterator[Mapping[str, Vectorised]]:
    """The generated code of a formula over arrays, by language: Python over NumPy, and C where this machine has it."""
    ways: dict[str, Vectorised] = {"python": python_module(formula).omega0}
    with compiled(formula) as native:
        if not isinstance(native, NotCompiled):
            ways["c"] = native
        yield ways
