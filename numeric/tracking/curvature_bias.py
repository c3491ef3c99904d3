"""The bias that a curved omega(t) gives to the peak of a windowed distribution, by formula to leading order.

It predicts errors before a window is chosen, and checks by an independent route the bias that trials on a model of the
signal show (``ridgeback.numeric.tracking.uncertainty``).
"""

from __future__ import annotations

import numpy as np

from ridgeback.numeric.arrays import Array, Mask


# phi(t + tau/2) - phi(t - tau/2) = phi' tau + phi''' tau^3 / 24 + ..., so the peak of the column over tau sits at
# phi' + phi''' <w tau^4> / (24 <w tau^2>), with <.> the sum over the lags under the lag window w (theory: Taylor in
# the small angle; Stankovic and Katkovnik, IEEE Trans. Signal Process. 46 (1998) 2315).
def curvature_coefficient(lags: Array, lag_window: Array) -> float:
    """Return <w tau^4> / (24 <w tau^2>) of the lag window ``w`` at the lags tau >= 0: the bias per phi''' = omega''.

    >>> tau = np.linspace(0.0, 4.0, 101)
    >>> round(curvature_coefficient(tau, np.ones(101)), 3)  # 0.6 * 4^2 / 24, and a little for sampling
    0.404
    """
    return float((lag_window * lags**4).sum() / (24.0 * (lag_window * lags**2).sum()))


def curvature_bias(time: Array, omega: Array, lags: Array, lag_window: Array) -> Array:
    """Bias omega'' <w tau^4> / (24 <w tau^2>) of a pseudo-Wigner peak along a smooth omega(t).

    >>> t = np.linspace(0.0, 10.0, 201)
    >>> bias = curvature_bias(t, 5.0 + 0.01 * t**2, np.linspace(0.0, 4.0, 4001), np.ones(4001))
    >>> round(float(bias[100]), 4)  # 0.02 * 0.4
    0.008
    """
    bend = np.gradient(np.gradient(omega, time), time)
    return np.asarray(curvature_coefficient(lags, lag_window) * bend, dtype=np.float64)


def hold_nearest(time: Array, values: Array, keep: Mask) -> Array:
    """Values where ``keep``, the nearest kept value before and after."""
    return np.asarray(np.interp(time, time[keep], values[keep]), dtype=np.float64)
