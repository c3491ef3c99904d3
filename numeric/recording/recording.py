"""A recording from a file or from arrays: uniformly sampled, without gaps, and openly what was done to make it so.

A file gives one signal per channel (column) and run (file, or value of a run column).  Where values or times are
missing a signal falls into stretches, each uniform and without a gap; nothing is filled in unless it is asked for.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, Mask, frozen, frozen_mask
from ridgeback.numeric.files.column_choice import signal_indices, time_index
from ridgeback.numeric.files.column_names import DEGREES, is_time, name_and_units
from ridgeback.numeric.files.in_memory import Samples, columns_of
from ridgeback.numeric.recording.drift import said_of, wandering
from ridgeback.numeric.recording.file_signals import Signal, Wanted, stamps
from ridgeback.numeric.recording.levels import refuse_level
from ridgeback.numeric.recording.shown import ShownRecording
from ridgeback.numeric.recording.stretches import Stamped, stamped, within
from ridgeback.numeric.recording.treatment import FEWEST_SAMPLES, Treatment, treated
from ridgeback.numeric.signal.samples import checked_swing


@dataclass(frozen=True, repr=False)
class Recording(ShownRecording):
    """A uniformly sampled signal, and what was found and done to get it.

    Parameters
    ----------
    time : array of float, shape (N,)
        ``time[i] = time[0] + i / rate``.
    values : array of float, shape (N,)
        The samples as in the file, the mean included.
    rate : float
        Samples per time unit.
    name : str
        The channel.
    units : str
        What the column's header states in brackets, ``"full scale"`` for integer WAV, else empty.
    source : str
        The file's name.
    sha256 : str
        The file's hash.
    notes : tuple of str
        What was found and done, in words.
    run : str
        The run, where there are several.
    stretch : int
        Counts the stretches of a signal with gaps from 1; 0 where there is no gap.
    clipped, filled : array of bool, shape (N,)
        Samples that are clipped or stand still, and those interpolated across missing ones.
    facts : mapping
        What was found and done, in numbers.

    Examples
    --------
    >>> Recording.from_arrays(np.cos(0.3 * np.arange(40)), 10.0, units="mm").time[-1].item()
    3.9
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

    def drift_notes(self, span: tuple[float, float] | None = None) -> tuple[str, ...]:
        """How far the slow part wanders where the motion is: what is held or at rest beside it is no drift.

        Parameters
        ----------
        span : (float, float), optional
            First and last time of the motion; all by default.

        Returns
        -------
        tuple of str
            A note where it is notable and was left in.

        Examples
        --------
        >>> t = np.arange(2000) / 20.0
        >>> held = Recording.from_arrays(np.where(t < 40.0, 3.0 + 1e-3 * t, np.cos(6.0 * t)), 20.0)
        >>> len(held.drift_notes()), held.drift_notes((41.0, 99.0))
        (1, ())
        """
        drift = self.facts.get("drift")
        if not isinstance(drift, float) or self.facts.get("detrend") != "none":
            return ()
        if span is not None and not math.isnan(drift):
            there = (self.time >= span[0]) & (self.time <= span[1])
            drift = wandering(self.values[there], self.rate, self.unsound[there])
        return said_of(drift)

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
        span: tuple[float, float] | None = None,
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
        resample, fill, detrend, span : optional
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
                span=span,
            )
        )

    @property
    def unsound(self) -> Mask:
        """The samples that enter no fit: clipped and stuck ones, and those interpolated across missing ones."""
        return self.clipped | self.filled

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
    span: tuple[float, float] | None = None,
) -> tuple[Recording, ...]:
    """Make recordings of samples in memory: every stretch between gaps, of every signal asked for.

    Parameters
    ----------
    x : array_like, masked array, Series, DataFrame, DataArray or Dataset
        The samples, real.  NaN, ``None`` and masked samples are missing.
    rate : float, optional
        Samples per time unit.
    time : array_like, optional
        The time of each sample, numbers or dates, in place of a rate.
    column : str, int or sequence of them, optional
        The signals of a table; ``"all"`` takes every one.
    name, units : str, optional
        What the samples are called and measured in.
    resample, fill, detrend, span : optional
        As for :func:`read_recordings`.

    Returns
    -------
    tuple of Recording
        Uniformly sampled stretches.

    Raises
    ------
    InputError
        As for :meth:`Recording.from_arrays`.

    Examples
    --------
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
        found.extend(recordings_of(signal, rate, Treatment(resample, fill, detrend, span)))
    return tuple(found)


def span_note(whole: Stamped, kept: Stamped) -> str:
    """What a span left out; nothing where it left out nothing."""
    if kept.time.size == whole.time.size:
        return ""
    return (
        f"{kept.time.size} of {whole.time.size} samples lie in the span and are used, "
        f"from t = {kept.time[0]:.6g} to {kept.time[-1]:.6g}."
    )


def recordings_of(signal: Signal, rate: float | None, treatment: Treatment) -> list[Recording]:
    """The stretches of one signal, checked and made uniform."""
    columns = signal.columns
    header = columns.names[signal.index]
    name, units = name_and_units(header)
    units = treatment.unit or units or columns.units
    refuse_level("" if treatment.unit else name, units, f"{columns.source}, column {header}")
    values, units, turned = in_radians(columns.values(signal.index), units)
    time, note = stamps(signal, values.size, rate)
    names = (header if signal.clock is None else columns.names[signal.clock], header)
    whole = stamped(time, values[signal.rows], signal.rows, columns, names, fewest=FEWEST_SAMPLES)
    samples = within(whole, treatment.span, source=f"{columns.source}, column {header}", fewest=FEWEST_SAMPLES)
    checked_swing(samples.values, name=f"{columns.source}, column {header}")
    if not np.ptp(samples.values) > 0.0:
        raise InputError(
            f"{columns.source}, column {header} is constant at {samples.values[0]:g}; there is no oscillation in it"
        )
    pieces, notes = treated(samples, columns, header, treatment)
    remarks = tuple(text for text in (columns.note, note, turned, span_note(whole, samples), *notes) if text)
    return [
        Recording(
            time=piece.samples.time,
            values=piece.values,
            rate=piece.samples.rate,
            name=name,
            units=units,
            source=columns.source,
            sha256=signal.sha256,
            notes=(*remarks, *piece.notes),
            run=signal.run,
            stretch=number if len(pieces) > 1 else 0,
            clipped=piece.samples.clipped,
            filled=piece.samples.filled,
            facts=piece.facts,
        )
        for number, piece in enumerate(pieces, start=1)
    ]


def in_radians(values: Array, units: str) -> tuple[Array, str, str]:
    """Angles in degrees as angles in radians, the unit that they have then, and a note; others as they are.

    >>> in_radians(np.array([180.0]), "deg")[1:]
    ('rad', 'angles in deg were converted to rad')
    """
    if units.lower() not in DEGREES:
        return values, units, ""
    return np.radians(values), "rad", f"angles in {units} were converted to rad"


def span(begin: float, end: float) -> str:
    """A stretch of time in words.

    >>> span(0.0, 1.25)
    't = 0 to 1.25'
    """
    return f"t = {begin:.6g} to {end:.6g}"
