"""Cells of a study that are a full product, as arrays over its axes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Grid:
    """The axes of a full product by name, in the order of the columns, and where each cell lies in it."""

    axes: Mapping[str, NDArray[Any]]
    """Every coordinate's own values: numbers rising, words as they come first."""
    place: NDArray[np.intp]
    """The flat index of each cell."""

    @property
    def dimensions(self) -> tuple[str, ...]:
        """The axes with more than one value."""
        return tuple(name for name, values in self.axes.items() if values.size > 1)

    def shaped(self, values: NDArray[Any]) -> NDArray[Any]:
        """One value for each cell, over the dimensions."""
        flat = np.empty_like(values)
        flat[self.place] = values
        return flat.reshape([self.axes[name].size for name in self.dimensions])


def grid_of(coordinates: Mapping[str, NDArray[Any]]) -> Grid | None:
    """The grid of some cells; None where they are no full product, or a coordinate is missing somewhere.

    >>> grid = grid_of({"order": np.array([2.0, 4.0, 2.0, 4.0]), "amplitude": np.array([1.0, 1.0, 0.5, 0.5])})
    >>> grid.shaped(np.array([1.0, 2.0, 3.0, 4.0])).tolist()
    [[3.0, 1.0], [4.0, 2.0]]
    >>> grid_of({"order": np.array([2.0, 4.0, 2.0]), "amplitude": np.array([1.0, 1.0, 0.5])}) is None
    True
    """
    axes: dict[str, NDArray[Any]] = {}
    place = np.zeros(len(next(iter(coordinates.values()))), dtype=np.intp)
    for name, values in coordinates.items():
        words = values.dtype == object
        if not words and np.isnan(values).any():
            return None
        own, first, inverse = np.unique(values.astype(str) if words else values, return_index=True, return_inverse=True)
        order = np.argsort(first) if words else np.arange(own.size)
        rank = np.empty_like(order)
        rank[order] = np.arange(order.size)
        axes[name] = own[order].astype(object) if words else own
        place = place * own.size + rank[inverse]
    if np.prod([values.size for values in axes.values()]) != place.size or np.unique(place).size != place.size:
        return None
    return Grid(axes, place)
