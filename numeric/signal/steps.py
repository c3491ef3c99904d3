"""Samples that come in steps, of a converter or of a printer, larger than the noise: what rounding does to an interval.

Rounding to steps of q errs by q / sqrt(12) rms; it is as white as noise where the signal, noise and all, runs through
many steps, and repeats with the signal where it does not (W. R. Bennett, Bell Syst. Tech. J. 27 (1948) 446).
"""

from __future__ import annotations

import numpy as np

from ridgeback.numeric.arrays import Array

EXACT, MOST_LEVELS = 1e-3, 0.5
"""Share of the step by which values may be off whole steps, and levels per sample of values that come in none."""
COARSE = 0.4
"""Noise over the step, the rounding's own 0.29 included, below which there is hardly any other."""
FEW, DRIFT = 40, 0.02
"""Phases that are too few for rounding to be as noise on them, and samples by which they may drift in a cycle."""


def step_of(values: Array) -> float | None:
    """The step of which all values are whole multiples apart; None where there are too many levels to tell.

    >>> t = np.arange(400) / 20.0
    >>> step_of(np.round(np.cos(t), 1)).__round__(9), step_of(np.cos(t))
    (0.1, None)
    """
    levels = np.unique(values)
    if levels.size < 3 or levels.size > MOST_LEVELS * values.size:
        return None
    apart = np.diff(levels)
    step = float(apart[apart > EXACT * apart.max()].min())
    whole = (levels - levels[0]) / step
    return step if float(np.abs(whole - np.rint(whole)).max()) < EXACT * max(1.0, float(whole[-1])) else None


def alike(per_cycle: float) -> int | None:
    """How many phases samples fall on again and again, at so many a cycle; None where there are many, or they drift.

    >>> alike(16.0), alike(15.5), alike(15.573), alike(100.0)
    (16, 31, None, None)
    """
    for cycles in (1, 2, 3):
        count = round(cycles * per_cycle)
        if count <= FEW and abs(cycles * per_cycle - count) < DRIFT * cycles:
            return count
    return None


def rounding_doubt(values: Array, noise: float, per_cycle: float) -> str:
    """Why rounding does not act as noise on samples, so many a cycle, about a model of which there is this noise.

    >>> x = np.round(np.cos(2 * np.pi * np.arange(400) / 16), 1)
    >>> rounding_doubt(x, 0.03, 16.0).split(",")[0], rounding_doubt(x, 0.2, 16.0), rounding_doubt(x, 0.03, 16.3)
    ('the samples come in steps of 0.1', '', '')
    """
    step, count = step_of(values), alike(per_cycle)
    if step is None or count is None or noise > COARSE * step:
        return ""
    return (
        f"the samples come in steps of {step:.3g}, larger than their noise, and fall on the same {count} phases "
        "again and again, so that rounding errs alike in every cycle; record finer steps, or at another rate"
    )
