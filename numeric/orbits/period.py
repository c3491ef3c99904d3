"""Exact frequency, action and limits of a conservative oscillator in any potential, by quadrature.

With the energy E = V(A) and the turning points B < 0 < A (trough and peak), E - V(u) = (A - u)(u - B) g(u) with g
smooth and positive, and u = (A + B)/2 - (A - B)/2 cos(theta) leaves

    T = sqrt(2) * integral of g^(-1/2) over 0 < theta < pi,                     omega0 = 2 pi / T,
    J = sqrt(2)/pi * h^2 * integral of sin(theta)^2 g^(1/2),  h = (A - B)/2,    dJ/dE = 1/omega0,

whose integrands are smooth, even and periodic in theta: the midpoint rule converges geometrically (Trefethen and
Weideman, SIAM Review 56 (2014) 385-458).  E - V(u) is never formed as a difference, which would cancel near a
turning point: it is (A - u) times the mean of V' over [u, A], or (u - B) times minus that over [B, u], both by
Gauss-Legendre.  Near the end of the well g^(-1/2) peaks within delta of a turning point; tan(theta) = c tan(psi),
c = sqrt(delta), widens the peak to sqrt(delta), so that the nodes needed grow like delta^(-1/2) only.  A force with
kinks in u is integrated from kink to kink, by ``kinked_orbit``.

Amplitudes are ``peak`` (the positive turning point) unless named otherwise.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, frozen
from ridgeback.numeric.motion.dynamics import Dynamics, well
from ridgeback.numeric.motion.roots import bracketed_newton
from ridgeback.numeric.orbits.kinked_orbit import MOST, half_orbit
from ridgeback.numeric.orbits.potential import (
    Restoring,
    check_peaks,
    mean_restoring,
    peak_limit,
    restoring_of,
    trough,
    troughs,
)

__all__ = ["FrequencyTable", "action", "exact_frequency", "peak_limit", "peak_of_action", "trough"]

Indices = NDArray[np.int64]
_FIRST_NODES = 16
_LAST_NODES = 2**13
_MOST_INNER = 512
_CHUNK = 500_000  # values of V' held at once: 4 MB each in a handful of arrays


@dataclass(frozen=True)
class FrequencyTable:
    """omega0 (rad per time unit) and J at each peak amplitude; 1-D read-only arrays of one length.

    ``error`` is the absolute error estimate of omega: its change over the last doubling of the nodes, and at least
    a few roundings.
    """

    peak: Array
    trough: Array
    omega: Array
    action: Array
    error: Array


def exact_frequency(dynamics: Dynamics, peak: ArrayLike, *, tolerance: float = 1e-13) -> FrequencyTable:
    """Return omega0(A) of the undamped oscillator by quadrature.

    Nodes are doubled until omega0 changes by less than ``tolerance`` or 8192 are reached.

    Parameters
    ----------
    dynamics : Dynamics
        The oscillator with numbers, which has a potential.
    peak : array of float, shape (M,)
        Peak amplitudes, 0 <= A < ``peak_limit(dynamics)``.
    tolerance : float
        Relative.

    Returns
    -------
    FrequencyTable
        Frequencies in rad per time unit, with the ``error`` that was reached: infinite where the force
        is too steep next to a turning point for 512 points.

    Raises
    ------
    InputError
        Without a potential, and for amplitudes outside the range.

    Examples
    --------
    >>> from ridgeback.numeric.motion.dynamics import pendulum
    >>> table = exact_frequency(pendulum(), [1.0, 3.0])
    >>> bool(np.all(np.abs(table.omega - pendulum().closed_form(table.peak)) < 1e-15))
    True
    """
    A = check_peaks(dynamics, peak)
    if not 1e-15 <= tolerance < 1:
        raise InputError(f"tolerance = {tolerance!r} must lie between 1e-15 and 1")
    k = dynamics.natural_frequency
    moving = A > 0
    B, omega, action = np.zeros_like(A), np.full_like(A, k), np.zeros_like(A)
    error = np.full_like(A, 4e-16 * k)
    high = A[moving]
    low = troughs(dynamics, high)
    B[moving] = low
    omega[moving], action[moving], error[moving] = _doubled(dynamics, low, high, tolerance)
    return FrequencyTable(*(frozen(x) for x in (A, B, omega, action, error)))


def action(dynamics: Dynamics, peak: ArrayLike) -> Array:
    """Return J(A) = (1/2 pi) loop integral of u' du; ``sqrt(2 J / k)`` is the ``action`` amplitude, A as A -> 0.

    >>> from ridgeback.numeric.motion.dynamics import linear
    >>> action(linear(k=2.0), [3.0])  # k A^2 / 2
    array([9.])
    """
    return exact_frequency(dynamics, peak).action


def peak_of_action(dynamics: Dynamics, value: ArrayLike) -> Array:
    """Return the peak A with J(A) = value, for 0 <= value < J at the separatrix; Newton with dJ/dA = V'(A)/omega0.

    Raises InputError for an action that no orbit has.

    >>> from ridgeback.numeric.motion.dynamics import linear
    >>> peak_of_action(linear(k=2.0), [9.0])
    array([3.])
    """
    J = np.atleast_1d(np.asarray(value, dtype=float))
    restoring, limit = restoring_of(dynamics), peak_limit(dynamics)
    most = float(action(dynamics, limit * (1 - 1e-9))[0]) if math.isfinite(limit) else math.inf
    bad = J[~((J >= 0) & (most >= J))]
    if bad.size:
        raise InputError(f"{dynamics.name}: action {bad[0]:.9g} is outside 0 to {most:.9g}, that of the separatrix")
    peak, moving = np.zeros_like(J), J > 0
    target = J[moving]

    def value_and_slope(A: Array) -> tuple[Array, Array]:
        """Square roots, so that the function is nearly linear: d sqrt(J)/dA = V' / (2 omega0 sqrt(J))."""
        table = exact_frequency(dynamics, A)
        root = np.sqrt(table.action)
        with np.errstate(divide="ignore", invalid="ignore"):  # an orbit too far out for the quadrature
            return root - np.sqrt(target), restoring(A) / (2 * table.omega * root)

    guess = np.minimum(np.sqrt(2 * target / dynamics.natural_frequency), 0.9 * limit)
    high = np.full_like(guess, limit * (1 - 1e-9)) if math.isfinite(limit) else _beyond(value_and_slope, guess)
    if np.isnan(high).any():
        lost = target[np.isnan(high)][0]
        raise InputError(f"{dynamics.name}: no amplitude has the action {lost:.9g}; the well levels off below it")
    peak[moving] = bracketed_newton(value_and_slope, np.zeros_like(guess), high, guess=guess, rising=True)
    return frozen(peak)


def _beyond(value_and_slope: Callable[[Array], tuple[Array, Array]], start: Array) -> Array:
    """Places from ``start`` on where a function is positive, by doubling; NaN where it has no number before it is."""
    place = start.copy()
    with np.errstate(all="ignore"):
        while place.size and np.any((value := value_and_slope(place)[0]) < 0):
            place = np.where(value < 0, 2 * place, place)
        return np.where(value >= 0, place, np.nan) if place.size else place


def _doubled(dynamics: Dynamics, low: Array, high: Array, tolerance: float) -> tuple[Array, Array, Array]:
    """Return omega0, J and the error of omega0, doubling nodes until each orbit has settled."""
    restoring = restoring_of(dynamics)
    share, c = stretch(dynamics, low, high)
    kinked = dynamics.is_kinked_in_u
    inner, inner_error = (0, np.zeros_like(low)) if kinked else inner_points(restoring, low, high)

    def sums(which: Indices, nodes: int) -> tuple[Array, Array]:
        if kinked:
            orbit = half_orbit(dynamics, low[which], high[which], nodes)
            return math.pi / orbit.duration, orbit.action
        return _sums(restoring, low[which], high[which], c[which], nodes, inner)

    omega, J = sums(np.arange(low.size, dtype=np.int64), _FIRST_NODES)
    # u is rounded next to the end of the well, where V' depends on the distance to it; 1e-3 is what was observed
    # on the pendulum from 1e-3 to 1e-12 before its separatrix, with a margin of 2
    rounding = 1e-15 + 1e-3 * np.spacing(1.0) / share
    if not kinked:
        rounding += mismatch(restoring, low, high, inner)
    error = np.full_like(omega, np.inf)
    active, nodes = np.arange(omega.size, dtype=np.int64), 2 * _FIRST_NODES
    while active.size and nodes <= (MOST if kinked else _LAST_NODES):
        finer, J[active] = sums(active, nodes)
        change = np.abs(finer - omega[active])
        with np.errstate(invalid="ignore"):  # 0 times infinite
            omega[active], error[active] = finer, change + (rounding + inner_error)[active] * finer
        active, nodes = active[change > tolerance * finer], 2 * nodes
    return omega, J, np.where(np.isnan(error), np.inf, error)


def mismatch(restoring: Restoring, low: Array, high: Array, inner: int) -> Array:
    """Return what rounding of the turning points and of V' next to them does to each omega0, as a share of it.

    V(A) and V(B), found apart, differ by the integral of V' over the orbit; u is rounded to a share of its size, which
    moves V by V' u, more than the 2 V of a harmonic well next to a wall.  An energy that is off by a share moves a
    turning point by E/|V' u| of that share, which is large where the force is nearly gone.

    >>> bool(mismatch(np.asarray, -np.ones(1), np.ones(1), 8)[0] < 1e-20)
    True
    >>> bool(mismatch(np.tan, -np.array([1.57]), np.array([1.57]), 64)[0] > 1e-13)
    True
    """
    with np.errstate(all="ignore"):
        halves = 0.5 * (high - low) * _halves(restoring, low, high, inner).reshape(2, low.size)
        energy = high * mean_restoring(restoring, np.zeros_like(high), high, inner)
        ends = np.abs(np.array([restoring(low) * low, restoring(high) * high]))
        steep = np.maximum(ends.sum(axis=0) / energy - 4, 0)
        lost = np.abs(halves.sum(axis=0)) / energy * (1 + energy / ends.min(axis=0, initial=np.inf))
        found = 0.2 * lost + 4 * np.spacing(1.0) * steep  # twice or more of what was seen beside closed forms
    return np.where(np.isfinite(found), found, 0)


def stretch(dynamics: Dynamics, low: Array, high: Array) -> tuple[Array, Array]:
    """Return the distance of each orbit from the end of the well as a share of h (at most 1), and c for it.

    >>> from ridgeback.numeric.motion.dynamics import linear
    >>> [float(x[0]) for x in stretch(linear(), np.array([-1.0]), np.array([1.0]))]
    [1.0, 1.0]
    """
    left, right = well(dynamics)
    share = np.minimum(np.minimum(right - high, low - left) / (0.5 * (high - low)), 1.0)
    return share, np.minimum(1.0, (2 * share) ** 0.25)  # delta = sqrt(2 share), from cosh(delta) = 1 + share


def inner_points(restoring: Restoring, low: Array, high: Array) -> tuple[int, Array]:
    """Return Gauss points that give the mean of V' over each half orbit, and the error left of each orbit (0: none).

    >>> inner_points(np.sin, np.array([-1.0]), np.array([1.0]))
    (16, array([0.]))
    """
    means = _halves(restoring, low, high, 8)
    inner = 8
    while True:
        finer = _halves(restoring, low, high, 2 * inner)
        with np.errstate(all="ignore"):
            change = np.abs(finer / means - 1).reshape(2, low.size).max(axis=0)
            balance = np.abs(finer.reshape(2, low.size).sum(axis=0) / finer[: low.size])  # V(A) - V(B) = 0
        # the points converge geometrically: twice as many have twice the digits
        settled = (change <= 1e-12) & (balance <= 1e-6)
        inner, means = 2 * inner, finer
        if inner >= _MOST_INNER or np.all(settled):
            return inner, np.where(settled, 0.0, np.where(np.isnan(change), np.inf, change))


def _halves(restoring: Restoring, low: Array, high: Array, inner: int) -> Array:
    span = 0.5 * (high - low)
    return np.concatenate((mean_restoring(restoring, low, span, inner), mean_restoring(restoring, high, -span, inner)))


def _sums(restoring: Restoring, low: Array, high: Array, c: Array, nodes: int, inner: int) -> tuple[Array, Array]:
    """Return omega0 and J of each orbit, a few orbits at a time to bound the memory."""
    per_chunk = max(1, _CHUNK // nodes)
    parts = [
        _midpoint(restoring, low[i : i + per_chunk], high[i : i + per_chunk], c[i : i + per_chunk], nodes, inner)
        for i in range(0, low.size, per_chunk)
    ]
    if not parts:
        return np.zeros(0), np.zeros(0)
    return np.concatenate([p[0] for p in parts]), np.concatenate([p[1] for p in parts])


def _midpoint(restoring: Restoring, low: Array, high: Array, c: Array, nodes: int, inner: int) -> tuple[Array, Array]:
    grid = orbit_grid(restoring, low, high, c, nodes, inner)
    root = np.sqrt(np.where(grid.g > 0, grid.g, np.nan))  # too few inner points: no number, with an infinite error
    omega = math.sqrt(2) / np.mean(grid.weight / root, axis=1)
    loop = np.mean(grid.weight * np.sin(grid.theta) ** 2 * root, axis=1)
    return omega, math.sqrt(2) * (0.5 * (high - low)) ** 2 * loop


@dataclass(frozen=True)
class OrbitGrid:
    """Midpoints psi over (0, pi), trough to peak, of each orbit; theta, its slope in psi, and g, ``[orbit, node]``."""

    psi: Array
    theta: Array
    weight: Array
    g: Array


def orbit_grid(restoring: Restoring, low: Array, high: Array, c: Array, nodes: int, inner: int) -> OrbitGrid:
    """Return theta, d theta / d psi and g; ``rise`` and ``fall`` are (u - B) / h and (A - u) / h.

    >>> grid = orbit_grid(np.asarray, -np.ones(1), np.ones(1), np.ones(1), 4, 8)  # V' = u: g = 1/2
    >>> bool(np.allclose(grid.g, 0.5, rtol=1e-15))
    True
    """
    psi = np.array((np.arange(nodes) + 0.5) * (math.pi / nodes), dtype=np.float64)
    c, half = c[:, None], 0.5 * (high - low)[:, None]
    theta: Array = np.arctan2(c * np.sin(psi), np.cos(psi))
    weight: Array = c / (np.cos(psi) ** 2 + (c * np.sin(psi)) ** 2)
    rise, fall = 2 * np.sin(0.5 * theta) ** 2, 2 * np.cos(0.5 * theta) ** 2
    near_low, near_high = np.s_[:, : nodes // 2], np.s_[:, nodes // 2 :]
    low_mean = mean_restoring(restoring, low[:, None], half * rise[near_low], inner)
    high_mean = mean_restoring(restoring, high[:, None], -half * fall[near_high], inner)
    g = np.hstack((-low_mean / (half * fall[near_low]), high_mean / (half * rise[near_high])))
    return OrbitGrid(psi, theta, weight, g)
