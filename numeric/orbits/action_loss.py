"""What a damping force takes from the action of an undamped orbit, averaged over its cycle.

The damping force is d(u, u') = f(u, u') - V'(u), of any form that is odd in u'.  Energy falls as E' = -u' d, and the
mean over the phase of the undamped orbit gives

    J' = -P / omega0,   P = <u' d>,   or   (ln J)' = -R(J),   R = P / (omega0 J)

(Bogoliubov and Mitropolsky, Asymptotic Methods in the Theory of Non-linear Oscillations, 1961).  d = 2 mu u' has
R = 2 mu in any potential, since <u'^2> = omega0 J.  The action J* of the instantaneous energy ripples about J:
J* = J + g(phi), omega0^2 dg/dphi = -(u' d - P), with zero mean over the cycle.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import BarycentricInterpolator

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.numeric.orbits.kinked_orbit import settled_half_orbit
from ridgeback.numeric.orbits.period import FrequencyTable, action, exact_frequency, peak_of_action
from ridgeback.numeric.orbits.potential import peak_limit, peak_of_potential, potential_at, restoring_of
from ridgeback.numeric.orbits.waveform import SETTLED, orbit_harmonics

POINTS = 512
"""Phases over one cycle: the mean of a smooth periodic function converges geometrically in their number."""
HARMONICS = 120
NODES = (17, 33, 65, 129)
"""Chebyshev points in ln J; their number is doubled until R is interpolated to ``ACCURACY``."""
ACCURACY = 1e-9
MOST_SPAN = 16.0
"""ln J below the start at which a motion under dry friction counts as at rest."""
SPAN = 4.0
"""ln J below the start that the first table covers."""
SAME = 1e-9
"""Levels of ln J closer than this are one."""
EDGE = 1 - 1e-6
"""Share of the well's last amplitude up to which a motion that grows is followed."""


Rate = Callable[[Array], Array]
"""R at levels of ln J."""


@dataclass(frozen=True)
class Cycle:
    """One undamped orbit over the phases 2 pi j / POINTS from its peak, and what damping does to it."""

    omega: float
    action: float
    power: Array
    """u' d(u, u') at the phases: the energy lost per time."""
    mean: float
    """P, its mean over the phase."""

    @property
    def rate(self) -> float:
        """R = P / (omega0 J)."""
        return self.mean / (self.omega * self.action)

    def ripple(self, phase: float) -> float:
        """Return g(phase): how far the action of the instantaneous energy lies above the averaged one."""
        spectrum = np.fft.rfft(self.power - self.mean) / POINTS
        m = np.arange(1, spectrum.size)
        terms = spectrum[1:] / (1j * m) * np.exp(1j * m * phase)
        return float(-2 * terms.real.sum() / self.omega**2)


def damping_force(dynamics: Dynamics, u: Array, velocity: Array) -> Array:
    """Return d(u, u') = f(u, u') - V'(u) at states, 1-D arrays of one length."""
    whole = [dynamics.force(x, v) for x, v in zip(u.tolist(), velocity.tolist(), strict=True)]
    return np.asarray(whole) - np.asarray(restoring_of(dynamics)(u))


def require_odd_damping(dynamics: Dynamics, size: float) -> None:
    """Raise InputError unless the force beside V'(u) is odd in u', checked at a few states within ``size`` of rest.

    >>> from ridgeback.numeric.motion.dynamics import pendulum
    >>> require_odd_damping(pendulum(mu=0.1), 1.0)
    """
    k = dynamics.natural_frequency
    u, v = size * np.array([0.1, -0.2, 0.35, 0.5]), k * size * np.array([0.1, 0.3, 0.2, 0.6])
    even = damping_force(dynamics, u, v) + damping_force(dynamics, u, -v)
    if np.any(np.abs(even) > 1e-9 * k * (k * np.abs(u) + np.abs(v))):
        raise InputError(
            f"{dynamics.name}: the force holds velocity terms that do not change sign with u', so V(u) alone does not "
            "set its undamped motion; use the cycle frequency of an integrated trajectory instead"
        )


def cycles_of(dynamics: Dynamics, peaks: Array) -> list[Cycle]:
    """Return undamped orbits by their peak amplitudes, and the power that damping takes along each.

    u is even and u' odd in the phase, so that the power of an odd damping force is even: half a cycle tells it.

    >>> from ridgeback.numeric.motion.dynamics import pendulum
    >>> (cycle,) = cycles_of(pendulum(mu=0.1), np.array([2.0]))
    >>> bool(abs(cycle.rate - 0.2) < 1e-12)
    True
    """
    table = exact_frequency(dynamics, peaks)
    cosine = orbit_harmonics(dynamics, peaks, count=HARMONICS).cosine
    m, phase = np.arange(HARMONICS + 1), np.arange(POINTS // 2 + 1) * (2 * np.pi / POINTS)
    u = np.cos(np.outer(phase, m)) @ cosine
    velocity = -np.sin(np.outer(phase, m)) @ (m[:, None] * cosine) * table.omega
    lost = damping_force(dynamics, u.ravel(), velocity.ravel()).reshape(u.shape) * velocity
    whole = np.concatenate((lost, lost[-2:0:-1]))
    means = whole.mean(axis=0) if dynamics.switches is None else _lost_between_kinks(dynamics, table)
    rows = zip(table.omega, table.action, whole.T, means, strict=True)
    return [Cycle(float(w), float(J), p, float(mean)) for w, J, p, mean in rows]


def _lost_between_kinks(dynamics: Dynamics, table: FrequencyTable) -> Array:
    """P of a force with kinks, the mean of u' d over half a cycle, between the kinks in u."""
    orbit, _ = settled_half_orbit(dynamics, table.trough, table.peak, SETTLED)
    shape = orbit.u.shape
    lost = damping_force(dynamics, orbit.u.ravel(), -orbit.speed.ravel()).reshape(shape)
    return orbit.mean(-orbit.speed * lost)


def averaged_action(dynamics: Dynamics, start: float, time: Array) -> Array:
    """Return J(t) at ``time`` of the averaged motion that has the action ``start`` at time 0.

    Parameters
    ----------
    dynamics : Dynamics
        An oscillator with a potential and a damping force odd in u'.
    start : float
        J at time 0, the averaged one.
    time : ndarray, shape (n,)
        Times in the oscillator's unit, in any order.

    Raises
    ------
    InputError
        Where the motion grows out of the well.

    Examples
    --------
    >>> from ridgeback.numeric.motion.dynamics import polynomial
    >>> free = polynomial((1.0,))
    >>> bool(np.allclose(averaged_action(free, 0.5, np.array([0.0, 9.0])), 0.5))
    True
    """
    top = _highest(dynamics, start)
    span = SPAN
    rough = dynamics.switches is not None and dynamics.switches.in_velocity
    while span <= MOST_SPAN or not rough:
        low = math.log(start) - span
        table = _table(dynamics, low, math.log(top))
        level = _followed(table, math.log(start), low, time)
        if level is not None:
            return np.asarray(np.exp(level))
        span *= 2
    raise InputError(
        f"{dynamics.name}: the averaged motion comes to rest before t = {time.max():.6g}, by dry friction; take a "
        "shorter time"
    )


def _highest(dynamics: Dynamics, start: float) -> float:
    """The highest action that the motion reaches: the start of a decay, else where growth has ended."""
    limit = peak_limit(dynamics)
    most = float(action(dynamics, [EDGE * limit])[0]) if math.isfinite(limit) else math.inf
    top = start
    while cycles_of(dynamics, peak_of_action(dynamics, [top]))[0].rate < 0:
        if top >= most:
            raise InputError(f"{dynamics.name}: the motion grows out of its well; start lower or take a shorter time")
        top = min(2 * top, most)
    return top if top > start else start * (1 + 1e-9)


def _table(dynamics: Dynamics, low: float, high: float) -> Rate:
    """R over ln J: a polynomial, or several where the force has stops in between.

    Just above the level at which the orbit reaches a stop R goes in powers of the square root of the distance from it,
    and so the polynomials are in that root.
    """
    edges = (low, *(level for level in _stop_levels(dynamics) if low < level < high), high)
    if len(edges) == 2:
        return _polynomial(dynamics, low, high, lambda x: x)
    parts = [_above(dynamics, start, end) for start, end in pairwise(edges)]

    def rates(level: Array) -> Array:
        which = np.clip(np.searchsorted(edges, level, side="right") - 1, 0, len(parts) - 1)
        return np.array([float(parts[i](np.sqrt(x - edges[i]))) for i, x in zip(which, level, strict=True)])

    return rates


def _above(dynamics: Dynamics, start: float, end: float) -> Rate:
    """R between two levels, over the root of the distance from the first."""
    return _polynomial(dynamics, 0.0, math.sqrt(end - start), lambda x: start + x**2)


def _stop_levels(dynamics: Dynamics) -> list[float]:
    """The levels ln J, rising, at which the orbit just reaches a kink away from rest."""
    places = [place for place in (dynamics.switches.places if dynamics.switches else ()) if place]
    limit = peak_limit(dynamics)
    depths = potential_at(dynamics, places) if places else np.zeros(0)
    most = float(potential_at(dynamics, limit)[0]) if math.isfinite(limit) else math.inf
    peaks = peak_of_potential(dynamics, depths[depths < most * (1 - 1e-12)])
    levels = sorted(np.log(action(dynamics, peaks)).tolist())
    return [level for i, level in enumerate(levels) if i == 0 or level - levels[i - 1] > SAME]  # both stops at once


def _polynomial(dynamics: Dynamics, low: float, high: float, level: Callable[[Array], Array]) -> Rate:
    """R over what ``level`` makes ln J of, through Chebyshev points, refined until the points between agree."""
    known: dict[float, float] = {}

    def rates(places: Array) -> Array:
        fresh = [x for x in places.tolist() if x not in known]
        if fresh:
            cycles = cycles_of(dynamics, peak_of_action(dynamics, np.exp(level(np.array(fresh)))))
            known.update((x, cycle.rate) for x, cycle in zip(fresh, cycles, strict=True))
        return np.array([known[x] for x in places.tolist()])

    before: BarycentricInterpolator | None = None
    for count in NODES:
        places = low + (high - low) * 0.5 * (1 - np.cos(np.pi * np.arange(count) / (count - 1)))
        values = rates(places)
        table = BarycentricInterpolator(places, values)
        if before is not None and np.abs(before(places) - values).max() <= ACCURACY * np.abs(values).max():
            return lambda x: np.asarray(table(x), dtype=float)
        before = table
    raise InputError(f"{dynamics.name}: the averaged loss of action changes too fast with amplitude to be tabulated")


def _followed(table: Rate, start: float, low: float, time: Array) -> Array | None:
    """ln J at the times, or None when the motion leaves the table at its lower end."""
    level = np.full(time.size, start)
    for side in (np.flatnonzero(time > 0), np.flatnonzero(time < 0)):
        if side.size:
            order = side[np.argsort(np.abs(time[side]))]
            solution = solve_ivp(
                lambda _, x: -table(np.maximum(x, low)),
                (0.0, float(time[order[-1]])),
                [start],
                t_eval=time[order],
                rtol=1e-11,
                atol=1e-12,
            )
            level[order] = solution.y[0]
    return None if level.min(initial=start) < low else level
