"""Tracks from the signal's phase itself: Hilbert, zero crossings, harmonic least squares."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.interpolate import make_interp_spline

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.estimators.hilbert import band_frequency
from ridgeback.numeric.estimators.zero_crossing import dead_zone, full_cycles
from ridgeback.numeric.harmonics.local_fit import HarmonicFit, choose_multiples, harmonic_fit
from ridgeback.numeric.harmonics.window_steps import PHASE_DEGREE, Shape
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.tracking.choices import Scope
from ridgeback.numeric.tracking.request import Request, check_valid
from ridgeback.numeric.tracking.track import Track

POINTS = 32
"""Fits of harmonic least squares per length of the window: nothing in them changes faster."""
POINTS_IN_TRIALS = 12
"""The same in trials, which are to show deviations of a tenth, not digits."""


# Phase noise through the band: var = (2 sigma^2 / A^2) / (2 pi rate) * integral over the band of (omega - omega0)^2.
def by_hilbert(request: Request) -> Track:
    """Phase derivative of the analytic signal limited to the band."""
    low, high = request.signal.search.limits
    omega = band_frequency(request.signal.x, request.signal.rate, low, high)
    valid = request.away_from_border(2.0 * request.signal.cycle)
    check_valid(valid, "hilbert", 2.0 * request.signal.cycle, request)
    centre = np.clip(omega, request.signal.search.low, request.signal.search.high)
    spread = ((high - centre) ** 3 + (centre - low) ** 3) / (3.0 * TWO_PI * request.signal.rate)
    deviation = request.deviation(lambda level: np.sqrt(2.0 * spread) * level.noise / level.amplitude, centre, valid)
    return Track(request.signal.time, omega, valid, "hilbert", deviation, None, request.used, request.details())


# The mean of omega over a cycle differs from its middle value by omega'' T^2 / 24: the bias.
def by_zero_crossing(request: Request) -> Track:
    """Full cycles between zero crossings; one value per half cycle, at the middle of its cycle."""
    level = (
        None
        if request.plan.trial
        else request.level(request.signal.search.guide, np.ones(request.signal.x.size, dtype=np.bool_))
    )
    hysteresis = (
        dead_zone(level.noise, float(level.amplitude.min())) if level is not None else request.plan.hysteresis or 0.0
    )
    noise = 0.0 if level is None else level.noise
    since, omega, deviation = full_cycles(request.signal.x, request.signal.rate, hysteresis=hysteresis, noise=noise)
    time, valid = request.signal.start + since, np.ones(since.size, dtype=np.bool_)
    used = replace(request.used, noise=noise, hysteresis=hysteresis)
    return Track(time, omega, valid, "zero-crossing", deviation, None, used, request.details())


def shape_for(request: Request) -> Shape:
    """The harmonics asked for, else those that the data show."""
    degree = PHASE_DEGREE if request.plan.phase_degree is None else request.plan.phase_degree
    if request.plan.multiples is not None:
        multiples = request.plan.multiples
    elif request.options.multiples is not None:
        multiples = request.options.multiples
    else:
        multiples = choose_multiples(
            request.signal.x, request.signal.rate, request.signal.search.guide, half=request.half
        )
    return Shape(multiples, degree, degree - 1)


def by_harmonic_least_squares(request: Request) -> Track:
    """Phase polynomial with harmonics, fitted locally at POINTS points per window and interpolated to the samples."""
    x, rate, guide, half = request.signal.x, request.signal.rate, request.signal.search.guide, request.half
    shape = shape_for(request)
    step = max(1, 2 * half // (POINTS_IN_TRIALS if request.plan.trial else POINTS))
    centres = np.union1d(np.arange(0, x.size, step), [x.size - 1])
    fit = harmonic_fit(x, rate, guide, half=half, shape=shape, start_time=request.signal.start, centres=centres)
    omega = spread(fit, fit.omega, request.signal.time)
    valid = np.interp(request.signal.time, fit.time, fit.valid) == 1.0
    check_valid(valid, "harmonic-least-squares", 0.5 * request.plan.lag_seconds, request)
    used = replace(
        request.used,
        scope=Scope.LOCAL,
        noise=float(np.median(fit.noise[fit.valid])),
        harmonics=(1, *shape.multiples),
        phase_degree=shape.phase_degree,
        lag_seconds=fit.window_seconds,
        one_sided_borders=True,
    )
    deviation = np.interp(request.signal.time, fit.time, fit.standard_deviation)
    return Track(
        request.signal.time, omega, valid, "harmonic-least-squares", deviation, None, used, request.details(step=step)
    )


def spread(fit: HarmonicFit, values: Array, time: Array) -> Array:
    """Cubic interpolation of a fit's values to the samples."""
    return np.asarray(make_interp_spline(fit.time, values, k=3)(time), dtype=np.float64)
