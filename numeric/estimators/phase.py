"""Tracks from the signal's phase itself: Hilbert, zero crossings, harmonic least squares."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import make_interp_spline

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.estimators.hilbert import band_frequency
from ridgeback.numeric.estimators.zero_crossing import full_cycles
from ridgeback.numeric.harmonics.local_fit import PHASE_DEGREE, HarmonicFit, Shape, choose_multiples, harmonic_fit
from ridgeback.numeric.harmonics.noise import Level
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.tracking.request import Request, need
from ridgeback.numeric.tracking.track import Track

POINTS = 32
"""Fits of harmonic least squares per length of the window: nothing in them changes faster."""
POINTS_IN_TRIALS = 12
"""The same in trials, which are to show deviations of a tenth, not digits."""


# Phase noise through the band: var = (2 sigma^2 / A^2) / (2 pi rate) * integral over the band of (omega - omega0)^2.
def by_hilbert(request: Request) -> Track:
    """Phase derivative of the analytic signal limited to the band."""
    low, high = request.corridor.limits
    omega = band_frequency(request.x, request.rate, low, high)
    valid = request.away_from_border(2.0 * request.cycle)
    need(valid, "hilbert", 2.0 * request.cycle, request)
    centre = np.clip(omega, request.corridor.low, request.corridor.high)
    spread = ((high - centre) ** 3 + (centre - low) ** 3) / (3.0 * TWO_PI * request.rate)
    deviation = request.deviation(lambda level: np.sqrt(2.0 * spread) * level.noise / level.amplitude, centre, valid)
    return Track(request.time, omega, valid, "hilbert", deviation, None, request.settings())


# The mean of omega over a cycle differs from its middle value by omega'' T^2 / 24: the bias.
def by_zero_crossing(request: Request) -> Track:
    """Full cycles between zero crossings; one value per half cycle, at the middle of its cycle."""
    level = None if request.bare else request.level(request.corridor.guide, np.ones(request.x.size, dtype=np.bool_))
    hysteresis = dead_zone(level) if level is not None else request.hysteresis or 0.0
    noise = 0.0 if level is None else level.noise
    since, omega, deviation = full_cycles(request.x, request.rate, hysteresis=hysteresis, noise=noise)
    time, valid = request.start + since, np.ones(since.size, dtype=np.bool_)
    settings = request.settings(noise=noise, hysteresis=hysteresis)
    return Track(time, omega, valid, "zero-crossing", deviation, None, settings)


def dead_zone(level: Level) -> float:
    """Three times the noise, within a fiftieth and a half of the smallest amplitude."""
    smallest = float(level.amplitude.min())
    return min(max(3.0 * level.noise, 0.02 * smallest), 0.5 * smallest)


def shape_for(request: Request) -> Shape:
    """The harmonics asked for, else those that the data show."""
    degree = PHASE_DEGREE if request.phase_degree is None else request.phase_degree
    if request.multiples is not None:
        multiples = request.multiples
    elif request.harmonics is not None:
        multiples = tuple(range(2, request.harmonics + 1))
    else:
        multiples = choose_multiples(request.x, request.rate, request.corridor.guide, half=request.half)
    return Shape(multiples, degree, degree - 1)


def by_harmonic_least_squares(request: Request) -> Track:
    """Phase polynomial with harmonics, fitted locally at POINTS points per window and interpolated to the samples."""
    x, rate, guide, half = request.x, request.rate, request.corridor.guide, request.half
    shape = shape_for(request)
    step = max(1, 2 * half // (POINTS_IN_TRIALS if request.bare else POINTS))
    centres = np.union1d(np.arange(0, x.size, step), [x.size - 1])
    fit = harmonic_fit(x, rate, guide, half=half, shape=shape, start_time=request.start, centres=centres)
    omega = spread(fit, fit.omega, request.time)
    valid = np.interp(request.time, fit.time, fit.valid) == 1.0
    need(valid, "harmonic-least-squares", 0.5 * request.lag_seconds, request)
    settings = request.settings(
        scope="local",
        noise=float(np.median(fit.noise[fit.valid])),
        harmonics=(1, *shape.multiples),
        phase_degree=shape.phase_degree,
        lag_seconds=fit.window_seconds,
        step=step,
        one_sided_borders=True,
    )
    deviation = np.interp(request.time, fit.time, fit.standard_deviation)
    return Track(request.time, omega, valid, "harmonic-least-squares", deviation, None, settings)


def spread(fit: HarmonicFit, values: Array, time: Array) -> Array:
    """Cubic interpolation of a fit's values to the samples."""
    return np.asarray(make_interp_spline(fit.time, values, k=3)(time), dtype=np.float64)
