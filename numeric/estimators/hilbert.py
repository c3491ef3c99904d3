"""Instantaneous frequency as the phase derivative of a band-limited analytic signal."""

from __future__ import annotations

import math

import numpy as np
from scipy import fft

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.signal.samples import TWO_PI

TAPER = 0.1
"""Share of the band over which each edge falls off as a raised cosine."""


def band_mask(omega: Array, low: float, high: float) -> Array:
    """1 inside the band, 0 outside, with raised-cosine edges inside it."""
    edge = TAPER * (high - low)
    rise = np.clip((omega - low) / edge, 0.0, 1.0)
    fall = np.clip((high - omega) / edge, 0.0, 1.0)
    return np.asarray((np.sin(0.5 * math.pi * rise) * np.sin(0.5 * math.pi * fall)) ** 2, dtype=np.float64)


# omega = d arg z / dt = Im(z' / z), with z' taken spectrally: no unwrapping and no difference quotient.
def band_frequency(x: Array, rate: float, low: float, high: float) -> Array:
    """Return omega(t) of the analytic signal of real ``x`` limited to ``low .. high`` (rad per time unit).

    Harmonics inside the band, and the record's ends (the DFT takes it as one period), ripple the result.

    >>> t = np.arange(320) / 32.0
    >>> omega = band_frequency(np.cos(2 * np.pi * 1.5 * t), 32.0, 6.0, 13.0)
    >>> bool(np.abs(omega / (2 * np.pi) - 1.5).max() < 1e-12)
    True
    """
    size = x.size
    bins = TWO_PI * rate * fft.fftfreq(size)
    spectrum = 2.0 * fft.fft(x) * band_mask(bins, low, high)
    z, slope = fft.ifft(spectrum), fft.ifft(1j * bins * spectrum)
    return np.asarray((slope * z.conj()).imag / np.maximum(np.abs(z) ** 2, np.finfo(float).tiny), dtype=np.float64)
