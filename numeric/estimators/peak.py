"""Tracks from the peak of a distribution: Wigner, pseudo-Wigner, smoothed pseudo-Wigner, spectrogram."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ridgeback.numeric.arrays import Array, ComplexArray
from ridgeback.numeric.distributions.lag_kernel import LagKernel
from ridgeback.numeric.distributions.ridge import Kernel, Ridge, follow
from ridgeback.numeric.distributions.short_time import ShortTimeKernel
from ridgeback.numeric.distributions.wigner import wigner_kernel
from ridgeback.numeric.harmonics.noise import Level, full_length_deviation, peak_deviation
from ridgeback.numeric.signal.samples import checked_work
from ridgeback.numeric.signal.windows import window
from ridgeback.numeric.tracking.request import Request, need
from ridgeback.numeric.tracking.track import Track


def peak_estimate(
    request: Request,
    method: str,
    ridge_of: Callable[[ComplexArray], Ridge],
    *,
    bins: int,
    border: float,
    deviation: Callable[[Level], Array],
    **settings: object,
) -> Track:
    """A ridge, on ``bins`` bins, with the deviation that weak white noise gives it by formula."""
    time = request.time
    work = 20.0 * time.size * bins * (1.0 + np.log2(bins))
    checked_work(work, f"{method} of {time.size} samples by {bins} bins", "use a windowed method or less signal")
    ridge = ridge_of(request.z)
    valid = ridge.inside & request.away_from_border(border + request.ringing)
    need(valid, method, border + request.ringing, request)
    how = request.settings(band_limited=request.band_limited, single=request.single, **settings)
    return Track(time, ridge.omega, valid, method, request.deviation(deviation, ridge.omega, valid), None, how)


def following(request: Request, make: Callable[[ComplexArray], Kernel]) -> Callable[[ComplexArray], Ridge]:
    """What follows the ridge of a signal's kernel through the corridor."""
    return lambda z: follow(make(z), request.corridor.low, request.corridor.high)


def half_lag_window(request: Request) -> Array:
    """h[0..M] at every lag, decimated or not: the band passes what the peak answers to."""
    return window(request.lag_window, request.half)[request.half :]


def by_wigner(request: Request) -> Track:
    """Peak of the full-length Wigner distribution; biased by the curvature of omega(t), to all orders."""

    def make(z: ComplexArray) -> LagKernel:
        return wigner_kernel(z, request.rate, band=request.band, single=request.single)

    return peak_estimate(
        request,
        "wigner",
        following(request, make),
        bins=make(request.z).n_fft,
        border=request.cycle,
        deviation=lambda level: full_length_deviation(level, request.rate),
    )


def by_pseudo_wigner(request: Request) -> Track:
    """Peak of the pseudo-Wigner distribution."""

    def make(z: ComplexArray) -> LagKernel:
        return wigner_kernel(
            z,
            request.rate,
            lag_seconds=request.lag_seconds,
            lag_window=request.lag_window,
            band=request.band,
            single=request.single,
        )

    kernel = make(request.z)
    return peak_estimate(
        request,
        "pseudo-wigner",
        following(request, make),
        bins=kernel.n_fft,
        border=0.5 * request.lag_seconds,
        deviation=lambda level: peak_deviation(level, request.rate, half_lag_window(request)),
        lag_seconds=2.0 * request.half / request.rate,
        lag_window=request.lag_window,
    )


def by_smoothed_pseudo_wigner(request: Request) -> Track:
    """Peak of the smoothed pseudo-Wigner distribution."""

    def make(z: ComplexArray) -> LagKernel:
        return wigner_kernel(
            z,
            request.rate,
            lag_seconds=request.lag_seconds,
            lag_window=request.lag_window,
            smoothing_seconds=request.smoothing_seconds,
            band=request.band,
            single=request.single,
        )

    kernel = make(request.z)
    return peak_estimate(
        request,
        "smoothed-pseudo-wigner",
        following(request, make),
        bins=kernel.n_fft,
        border=0.5 * (request.lag_seconds + request.smoothing_seconds),
        deviation=lambda level: peak_deviation(level, request.rate, half_lag_window(request), kernel.smoothing),
        lag_seconds=2.0 * request.half / request.rate,
        lag_window=request.lag_window,
        smoothing_seconds=2.0 * kernel.half_smoothing / request.rate,
    )


def by_spectrogram(request: Request) -> Track:
    """Peak of the spectrogram of the analytic signal."""
    w = window(request.lag_window, request.half)

    def make(z: ComplexArray) -> ShortTimeKernel:
        return ShortTimeKernel(z, request.rate, w)

    return peak_estimate(
        request,
        "spectrogram",
        following(request, make),
        bins=make(request.z).n_fft,
        border=0.5 * request.lag_seconds,
        deviation=lambda level: peak_deviation(level, request.rate, w[request.half :]),
        lag_seconds=2.0 * request.half / request.rate,
        lag_window=request.lag_window,
    )
