"""Where a recording has no gap: the stretches between missing values, missing times and skipped ones."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.files.columns import Columns

GAP_STEPS = 1.5
"""A step longer than so many usual ones is a gap."""
Rows = NDArray[np.intp]


@dataclass(frozen=True)
class Gap:
    """A place without samples: the times before and after it, and about how many are missing."""

    begin: float
    end: float
    missing: int


@dataclass(frozen=True)
class Stamped:
    """The samples of one signal that are there, with their times; ``row`` is each one's row in the file."""

    time: Array
    values: Array
    row: Rows
    absent: int
    """Rows without a value or without a time."""

    @property
    def usual(self) -> float:
        """The median step."""
        return float(np.median(np.diff(self.time)))

    @property
    def mean(self) -> float:
        """The mean step."""
        return float(self.time[-1] - self.time[0]) / (self.time.size - 1)


def within(samples: Stamped, span: tuple[float, float] | None, *, source: str, fewest: int) -> Stamped:
    """The samples from one time to another, both included; all of them without a span.

    Raises InputError where too few lie in it.

    >>> three = Stamped(np.arange(3.0), np.ones(3), np.arange(3), 0)
    >>> within(three, (0.5, 2.0), source="run.csv", fewest=2).time.tolist()
    [1.0, 2.0]
    """
    if span is None:
        return samples
    inside = (samples.time >= span[0]) & (samples.time <= span[1])
    if np.count_nonzero(inside) < fewest:
        raise InputError(
            f"{source}: span {span[0]:g} to {span[1]:g} holds {np.count_nonzero(inside)} samples, {fewest} are needed; "
            f"the recording runs from {samples.time[0]:g} to {samples.time[-1]:g}"
        )
    return Stamped(samples.time[inside], samples.values[inside], samples.row[inside], samples.absent)


# Infinity is an overflow, not a value left out: it is refused, NaN is a gap.
def stamped(
    time: Array, values: Array, rows: Rows, columns: Columns, names: tuple[str, str], *, fewest: int
) -> Stamped:
    """The rows that have both a time and a value; ``names`` are those of the two columns.

    Raises InputError for infinity, times that do not rise, and too few samples.
    """
    clock, name = names
    for what, numbers in ((name, values), (clock, time)):
        wrong = np.flatnonzero(np.isinf(numbers))
        if wrong.size:
            at = int(wrong[0])
            raise InputError(
                f"{columns.source}, {columns.place(int(rows[at]))}, column {what}: {numbers[at]} is not finite; "
                f"leave the cell empty if there is no value ({wrong.size} such values in all)"
            )
    there = np.isfinite(values) & np.isfinite(time)
    if np.count_nonzero(there) < fewest:
        lost = f", {np.count_nonzero(~there)} of them without a value" if not there.all() else ""
        samples = f"{values.size} sample{'s' * (values.size != 1)}{lost}"
        raise InputError(f"{columns.source}, column {name} has {samples}; at least {fewest} are needed")
    keep = slice(None) if there.all() else there
    kept = Stamped(time[keep], values[keep], rows[keep], int(np.count_nonzero(~there)))
    check_rising(kept, columns)
    return kept


def check_rising(samples: Stamped, columns: Columns) -> None:
    """Refuse times that repeat or go back."""
    steps = np.diff(samples.time)
    back = np.flatnonzero(steps <= 0.0)
    if back.size:
        at = int(back[0]) + 1
        what = "repeats" if samples.time[at] == samples.time[at - 1] else "is before"
        raise InputError(
            f"{columns.source}, {columns.place(int(samples.row[at]))}: time {samples.time[at]:.9g} {what} the one "
            f"above ({samples.time[at - 1]:.9g}); time stamps must increase: {remedy(steps)}"
        )


def remedy(steps: Array) -> str:
    """What helps against times that do not rise, by their steps.

    >>> remedy(np.array([-1.0, -1.0])), remedy(np.array([1.0, -9.0, 1.0]))
    ('turn the rows round', 'they begin again 1 time; number the runs in a column (--run-column), or cut the file')
    >>> remedy(np.array([0.0, 0.1, 0.0]))
    'where their clock is too coarse, --rate takes the place of --time-column'
    """
    if np.all(steps < 0.0):
        return "turn the rows round"
    restarts = int(np.count_nonzero(steps < 0.0))
    if restarts:
        times = f"{restarts} time{'s' * (restarts > 1)}"
        return f"they begin again {times}; number the runs in a column (--run-column), or cut the file"
    return "where their clock is too coarse, --rate takes the place of --time-column"


def split(samples: Stamped, longest: float) -> tuple[list[Stamped], list[Gap]]:
    """Cut the samples where a step is longer than ``longest``.

    >>> rows = np.arange(5)
    >>> parts, gaps = split(Stamped(np.array([0.0, 1, 2, 5, 6]), np.zeros(5), rows, 0), 1.5)
    >>> [part.time.tolist() for part in parts], gaps
    ([[0.0, 1.0, 2.0], [5.0, 6.0]], [Gap(begin=2.0, end=5.0, missing=2)])
    """
    steps = np.diff(samples.time)
    cuts = np.flatnonzero(steps > longest) + 1
    usual = samples.usual
    gaps = [
        Gap(float(samples.time[i - 1]), float(samples.time[i]), max(0, round(float(steps[i - 1]) / usual) - 1))
        for i in cuts
    ]
    parts = zip(*(np.split(a, cuts) for a in (samples.time, samples.values, samples.row)), strict=True)
    return [Stamped(t, x, row, 0) for t, x, row in parts], gaps
