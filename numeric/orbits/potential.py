"""The potential of an oscillator from its V': levels, turning points and the amplitude at which oscillation ends.

V is integrated from V' by Gauss-Legendre, so that it is accurate relative to itself at small amplitude, where a
formula such as 1 - cos(u) cancels.  Amplitudes are ``peak``: the positive turning point A; ``trough`` is the other.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, frozen
from ridgeback.numeric.motion.dynamics import SCAN, Dynamics, well
from ridgeback.numeric.motion.roots import bracketed_newton

Restoring = Callable[[ArrayLike], Array]


def restoring_of(dynamics: Dynamics) -> Restoring:
    """Return V', or raise InputError for an oscillator whose energy is not u'^2/2 + V(u).

    >>> from ridgeback.numeric.motion.dynamics import van_der_pol
    >>> restoring_of(van_der_pol(1.0))
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: van-der-pol has no potential, so no frequency by amplitude from it; take the ...
    """
    if dynamics.restoring is None:
        raise InputError(
            f"{dynamics.name} has no potential, so no frequency by amplitude from it; take the frequency of a "
            "simulated motion"
        )
    return dynamics.restoring


def potential_at(dynamics: Dynamics, u: ArrayLike) -> Array:
    """Return V(u) = integral of V' from 0 by Gauss-Legendre, accurate relative to itself even at small u.

    >>> from ridgeback.numeric.motion.dynamics import pendulum
    >>> bool(abs(potential_at(pendulum(), [1e-9])[0] / 5e-19 - 1) < 1e-15)
    True
    """
    points = np.atleast_1d(np.asarray(u, dtype=float))
    value = _integrated(dynamics, points, 16)
    with np.errstate(all="ignore"):
        direct = None if dynamics.potential is None else np.asarray(dynamics.potential(points))
    inner = 32
    while inner <= 512:
        previous, value = value, _integrated(dynamics, points, inner)
        settled = np.abs(value - previous) <= 1e-12 * np.abs(value)  # the next change would be its square
        if direct is not None:  # points that miss a steep part settle too, on what is not V
            settled &= np.abs(value - direct) <= 1e-9 * (1 + np.abs(direct))
        if np.all(settled):
            return np.asarray(value)
        inner *= 2
    return value if direct is None else np.where(settled, value, direct)  # next to a wall V is large: no cancellation


def _integrated(dynamics: Dynamics, points: Array, inner: int) -> Array:
    """V' integrated from 0, from kink to kink."""
    restoring, total, start = restoring_of(dynamics), np.zeros_like(points), np.zeros_like(points)
    places = dynamics.switches.places if dynamics.switches is not None else ()
    for place in (*sorted((p for p in places if p), key=abs), math.inf):
        between = (np.sign(points) == np.sign(place)) & (np.abs(points) > abs(place))
        end = points if math.isinf(place) else np.where(between, place, start)
        total += (end - start) * mean_restoring(restoring, start, end - start, inner)
        start = end
    return total


def peak_limit(dynamics: Dynamics) -> float:
    """Return the peak amplitude at which the oscillation ends: the first other equilibrium on either side.

    As whoever bound the oscillator to its numbers knows it, else by a scan of V'.  An end on the left is translated to
    the peak of equal potential; so is the level at which V saturates on the left (Morse's potential, mirrored).

    Parameters
    ----------
    dynamics : Dynamics
        The oscillator with numbers, which has a potential.

    Returns
    -------
    float
        In the unit of u; infinite where the scan up to 1e6 finds no end.

    Examples
    --------
    >>> from ridgeback.numeric.motion.dynamics import duffing, helmholtz_duffing
    >>> peak_limit(duffing(eps=-1.0)), peak_limit(helmholtz_duffing(alpha=-1.0, eps=0.0))
    (1.0, 1.0)
    >>> round(peak_limit(helmholtz_duffing(alpha=1.0, eps=0.0)), 14)
    0.5
    """
    restoring = restoring_of(dynamics)
    known = dynamics.known_ends()
    if known is not None:
        return known[2]
    left, right = well(dynamics)
    depth = float(potential_at(dynamics, left)[0]) if math.isfinite(left) else _saturation(restoring)
    if math.isinf(depth):
        return right
    if math.isfinite(right) and float(potential_at(dynamics, right)[0]) <= depth * (1 + 1e-14):
        return right
    high = right if math.isfinite(right) else _outward(dynamics, 1.0, np.array([depth]))[0]
    return float(_at_level(dynamics, np.array([depth]), np.zeros(1), np.array([high]))[0])


def check_peaks(dynamics: Dynamics, peak: ArrayLike) -> Array:
    """Return the amplitudes as a 1-D array, or raise InputError naming the first unusable one and the limit.

    >>> from ridgeback.numeric.motion.dynamics import pendulum
    >>> check_peaks(pendulum(), 3.2)
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: pendulum: peak amplitude 3.2 is not below the separatrix at 3.14159; use less
    """
    restoring_of(dynamics)
    A = np.atleast_1d(np.asarray(peak, dtype=float)).ravel()
    bad = A[~(np.isfinite(A) & (A >= 0))]
    if bad.size:
        raise InputError(f"{dynamics.name}: peak amplitude {bad[0]} must be finite and not negative")
    limit = peak_limit(dynamics)
    beyond = A[limit <= A]
    if beyond.size:
        raise InputError(
            f"{dynamics.name}: peak amplitude {beyond[0]:.9g} is not below the separatrix at {limit:.6g}; use less"
        )
    return A


def trough(dynamics: Dynamics, peak: ArrayLike) -> Array:
    """Return the negative turning point B(A) with V(B) = V(A).

    >>> from ridgeback.numeric.motion.dynamics import pendulum
    >>> trough(pendulum(), [1.0])
    array([-1.])
    """
    A = check_peaks(dynamics, peak)
    B = np.zeros_like(A)
    B[A > 0] = troughs(dynamics, A[A > 0])
    return frozen(B)


def peak_of_potential(dynamics: Dynamics, energy: ArrayLike) -> Array:
    """Return the peak A with V(A) = energy, for energies from 0 to below that of the separatrix.

    >>> from ridgeback.numeric.motion.dynamics import linear
    >>> peak_of_potential(linear(k=2.0), [0.0, 8.0])
    array([0., 2.])
    """
    E = np.atleast_1d(np.asarray(energy, dtype=float))
    limit = peak_limit(dynamics)
    most = float(potential_at(dynamics, limit)[0]) if math.isfinite(limit) else math.inf
    below = most * (1 - 4 * np.finfo(float).eps)  # V at the edge of the well is known to a few roundings
    bad = E[~((E >= 0) & (below > E))]
    if bad.size:
        raise InputError(
            f"{dynamics.name}: energy {bad[0]:.9g} is outside the well, 0 to {most:.9g}; start with less energy"
        )
    peak, moving = np.zeros_like(E), E > 0
    level = E[moving]
    high = np.full_like(level, limit) if math.isfinite(limit) else _outward(dynamics, 1.0, level)
    peak[moving] = _at_level(dynamics, level, np.zeros_like(high), high)
    return peak


def troughs(dynamics: Dynamics, peaks: Array) -> Array:
    """Return the trough of each positive peak, the peaks being known to lie in range.

    >>> from ridgeback.numeric.motion.dynamics import linear
    >>> troughs(linear(), np.array([1.0, 2.0]))
    array([-1., -2.])
    """
    left, _ = well(dynamics)
    level = potential_at(dynamics, peaks)
    low = np.full_like(peaks, left) if math.isfinite(left) else _outward(dynamics, -1.0, level)
    return _at_level(dynamics, level, low, np.zeros_like(low), guess=-peaks)


def _saturation(restoring: Restoring) -> float:
    """Level that V approaches far on the left, or infinity while it still grows at the end of the scan."""
    x, w = gauss(8)
    edges = np.concatenate(([0.0], -SCAN))
    width = np.diff(edges)
    with np.errstate(all="ignore"):
        pieces = width * (0.5 * w @ restoring(edges[:-1] + 0.5 * (1 + x)[:, None] * width))
        level = np.cumsum(np.where(np.isfinite(pieces), pieces, np.inf))
        still = float(-SCAN[-1] * restoring(-SCAN[-1])) / level[-1]
    return math.inf if not np.isfinite(level[-1]) or not abs(still) < 0.01 else float(level[-1])


def _outward(dynamics: Dynamics, side: float, level: Array) -> Array:
    """Points on one side whose potential is at least ``level``, found by doubling; the well is endless there."""
    u = side * np.sqrt(2 * level) / dynamics.natural_frequency
    for _ in range(2000):
        short = potential_at(dynamics, u) < level
        if not short.any():
            return u
        with np.errstate(over="ignore"):  # behind a wall V is infinite, and the well endless on the other side
            u = np.where(short, 2 * u, u)
    raise InputError(f"{dynamics.name}: no turning point where V(u) = {level.max():.6g}; use a smaller amplitude")


def _at_level(dynamics: Dynamics, level: Array, low: Array, high: Array, guess: Array | None = None) -> Array:
    """Solve V(u) = level in brackets on one side of 0, by Newton on sqrt(V), which is nearly linear in u."""
    restoring, target = restoring_of(dynamics), np.sqrt(level)

    def value_and_slope(u: Array) -> tuple[Array, Array]:
        root = np.sqrt(potential_at(dynamics, u))
        with np.errstate(invalid="ignore"):  # 0/0 at u = 0, where the solver bisects
            return root - target, np.asarray(restoring(u)) / (2 * root)

    rising = np.maximum(low, high) > 0
    return bracketed_newton(value_and_slope, low, high, guess=guess, rising=rising)


def mean_restoring(restoring: Restoring, start: Array, offset: Array, inner: int) -> Array:
    """Mean of V' from ``start`` to ``start + offset`` by Gauss-Legendre with ``inner`` points."""
    x, w = gauss(inner)
    total = np.zeros(np.broadcast_shapes(start.shape, offset.shape))
    for share, weight in zip(0.5 * (1 + x), 0.5 * w, strict=True):
        total += weight * np.asarray(restoring(start + share * offset))
    return total


@lru_cache(maxsize=16)
def gauss(points: int) -> tuple[Array, Array]:
    """Nodes and weights of Gauss-Legendre on [-1, 1].

    >>> round(float(gauss(3)[1].sum()), 12)
    2.0
    """
    x, w = np.polynomial.legendre.leggauss(points)
    return frozen(x), frozen(w)
