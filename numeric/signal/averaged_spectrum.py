"""The power spectrum of a record averaged over its stretches."""

from __future__ import annotations

import numpy as np
from scipy import fft

from ridgeback.numeric.arrays import Array


# P. D. Welch, IEEE Trans. Audio Electroacoust. 15 (1967) 70-73
def averaged_spectrum(x: Array, rate: float, length: int) -> tuple[Array, Array]:
    """Frequencies and one-sided power density by Welch's method: stretches that overlap by half, under a Hann window.

    Parameters
    ----------
    x : array of float, shape (N,)
        The samples.
    rate : float
        Samples per time unit.
    length : int
        Samples of a stretch, N at most; each is taken less its mean.

    Returns
    -------
    frequency : array of float
        Cycles per time unit, from 0 to half the rate.
    power : array of float
        Mean square of the samples per unit of frequency.

    Examples
    --------
    >>> x = np.random.default_rng(1).normal(size=4096)
    >>> frequency, power = averaged_spectrum(x, 10.0, 256)
    >>> float(frequency[-1]), round(float(power.sum() * frequency[1]), 1)
    (5.0, 1.0)
    """
    hann = 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(length) / length)
    step = length - length // 2
    parts = np.lib.stride_tricks.sliding_window_view(x, length)[::step]
    spectra = np.abs(fft.rfft((parts - parts.mean(axis=1, keepdims=True)) * hann, axis=1)) ** 2
    power = spectra.mean(axis=0) / (rate * (hann**2).sum())
    power[1 : (length + 1) // 2] *= 2.0  # of both signs of the frequency; at 0 and half the rate there is one
    return np.asarray(fft.rfftfreq(length, 1.0 / rate), dtype=np.float64), np.asarray(power, dtype=np.float64)
