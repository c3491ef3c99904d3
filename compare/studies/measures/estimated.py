"""The ways to omega0(t) of a motion that see its samples alone, by name, in seeded white noise."""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from ridgeback.compare.benchmark.ways.outsiders import outsiders
from ridgeback.compare.benchmark.ways.own_correction import corrected
from ridgeback.compare.motion.estimate_curves import along
from ridgeback.compare.noise.monte_carlo import SCOPED
from ridgeback.compare.studies.measures.along import Case
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.estimators.estimate import ESTIMATORS, estimate
from ridgeback.numeric.tracking.choices import Scope
from ridgeback.numeric.tracking.track import Track

OWN_BIAS = "own-bias"
"""Behind a method's name: the bias that it shows on the signal of its own track is taken off."""
OUTSIDERS = outsiders()
"""Estimators of other packages, which a worker must have, too."""
ESTIMATES = (
    *ESTIMATORS,
    *(f"{SCOPED}/{scope}" for scope in tuple(Scope)),
    *(f"{name}/{OWN_BIAS}" for name in ESTIMATORS if name != SCOPED),
    *OUTSIDERS,
)


def noisy(x: Array, snr_db: float, seed: int, trial: int) -> Array:
    """The record of one trial; the signal itself where the ratio is infinite.

    >>> x = np.sin(np.arange(1000.0))
    >>> round(float(np.std(noisy(x, 20.0, 1, 0) - x) / np.std(x)), 2), noisy(x, math.inf, 1, 0) is x
    (0.1, True)
    """
    if snr_db == math.inf:
        return x
    key = (seed, round(1000 * (snr_db + 1000)), trial)
    size = float(np.std(x)) * 10 ** (-snr_db / 20)
    return np.asarray(x + size * np.random.default_rng(key).standard_normal(x.size))


def estimated(case: Case, method: str, x: Array) -> Array:
    """omega0 on the samples of a motion by an estimator that sees ``x`` alone.  Raises InputError as it does."""
    rate = case.motion.trajectory.rate
    if method in OUTSIDERS:
        return along(OUTSIDERS[method](x, rate), case.time)
    name, _, how = method.partition("/")
    run = partial(_plain, rate=rate, method=name, scope=how if how and how != OWN_BIAS else None)
    track = run(x)
    if how == OWN_BIAS:
        track = corrected(track, run, x, rate)
    return along(track, case.time)


def _plain(x: Array, rate: float, method: str, scope: str | None) -> Track:
    if scope is None:
        return estimate(x, rate, method=method, bias=False)
    return estimate(x, rate, method=method, bias=False, scope=Scope(scope))
