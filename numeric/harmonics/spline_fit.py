"""Global harmonic least squares: phase, amplitudes and offset as quintic splines over the whole record, fitted at once.

    x = a(t) cos phi(t) + sum over h of [b_h(t) cos h phi + c_h(t) sin h phi] + d(t) + noise,

with phi, a, b_h, c_h and d quintic splines on the same knots.  For white Gaussian noise this is maximum likelihood, and
the deviations are the Cramer-Rao bound of this model with the residual variance put in (Kay, Fundamentals of
Statistical Signal Processing: Estimation Theory, 1993, ch. 3).  The knots stand at equal numbers of *cycles* first and
are then moved to where the phase's sixth derivative asks for them.  Their number is chosen by how well the model
predicts: Akaike's criterion.  The local form, a polynomial in a sliding window, is ``harmonics.local_fit``.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.integrate import cumulative_trapezoid

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.harmonics.spline_basis import (
    DEGREE,
    NormalEquations,
    Part,
    SplineBasis,
    adapted_density,
    alone,
    normal_equations,
    spline_basis,
)
from ridgeback.numeric.signal.local_line import local_line
from ridgeback.numeric.signal.samples import TWO_PI, checked_work
from ridgeback.numeric.signal.windows import window

ITERATIONS = 15
SETTLED = 1e-4
"""Radians by which the last step may still have moved the phase, weighted with the amplitude: under the noise, at the
end of a decay, it goes on wandering."""
FINEST_CYCLES = 2.0
"""Closer knots would let the amplitude's spline imitate harmonics."""
CLEAR = 5.0
GROWTH = 1.5
"""From one number of knot intervals to the next that is tried."""
GUIDE_CYCLES = (4.0, 3.0)
"""Lengths of the windows in which the guide's phase is corrected, one after the other."""


@dataclass(frozen=True)
class SplineModel:
    """A fitted model.  ``coefficients`` is ``(K, F)``: the splines a, then b_h and c_h in turn, d, and phi.

    ``noise`` is the residual's standard deviation, ``cycles`` the mean distance of the knots, ``settled`` tells whether
    the iteration came to rest.
    """

    time: Array
    breaks: Array
    coefficients: Array
    multiples: tuple[int, ...]
    noise: float
    settled: bool
    equations: NormalEquations

    @property
    def basis(self) -> SplineBasis:
        """The splines that all parts are made of."""
        return self.equations.basis

    @property
    def parameters(self) -> int:
        """The number of coefficients."""
        return self.coefficients.size

    @cached_property
    def phase(self) -> Array:
        """phi at the samples."""
        return self.basis.values(self.coefficients[:, -1])

    @property
    def cycles(self) -> float:
        """Cycles per knot interval, on the mean."""
        turned = self.coefficients[-1, -1] - self.coefficients[0, -1]  # at its ends a spline is its end coefficient
        return float(turned) / TWO_PI / (self.breaks.size - 1)

    @property
    def omega(self) -> Array:
        """phi' at the samples, rad per time unit."""
        return self.tone(1)[0]

    @property
    def amplitude(self) -> Array:
        """a at the samples."""
        return self.tone(1)[1]

    # Akaike's criterion with its correction for few samples: Hurvich and Tsai, Biometrika 76 (1989) 297.
    @property
    def criterion(self) -> float:
        """n log(mean squared residual) + 2 p n / (n - p - 1): the lower, the better the model predicts."""
        n, p = self.time.size, self.parameters
        floor = (1e-14 * float(np.abs(self.coefficients[:, 0]).max())) ** 2
        return n * math.log(self.noise**2 * (n - p) / n + floor) + 2.0 * p * n / (n - p - 1)

    def tone(self, multiple: int, change: Array | None = None) -> tuple[Array, Array]:
        """Frequency and amplitude of harmonic ``multiple``, with the coefficients changed by ``change``.

        Raises InputError for a harmonic that the model does not hold.
        """
        c = self.coefficients if change is None else self.coefficients + change
        if multiple == 1:
            return self.basis.slopes(c[:, -1]), self.basis.values(c[:, 0])
        if multiple not in self.multiples:
            raise InputError(f"harmonic {multiple} is not in the model of the signal; it holds {(1, *self.multiples)}")
        # b_h and c_h are solved for beside cos and sin of h times the phase as it was, before it takes its increment
        omega = self.basis.slopes(self.coefficients[:, -1])
        at = 1 + 2 * self.multiples.index(multiple)
        cosine, sine = c[:, at], c[:, at + 1]
        value = self.basis.values(cosine) - 1j * self.basis.values(sine)
        slope = self.basis.slopes(cosine) - 1j * self.basis.slopes(sine)
        size = np.abs(value)
        drift = (slope * value.conj()).imag / np.maximum(size, np.finfo(float).tiny) ** 2
        return np.asarray(multiple * omega + drift, dtype=np.float64), np.asarray(size, dtype=np.float64)

    def samples(self, *, keep: Callable[[int], bool] = lambda _: True) -> Array:
        """The model's samples: of the harmonics (0 the offset, 1 the fundamental, ...) for which ``keep`` is true."""
        order = (1, *(h for h in self.multiples for _ in "bc"), 0)
        kept = np.array([keep(h) for h in order] + [False])
        return self.equations.model(np.where(kept, self.coefficients, 0.0))

    def response(self, noise: Array) -> tuple[Array, Array]:
        """What small noise in the samples does to the coefficients, and the part of the noise that the fit takes up."""
        change = self.equations.solve(noise)
        return change, self.equations.model(change)

    @cached_property
    def clear(self) -> bool:
        """Whether the amplitude rises out of the noise anywhere, CLEAR times its own deviation."""
        deviation = self.noise * np.sqrt(self.equations.variance(0))
        return bool((np.abs(self.amplitude) > CLEAR * deviation).any())

    @cached_property
    def omega_deviation(self) -> Array:
        """One sigma of omega in white noise of the residual's size: the Cramer-Rao bound of this model."""
        last = self.coefficients.shape[1] - 1
        return np.asarray(self.noise * np.sqrt(self.equations.variance(last, slopes=True)), dtype=np.float64)


def weights_of(phase: Array, amplitude: Array, multiples: tuple[int, ...]) -> Array:
    """What multiplies each spline: those of a, of b_h and c_h in turn, of d, and of an increment of phi."""
    columns = [np.cos(phase)]
    for h in multiples:
        columns += [np.cos(h * phase), np.sin(h * phase)]
    return np.stack([*columns, np.ones_like(phase), -amplitude * np.sin(phase)], axis=1)


@dataclass(frozen=True)
class Linearised:
    """The weights of a model about a phase and an amplitude, as coefficients of splines ``(K,)``."""

    phase: Array
    amplitude: Array
    multiples: tuple[int, ...]

    def __call__(self, part: Part) -> Array:
        """The weights at the samples of a part, ``(R, F)``."""
        return weights_of(part.values @ self.phase, part.values @ self.amplitude, self.multiples)


def fit_on(
    x: Array, time: Array, phase: Array, amplitude: Array, breaks: Array, multiples: tuple[int, ...]
) -> SplineModel:
    """Gauss-Newton with knots at ``breaks``, from a phase and an amplitude; each step half a radian at most."""
    basis = spline_basis(time, breaks)
    plain = normal_equations(basis, alone, 1)
    p, a = plain.solve(phase)[:, 0], plain.solve(amplitude)[:, 0]
    step = math.inf
    for _ in range(ITERATIONS):
        equations = normal_equations(basis, Linearised(p, a, multiples), 3 + 2 * len(multiples))
        c = equations.solve(x)
        a = c[:, 0]
        turn, size = np.abs(basis.values(c[:, -1])), np.abs(basis.values(a))
        before, step = step, float((turn * size).max() / max(float(size.max()), np.finfo(float).tiny))
        if step < 1e-10 or (step < SETTLED and step > 0.5 * before):
            break
        p = p + c[:, -1] * min(1.0, 0.5 / float(turn.max()))
    residual = x - equations.model(c)
    c[:, -1] = p
    noise = math.sqrt(float(residual @ residual) / max(1, x.size - c.size))
    return SplineModel(time, breaks, c, multiples, noise, step < SETTLED, equations)


def corrected_phase(x: Array, rate: float, guide: Array) -> tuple[Array, Array]:
    """Phase and amplitude of the component near ``guide``: what is left after turning back by the guide's phase.

    >>> t = np.arange(640) / 32.0
    >>> true = 2 * np.pi * (1.2 * t + 0.02 * t**2) + 0.5
    >>> phase, amplitude = corrected_phase(3.0 * np.cos(true), 32.0, np.full(640, 2 * np.pi * 1.6))
    >>> bool(np.abs(phase - true)[64:-64].max() < 0.02), round(float(amplitude[320]), 2)
    (True, 3.0)
    """
    phase = cumulative_trapezoid(guide, dx=1.0 / rate, initial=0)
    slowest = TWO_PI * rate / float(guide.min())
    for cycles in GUIDE_CYCLES:
        half = max(1, min(round(0.5 * cycles * slowest), (x.size - 1) // 2))
        left, _ = local_line(2.0 * x * np.exp(-1j * phase), window("blackman", half), rate)
        phase = phase + np.unwrap(np.angle(left))
    return phase, np.abs(left)


def breaks_of(rising: Array, time: Array, intervals: int) -> Array:
    """Ends of ``intervals`` stretches over which ``rising`` grows by the same."""
    level = np.maximum.accumulate(rising)
    inner = np.interp(np.linspace(level[0], level[-1], intervals + 1)[1:-1], level, time)
    return np.concatenate([time[:1], inner, time[-1:]])


def numbers_of_intervals(cycles: float, size: int, families: int) -> list[int]:
    """1, 2, 3, 5, 8, ... knot intervals, down to FINEST_CYCLES cycles each and a third of the samples as coefficients.

    >>> numbers_of_intervals(33.0, 641, 6)
    [1, 2, 3, 5, 8, 12]
    """
    most = min(int(cycles / FINEST_CYCLES), size // (3 * families) - DEGREE)
    found = [1]
    while (after := math.ceil(GROWTH * found[-1])) <= most:
        found.append(after)
    return found


def on_more_knots(
    x: Array, time: Array, phase: Array, amplitude: Array, density: Array, multiples: tuple[int, ...]
) -> Iterator[SplineModel]:
    """Models on more and more knots, spread as ``density`` grows, from the first that can follow the phase."""
    families = 3 + 2 * len(multiples)
    for intervals in numbers_of_intervals(float(phase[-1] - phase[0]) / TWO_PI, x.size, families):
        breaks = breaks_of(density, time, intervals)
        if np.diff(breaks).min() > 0.0 and follows(time, breaks, phase, amplitude):
            yield fit_on(x, time, phase, amplitude, breaks, multiples)


def follows(time: Array, breaks: Array, phase: Array, amplitude: Array) -> bool:
    """Tell whether splines come within half a radian of a phase, rms, weighted with the amplitude."""
    weight = np.maximum(amplitude, 1e-6 * amplitude.max())
    fitted = normal_equations(spline_basis(time, breaks), lambda part: weight[part.rows, None], 1)
    off = fitted.model(fitted.solve(phase * weight)) - phase * weight
    return bool((off**2).mean() < 0.25 * (weight**2).mean())


def until_no_better(models: Iterator[SplineModel]) -> list[SplineModel]:
    """The models that settled, in order, until the criterion has failed to improve twice."""
    found: list[SplineModel] = []
    for model in models:
        if model.settled and model.clear:
            found.append(model)
        if len(found) > 2 and min(m.criterion for m in found[-2:]) > min(m.criterion for m in found[:-2]):
            break
    if not found:
        raise InputError("no model of the whole signal settled: its phase is not that of one smooth oscillation")
    return found


def harmonic_splines(x: Array, rate: float, guide: Array, *, multiples: tuple[int, ...] = ()) -> list[SplineModel]:
    """Fit models on more and more knots until the criterion has failed to improve twice; in that order.

    ``guide`` is the frequency per sample, rad per time unit, right to within a quarter of itself or so.  Raises
    InputError where no model settles, the record is too short or the work is over the budget.

    >>> t = np.arange(640) / 32.0
    >>> x = np.cos(2 * np.pi * (1.2 * t + 0.02 * t**2)) + 0.1 * np.random.default_rng(1).normal(size=640)
    >>> best = best_model(harmonic_splines(x, 32.0, np.full(640, 2 * np.pi * 1.6)))
    >>> best.settled, round(best.noise, 2)
    (True, 0.1)
    """
    families = 3 + 2 * len(multiples)
    checked_work(200.0 * x.size * families**2 * ITERATIONS, f"harmonic splines on {x.size} samples", "decimate first")
    phase, amplitude = corrected_phase(x, rate, guide)
    cycles = float(phase[-1] - phase[0]) / TWO_PI
    if not (cycles > FINEST_CYCLES and x.size >= 3 * families * (DEGREE + 1)):
        raise InputError(
            f"signal holds {cycles:.3g} cycles in {x.size} samples; a model of all of it with {families} splines needs "
            f"more than {FINEST_CYCLES:g} cycles and {3 * families * (DEGREE + 1)} samples"
        )
    time = np.arange(x.size) / rate
    first = best_model(until_no_better(on_more_knots(x, time, phase, amplitude, phase, multiples)))
    return until_no_better(on_more_knots(x, time, first.phase, first.amplitude, adapted(first), multiples))


def adapted(model: SplineModel) -> Array:
    """A rising function of time whose equal steps put knots where the model's phase asks for them."""
    share = np.diff(np.interp(model.breaks, model.time, model.phase)) / np.diff(model.breaks)
    total = float(model.phase[-1] - model.phase[0])
    density = adapted_density(model.coefficients[:, -1], model.breaks, share / total)
    level = np.concatenate([[0.0], np.cumsum(density * np.diff(model.breaks))])
    return np.asarray(np.interp(model.time, model.breaks, level), dtype=np.float64)


def best_model(models: list[SplineModel]) -> SplineModel:
    """The model with the lowest criterion."""
    return min(models, key=lambda model: model.criterion)
