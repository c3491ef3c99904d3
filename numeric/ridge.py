"""The ridge of a lag kernel: the highest bin of each column, then Newton on the exact transform of its lags.

No plane is stored: columns are formed, searched and dropped in blocks.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from numeric.samples import Array, ComplexArray, Mask

NEWTON_STEPS = 5
SETTLED = 1e-10
"""Share of a bin below which a step of all columns ends the iteration."""


class Kernel(Protocol):
    """What gives columns by the block, their spectra on the bins ``omega``, and the spectra's exact derivatives."""

    @property
    def n_fft(self) -> int:
        """Length of the transform."""

    @property
    def omega(self) -> Array:
        """The bins."""

    def blocks(self) -> Iterator[tuple[int, int, ComplexArray]]:
        """All columns as (start, stop, columns)."""

    def spectra(self, columns: ComplexArray) -> Array:
        """Real spectra, ``(columns, bins)``."""

    def derivatives(self, columns: ComplexArray, omega: Array) -> tuple[Array, Array]:
        """First and second derivative of each column's spectrum at its own ``omega``, up to a positive factor."""


@dataclass(frozen=True)
class Ridge:
    """Peak frequency (rad per time unit) and height per column; ``inside`` is False where the band edge was highest."""

    omega: Array
    height: Array
    inside: Mask


def parabola_vertex(left: Array, centre: Array, right: Array) -> Array:
    """Offset (in bins, -1/2 .. 1/2) of the vertex through three neighbouring values; 0 where they do not bend down.

    >>> parabola_vertex(np.array([1.0]), np.array([2.0]), np.array([2.0])).tolist()
    [0.5]
    """
    bend = left - 2.0 * centre + right
    safe = np.where(bend < 0.0, bend, -1.0)
    return np.asarray(np.where(bend < 0.0, np.clip(0.5 * (left - right) / safe, -0.5, 0.5), 0.0), dtype=np.float64)


def refine(kernel: Kernel, columns: ComplexArray, omega: Array, reach: float) -> Array:
    """Newton's method for the maximum of the exact transform, kept within ``reach`` of the starting ``omega``."""
    best = omega
    for _ in range(NEWTON_STEPS):
        slope, bend = kernel.derivatives(columns, best)
        concave = bend < 0.0
        step = np.where(concave, -slope / np.where(concave, bend, -1.0), 0.25 * reach * np.sign(slope))
        best = np.clip(best + np.clip(step, -0.5 * reach, 0.5 * reach), omega - reach, omega + reach)
        if np.abs(step).max() < SETTLED * reach:
            break
    return best


def follow(kernel: Kernel, low: Array, high: Array) -> Ridge:
    """Return the ridge of ``kernel`` between ``low[n]`` and ``high[n]`` (rad per time unit, one value per column)."""
    size, bins = low.size, kernel.omega
    omega, height, inside = np.empty(size), np.empty(size), np.empty(size, dtype=np.bool_)
    spacing = bins[1] - bins[0] if bins.size > 1 else 0.0
    first = max(0, int(np.searchsorted(bins, low.min())) - 1)
    last = min(bins.size, int(np.searchsorted(bins, high.max())) + 2)
    bins = bins[first:last]
    for begin, end, columns in kernel.blocks():
        values = kernel.spectra(columns)[:, first:last]
        rows = np.arange(end - begin)
        allowed = (bins >= low[begin:end, None]) & (bins <= high[begin:end, None])
        at = np.where(allowed, values, -np.inf).argmax(axis=1)
        left, centre, right = (values[rows, np.clip(at + d, 0, bins.size - 1)] for d in (-1, 0, 1))
        inside[begin:end] = (centre >= left) & (centre >= right) & allowed[rows, at]
        coarse = bins[at] + spacing * parabola_vertex(left, centre, right)
        omega[begin:end] = refine(kernel, columns, coarse, spacing)
        height[begin:end] = centre
    return Ridge(omega, height, inside)
