"""Samples that are no part of the motion: spikes far outside the noise, in which an oscillation has no share.

A sample is a spike where it is FAR robust deviations (1.4826 times the median of the sizes near by, since noise may
grow or fall: Hampel, J. Am. Stat. Assoc. 69 (1974) 383) from a model of the whole signal, in a run much shorter than a
cycle: where the model itself fails, as at a jump of the motion, longer runs stand out.  A large spike bends the model
about it, so that only what comes near to the largest within a cycle counts.

Before there is a model, samples stand out of what their neighbours on both sides say of them: SIDE pairs of equal
weight fit least squares that are robust (Cauchy's weights), and what is left is held against its own median near by.
"""

from __future__ import annotations

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from scipy.ndimage import maximum_filter1d, median_filter

from ridgeback.numeric.arrays import Array, Mask

FAR = 6.0
LEAST = 0.01
"""Of the oscillation's amplitude: what a model of a clean signal leaves at the top of a fast decay is none."""
BESIDE = 0.3
"""Of the largest within a cycle: what is less may be where that bends the model."""
LONGEST = 0.125
"""Of a cycle, that a run of spikes may last."""
SCALE = 2.0
"""Cycles on each side whose residuals are the scale of one."""
MOST = 0.1
"""Of the samples, that may be spikes: with more of them the noise is another one."""
TO_SIGMA = 1.4826
SIDE, NEAR, ISOLATED = 8, 65, 8.0
"""Neighbours on each side that predict a sample, samples whose residuals are the scale of one, and times that scale."""
ROUNDS, ROWS, SOFT = 8, 20000, 2.0
"""Of least squares, and of outliers one beside the other; samples that suffice for weights; deviations from which on a
residual counts less."""


def spikes(left: Array, cycle: float, amplitude: float = 0.0) -> Mask:
    """Which samples of a residual are spikes; ``cycle`` in samples, ``amplitude`` that of the oscillation.

    >>> left = np.random.default_rng(1).normal(size=200)
    >>> left[[20, 90]] += 30.0
    >>> np.flatnonzero(spikes(left, 16.0)).tolist()
    [20, 90]
    """
    size = np.abs(left - np.median(left))
    near = maximum_filter1d(size, 2 * round(cycle) + 1)
    usual = scale_of(size, max(NEAR, 2 * round(SCALE * cycle) + 1))
    off = size > np.maximum(BESIDE * near, np.maximum(FAR * usual, LEAST * amplitude))
    edges = np.flatnonzero(np.diff(np.concatenate([[False], off, [False]]).astype(int)))
    for first, last in zip(edges[::2], edges[1::2], strict=True):
        if last - first > max(1.0, LONGEST * cycle):
            off[first:last] = False
    return off if off.mean() <= MOST else np.zeros_like(off)


def scale_of(size: Array, width: int) -> Array:
    """The scale of residuals of these sizes near by: of their medians in windows, the largest of those that see one."""
    medians = median_filter(size, width, mode="reflect")
    return np.asarray(TO_SIGMA * maximum_filter1d(medians, width), dtype=np.float64)


def without_isolated(x: Array) -> tuple[Array, Mask]:
    """Samples with those that stand out of their neighbours replaced by what these say, and which ones these are.

    >>> x = np.cos(0.4 * np.arange(300.0))
    >>> x += 0.01 * np.random.default_rng(1).normal(size=300)
    >>> whole = x.copy()
    >>> x[[3, 53, 56, 200]] += [1.0, 3.0, -9.0, 0.8]
    >>> mended, odd = without_isolated(x)
    >>> np.flatnonzero(odd).tolist(), bool(np.abs(mended - whole).max() < 0.1)
    ([3, 53, 56, 200], True)
    """
    odd, mended = np.zeros(x.size, dtype=np.bool_), x - np.median(x)
    if x.size < NEAR:
        return x, odd
    for _ in range(ROUNDS):
        left, scale = beside_neighbours(mended)
        size, least = np.abs(left), np.maximum(ISOLATED * scale, LEAST * scale_of(np.abs(mended), NEAR))
        new = (size > least) & (size == maximum_filter1d(size, 2 * SIDE + 1)) & ~odd
        odd |= new
        mended -= np.where(odd, left, 0.0)
        if not new.any():
            break
    return (np.where(odd, mended + np.median(x), x), odd) if odd.mean() <= MOST else (x, np.zeros_like(odd))


def beside_neighbours(x: Array) -> tuple[Array, Array]:
    """Samples less what SIDE pairs of neighbours say of them, and the scale of that near by.

    Near an end those on one side alone predict a sample, less well: what that leaves has a scale of its own.
    """
    windows = sliding_window_view(x, 2 * SIDE + 1)
    both = unexplained(windows[:, SIDE + 1 :] + windows[:, SIDE - 1 :: -1], windows[:, SIDE])
    ahead, behind = (unexplained(windows[:, s], windows[:, i]) for s, i in ((slice(1, None), 0), (slice(-1), -1)))
    left = np.concatenate([ahead[:SIDE], both, behind[-SIDE:]])
    scales = [scale_of(np.abs(one), NEAR) for one in (ahead, both, behind)]
    return left, np.concatenate([scales[0][:SIDE], scales[1], scales[2][-SIDE:]])


# Iteratively reweighted: Holland and Welsch, Commun. Stat. A 6 (1977) 813.
def unexplained(columns: Array, y: Array) -> Array:
    """What columns leave of y with the coefficients that fit most of it, not what stands out or is beside that."""
    few = slice(None, None, max(1, y.size // ROWS))
    some, there, weight = columns[few], y[few], np.ones(y[few].size)
    found = np.zeros(columns.shape[1])
    for _ in range(ROUNDS):
        normal, right = some.T @ (weight[:, None] * some), some.T @ (weight * there)
        found = np.asarray(np.linalg.lstsq(normal, right, rcond=1e-12)[0], dtype=np.float64)
        left = there - some @ found
        usual = SOFT * TO_SIGMA * float(np.median(np.abs(left))) + np.finfo(float).tiny
        weight = 1.0 / (1.0 + (left / usual) ** 2)
    return np.asarray(y - columns @ found, dtype=np.float64)
