"""Tracks from the signal's phase itself: Hilbert, zero crossings, harmonic least squares."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import make_interp_spline

from numeric.curvature import reestimated_bias, smooth_fit
from numeric.harmonic_fit import HarmonicFit, Shape, choose_multiples, harmonic_fit
from numeric.hilbert import band_frequency
from numeric.request import FEWEST_VALID, Request, need
from numeric.samples import TWO_PI, Array, ComplexArray
from numeric.track import Track
from numeric.zero_crossing import full_cycles

POINTS_PER_CYCLE = 16
"""Windows of harmonic least squares per fastest cycle; a window spans several cycles, so nothing changes faster."""


# Phase noise through the band: var = (2 sigma^2 / A^2) / (2 pi rate) * integral over the band of (omega - omega0)^2.
def by_hilbert(request: Request) -> Track:
    """Phase derivative of the analytic signal limited to the band."""
    low, high = request.corridor.limits
    omega = band_frequency(request.x, request.rate, low, high)
    valid = request.away_from_border(2.0 * request.cycle)
    need(valid, "hilbert", 2.0 * request.cycle)
    level = request.level(np.clip(omega, request.corridor.low, request.corridor.high), valid)
    centre = np.clip(omega, low, high)
    spread = ((high - centre) ** 3 + (centre - low) ** 3) / (3.0 * TWO_PI * request.rate)
    deviation = np.sqrt(2.0 * spread) * level.noise / level.amplitude
    return Track(request.time, omega, valid, "hilbert", deviation, None, request.settings(noise=level.noise))


# The mean of omega over a cycle differs from its middle value by omega'' T^2 / 24.
def by_zero_crossing(request: Request) -> Track:
    """Full cycles between zero crossings; one value per half cycle, at the middle of its cycle."""
    everywhere = np.ones(request.x.size, dtype=np.bool_)
    level = request.level(request.corridor.guide, everywhere)
    smallest = float(level.amplitude.min())
    hysteresis = min(max(3.0 * level.noise, 0.02 * smallest), 0.5 * smallest)
    since, omega, deviation = full_cycles(request.x, request.rate, hysteresis=hysteresis, noise=level.noise)
    time, valid = request.start + since, np.ones(since.size, dtype=np.bool_)
    bias = None
    if request.bias and time.size >= FEWEST_VALID:
        fit = smooth_fit(time, omega, valid, 2.0 * request.cycle)
        bias = fit.deriv(2)(time) * (TWO_PI / omega) ** 2 / 24.0
    settings = request.settings(noise=level.noise, hysteresis=hysteresis, bias_by="curvature over the cycle")
    return Track(time, omega, valid, "zero-crossing", deviation, bias, settings)


def by_harmonic_least_squares(request: Request) -> Track:
    """Phase polynomial with harmonics, fitted locally, at POINTS_PER_CYCLE points and interpolated to the samples."""
    x, rate, guide, half = request.x, request.rate, request.corridor.guide, request.half
    if request.harmonics is None:
        shape = Shape(choose_multiples(x, rate, guide, half=half))
    else:
        shape = Shape(tuple(range(2, request.harmonics + 1)))
    step = max(1, int(TWO_PI * rate / (guide.max() * POINTS_PER_CYCLE)))
    centres = np.union1d(np.arange(0, x.size, step), [x.size - 1])
    fit = harmonic_fit(x, rate, guide, half=half, shape=shape, start_time=request.start, centres=centres)
    omega = spread(fit, fit.omega, request.time)
    valid = np.interp(request.time, fit.time, fit.valid) == 1.0
    need(valid, "harmonic-least-squares", 0.5 * request.lag_seconds)

    def again(z: ComplexArray) -> Array:
        plain = harmonic_fit(z.real, rate, omega, half=half, shape=Shape(), centres=centres)
        return spread(plain, plain.omega, request.time - request.start)

    bias = None
    if request.bias:
        bias = reestimated_bias(request.time, omega, valid, resolution=fit.window_seconds, estimator=again)
    settings = request.settings(
        noise=float(np.median(fit.noise[fit.valid])),
        harmonics=(1, *shape.multiples),
        lag_seconds=fit.window_seconds,
        step=step,
        one_sided_borders=True,
        bias_by="estimating again on the fitted chirp",
    )
    deviation = np.interp(request.time, fit.time, fit.standard_deviation)
    return Track(request.time, omega, valid, "harmonic-least-squares", deviation, bias, settings)


def spread(fit: HarmonicFit, values: Array, time: Array) -> Array:
    """Cubic interpolation of a fit's values to the samples."""
    return np.asarray(make_interp_spline(fit.time, values, k=3)(time), dtype=np.float64)
