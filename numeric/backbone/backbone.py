"""The backbone of a recording: frequency and growth rate against amplitude, with uncertainty."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.ndimage import uniform_filter1d

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.backbone.curve import Backbone, Crowding, Points, Rates, assemble
from ridgeback.numeric.backbone.local_rates import local_rates
from ridgeback.numeric.backbone.model_rates import ModelRates
from ridgeback.numeric.backbone.windows import MOST_POINTS, POINTS_PER_CYCLE
from ridgeback.numeric.estimators.higher_harmonics import carrier
from ridgeback.numeric.harmonics.local_fit import choose_multiples
from ridgeback.numeric.harmonics.signal_model import SignalModels
from ridgeback.numeric.signal.samples import TWO_PI, checked_rate, checked_real_samples
from ridgeback.numeric.signal.windows import half_width
from ridgeback.numeric.tracking.choices import Scope
from ridgeback.numeric.tracking.track import Track

__all__ = ["Backbone", "backbone"]

WINDOW_CYCLES, MOST_SHARE = 4.0, 0.95
MOST_EXCLUDED = 0.75
CLEAR = 5.0
"""A point is used where the amplitude exceeds its own standard deviation this many times."""


def backbone(
    track: Track,
    x: ArrayLike,
    rate: float,
    *,
    start: float | None = None,
    window_seconds: float | None = None,
    exclude: Mask | None = None,
    models: SignalModels | None = None,
) -> Backbone:
    """Measure amplitude and growth rate along a frequency track, and set omega0 against amplitude.

    Amplitude and its logarithmic slope come from local harmonic least squares, started from the track, in windows that
    follow the local rate of change; omega comes from the track itself.

    Parameters
    ----------
    track : Track
        The fundamental's frequency.
    x : array of float, shape (N,)
        The real samples that it is of.
    rate : float
        Samples per time unit.
    start : float, optional
        Time of the first sample; by default as the track noted it.
    window_seconds : float, optional
        Width of the local fits, in time units; by default 3 to 32 cycles, as amplitude and frequency change.
    exclude : array of bool, shape (N,), optional
        Samples that are not to be used (clipped ones): points whose window holds one are left out.
    models : SignalModels, optional
        Models of all of the track's stretch, which give amplitude and growth rate in place of local fits.

    Returns
    -------
    Backbone
        Along time and in bins of amplitude.

    Raises
    ------
    InputError
        When fewer than four points are clear of the noise.

    Examples
    --------
    >>> from ridgeback.numeric.estimators.estimate import estimate
    >>> t = np.arange(1280) / 32.0
    >>> x = 2.0 * np.exp(-0.05 * t) * np.cos(2 * np.pi * 1.25 * t) + 0.7
    >>> curve = backbone(estimate(x, 32.0), x, 32.0)
    >>> bool(np.abs(curve.curve_growth_rate + 0.05).max() < 1e-4), bool(np.abs(curve.omega - 2.5 * np.pi).max() < 1e-3)
    (True, True)
    """
    samples, rate = checked_real_samples(x, what="backbone", at_least=16), checked_rate(rate)
    first = track.start if start is None else start
    if track.used.span is not None:
        keep = stretch_of(track.used.span, samples.size, rate, first)
        samples, first = samples[keep], first + keep.start / rate
        exclude = None if exclude is None else exclude[keep]
    offset = float(samples.mean())
    if models is not None and window_seconds is None and models.fine is not models.coarse:
        measured = along_models(models, track, first, exclude)
    else:
        measured = along_windows(samples - offset, rate, track, first, window_seconds, exclude)
    notes = [*track.used.span_notes(), f"The mean of the samples, {offset:.4g}, was removed.", *measured.notes]
    return assemble(
        measured.points,
        crowding=measured.crowding,
        offset=offset,
        settings={"track": track.method, "harmonics": measured.harmonics},
        notes=notes,
        window_seconds=measured.window_seconds,
        local=measured.rates,
    )


@dataclass(frozen=True)
class Measured:
    """Points along time, and how the errors of neighbours belong together."""

    points: Points
    rates: Rates
    crowding: Crowding
    harmonics: tuple[int, ...]
    notes: list[str]
    window_seconds: float


def along_models(models: SignalModels, track: Track, first: float, exclude: Mask | None) -> Measured:
    """Amplitude and growth rate by models of all of the stretch, and omega too where the track is such a model's.

    A point is used where at most MOST_EXCLUDED of the cycle round it are samples that are not.
    """
    fine = models.fine
    cycle = TWO_PI / float(np.median(fine.omega))
    step = max(1, round(cycle / POINTS_PER_CYCLE / (fine.time[1] - fine.time[0])), fine.time.size // MOST_POINTS)
    own = track.used.scope is Scope.GLOBAL
    found = ModelRates(models, np.arange(step // 2, fine.time.size, step), own)
    points = found.points(first)
    usable = points.amplitude > CLEAR * points.amplitude_sd
    if not own:
        base, total = (
            carrier(track, fine.time.size, 1.0 / float(fine.time[1] - fine.time[0]), first),
            total_deviation(track),
        )
        usable &= base.valid[found.index] | track.used.one_sided_borders
        sd = points.omega_sd if total is None else np.interp(points.time, track.time, total)
        points = replace(points, omega=base.omega[found.index], omega_sd=sd)
    clean = np.ones_like(usable)
    if exclude is not None:
        around = max(1, round(cycle / float(fine.time[1] - fine.time[0])))
        clean = (uniform_filter1d(exclude.astype(float), around, mode="nearest") <= MOST_EXCLUDED)[found.index]
    usable &= clean
    check_enough(usable, clean)
    knot = fine.cycles * cycle
    window = max(1.0, knot / (step * float(fine.time[1] - fine.time[0])))
    return Measured(
        points.at(usable),
        found.at(usable),
        Crowding(amplitude=window, omega=max(window, resolution(track, cycle) / knot * window)),
        (1, *fine.multiples),
        left_out_notes(usable, clean),
        knot,
    )


def along_windows(
    real: Array, rate: float, track: Track, first: float, window_seconds: float | None, exclude: Mask | None
) -> Measured:
    """Amplitude and growth rate by local fits, in windows that follow the local rate of change unless one is given."""
    base = carrier(track, real.size, rate, first)
    cycle = TWO_PI / float(np.median(base.omega[base.valid]))
    longest = MOST_SHARE * (real.size - 1) / rate
    seconds = min(WINDOW_CYCLES * cycle, longest) if window_seconds is None else window_seconds
    half = half_width(seconds, rate, name="window_seconds", longest=real.size)
    multiples = choose_multiples(real, rate, base.omega, half=half)
    fixed, unclipped = window_seconds is not None, np.ones(real.size, dtype=np.bool_) if exclude is None else ~exclude
    found = local_rates(real, rate, base.omega, multiples, half=half, start=first, fixed=fixed, clean=unclipped)
    fit, centres = found.fine, found.centre
    seen = fit.settled if track.used.one_sided_borders else fit.settled & base.valid[centres]
    clean = ~touched(found.begin, found.half, exclude)
    usable = seen & clean & (fit.amplitude > CLEAR * fit.amplitude_sd)
    check_enough(usable, clean)
    omega = base.omega[centres]
    total = total_deviation(track)
    omega_sd = fit.standard_deviation if total is None else np.interp(fit.time, track.time, total)
    points = Points(fit.time, fit.amplitude, fit.amplitude_sd, omega, omega_sd, fit.growth, fit.growth_sd).at(usable)
    spacing, width = float(np.median(np.diff(fit.time))), 2.0 * float(np.median(found.half[usable])) / rate
    window = max(1.0, width / spacing)
    crowding = Crowding(amplitude=window, omega=max(window, resolution(track, cycle) / spacing))
    return Measured(points, found.at(usable), crowding, (1, *multiples), left_out_notes(usable, clean), width)


def stretch_of(span: tuple[float, float], size: int, rate: float, start: float) -> slice:
    """The samples of a record from one time to another, both included.

    >>> stretch_of((1.5, 2.0), 100, 10.0, 1.0)
    slice(5, 11, None)
    """
    first, last = (round((time - start) * rate) for time in span)
    return slice(max(0, first), min(size, last + 1))


def check_enough(usable: Mask, clean: Mask) -> None:
    """Refuse a backbone of fewer than four points."""
    if np.count_nonzero(usable) < 4:
        raise InputError(
            f"backbone: {np.count_nonzero(usable)} points are clear of the noise"
            f"{'' if clean.all() else ' and of clipped or stuck samples'}; give a longer or less noisy record"
        )


def resolution(track: Track, cycle: float) -> float:
    """The time over which the values of a track share their error: its window, or a knot's reach of a global model."""
    return max(track.used.lag_seconds or 0.0, (track.used.cycles_per_knot or 0.0) * cycle)


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
    left = np.zeros_like(track.omega) if track.bias is None or track.bias_removed else track.bias
    unsure = np.zeros_like(track.omega) if track.bias_deviation is None else track.bias_deviation
    return np.asarray(np.sqrt(track.standard_deviation**2 + left**2 + unsure**2))


def touched(begin: NDArray[np.intp], half: NDArray[np.intp], exclude: Mask | None) -> Mask:
    """Which windows, of 2 ``half`` + 1 samples from ``begin`` on, hold an excluded sample.

    >>> touched(np.array([0, 3, 6]), np.array([1, 1, 1]), np.arange(9) == 6).tolist()
    [False, False, True]
    """
    if exclude is None:
        return np.zeros(begin.size, dtype=np.bool_)
    before = np.concatenate([[0], np.cumsum(exclude)])
    return np.asarray(before[begin + 2 * half + 1] > before[begin])


def left_out_notes(usable: Mask, clean: Mask) -> list[str]:
    """How many points were left out, and why."""
    notes, unclear = [], int(np.count_nonzero(clean & ~usable))
    if unclear:
        notes.append(
            f"{unclear} of {usable.size} points lie near a border or are not {CLEAR:g} times above noise; left out."
        )
    if not clean.all():
        notes.append(
            f"{np.count_nonzero(~clean)} of {usable.size} points have clipped or stuck samples in their window; "
            "left out."
        )
    return notes
