"""One candidate fitted to one recording: starting values from the backbone, then phases, then the samples themselves.

The samples are the data: least squares of x - model is maximum likelihood in white noise, and uses waveform, mean
offset and the phase over the whole record at once.  The first two stages only bring it near enough to converge: a phase
that is wrong by half a turn at the end would end in a false minimum.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from ridgeback.common.errors import InputError
from ridgeback.compare.identification.candidates import DampingLaw, Model, level_at
from ridgeback.compare.identification.potentials import Shape
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.backbone.backbone import Backbone, backbone
from ridgeback.numeric.estimators.higher_harmonics import carrier
from ridgeback.numeric.harmonics.signal_model import SignalModels
from ridgeback.numeric.orbits.slow_flow import motion
from ridgeback.numeric.recording.recording import Recording
from ridgeback.numeric.signal.local_line import local_line
from ridgeback.numeric.signal.windows import half_width, window
from ridgeback.numeric.tracking.track import Track

DEMODULATED = 4.0
"""Cycles of the window in which a phase is demodulated: half of one from an end it leans on what is not there."""
ANCHORS = 60
"""Points of the record whose phase and amplitude start the fit."""
NEAR_STEPS, STEPS = 10, 30
"""Evaluations that the anchors and the samples may take, Jacobians not counted; the anchors need only come near."""
COARSE, FINE = 1e-4, 1e-8
"""Relative change of the sum of squares at which a first fit stops, and one to full precision."""

FLAT, LONG_STEP = 1e-6, 1e-3
"""Derivatives below which a short step shows nothing, and a longer one over the range of a parameter or 1."""


@dataclass(frozen=True)
class Data:
    """A recording prepared for fitting: times from 0, samples over L, the measured backbone, phases at anchors."""

    time: Array
    x: Array
    length: float
    rate: float
    measured: Backbone
    anchor_time: Array
    anchor_phase: Array
    anchor_log: Array
    anchor_weight: Array
    kept: Mask
    """Samples that count: not clipped."""

    @property
    def cycle(self) -> float:
        """A typical period."""
        return 2 * np.pi / float(np.median(self.measured.omega))


@dataclass(frozen=True)
class Fit:
    """Least squares of one model: theta, the sum of squares in units of L, and (J^T J)^-1."""

    model: Model
    theta: Array
    residual: Array
    spread: Array

    @property
    def sum_of_squares(self) -> float:
        """Sum of squared residuals."""
        return float(self.residual @ self.residual)


def prepare(
    recording: Recording,
    track: Track,
    *,
    models: SignalModels | None = None,
    kept: Mask | None = None,
    measured: Backbone | None = None,
) -> Data:
    """Measure what a fit starts from, by ``models`` of the samples if there are any; only ``kept`` samples count.

    ``measured`` is the backbone where that is known.  Raises InputError when it cannot be measured.
    """
    first, kept = float(recording.time[0]), np.ones(recording.values.size, dtype=np.bool_) if kept is None else kept
    if measured is None:
        wrong = None if kept.all() else ~kept
        measured = backbone(track, recording.values, recording.rate, start=first, exclude=wrong, models=models)
    x = recording.values - measured.offset
    phase, size = demodulated(x, recording.rate, track, first)
    length = max(float(measured.amplitude.max()), float(size.max()))
    edge = round(2 * np.pi / float(np.median(measured.omega)) * recording.rate)
    at = np.unique(np.linspace(edge, x.size - 1 - edge, ANCHORS).astype(int))
    amplitude = size / length
    return Data(
        time=np.arange(x.size) / recording.rate,
        x=x / length,
        length=length,
        rate=recording.rate,
        measured=measured,
        anchor_time=at / recording.rate,
        anchor_phase=phase[at],
        anchor_log=np.log(np.maximum(amplitude[at], 1e-6)),
        anchor_weight=amplitude[at],
        kept=kept,
    )


def demodulated(x: Array, rate: float, track: Track, start: float) -> tuple[Array, Array]:
    """Phase and amplitude of the fundamental on every sample: the track's carrier, and what is left of it filtered."""
    base = carrier(track, x.size, rate, start)
    cycle = 2 * np.pi / float(np.median(base.omega[base.valid]))
    w = window("blackman", half_width(DEMODULATED * cycle, rate, name="window", longest=x.size))
    value, _ = local_line(2 * x * np.exp(-1j * base.phase), w, rate)
    return base.phase + np.unwrap(np.angle(value)), np.abs(value)


def fit(model: Model, data: Data) -> Fit:
    """Fit a model from the best starting shape of each of its groups; the best result, coarsely (see ``refit``).

    Raises InputError when no start leads to a fit.
    """
    found = [refined(model, data, start) for start in starts(model, data)]
    usable = [f for f in found if np.isfinite(f.sum_of_squares)]
    if not usable:
        raise InputError(f"{model.name}: no starting value led to a fit")
    return min(usable, key=lambda f: f.sum_of_squares)


def refit(model: Model, data: Data, theta: Array) -> Fit:
    """Fit a model to the samples, to rounding, from a theta that is already near."""
    return by_samples(model, data, theta, FINE)


def starts(model: Model, data: Data) -> list[Array]:
    """The best shape of each group by the measured backbone, completed by rates, amplitude and phase."""
    found = []
    for group in model.groups or ((bends(model, data),),):
        ranked = sorted((backbone_cost(model, data, shape) for shape in group), key=lambda pair: pair[0])
        if np.isfinite(ranked[0][0]):
            found.append(ranked[0][1])
    return found


def backbone_cost(model: Model, data: Data, shape: Shape) -> tuple[float, Array]:
    """Distance of a shape's backbone from the measured one, its frequency scale fitted, and the theta that it gives."""
    b = data.measured
    a = b.amplitude / data.length
    weight = 1 / (b.omega_sd**2 + (1e-4 * b.omega) ** 2)
    theta = np.array([float(np.median(b.omega)), *shape, *first_rates(model, data), data.anchor_log[0], 0.0, 0.0])
    try:
        omega, growth = model.curves(theta, a, float(data.time[-1]))
    except (InputError, FloatingPointError):
        return np.inf, theta
    scale = float(np.sum(weight * b.omega * omega) / np.sum(weight * omega**2))
    cost = float(np.sum(weight * (b.omega - scale * omega) ** 2))
    cost += float(np.sum((b.growth_rate - growth) ** 2 / (b.growth_rate_sd**2 + (0.02 * b.omega) ** 2)))
    theta[0] *= scale
    theta[-2] = data.anchor_phase[0] - float(b.omega[0]) * data.anchor_time[0]
    return cost, theta


def bends(model: Model, data: Data) -> Shape:
    """Bends of a polynomial backbone from the measured one by weighted least squares; harmonics start from none."""
    b = data.measured
    terms = model.size - model.rates - 2
    weight = 1 / np.sqrt(b.omega_sd**2 + (1e-4 * b.omega) ** 2)
    powers = ((b.amplitude / data.length) ** 2)[:, None] ** np.arange(terms) * weight[:, None]
    solution, *_ = np.linalg.lstsq(powers, b.omega * weight, rcond=None)
    return (*(float(x) for x in np.clip(solution[1:] / solution[0], -2.9, 2.9)), 0.0, 0.0, 0.0)


def first_rates(model: Model, data: Data) -> list[float]:
    """Loss rates from the measured growth rate: its weighted mean, or a line in a, a^2 or 1/a."""
    if not model.rates:
        return []
    b = data.measured
    a, loss = b.amplitude / data.length, -2 * b.growth_rate
    columns = [np.ones_like(a)]
    if model.law == DampingLaw.QUADRATIC:
        columns.append(8 / (3 * np.pi) * a)
    elif model.law == DampingLaw.CUBIC:
        columns.append(0.75 * a**2)
    elif model.law == DampingLaw.COULOMB:
        columns.append(4 / (np.pi * a))
    weight = 1 / np.maximum(b.growth_rate_sd, 1e-3 * np.abs(loss).max() + np.finfo(float).tiny)
    matrix = np.array(columns).T * weight[:, None]
    solution, *_ = np.linalg.lstsq(matrix, loss * weight, rcond=None)
    return [float(x) for x in solution]


def bounds(model: Model, data: Data) -> tuple[Array, Array]:
    """Bounds on theta: shapes as the model says, rates relative to the frequency, k within a factor of 3."""
    omega = float(np.median(data.measured.omega))
    shapes = model.size - model.rates
    low = [omega / 3, *model.lower[:shapes], *(omega * x for x in model.lower[shapes:]), np.log(0.01), -np.inf, -1.0]
    high = [omega * 3, *model.upper[:shapes], *(omega * x for x in model.upper[shapes:]), np.log(1.45), np.inf, 1.0]
    return np.array(low), np.array(high)


def units_of(model: Model, data: Data) -> Array:
    """What theta is counted in: k and rates in the measured frequency, so that no unit of time is in a fit's steps."""
    omega, shapes = float(np.median(data.measured.omega)), model.size - model.rates
    return np.array([omega, *[1.0] * shapes, *[omega] * model.rates, 1.0, 1.0, 1.0])


def refined(model: Model, data: Data, start: Array) -> Fit:
    """Anchors first, samples then."""
    low, high = bounds(model, data)
    units = units_of(model, data)
    inside = low + 1e-6 * np.where(np.isfinite(low), np.abs(low) + 1e-3 * units, 0.0)
    theta = np.clip(start, inside, high * (1 - 1e-9))
    shown = np.flatnonzero(shown_by_anchors(model))

    def anchors(part: Array) -> Array:
        whole = theta.copy()
        whole[shown] = part * units[shown]
        flow = model.flow(whole[:-2], float(data.anchor_time[-1]))
        at = motion(flow, level_at(flow, whole[-3]), whole[-2], data.anchor_time, waveform=False)
        phase = at.phase - data.anchor_phase
        return np.concatenate((phase, np.log(at.amplitude) - data.anchor_log)) * np.tile(data.anchor_weight, 2)

    try:
        near, begin = (low[shown] / units[shown], high[shown] / units[shown]), theta[shown] / units[shown]
        rough = least_squares(anchors, begin, bounds=near, x_scale="jac", max_nfev=NEAR_STEPS, ftol=COARSE)
    except (InputError, ValueError, FloatingPointError, np.linalg.LinAlgError):
        return failed(model, data, start)
    theta[shown] = rough.x * units[shown]
    if model.mirror is not None:
        sides = [theta, np.clip(model.mirror(theta), low, high)]
        theta = min(sides, key=lambda side: residual_variance(model, data, side))
    return by_samples(model, data, theta, COARSE)


def shown_by_anchors(model: Model) -> Mask:
    """Which of theta phases and amplitudes show: not the offset, nor what only shapes the wave."""
    shown = np.ones(model.size + 4, dtype=np.bool_)
    shown[-1] = False
    shapes = 1 + model.size - model.rates
    shown[shapes - model.forms : shapes] = False
    return shown


def residual_variance(model: Model, data: Data, theta: Array) -> float:
    """Variance of the samples less the model: the offset is free."""
    return float(np.var((model.signal(theta, data.time) - data.x)[data.kept]))


def failed(model: Model, data: Data, theta: Array) -> Fit:
    """What stands for a fit that did not converge: an infinite residual, never the best."""
    return Fit(model, theta, np.full(int(data.kept.sum()), np.inf), np.eye(theta.size))


def by_samples(model: Model, data: Data, theta: Array, tolerance: float) -> Fit:
    """Least squares of the samples less the model."""
    units, signal = units_of(model, data), model.signals(data.time)
    low, high = bounds(model, data)
    limits = low / units, high / units

    def samples(values: Array) -> Array:
        return np.asarray((signal(values * units) - data.x)[data.kept])

    try:
        begin = np.clip(theta / units, *limits)
        fine = least_squares(samples, begin, bounds=limits, x_scale="jac", max_nfev=STEPS, ftol=tolerance)
        jacobian = seen(samples, np.asarray(fine.x), np.asarray(fine.jac), limits)
    except (InputError, ValueError, FloatingPointError, np.linalg.LinAlgError):
        return failed(model, data, theta)
    return Fit(model, fine.x * units, np.asarray(fine.fun), spread_of(jacobian) * np.outer(units, units))


def seen(samples: Callable[[Array], Array], theta: Array, jacobian: Array, limits: tuple[Array, Array]) -> Array:
    """The Jacobian with differences over longer steps where short ones show nothing, as at the least of all losses."""
    found = jacobian.copy()
    for i in np.flatnonzero(np.abs(jacobian).max(axis=0) < FLAT):
        away = theta.copy()
        step = LONG_STEP * min(float(limits[1][i] - limits[0][i]), 1.0)
        away[i] += step if theta[i] + step <= limits[1][i] else -step
        found[:, i] = (samples(away) - samples(theta)) / (away[i] - theta[i])
    return found


def spread_of(jacobian: Array) -> Array:
    """(J^T J)^-1, with columns that the data do not see left with a large variance instead of a singular matrix."""
    size = np.sqrt((jacobian**2).sum(axis=0))
    size = np.where(size > 0, size, 1e-12)
    normal = (jacobian / size).T @ (jacobian / size)
    inverse = np.linalg.inv(normal + 1e-13 * np.eye(size.size))
    return np.asarray(inverse / np.outer(size, size))
