"""Quintic B-splines on knots at chosen times: values, slopes, and the banded least squares that they lead to.

A model that is linear in F splines on the same knots, x(t) = sum over f of w_f(t) s_f(t), has K F coefficients.
Ordered knot by knot, index k F + f, its normal matrix has a bandwidth of 6 F, whatever the length of the record.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations_with_replacement

import numpy as np
from scipy.interpolate import BSpline
from scipy.linalg import cho_solve_banded, cholesky_banded
from scipy.sparse import coo_array, csr_array, diags_array

from ridgeback.numeric.arrays import Array

DEGREE = 5
"""Of the splines: with quintics the phase of a decay needs half the knots that cubics need (measured)."""
PRODUCTS = 8_000_000
"""Products of weights that are held at a time (64 MB)."""
FLOOR = 1e-12
"""Added to the unit diagonal: a column that the data leave empty is no reason to fail."""


@dataclass(frozen=True)
class SplineBasis:
    """Values and time derivatives of K B-splines at N times, as sparse ``(N, K)`` arrays."""

    values: csr_array
    slopes: csr_array
    knots: Array

    @property
    def count(self) -> int:
        """K."""
        return int(self.values.shape[1])

    @cached_property
    def overlaps(self) -> tuple[csr_array, ...]:
        """The products B_k(t_n) B_(k+j)(t_n) as ``(K, N)``, j = 0 .. DEGREE: times a weight they sum it over n."""
        size = self.values.shape[0]
        value = self.values.data.reshape(size, DEGREE + 1)
        index = self.values.indices.reshape(size, DEGREE + 1)
        sample = np.repeat(np.arange(size), DEGREE + 1).reshape(size, DEGREE + 1)
        products = []
        for j in range(DEGREE + 1):
            keep = DEGREE + 1 - j
            entries = (value[:, :keep] * value[:, j:]).ravel()
            where = (index[:, :keep].ravel(), sample[:, :keep].ravel())
            products.append(csr_array(coo_array((entries, where), shape=(self.count, size))))
        return tuple(products)


def spline_basis(time: Array, breaks: Array) -> SplineBasis:
    """B-splines on the intervals between ``breaks``, the first and last of which are the ends of ``time``.

    >>> basis = spline_basis(np.linspace(0.0, 1.0, 5), np.array([0.0, 0.5, 1.0]))
    >>> basis.count, np.asarray(basis.values.sum(axis=1)).round(12).tolist()
    (7, [1.0, 1.0, 1.0, 1.0, 1.0])
    """
    knots = np.concatenate([np.full(DEGREE, breaks[0]), breaks, np.full(DEGREE, breaks[-1])])
    values = csr_array(BSpline.design_matrix(time, knots, DEGREE))
    lower = csr_array(BSpline.design_matrix(time, knots[1:-1], DEGREE - 1))
    # c'_i = d (c_(i+1) - c_i) / (t_(i+d+1) - t_(i+1)), d the degree: de Boor, A Practical Guide to Splines, ch. X
    rise = DEGREE / (knots[DEGREE + 1 : -1] - knots[1 : -DEGREE - 1])
    count = values.shape[1]
    difference = diags_array([-rise, rise], offsets=[0, 1], shape=(count - 1, count))
    return SplineBasis(values, csr_array(lower @ difference), knots)


# de Boor's NEWNOT, A Practical Guide to Splines, ch. XII: breaks between which |s^(d+1)|^(1/(d+1)) has equal integrals,
# that derivative being the jumps of the d-th, spread out; mixed half and half with the density that the breaks had.
def adapted_density(coefficients: Array, breaks: Array, before: Array) -> Array:
    """Return the density of breaks (one value per interval, integral 1) that suits a spline."""
    width = np.diff(breaks)
    if width.size < 3:
        return before
    knots = np.concatenate([np.full(DEGREE, breaks[0]), breaks, np.full(DEGREE, breaks[-1])])
    highest = BSpline(knots, coefficients, DEGREE).derivative(DEGREE)(0.5 * (breaks[1:] + breaks[:-1]))
    jump = np.abs(np.diff(highest)) / (0.5 * (width[1:] + width[:-1]))
    beyond = 0.5 * (np.concatenate([jump[:1], jump]) + np.concatenate([jump, jump[-1:]]))
    wanted = beyond ** (1.0 / (DEGREE + 1))
    total = float((wanted * width).sum())
    return before if total <= 0.0 else np.asarray(0.5 * before + 0.5 * wanted / total, dtype=np.float64)


@dataclass(frozen=True)
class NormalEquations:
    """The factored normal matrix of F weighted splines; coefficients come as ``(K, F)``."""

    basis: SplineBasis
    weights: Array
    factor: Array
    scale: Array

    def moments(self, x: Array) -> Array:
        """J^T x, ``(K, F)``."""
        return np.asarray(self.basis.values.T @ (self.weights * x[:, None]), dtype=np.float64)

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
        return np.asarray(((self.basis.values @ coefficients) * self.weights).sum(axis=1), dtype=np.float64)

    def variance(self, rows: csr_array, family: int) -> Array:
        """Diagonal of R C R^T per unit noise variance, C the covariance of one family's K coefficients, R ``rows``."""
        count, families = self.basis.count, self.weights.shape[1]
        total = np.zeros(rows.shape[0])
        for first in range(0, count, 256):
            wanted = np.arange(first, min(first + 256, count))
            unit = np.zeros((count * families, wanted.size))
            unit[wanted * families + family, np.arange(wanted.size)] = 1.0
            part = self.inverse_times(unit)[family::families]
            total += np.asarray(rows[:, wanted].multiply(rows @ part).sum(axis=1)).ravel()
        return np.maximum(total, 0.0)


def overlap_sums(basis: SplineBasis, weights: Array, pairs: list[tuple[int, int]]) -> Iterator[Array]:
    """Sums over n of B_k B_(k+j) w_f w_g as ``(K, pairs)``, for j = 0 .. DEGREE in turn."""
    left, right = np.array(pairs).T
    sums = [np.zeros((basis.count, len(pairs))) for _ in basis.overlaps]
    rows = max(1024, PRODUCTS // len(pairs))
    for first in range(0, weights.shape[0], rows):
        part = weights[first : first + rows]
        products = part[:, left] * part[:, right]
        for j, overlap in enumerate(basis.overlaps):
            sums[j] += (overlap if len(part) == len(weights) else overlap[:, first : first + rows]) @ products
    yield from sums


def normal_equations(basis: SplineBasis, weights: Array) -> NormalEquations:
    """Form and factor J^T J of the model with ``weights``, ``(N, F)``.

    >>> t = np.linspace(0.0, 1.0, 40)
    >>> weights = np.stack([np.ones(40), np.cos(30 * t)], axis=1)
    >>> equations = normal_equations(spline_basis(t, np.linspace(0.0, 1.0, 4)), weights)
    >>> x = t**3 + (1.0 - t) * np.cos(30 * t)
    >>> bool(np.abs(equations.model(equations.solve(x)) - x).max() < 1e-9)
    True
    """
    families = weights.shape[1]
    size = basis.count * families
    bands = np.zeros(((DEGREE + 1) * families, size))
    pairs = list(combinations_with_replacement(range(families), 2))
    for j, sums in enumerate(overlap_sums(basis, weights, pairs)):
        for column, (f, g) in enumerate(pairs):
            bands[j * families + g - f, f::families] = sums[:, column]
            if j and g > f:  # the sums of w_f w_g are symmetric; below the diagonal of a block there is the same again
                bands[j * families + f - g, g::families] = sums[:, column]
    scale = np.sqrt(np.where(bands[0] > 0.0, bands[0], 1.0))
    bands /= scale
    for r in range(bands.shape[0]):
        bands[r, : size - r] /= scale[r:]
        bands[r, size - r :] = 0.0
    bands[0] += FLOOR
    return NormalEquations(basis, weights, cholesky_banded(bands, lower=True, check_finite=False), scale)
