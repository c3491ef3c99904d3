"""The bias and the deviation of an estimator on the signal at hand, and the 95 % interval of both.

The signal is modelled as a whole by harmonic least squares (``harmonics.spline_fit``).  The model's samples are a
clean signal whose frequency is known, much like the one measured.

- Bias: the estimator run on the clean signal, less the model's frequency.  Curvature to all orders, harmonics, borders,
  and whatever else the estimator suffers from are in it.
- Deviation: the estimator run on the clean signal with white noise added, a few times over (a parametric bootstrap:
  Efron and Tibshirani, An Introduction to the Bootstrap, 1993, ch. 6), from a stated seed.
- Deviation of the corrected values.  With P the projection of the model's fit, the corrected estimate is that of the
  model plus the estimator's answer to the residual (I - P) noise; both parts are replicated from the same noise.  It is
  scaled so that 95 % of the copies lie inside; where a peak jumps in too many of them, no interval is claimed.
- Model: the same correction by a model on fewer knots.  Where the two differ by more than noise explains, the share of
  the difference that should be left in the finer one, by the order at which the models converge, counts as one sigma.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import make_interp_spline
from scipy.ndimage import median_filter, uniform_filter1d
from scipy.special import stdtrit

from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.harmonics.signal_model import SignalModels
from ridgeback.numeric.harmonics.spline_fit import ROUNDED
from ridgeback.numeric.harmonics.spline_model import SplineModel
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.tracking.request import Request
from ridgeback.numeric.tracking.track import NORMAL_95, Track

SEED = 20031
ENOUGH = 64
"""Independent windows wanted among all replicates: their deviation is then known to 9 %."""
MOST_REPLICATES, FEWEST_REPLICATES = 24, 4
VERY_MANY = 1500.0
"""Windows in a record from which on two replicates tell as much as four do of a shorter one."""
INDEPENDENT = 0.5
"""Share of a tapered window after which its estimates are as good as independent."""
POOLED_SHARE = 0.25
"""Share of the record over which replicates are pooled."""
MOST_JUMPS = 0.02
"""Share of the noisy copies' valid values that may be outliers; with more of them a method claims no interval."""
FAR, MEDIAN_OF_SQUARE = 3.0, 0.4549
"""Sigmas beyond which an error is an outlier, and the median of the square of a standard normal variable."""
AMBIGUOUS = 0.1
"""Relative change of omega per cycle above which omega(t) is flagged as ambiguous."""
ROOM = 0.2
"""What the definition leaves open there: this times the square of that change (found between the readings of crossings
and of turning points of the pendulum near its separatrix: 0.17 to 0.33)."""


@dataclass(frozen=True)
class Trial:
    """An estimator as a function of the samples alone, read at fixed times, and what it should give on a model."""

    time: Array
    run: Callable[[Array], Array]
    multiple: int = 1
    efficient: bool = False
    """Whether the track's own deviation is exact, as that of a least-squares fit is."""

    def truth(self, model: SplineModel, change: Array | None = None) -> Array:
        """The model's frequency at the times of the trial."""
        omega = model.tone(self.multiple, change)[0]
        if np.array_equal(self.time, model.time):
            return omega
        return np.asarray(make_interp_spline(model.time, omega, k=3)(self.time), dtype=np.float64)

    def bias(self, model: SplineModel) -> Array:
        """The estimator on the model's samples, less the model's frequency."""
        return self.run(model.samples()) - self.truth(model)


def trial_of(estimator: Callable[[Request], Track], request: Request, track: Track) -> Trial:
    """The trial of one of the estimators, with what ``track`` chose from the data fixed, read at its times."""
    fixed = request.like(track.used)

    def run(x: Array) -> Array:
        found = estimator(fixed.on(x))
        return np.asarray(np.interp(track.time, found.time, found.omega), dtype=np.float64)

    return Trial(track.time - request.signal.start, run, efficient=track.used.scope is not None)


@dataclass(frozen=True)
class Replicates:
    """Errors of the plain and of the corrected estimate in replicated noise, and of the models' difference."""

    plain: Array
    corrected: Array
    between: Array


def replicated(trial: Trial, models: SignalModels, clean: Array, count: int) -> Replicates:
    """Run the trial on ``count`` noisy copies of the finer model; ``clean`` is what it gives without noise."""
    rng, fine, coarse = np.random.default_rng(SEED), models.fine, models.coarse
    samples, truth, truth_coarse = fine.samples(), trial.truth(fine), trial.truth(coarse)
    plain, corrected, between = (np.empty((count, trial.time.size)) for _ in range(3))
    for i in range(count):
        noise = fine.band_noise * rng.normal(size=samples.size)
        change, taken = fine.response(noise)
        moved = trial.truth(fine, change) - truth
        plain[i] = 0.0 if trial.efficient else trial.run(samples + noise) - clean
        corrected[i] = moved + trial.run(samples + noise - taken) - clean
        between[i] = moved - (trial.truth(coarse, coarse.response(noise)[0]) - truth_coarse)
    return Replicates(plain, corrected, between)


# A peak that jumps to a cross term now and then is far off for a few samples, and its root mean square says little of
# the rest: errors beyond three sigma, as the median of the replicates has it, count as three.
def pooled(errors: Array, shape: Array, width: int) -> Array:
    """Root mean square over replicates and over ``width`` neighbours, of errors relative to ``shape``, times it.

    >>> pooled(np.full((2, 4), 3.0), np.array([1.0, 1.0, 2.0, 2.0]), 1).tolist()
    [3.0, 3.0, 3.0, 3.0]
    """
    share = np.square(errors / shape)
    typical = moving_mean(np.median(share, axis=0), width) / MEDIAN_OF_SQUARE
    return shape * np.sqrt(moving_mean(np.minimum(share, FAR**2 * typical).mean(axis=0), width))


def calibrated(errors: Array, sigma: Array, valid: Mask) -> Array:
    """``sigma`` scaled so that 95 % of the replicated errors at the valid times lie within 1.96 of it.

    Where jumps are more than rare, it takes them in; where a few of them widened it, it becomes narrower again.

    >>> calibrated(np.array([[0.0, 1.0, 2.0, 9.0]]), np.ones(4), np.array([True, True, True, False])).round(3).tolist()
    [0.969, 0.969, 0.969, 0.969]
    """
    ratio = np.abs(errors / sigma)[:, valid if valid.any() else ~valid]
    return np.asarray(sigma * (float(np.quantile(ratio, 0.95)) / NORMAL_95), dtype=np.float64)


def moving_mean(values: Array, width: int) -> Array:
    """Mean over ``width`` neighbours, the end values held beyond the ends; 0 where it is negative.

    >>> moving_mean(np.array([0.0, 3.0, 0.0, -9.0]), 3).tolist()
    [1.0, 1.0, 0.0, 0.0]
    """
    return np.maximum(uniform_filter1d(values, width, mode="nearest"), 0.0)


def replicates_needed(windows: float) -> int:
    """Few for a long record, which holds many independent windows itself."""
    fewest = FEWEST_REPLICATES if windows < VERY_MANY else 2
    return int(np.clip(math.ceil(ENOUGH / windows), fewest, MOST_REPLICATES))


def with_interval(track: Track, request: Request, trial: Trial, models: SignalModels) -> Track:
    """The track with its bias, both deviations, and so its interval."""
    windows = request.signal.x.size / request.signal.rate / request.plan.lag_seconds
    count = replicates_needed(windows)
    clean = trial.run(models.fine.samples())
    bias = clean - trial.truth(models.fine)
    copies = replicated(trial, models, clean, count)
    noise, total, jumps = deviations(track, trial, copies, models.fine, windows)
    apart = (trial.bias(models.coarse) - bias) ** 2 - copies.between.var(axis=0)
    near = max(1, round(request.plan.lag_seconds / float(np.median(np.diff(track.time)))))
    left = models.remainder**2 * np.maximum(median_filter(apart, near, mode="nearest"), 0.0)
    ambiguous, room = room_of_definition(trial.truth(models.fine), trial.time, models.best)
    how = {
        "model_harmonics": (1, *models.fine.multiples),
        "model_cycles_per_knot": models.fine.cycles,
        "bias_by": "running the method on a model of the signal",
        "deviation_by": f"{count} noisy copies of the model",
        "seed": SEED,
    }
    reason = f"{100 * jumps:.2g} % of the values in noisy copies of the signal are jumps to other peaks"
    unknown = np.sqrt(np.maximum(total**2 - noise**2, 0.0) + left + room**2)
    return replace(
        track,
        standard_deviation=noise,
        bias=bias,
        bias_deviation=None if jumps > MOST_JUMPS else unknown,
        no_interval=reason if jumps > MOST_JUMPS else None,
        ambiguous=ambiguous,
        used=replace(track.used, noise=models.fine.noise),
        details={**track.details, **how},
    )


def deviations(
    track: Track, trial: Trial, copies: Replicates, model: SplineModel, windows: float
) -> tuple[Array, Array, float]:
    """Deviation of the values as given, and of the corrected ones, pooled along time; the share of outliers."""
    width = max(1, round(POOLED_SHARE * track.time.size))
    own = trial.multiple * np.interp(trial.time, model.time, model.omega_deviation)
    analytic = own if track.standard_deviation is None else track.standard_deviation
    floor = ROUNDED * np.abs(track.omega)
    noise = analytic if trial.efficient else pooled(copies.plain, analytic + floor, width)
    freedom = copies.plain.shape[0] * max(1.0, windows * POOLED_SHARE / INDEPENDENT)
    total = pooled(copies.corrected, np.hypot(analytic, own) + floor, width) + floor
    jumps = float(np.mean(np.abs(copies.corrected / total)[:, track.valid] > FAR)) if track.valid.any() else 0.0
    right = few_sample_factor(freedom) * calibrated(copies.corrected, total, track.valid)
    return noise, np.maximum(right, floor), jumps


# Student's t: a deviation that was itself estimated with few degrees of freedom holds 95 % only when it is enlarged.
def few_sample_factor(freedom: float) -> float:
    """How much larger the 97.5 % point of Student's t is than that of the normal distribution.

    >>> round(few_sample_factor(10.0), 3), round(few_sample_factor(1e6), 3)
    (1.137, 1.0)
    """
    return float(stdtrit(freedom, 0.975)) / NORMAL_95


# Any definition of omega(t) of a decay (by crossings, by turning points, by the averaged action) holds to the square of
# the relative change per cycle, 2 pi omega' / omega^2.
def room_of_definition(omega: Array, time: Array, model: SplineModel) -> tuple[Mask, Array]:
    """Where omega(t), at these times, is ambiguous, and there the room that its definitions leave (one sigma)."""
    base = model.tone(1)[0]
    change = np.interp(time, model.time, TWO_PI * np.gradient(base, model.time) / base**2)
    ambiguous = np.abs(change) > AMBIGUOUS
    return ambiguous, np.where(ambiguous, ROOM * change**2 * omega, 0.0)
