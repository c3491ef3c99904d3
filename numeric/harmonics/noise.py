"""How strong the fundamental and the noise are, and what white noise does to a peak track."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.harmonics.local_fit import choose_multiples, harmonic_fit
from ridgeback.numeric.harmonics.window_steps import Shape


@dataclass(frozen=True)
class Level:
    """Fundamental amplitude per sample and the standard deviation of what harmonics do not explain."""

    amplitude: Array
    noise: float


def measure_level(x: Array, rate: float, guide: Array, *, half: int) -> Level:
    """Local harmonic least squares in half-overlapping windows; the noise is the median of the residuals."""
    half = min(half, (x.size - 1) // 2)
    shape = Shape(choose_multiples(x, rate, guide, half=half))
    fit = harmonic_fit(x, rate, guide, half=half, shape=shape, centres=np.arange(half, x.size - half, max(1, half)))
    usable = fit.valid if fit.valid.any() else np.ones_like(fit.valid)
    amplitude = np.interp(np.arange(x.size) / rate, fit.time[usable], np.abs(fit.amplitude[usable]))
    if not amplitude.max() > 0.0:
        raise InputError("signal has no component that follows the track; give a --band around the oscillation")
    return Level(amplitude, float(np.median(fit.noise[usable])))


# At high signal-to-noise ratio the peak over lags m under the window h moves by
#     d omega = rate * sum_m h m eta[n + m] / sum_m h m^2,   var eta = 2 sigma^2 / A^2,
# with eta the phase noise of a real tone of amplitude A in real white noise sigma; time smoothing convolves h m with g.
# The product of the noise with itself adds the factor 1 + 2 sigma^2 / A^2.  The peak of |S|^2 obeys the same formula
# with the spectrogram's window for h.  (Stankovic and Katkovnik 1998; Boashash, Proc. IEEE 80 (1992) 540.)
def peak_deviation(level: Level, rate: float, half_window: Array, smoothing: Array | None = None) -> Array:
    """Standard deviation of a peak track in white noise, rad per time unit, per sample; ``half_window`` is h[0..M]."""
    m = np.arange(-(half_window.size - 1), half_window.size)
    h = np.concatenate([half_window[:0:-1], half_window])
    g = np.ones(1) if smoothing is None else smoothing
    response = np.convolve(g, h * m) / (g.sum() * (h * m * m).sum())
    return float(rate * np.sqrt((response**2).sum())) * phase_noise(level)


def phase_noise(level: Level) -> Array:
    """Standard deviation of eta per sample, with the factor for the product of the noise with itself."""
    variance = 2.0 * level.noise**2 / np.maximum(level.amplitude, np.finfo(float).tiny) ** 2
    return np.asarray(np.sqrt(variance * (1.0 + variance)), dtype=np.float64)


# The same with h = 1 on all lags that the record has, M = min(n, N - 1 - n): sum of m^2 = M (M + 1) (2 M + 1) / 3.
def full_length_deviation(level: Level, rate: float) -> Array:
    """Standard deviation of the peak of the full-length Wigner distribution in white noise, per sample."""
    n = np.arange(level.amplitude.size)
    M = np.maximum(np.minimum(n, n[::-1]), 1)
    return np.asarray(rate * phase_noise(level) / np.sqrt(M * (M + 1) * (2 * M + 1) / 3.0), dtype=np.float64)
