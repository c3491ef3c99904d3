"""Samples that are no measurement: flat tops at the largest or the smallest value, and values that stand still.

A flat top is a run of RUN or more samples that equal the extreme.  A digitised signal has such runs at its turning
points too.  With quantum q a parabola that rounds to one value over n samples has a curvature of at most
4 q / (n - 1)^2 a step squared, so that its sample b beyond the run has left it by at most
q ((1 + (2 b + 1) / (n - 1))^2 + 1).  Only a run that is left faster than that is clipped; b is a quarter of the run,
and not 1, since the first sample may lie anywhere below the level at which a signal is clipped.

Where a top holds fewer than RUN samples, its value tells: a signal that is not clipped comes to its extreme about as
often as to the values next to it.  Of a sine in steps the top one holds at most 1 / (sqrt 2 - 1) = 2.4 times as many
samples as the next, of a flat top that is a quartic 1 / (2^(1/4) - 1) = 5.3 times as many.

A value that stands still between others, as that of a stuck sensor or a zero in place of what was lost, is one that is
left as fast on both sides: what rests in steps before it moves, or after, is left slowly on one.
"""

from __future__ import annotations

import math

import numpy as np

from ridgeback.numeric.arrays import Array, Mask

RUN = 3
BESIDE, OFTEN, FEWEST, TOPS = 8, 6.0, 5, 3
"""Values next to an extreme that are counted; times their mean count, and deviations beyond, that an extreme occurs
which is that of a clipped signal; the samples at it, and the tops that they are in, at least."""
STILL, CHANCE, MOST_STILL = 4, 0.01, 0.2
"""Samples that stand still, at least; the probability that so many in a row are equal where each equals the one before
as often as they do in the record; and the share of samples from which on runs are how the signal is."""
SAME = 1e-9
"""Of the range: differences of values that are none."""


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
            beyond = beyond_run(first, last)
            beside = [abs(float(x[i]) - extreme) for i in (first - beyond, last + beyond) if 0 <= i < x.size]
            if beside and min(beside) > rounding(step, first, last):
                found |= x == extreme  # where one top is cut off, so is every sample that reaches it
                break
        else:
            found |= repeated(x, extreme)
    return found


def beyond_run(first: int, last: int) -> int:
    """Samples beyond a run, from its first to its last, at which it is seen how fast it is left."""
    return max(2, (last - first + 1) // 4)


def rounding(step: float, first: int, last: int) -> float:
    """How far a parabola that rounds to one value over a run may be from it there."""
    return step * ((1.0 + (2 * beyond_run(first, last) + 1) / (last - first)) ** 2 + 1.0) * (1.0 + 1e-9)


def standing_still(x: Array) -> Mask:
    """True at samples between the extremes of ``x`` that equal their neighbours for longer than rounding lets them.

    >>> x = np.sin(0.3 * np.arange(300.0))
    >>> x[120:155] = x[120]
    >>> runs(standing_still(x), 1), standing_still(np.round(0.1 * x, 2))[200:].any().item()
    ([(120, 154)], False)
    """
    found, same = np.zeros(x.size, dtype=np.bool_), np.diff(x) == 0.0
    often = float(np.clip(same.mean(), 1.0 / x.size, 1.0 - 1.0 / x.size))
    least = max(STILL, 1.0 + math.log(CHANCE / x.size) / math.log(often))
    values = np.unique(x)
    for first, last in ((first, last + 1) for first, last in runs(same, 1)):
        at = int(np.searchsorted(values, x[first]))
        if last - first + 1 < least or at in (0, values.size - 1):
            continue
        step, beyond = float(np.diff(values[at - 1 : at + 2]).max()), beyond_run(first, last)
        sides = x[max(0, first - beyond) : first], x[last + 1 : last + 1 + beyond]
        if all(side.size and np.median(np.abs(side - x[first])) > rounding(step, first, last) for side in sides):
            found[first : last + 1] = True
    return found if found.mean() <= MOST_STILL else np.zeros_like(found)


def repeated(x: Array, extreme: float) -> Mask:
    """True at the samples at an extreme that occurs far more often, in tops of its own, than the values next to it.

    >>> t = np.arange(300.0)
    >>> x = np.exp(-0.004 * t) * np.cos(0.84 * t)
    >>> int(repeated(np.minimum(x, 0.8), 0.8).sum()), int(repeated(x, float(x.max())).sum())
    (9, 0)
    """
    steps = np.rint(np.abs(x - extreme) / (SAME * float(np.ptp(x))))
    at = steps == 0
    beside = np.unique(steps[~at], return_counts=True)[1][:BESIDE]
    usual = OFTEN * float(beside.mean()) if beside.size else 0.0
    single = bool((beside == 1).all())
    enough = FEWEST if single else usual + OFTEN * float(np.sqrt(usual))
    clear = beside.size == BESIDE and int(at.sum()) >= enough and len(runs(at, 1)) >= TOPS
    return at if clear else np.zeros_like(at)
