"""Samples that come in steps, of a converter or of a printer, larger than the noise: what rounding does to an interval.

Rounding to steps of q errs by q / sqrt(12) rms; it is as white as noise where the signal, noise and all, runs through
many steps, and repeats with the signal where it does not (W. R. Bennett, Bell Syst. Tech. J. 27 (1948) 446).
"""

from __future__ import annotations

import numpy as np
from scipy.special import ndtr

from ridgeback.numeric.arrays import Array

EXACT, WHOLE, MOST_LEVELS = 1e-3, 0.1, 0.5
"""Share of the widest gap between levels that is none, share of the step by which values may be off whole ones, as
printed digits are, and levels per sample of values that come in none."""
LEVELS = 6
"""To either side of a value, on which it may be rounded: in noise of more than a step the mean error is nothing."""


def step_of(values: Array) -> float | None:
    """The step of which all values are whole multiples apart; None where there are too many levels to tell.

    >>> t = np.arange(400) / 20.0
    >>> step_of(np.round(np.cos(t), 1)).__round__(9), step_of(np.cos(t))
    (0.1, None)
    >>> step_of(np.cos(np.pi * t))
    """
    levels = np.unique(values)
    if levels.size < 3 or levels.size > MOST_LEVELS * values.size:
        return None
    apart = np.diff(levels)
    step = refined(levels - levels[levels.size // 2], float(apart[apart > EXACT * apart.max()].min()))
    whole = (levels - levels[0]) / step
    return step if float(np.abs(whole - np.rint(whole)).max()) < WHOLE else None


def refined(levels: Array, step: float) -> float:
    """A step from about it, by levels further and further from 0 that count how many of it they are.

    >>> round(refined(np.round(np.arange(-2000, 2000) / 7.0, 3), 0.142), 5), round(1 / 7, 5)
    (0.14286, 0.14286)
    """
    reach, furthest = LEVELS * step, float(np.abs(levels).max())
    while True:
        near = levels[np.abs(levels) <= reach]
        whole = np.rint(near / step)
        step = float(near @ whole / (whole @ whole)) if whole.any() else step
        if reach >= furthest:
            return step
        reach *= 2.0


# round(m + n) is above the level j with the probability that m + n is above j + 1/2.
def mean_rounding(values: Array, step: float, noise: float) -> Array:
    """What rounding to steps, one of which is at 0, adds to values in noise of a standard deviation, on the mean.

    >>> places = np.array([0.03, 0.04])
    >>> mean_rounding(places, 0.1, 1e-4).round(3).tolist(), bool(np.abs(mean_rounding(places, 0.1, 0.08)).max() < 1e-6)
    ([-0.03, -0.04], True)
    """
    whole = np.floor(values / step)
    share, spread = values / step - whole, max(noise / step, EXACT)
    above = sum(ndtr((share - 0.5 - j) / spread) - (j < 0) for j in range(-LEVELS, LEVELS + 1))
    return np.asarray(step * (above - share), dtype=np.float64)


def rounding_error(values: Array, predicted: Array, noise: float) -> tuple[Array, float] | None:
    """What the steps in which samples come add to them, on the mean, and the step; None where they come in none.

    Parameters
    ----------
    values : array of float, shape (N,)
        The samples as they were recorded.
    predicted : array of float, shape (N,)
        What a model says of them.
    noise : float
        Standard deviation of what the model leaves, rounding and all.
    """
    step = step_of(values)
    if step is None:
        return None
    white = np.sqrt(max(noise**2 - step**2 / 12.0, 0.0))
    return mean_rounding(predicted - values[0], step, float(white)), step
