"""Global harmonic least squares: phase, amplitudes and offset as quintic splines over the whole record, fitted at once.

    x = a(t) (cos phi(t) + sum over h of [b_h(t) cos h phi + c_h(t) sin h phi]) + d(t) + noise,      a = exp(l(t)),

with phi, l, b_h, c_h and d quintic splines on the same knots: the logarithm of a decay's amplitude is as smooth as its
phase, and a plain damped oscillation is in the model on any knots.
For white Gaussian noise this is maximum likelihood, and the deviations are the Cramer-Rao bound of this model with the
residual variance put in (Kay, Fundamentals of Statistical Signal Processing: Estimation Theory, 1993, ch. 3).  The
knots stand at equal numbers of *cycles* first and are then moved to where the sixth derivatives of phase and l, times
a, ask for them.  Their number is chosen by how well the model predicts: Akaike's criterion.  The local form, a
polynomial in a sliding window, is ``harmonics.local_fit``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from scipy.fft import rfft, rfftfreq
from scipy.integrate import cumulative_trapezoid

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.harmonics.spline_basis import (
    SplineBasis,
    adapted_density,
    alone,
    normal_equations,
    spline_basis,
)
from ridgeback.numeric.harmonics.spline_model import Linearised, SplineModel
from ridgeback.numeric.harmonics.spline_parts import DEGREE
from ridgeback.numeric.harmonics.window_steps import AT_REST, left_open
from ridgeback.numeric.signal.local_line import local_line
from ridgeback.numeric.signal.samples import TWO_PI, checked_work
from ridgeback.numeric.signal.windows import window

ITERATIONS = 15
SETTLED = 1e-4
"""Radians by which the last step may still have moved the phase, weighted with the amplitude: under the noise, at the
end of a decay, it goes on wandering."""
FINEST_CYCLES = 2.0
"""Closer knots would let the amplitude's spline imitate harmonics."""
UNSEEN_IN_ALL = 1e-2
"""Last step of the phase at which a fit ends, relative to what the noise leaves open of it by all parameters."""
HOPEFUL, NEAR = 6, 0.1
"""Steps after which a fit is given up that, once they are below NEAR, shrink too slowly for it to settle."""

ENOUGH = 100
"""Ordinates of a spectrum from which on they suffice to judge a model by."""
ROUNDED = 1e-14
"""Of the largest amplitude, down to which a sum of some ten terms of doubles (2.2e-16 each) is right."""
FIRM = 0.05
"""Of the mean square of what is left of the samples: so much of a^2 / 2 leaves the increments of l and phi free."""
BACK = 0.2
"""Of the largest amplitude, by which it may fall and come back and yet have risen and fallen once."""
FLOOR, MUCH = 0.01, 3.0
"""Of the largest amplitude, down to which its changes count where knots are spread; the logarithm of all of them from
which on they count as much as the cycles."""
LEAST = 1e-4
"""Of the largest amplitude, that the first logarithm is taken of."""
LOW_DEGREES = (1, 2, 3)
"""Of polynomials over the whole record, which are tried first."""
GROWTH = 1.5
"""From one number of knot intervals to the next that is tried."""
GUIDE_CYCLES = (4.0, 3.0)
"""Lengths of the windows in which the guide's phase is corrected, one after the other."""


@dataclass(frozen=True)
class Known:
    """What is known of samples beside the oscillation in them.

    ``sound`` is 1 at the samples that count and 0 at those that are no part of the motion, all by default; ``beside``
    the tangent of other components that were fitted to them and are taken off already; ``band`` that in which models
    are judged, rad per sample, by default that of the model itself.
    """

    sound: Array | None = None
    beside: Array | None = None
    band: tuple[float, float] | None = None

    def sound_of(self, size: int) -> Array:
        """1 at the samples that count."""
        return np.ones(size) if self.sound is None else self.sound


NOTHING_KNOWN = Known()


def level_of(basis: SplineBasis, amplitude: Array) -> Array:
    """Coefficients of the logarithm of an amplitude, weighted with it; LEAST of the largest at least."""
    weight = np.maximum(amplitude, LEAST * float(amplitude.max()))
    equations = normal_equations(basis, lambda part: weight[part.rows, None], 1)
    return equations.solve(weight * np.log(weight))[:, 0]


def fit_on(
    x: Array,
    time: Array,
    phase: Array,
    amplitude: Array,
    breaks: Array,
    multiples: tuple[int, ...],
    degree: int = DEGREE,
    known: Known = NOTHING_KNOWN,
) -> SplineModel:
    """Gauss-Newton with knots at ``breaks``, from a phase and an amplitude; each step half a radian at most."""
    basis = spline_basis(time, breaks, degree, keep=True)
    p, level = normal_equations(basis, alone, 1).solve(phase)[:, 0], level_of(basis, amplitude)
    sound = known.sound_of(x.size)
    step, heard = math.inf, x * sound
    residual = heard
    families = 3 + 2 * len(multiples)
    itself = np.zeros((basis.count, families))
    itself[:, 0] = 1.0
    for done in range(1, ITERATIONS + 1):
        weights = Linearised(p, level, multiples, known.sound, {})
        equations = normal_equations(basis, weights, families, firmness(families, residual))
        left = heard - equations.model(itself)
        c = equations.solve(left)
        residual, size = left - equations.model(c), np.exp(basis.values(level))
        moved = np.maximum(np.abs(basis.values(c[:, 0])), np.abs(basis.values(c[:, -1])))
        largest = max(float(size.max()), np.finfo(float).tiny)
        before, step = step, float((moved * size).max()) / largest
        unseen = UNSEEN_IN_ALL * float(left_open(np.mean(residual**2), basis.count / x.size, largest))
        if done > 1 and (step < max(AT_REST, min(SETTLED, unseen)) or (step < SETTLED and step > 0.5 * before)):
            break  # not after the first, which is as firm as if all of the samples were noise
        if done >= HOPEFUL and step < NEAR and step * min(1.0, step / before) ** (ITERATIONS - done) > SETTLED:
            break
        part = min(1.0, 0.5 / float(moved.max()))
        p, level = p + part * c[:, -1], level + part * c[:, 0]
    c[:, 0] += 1.0
    c[:, -1] = p
    count = int(sound.sum())
    noise = math.sqrt(float((residual**2).sum()) / max(1, count - c.size))
    plain = replace(basis, keep=False)
    equations = replace(equations, basis=plain, beside=known.beside, weights=replace(weights, held=None))
    band = known.band or counted(basis.slopes(p) * (time[1] - time[0]), size, multiples)
    criterion = akaike(residual, band, count=count, parameters=c.size - basis.count, floor=rounding(size))
    return SplineModel(
        time=time,
        breaks=breaks,
        coefficients=c,
        logarithm=level,
        multiples=multiples,
        noise=noise,
        settled=step < SETTLED,
        equations=equations,
        count=count,
        criterion=criterion,
        band=band,
    )


def counted(omega: Array, size: Array, multiples: tuple[int, ...]) -> tuple[float, float]:
    """The band round an oscillation of so many rad per sample and its harmonics, in which a model is judged."""
    clear = omega[size > 0.1 * size.max()]
    return 0.5 * float(clear.min()), (max(multiples, default=1) + 1.0) * float(clear.max())


def rounding(size: Array) -> float:
    """What counts as nothing of what a model leaves, in the unit of the samples: some ten units in the last place.

    A sum of some ten terms of an amplitude ``size`` errs by so much; what is less has no say in a criterion.

    >>> rounding(np.array([1.0, 200.0]))
    2e-12
    """
    return ROUNDED * float(size.max())


# Akaike's criterion with its correction for few samples: Hurvich and Tsai, Biometrika 76 (1989) 297.
def akaike(left: Array, band: tuple[float, float], *, count: int, parameters: int, floor: float) -> float:
    """n log(mean square) + 2 p n / (n - p - 1) of what a model leaves in a band, below which the offset is.

    Slow drift and noise far away from the oscillation are nothing that knots of its phase are for.  A band with fewer
    than ENOUGH ordinates is widened upward.

    >>> left = np.random.default_rng(1).normal(size=400)
    >>> fine, drifting = (akaike(x, (0.5, 2.0), count=400, parameters=6, floor=0.0) for x in (left, left + 9.0))
    >>> bool(abs(fine - drifting) < 1e-6)
    True
    """
    power, w = np.abs(rfft(left)) ** 2 / left.size, TWO_PI * rfftfreq(left.size)
    first = int(np.searchsorted(w, band[0]))
    last = max(int(np.searchsorted(w, band[1])), min(first + ENOUGH, w.size))
    n = 2.0 * (last - first) * count / left.size
    mean = 2.0 * float(power[first:last].sum()) / max(n, 1.0)
    return n * math.log(mean + floor**2 + 1e-300) + 2.0 * parameters * n / max(n - parameters - 1.0, 0.5)


def firmness(families: int, left: Array) -> Array:
    """The ridge of the two increments: where a is far below what is left of the samples, both stay as they are."""
    ridge = np.zeros(families)
    ridge[[0, -1]] = FIRM * float(np.mean(left**2))
    return ridge


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


@dataclass(frozen=True)
class Splines:
    """How many intervals between knots, and the degree on them."""

    intervals: int
    degree: int

    @property
    def count(self) -> int:
        """Coefficients of one spline."""
        return self.intervals + self.degree


def splines_tried(cycles: float, size: int, families: int) -> list[Splines]:
    """Polynomials of degree 1, 2 and 3, then quintics on 1, 2, 3, 5, 8, ... intervals.

    No more coefficients than cycles, down to FINEST_CYCLES cycles an interval, and a third of the samples at most.

    >>> [(one.intervals, one.degree) for one in splines_tried(33.0, 641, 6)]
    [(1, 1), (1, 2), (1, 3), (1, 5), (2, 5), (3, 5), (5, 5), (8, 5), (12, 5)]
    >>> [(one.intervals, one.degree) for one in splines_tried(3.5, 140, 3)]
    [(1, 1), (1, 2)]
    """
    tried = [Splines(1, degree) for degree in (*LOW_DEGREES, DEGREE)]
    most = int(cycles / FINEST_CYCLES)
    while (after := math.ceil(GROWTH * tried[-1].intervals)) <= most:
        tried.append(Splines(after, DEGREE))
    return [s for s in tried if s.count <= max(cycles, LOW_DEGREES[1] + 1) and 3 * families * s.count <= size]


def on_more_knots(
    x: Array,
    time: Array,
    phase: Array,
    amplitude: Array,
    density: Array,
    multiples: tuple[int, ...],
    known: Known = NOTHING_KNOWN,
) -> Iterator[SplineModel]:
    """Models on more and more knots, spread as ``density`` grows, from the first that can follow the phase."""
    families = 3 + 2 * len(multiples)
    for splines in splines_tried(float(phase[-1] - phase[0]) / TWO_PI, x.size, families):
        breaks = breaks_of(density, time, splines.intervals)
        if np.diff(breaks).min() > 0.0 and follows(time, breaks, phase, amplitude, splines.degree):
            yield fit_on(x, time, phase, amplitude, breaks, multiples, splines.degree, known)


def follows(time: Array, breaks: Array, phase: Array, amplitude: Array, degree: int = DEGREE) -> bool:
    """Tell whether splines come within half a radian of a phase, rms, weighted with the amplitude."""
    weight = np.maximum(amplitude, 1e-6 * amplitude.max())
    fitted = normal_equations(spline_basis(time, breaks, degree), lambda part: weight[part.rows, None], 1)
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


def harmonic_splines(
    x: Array, rate: float, guide: Array, *, multiples: tuple[int, ...] = (), known: Known = NOTHING_KNOWN
) -> list[SplineModel]:
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
    fewest = 3 * families * (LOW_DEGREES[1] + 1)
    if not (cycles > FINEST_CYCLES and x.size >= fewest):
        raise InputError(
            f"signal holds {cycles:.3g} cycles in {x.size} samples; a model of all of it with {families} splines needs "
            f"more than {FINEST_CYCLES:g} cycles and {fewest} samples"
        )
    time = np.arange(x.size) / rate
    known = replace(known, band=counted(guide / rate, amplitude, multiples))
    even = changing(phase, amplitude)
    first = best_model(until_no_better(on_more_knots(x, time, phase, amplitude, even, multiples, known)))
    return until_no_better(on_more_knots(x, time, first.phase, first.amplitude, adapted(first), multiples, known))


def changing(phase: Array, amplitude: Array) -> Array:
    """A rising function of time whose equal steps hold as many cycles, or as great a change of the amplitude.

    A loss that grows with the amplitude makes most of its changes early, in a few cycles, a swell may before its top.
    Where the amplitude falls and comes back, as in beats, the cycles count alone.

    >>> t = np.linspace(0.0, 60.0, 7)
    >>> changing(t, np.ones(7)).tolist() == (t / 60.0).tolist(), np.allclose(changing(t, np.exp(-t / 20)), t / 30.0)
    (True, True)
    >>> np.allclose(changing(t, np.exp(t / 20)), t / 30.0), np.allclose(changing(t, 1 - (t % 20) / 20), t / 60.0)
    (True, True)
    """
    largest = float(amplitude.max())
    around = np.minimum(np.maximum.accumulate(amplitude), np.maximum.accumulate(amplitude[::-1])[::-1])
    cycles = np.asarray((phase - phase[0]) / float(phase[-1] - phase[0]), dtype=np.float64)
    if float((around - amplitude).max()) > BACK * largest:
        return cycles
    log = np.log(np.maximum(around, FLOOR * largest))
    changed = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(log)))])
    most = float(changed[-1])
    return np.asarray(cycles + min(1.0, most / MUCH) ** 2 * changed / max(most, 1e-300), dtype=np.float64)


def adapted(model: SplineModel) -> Array:
    """A rising function of time whose equal steps put knots where the model's phase asks for them."""
    if model.basis.degree < DEGREE:
        return model.phase
    even = changing(model.phase, model.size)
    share = np.diff(np.interp(model.breaks, model.time, even)) / np.diff(model.breaks)
    total = float(even[-1] - even[0])
    middle = np.interp(0.5 * (model.breaks[1:] + model.breaks[:-1]), model.time, model.size)
    both = np.stack([model.logarithm, model.coefficients[:, -1]], axis=1)
    density = adapted_density(both, model.breaks, share / total, middle)
    level = np.concatenate([[0.0], np.cumsum(density * np.diff(model.breaks))])
    return np.asarray(np.interp(model.time, model.breaks, level), dtype=np.float64)


def best_model(models: list[SplineModel]) -> SplineModel:
    """The model with the lowest criterion."""
    return min(models, key=lambda model: model.criterion)
