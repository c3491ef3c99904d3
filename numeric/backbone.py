"""The backbone of a recording: fundamental frequency and damping against fundamental amplitude, with uncertainty."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

from numeric.arrays import frozen
from numeric.errors import InputError
from numeric.harmonic_fit import Shape, choose_multiples, harmonic_fit
from numeric.harmonics import carrier
from numeric.samples import TWO_PI, Array, Mask, checked_rate, checked_real_samples
from numeric.track import Track
from numeric.windows import half_width

WINDOW_CYCLES = 4.0
POINTS_PER_CYCLE = 4.0
MOST_BINS = 24
CLEAR = 5.0
"""A point is used where the amplitude exceeds its own standard deviation this many times."""


@dataclass(frozen=True)
class Backbone:
    """omega0 and a'/a against the amplitude a; ``definition`` says which amplitude, "fundamental" or "peak".

    Along time: ``time, amplitude, omega, damping`` (a'/a per time unit, negative in a decay) with one-sigma ``_sd``,
    that of omega with the track's bias in it.
    The curve: ``curve_amplitude`` rising, ``curve_omega``, ``curve_damping`` with ``_sd``: means over bins of
    amplitude, all weighted by the precision of omega; their deviation joins the estimates' own with the scatter in
    the bin, counting one independent value per window length.  ``offset`` is the mean that was removed; amplitudes
    are in the signal's unit.
    """

    time: Array
    amplitude: Array
    amplitude_sd: Array
    omega: Array
    omega_sd: Array
    damping: Array
    damping_sd: Array
    curve_amplitude: Array
    curve_omega: Array
    curve_omega_sd: Array
    curve_damping: Array
    curve_damping_sd: Array
    offset: float
    definition: str = "fundamental"
    settings: Mapping[str, object] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        for item in fields(self):
            if isinstance(getattr(self, item.name), np.ndarray):
                object.__setattr__(self, item.name, frozen(getattr(self, item.name)))
        object.__setattr__(self, "settings", MappingProxyType(dict(self.settings)))

    def rows(self) -> list[dict[str, float]]:
        """One row per point of the curve: amplitude, omega, frequency and damping with their standard deviations."""
        columns = {
            "amplitude": self.curve_amplitude,
            "omega_rad_s": self.curve_omega,
            "frequency_hz": self.curve_omega / TWO_PI,
            "omega_standard_deviation_rad_s": self.curve_omega_sd,
            "damping_per_s": self.curve_damping,
            "damping_standard_deviation_per_s": self.curve_damping_sd,
        }
        return [{name: float(column[i]) for name, column in columns.items()} for i in range(self.curve_omega.size)]


def backbone(
    track: Track,
    x: ArrayLike,
    rate: float,
    *,
    start: float | None = None,
    window_seconds: float | None = None,
    exclude: Mask | None = None,
) -> Backbone:
    """Measure amplitude and damping along a frequency track and set omega0 against amplitude.

    The amplitude and its logarithmic slope come from local harmonic least squares over ``window_seconds`` (default
    four cycles), started from the track; omega comes from the track itself.  ``start`` is the time of the first sample
    (default: as the track noted it).  Points whose window holds a sample of ``exclude`` (clipped ones) are left out.
    Raises InputError when fewer than four points are clear of the noise.

    >>> from numeric.estimate import estimate
    >>> t = np.arange(1280) / 32.0
    >>> x = 2.0 * np.exp(-0.05 * t) * np.cos(2 * np.pi * 1.25 * t) + 0.7
    >>> curve = backbone(estimate(x, 32.0), x, 32.0)
    >>> bool(np.abs(curve.curve_damping + 0.05).max() < 1e-4), bool(np.abs(curve.omega - 2.5 * np.pi).max() < 1e-3)
    (True, True)
    """
    samples, rate = checked_real_samples(x, what="backbone", at_least=16), checked_rate(rate)
    first = track.start if start is None else start
    offset = float(samples.mean())
    base = carrier(track, samples.size, rate, first)
    cycle = TWO_PI / float(np.median(base.omega[base.valid]))
    seconds = WINDOW_CYCLES * cycle if window_seconds is None else window_seconds
    half = half_width(seconds, rate, name="window_seconds", longest=samples.size)
    real = samples - offset
    shape = Shape(choose_multiples(real, rate, base.omega, half=half))
    centres = np.arange(0, samples.size, max(1, round(cycle * rate / POINTS_PER_CYCLE)))
    fit = harmonic_fit(real, rate, base.omega, half=half, shape=shape, start_time=first, centres=centres)
    seen = fit.settled if track.settings.get("one_sided_borders") else fit.valid & base.valid[centres]
    clean = ~touched(samples.size, centres, half, exclude)
    usable = seen & clean & (fit.amplitude > CLEAR * fit.amplitude_sd)
    if np.count_nonzero(usable) < 4:
        raise InputError(
            f"backbone: {np.count_nonzero(usable)} points are clear of the noise"
            f"{'' if clean.all() else ' and of clipped samples'}; give a longer or less noisy record"
        )
    omega = base.omega[centres]
    total = total_deviation(track)
    omega_sd = fit.standard_deviation if total is None else np.interp(fit.time, track.time, total)
    points = Points(fit.time, fit.amplitude, fit.amplitude_sd, omega, omega_sd, fit.growth, fit.growth_sd).at(usable)
    crowding = max(1.0, fit.window_seconds / float(np.median(np.diff(fit.time))))
    settings = {"track": track.method, "window_seconds": fit.window_seconds, "harmonics": (1, *shape.multiples)}
    notes = [f"The mean of the samples, {offset:.4g}, was removed.", *left_out_notes(usable, clean)]
    return assemble(points, crowding=crowding, offset=offset, settings=settings, notes=notes)


def total_deviation(track: Track) -> Array | None:
    """Standard deviation of a track's values with what is known of their bias; None where the track knows nothing.

    A bias that is still in the values counts whole, one that was taken off with its own deviation.

    >>> flat = np.full(3, 6.0)
    >>> track = Track(np.arange(3.0), flat, flat > 0, "example", 0.3 + 0 * flat, 0.4 + 0 * flat)
    >>> total_deviation(track).round(12).tolist()
    [0.5, 0.5, 0.5]
    """
    if track.standard_deviation is None:
        return None
    removed = bool(track.settings.get("bias_removed"))
    left = np.zeros_like(track.omega) if track.bias is None or removed else track.bias
    unsure = np.zeros_like(track.omega) if track.bias_deviation is None else track.bias_deviation
    return np.asarray(np.sqrt(track.standard_deviation**2 + left**2 + unsure**2))


def touched(size: int, centres: NDArray[np.intp], half: int, exclude: Mask | None) -> Mask:
    """Which of the windows of harmonic least squares round ``centres`` hold an excluded sample.

    >>> touched(9, np.array([1, 4, 7]), 1, np.arange(9) == 6).tolist()
    [False, False, True]
    """
    if exclude is None:
        return np.zeros(centres.size, dtype=np.bool_)
    before = np.concatenate([[0], np.cumsum(exclude)])
    begins = np.clip(centres - half, 0, size - 2 * half - 1)
    return np.asarray(before[begins + 2 * half + 1] > before[begins])


def left_out_notes(usable: Mask, clean: Mask) -> list[str]:
    """How many points were left out, and why."""
    notes, unclear = [], int(np.count_nonzero(clean & ~usable))
    if unclear:
        notes.append(
            f"{unclear} of {usable.size} points lie near a border or are not {CLEAR:g} times above noise; left out."
        )
    if not clean.all():
        notes.append(
            f"{np.count_nonzero(~clean)} of {usable.size} points have clipped samples in their window; left out."
        )
    return notes


@dataclass(frozen=True)
class Points:
    """Amplitude, frequency and damping along time with their standard deviations, before they are binned."""

    time: Array
    amplitude: Array
    amplitude_sd: Array
    omega: Array
    omega_sd: Array
    damping: Array
    damping_sd: Array

    def at(self, keep: Mask) -> Points:
        """Some of the points."""
        return Points(**{item.name: getattr(self, item.name)[keep] for item in fields(self)})


def assemble(
    points: Points,
    *,
    crowding: float,
    offset: float,
    settings: Mapping[str, object],
    notes: Sequence[str],
    definition: str = "fundamental",
    fewest: int = 1,
) -> Backbone:
    """Put points into a Backbone and bin them over amplitude, at least ``fewest`` in a bin.

    ``crowding`` neighbours count as one independent value.
    """
    a, w, s = points.amplitude, points.omega, points.omega_sd
    edges = np.linspace(a.min(), a.max(), min(MOST_BINS, max(2, a.size // 4)) + 1)
    bin_of = np.clip(np.digitize(a, edges) - 1, 0, edges.size - 2)
    of = merged([np.flatnonzero(bin_of == b) for b in np.unique(bin_of)], fewest)
    weights = 1.0 / np.maximum(s, 1e-9 * w.max()) ** 2
    curve_omega = np.array([pooled(w[i], s[i], weights[i], crowding) for i in of])
    curve_damping = np.array([pooled(points.damping[i], points.damping_sd[i], weights[i], crowding) for i in of])
    return Backbone(
        **{item.name: getattr(points, item.name) for item in fields(points)},
        curve_amplitude=np.array([np.average(a[i], weights=weights[i]) for i in of]),
        curve_omega=curve_omega[:, 0],
        curve_omega_sd=curve_omega[:, 1],
        curve_damping=curve_damping[:, 0],
        curve_damping_sd=curve_damping[:, 1],
        offset=offset,
        definition=definition,
        settings=settings,
        notes=tuple(notes),
    )


def merged(bins: list[NDArray[np.intp]], fewest: int) -> list[NDArray[np.intp]]:
    """Join each bin with too few points to the next, the last to the one before.

    >>> [part.tolist() for part in merged([np.array([0, 1]), np.array([2]), np.array([3, 4]), np.array([5])], 2)]
    [[0, 1], [2, 3, 4, 5]]
    """
    found: list[NDArray[np.intp]] = []
    open_bin = np.zeros(0, dtype=np.intp)
    for part in bins:
        open_bin = np.concatenate([open_bin, part])
        if open_bin.size >= fewest:
            found.append(open_bin)
            open_bin = open_bin[:0]
    if open_bin.size and found:
        return [*found[:-1], np.concatenate([found[-1], open_bin])]
    return found or [open_bin]


def pooled(values: Array, deviations: Array, weights: Array, crowding: float) -> tuple[float, float]:
    """Weighted mean and its standard deviation, when ``crowding`` neighbouring values share one window.

    >>> pooled(np.ones(2), np.array([0.1, 0.1]), np.ones(2), 2.0)
    (1.0, 0.1)
    """
    share = weights / weights.sum()
    mean = float((share * values).sum())
    independent = max(1.0, values.size / crowding)
    variance = float((share * (deviations**2 + (values - mean) ** 2)).sum())
    return mean, float(np.sqrt(variance / independent))
