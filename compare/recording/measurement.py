"""What is measured of one signal: omega0(t), a(t), backbone and growth rate, and the same of what is beside it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.common.progress import silent
from ridgeback.common.show.brief import Brief
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.backbone.backbone import Backbone, backbone
from ridgeback.numeric.backbone.damping import growth_columns
from ridgeback.numeric.backbone.half_cycles import HalfCycles, half_cycles
from ridgeback.numeric.backbone.hum import hum_of
from ridgeback.numeric.components.modulation import swing_notes
from ridgeback.numeric.components.tones import beside_notes
from ridgeback.numeric.estimators.amplitude import amplitude_of, estimate_amplitude
from ridgeback.numeric.estimators.estimate import Estimation, estimation
from ridgeback.numeric.recording.recording import Recording
from ridgeback.numeric.signal.decimation import Samples, decimation_notes, every, every_flag
from ridgeback.numeric.tracking.track import NORMAL_95, AmplitudeTrack, Track

Row = dict[str, float | bool]


class Along(NamedTuple):
    """Frequency over time with the ends of its 95 % interval, rad per time unit; NaN where nothing is claimed."""

    time: Array
    omega: Array
    low: Array
    high: Array


@dataclass(frozen=True, repr=False)
class Measurement(Brief):
    """One signal: its track or its half cycles, and its backbone where the amplitude is clear of the noise."""

    recording: Recording
    found: Track | HalfCycles
    backbone: Backbone | None
    notes: tuple[str, ...]
    size: AmplitudeTrack | None = None
    """The amplitude of a higher harmonic."""
    component: int = 0
    """Counts the oscillations of one signal from 1, the strongest; 0 where only that is asked for."""
    unmeasured: str = ""
    """Why there is no backbone; empty where there is one."""

    @property
    def track(self) -> Track | None:
        """Its track; None where half cycles were counted."""
        return self.found if isinstance(self.found, Track) else None

    @property
    def method(self) -> str:
        """How the frequency was estimated."""
        return self.found.method if isinstance(self.found, Track) else "half-cycles"

    @property
    def usable(self) -> bool:
        """Whether any value is one that the estimator calls valid."""
        return not self.noise if isinstance(self.found, HalfCycles) else bool(self.found.valid.any())

    @property
    def noise(self) -> str:
        """Why noise alone explains the signal; empty where an oscillation stands out of it."""
        return "" if self.found.presence is None else self.found.presence.reason

    def frequency(self) -> Along:
        """Frequency where it is valid with its 95 % interval: with the bias in it, where the estimator knows that."""
        found = self.found
        if isinstance(found, HalfCycles):
            reach = NORMAL_95 * found.omega_sd
            return Along(found.time, found.omega, found.omega - reach, found.omega + reach)
        values = np.where(found.valid, found.omega, np.nan)
        if found.interval is not None:
            low, high = (np.where(found.valid, end, np.nan) for end in found.interval)
            return Along(found.time, values, low, high)
        sd = found.standard_deviation
        deviation = np.nan if sd is None or found.no_interval is not None else sd
        return Along(found.time, values, values - NORMAL_95 * deviation, values + NORMAL_95 * deviation)

    def rows(self) -> list[Row]:
        """One row per time: frequency, amplitude and growth rate with their standard deviations, NaN where unknown."""
        if isinstance(self.found, HalfCycles):
            return [dict(row) for row in self.found.rows()]
        rows: list[Row] = [dict(row) for row in self.found.rows()]
        columns: Mapping[str, Array] = {}
        if self.backbone is not None:
            columns = amplitude_columns(self.backbone, self.found.time)
        elif self.size is not None:
            columns = size_columns(self.size, self.found.time)
        for name, values in columns.items():
            for row, value in zip(rows, values.tolist(), strict=True):
                row[name] = value
        return rows


def amplitude_columns(curve: Backbone, time: Array) -> Mapping[str, Array]:
    """Amplitude and growth rate along ``time``, linear between the backbone's points, NaN away from them.

    Up to one spacing beyond its ends, as at the first and the last samples, the amplitude goes on at the growth rate.
    """
    spacing = float(np.median(np.diff(curve.time)))
    after = np.clip(np.searchsorted(curve.time, time), 1, curve.time.size - 1)
    beyond = time - np.clip(time, curve.time[0], curve.time[-1])
    near = (beyond != 0.0) | (curve.time[after] - curve.time[after - 1] < 1.5 * spacing)
    near &= np.abs(beyond) <= spacing

    def along(values: Array) -> Array:
        return np.where(near, np.interp(time, curve.time, values), np.nan)

    growth, growth_sd = along(curve.growth_rate), along(curve.growth_rate_sd)
    grown = np.exp(np.where(near, growth * beyond, 0.0))
    amplitude = grown * along(curve.amplitude)
    return {
        "amplitude": amplitude,
        "amplitude_standard_deviation": np.hypot(grown * along(curve.amplitude_sd), amplitude * growth_sd * beyond),
        **growth_columns(growth, growth_sd, along(curve.omega), along(curve.omega_sd)),
    }


def size_columns(size: AmplitudeTrack, time: Array) -> Mapping[str, Array]:
    """The amplitude of a harmonic along ``time``, with its 95 % interval where it claims one."""
    columns = {"amplitude": size.amplitude}
    if size.standard_deviation is not None:
        columns["amplitude_standard_deviation"] = size.standard_deviation
    if size.interval is not None:
        columns |= {"amplitude_low_95": size.interval.low, "amplitude_high_95": size.interval.high}
    return {name: np.interp(time, size.time, values) for name, values in columns.items()}


def of_harmonic(recording: Recording, found: Estimation, multiple: int, band: Any) -> Measurement:
    """A harmonic with its track, phase-locked to the fundamental's, and its amplitude where the data show it."""
    notes, size, used = (*recording.drift_notes(found.track.used.span), *recording.notes), None, found.samples
    try:
        if found.request is not None:
            size = amplitude_of(found.request, multiple)
        else:
            size = estimate_amplitude(used.x, used.rate, harmonic=multiple, band=band, start=used.start)
    except InputError as error:
        notes = (*notes, f"No amplitude: {error}.")
    return Measurement(recording, found.track, None, notes, size, unmeasured="a harmonic has none of its own")


def measure(recording: Recording, *, harmonic: int = 1, halves: bool = False, **settings: object) -> Measurement:
    """Measure frequency, amplitude and growth rate of one signal; without a clear amplitude there is no backbone.

    Parameters
    ----------
    recording
        One signal, evenly sampled.
    harmonic
        Which multiple of the fundamental is tracked; above 1 there is an amplitude and no backbone.
    halves
        Whether frequency and amplitude are taken half cycle by half cycle.
    **settings
        Those of :func:`ridgeback.numeric.estimators.estimate.estimate`.

    Raises
    ------
    InputError
        Where the frequency cannot be estimated.

    Examples
    --------
    >>> t = np.arange(1280) / 32.0
    >>> x = 2.0 * np.exp(-0.05 * t) * np.cos(2 * np.pi * 1.25 * t)
    >>> found = measure(Recording(t, x, 32.0, "u", "mm", "run.csv", ""), method="pseudo-wigner")
    >>> row = found.rows()[640]
    >>> bool(abs(row["frequency_hz"] - 1.25) < 1e-3), round(row["amplitude"], 3), round(row["growth_rate_per_s"], 4)
    (True, 0.736, -0.05)
    """
    if halves:
        return of_half_cycles(recording, settings)
    return measured(recording, estimated(recording, harmonic=harmonic, **settings), harmonic, settings.get("band"))


def estimated(recording: Recording, *, harmonic: int = 1, **settings: object) -> Estimation:
    """The track of one signal, with what led to it."""
    words: Any = settings
    start, wrong = float(recording.time[0]), marked(recording)
    return estimation(recording.values, recording.rate, start=start, harmonic=harmonic, wrong=wrong, **words)


def measured(recording: Recording, found: Estimation, harmonic: int, band: object) -> Measurement:
    """The measurement along a track."""
    track = found.track
    if harmonic > 1:
        return of_harmonic(recording, found, harmonic, band)
    few = decimation_notes(found.samples, float(recording.time[0]), float(recording.time[-1]))
    own = (*few, *recording.drift_notes(track.used.span), *recording.notes)
    told = (
        *beside_notes(track.used.tones, track.used.spikes),
        *swing_notes(track.used.swing),
        *bias_notes(track),
        *own,
    )
    if track.used.doubt:
        said = f"No interval and no amplitude: {track.used.doubt}."
        return Measurement(recording, track, None, (said, *told), unmeasured=track.used.doubt)
    wanted = found.request is not None and found.request.options.bias and track.no_interval is not None
    if wanted and not found.modelled:
        reason = track.no_interval or "no model of one oscillation holds"
        return Measurement(recording, track, None, (f"No amplitude: {reason}.", *told), unmeasured=reason)
    try:
        used = as_tracked(recording, found.samples)
        curve = backbone(
            track,
            used.values,
            used.rate,
            start=float(used.time[0]),
            exclude=marked(used),
            models=found.claimed_models,
        )
    except InputError as error:
        reason = str(error) if track.presence is None or track.presence.found else track.presence.reason
        return Measurement(recording, track, None, (*told, f"No amplitude: {reason}."), unmeasured=reason)
    curve = replace(curve, units=recording.units)
    return Measurement(recording, track, curve, (*hum_notes(curve), *told, *curve.notes))


def bias_notes(track: Track) -> tuple[str, ...]:
    """How many values their own interval does not hold, since it is about the value less its bias.

    >>> w, small, bias = np.full(3, 6.0), np.full(3, 0.01), np.array([0.0, 0.0, 0.5])
    >>> track = Track(np.arange(3.0), w, np.ones(3, dtype=bool), "example", small, bias, bias_deviation=small)
    >>> bias_notes(track)[0][:53]
    'The intervals of 1 of 3 frequencies do not hold these'
    """
    interval = track.interval
    if interval is None or track.bias_removed:
        return ()
    apart = track.valid & ((track.omega < interval.low) | (track.omega > interval.high))
    if not apart.any():
        return ()
    return (
        f"The intervals of {np.count_nonzero(apart)} of {np.count_nonzero(track.valid)} frequencies do not hold these: "
        "they are about the frequency less its bias, which --remove-bias takes off.",
    )


def hum_notes(curve: Backbone) -> tuple[str, ...]:
    """That the oscillation is no decay but mains hum: of constant amplitude, at a multiple of 50 or 60 Hz."""
    tone = hum_of(curve)
    if tone is None:
        return ()
    return (f"What is measured is no decay: {tone.said()}; give a --band round another oscillation.",)


def samples_behind(track: Track, recording: Recording) -> Samples:
    """The samples that a track is of: all of the recording's, or those that its estimator decimated it to."""
    whole = Samples(recording.values, recording.rate, float(recording.time[0]))
    return whole if track.used.decimated_by < 2 else every(whole, track.used.decimated_by)


def as_tracked(recording: Recording, samples: Samples) -> Recording:
    """The recording at the samples that its track is of, without what was found beside the oscillation.

    >>> t = np.arange(20_000) / 1000.0
    >>> run = Recording(t, np.cos(30.0 * t), 1000.0, "u", "mm", "run.csv", "")
    >>> few = as_tracked(run, estimation(run.values, run.rate).samples)
    >>> few.rate < 60.0, bool(np.allclose(few.values, np.cos(30.0 * few.time), atol=1e-3))
    (True, True)
    """
    if samples.factor < 2:
        return replace(recording, values=samples.x)
    clipped, filled = (every_flag(flags, samples.factor) for flags in (recording.clipped, recording.filled))
    return replace(recording, time=samples.time, values=samples.x, rate=samples.rate, clipped=clipped, filled=filled)


def of_half_cycles(recording: Recording, settings: Mapping[str, object]) -> Measurement:
    """Measure one signal half cycle by half cycle; those with clipped samples stay out of the backbone."""
    band: Any = settings.get("band")
    start = float(recording.time[0])
    told: Any = settings.get("progress", silent)
    found = half_cycles(
        recording.values, recording.rate, start=start, band=band, exclude=recording.unsound, progress=told
    )
    hit = None if not recording.clipped.any() else overlapping(recording, found)
    own = (*recording.drift_notes(), *recording.notes)
    try:
        curve = replace(found.backbone(hit), units=recording.units)
    except InputError as error:
        notes = (*found.span_notes(), *own, f"No backbone: {error}.")
        return Measurement(recording, found, None, notes, unmeasured=found.no_interval or "")
    return Measurement(recording, found, curve, (*own, *curve.notes))


def overlapping(recording: Recording, found: HalfCycles) -> Mask:
    """Which half cycles hold clipped samples."""
    before = np.concatenate([[0], np.cumsum(recording.clipped)])
    reach = 0.5 * np.pi / found.omega
    first = np.searchsorted(recording.time, found.time - reach)
    last = np.searchsorted(recording.time, found.time + reach, side="right")
    return np.asarray(before[last] > before[first])


def marked(recording: Recording) -> Mask | None:
    """The samples that count in no fit, clipped ones and those filled in; None where there are none."""
    return recording.unsound if recording.unsound.any() else None
