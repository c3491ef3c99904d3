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
from ridgeback.numeric.estimators.peak import following, peak_estimate
from ridgeback.numeric.signal.analytic import as_analytic
from ridgeback.numeric.signal.windows import window
from ridgeback.numeric.tracking.request import Request
from ridgeback.numeric.tracking.track import Track


def by_polynomial_wigner(request: Request) -> Track:
    """Peak of the polynomial Wigner distribution after the harmonics have been taken out.

    A product of six factors multiplies harmonics into cross terms on the fundamental, so they are removed first, as
    the model of the whole signal has them.
    """
    model = request.models.fine
    alone = request.x - model.samples(keep=lambda h: h != 1)
    M = half_lags(request.lag_seconds, request.rate, request.order, request.x.size)
    h = window(request.lag_window, M)[M:]

    def make(z: ComplexArray) -> PolynomialKernel:
        return polynomial_kernel(
            z, request.rate, lag_seconds=request.lag_seconds, order=request.order, lag_window=request.lag_window
        )

    return peak_estimate(
        replace(request, z=as_analytic(alone)),
        "polynomial-wigner",
        following(request, make),
        bins=4 * M + 2,
        border=0.5 * request.lag_seconds,
        deviation=lambda level: polynomial_deviation(level, request.rate, h, request.order),
        lag_seconds=2.0 * request.half / request.rate,
        lag_window=request.lag_window,
        order=request.order,
        harmonics_removed=model.multiples,
    )
