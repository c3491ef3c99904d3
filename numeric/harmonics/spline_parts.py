"""B-splines at neighbouring samples: read there, and summed over them against what stands at the samples.

Where many samples lie between two knots, all of a part see the same splines: its matrices are dense and products of
them fast.  Where few do, they are sparse.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array, csr_array

from ridgeback.numeric.arrays import Array

DEGREE = 5
"""Of the splines: with quintics the phase of a decay needs half the knots that cubics need (measured)."""


# The recursion of Cox and de Boor, A Practical Guide to Splines, ch. X: B_(i,d) from the two B_(i,d-1) beside it.
def splines_at(time: Array, knots: Array, left: NDArray[np.integer], degree: int) -> Array:
    """The B-splines of a degree that are not 0 at each time, ``(R, degree + 1)``; ``left`` is the knot before it.

    >>> splines_at(np.array([0.25]), np.array([0.0, 0.0, 1.0, 1.0]), np.array([1]), 1).tolist()
    [[0.75, 0.25]]
    """
    found = np.zeros((degree + 1, time.size))
    found[0] = 1.0
    before = [time - knots[left + 1 - j] for j in range(1, degree + 1)]
    beyond = [knots[left + j] - time for j in range(1, degree + 1)]
    for d in range(1, degree + 1):
        carried = np.zeros(time.size)
        for i in range(d):
            share = found[i] / (beyond[i] + before[d - 1 - i])
            found[i] = carried + beyond[i] * share
            carried = before[d - 1 - i] * share
        found[d] = carried
    return np.ascontiguousarray(found.T)


# c'_i = d (c_(i+1) - c_i) / (t_(i+d+1) - t_(i+1)), d the degree: de Boor, A Practical Guide to Splines, ch. X
def slopes_at(time: Array, knots: Array, first: NDArray[np.integer], degree: int) -> Array:
    """The derivatives of the B-splines from ``first`` on at each time, ``(R, degree + 1)``.

    >>> slopes_at(np.array([0.25]), np.array([0.0, 0.0, 2.0, 2.0]), np.array([0]), 1).tolist()
    [[-0.5, 0.5]]
    """
    lower = splines_at(time, knots, first + degree, degree - 1)
    rise = degree / (knots[degree + 1 : -1] - knots[1 : -degree - 1])
    steps = lower * rise[first[:, None] + np.arange(degree)]
    return np.asarray(np.diff(np.pad(-steps, ((0, 0), (1, 1))), axis=1))


def by_samples(entries: Array, places: NDArray[np.int32], rows: int) -> csc_array:
    """Entries ``(R, width)`` that stand in these rows of a matrix ``(rows, R)``."""
    size, width = entries.shape
    ends = np.arange(0, (size + 1) * width, width, dtype=np.int32)
    return csc_array((entries.ravel(), places.ravel(), ends), shape=(rows, size))


@dataclass(frozen=True)
class Part:
    """The B-splines at R neighbouring samples: each sees ``degree`` + 1 of them, from ``first`` on."""

    rows: slice
    time: Array
    knots: Array
    degree: int = DEGREE

    @property
    def count(self) -> int:
        """K."""
        return self.knots.size - self.degree - 1

    @cached_property
    def first(self) -> NDArray[np.int32]:
        """The number of the first spline that each sample sees."""
        left = np.searchsorted(self.knots, self.time, side="right") - 1
        return (np.clip(left, self.degree, self.count - 1) - self.degree).astype(np.int32)

    @cached_property
    def entries(self) -> Array:
        """The values of those splines at each sample, ``(R, degree + 1)``."""
        return splines_at(self.time, self.knots, self.first + self.degree, self.degree)

    @cached_property
    def slope_entries(self) -> Array:
        """Their derivatives by time."""
        return slopes_at(self.time, self.knots, self.first, self.degree)

    @cached_property
    def values(self) -> csr_array:
        """B_k(t_n), ``(R, K)``."""
        return self.sparse(self.entries)

    @cached_property
    def slopes(self) -> csr_array:
        """B_k'(t_n), ``(R, K)``."""
        return self.sparse(self.slope_entries)

    @cached_property
    def summing(self) -> csc_array:
        """The same the other way, ``(K, R)``: it sums over the samples."""
        return by_samples(self.entries, self.places(self.degree + 1), self.count)

    @cached_property
    def overlaps(self) -> csc_array:
        """The products B_k(t_n) B_(k+j)(t_n) as ``(K, R)``, one below the other for j = 0 .. degree."""
        value, order = self.entries, self.degree + 1
        products = [value[:, : order - j] * value[:, j:] for j in range(order)]
        below = [np.arange(j * self.count, j * self.count + order - j, dtype=np.int32) for j in range(order)]
        places = (self.first[:, None] + np.concatenate(below)).astype(np.int32)
        return by_samples(np.concatenate(products, axis=1), places, order * self.count)

    def places(self, width: int) -> NDArray[np.int32]:
        """The numbers of so many splines from ``first`` on, ``(R, width)``."""
        return np.asarray(self.first[:, None] + np.arange(width, dtype=np.int32), dtype=np.int32)

    def sparse(self, entries: Array) -> csr_array:
        """Entries ``(R, width)`` that stand from ``first`` on, as ``(R, K)``."""
        size, width = entries.shape
        columns = self.places(width)
        ends = np.arange(0, (size + 1) * width, width, dtype=np.int32)
        return csr_array((entries.ravel(), columns.ravel(), ends), shape=(size, self.count))

    def read(self, coefficients: Array, *, slopes: bool = False) -> Array:
        """Splines with these coefficients, ``(K, ...)``, at the samples, or their slopes."""
        return np.asarray((self.slopes if slopes else self.values) @ coefficients)

    def spread(self, entries: Array, coefficients: Array) -> Array:
        """The same of any entries ``(R, width)`` that stand from ``first`` on."""
        return np.asarray(self.sparse(entries) @ coefficients)

    def add_moments(self, total: Array, x: Array) -> None:
        """Add the sums over the samples of B_k x to ``(K, ...)``."""
        total += self.summing @ x

    def add_overlaps(self, sums: list[Array], products: Array, some: slice) -> None:
        """Add those of B_k B_(k+j) times products at some of the samples to ``sums[j]``."""
        overlaps = self.overlaps if len(products) == self.time.size else self.overlaps[:, some]
        found = np.asarray(overlaps @ products).reshape(self.degree + 1, self.count, -1)
        for total, new in zip(sums, found, strict=True):
            np.add(total, new, out=total)


@dataclass(frozen=True)
class Between(Part):
    """A part between two knots: all of its samples see the splines from number ``at`` on, polynomials there."""

    at: int = 0

    @cached_property
    def first(self) -> NDArray[np.int32]:
        """The same for each sample."""
        return np.full(self.time.size, self.at, dtype=np.int32)

    @property
    def seen(self) -> slice:
        """The splines that are not 0 here."""
        return slice(self.at, self.at + self.degree + 1)

    # A polynomial of degree d is known from d + 1 of its values; those at Chebyshev's points are best conditioned.
    def interpolated(self, *, slopes: bool) -> Array:
        """Values or slopes of those splines at the samples, ``(R, degree + 1)``, by powers of the place between."""
        low, high = self.knots[self.at + self.degree], self.knots[self.at + self.degree + 1]
        nodes = np.cos(np.pi * (np.arange(self.degree + 1) + 0.5) / (self.degree + 1))
        there = 0.5 * (low + high) + 0.5 * (high - low) * nodes
        first = np.full(nodes.size, self.at, dtype=np.int32)
        known = (
            slopes_at(there, self.knots, first, self.degree)
            if slopes
            else splines_at(there, self.knots, first + self.degree, self.degree)
        )
        polynomials = np.linalg.solve(np.vander(nodes, increasing=True), known)
        powers = np.ones((nodes.size, self.time.size))
        np.divide(2.0 * self.time - low - high, high - low, out=powers[1])
        for degree in range(2, nodes.size):
            np.multiply(powers[degree - 1], powers[1], out=powers[degree])
        return np.asarray((polynomials.T @ powers).T)

    @cached_property
    def entries(self) -> Array:
        """The values of those splines at each sample."""
        return self.interpolated(slopes=False)

    @cached_property
    def slope_entries(self) -> Array:
        """Their derivatives by time."""
        return self.interpolated(slopes=True)

    def read(self, coefficients: Array, *, slopes: bool = False) -> Array:
        """As of any part; samples lie side by side in memory."""
        return np.asarray((coefficients[self.seen].T @ (self.slope_entries if slopes else self.entries).T).T)

    def spread(self, entries: Array, coefficients: Array) -> Array:
        """As of any part."""
        return np.asarray(entries @ coefficients[self.at : self.at + entries.shape[1]])

    def add_moments(self, total: Array, x: Array) -> None:
        """As of any part."""
        total[self.seen] += self.entries.T @ x

    def add_overlaps(self, sums: list[Array], products: Array, some: slice) -> None:
        """As of any part."""
        value, order = self.entries[some], self.degree + 1
        for j, total in enumerate(sums):
            total[self.at : self.at + order - j] += (value[:, : order - j] * value[:, j:]).T @ products
