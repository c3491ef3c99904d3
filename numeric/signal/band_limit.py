"""A signal limited to a band and turned down to its lower edge, so that its lags may be decimated.

The Wigner distribution of a signal whose spectrum lies in [a, b] lies in [a, b] itself, at every time.  One period of
its frequency axis need be no longer than b - a: only every D-th lag is needed, D = floor(pi rate / (b - a)), at every
sample in time all the same.  What lay outside the band, and its cross terms with what lies inside, is gone.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy import fft

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, ComplexArray
from ridgeback.numeric.signal.samples import TWO_PI

SKIRT = 0.25
"""Width of each transition from 1 to 0, as a share of the band."""


@dataclass(frozen=True)
class BandLimited:
    """z times exp(-i origin n / rate) with nothing left outside origin .. origin + pi rate / decimation."""

    signal: ComplexArray
    origin: float
    decimation: int


def pass_band(omega: Array, low: float, high: float) -> Array:
    """1 between ``low`` and ``high``, 0 beyond the skirts, a raised cosine in between (short in time).

    >>> pass_band(np.array([1.0, 1.75, 2.0, 6.0, 7.0]), 2.0, 6.0).round(6).tolist()
    [0.0, 0.853553, 1.0, 1.0, 0.0]
    """
    skirt = SKIRT * (high - low)
    outside = np.maximum(low - omega, omega - high) / skirt
    return np.asarray(0.5 + 0.5 * np.cos(math.pi * np.clip(outside, 0.0, 1.0)), dtype=np.float64)


def ringing(low: float, high: float) -> float:
    """Time that the ends of a record ring in this filter: one period of the width of its skirts.

    >>> round(ringing(2.0, 6.0), 3)
    6.283
    """
    return TWO_PI / (SKIRT * (high - low))


def band_limited(z: ComplexArray, rate: float, low: float, high: float) -> BandLimited:
    """Limit complex samples to ``low`` .. ``high`` (rad per time unit) by their DFT, taken as one period.

    Raises InputError for a band without width.

    >>> n = np.arange(64)
    >>> two = np.exp(2j * np.pi * 4.0 * n / 32.0) + np.exp(2j * np.pi * 12.0 * n / 32.0)
    >>> limited = band_limited(two, 32.0, 20.0, 30.0)
    >>> limited.decimation
    6
    >>> bool(np.abs(limited.signal - np.exp(1j * (8.0 * np.pi - limited.origin) * n / 32.0)).max() < 1e-12)
    True
    """
    if not (math.isfinite(low) and math.isfinite(high) and low < high):
        raise InputError(f"band ({low:g}, {high:g}) rad per time unit is not usable; need low < high, both finite")
    omega = TWO_PI * rate * fft.fftfreq(z.size)
    origin, end = low - SKIRT * (high - low), high + SKIRT * (high - low)
    alone = fft.ifft(fft.fft(z) * pass_band(omega, low, high))
    down = np.exp(-1j * origin / rate * np.arange(z.size))
    return BandLimited(alone * down, origin, max(1, int(math.pi * rate / (end - origin))))
