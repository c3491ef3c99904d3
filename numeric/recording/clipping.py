"""Clipped samples: flat tops at the largest or the smallest value of a recording.

A flat top is a run of RUN or more samples that equal the extreme.  A digitised signal has such runs at its turning
points too.  With quantum q a parabola that rounds to one value over n samples has a curvature of at most
4 q / (n - 1)^2 a step squared, so that its sample b beyond the run has left it by at most
q ((1 + (2 b + 1) / (n - 1))^2 + 1).  Only a run that is left faster than that is clipped; b is a quarter of the run,
and not 1, since the first sample may lie anywhere below the level at which a signal is clipped.
"""

from __future__ import annotations

import numpy as np

from ridgeback.numeric.arrays import Array, Mask

RUN = 3


def quantum(x: Array) -> float:
    """The smallest difference between two values that occur.

    >>> quantum(np.array([0.0, 0.25, 1.0, 0.25]))
    0.25
    """
    steps = np.diff(np.unique(x))
    return float(steps.min()) if steps.size else 0.0


def runs(flags: Mask, shortest: int) -> list[tuple[int, int]]:
    """First and last index of each run of at least ``shortest`` true values.

    >>> runs(np.array([True, True, False, True]), 2)
    [(0, 1)]
    """
    edges = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]).astype(int)))
    pairs = zip(edges[::2].tolist(), (edges[1::2] - 1).tolist(), strict=True)
    return [(first, last) for first, last in pairs if last - first + 1 >= shortest]


def clipped(x: Array) -> Mask:
    """True at samples at an extreme of ``x`` that has a flat top.

    >>> flat = np.clip(np.sin(np.linspace(0.0, 20.0, 200)), -2.0, 0.8)
    >>> bool(clipped(flat)[flat >= 0.8].all()), bool(clipped(flat)[flat < 0.8].any())
    (True, False)
    """
    found = np.zeros(x.size, dtype=np.bool_)
    if x.size < RUN or not np.ptp(x) > 0.0:
        return found
    step = quantum(x)
    for extreme in (float(x.max()), float(x.min())):
        for first, last in runs(x == extreme, RUN):
            beyond = max(2, (last - first + 1) // 4)
            beside = [abs(float(x[i]) - extreme) for i in (first - beyond, last + beyond) if 0 <= i < x.size]
            rounding = step * ((1.0 + (2 * beyond + 1) / (last - first)) ** 2 + 1.0)
            if beside and min(beside) > rounding * (1.0 + 1e-9):
                found |= x == extreme  # where one top is cut off, so is every sample that reaches it
                break
    return found
