"""A grid of errors as a map: six bands, drawn as run-length rectangles, with staircase outlines.

The outline of a threshold follows the edges of the cells.  Nothing is interpolated: there is no order 2.5, and a
contour drawn through one invents loops.
"""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from ridgeback.numeric.arrays import Array

Bands = NDArray[np.int64]

# |relative error| up to which a cell belongs to the band; beyond the last is band 5.
THRESHOLDS = (1e-6, 1e-4, 1e-3, 1e-2, 1e-1)
MISSING = -1


def bands(relative_error: Array) -> Bands:
    """Return the band 0 (good) to 5 (bad) of each cell, MISSING where the error is not a number.

    >>> bands(np.array([[1e-7, -0.005, 0.5, np.nan]])).tolist()
    [[0, 3, 5, -1]]
    """
    size = np.abs(relative_error)
    found = np.searchsorted(THRESHOLDS, np.where(np.isnan(size), 0.0, size), side="left")
    return np.where(np.isnan(size), MISSING, found).astype(np.int64)


def runs(row: Bands) -> list[tuple[int, int, int]]:
    """Split a row into maximal runs ``(start, stop, value)``.

    >>> runs(np.array([2, 2, 5]))
    [(0, 2, 2), (2, 3, 5)]
    """
    breaks = [0, *(np.flatnonzero(np.diff(row)) + 1).tolist(), row.size]
    return [(a, b, int(row[a])) for a, b in itertools.pairwise(breaks) if b > a]


def edges(centres: Array) -> Array:
    """Return the edges of cells around increasing centres: half way between neighbours.

    >>> edges(np.array([1.0, 2.0, 4.0])).tolist()
    [0.5, 1.5, 3.0, 5.0]
    """
    if centres.size == 1:
        return np.array([centres[0] - 0.5, centres[0] + 0.5])
    middle = (centres[1:] + centres[:-1]) / 2
    first = centres[0] - (middle[0] - centres[0])
    last = centres[-1] + (centres[-1] - middle[-1])
    return np.concatenate([[first], middle, [last]])


def staircase(inside: NDArray[np.bool_]) -> list[tuple[int, int, int, int]]:
    """Return the edges between cells that are inside and cells that are not, merged, as grid-corner segments.

    ``inside[row, column]``; a segment is ``(column0, row0, column1, row1)``.  The rim of the grid is no edge.

    >>> staircase(np.array([[True, True, False]]))
    [(2, 0, 2, 1)]
    """
    upright = inside[:, 1:] != inside[:, :-1]
    level = inside[1:, :] != inside[:-1, :]
    found = []
    for column in range(upright.shape[1]):
        for a, b, on in runs(upright[:, column].astype(np.int64)):
            found += [(column + 1, a, column + 1, b)] if on else []
    for row in range(level.shape[0]):
        for a, b, on in runs(level[row].astype(np.int64)):
            found += [(a, row + 1, b, row + 1)] if on else []
    return found


def rectangles(grid: Bands, x: Array, y: Array) -> dict[int, str]:
    """Return for each band one SVG path of run-length rectangles; ``x`` and ``y`` are cell edges in SVG units.

    >>> rectangles(np.array([[0, 0]]), np.array([0.0, 1.0, 2.0]), np.array([5.0, 0.0]))
    {0: 'M0 5h2v-5h-2z'}
    """
    paths: dict[int, list[str]] = {}
    for i, row in enumerate(grid):
        for a, b, band in runs(row):
            width, height = x[b] - x[a], y[i + 1] - y[i]
            shape = f"M{_n(x[a])} {_n(y[i])}h{_n(width)}v{_n(height)}h{_n(-width)}z"
            paths.setdefault(band, []).append(shape)
    return {band: "".join(shapes) for band, shapes in sorted(paths.items())}


def outline(segments: list[tuple[int, int, int, int]], x: Array, y: Array) -> str:
    """Return one SVG path that strokes grid-corner segments.

    >>> outline([(1, 0, 1, 1)], np.array([0.0, 7.5]), np.array([5.0, 0.0]))
    'M7.5 5L7.5 0'
    """
    return "".join(f"M{_n(x[a])} {_n(y[b])}L{_n(x[c])} {_n(y[d])}" for a, b, c, d in segments)


def _n(value: float) -> str:
    return f"{round(float(value), 2) + 0.0:.2f}".rstrip("0").rstrip(".")
