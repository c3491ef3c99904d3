"""A recording read from CSV, NPZ or WAV: one uniformly sampled signal, checked, with the hash of its file."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from numeric.arrays import frozen
from numeric.errors import InputError
from numeric.file_columns import FILE_BUDGET, READERS, Columns
from numeric.samples import Array, checked_budget, checked_rate

TIME_NAMES = ("time", "t", "time_s", "t_s", "times", "seconds", "sec", "timestamp", "time_sec", "time_seconds")
JITTER = 0.02
"""Share of the step by which a time stamp may leave the uniform grid: decimal rounding, not a gap."""
FEWEST_SAMPLES = 16


@dataclass(frozen=True)
class Recording:
    """A uniformly sampled signal; ``time[i] = time[0] + i / rate``, ``values`` as in the file (the mean included).

    ``units`` is what the column's header states in brackets, "full scale" for integer WAV, else empty.
    ``notes`` says what was done on reading; ``sha256`` is that of the file.
    """

    time: Array
    values: Array
    rate: float
    name: str
    units: str
    source: str
    sha256: str
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "time", frozen(self.time))
        object.__setattr__(self, "values", frozen(self.values))


def read_recording(
    path: str | Path,
    *,
    column: str | int | None = None,
    time_column: str | int | None = None,
    rate: float | None = None,
) -> Recording:
    r"""Read one signal from a ``.csv`` (``.txt``, ``.tsv``, ``.dat``), ``.npz`` or ``.wav`` file.

    ``column`` is a name or a number from 1 (WAV: the channel); it may be left out when there is only one candidate.
    The time column is found by name (time, t, time_s, ...) or given as ``time_column``; ``rate`` (samples per second)
    replaces it.  Integer WAV samples are divided by full scale.

    Raises OSError when the file cannot be read, and InputError for everything in it that is not a uniformly sampled
    signal of finite numbers: the message names the line, the column and the value.

    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder) / "run.csv"
    ...     _ = path.write_text("t_s,u [mm]\n" + "".join(f"{i / 10},{i % 3}\n" for i in range(20)))
    ...     recording = read_recording(path)
    >>> recording.name, recording.units, round(recording.rate, 9), recording.values[:4].tolist()
    ('u', 'mm', 10.0, [0.0, 1.0, 2.0, 0.0])
    """
    file = Path(path)
    reader = READERS.get(file.suffix.lower())
    if reader is None:
        raise InputError(f"{file.name}: the suffix {file.suffix!r} is unknown; use one of {', '.join(READERS)}")
    checked_budget(file.stat().st_size, FILE_BUDGET, file.name, "cut the recording into parts")
    data = file.read_bytes()
    columns = reader(data, file.name)
    clock = time_index(columns, time_column, rate)
    index = signal_index(columns, column, clock)
    values = finite_column(columns, index)
    start, found, note = sampling(columns, clock, rate)
    if not np.ptp(values) > 0.0:
        raise InputError(
            f"{file.name}, column {columns.names[index]} is constant at {values[0]:g}; there is no oscillation in it"
        )
    name, units = name_and_units(columns.names[index])
    return Recording(
        time=start + np.arange(values.size) / found,
        values=values,
        rate=found,
        name=name,
        units=units or columns.units,
        source=file.name,
        sha256=hashlib.sha256(data).hexdigest(),
        notes=tuple(text for text in (columns.note, note) if text),
    )


def name_and_units(header: str) -> tuple[str, str]:
    """Split a header into its name and the unit in brackets at its end.

    >>> name_and_units("u [mm]"), name_and_units("time (s)"), name_and_units("velocity")
    (('u', 'mm'), ('time', 's'), ('velocity', ''))
    """
    match = re.fullmatch(r"(.*\S)\s*[\[(]([^\[\]()]*)[\])]\s*", header)
    return (match[1], match[2]) if match else (header, "")


def find_column(columns: Columns, wanted: str | int) -> int:
    """Index of a column by its name (with or without its unit) or its number from 1; InputError lists the columns."""
    listed = ", ".join(columns.names)
    for candidates in (columns.names, [name_and_units(name)[0] for name in columns.names]):
        hits = [i for i, name in enumerate(candidates) if name == wanted]
        if len(hits) == 1:
            return hits[0]
        if hits:
            raise InputError(f"{columns.source} has {len(hits)} columns {wanted}; name one by its number from 1")
    if str(wanted).strip().isdecimal() and 1 <= int(wanted) <= len(columns.names):
        return int(wanted) - 1
    raise InputError(f"{columns.source} has no column {wanted}; it has {listed} (or a number from 1)")


def time_index(columns: Columns, wanted: str | int | None, rate: float | None) -> int | None:
    """Index of the time column, or None where the rate is stated by the file or given."""
    if columns.rate is not None:
        if wanted is not None:
            raise InputError(f"{columns.source} states its sampling rate and has no time column; leave {wanted} out")
        return None
    if wanted is not None:
        return find_column(columns, wanted)
    hits = [i for i, name in enumerate(columns.names) if name_and_units(name)[0].strip().lower() in TIME_NAMES]
    if not hits and rate is None:
        raise InputError(
            f"{columns.source} has no time column among {', '.join(columns.names)}; "
            f"name it, or give the sampling rate in its place"
        )
    return hits[0] if hits else None


def signal_index(columns: Columns, wanted: str | int | None, clock: int | None) -> int:
    """Index of the signal: the one asked for, or the only one beside the time."""
    others: Sequence[int] = [i for i in range(len(columns.names)) if i != clock]
    if wanted is None:
        if len(others) == 1:
            return others[0]
        listed = ", ".join(columns.names[i] for i in others) or "only the time column"
        raise InputError(f"{columns.source}: say which column holds the signal; it has {listed}")
    index = find_column(columns, wanted)
    if index == clock:
        raise InputError(f"{columns.source}: column {columns.names[index]} is the time, not a signal; name another")
    return index


def finite_column(columns: Columns, index: int) -> Array:
    """The numbers of a column, all finite and enough of them."""
    values = columns.values(index)
    if values.size < FEWEST_SAMPLES:
        raise InputError(f"{columns.source} has {values.size} samples; at least {FEWEST_SAMPLES} are needed")
    wrong = np.flatnonzero(~np.isfinite(values))
    if wrong.size:
        at = int(wrong[0])
        raise InputError(
            f"{columns.source}, {columns.place(at)}, column {columns.names[index]}: {values[at]} is not finite; "
            f"cut or fill the gap first ({wrong.size} such values in all)"
        )
    return values


def sampling(columns: Columns, clock: int | None, rate: float | None) -> tuple[float, float, str]:
    """Start time, sampling rate, and a note where a given rate took the place of a time column."""
    stated = columns.rate
    if stated is not None and rate not in (None, stated):
        raise InputError(f"{columns.source} states {stated:g} samples per second, not {rate:g}; leave the rate out")
    if clock is None or rate is not None:
        replaced = "" if clock is None else f"the time column {columns.names[clock]} was replaced by the given rate"
        return 0.0, checked_rate(stated or rate or 0.0), replaced
    stamps = finite_column(columns, clock)
    return float(stamps[0]), uniform_rate(stamps, columns), ""


def uniform_rate(stamps: Array, columns: Columns) -> float:
    """Samples per time unit of increasing, uniform time stamps.

    Raises InputError at the first stamp that does not increase, or whose step or place on the uniform grid is off by
    more than JITTER of a step.
    """
    steps = np.diff(stamps)
    back = np.flatnonzero(steps <= 0.0)
    if back.size:
        at = int(back[0]) + 1
        what = "repeats" if steps[at - 1] == 0.0 else "is before"
        raise InputError(
            f"{columns.source}, {columns.place(at)}: time {stamps[at]:.9g} {what} the one above "
            f"({stamps[at - 1]:.9g}); time stamps must increase"
        )
    usual = float(np.median(steps))
    mean = float(stamps[-1] - stamps[0]) / steps.size
    uneven = np.flatnonzero(np.abs(steps - usual) > 2.0 * JITTER * usual)
    grid = stamps[0] + mean * np.arange(stamps.size)
    drifting = np.flatnonzero(np.abs(stamps - grid) > JITTER * mean)
    if uneven.size or drifting.size:
        at = int(uneven[0]) + 1 if uneven.size else int(drifting[0])
        raise InputError(
            f"{columns.source}, {columns.place(at)}: time {stamps[at]:.9g} comes {steps[at - 1]:.6g} after the one "
            f"above, the usual step is {usual:.6g}; steps must agree to {2 * JITTER:.0%} (resample the recording, "
            f"or give its rate if the stamps are at fault)"
        )
    return 1.0 / mean
