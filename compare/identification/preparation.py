"""A recording made ready for identification: the part asked for, thinned, with the track that the fits start from."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from scipy.ndimage import maximum_filter1d

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.components.modulation import swing_notes
from ridgeback.numeric.components.tones import beside_notes
from ridgeback.numeric.estimators.estimate import estimate, estimation
from ridgeback.numeric.harmonics.signal_model import SignalModels
from ridgeback.numeric.recording.quantity import named_quantity
from ridgeback.numeric.recording.recording import Recording
from ridgeback.numeric.signal.decimation import RINGING, Samples, every
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.tracking.track import Track

PER_CYCLE = 24
"""Samples per cycle that are kept when a recording is thinned."""
ENOUGH = 3000
MOST_SAMPLES = 60_000
ARTICLES = {"velocity": "a velocity", "acceleration": "an acceleration"}
WINDOW_CYCLES = 4.0
"""Window of the local harmonic least squares that start the fits; their border values are one-sided fits."""

Pair = tuple[float, float]


@dataclass(frozen=True)
class Prepared:
    """What identification and prediction of one recording share."""

    recording: Recording
    """The part used, thinned: one oscillation, without what was found beside it."""
    track: Track
    """Its fundamental frequency over time."""
    notes: tuple[str, ...]
    """What was left out, taken off or thinned."""
    kept: Mask
    """Samples that count: not clipped."""
    models: SignalModels | None = None
    """Models of the samples without any oscillator in mind, where an interval can rest on them."""
    noise: float | None = None
    """Standard deviation of what such a model leaves, in the signal's unit."""
    doubt: str = ""
    """Why no model of one oscillation can be trusted, if so."""
    left: Array | None = None
    """What the best of the models leaves of the samples, 0 where they do not count."""
    whole: Prepared | None = None
    """The same with the tones that were found beside the oscillation, where there are any."""

    def others(self) -> Iterator[Prepared]:
        """What else the oscillation may be: with all that is beside it, and all of the samples in windows.

        A folded harmonic, and a decay that ends at once, may have been taken for tones beside an oscillation.
        """
        least = self.whole or self
        if self.whole is not None:
            yield self.whole
        if self.models is not None:
            yield in_windows(least.recording, least.notes)


def prepared(recording: Recording, *, span: Pair | None = None, band: Pair | None = None) -> Prepared:
    """Make one oscillation of a recording: thinned, where it stands above the noise, without tones beside it.

    Parameters
    ----------
    recording
        One signal, evenly sampled.
    span
        First and last time to use; all by default.
    band
        Lowest and highest frequency of the oscillation, rad per time unit; by default about the strongest component.

    Raises
    ------
    InputError
        For a span without samples, more samples than fit the budget, a signal that noise alone explains, one that is
        no displacement by its name or unit, and a band in which no model of one oscillation holds.

    Examples
    --------
    >>> t = np.arange(40_000) / 200.0
    >>> long = Recording(t, np.exp(-0.02 * t) * np.cos(7.0 * t), 200.0, "u", "mm", "long.csv", "")
    >>> prepared(long).notes
    ('Every 7th sample was used, after a low-pass filter.',)
    """
    named = named_quantity(recording)
    if named:
        raise InputError(
            f"{recording.label}: by its name or unit this is of {ARTICLES[named]}, and oscillators are told apart by "
            f"the displacement; give --quantity {named}, which converts it, or --quantity displacement if it is one"
        )
    used, notes = usable(recording, span, band)
    wrong = used.unsound if used.unsound.any() else None
    start = float(used.time[0])
    try:
        found = estimation(used.values, used.rate, method="harmonic-least-squares", start=start, wrong=wrong, band=band)
    except InputError:
        if band is not None:
            raise
        return in_windows(used, notes)
    track = found.track.of_oscillation()
    if not found.modelled or track.used.doubt or track.interval is None:
        doubt = track.used.doubt or track.no_interval or ""
        if band is not None:
            raise InputError(f"{recording.label}: no model of one oscillation in the band settles: {doubt}")
        return in_windows(used, notes, doubt)
    alone, where = in_its_span(used, track, found.samples.x)
    here = replace(track, used=replace(track.used, span=None))
    said = (*where, *beside_notes((), track.used.spikes), *swing_notes(track.used.swing), *notes)
    told = (*where, *beside_notes(track.used.tones, track.used.spikes), *swing_notes(track.used.swing), *notes)
    models = found.claimed_models
    left = None if models is None else np.where(alone.unsound, 0.0, alone.values - models.best.samples())
    bare = Prepared(alone, here, told, ~alone.unsound, models, track.used.noise, left=left)
    if not track.used.tones or track.used.spikes or band is not None:
        return bare
    together = in_its_span(used, track, used.values)[0]
    return replace(bare, whole=replace(bare, recording=together, notes=said))


def in_windows(recording: Recording, notes: tuple[str, ...], doubt: str = "") -> Prepared:
    """All samples of a recording, with a track of short windows."""
    return Prepared(recording, local_track(recording).of_oscillation(), notes, ~recording.unsound, doubt=doubt)


def in_its_span(recording: Recording, track: Track, values: Array) -> tuple[Recording, tuple[str, ...]]:
    """The samples that a track is of, with these values, and a note that says which are left out."""
    if track.used.span is None:
        return replace(recording, values=values), ()
    first, last = (round((time - recording.time[0]) * recording.rate) for time in track.used.span)
    part = part_of(replace(recording, values=values), slice(first, last + 1))
    return part, track.used.span_notes()


def usable(recording: Recording, span: Pair | None, band: Pair | None = None) -> tuple[Recording, tuple[str, ...]]:
    """The part asked for, thinned where it has far more samples per cycle than a fit needs, with notes that say so."""
    notes: list[str] = []
    if span is not None:
        keep = (recording.time >= span[0]) & (recording.time <= span[1])
        if np.count_nonzero(keep) < 16:
            raise InputError(
                f"{recording.source}: {np.count_nonzero(keep)} samples lie within {span[0]:g} to {span[1]:g}; "
                f"the recording runs from {recording.time[0]:g} to {recording.time[-1]:g}"
            )
        first, last = int(np.flatnonzero(keep)[0]), int(np.flatnonzero(keep)[-1])
        recording = part_of(recording, slice(first, last + 1))
        notes.append(f"Only times from {span[0]:g} to {span[1]:g} were used.")
    factor = thinning(recording, band)
    if factor > 1:
        recording = replace(
            recording,
            time=recording.time[::factor],
            values=thinned(recording, factor),
            rate=recording.rate / factor,
            clipped=maximum_filter1d(recording.clipped, 2 * factor + 1)[::factor],
            filled=maximum_filter1d(recording.filled, 2 * factor + 1)[::factor],
        )
        notes.append(f"Every {factor}th sample was used, after a low-pass filter.")
    if recording.values.size > MOST_SAMPLES:
        raise InputError(
            f"{recording.source}: {recording.values.size} samples are over the budget of {MOST_SAMPLES} for fits; "
            f"use a --span of {MOST_SAMPLES / recording.rate:.4g} time units or less"
        )
    return recording, tuple(notes)


def thinned(recording: Recording, factor: int) -> Array:
    """Every ``factor``-th sample after a low-pass filter; as measured at the ends, which the filter reaches beyond.

    Errs by less than 2e-4 of the amplitude up to three quarters of the new Nyquist frequency (``decimation.FLAT``).
    """
    values = recording.values[::factor].copy()
    values[RINGING:-RINGING] = every(Samples(recording.values, recording.rate, 0.0), factor).x
    return values


def part_of(recording: Recording, cut: slice) -> Recording:
    """The same recording with some of its samples."""
    return replace(
        recording,
        time=recording.time[cut],
        values=recording.values[cut],
        clipped=recording.clipped[cut],
        filled=recording.filled[cut],
    )


def thinning(recording: Recording, band: Pair | None = None) -> int:
    """Factor by which samples may be thinned and still leave PER_CYCLE in a cycle of the strongest, or in a band."""
    if recording.values.size <= ENOUGH:
        return 1
    cycle = samples_per_cycle(recording) if band is None else TWO_PI * recording.rate / band[1]
    return max(1, min(int(cycle / PER_CYCLE), math.ceil(recording.values.size / ENOUGH)))


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
