"""Where the energy of a short-time spectrum sits: reassigned times and frequencies.

With S_w(omega, t) = sum over j of z(t + tau_j) w(tau_j) exp(-i omega tau_j), tau_j = j / rate, and w' = dw/dtau,

    t_hat     = t + Re(S_{tau w} / S_w),        omega_hat = omega - Im(S_{w'} / S_w)

(Auger and Flandrin, IEEE Trans. Signal Process. 43 (1995) 1068).  For z = exp(alpha + beta tau + gamma tau^2 / 2) near
t, integration by parts under the windows w and tau w, which end at zero, gives two equations,

    beta S_w       + gamma S_{tau w}   = i omega S_w       - S_{w'}
    beta S_{tau w} + gamma S_{tau^2 w} = i omega S_{tau w} - S_{tau w'} - S_w,

whose Im beta is the frequency at t itself: exact for a linear chirp, at every omega (the second order of Oberlin,
Meignen and Perrier, IEEE Trans. Signal Process. 63 (2015) 1335, without second derivatives).  Sums stand for integrals
here, which leaves an error of the order of (omega - ridge) / half^2; it is odd about the ridge and vanishes there.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ridgeback.numeric.arrays import Array, ComplexArray
from ridgeback.numeric.signal.windows import window, window_slope

NEGLIGIBLE = 1e-12
"""Share of a column's largest |S|^2 (or of a determinant's own products) below which nothing is moved."""


@dataclass(frozen=True)
class WindowFamily:
    """w and the four windows made from it, at j = -half .. half."""

    plain: Array
    slope: Array
    lag: Array
    lag_slope: Array
    lag_square: Array

    @property
    def half(self) -> int:
        """Samples on each side."""
        return self.plain.size // 2

    @property
    def three(self) -> tuple[Array, Array, Array]:
        """What the first order needs: w, w', tau w."""
        return self.plain, self.slope, self.lag

    @property
    def five(self) -> tuple[Array, Array, Array, Array, Array]:
        """What the second order needs: w, w', tau w, tau w', tau^2 w."""
        return self.plain, self.slope, self.lag, self.lag_slope, self.lag_square


def window_family(name: str, half: int, rate: float, *, scale: float = 1.0) -> WindowFamily:
    """Return ``scale`` times a window that ends at zero, with its slope and its moments in time units.

    >>> window_family("hann", 1, 2.0).lag.round(12).tolist()
    [-0.25, 0.0, 0.25]
    """
    slope = scale * window_slope(name, half) * rate
    w, tau = scale * window(name, half), np.arange(-half, half + 1) / rate
    return WindowFamily(w, slope, tau * w, tau * slope, tau * tau * w)


def ratio(above: ComplexArray, below: ComplexArray, floor: float | Array) -> ComplexArray:
    """``above / below`` where ``|below|`` is over ``floor``, else 0."""
    usable = np.abs(below) > floor
    return np.where(usable, above / np.where(usable, below, 1.0), 0.0)


def floor_of(s: ComplexArray) -> Array:
    """|S| below which a bin of its column says nothing."""
    return np.asarray(np.sqrt(NEGLIGIBLE) * np.abs(s).max(axis=1, keepdims=True), dtype=np.float64)


def first_order(omega: Array, s: ComplexArray, s_slope: ComplexArray, s_lag: ComplexArray) -> tuple[Array, Array]:
    """Shift in time and reassigned frequency of short-time spectra, rows by column, at ``omega``."""
    floor = floor_of(s)
    shift = ratio(s_lag, s, floor).real
    return shift, omega - ratio(s_slope, s, floor).imag


def second_order(omega: Array, *spectra: ComplexArray) -> Array:
    """Frequency at the column's own time, from the spectra under :attr:`WindowFamily.five`; first order where singular.

    >>> t = np.arange(-80, 81) / 32.0
    >>> family = window_family("hann", 80, 32.0)
    >>> z = np.exp(1j * (7.0 * t + 0.3 * t**2))
    >>> at = np.array([6.0])
    >>> spectra = [((z * w) @ np.exp(-1j * at[0] * t)).reshape(1, 1) for w in family.five]
    >>> round(float(second_order(at, *spectra)[0, 0]), 4)
    7.0
    """
    s, s_slope, s_lag, s_lag_slope, s_square = spectra
    one = 1j * omega * s - s_slope
    two = 1j * omega * s_lag - s_lag_slope - s
    determinant = s * s_square - s_lag * s_lag
    scale = NEGLIGIBLE**0.5 * (np.abs(s * s_square) + np.abs(s_lag * s_lag)) + np.finfo(float).tiny
    beta = ratio(one * s_square - two * s_lag, determinant, scale)
    plain = first_order(omega, s, s_slope, s_lag)[1]
    return np.asarray(np.where(np.abs(determinant) > scale, beta.imag, plain), dtype=np.float64)
