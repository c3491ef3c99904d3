"""The ridge of a lag kernel: the highest bin of each column, then Newton's method on its spectrum between the bins.

No plane is stored: columns are formed, transformed, searched and dropped in blocks.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.distributions.bin_interpolation import (
    HALF,
    maximum,
    neighbours,
    parabola_vertex,
    slopes_around,
)

AT_ONCE = 1 << 11
"""Columns that are read between the bins at a time."""


class Kernel(Protocol):
    """What gives real spectra by the block, on enough bins to be read between them."""

    @property
    def n_fft(self) -> int:
        """Length of the longest transform."""

    @property
    def origin(self) -> float:
        """Frequency of the first bin, rad per time unit."""

    @property
    def period(self) -> float:
        """Span of one period of the frequency axis, rad per time unit."""

    def searched(self) -> Iterator[tuple[int, int, NDArray[np.floating]]]:
        """All spectra as (start, stop, ``(columns, bins)``), the bins in equal steps over one period from ``origin``.

        Their number, which may change from block to block, is at least OVERSAMPLING times that of the lags.
        """


@dataclass(frozen=True)
class Ridge:
    """Peak frequency (rad per time unit) and height per column; ``inside`` is False where the band edge was highest."""

    omega: Array
    height: Array
    inside: Mask


def highest(values: NDArray[np.floating], spacing: float, low: Array, high: Array) -> NDArray[np.intp]:
    """Highest bin of each row between its ``low`` and ``high``; some bin outside where none lies between.

    >>> highest(np.array([[9.0, 1.0, 2.0, 1.0]]), 1.0, np.ones(1), np.full(1, 3.0)).tolist()
    [2]
    """
    lowest = np.minimum(np.ceil(low / spacing), values.shape[1] - 1).astype(np.intp)
    beyond = np.minimum(np.floor(high / spacing) + 1, values.shape[1]).astype(np.intp)
    first, last = int(lowest.min()), max(int(beyond.max()), int(lowest.min()) + 1)
    within = values[:, first:last]
    edges = np.ptp(lowest), np.ptp(beyond)
    if any(edges):  # only the strips between the lowest and the highest edge need a mask
        within = within.copy()
        bins = np.arange(first, last)
        left, right = within[:, : edges[0]], within[:, within.shape[1] - edges[1] :]
        left[bins[: edges[0]] < lowest[:, None]] = -np.inf
        right[bins[bins.size - edges[1] :] >= beyond[:, None]] = -np.inf
    return np.asarray(within.argmax(axis=1) + first, dtype=np.intp)


@dataclass(frozen=True)
class Peaks:
    """Highest bins of neighbouring columns, not yet read between the bins."""

    part: slice
    spacing: float
    at: NDArray[np.intp]
    around: NDArray[np.floating]
    """Values of the neighbouring bins, ``(columns, 2 HALF + 1)`` or so, the highest in the middle."""


def follow(kernel: Kernel, low: Array, high: Array) -> Ridge:
    """Return the ridge of ``kernel`` between ``low[n]`` and ``high[n]`` (rad per time unit, one value per column)."""
    low, high = low - kernel.origin, high - kernel.origin
    omega, height, inside = np.empty(low.size), np.empty(low.size), np.empty(low.size, dtype=np.bool_)
    waiting: list[Peaks] = []
    for begin, end, values in kernel.searched():
        part, spacing = slice(begin, end), kernel.period / values.shape[1]
        at = highest(values, spacing, low[part], high[part])
        waiting.append(Peaks(part, spacing, at, neighbours(values, at)))
        if end == low.size or end - waiting[0].part.start >= AT_ONCE:
            some = slice(waiting[0].part.start, end)
            omega[some], height[some], inside[some] = between_bins(waiting, low[some], high[some])
            waiting = []
    return Ridge(kernel.origin + omega, height, inside)


def between_bins(peaks: Sequence[Peaks], low: Array, high: Array) -> tuple[Array, Array, Mask]:
    """Frequency of each peak, its height, and whether it is one and lies between ``low`` and ``high``."""
    around = np.concatenate([some.around for some in peaks])
    spacing = np.concatenate([np.full(some.at.size, some.spacing) for some in peaks])
    coarse = spacing * np.concatenate([some.at for some in peaks])
    left, centre, right = around[:, HALF - 1 : HALF + 2].astype(np.float64).T
    inside = (centre >= left) & (centre >= right) & (coarse >= low) & (coarse <= high)
    return coarse + spacing * maximum(slopes_around(around), parabola_vertex(left, centre, right)), centre, inside
