"""The track from the peak of the polynomial Wigner distribution of the fundamental alone."""

from __future__ import annotations

from dataclasses import replace

from ridgeback.numeric.arrays import ComplexArray
from ridgeback.numeric.distributions.polynomial_wigner import (
    PolynomialKernel,
    half_lags,
    polynomial_deviation,
    polynomial_kernel,
)
from ridgeback.numeric.estimators.peak import following, peak_estimate, windowed
from ridgeback.numeric.signal.analytic import analytic_of
from ridgeback.numeric.signal.windows import window
from ridgeback.numeric.tracking.request import Request
from ridgeback.numeric.tracking.track import Track


def by_polynomial_wigner(request: Request) -> Track:
    """Peak of the polynomial Wigner distribution after the harmonics have been taken out.

    A product of six factors multiplies harmonics into cross terms on the fundamental, so they are removed first, as
    the model of the whole signal has them.
    """
    model = request.models.fine
    alone = request.signal.x - model.samples(keep=lambda h: h != 1)
    M = half_lags(request.plan.lag_seconds, request.signal.rate, request.options.order, request.signal.x.size)
    h = window(request.options.lag_window, M)[M:]

    def make(z: ComplexArray) -> PolynomialKernel:
        return polynomial_kernel(
            z,
            request.signal.rate,
            lag_seconds=request.plan.lag_seconds,
            order=request.options.order,
            lag_window=request.options.lag_window,
        )

    return peak_estimate(
        replace(request, signal=replace(request.signal, z=analytic_of(alone))),
        "polynomial-wigner",
        following(request, make),
        bins=4 * M + 2,
        border=0.5 * request.plan.lag_seconds,
        deviation=lambda level: polynomial_deviation(level, request.signal.rate, h, request.options.order),
        used=replace(windowed(request), order=request.options.order),
        lag_window=request.options.lag_window,
        harmonics_removed=model.multiples,
    )
