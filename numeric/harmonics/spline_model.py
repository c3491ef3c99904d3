"""The model of global harmonic least squares: phase, logarithm of the amplitude, harmonics and offset as splines.

    x = a(t) (cos phi(t) + sum over h of [b_h(t) cos h phi + c_h(t) sin h phi]) + d(t),      a = exp(l(t)),

with phi, l, b_h, c_h and d splines on the same knots.  How it is fitted stands in ``harmonics.spline_fit``.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.harmonics.spline_basis import NormalEquations, SplineBasis, normal_equations
from ridgeback.numeric.harmonics.spline_parts import Part
from ridgeback.numeric.harmonics.window_steps import turning
from ridgeback.numeric.signal.samples import TWO_PI

CLEAR = 5.0
"""Deviations of its own by which an amplitude stands out of the noise."""


@dataclass(frozen=True)
class SplineModel:
    """A fitted model.  ``coefficients`` is ``(K, F)``: the splines 1 (what multiplies a), b_h and c_h in turn, d, phi.

    ``size`` is a at the samples and ``logarithm`` the coefficients of l.  ``noise`` is the residual's standard
    deviation, ``cycles`` the mean distance of the knots, ``settled`` tells whether the iteration came to rest.
    """

    time: Array
    breaks: Array
    coefficients: Array
    logarithm: Array
    multiples: tuple[int, ...]
    noise: float
    settled: bool
    equations: NormalEquations
    count: int
    """Samples that it was fitted to."""
    criterion: float
    """Akaike's: the lower, the better the model predicts."""
    band: tuple[float, float]
    """In which that counts, rad per sample."""
    colour: float = 1.0
    """Power of the noise near the oscillation over its mean power."""

    @property
    def band_noise(self) -> float:
        """Standard deviation of white noise as strong as that near the oscillation."""
        return self.noise * math.sqrt(self.colour)

    @property
    def basis(self) -> SplineBasis:
        """The splines that all parts are made of."""
        return self.equations.basis

    @property
    def families(self) -> int:
        """F."""
        return int(self.coefficients.shape[1])

    @property
    def parameters(self) -> int:
        """The number of coefficients."""
        return self.coefficients.size

    @cached_property
    def phase(self) -> Array:
        """phi at the samples."""
        return self.basis.values(self.coefficients[:, -1])

    @cached_property
    def size(self) -> Array:
        """e^l at the samples."""
        return np.exp(self.basis.values(self.logarithm))

    @property
    def cycles(self) -> float:
        """Cycles per knot interval, on the mean."""
        turned = self.coefficients[-1, -1] - self.coefficients[0, -1]  # at its ends a spline is its end coefficient
        return float(turned) / TWO_PI / (self.breaks.size - 1)

    @property
    def omega(self) -> Array:
        """phi' at the samples, rad per time unit."""
        return self.tone(1)[0]

    @cached_property
    def mean_omega(self) -> float:
        """The mean of omega, weighted by the power, rad per time unit."""
        return float(np.average(self.omega, weights=self.size**2))

    @property
    def amplitude(self) -> Array:
        """a at the samples."""
        return self.tone(1)[1]

    @property
    def growth(self) -> Array:
        """a'/a = l' at the samples."""
        return self.basis.slopes(self.logarithm)

    def tone(self, multiple: int, change: Array | None = None) -> tuple[Array, Array]:
        """Frequency and amplitude of harmonic ``multiple``, with the coefficients changed by ``change``.

        Raises InputError for a harmonic that the model does not hold.
        """
        c = self.coefficients if change is None else self.coefficients + change
        if multiple == 1:
            return self.basis.slopes(c[:, -1]), self.size * self.basis.values(c[:, 0])
        if multiple not in self.multiples:
            raise InputError(f"harmonic {multiple} is not in the model of the signal; it holds {(1, *self.multiples)}")
        # b_h and c_h are solved for beside cos and sin of h times the phase as it was, before it takes its increment
        omega = self.basis.slopes(self.coefficients[:, -1])
        at = 1 + 2 * self.multiples.index(multiple)
        cosine, sine = c[:, at], c[:, at + 1]
        value = self.basis.values(cosine) - 1j * self.basis.values(sine)
        slope = self.basis.slopes(cosine) - 1j * self.basis.slopes(sine)
        share = np.abs(value)
        drift = (slope * value.conj()).imag / np.maximum(share, np.finfo(float).tiny) ** 2
        return np.asarray(multiple * omega + drift, dtype=np.float64), np.asarray(self.size * share, dtype=np.float64)

    def samples(self, *, keep: Callable[[int], bool] = lambda _: True) -> Array:
        """The model's samples: of the harmonics (0 the offset, 1 the fundamental, ...) for which ``keep`` is true."""
        order = (1, *(h for h in self.multiples for _ in "bc"), 0)
        kept = np.array([keep(h) for h in order] + [False])
        part = np.where(kept, self.coefficients, 0.0)
        weights = Linearised(self.coefficients[:, -1], self.logarithm, self.multiples)
        return self.basis.along(lambda some: (some.read(part) * weights(some)).sum(axis=1))

    def response(self, noise: Array) -> tuple[Array, Array]:
        """What small noise in the samples does to the coefficients, and the part of the noise that the fit takes up."""
        change = self.equations.solve(noise)
        return change, self.equations.model(change)

    @cached_property
    def information(self) -> NormalEquations:
        """The normal equations without what held the fit firm: the Fisher information, over the variance of the noise.

        Where the amplitude sinks under the noise a firm fit comes to rest sooner, but knows no more.
        """
        free = normal_equations(self.basis, self.equations.weights, self.families)
        return replace(free, beside=self.equations.beside)

    @cached_property
    def clear(self) -> bool:
        """Whether the amplitude rises out of the noise anywhere, CLEAR times its own deviation."""
        deviation = self.band_noise * np.sqrt(self.equations.variance(0))
        return bool((deviation < 1.0 / CLEAR).any())

    @cached_property
    def omega_deviation(self) -> Array:
        """One sigma of omega in white noise of the residual's size: the Cramer-Rao bound of this model."""
        last = self.coefficients.shape[1] - 1
        return np.asarray(self.band_noise * np.sqrt(self.information.variance(last, slopes=True)), dtype=np.float64)


def weights_of(phase: Array, amplitude: Array, multiples: tuple[int, ...]) -> Array:
    """What multiplies each spline, ``(R, F)``: an increment of l, b_h and c_h in turn, d, and an increment of phi.

    Samples lie side by side in memory.
    """
    rows = np.empty((3 + 2 * len(multiples), phase.size))
    turn = turning(phase)
    rows[0], rows[-2], rows[-1] = amplitude * turn.real, 1.0, -amplitude * turn.imag
    power, reached = turn, 1
    for at, h in enumerate(multiples):
        power, reached = power * turn ** (h - reached), h
        np.multiply(amplitude, power.real, out=rows[1 + 2 * at])
        np.multiply(amplitude, power.imag, out=rows[2 + 2 * at])
    return rows.T


@dataclass(frozen=True)
class Linearised:
    """The weights of a model about a phase and the logarithm of an amplitude, as coefficients of splines ``(K,)``.

    They are 0 at samples that are not ``sound``.  Those of each part are kept from one use to the next by ``held``, if
    there is one.
    """

    phase: Array
    logarithm: Array
    multiples: tuple[int, ...]
    sound: Array | None = None
    held: dict[int, Array] | None = None

    def __call__(self, part: Part) -> Array:
        """The weights at the samples of a part, ``(R, F)``."""
        if self.held is not None and part.rows.start in self.held:
            return self.held[part.rows.start]
        weights = weights_of(part.read(self.phase), np.exp(part.read(self.logarithm)), self.multiples)
        weights = weights if self.sound is None else weights * self.sound[part.rows, None]
        if self.held is not None:
            self.held[part.rows.start] = weights
        return weights
