"""The frequency of an integrated solution, read off its zero crossings and turning points.

Two values are given.  The *cycle average* 2 pi / (t_(i+2) - t_i), placed at the middle of the cycle, is what a counter
measures; it is the mean of omega over the cycle and differs from the instantaneous value by its curvature,

    mean of omega = omega + omega'' T^2 / 24 + O(T^4).

The *instantaneous* value removes this bias: located events have known phases, and their times as a smooth function of
phase, t(phi), are interpolated by a spline on these equidistant phases; omega = 1 / t'(phi).

In a symmetric oscillator the events are the zero crossings, pi apart.  In an asymmetric one the phase phi_0 of a
crossing depends on the amplitude, so that crossings of one direction alone would be wrong by (d phi_0 / dA) A', of
first order in the damping, and those of the other direction by as much with the other sign.  The centre between an
upward and the next downward crossing is free of it; these centres, 2 pi apart, are the events then.

A second reading, from the other families of events (turning points, centres of the lower half swings), differs from the
first by what a damped oscillation leaves undefined, of relative order (mu/k)^2, and by interpolation error; this spread
is part of the uncertainty.  Beyond its outermost events the spline is continued by at most 0.6 of their spacing, which
reaches a start or an end at a turning point; its error estimate grows accordingly.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import BSpline, make_interp_spline

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, Mask, frozen
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.numeric.motion.events import CrossingEvents
from ridgeback.numeric.motion.roots import bracketed_newton
from ridgeback.numeric.motion.trajectory import Trajectory

_DEGREE = 7
_LEAST_EVENTS = 4
_REACH = 0.6  # of the spacing of the events, beyond the first and the last


@dataclass(frozen=True)
class PhaseReading:
    """Event times at equidistant phases ``step * i``, and the splines t(i) of two degrees through them."""

    name: str
    time: Array
    step: float
    spline: BSpline
    lower: BSpline

    def omega(self, t: Array) -> Array:
        """Return omega = step / t'(i) at times within the events."""
        return np.asarray(self.step / self.spline.derivative()(self._index(t)))

    def interpolation_error(self, t: Array) -> Array:
        """Return the difference from the spline of degree lower by two, which is the less accurate one."""
        index = self._index(t)
        return np.abs(self.step / self.spline.derivative()(index) - self.step / self.lower.derivative()(index))

    def phase(self, t: Array) -> Array:
        """Return the phase since the first event."""
        return self.step * self._index(t)

    def covers(self, t: Array) -> Mask:
        """Tell which times lie between the first and the last event, or within reach of them."""
        start, stop = self.span
        return np.asarray((t >= start) & (t <= stop))

    @property
    def span(self) -> tuple[float, float]:
        """The first and last time within reach."""
        return float(self.spline(-_REACH)), float(self.spline(self.time.size - 1 + _REACH))

    def _index(self, t: Array) -> Array:
        slope, last = self.spline.derivative(), self.time.size - 1
        guess = np.interp(t, self.time, np.arange(self.time.size))
        low, high = np.maximum(guess - 1, -_REACH), np.minimum(guess + 1, last + _REACH)
        return bracketed_newton(lambda i: (self.spline(i) - t, slope(i)), low, high, guess=guess, rising=True)


class Events(StrEnum):
    """Whose times are read: crossings, pi apart (symmetric oscillators), or centres between them, 2 pi apart."""

    CROSSINGS = "crossings"
    CENTRES = "centres"


@dataclass(frozen=True)
class CycleFrequency:
    """Cycle averages in order of time, and the instantaneous frequency between the events.

    ``uncertainty`` estimates the systematic difference of each cycle average from the instantaneous value at the
    same time (its curvature bias); that of ``at`` is ``uncertainty_at``.
    """

    time: Array
    omega: Array
    uncertainty: Array
    kind: Events
    span: tuple[float, float]
    """First and last time at which ``at`` gives a value."""
    readings: tuple[PhaseReading, ...]

    def at(self, time: ArrayLike) -> Array:
        """Return omega at ``time`` (1-D): from the first reading that covers it; NaN where none does."""
        return self._first_reading(time, lambda reading, t: reading.omega(t))

    def uncertainty_at(self, time: ArrayLike) -> Array:
        """Return the error estimate of ``at``: interpolation, plus the spread of the readings; NaN where none reach."""
        return np.asarray(self.interpolation_error_at(time) + self.spread_at(time))

    def interpolation_error_at(self, time: ArrayLike) -> Array:
        """Return how well the reading that ``at`` takes is interpolated: the numerical error of the reference."""
        return self._first_reading(time, lambda reading, t: reading.interpolation_error(t))

    def _first_reading(self, time: ArrayLike, value: Callable[[PhaseReading, Array], Array]) -> Array:
        """What the first reading that covers each time says; NaN where none does."""
        t = np.atleast_1d(np.asarray(time, dtype=float))
        found = np.full_like(t, np.nan)
        for reading in reversed(self.readings):
            inside = reading.covers(t)
            found[inside] = value(reading, t[inside])
        return found

    def spread_at(self, time: ArrayLike) -> Array:
        """Return how far the readings differ: how well the omega0(t) of a decay is defined at all.

        Where a reading does not reach, its difference is taken at the nearest time it does.
        """
        t = np.atleast_1d(np.asarray(time, dtype=float))
        spread = np.zeros_like(t)
        for reading in reversed(self.readings):
            nearest = np.clip(t, *reading.span)
            spread = np.fmax(spread, np.abs(reading.omega(nearest) - self.at(nearest)))
        return spread


def cycle_frequency(trajectory: Trajectory, *, dynamics: Dynamics | None = None) -> CycleFrequency:
    """Return the frequency of a trajectory from its located events.

    Parameters
    ----------
    trajectory : Trajectory
        The motion.
    dynamics : Dynamics, optional
        The oscillator, which is asked whether it is symmetric, f(-u, -u') = -f(u, u'); without, the centres between
        crossings are used, which is right for both.

    Returns
    -------
    CycleFrequency
        Averages over cycles, and the instantaneous frequency between the events, rad per time unit.

    Raises
    ------
    InputError
        With fewer than 4 events.

    Examples
    --------
    >>> from ridgeback.numeric.motion.dynamics import linear
    >>> from ridgeback.numeric.motion.trajectory import integrate
    >>> oscillator = linear(k=3.0)
    >>> cycles = cycle_frequency(integrate(oscillator, (1.0, 0.0), duration=10.0, rate=8.0), dynamics=oscillator)
    >>> bool(np.allclose(cycles.omega, 3.0, rtol=1e-11)), bool(abs(cycles.at(0.0)[0] - 3.0) < 1e-9)
    (True, True)
    """
    symmetric = dynamics is not None and is_symmetric(dynamics, largest=float(np.abs(trajectory.u).max()))
    families = _families(trajectory, symmetric)
    readings = tuple(_reading(*family) for family in families if family[1].size >= _LEAST_EVENTS)
    if not readings:
        most = max(family[1].size for family in families)
        raise InputError(
            f"{trajectory.name}: {most} zero crossings or turning points are too few for a frequency; "
            f"{_LEAST_EVENTS} are needed: use a longer duration"
        )
    time, omega = _averages(trajectory, symmetric)
    start, stop = min(r.span[0] for r in readings), max(r.span[1] for r in readings)
    span = (max(start, 0.0), min(stop, trajectory.duration))
    kind = Events.CROSSINGS if symmetric else Events.CENTRES
    draft = CycleFrequency(time, omega, np.zeros_like(omega), kind, span, readings)
    return CycleFrequency(
        time=frozen(time),
        omega=frozen(omega),
        uncertainty=frozen(np.abs(draft.at(time) - omega)),
        kind=kind,
        span=span,
        readings=readings,
    )


def is_symmetric(dynamics: Dynamics, *, largest: float = 1.0) -> bool:
    """Tell whether f(-u, -u') = -f(u, u'), checked at a few states of different size, up to the largest |u| and at 1.

    >>> from ridgeback.numeric.motion.dynamics import helmholtz_duffing, van_der_pol
    >>> is_symmetric(van_der_pol(1.0)), is_symmetric(helmholtz_duffing())
    (True, False)
    """
    k = dynamics.natural_frequency
    states = [(0.3, 0.2 * k), (1.0, -0.7 * k), (-0.05, 0.01 * k), (0.6, 0.0)]
    states += [(share * largest, 0.02 * share * k * largest) for share in (1.0, 0.9, 0.6, 0.3)]
    try:
        pairs = [(dynamics.force(u, v), dynamics.force(-u, -v)) for u, v in states]
    except (ValueError, OverflowError, ZeroDivisionError):
        return False  # f is not even defined at both
    return all(abs(a + b) <= 1e-12 * (abs(a) + abs(b)) for a, b in pairs)


def _families(trajectory: Trajectory, symmetric: bool) -> list[tuple[str, Array, float]]:
    """Name, times and phase step of each family of events, the preferred one first."""
    crossings, turnings = trajectory.crossings, trajectory.turnings
    if symmetric:
        return [("crossings", crossings.time, math.pi), ("turning points", turnings.time, math.pi)]
    upper, lower = _centres(crossings)
    return [
        ("centres of upper half swings", upper, 2 * math.pi),
        ("centres of lower half swings", lower, 2 * math.pi),
        ("peaks", turnings.time[turnings.value > 0], 2 * math.pi),
        ("troughs", turnings.time[turnings.value < 0], 2 * math.pi),
    ]


def _centres(crossings: CrossingEvents) -> tuple[Array, Array]:
    """Times half way from each crossing to the next: of the half swings above and below zero."""
    middle = 0.5 * (crossings.time[:-1] + crossings.time[1:])
    above = crossings.rising[:-1]
    return middle[above], middle[~above]


def _reading(name: str, time: Array, step: float) -> PhaseReading:
    degree = min(_DEGREE, 2 * ((time.size - 2) // 2) + 1)
    index = np.arange(time.size, dtype=float)
    return PhaseReading(
        name,
        time,
        step,
        make_interp_spline(index, time, k=degree),
        make_interp_spline(index, time, k=max(1, degree - 2)),
    )


def _averages(trajectory: Trajectory, symmetric: bool) -> tuple[Array, Array]:
    """Full cycles: every crossing to the next but one, or every centre to the next of its kind."""
    if symmetric:
        crossings = trajectory.crossings.time
        pairs = [(crossings[:-2], crossings[2:])]
    else:
        pairs = [(centres[:-1], centres[1:]) for centres in _centres(trajectory.crossings)]
    start, stop = (np.concatenate(x) for x in zip(*pairs, strict=True))
    order = np.argsort(start)
    return 0.5 * (start + stop)[order], 2 * math.pi / (stop - start)[order]
