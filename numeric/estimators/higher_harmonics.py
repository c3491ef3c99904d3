"""Tracks of the higher harmonics, by phase-locked filtering, and the raw Wigner peak that must not be used.

The h-th harmonic is brought to rest by turning the signal back by h times the phase of the fundamental,

    c_h(t) = low-pass of 2 x(t) exp(-i h phi_0(t)),     omega_h = h phi_0' + d arg c_h / dt,

and what is left turns slowly, however fast omega_0 changes.  It holds for u and for u' alike.  What the low-pass lets
through of the other harmonics (the fundamental may be thirty times the third) is taken out of the signal first.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import make_interp_spline

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.distributions.ridge import follow
from ridgeback.numeric.distributions.wigner import wigner_kernel
from ridgeback.numeric.harmonics.noise import Level, measure_level, peak_deviation
from ridgeback.numeric.signal.local_line import local_line
from ridgeback.numeric.signal.samples import TWO_PI, checked_rate, checked_real_samples
from ridgeback.numeric.signal.windows import half_width, window
from ridgeback.numeric.tracking.choices import Choices
from ridgeback.numeric.tracking.request import Request
from ridgeback.numeric.tracking.track import Track
from ridgeback.numeric.tracking.uncertainty import Trial, with_interval

CLEANING_ROUNDS = 2
MOST_OTHERS = 7
CLEAR = 4.0
"""A harmonic's frequency counts as valid where its amplitude is this many times its own deviation in the noise."""
FILTER_CYCLES = 4.0
"""Length of the low-pass in cycles of the slowest fundamental: a Blackman window's zeros then keep neighbours out."""


@dataclass(frozen=True)
class Carrier:
    """The fundamental on every sample: omega, its phase, and where its track is valid."""

    omega: Array
    phase: Array
    valid: Mask


def carrier(fundamental: Track, size: int, rate: float, start: float) -> Carrier:
    """Interpolate a track to the samples and integrate it.

    Beyond its valid part omega is held at the nearest valid value, unless the track's border values are one-sided fits.
    """
    inside = fundamental.inside()
    if inside.time.size < 8:
        raise InputError(f"track {fundamental.method} has {inside.time.size} valid values; a carrier needs 8 or more")
    used = fundamental if fundamental.used.one_sided_borders else inside
    time = start + np.arange(size) / rate
    spline = make_interp_spline(used.time, used.omega, k=3)
    omega = spline(np.clip(time, used.time[0], used.time[-1]))
    phase = make_interp_spline(time, omega, k=3).antiderivative()
    covered = (time >= inside.time[0]) & (time <= inside.time[-1])
    return Carrier(omega, phase(time) - phase(time[0]), covered)


def without_others(x: Array, phase: Array, w: Array, rate: float, *, multiple: int, top: int) -> Array:
    """Return x less its harmonics 1 .. top other than ``multiple``, each phase-locked and filtered in turn, twice."""
    parts = np.zeros((top + 1, x.size))
    for _ in range(CLEANING_ROUNDS):
        for h in range(1, top + 1):
            alone = x - parts.sum(axis=0) + parts[h]
            value, _slope = local_line(2.0 * alone * np.exp(-1j * h * phase), w, rate)
            parts[h] = (value * np.exp(1j * h * phase)).real
    parts[multiple if multiple <= top else 0] = 0.0
    return np.asarray(x - parts.sum(axis=0), dtype=np.float64)


def locked(real: Array, rate: float, base: Carrier, w: Array, multiple: int) -> tuple[Array, Array]:
    """Frequency and amplitude of a harmonic of a signal without mean, phase-locked, under the low-pass ``w``."""
    top = min(MOST_OTHERS, max(multiple, int(0.9 * math.pi * rate / base.omega.max())))
    alone = without_others(real, base.phase, w, rate, multiple=multiple, top=top)
    value, slope = local_line(2.0 * alone * np.exp(-1j * multiple * base.phase), w, rate)
    amplitude = np.abs(value)
    drift = (slope * value.conj()).imag / np.maximum(amplitude, np.finfo(float).tiny) ** 2
    return multiple * base.omega + drift, amplitude


def checked_multiple(multiple: int, omega: Array, rate: float) -> None:
    """Refuse a harmonic below the first or beyond the Nyquist frequency."""
    if multiple < 1:
        raise InputError(f"harmonic {multiple} is below 1; the fundamental is harmonic 1")
    top, nyquist = multiple * float(omega.max()), math.pi * rate
    if top >= nyquist:
        raise InputError(
            f"harmonic {multiple} reaches {top / TWO_PI:.4g} cycles per time unit, at or beyond the Nyquist frequency "
            f"{nyquist / TWO_PI:.4g}; use harmonic {max(1, int(nyquist / omega.max() * 0.999))} or less"
        )


def harmonic_track(
    x: ArrayLike,
    rate: float,
    fundamental: Track,
    *,
    multiple: int = 3,
    start: float | None = None,
    filter_seconds: float | None = None,
) -> Track:
    """Track a harmonic of a signal, phase-locked to the track of its fundamental.

    Parameters
    ----------
    x : array of float, shape (N,)
        Real samples, evenly spaced.
    rate : float
        Samples per time unit.
    fundamental : Track
        Track of the fundamental with eight valid values or more.
    multiple : int
        Which harmonic.
    start : float, optional
        Time of the first sample; by default as the track noted it.
    filter_seconds : float, optional
        Full width of the low-pass, in time units: four cycles of the slowest fundamental by default.  It is the
        resolution, and half of it is the border zone.

    Returns
    -------
    Track
        Frequency of the harmonic itself, rad per time unit, at every sample.  A value is not valid where the harmonic
        is not clear of the noise.  No bias and no interval.

    Raises
    ------
    InputError
        When the harmonic lies beyond the Nyquist frequency, or the fundamental has too few valid values.

    Examples
    --------
    >>> from ridgeback.numeric.estimators.estimate import estimate
    >>> t = np.arange(640) / 64.0
    >>> phase = 2 * np.pi * (1.0 * t + 0.02 * t**2)
    >>> x = np.cos(phase) + 0.1 * np.cos(3 * phase)
    >>> third = harmonic_track(x, 64.0, estimate(x, 64.0, method="harmonic-least-squares")).inside()
    >>> bool(np.abs(third.frequency_hz - 3.0 - 0.12 * third.time).max() < 1e-3)
    True
    """
    samples, rate = checked_real_samples(x, what="harmonic_track"), checked_rate(rate)
    real = samples - samples.mean()
    return locked_track(real, rate, fundamental, multiple=multiple, start=start, filter_seconds=filter_seconds)


def locked_track(
    real: Array,
    rate: float,
    fundamental: Track,
    *,
    multiple: int,
    start: float | None = None,
    filter_seconds: float | None = None,
) -> Track:
    """:func:`harmonic_track` of checked samples without their mean."""
    first = fundamental.start if start is None else start
    base = carrier(fundamental, real.size, rate, first)
    checked_multiple(multiple, base.omega, rate)
    seconds = FILTER_CYCLES * TWO_PI / float(base.omega.min()) if filter_seconds is None else filter_seconds
    half = half_width(seconds, rate, name="filter_seconds", longest=real.size)
    w = window("blackman", half)
    omega, amplitude = locked(real, rate, base, w, multiple)
    index = np.arange(real.size)
    valid = base.valid & (index >= half) & (index < real.size - half)
    noise = measure_level(real, rate, base.omega, half=half).noise
    valid &= amplitude > CLEAR * noise * math.sqrt(2.0 * float((w**2).sum())) / float(w.sum())
    deviation = peak_deviation(Level(amplitude, noise), rate, w[half:])
    used = Choices(start=first, multiple=multiple, filter_seconds=2.0 * half / rate, noise=noise)
    details = {
        "fundamental": fundamental.method,
        "amplitude_median": float(np.median(amplitude[valid])) if valid.any() else float(np.median(amplitude)),
    }
    time = first + index / rate
    return Track(time, omega, valid, "phase-locked", deviation, None, used, details)


def harmonic_with_interval(track: Track, request: Request, fundamental: Track) -> Track:
    """The harmonic's track with its bias and its interval; without, and with the reason, where no model holds it.

    The fundamental stays as it is in the trials: what is wrong with it the phase-locked filter finds again.
    """
    multiple, rate, seconds = track.used.multiple, request.signal.rate, track.used.filter_seconds
    base = carrier(fundamental, request.signal.x.size, rate, request.signal.start)
    w = window("blackman", half_width(0.0 if seconds is None else seconds, rate))

    def run(x: Array) -> Array:
        return locked(x - x.mean(), rate, base, w, multiple)[0]

    try:
        models = request.models
        models.fine.tone(multiple)
        models.coarse.tone(multiple)
    except InputError as error:
        return replace(track, no_interval=str(error))
    return with_interval(track, request, Trial(track.time - request.signal.start, run, multiple), models)


def raw_harmonic_peak(
    x: ArrayLike, rate: float, fundamental: Track, *, multiple: int = 3, start: float | None = None, reach: float = 0.2
) -> Track:
    """Highest point of the full Wigner distribution near ``multiple * omega_0`` (a share ``reach`` away at most).

    It is wrong, because the distribution is quadratic: components m and n leave a cross term at (m + n) / 2, so that
    (1, 5) falls exactly on harmonic 3, with the product of two amplitudes that may exceed the square of the third's,
    and oscillates along time at the difference frequency.  To be shown as what goes wrong; use :func:`harmonic_track`.
    """
    samples, rate = checked_real_samples(x, what="raw_harmonic_peak"), checked_rate(rate)
    first = fundamental.start if start is None else start
    base = carrier(fundamental, samples.size, rate, first)
    checked_multiple(multiple, base.omega * (1.0 + reach), rate)
    expected = multiple * base.omega
    ridge = follow(wigner_kernel(samples, rate), (1.0 - reach) * expected, (1.0 + reach) * expected)
    time = first + np.arange(samples.size) / rate
    why = f"cross terms of components m and n with m + n = {2 * multiple} fall on harmonic {multiple}"
    used = Choices(start=first, multiple=multiple, why=why)
    return Track(time, ridge.omega, ridge.inside & base.valid, "raw-wigner-peak", None, None, used, {"reach": reach})
