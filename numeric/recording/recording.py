"""A recording from a file or from arrays: uniformly sampled, without gaps, and openly what was done to make it so.

A file gives one signal per channel (column) and run (file, or value of a run column).  Where values or times are
missing a signal falls into stretches, each uniform and without a gap; nothing is filled in unless it is asked for.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.common.files import check_regular, read_regular
from ridgeback.numeric.arrays import Array, Mask, frozen, frozen_mask
from ridgeback.numeric.files.column_choice import (
    SECONDS,
    find_column,
    is_time,
    name_and_units,
    signal_indices,
    time_index,
    time_unit,
)
from ridgeback.numeric.files.columns import FILE_BUDGET, Columns
from ridgeback.numeric.files.in_memory import Samples, columns_of
from ridgeback.numeric.files.readers import READERS
from ridgeback.numeric.recording.shown import ShownRecording
from ridgeback.numeric.recording.stretches import Rows, stamped
from ridgeback.numeric.recording.treatment import FEWEST_SAMPLES, Treatment, treated
from ridgeback.numeric.signal.samples import checked_rate, checked_swing

Wanted = str | int | Sequence[str | int] | None
MOST_SAMPLES = 50_000_000
"""Samples of one signal: 400 MB each for its times and its values."""


@dataclass(frozen=True, repr=False)
class Recording(ShownRecording):
    """A uniformly sampled signal; ``time[i] = time[0] + i / rate``, ``values`` as in the file (the mean included).

    ``units`` is what the column's header states in brackets, "full scale" for integer WAV, else empty.  ``run`` names
    the run where there are several, ``stretch`` counts the stretches of a signal with gaps from 1 (0: there is none).
    ``clipped`` is true at clipped samples, ``filled`` at those interpolated across missing ones.  ``notes`` says in
    words what was found and done, ``facts`` in numbers; ``sha256`` is that of the file.
    """

    time: Array
    values: Array
    rate: float
    name: str
    units: str
    source: str
    sha256: str
    notes: tuple[str, ...] = ()
    run: str = ""
    stretch: int = 0
    clipped: Mask = field(default_factory=lambda: np.zeros(0, dtype=np.bool_))
    filled: Mask = field(default_factory=lambda: np.zeros(0, dtype=np.bool_))
    facts: Mapping[str, object] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "time", frozen(self.time))
        object.__setattr__(self, "values", frozen(self.values))
        for name in ("clipped", "filled"):
            flags = getattr(self, name)
            object.__setattr__(self, name, frozen_mask(flags if flags.size else np.zeros(self.values.size)))
        object.__setattr__(self, "facts", MappingProxyType(dict(self.facts)))

    @classmethod
    def from_arrays(
        cls,
        x: Samples,
        rate: float | None = None,
        *,
        time: Samples = None,
        column: str | int | None = None,
        name: str = "",
        units: str = "",
        resample: float | None = None,
        fill: float | None = None,
        detrend: str = "none",
    ) -> Recording:
        """Make a recording of samples in memory; of a signal with gaps the longest stretch, and ``notes`` says so.

        Parameters
        ----------
        x : array_like, masked array, Series, DataFrame, DataArray or Dataset
            The samples, one-dimensional and real.  NaN, ``None`` and masked samples are missing.
        rate : float, optional
            Samples per time unit.
        time : array_like, optional
            The time of each sample, numbers or dates, in place of a rate.  The index of a pandas object and the
            coordinate of an xarray object are used where neither is given.
        column : str or int, optional
            The signal of a DataFrame or Dataset with several.
        name, units : str, optional
            What the samples are called and measured in.
        resample, fill, detrend : optional
            As for :func:`read_recordings`.

        Returns
        -------
        Recording
            The uniformly sampled signal.

        Raises
        ------
        InputError
            Without a rate or times, with both, and for what :func:`read_recordings` refuses.

        Examples
        --------
        >>> x = np.ma.array(np.cos(0.3 * np.arange(40)), mask=np.arange(40) == 7)
        >>> recording = Recording.from_arrays(x, 10.0, fill=0.2, units="mm")
        >>> recording.channel, recording.rate, int(recording.filled.sum())
        ('x [mm]', 10.0, 1)
        """
        return longest_of(
            recordings_from_arrays(
                x,
                rate,
                time=time,
                column=column,
                name=name,
                units=units,
                resample=resample,
                fill=fill,
                detrend=detrend,
            )
        )

    @property
    def channel(self) -> str:
        """The name with its unit."""
        return f"{self.name} [{self.units}]" if self.units else self.name

    @property
    def label(self) -> str:
        """Source, run, channel and stretch, as far as they tell signals apart."""
        where = [self.run] if self.source in self.run else [self.source, self.run]
        stretch = f"stretch {self.stretch}" if self.stretch else ""
        return ", ".join(part for part in (*where, self.name, stretch) if part)


@dataclass(frozen=True)
class Signal:
    """One channel of one run as the file has it: which rows of which column."""

    columns: Columns
    index: int
    clock: int | None
    rows: Rows
    run: str
    sha256: str


def read_recording(
    path: str | Path,
    *,
    column: str | int | None = None,
    time_column: str | int | None = None,
    rate: float | None = None,
    resample: float | None = None,
    fill: float | None = None,
    detrend: str = "none",
) -> Recording:
    r"""Read one signal from a CSV (.csv, .txt, .tsv, .dat), NPZ, NPY, WAV, MAT or HDF5 (.h5, .hdf5) file.

    ``column`` is a name or a number from 1 (WAV: the channel); it may be left out when there is only one candidate.
    The time column is found by name (time, t, time_s, ...) or given as ``time_column``; ``rate`` (samples per second)
    replaces it.  Integer WAV samples are divided by full scale.  Of a signal with gaps the longest stretch without one
    is taken, and ``notes`` says so; for all stretches, channels or runs and for the further options see
    :func:`read_recordings`.

    Raises OSError when the file cannot be read, and InputError for everything in it that is not a signal of numbers:
    the message names the line, the column and the value.

    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder) / "run.csv"
    ...     _ = path.write_text("t_s,u [mm]\n" + "".join(f"{i / 10},{i % 3}\n" for i in range(20)))
    ...     recording = read_recording(path)
    >>> recording.name, recording.units, round(recording.rate, 9), recording.values[:4].tolist()
    ('u', 'mm', 10.0, [0.0, 1.0, 2.0, 0.0])
    """
    found = read_recordings(
        [path], columns=column, time_column=time_column, rate=rate, resample=resample, fill=fill, detrend=detrend
    )
    return longest_of(found)


def longest_of(found: Sequence[Recording]) -> Recording:
    """The longest stretch, with a note where there are others."""
    longest = max(found, key=lambda recording: recording.values.size)
    if len(found) == 1:
        return longest
    note = f"The longest of {len(found)} stretches is taken: {span(longest.time[0], longest.time[-1])}."
    return Recording(**{**vars(longest), "notes": (*longest.notes, note)})


def recordings_from_arrays(
    x: Samples,
    rate: float | None = None,
    *,
    time: Samples = None,
    column: Wanted = None,
    name: str = "",
    units: str = "",
    resample: float | None = None,
    fill: float | None = None,
    detrend: str = "none",
) -> tuple[Recording, ...]:
    """Every stretch of samples in memory; parameters and errors as for :meth:`Recording.from_arrays`.

    ``column`` may name several columns of a table, or ``"all"``.

    >>> x = np.sin(np.arange(80.0))
    >>> x[40] = np.nan
    >>> [part.values.size for part in recordings_from_arrays(x, 4.0)]
    [40, 39]
    """
    if rate is not None and time is not None:
        raise InputError(f"both a rate, {rate:g}, and times are given; keep one of them")
    columns = columns_of(x, time=time, name=name, units=units)
    timed = any(is_time(header) for header in columns.names)
    if rate is None and not timed:
        raise InputError("the samples have no times; give the sampling rate, or time= with the time of each sample")
    clock = time_index(columns, None, rate) if timed else None
    found: list[Recording] = []
    for index in signal_indices(columns, column, (clock,)):
        values = columns.values(index)
        signal = Signal(columns, index, clock, np.arange(values.size), "", hashlib.sha256(values.tobytes()).hexdigest())
        found.extend(recordings_of(signal, rate, Treatment(resample, fill, detrend)))
    return tuple(found)


def read_recordings(
    paths: Sequence[str | Path],
    *,
    columns: Wanted = None,
    time_column: str | int | None = None,
    rate: float | None = None,
    run_column: str | int | None = None,
    resample: float | None = None,
    fill: float | None = None,
    detrend: str = "none",
) -> tuple[Recording, ...]:
    """Read every stretch of every channel of every run: of several files, or by the values of a ``run_column``.

    ``columns`` is a name, a number, several, or "all".  Where values or times are missing (an empty cell, NaN) the
    signal is cut; ``fill`` interpolates instead where neighbouring samples are at most so many time units apart.
    Uneven times are refused, unless they are nearly even, or ``resample`` gives the rate to interpolate to (a lower
    rate than that of even samples filters them first).  ``detrend`` is "none", "linear" or "slow".  A unit of time in
    the header, such as "t [ms]", is converted to seconds.

    Raises as :func:`read_recording` does.

    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder) / "run.csv"
    ...     rows = [f"{i / 10},{i % 3},{'' if i == 20 else i % 4}" for i in range(50)]
    ...     _ = path.write_text("t_s,u,w" + chr(10) + chr(10).join(rows))
    ...     found = read_recordings([path], columns="all")
    >>> [(recording.name, recording.stretch, recording.values.size) for recording in found]
    [('u', 0, 50), ('w', 1, 20), ('w', 2, 29)]
    """
    treatment = Treatment(resample, fill, detrend)
    names = [Path(path).name for path in paths]
    found: list[Recording] = []
    for path, name in zip(paths, names, strict=True):
        run = "" if len(paths) == 1 else name if names.count(name) == 1 else str(path)
        for signal in signals(Path(path), columns, time_column, rate, run_column, run):
            found.extend(recordings_of(signal, rate, treatment))
    if not found:
        raise InputError("no file is given; name at least one")
    return tuple(found)


def signals(
    file: Path, wanted: Wanted, time_column: str | int | None, rate: float | None, run: str | int | None, file_run: str
) -> Iterator[Signal]:
    """The channels and runs of one file, which is itself the run ``file_run`` when no column tells runs."""
    with suppress(FileNotFoundError):  # of which the suffix may be wrong, too
        check_regular(file)
    reader = READERS.get(file.suffix.lower())
    if reader is None:
        raise InputError(f"{file.name}: the suffix {file.suffix!r} is unknown; use one of {', '.join(READERS)}")
    data = read_regular(file, FILE_BUDGET, "cut the recording into parts")
    columns, digest = reader(data, file.name), hashlib.sha256(data).hexdigest()
    columns = replace(columns, values=lru_cache(maxsize=2)(columns.values))  # the times, for channel after channel
    clock = time_index(columns, time_column, rate)
    by = None if run is None else find_column(columns, run)
    for index in signal_indices(columns, wanted, (clock, by)):
        if columns.sizes[index] > MOST_SAMPLES:
            raise InputError(
                f"{file.name}, column {columns.names[index]} has {columns.sizes[index]} samples, over {MOST_SAMPLES}; "
                "cut the recording into parts"
            )
        for name, rows in runs_of(columns, by, columns.sizes[index]):
            yield Signal(columns, index, clock, rows, ", ".join(text for text in (file_run, name) if text), digest)


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


def recordings_of(signal: Signal, rate: float | None, treatment: Treatment) -> list[Recording]:
    """The stretches of one signal, checked and made uniform."""
    columns = signal.columns
    header = columns.names[signal.index]
    name, units = name_and_units(header)
    values = columns.values(signal.index)
    time, note = stamps(signal, values.size, rate)
    names = (header if signal.clock is None else columns.names[signal.clock], header)
    samples = stamped(time, values[signal.rows], signal.rows, columns, names, fewest=FEWEST_SAMPLES)
    checked_swing(samples.values, name=f"{columns.source}, column {header}")
    if not np.ptp(samples.values) > 0.0:
        raise InputError(
            f"{columns.source}, column {header} is constant at {samples.values[0]:g}; there is no oscillation in it"
        )
    pieces, notes = treated(samples, columns, header, treatment)
    said = tuple(text for text in (columns.note, note, *notes) if text)
    return [
        Recording(
            time=piece.samples.time,
            values=piece.values,
            rate=piece.samples.rate,
            name=name,
            units=units or columns.units,
            source=columns.source,
            sha256=signal.sha256,
            notes=(*said, *piece.notes),
            run=signal.run,
            stretch=number if len(pieces) > 1 else 0,
            clipped=piece.samples.clipped,
            filled=piece.samples.filled,
            facts=piece.facts,
        )
        for number, piece in enumerate(pieces, start=1)
    ]


def stamps(signal: Signal, size: int, rate: float | None) -> tuple[Array, str]:
    """The time of each row of a signal, and a note where a given rate took the place of a time column."""
    columns, clock = signal.columns, signal.clock
    stated = columns.rate
    if clock is None or rate is not None:
        if stated is not None and clock is None and rate not in (None, stated):
            raise InputError(f"{columns.source} states {stated:g} samples per second, not {rate:g}; leave the rate out")
        used = checked_rate(rate if rate is not None else stated or 0.0)
        note = "" if clock is None else f"the time column {columns.names[clock]} was replaced by the given rate"
        return np.arange(signal.rows.size) / used, note
    if columns.sizes[clock] != size:
        raise InputError(
            f"{columns.source}: {columns.names[signal.index]} has {size} samples, the time column "
            f"{columns.names[clock]} {columns.sizes[clock]}; name columns of one length"
        )
    unit, seconds = time_unit(columns.names[clock])
    note = "" if seconds == 1.0 else f"times in {unit} were converted to seconds"
    if unit and unit.lower() not in SECONDS:
        note = f"the unit of time, {unit}, is not known: what is printed per second is per {unit}"
    return seconds * columns.values(clock)[signal.rows], note


def span(begin: float, end: float) -> str:
    """A stretch of time in words.

    >>> span(0.0, 1.25)
    't = 0 to 1.25'
    """
    return f"t = {begin:.6g} to {end:.6g}"
