"""Where to look for the fundamental: a corridor around the strongest component, found from the data.

The corridor follows the ridge of a spectrogram some six cycles long and keeps a factor away from it on both sides,
so that the constant, the second and the third harmonic stay outside even when omega0 itself moves by more than that.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import fft
from scipy.ndimage import gaussian_filter1d

from numeric.errors import InputError
from numeric.samples import TWO_PI, Array
from numeric.spectrogram import spectrogram

MARGIN = 1.45
"""Corridor half width as a factor: below 1.5, so that a second harmonic 1.45 times off its corridor stays out."""
GUIDE_CYCLES = 6.0
FEWEST_CYCLES = 3.0


@dataclass(frozen=True)
class Corridor:
    """Band limits per sample (rad per time unit), the guide between them, and how they were found."""

    low: Array
    high: Array
    guide: Array
    why: str

    @property
    def limits(self) -> tuple[float, float]:
        """The lowest low and the highest high."""
        return float(self.low.min()), float(self.high.max())


def strongest_frequency(x: Array, rate: float) -> float:
    """Angular frequency of the highest line of the Hann-windowed spectrum, the constant and slow drift left out.

    >>> t = np.arange(320) / 32.0
    >>> round(strongest_frequency(np.cos(2 * np.pi * 1.5 * t), rate=32.0) / (2 * np.pi), 2)
    1.5
    """
    size = x.size
    padded = 4 * size
    spectrum = np.abs(fft.rfft((x - x.mean()) * np.hanning(size), padded)) ** 2
    lowest = math.ceil(FEWEST_CYCLES * padded / size)
    if lowest >= spectrum.size - 1 or not np.any(spectrum[lowest:] > 0.0):
        raise InputError(
            f"signal of {size} samples shows no oscillation of {FEWEST_CYCLES:g} cycles or more; give a longer record"
        )
    return TWO_PI * rate * (lowest + int(spectrum[lowest:].argmax())) / padded


def continuous_path(level: Array, reach: int) -> NDArray[np.intp]:
    """Row indices of the path through ``level[row, column]`` with the largest sum, moving at most ``reach`` a column.

    >>> continuous_path(np.array([[9.0, 0, 0], [0, 9, 0], [0, 0, 9]]), reach=1).tolist()
    [0, 1, 2]
    """
    rows, columns = level.shape
    best, came = level[:, 0].copy(), np.zeros((rows, columns), dtype=np.intp)
    for column in range(1, columns):
        padded = np.pad(best, reach, constant_values=-np.inf)
        choices = np.lib.stride_tricks.sliding_window_view(padded, 2 * reach + 1)
        pick = choices.argmax(axis=1)
        came[:, column] = np.arange(rows) + pick - reach
        best = choices[np.arange(rows), pick] + level[:, column]
    path = np.empty(columns, dtype=np.intp)
    path[-1] = best.argmax()
    for column in range(columns - 1, 0, -1):
        path[column - 1] = came[path[column], column]
    return path


def find_corridor(x: Array, rate: float) -> Corridor:
    """Return the corridor around the strongest component of the real signal ``x``."""
    centre = strongest_frequency(x, rate)
    seconds = min(GUIDE_CYCLES * TWO_PI / centre, (x.size - 1) / rate * 0.999)
    hop = max(1, round(0.25 * TWO_PI / centre * rate))
    plane = spectrogram(x, rate, window_seconds=seconds, hop=hop, n_fft=fft.next_fast_len(int(8 * seconds * rate)))
    rows = (plane.omega >= 0.25 * centre) & (plane.omega <= 4.0 * centre)
    level = plane.values[rows] / plane.values[rows].max(axis=0)
    path = plane.omega[rows][continuous_path(np.log(level + 1e-6), reach=3)]
    smooth = gaussian_filter1d(path, GUIDE_CYCLES, mode="nearest")
    guide = np.interp(np.arange(x.size) / rate, plane.time, smooth)
    why = f"corridor of a factor {MARGIN} around the strongest component, near {centre / TWO_PI:.4g} cycles per unit"
    nyquist = math.pi * rate
    return Corridor(guide / MARGIN, np.minimum(guide * MARGIN, nyquist), guide, why)


def given_band(band: tuple[float, float], x: Array, rate: float) -> Corridor:
    """Return the corridor of a band given as (low, high) in rad per time unit."""
    low, high = float(band[0]), float(band[1])
    nyquist = math.pi * rate
    if not (math.isfinite(low) and math.isfinite(high) and 0.0 <= low < high <= nyquist * (1 + 1e-12)):
        raise InputError(
            f"band ({low:g}, {high:g}) rad per time unit is not usable; need 0 <= low < high <= {nyquist:.6g} (Nyquist)"
        )
    ones = np.ones(x.size)
    return Corridor(low * ones, high * ones, 0.5 * (low + high) * ones, "band given")
