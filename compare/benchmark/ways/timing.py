"""What a value of a formula or a track costs: time of this machine's processor, over a few runs, with their scatter.

The processor's and not the clock's, which runs on while other programs have their turn.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ridgeback.numeric.arrays import Array

REPEATS, FEWEST = 7, 2
PATIENCE = 0.03
"""Seconds of runs after which no more than FEWEST are made."""
TIMED = 2**15
"""Values in a timed call: enough that the call itself costs nothing."""
OF_QUARTILES = 1.349
"""Distance of the quartiles of a normal distribution, in its standard deviation."""


@dataclass(frozen=True)
class Cost:
    """What one run takes, s, and how that scatters from run to run, as a share of it."""

    seconds: float
    scatter: float

    def per(self, count: int) -> Cost:
        """The share of one of so many values."""
        return Cost(self.seconds / count, self.scatter)


NOT_TIMED = Cost(math.nan, math.nan)
"""What stands for the cost of what was not run for it."""


def cost_of(laps: Sequence[float]) -> Cost:
    """The median of a few laps, and the standard deviation of one: by the quartiles where there are some.

    Of one alone it is not a number.

    >>> cost_of([2.0, 2.0, 2.1, 2.2, 9.0]).seconds, round(cost_of([2.0, 2.0, 2.1, 2.2, 9.0]).scatter, 3)
    (2.1, 0.071)
    >>> round(cost_of([1.0, 1.1]).scatter, 3)
    0.067
    """
    middle = float(np.median(laps))
    low, high = np.quantile(laps, (0.25, 0.75))
    if len(laps) < FEWEST:
        return Cost(middle, math.nan)
    scatter = float(high - low) / OF_QUARTILES if len(laps) > FEWEST + 1 else float(np.std(laps, ddof=1))
    return Cost(middle, scatter / middle if middle > 0.0 else math.nan)


def lap(run: Callable[[], object]) -> float:
    """Processor time of one run, s."""
    began = time.process_time()
    run()
    return time.process_time() - began


def repeated(run: Callable[[], object], *, laps: Sequence[float] = ()) -> Cost:
    """What a run costs by a few, those that were made already among them; of slow ones FEWEST.

    >>> 0.0 < repeated(lambda: sum(range(1000))).seconds < 1.0
    True
    """
    known = list(laps)
    while len(known) < FEWEST or (len(known) < REPEATS and sum(known) < PATIENCE):
        known.append(lap(run))
    return cost_of(known)


def per_value(function: Callable[[Array], object], x: Array, *, values: int = TIMED) -> Cost:
    """What a value of a call over the array costs, which is repeated to ``values``.

    The first call is not counted, unless it is a slow one.
    """
    x = np.resize(x, max(values, x.size))
    first = lap(lambda: function(x))
    return repeated(lambda: function(x), laps=(first,) if first > PATIENCE else ()).per(x.size)
