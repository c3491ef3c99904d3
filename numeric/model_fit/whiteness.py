"""Is a residual white?  The portmanteau test on its autocorrelation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import chdtrc

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array

MOST_LAGS = 40


@dataclass(frozen=True)
class Whiteness:
    """``statistic`` is chi-square distributed with ``lags`` degrees of freedom for white noise."""

    statistic: float
    lags: int
    probability: float
    """How often white noise would show as much correlation, or more."""
    first: float
    """Correlation of neighbours."""


# Q = n (n + 2) sum over lags of r_m^2 / (n - m), r the autocorrelation (Ljung and Box, Biometrika 65 (1978) 297).
def whiteness(residual: Array, *, lags: int = 20) -> Whiteness:
    """Test the autocorrelation of a residual at ``lags`` lags, at most MOST_LAGS and a fifth of its samples.

    Raises InputError for fewer than 10 samples, and for a residual that is constant.

    >>> noise = np.random.default_rng(1).standard_normal(400)
    >>> whiteness(noise).probability > 0.01, whiteness(noise + np.sin(np.arange(400))).probability < 1e-9
    (True, True)
    """
    n = residual.size
    if n < 10:
        raise InputError(f"residual has {n} samples; 10 are needed to judge whether it is white")
    centred = residual - residual.mean()
    power = float(centred @ centred)
    if not power > 0.0:
        raise InputError("residual is constant; there is nothing to judge")
    count = max(1, min(lags, MOST_LAGS, n // 5))
    r = np.array([float(centred[m:] @ centred[:-m]) for m in range(1, count + 1)]) / power
    statistic = float(n * (n + 2) * np.sum(r**2 / (n - np.arange(1, count + 1))))
    return Whiteness(statistic, count, float(chdtrc(count, statistic)), float(r[0]))
