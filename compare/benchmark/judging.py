"""One support for all that is ranked, and the error of each contender on it.

The interior of the motion (10 % to 90 % of its duration) is where the reference is trusted.  The common support is
the longest stretch of it on which the reference and every contender that covers at least ``LEAST`` of the interior
give a value.  Who covers less is not ranked; its coverage is said, and its error is that on its own part.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.compare.benchmark.contenders import Reference, Row
from ridgeback.compare.benchmark.ways.contender import Contender
from ridgeback.compare.motion.motion import Motion
from ridgeback.numeric.arrays import Array, Mask

LEAST = 0.75
"""Share of the interior that a contender must cover to be ranked."""


def relative_errors(motion: Motion, contenders: Sequence[Contender]) -> Array:
    """Signed relative error of each contender on the motion's samples, ``[row, time]``, NaN where it gives nothing."""
    reference = motion.reference(motion.time)
    table = np.full((len(contenders), motion.time.size), np.nan)
    for index, contender in enumerate(contenders):
        if contender.omega is not None:
            with np.errstate(invalid="ignore", over="ignore"):
                table[index] = contender.omega / reference - 1.0
    table[~np.isfinite(table)] = np.nan
    return table


def coverages(errors: Array, inside: Mask) -> Array:
    """Share of the interior on which each row has an error."""
    return np.asarray(np.isfinite(errors[:, inside]).mean(axis=1))


def common_support(time: Array, errors: Array, inside: Mask) -> tuple[Mask, Mask]:
    """Return the samples of the common support, and which rows share it.

    >>> time = np.arange(6.0)
    >>> errors = np.array([[0, 0, 0, 0, np.nan, 0], [np.nan, 0, 0, 0, 0, 0], [np.nan] * 4 + [0, 0]], dtype=float)
    >>> support, ranked = common_support(time, errors, np.ones(6, bool))
    >>> time[support].tolist(), ranked.tolist()
    ([1.0, 2.0, 3.0], [True, True, False])
    """
    ranked = coverages(errors, inside) >= LEAST
    if not ranked.any():
        raise InputError("no contender covers enough of the motion to be ranked; use a longer duration")
    shared = inside & np.isfinite(errors[ranked]).all(axis=0)
    edges = np.flatnonzero(np.diff(np.concatenate(([False], shared, [False])).astype(int)))
    starts, ends = edges[::2], edges[1::2]
    if not starts.size:
        raise InputError("the contenders share no stretch of the motion; use a longer duration")
    longest = int(np.argmax(ends - starts))
    support = np.zeros(time.size, dtype=bool)
    support[starts[longest] : ends[longest]] = True
    return support, np.asarray(ranked)


def judged(row: Row, error: Array, time: Array, where: Mask, *, ranked: bool, coverage: float) -> Row:
    """Return the row with its norms over ``where``, or over its own part of the interior when it is not ranked."""
    kept = where & np.isfinite(error)
    if row.refused is not None or not kept.any():
        reason = row.refused or "it gives no value on the interior of this motion"
        return replace(row, refused=reason, coverage=coverage)
    values, times = error[kept], time[kept]
    return replace(
        row,
        relative_rms_error=float(np.sqrt(np.mean(values**2))),
        largest=float(np.abs(values).max()),
        mean=float(values.mean()),
        support=(float(times[0]), float(times[-1])),
        coverage=coverage,
        ranked=ranked,
    )


def reference_of(motion: Motion, support: Mask) -> Reference:
    """The reference with what is left open in it, relative rms over the support."""
    time = motion.time[support]
    omega = motion.reference(time)

    def rms(values: Array) -> float:
        return float(np.sqrt(np.nanmean((values / omega) ** 2)))

    return Reference(
        label="cycle frequency of the integrated solution",
        numerical_error=max(rms(motion.interpolation_error[support]), integration_error(motion)),
        definition=rms(motion.spread[support]),
    )


def integration_error(motion: Motion) -> float:
    """Relative error of the frequency that two integrations leave open: their distance in u as a phase, over the run.

    A distance d of two motions of amplitude a is a phase of at most d / a where they move fastest, and that phase has
    built up over all of the phase that was passed.
    """
    passed = float(np.trapezoid(motion.known_omega, motion.time))
    return float(np.nan_to_num(motion.disagreement)) / (float(np.nanmin(motion.energy_peak)) * passed)
