"""The orbit of a family through a given peak, integrated over one cycle at high precision by Taylor series.

For forces with terms in u' that neither dissipate nor leave an energy of a known form: the period is read from the
integrated solution itself, and the orbit must return to the peak that it began at.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import mpmath as mp

from ridgeback.common.errors import InputError
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.numeric.motion.taylor import PreciseEvent, taylor_solution

DIGITS: Final = 20
CLOSED: Final = 1e-13
"""Relative distance between two peaks below which an orbit counts as closed."""
DURATIONS: Final = (1.2, 2.0, 4.0, 16.0, 64.0)
"""Durations tried until the orbit has come back, in natural periods."""


@dataclass(frozen=True)
class ClosedOrbit:
    """Frequency in rad per time unit, its relative error, and the lower turning point (negative)."""

    omega: float
    relative_error: float
    trough: float


def closed_orbit(dynamics: Dynamics, peak: float) -> ClosedOrbit:
    """Integrate from rest at u = ``peak`` until u' vanishes at a peak again.

    Parameters
    ----------
    dynamics : Dynamics
        The oscillator with numbers; it must give its Taylor coefficients (``jet``).
    peak : float
        The positive turning point, in the unit of u.

    Returns
    -------
    ClosedOrbit
        The period is known to about 20 digits, so that the error is that of a float, and the distance by which the
        orbit misses its start.

    Raises
    ------
    InputError
        When the motion does not come back within 64 natural periods, or comes back to another peak.

    Examples
    --------
    >>> from ridgeback.numeric.motion.dynamics import duffing
    >>> found = closed_orbit(duffing(eps=1.0), 1.0)
    >>> round(found.omega, 12), found.trough
    (1.317776064966, -1.0)
    """
    natural = 2 * math.pi / dynamics.natural_frequency
    for factor in DURATIONS:
        solution = taylor_solution(dynamics, (peak, 0.0), duration=factor * natural, digits=DIGITS)
        found = _cycle(solution.turnings())
        if found is not None:
            return _closed(dynamics, peak, *found)
    raise InputError(
        f"{dynamics.name}: from rest at u = {peak:.6g} the motion does not come back to a peak within "
        f"{DURATIONS[-1]:g} natural periods; use a smaller amplitude"
    )


def _cycle(turnings: tuple[PreciseEvent, ...]) -> tuple[PreciseEvent, PreciseEvent] | None:
    """The first turning point below zero, and the first above it after that."""
    low = next((i for i, event in enumerate(turnings) if event.u < 0), len(turnings))
    high = next((event for event in turnings[low:] if event.u > 0), None)
    return None if high is None else (turnings[low], high)


def _closed(dynamics: Dynamics, peak: float, low: PreciseEvent, high: PreciseEvent) -> ClosedOrbit:
    gap = abs(float((high.u - mp.mpf(peak)) / mp.mpf(peak)))
    if not gap < CLOSED:
        raise InputError(
            f"{dynamics.name}: the orbit from rest at u = {peak:.6g} does not close, it comes back to "
            f"{float(high.u):.10g}; it gains or loses energy, and no frequency belongs to an amplitude"
        )
    return ClosedOrbit(float(2 * mp.pi / high.time), gap + 2.0**-52, float(low.u))
