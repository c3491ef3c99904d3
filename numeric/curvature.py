"""The bias that a curved omega(t) gives to a Wigner peak, by formula and by estimating again on a fitted chirp."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.polynomial import Chebyshev

from numeric.lag_kernel import LagKernel
from numeric.samples import Array, ComplexArray, Mask

MAX_DEGREE = 14


# phi(t + tau/2) - phi(t - tau/2) = phi' tau + phi''' tau^3 / 24 + ..., so the peak of the column over tau sits at
# phi' + phi''' <w tau^4> / (24 <w tau^2>), with <.> the sum over the lags under the lag window w (theory: Taylor in
# the small angle; Stankovic and Katkovnik, IEEE Trans. Signal Process. 46 (1998) 2315).
def curvature_coefficient(kernel: LagKernel) -> float:
    """Return <w tau^4> / (24 <w tau^2>) of a kernel's lag window: the bias per phi''' = omega''.

    >>> from numeric.wigner import wigner_kernel
    >>> kernel = wigner_kernel(np.ones(101), 10.0, lag_seconds=4.0, lag_window="rectangular")
    >>> round(curvature_coefficient(kernel), 4)  # 0.6 * tau_max^2 / 24 with tau_max = 4, and a little for sampling
    0.4197
    """
    tau, w = kernel.lags, kernel.lag_window
    return float((w * tau**4).sum() / (24.0 * (w * tau**2).sum()))


def smooth_fit(time: Array, omega: Array, keep: Mask, resolution: float) -> Chebyshev:
    """Least-squares Chebyshev series through the kept part of a track.

    The degree is the smallest that minimises the Bayesian information criterion when one independent value per half
    ``resolution`` (the estimator's window in time units) is counted; at most one degree per such value.
    """
    t, w = time[keep], omega[keep]
    independent = max(4.0, 2.0 * (t[-1] - t[0]) / resolution)
    domain = [float(t[0]), float(t[-1])]
    top = min(MAX_DEGREE, int(independent) - 2)
    fits = [Chebyshev.fit(t, w, degree, domain=domain) for degree in range(top + 1)]
    floor = (1e-12 * np.abs(w).max()) ** 2
    scores = [
        independent * np.log(np.mean((fit(t) - w) ** 2) + floor) + (degree + 1) * np.log(independent)
        for degree, fit in enumerate(fits)
    ]
    return fits[int(np.argmin(scores))]


def chirp(fit: Chebyshev, time: Array) -> ComplexArray:
    """Return exp(i phi(t)) with phi the integral of a fitted omega(t)."""
    return np.asarray(np.exp(1j * fit.integ(lbnd=fit.domain[0])(time)), dtype=np.complex128)


def reestimated_bias(
    time: Array,
    omega: Array,
    keep: Mask,
    *,
    resolution: float,
    estimator: Callable[[ComplexArray], Array],
    rounds: int = 2,
) -> Array:
    """Bias of a track: estimate again on the noise-free chirp fitted to it, and take the difference.

    The fit is then corrected by the bias it showed and the step repeated, ``rounds`` times in all.  The whole phase
    enters, not only its third derivative.  Outside ``keep`` the nearest kept value is held.
    """
    bias = np.zeros_like(omega)
    for _ in range(rounds):
        fit = smooth_fit(time, omega - bias, keep, resolution)
        bias = held(time, estimator(chirp(fit, time)) - fit(time), keep)
    return bias


def formula_bias(time: Array, omega: Array, keep: Mask, *, kernel: LagKernel) -> Array:
    """Bias phi''' <w tau^4> / (24 <w tau^2>) of a pseudo-Wigner track, phi''' from the smooth fit of the track itself.

    Outside ``keep`` the nearest kept value is held.
    """
    fit = smooth_fit(time, omega, keep, float(kernel.lags[-1]))
    return held(time, curvature_coefficient(kernel) * fit.deriv(2)(time), keep)


def held(time: Array, values: Array, keep: Mask) -> Array:
    """Values where ``keep``, the nearest kept value before and after."""
    return np.asarray(np.interp(time, time[keep], values[keep]), dtype=np.float64)
