"""Amplitude, growth rate and frequency along a record by models of all of it, and the deviation of any mean of them.

In a model x = e^l cos phi + ... with splines l and phi, the growth rate is l' and the frequency phi'.  Both are linear
in the coefficients, of which the Fisher information gives the covariance C: a mean with shares w_k of the values at
times t_k has the variance r^T C r, r = sum of w_k B'(t_k), however the errors at these times belong together.  The
values are those of the model on more knots; what is left of its bias is, as far as that exceeds noise, its difference
from the one on fewer knots where that is clear, else the share of it by the order at which the models converge.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.backbone.curve import MeanDeviation, Points
from ridgeback.numeric.harmonics.signal_model import SignalModels
from ridgeback.numeric.harmonics.spline_model import SplineModel
from ridgeback.numeric.tracking.uncertainty import room_of_definition

CLEARLY = 2.0
"""Deviations by which two models differ more than noise explains: all of the difference is taken for bias there, since
at the end of a fast decay models converge far more slowly than their order says."""
LEVEL, PHASE = 0, -1
"""Families of a model's coefficients: the increments of l and of phi."""


@dataclass(frozen=True)
class ModelRates:
    """Two models and the samples at which they are read."""

    models: SignalModels
    index: NDArray[np.intp]
    of_omega: bool = True
    """Whether the frequency that belongs to the points is that of the models."""

    def at(self, keep: Mask) -> ModelRates:
        """Some of the points."""
        return ModelRates(self.models, self.index[keep], self.of_omega)

    def points(self, start: float) -> Points:
        """Amplitude, frequency and growth rate with their deviations, at each point by itself."""
        fine = self.models.fine
        a = fine.amplitude[self.index]
        return Points(
            time=start + fine.time[self.index],
            amplitude=a,
            amplitude_sd=a * self.at_points(LEVEL, slopes=False),
            omega=fine.omega[self.index],
            omega_sd=np.hypot(self.at_points(PHASE, slopes=True), self.room()),
            growth_rate=fine.growth[self.index],
            growth_rate_sd=self.at_points(LEVEL, slopes=True),
        )

    def room(self) -> Array:
        """What the definition of omega(t) leaves open at the points."""
        fine = self.models.fine
        return room_of_definition(fine.omega, fine.time, self.models.best)[1][self.index]

    def at_points(self, family: int, *, slopes: bool) -> Array:
        """One sigma of a family's values or slopes at each point."""
        fine, coarse = self.models.fine, self.models.coarse
        noise, noise_coarse = (
            model.band_noise * np.sqrt(model.information.variance(family % model.families, slopes=slopes)[self.index])
            for model in (fine, coarse)
        )
        apart = self.rows(fine, slopes=slopes) @ coefficients(fine, family)
        apart -= self.rows(coarse, slopes=slopes) @ coefficients(coarse, family)
        return self.with_bias(noise, noise_coarse, apart)

    def rows(self, model: SplineModel, *, slopes: bool) -> csr_array:
        """Values or slopes of a model's splines at the points."""
        return model.basis.rows_at(self.index, slopes=slopes)

    def with_bias(self, noise: Array, noise_coarse: Array, apart: Array) -> Array:
        """One sigma of the fine model with the bias that should be left in it."""
        by_noise = np.maximum(noise**2 - noise_coarse**2, 0.0)
        share = np.where(apart**2 > CLEARLY**2 * by_noise, 1.0, self.models.remainder)
        beyond = np.maximum(apart**2 - by_noise, 0.0)
        return np.asarray(np.sqrt(noise**2 + share**2 * beyond), dtype=np.float64)

    def of_means(self, weights: csr_array, family: int, *, slopes: bool) -> Array:
        """One sigma of means ``weights[mean, point]`` of a family's values or slopes."""
        fine, coarse = self.models.fine, self.models.coarse
        r, r_coarse = (csr_array(weights @ self.rows(model, slopes=slopes)) for model in (fine, coarse))
        noise, noise_coarse = deviation_of(fine, r, family), deviation_of(coarse, r_coarse, family)
        apart = r @ coefficients(fine, family) - r_coarse @ coefficients(coarse, family)
        return self.with_bias(noise, noise_coarse, apart)

    # of n standard normal values with correlations r the squares sum as chi-square with n^2 / sum of r^2 degrees of
    # freedom, times a number (F. E. Satterthwaite, Biometrics Bull. 2 (1946) 110)
    def independent(self, index: list[NDArray[np.intp]], share: list[Array]) -> float:
        """How many independent values the errors of means of the frequency are as good as, by their correlations."""
        fine = self.models.fine
        rows = csr_array(mixing(index, share, self.index.size) @ self.rows(fine, slopes=True))
        size = deviation_of(fine, rows, PHASE)
        if not self.of_omega or not (size > 0.0).all():
            return float("nan")
        rows = csr_array(rows.multiply(1.0 / size[:, None]))
        i, j = np.triu_indices(len(index), 1)
        correlation = 0.5 * deviation_of(fine, csr_array(rows[i] + rows[j]), PHASE) ** 2 - 1.0
        return float(len(index) ** 2 / (len(index) + 2.0 * float(correlation @ correlation)))

    def mean_deviations(self, index: list[NDArray[np.intp]], share: list[Array]) -> list[MeanDeviation]:
        """Standard deviations of means over some of the points, each with its shares."""
        a = self.models.fine.amplitude[self.index]
        weights = mixing(index, share, self.index.size)
        by_size = mixing(index, [s * a[i] for i, s in zip(index, share, strict=True)], self.index.size)
        level = self.of_means(by_size, LEVEL, slopes=False)
        growth = self.of_means(weights, LEVEL, slopes=True)
        omega = np.hypot(self.of_means(weights, PHASE, slopes=True), weights @ self.room())
        known = zip(level.tolist(), growth.tolist(), omega.tolist(), strict=True)
        return [MeanDeviation(a, g, w if self.of_omega else None) for a, g, w in known]


def mixing(index: list[NDArray[np.intp]], share: list[Array], size: int) -> csr_array:
    """The matrix ``[mean, point]`` of shares.

    >>> mixing([np.array([0, 2])], [np.array([0.25, 0.75])], 3).toarray().tolist()
    [[0.25, 0.0, 0.75]]
    """
    row = np.repeat(np.arange(len(index)), [part.size for part in index])
    return csr_array((np.concatenate(share), (row, np.concatenate(index))), shape=(len(index), size))


def coefficients(model: SplineModel, family: int) -> Array:
    """Coefficients of l or of phi."""
    return model.logarithm if family == LEVEL else model.coefficients[:, family]


def deviation_of(model: SplineModel, rows: csr_array, family: int) -> Array:
    """One sigma in noise of ``rows`` times the coefficients of a family."""
    return model.band_noise * np.sqrt(model.information.variance_of(rows, family % model.families))
