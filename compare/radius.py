"""Radius of convergence read off the last coefficients, with an uncertainty, or nothing.

Ratio method with linear extrapolation in 1/m (Domb and Sykes 1957; Van Dyke 1974): near a singularity of type
(1 - x/x_c)^p the ratios obey c_m / c_(m-1) = (1 - (1 + p)/m) / x_c + ..., so m r_m - (m - 1) r_(m-1) tends to
1/x_c faster than r_m does.  Only one real singularity nearest to the origin gives such ratios; when they do not
settle (a complex pair makes them oscillate) no radius is claimed.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

MIN_TERMS = 6
TRUSTED = 0.1
"""Largest relative uncertainty that is still handed out."""


@dataclass(frozen=True)
class Radius:
    """Estimate of a radius of convergence, in the variable of the series."""

    value: float
    uncertainty: float


def convergence_radius(coefficients: Sequence[float]) -> Radius | None:
    """Radius of a power series from its coefficients c_0, c_1, ...; None when they do not settle it.

    The uncertainty is the largest of: the change over the last three extrapolants, and their distance from the
    last plain ratio (which bounds what the extrapolation assumes).

    >>> geometric = [0.25**n for n in range(20)]
    >>> convergence_radius(geometric)
    Radius(value=4.0, uncertainty=0.0)
    """
    step, series = _stripped(coefficients)
    if len(series) < MIN_TERMS or 0.0 in series[-MIN_TERMS:]:
        return None
    ratios = [series[m] / series[m - 1] for m in range(len(series) - 4, len(series))]
    if len({math.copysign(1.0, ratio) for ratio in ratios}) > 1:
        return None
    m = np.arange(len(series) - 4, len(series))
    sizes = np.abs(ratios)
    extrapolated = m[1:] * sizes[1:] - m[:-1] * sizes[:-1]
    if not (extrapolated > 0).all():
        return None
    radii = extrapolated ** (-1.0 / step)
    value, plain = float(radii[-1]), float(sizes[-1] ** (-1.0 / step))
    uncertainty = max(float(np.ptp(radii)), abs(value - plain))
    return Radius(value, uncertainty) if uncertainty <= TRUSTED * value else None


def _stripped(coefficients: Sequence[float]) -> tuple[int, list[float]]:
    """Return the spacing of the nonzero powers (1 or 2) and the coefficients at that spacing."""
    odd = [c for c in coefficients[1::2] if c != 0]
    return (1, list(coefficients)) if odd else (2, list(coefficients[::2]))
