"""Error norms of a frequency track, relative to a reference, by zone.

The interior is 10 % .. 90 % of the duration (2 s .. 18 s in the paper's case); the start and end zones are
the rest.  The error is ``omega(t) / omega_ref(t) - 1`` at the curve's own samples wherever both are valid: a
reference made of whole cycles begins half a cycle after the signal does, and nothing is said about what it
does not cover.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ridgeback.compare.motion.results import Curve, Score
from ridgeback.numeric.arrays import Array, Mask

Reference = Callable[[Array], Array]
"""The reference frequency at given times, NaN where it says nothing."""

BORDER = 0.1
"""Fraction of the duration that counts as border at either end."""


@dataclass(frozen=True)
class Zones:
    """Start zone, interior and end zone of a time span: [first, lower), [lower, upper], (upper, last]."""

    first: float
    lower: float
    upper: float
    last: float

    def interior(self, time: Array) -> Mask:
        """Where ``time`` lies in the interior."""
        return np.asarray((time >= self.lower) & (time <= self.upper))

    def start(self, time: Array) -> Mask:
        """Where ``time`` lies before the interior."""
        return np.asarray((time >= self.first) & (time < self.lower))

    def end(self, time: Array) -> Mask:
        """Where ``time`` lies after the interior."""
        return np.asarray((time > self.upper) & (time <= self.last))


def zones(first: float, last: float, *, border: float = BORDER) -> Zones:
    """Zones of the span from ``first`` to ``last``.

    >>> zones(0.0, 20.0)
    Zones(first=0.0, lower=2.0, upper=18.0, last=20.0)
    """
    margin = border * (last - first)
    return Zones(first, first + margin, last - margin, last)


def rms(values: Array) -> float | None:
    """Root mean square of the finite values; None when there are none.

    >>> rms(np.array([3.0, 4.0, np.nan]))
    3.5355339059327378
    """
    kept = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(kept**2))) if kept.size else None


def worst(values: Array) -> float | None:
    """Largest magnitude among the finite values; None when there are none."""
    kept = values[np.isfinite(values)]
    return float(np.max(np.abs(kept))) if kept.size else None


def mean(values: Array) -> float | None:
    """Mean of the finite values, sign kept; None when there are none."""
    kept = values[np.isfinite(values)]
    return float(np.mean(kept)) if kept.size else None


def relative_error(curve: Curve, reference: Reference) -> Array:
    """Signed relative error at the curve's samples; NaN where the curve or the reference is not valid."""
    expected = reference(curve.time)
    with np.errstate(invalid="ignore", divide="ignore"):
        error = curve.omega / expected - 1.0
    return np.asarray(np.where(curve.valid & np.isfinite(error), error, np.nan))


def score(curve: Curve, reference: Reference, zone: Zones) -> Score:
    """Norms of one curve in the three zones."""
    error = relative_error(curve, reference)
    inside = error[zone.interior(curve.time)]
    return Score(
        method=curve.name,
        label=curve.label,
        kind=curve.kind,
        rms_interior=rms(inside),
        max_interior=worst(inside),
        mean_interior=mean(inside),
        rms_start=rms(error[zone.start(curve.time)]),
        rms_end=rms(error[zone.end(curve.time)]),
        note=curve.note,
    )


def failure(name: str, label: str, reason: str) -> Score:
    """Score of an estimate that gave nothing; the reason is kept and shown."""
    return Score(name, label, "estimate", None, None, None, None, None, failed=reason)


def distance(first: Curve, second: Curve) -> float | None:
    """Relative rms difference of two tracks at the times of the second where both are valid; None without any.

    >>> t = np.arange(5.0)
    >>> one = Curve("", "", "estimate", t, np.full(5, 2.0), t >= 0)
    >>> distance(one, Curve("", "", "estimate", t, np.full(5, 2.2), t >= 0)).__round__(12)
    0.1
    """
    own = first.time[first.valid]
    keep = second.valid & (second.time >= own[0]) & (second.time <= own[-1]) if own.size else second.valid & False
    if not keep.any():
        return None
    expected = np.interp(second.time[keep], own, first.omega[first.valid])
    return float(np.sqrt(np.mean((second.omega[keep] / expected - 1) ** 2)))
