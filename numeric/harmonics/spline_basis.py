"""Quintic B-splines on knots at chosen times: values, slopes, and the banded least squares that they lead to.

A model that is linear in F splines on the same knots, x(t) = sum over f of w_f(t) s_f(t), has K F coefficients.
Ordered knot by knot, index k F + f, its normal matrix has a bandwidth of 6 F, whatever the length of the record.
Everything of the length of the record is formed in parts of it and dropped: a model is its coefficients.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations_with_replacement, pairwise

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray
from scipy.interpolate import BSpline
from scipy.linalg import cho_solve_banded, cholesky_banded
from scipy.sparse import csr_array

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.harmonics.spline_parts import DEGREE, Between, Part

PRODUCTS = 4_000_000
"""Products of weights that are held at a time (32 MB)."""
ROWS = 1 << 13
"""Samples of a part."""
MOST_KEPT = 1_000_000
"""Samples whose splines are kept (48 MB) while a model is fitted to them."""
DENSE = 128
"""Samples between two knots, on the mean, from which on parts end at the knots."""
UNKNOWNS = 8_000_000
"""Numbers of the columns of a covariance that are found at a time (64 MB)."""
FLOOR = 1e-12
"""Added to the unit diagonal: a column that the data leave empty is no reason to fail."""

Weights = Callable[["Part"], Array]
"""What multiplies each of the F splines at the samples of a part, ``(R, F)``."""


@dataclass(frozen=True)
class SplineBasis:
    """K B-splines on ``knots``, read at N times; with ``keep`` what they are there is kept for the next use."""

    time: Array
    knots: Array
    degree: int = DEGREE
    keep: bool = False

    @property
    def count(self) -> int:
        """K."""
        return self.knots.size - self.degree - 1

    @cached_property
    def _whole(self) -> Part:
        return Part(slice(0, self.time.size), self.time, self.knots, self.degree)

    @cached_property
    def _kept(self) -> tuple[Between, ...]:
        return tuple(self.between())

    def parts(self) -> Iterator[Part]:
        """All samples, in parts; those of a short record are one, which is kept."""
        size = self.time.size
        if size <= ROWS:
            yield self._whole
            return
        if size >= DENSE * (self.count - self.degree):
            yield from self._kept if self.keep and size <= MOST_KEPT else self.between()
            return
        for first in range(0, size, ROWS):
            rows = slice(first, min(first + ROWS, size))
            yield Part(rows, self.time[rows], self.knots, self.degree)

    def between(self) -> Iterator[Between]:
        """All samples, in parts between two knots each."""
        inner = np.searchsorted(self.time, self.knots[self.degree + 1 : -self.degree - 1], side="left").tolist()
        for at, (begin, end) in enumerate(pairwise([0, *inner, self.time.size])):
            for first in range(begin, end, ROWS):
                rows = slice(first, min(first + ROWS, end))
                yield Between(rows, self.time[rows], self.knots, self.degree, at)

    def along(self, of: Callable[[Part], Array]) -> Array:
        """What a function gives for each part, joined, ``(N,)``."""
        found = np.empty(self.time.size)
        for part in self.parts():
            found[part.rows] = of(part)
        return found

    def values(self, coefficients: Array) -> Array:
        """The spline with these coefficients at all times."""
        return self.along(lambda part: part.read(coefficients))

    def slopes(self, coefficients: Array) -> Array:
        """Its derivative by time."""
        return self.along(lambda part: part.read(coefficients, slopes=True))

    @cached_property
    def squares(self) -> Array:
        """Sums over all times of B_k^2, ``(K,)``."""
        return overlap_sums(self, alone, [(0, 0)])[0][:, 0]

    def rows_at(self, index: NDArray[np.intp], *, slopes: bool) -> csr_array:
        """Values or slopes of the splines at some of the times, ``(index, K)``."""
        some = Part(slice(0, index.size), self.time[index], self.knots, self.degree)
        return some.slopes if slopes else some.values


def spline_basis(time: Array, breaks: Array, degree: int = DEGREE, *, keep: bool = False) -> SplineBasis:
    """B-splines on the intervals between ``breaks``, the first and last of which are the ends of ``time``.

    >>> basis = spline_basis(np.linspace(0.0, 1.0, 5), np.array([0.0, 0.5, 1.0]))
    >>> basis.count, basis.values(np.ones(7)).round(12).tolist()
    (7, [1.0, 1.0, 1.0, 1.0, 1.0])
    """
    ends = np.full(degree, breaks[0]), np.full(degree, breaks[-1])
    return SplineBasis(time, np.concatenate([ends[0], breaks, ends[1]]), degree, keep)


# de Boor's NEWNOT, A Practical Guide to Splines, ch. XII: breaks between which |s^(d+1)|^(1/(d+1)) has equal integrals,
# that derivative being the jumps of the d-th, spread out; mixed half and half with the density that the breaks had.
def adapted_density(coefficients: Array, breaks: Array, before: Array, size: Array) -> Array:
    """Return the density of breaks (one value per interval, integral 1) that suits splines.

    ``coefficients`` are ``[K, spline]``; an error of the splines counts by the ``size`` on each interval.
    """
    width = np.diff(breaks)
    if width.size < 3:
        return before
    knots = np.concatenate([np.full(DEGREE, breaks[0]), breaks, np.full(DEGREE, breaks[-1])])
    highest = BSpline(knots, coefficients, DEGREE).derivative(DEGREE)(0.5 * (breaks[1:] + breaks[:-1]))
    jump = np.linalg.norm(np.diff(highest, axis=0), axis=1) / (0.5 * (width[1:] + width[:-1]))
    beyond = 0.5 * (np.concatenate([jump[:1], jump]) + np.concatenate([jump, jump[-1:]]))
    wanted = (size * beyond) ** (1.0 / (DEGREE + 1))
    total = float((wanted * width).sum())
    return before if total <= 0.0 else np.asarray(0.5 * before + 0.5 * wanted / total, dtype=np.float64)


def alone(part: Part) -> Array:
    """The weight of one spline by itself: 1."""
    return np.ones((part.time.size, 1))


@dataclass(frozen=True)
class NormalEquations:
    """The factored normal matrix of F weighted splines; coefficients come as ``(K, F)``.

    ``beside``, ``(N, Q)``, are columns of something else that was fitted to the same samples: they count in the
    variance, not in the solution.
    """

    basis: SplineBasis
    weights: Weights
    factor: Array
    scale: Array
    """Square roots of its diagonal, ``(K F,)``."""
    beside: Array | None = None

    @property
    def families(self) -> int:
        """F."""
        return self.scale.size // self.basis.count

    def moments(self, x: Array) -> Array:
        """J^T x, ``(K, F)``."""
        total = np.zeros((self.basis.count, self.families))
        for part in self.basis.parts():
            part.add_moments(total, self.weights(part) * x[part.rows, None])
        return total

    def inverse_times(self, right: Array) -> Array:
        """(J^T J)^-1 of the columns of ``right``, ``(K F, columns)``."""
        scaled = cho_solve_banded((self.factor, True), right / self.scale[:, None], check_finite=False)
        return np.asarray(scaled / self.scale[:, None], dtype=np.float64)

    def solve(self, x: Array) -> Array:
        """Least-squares coefficients of ``x``, ``(K, F)``."""
        right = self.moments(x)
        return self.inverse_times(right.reshape(-1, 1)).reshape(right.shape)

    def model(self, coefficients: Array) -> Array:
        """J times coefficients: the samples they stand for."""
        return self.basis.along(lambda part: (part.read(coefficients) * self.weights(part)).sum(axis=1))

    # Six neighbouring splines meet at a sample: only the band of C within five of the diagonal counts there.
    def variance(self, family: int, *, slopes: bool = False) -> Array:
        """Diagonal of R C R^T per unit noise variance: C that of one family's coefficients, R its values or slopes."""
        band = self.band(family)

        def at(part: Part) -> Array:
            rows, order = part.slope_entries if slopes else part.entries, self.basis.degree + 1
            total = np.zeros(part.time.size)
            for j in range(order):
                pairs = rows[:, : order - j] * rows[:, j:]
                total += (1.0 if j == 0 else 2.0) * part.spread(pairs, band[:, j])
            return np.maximum(total, 0.0) + self.by_others(lambda c: part.read(c, slopes=slopes), family)

        return self.basis.along(at)

    def variance_of(self, vectors: csr_array, family: int) -> Array:
        """The same for any combinations ``(M, K)`` of a family's coefficients, a few of them."""
        right = np.zeros((self.basis.count * self.families, vectors.shape[0]))
        right[family :: self.families] = vectors.toarray().T
        answer = self.inverse_times(right)[family :: self.families]
        own = np.asarray(vectors.multiply(answer.T).sum(axis=1)).ravel()
        return np.maximum(own, 0.0) + self.by_others(lambda c: vectors @ c, family)

    # The inverse of a matrix in blocks: with C = (J^T J)^-1, Y = C J^T B and S = B^T B - B^T J Y, the covariance of the
    # coefficients is C + Y S^-1 Y^T.
    @cached_property
    def shared(self) -> tuple[Array, Array]:
        """Y and S^-1 for the columns ``beside``."""
        beside = np.zeros((self.basis.time.size, 0)) if self.beside is None else self.beside
        between = np.stack([self.moments(b).ravel() for b in beside.T], axis=1)
        answer = self.inverse_times(between)
        inverse = np.linalg.pinv(beside.T @ beside - between.T @ answer, hermitian=True)
        return answer, np.asarray(inverse, dtype=np.float64)

    def by_others(self, read: Callable[[Array], Array], family: int) -> Array | float:
        """What columns ``beside`` add to a variance of what ``read`` makes of coefficients."""
        if self.beside is None:
            return 0.0
        answer, inverse = self.shared
        part = np.asarray(read(answer[family :: self.families]))
        return np.asarray(np.maximum(np.einsum("rq,qp,rp->r", part, inverse, part), 0.0), dtype=np.float64)

    def band(self, family: int) -> Array:
        """C_(k, k+j) of one family, ``(K, degree + 1)``, j = 0 .. degree; 0 beyond the last."""
        count, families, order = self.basis.count, self.families, self.basis.degree + 1
        found, columns = np.zeros((count, order)), max(16, UNKNOWNS // (count * families))
        for first in range(0, count, columns):
            wanted = np.arange(first, min(first + columns, count))
            unit = np.zeros((count * families, wanted.size))
            unit[wanted * families + family, np.arange(wanted.size)] = 1.0
            part = self.inverse_times(unit)[family::families]
            for j in range(order):
                inside = wanted[wanted + j < count]
                found[inside, j] = part[inside + j, inside - first]
        return found


def overlap_sums(basis: SplineBasis, weights: Weights, pairs: list[tuple[int, int]]) -> list[Array]:
    """Sums over n of B_k B_(k+j) w_f w_g as ``(K, pairs)``, for j = 0 .. degree in turn."""
    left, right = np.array(pairs).T
    sums = [np.zeros((basis.count, len(pairs))) for _ in range(basis.degree + 1)]
    step = max(1024, PRODUCTS // len(pairs))
    for part in basis.parts():
        given = weights(part).T
        for first in range(0, part.time.size, step):
            some = slice(first, first + step)
            products = (given[left, some] * given[right, some]).T
            part.add_overlaps(sums, products, some)
    return sums


def normal_equations(
    basis: SplineBasis, weights: Weights, families: int, ridge: Array | None = None
) -> NormalEquations:
    """Form and factor J^T J of the model with ``weights`` for ``families`` splines.

    ``ridge``, ``(F,)``, adds to each family what so large a weight at all times would: families that are increments
    stay put where the data say less of them than that.

    >>> t = np.linspace(0.0, 1.0, 40)
    >>> basis = spline_basis(t, np.linspace(0.0, 1.0, 4))
    >>> equations = normal_equations(basis, lambda part: np.stack([part.time**0, np.cos(30 * part.time)], axis=1), 2)
    >>> x = t**3 + (1.0 - t) * np.cos(30 * t)
    >>> bool(np.abs(equations.model(equations.solve(x)) - x).max() < 1e-9)
    True
    """
    order, size = basis.degree + 1, basis.count * families
    blocks = np.zeros((order * families, basis.count, families))
    pairs = list(combinations_with_replacement(range(families), 2))
    left, right = np.array(pairs).T
    above = right > left
    for j, sums in enumerate(overlap_sums(basis, weights, pairs)):
        blocks[j * families + right - left, :, left] = sums.T
        if j:  # the sums of w_f w_g are symmetric; below the diagonal of a block there is the same again
            blocks[j * families + (left - right)[above], :, right[above]] = sums.T[above]
    if ridge is not None:
        blocks[0] += np.outer(basis.squares, ridge)
    bands = blocks.reshape(-1, size)
    scale = np.sqrt(np.where(bands[0] > 0.0, bands[0], 1.0))
    bands /= scale
    bands /= sliding_window_view(np.concatenate([scale, np.full(len(bands) - 1, np.inf)]), size)
    bands[0] += FLOOR
    return NormalEquations(basis, weights, cholesky_banded(bands, lower=True, check_finite=False), scale)
