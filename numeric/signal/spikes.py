"""Samples that are no part of the motion: spikes far outside the noise, in which an oscillation has no share.

A sample is a spike where it is FAR robust deviations (1.4826 times the median of the sizes: Hampel, J. Am. Stat. Assoc.
69 (1974) 383) from a model of the whole signal, in a run much shorter than a cycle: where the model itself fails, as
at a jump of the motion, longer runs stand out.  A large spike bends the model about it, so that only what comes near to
the largest within a cycle counts.
"""

from __future__ import annotations

import numpy as np
from scipy.ndimage import maximum_filter1d

from ridgeback.numeric.arrays import Array, Mask

FAR = 6.0
LEAST = 0.01
"""Of the oscillation's amplitude: what a model of a clean signal leaves at the top of a fast decay is none."""
BESIDE = 0.3
"""Of the largest within a cycle: what is less may be where that bends the model."""
LONGEST = 0.125
"""Of a cycle, that a run of spikes may last."""
MOST = 0.1
"""Of the samples, that may be spikes: with more of them the noise is another one."""
TO_SIGMA = 1.4826


def spikes(left: Array, cycle: float, amplitude: float = 0.0) -> Mask:
    """Which samples of a residual are spikes; ``cycle`` in samples, ``amplitude`` that of the oscillation.

    >>> left = np.random.default_rng(1).normal(size=200)
    >>> left[[20, 90]] += 30.0
    >>> np.flatnonzero(spikes(left, 16.0)).tolist()
    [20, 90]
    """
    size = np.abs(left - np.median(left))
    near = maximum_filter1d(size, 2 * round(cycle) + 1)
    off = size > np.maximum(BESIDE * near, max(FAR * TO_SIGMA * float(np.median(size)), LEAST * amplitude))
    edges = np.flatnonzero(np.diff(np.concatenate([[False], off, [False]]).astype(int)))
    for first, last in zip(edges[::2], edges[1::2], strict=True):
        if last - first > max(1.0, LONGEST * cycle):
            off[first:last] = False
    return off if off.mean() <= MOST else np.zeros_like(off)
