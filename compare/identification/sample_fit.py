"""The best class over the samples themselves, and what the spectrum of the residual says of what it leaves.

A residual without a line is told from one with a line by Fisher's test: of m ordinates I_j of the periodogram of white
noise, the largest one's share g = max I / sum I exceeds x with a probability of at most m (1 - x)^(m - 1) (R. A.
Fisher, Proc. R. Soc. A 125 (1929) 54).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ridgeback.common.show.brief import Brief
from ridgeback.numeric.arrays import Array, freeze
from ridgeback.numeric.late import signal

RARE = 0.01
"""Probability of so high a line in white noise below which it is called one."""
SEGMENTS = 4
"""Segments of the record, half overlapping with each other, over which a spectrum is averaged, about."""
TOP = 8.5
"""Highest multiple of the fundamental that a spectrum shows."""
NEAR = 0.1
"""Distance from a whole multiple of the fundamental, in fundamentals, within which a line is called by it."""


@dataclass(frozen=True, repr=False)
class SampleFit(Brief):
    """Samples, the model of the best class, and levels of their spectra; arrays of shape (N,) over ``time``."""

    time: Array
    samples: Array
    model: Array
    omega: Array
    """Angular frequencies of the spectra, shape (M,), rad per time unit."""
    samples_level: Array
    """dB of the highest level of the samples' spectrum, shape (M,)."""
    residual_level: Array
    """The same of samples less model, against the same level."""
    fundamental: float
    """The typical omega0, rad per time unit."""
    line: float | None
    """Where the residual has a line that white noise would not show, rad per time unit; None without one."""
    share: float
    """Of the residual's power, that of its highest ordinate."""

    def __post_init__(self) -> None:
        freeze(self)

    @property
    def multiple(self) -> int | None:
        """The multiple of the fundamental that the line is near, 0 for a drift; None elsewhere."""
        if self.line is None:
            return None
        ratio = self.line / self.fundamental
        return round(ratio) if abs(ratio - round(ratio)) < NEAR else None


def sample_fit(time: Array, samples: Array, model: Array, rate: float, fundamental: float) -> SampleFit:
    """Put a fitted model beside its samples.

    Parameters
    ----------
    time, samples, model
        Shape (N,).
    rate
        Samples per time unit.
    fundamental
        A typical frequency of the motion, rad per time unit.

    Examples
    --------
    >>> t = np.arange(640) / 32.0
    >>> noise = 0.01 * np.random.default_rng(1).normal(size=640)
    >>> x = np.cos(6.0 * t)
    >>> sample_fit(t, x + noise, x, 32.0, 6.0).line is None
    True
    >>> sample_fit(t, x + noise + 0.01 * np.cos(12.0 * t), x, 32.0, 6.0).multiple
    2
    """
    residual = samples - model
    omega, of_samples = spectrum(samples, rate)
    _, of_residual = spectrum(residual, rate)
    kept = omega <= TOP * fundamental
    top = max(float(of_samples.max()), np.finfo(float).tiny)
    line, share = strongest_line(residual, rate)
    return SampleFit(
        time,
        samples,
        model,
        omega[kept],
        level(of_samples[kept], top),
        level(of_residual[kept], top),
        fundamental,
        line,
        share,
    )


def spectrum(x: Array, rate: float) -> tuple[Array, Array]:
    """Welch's spectrum under a Hann window, and its angular frequencies."""
    length = max(16, 2 * x.size // (SEGMENTS + 1))
    frequency, power = signal.welch(x - x.mean(), rate, "hann", min(length, x.size), detrend="constant")
    return np.asarray(2 * np.pi * frequency), np.asarray(power, dtype=float)


def level(power: Array, top: float) -> Array:
    """Decibels of ``top``."""
    return np.asarray(10 * np.log10(np.maximum(power, np.finfo(float).tiny) / top))


def strongest_line(residual: Array, rate: float) -> tuple[float | None, float]:
    """The angular frequency of the highest ordinate where it is no accident of white noise, and its share."""
    power = np.abs(np.fft.rfft(residual - residual.mean()))[1:-1] ** 2
    total = float(power.sum())
    if power.size < 2 or not total > 0:
        return None, 0.0
    at = int(np.argmax(power))
    share = float(power[at] / total)
    chance = power.size * (1.0 - share) ** (power.size - 1)
    return (2 * np.pi * rate * (at + 1) / residual.size if chance < RARE else None), share
