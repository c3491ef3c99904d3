"""The signals that a file holds: one for each channel (column) and run (the file, or a value of a run column)."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.common.files import check_regular, read_regular
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.files.column_choice import find_column, signal_indices, time_index
from ridgeback.numeric.files.column_names import is_date, is_time, name_and_units
from ridgeback.numeric.files.columns import FILE_BUDGET, Columns
from ridgeback.numeric.files.readers import SUFFIXES, columns_of_file
from ridgeback.numeric.files.tables.numbers import stated_mark
from ridgeback.numeric.recording.clock import Clock, clocks, only
from ridgeback.numeric.recording.stretches import Rows
from ridgeback.numeric.recording.uniform import MOST_SAMPLES
from ridgeback.numeric.signal.samples import checked_rate

ALIKE, MOSTLY = 0.02, 0.9
"""Steps of a time column that differ by less than this share are alike; it is even where most of them are."""
TAKEN = "The first column has no name and rises evenly: it was taken for the time in seconds (--time-column, --rate)."
Wanted = str | int | Sequence[str | int] | None


@dataclass(frozen=True)
class Signal:
    """One channel of one run as the file has it: which rows of which column."""

    columns: Columns
    index: int
    clock: int | None
    rows: Rows
    run: str
    sha256: str


@dataclass(frozen=True)
class Places:
    """Where the samples, their times and runs are in a file, by names or numbers, and how its numbers are written."""

    columns: Wanted = None
    time_column: str | int | None = None
    rate: float | None = None
    run_column: str | int | None = None
    decimal: str = "auto"


def signals(file: Path, places: Places, file_run: str) -> Iterator[Signal]:
    """The channels and runs of one file, which is itself the run ``file_run`` when no column tells runs."""
    with suppress(FileNotFoundError):  # of which the suffix may be wrong, too
        check_regular(file)
    suffix = file.suffix.lower()
    if suffix not in SUFFIXES:
        known = f"export a table (.csv), or use one of {', '.join(SUFFIXES)}"
        raise InputError(f"{file.name}: the suffix {file.suffix!r} is unknown; {known}")
    data = read_regular(file, FILE_BUDGET, "cut the recording into parts")
    columns = columns_of_file(data, suffix, file.name, stated_mark(places.decimal))
    digest = hashlib.sha256(data).hexdigest()
    del data  # what columns need of it they hold
    columns = replace(columns, values=lru_cache(maxsize=2)(columns.values))  # the times, for channel after channel
    clock = time_index(columns, places.time_column, places.rate)
    if clock is not None and places.time_column is None and not is_named_time(columns.names[clock]):
        columns = replace(columns, note=f"{columns.note} {TAKEN}".strip())
    by = None if places.run_column is None else find_column(columns, places.run_column)
    for index in signal_indices(columns, places.columns, (clock, by)):
        if columns.sizes[index] > MOST_SAMPLES:
            raise InputError(
                f"{file.name}, column {columns.names[index]} has {columns.sizes[index]} samples, over {MOST_SAMPLES}; "
                "cut the recording into parts"
            )
        for name, rows in runs_of(columns, by, columns.sizes[index]):
            yield Signal(columns, index, clock, rows, ", ".join(text for text in (file_run, name) if text), digest)


def is_named_time(name: str) -> bool:
    """Whether a column's name is that of a time or of a day."""
    return is_time(name) or is_date(name)


def runs_of(columns: Columns, by: int | None, size: int) -> list[tuple[str, Rows]]:
    """Name and rows of each run, in the order in which the runs begin; one without a name when nothing tells them."""
    if by is None:
        return [("", np.arange(size))]
    marks = columns.values(by)
    if marks.size != size:
        raise InputError(f"{columns.source}: run column {columns.names[by]} has {marks.size} rows, the signal {size}")
    values, first = np.unique(marks[np.isfinite(marks)], return_index=True)
    name = name_and_units(columns.names[by])[0]
    return [(f"{name} {values[i]:g}", np.flatnonzero(marks == values[i])) for i in np.argsort(first)]


def stamps(signal: Signal, size: int, rate: float | None) -> tuple[Array, str]:
    """The time of each row of a signal, and a note where a given rate took the place of a time column."""
    columns, clock = signal.columns, signal.clock
    stated = columns.rate
    if clock is None or rate is not None:
        if stated is not None and clock is None and rate not in (None, stated):
            raise InputError(f"{columns.source} states {stated:g} samples per second, not {rate:g}; leave the rate out")
        used = checked_rate(rate if rate is not None else stated or 0.0)
        check_agreement(signal, used)
        note = "" if clock is None else f"the time column {columns.names[clock]} was replaced by the given rate"
        return np.arange(signal.rows.size) / used, note
    if columns.sizes[clock] != size:
        raise InputError(
            f"{columns.source}: {columns.names[signal.index]} has {size} samples, the time column "
            f"{columns.names[clock]} {columns.sizes[clock]}; name columns of one length"
        )
    values = columns.values(clock)[signal.rows]
    found = only(clocks_of(signal), columns.names[clock], values, columns.source)
    return found.times(values), found.note


def clocks_of(signal: Signal) -> tuple[Clock, ...]:
    """What the numbers of a signal's time column can be."""
    columns, clock = signal.columns, signal.clock
    if clock is None:
        return ()
    return clocks(columns.names[clock], columns.values(clock)[signal.rows], stamps=clock in columns.stamps)


def check_agreement(signal: Signal, rate: float) -> None:
    """Refuse a rate that a rising time column contradicts, unless that counts the samples."""
    columns, clock = signal.columns, signal.clock
    if clock is None:
        return
    values = columns.values(clock)[signal.rows]
    wrong = [contradiction(clock.times(values[np.isfinite(values)]), rate) for clock in clocks_of(signal)]
    if all(wrong):
        raise InputError(f"{columns.source}: the time column {columns.names[clock]} {wrong[0]}")


def contradiction(times: Array, rate: float) -> str:
    """How times contradict a rate; empty where they do not, or do not rise, or count the samples.

    >>> contradiction(np.arange(9.0), 5.0), contradiction(0.5 * np.arange(9.0), 2.0)
    ('', '')
    >>> contradiction(0.5 * np.arange(9.0), 5.0)[:45]
    'has steps of 0.5 s, 2 samples per second, not'
    """
    steps = np.diff(times)
    usual = float(np.median(steps)) if steps.size else 0.0
    if usual == 1.0 or not steps.any() or np.any(steps < 0.0):
        return ""
    even = usual > 0.0 and bool(np.mean(np.abs(steps - usual) <= ALIKE * usual) > MOSTLY)
    mean = float(steps.mean())
    known = ALIKE + float(np.quantile(steps, MOSTLY)) / max(float(steps.sum()), usual)  # a clock's tick may be coarse
    if even and abs(usual * rate - 1.0) > ALIKE:
        return (
            f"has steps of {usual:.6g} s, {1.0 / usual:.6g} samples per second, not {rate:g}; leave --rate out, or "
            "name another --time-column"
        )
    if mean > 0.0 and abs(mean * rate - 1.0) > known:
        why = "has gaps, which a rate would close" if even else f"has {1.0 / mean:.6g} samples per second, not {rate:g}"
        return f"{why}; leave --rate out"
    return ""
