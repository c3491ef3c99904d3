"""A recording made ready for identification: the part asked for, thinned, with the track that the fits start from."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy import signal

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.recording.recording import Recording
from ridgeback.numeric.tracking.track import Track

PER_CYCLE = 24
"""Samples per cycle that are kept when a recording is thinned."""
ENOUGH = 6000
MOST_SAMPLES = 60_000
WINDOW_CYCLES = 4.0
"""Window of the local harmonic least squares that start the fits; their border values are one-sided fits."""


@dataclass(frozen=True)
class Prepared:
    """What identification and prediction of one recording share."""

    recording: Recording
    """The part used, thinned."""
    track: Track
    """Its fundamental frequency over time."""
    notes: tuple[str, ...]
    """What was left out or thinned."""


def prepared(recording: Recording, *, span: tuple[float, float] | None = None) -> Prepared:
    """Thin a recording to what fits need and track its fundamental.

    Parameters
    ----------
    recording
        One signal, evenly sampled.
    span
        First and last time to use; all by default.

    Raises
    ------
    InputError
        For a span without samples, more samples than fit the budget, and a signal that noise alone explains.

    Examples
    --------
    >>> t = np.arange(40_000) / 200.0
    >>> long = Recording(t, np.exp(-0.02 * t) * np.cos(7.0 * t), 200.0, "u", "mm", "long.csv", "")
    >>> prepared(long).notes
    ('Every 7th sample was used, after a low-pass filter.',)
    """
    used, notes = usable(recording, span)
    return Prepared(used, local_track(used).of_oscillation(), notes)


def usable(recording: Recording, span: tuple[float, float] | None) -> tuple[Recording, tuple[str, ...]]:
    """The part asked for, thinned where it has far more samples per cycle than a fit needs, with notes that say so."""
    notes: list[str] = []
    if span is not None:
        keep = (recording.time >= span[0]) & (recording.time <= span[1])
        if np.count_nonzero(keep) < 16:
            raise InputError(
                f"{recording.source}: {np.count_nonzero(keep)} samples lie within {span[0]:g} to {span[1]:g}; "
                f"the recording runs from {recording.time[0]:g} to {recording.time[-1]:g}"
            )
        recording = part_of(recording, recording.time[keep], recording.values[keep], recording.rate)
        notes.append(f"Only times from {span[0]:g} to {span[1]:g} were used.")
    factor = thinning(recording)
    if factor > 1:
        values = signal.decimate(recording.values, factor, ftype="fir", zero_phase=True)
        recording = part_of(recording, recording.time[::factor], values, recording.rate / factor)
        notes.append(f"Every {factor}th sample was used, after a low-pass filter.")
    if recording.values.size > MOST_SAMPLES:
        raise InputError(
            f"{recording.source}: {recording.values.size} samples are over the budget of {MOST_SAMPLES} for fits; "
            f"use a span of {MOST_SAMPLES / recording.rate:.4g} time units or less"
        )
    return recording, tuple(notes)


def part_of(recording: Recording, time: Array, values: Array, rate: float) -> Recording:
    """The same recording with other samples."""
    return Recording(
        time, values, rate, recording.name, recording.units, recording.source, recording.sha256, recording.notes
    )


def thinning(recording: Recording) -> int:
    """Factor by which samples may be thinned and still leave PER_CYCLE in each cycle of the strongest component."""
    if recording.values.size <= ENOUGH:
        return 1
    return max(1, min(int(samples_per_cycle(recording) / PER_CYCLE), math.ceil(recording.values.size / ENOUGH)))


def local_track(recording: Recording) -> Track:
    """The fundamental's track by harmonic least squares in windows of four cycles; auto where they hold too little."""
    x, rate, start = recording.values, recording.rate, float(recording.time[0])
    lag = WINDOW_CYCLES * samples_per_cycle(recording) / rate
    try:
        return estimate(x, rate, method="harmonic-least-squares", lag_seconds=lag, start=start, bias=False)
    except InputError:
        return estimate(x, rate, start=start, bias=False)


def samples_per_cycle(recording: Recording) -> float:
    """Samples in one cycle of the strongest component."""
    x = recording.values - recording.values.mean()
    spectrum = np.abs(np.fft.rfft(x * np.hanning(x.size)))
    return float(x.size / max(1, int(spectrum.argmax())))
