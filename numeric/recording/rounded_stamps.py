"""Time stamps that a printer rounded: 0.00 0.01 0.03 0.04 at 80 per second is an even clock written to hundredths.

Rounding to a unit u moves each stamp by u / 2 at most, cutting digits off by u: a clock t_0 + k / r explains the stamps
where they leave it within u in all.  Of the rates that do, all but equal, the one with the fewest digits is taken.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.recording.stretches import Stamped
from ridgeback.numeric.recording.uniform import JITTER, grid_of

FEWEST, MOST_DIGITS = 16, 12
"""Samples that tell a rate, and its most digits, or those of the step."""
ODD, ROUND = 4, 3
"""Long steps, and most digits of the rate or the step, where the long ones could as well be samples missing."""
EXACT = 1e-3
"""Share of the unit by which stamps may be off whole multiples of it, and beyond it."""


def unrounded(samples: Stamped) -> tuple[Stamped, str]:
    """The samples at the times of the even clock whose rounding explains their stamps, and a note that says so.

    Those that are even as they are, or that no such clock explains, come back without a note.

    >>> time = np.round(np.arange(40) / 80.0, 2)
    >>> found, note = unrounded(Stamped(time, time, np.arange(40), 0))
    >>> bool(np.abs(found.time - np.arange(40) / 80.0).max() < 0.006), note.split(":")[0]
    (True, 'Time stamps are rounded to 0.01, which explains their uneven steps')
    """
    time = samples.time
    unit = unit_of(time) if time.size >= FEWEST else None
    if unit is None:
        return samples, ""
    gaps = grid_of(time, samples.usual).off <= JITTER
    beside = np.diff(time)[np.diff(samples.row) == 1]
    if gaps and np.count_nonzero(beside > samples.usual + 0.5 * unit) < ODD:
        return samples, ""
    for k in counts(samples, unit):
        found = even(time, k, unit, ROUND if gaps else MOST_DIGITS)
        if found is not None:
            begin, rate = found
            note = (
                f"Time stamps are rounded to {unit:.4g}, which explains their uneven steps: the samples were taken for "
                f"evenly spaced, {rate:.9g} per time unit, which they tell to {100 * unit / np.ptp(time):.1g} %"
            )
            more = " (--fill takes the longer steps for missing samples)" if gaps else ""
            return replace(samples, time=begin + k / rate), f"{note}{more}."
    return samples, ""


def unit_of(time: Array) -> float | None:
    """The unit of which all stamps are whole multiples apart: the least difference of two steps; None without one.

    >>> round(unit_of(np.array([0.0, 0.3, 0.5, 0.8])), 9), unit_of(np.array([0.0, 0.31, 0.5, 0.8131]))
    (0.1, None)
    """
    steps = np.sort(np.diff(time))
    apart = np.diff(steps)
    apart = apart[apart > EXACT * steps[0]]
    if not apart.size:
        return None
    unit = float(apart.min())
    unit = float(time[-1] - time[0]) / max(1.0, float(np.rint((time[-1] - time[0]) / unit)))
    whole = (time - time[0]) / unit
    return unit if float(np.abs(whole - np.rint(whole)).max()) < EXACT * max(1.0, 1e-6 * float(whole[-1])) else None


def counts(samples: Stamped, unit: float) -> Iterator[Array]:
    """The place of each sample on an even clock: by its row, and by the steps of the longest part without a gap."""
    yield (samples.row - samples.row[0]).astype(float)
    time, steps = samples.time, np.rint(np.diff(samples.time) / unit)
    cuts = np.flatnonzero(steps > steps.min() + 1.0) + 1
    part = max(np.split(np.arange(time.size), cuts), key=lambda one: one.size)
    if part.size >= FEWEST:
        step, begin = np.polyfit(np.arange(part.size), time[part], 1)
        places = np.rint((time - begin) / step)
        yield places - places[0]


def even(time: Array, k: Array, unit: float, digits: int) -> tuple[float, float] | None:
    """Begin and rate of the even clock that explains stamps at these places; None without one of so few digits.

    >>> even(np.array([0.0, 0.3, 0.7, 1.0]), np.arange(4.0), 0.1, 3)
    (0.0, 3.0)
    >>> even(np.array([0.0, 0.3, 1.7, 2.0]), np.arange(4.0), 0.1, 12) is None
    True
    """
    if not (np.diff(k) > 0.0).all():
        return None
    step = float(np.polyfit(k, time - time[0], 1)[0])
    for count in range(1, digits + 1):
        for rate in (float(f"{1.0 / step:.{count}g}"), 1.0 / float(f"{step:.{count}g}")):
            off = time - k / rate
            if np.ptp(off) <= unit * (1.0 + EXACT):
                return float(round(0.5 * (off.max() + off.min()), MOST_DIGITS)), rate
    return None
