"""Tracks from the peak of a distribution: Wigner, pseudo-Wigner, smoothed pseudo-Wigner, spectrogram."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ridgeback.numeric.arrays import Array, ComplexArray
from ridgeback.numeric.distributions.lag_kernel import LagKernel
from ridgeback.numeric.distributions.ridge import Kernel, Ridge, follow
from ridgeback.numeric.distributions.short_time import ShortTimeKernel
from ridgeback.numeric.distributions.wigner import kernel_of
from ridgeback.numeric.harmonics.noise import Level, full_length_deviation, peak_deviation
from ridgeback.numeric.signal.samples import checked_work
from ridgeback.numeric.signal.windows import window
from ridgeback.numeric.tracking.choices import Choices
from ridgeback.numeric.tracking.request import Request, check_valid
from ridgeback.numeric.tracking.track import Track


def peak_estimate(
    request: Request,
    method: str,
    ridge_of: Callable[[ComplexArray], Ridge],
    *,
    bins: int,
    border: float,
    deviation: Callable[[Level], Array],
    used: Choices,
    **details: object,
) -> Track:
    """A ridge, on ``bins`` bins, with the deviation that weak white noise gives it by formula."""
    time = request.signal.time
    work = 20.0 * time.size * bins * (1.0 + np.log2(bins))
    checked_work(work, f"{method} of {time.size} samples by {bins} bins", "use a windowed method or less signal")
    ridge = ridge_of(request.signal.z)
    valid = ridge.inside & request.away_from_border(border + request.ringing)
    check_valid(valid, method, border + request.ringing, request)
    shown = request.details(band_limited=request.options.band_limited, single=request.options.single, **details)
    sigma = request.deviation(deviation, ridge.omega, valid)
    return Track(time, ridge.omega, valid, method, sigma, None, used, shown)


def following(request: Request, make: Callable[[ComplexArray], Kernel]) -> Callable[[ComplexArray], Ridge]:
    """What follows the ridge of a signal's kernel through the search band."""
    return lambda z: follow(make(z), request.signal.search.low, request.signal.search.high)


def half_lag_window(request: Request) -> Array:
    """h[0..M] at every lag, decimated or not: the band passes what the peak answers to."""
    return window(request.options.lag_window, request.half)[request.half :]


def windowed(request: Request) -> Choices:
    """What a track is made with whose method has a lag window: its width in whole samples."""
    return replace(request.used, lag_seconds=2.0 * request.half / request.signal.rate)


def by_wigner(request: Request) -> Track:
    """Peak of the full-length Wigner distribution; biased by the curvature of omega(t), to all orders."""

    def make(z: ComplexArray) -> LagKernel:
        return kernel_of(z, request.signal.rate, band=request.band, single=request.options.single)

    return peak_estimate(
        request,
        "wigner",
        following(request, make),
        bins=make(request.signal.z).n_fft,
        border=request.signal.cycle,
        deviation=lambda level: full_length_deviation(level, request.signal.rate),
        used=request.used,
    )


def by_windowed_wigner(request: Request, method: str, smoothing_seconds: float | None) -> Track:
    """Peak of a Wigner distribution under a lag window, smoothed along time or not."""

    def make(z: ComplexArray) -> LagKernel:
        return kernel_of(
            z,
            request.signal.rate,
            lag_seconds=request.plan.lag_seconds,
            lag_window=request.options.lag_window,
            smoothing_seconds=smoothing_seconds,
            band=request.band,
            single=request.options.single,
        )

    kernel, used = make(request.signal.z), windowed(request)
    if smoothing_seconds is not None:
        used = replace(used, smoothing_seconds=2.0 * kernel.half_smoothing / request.signal.rate)
    return peak_estimate(
        request,
        method,
        following(request, make),
        bins=kernel.n_fft,
        border=0.5 * (request.plan.lag_seconds + (smoothing_seconds or 0.0)),
        deviation=lambda level: peak_deviation(level, request.signal.rate, half_lag_window(request), kernel.smoothing),
        used=used,
        lag_window=request.options.lag_window,
    )


def by_pseudo_wigner(request: Request) -> Track:
    """Peak of the pseudo-Wigner distribution."""
    return by_windowed_wigner(request, "pseudo-wigner", None)


def by_smoothed_pseudo_wigner(request: Request) -> Track:
    """Peak of the smoothed pseudo-Wigner distribution."""
    return by_windowed_wigner(request, "smoothed-pseudo-wigner", request.plan.smoothing_seconds)


def by_spectrogram(request: Request) -> Track:
    """Peak of the spectrogram of the analytic signal."""
    w = window(request.options.lag_window, request.half)

    def make(z: ComplexArray) -> ShortTimeKernel:
        return ShortTimeKernel(z, request.signal.rate, w)

    return peak_estimate(
        request,
        "spectrogram",
        following(request, make),
        bins=make(request.signal.z).n_fft,
        border=0.5 * request.plan.lag_seconds,
        deviation=lambda level: peak_deviation(level, request.signal.rate, w[request.half :]),
        used=windowed(request),
        lag_window=request.options.lag_window,
    )
