"""The undamped motion at a given amplitude: where on its orbit a state lies, and the Fourier series of u.

The phase phi = omega0 t is counted from the peak, so that u = sum a_m cos(m phi) by the symmetry of the orbit.  Along
psi of ``period`` the slope d phi / d psi is even and periodic: its cosine series, integrated term by term, gives phi
with the geometric convergence of the quadrature itself.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.polynomial.chebyshev import chebval
from numpy.typing import ArrayLike
from scipy import fft

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, frozen
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.numeric.orbits.kinked_orbit import MOST, half_orbit, settled_half_orbit, since_turning
from ridgeback.numeric.orbits.period import OrbitGrid, inner_points, orbit_grid, stretch
from ridgeback.numeric.orbits.potential import check_peaks, peak_of_potential, potential_at, restoring_of, troughs

_LAST_NODES = 2**12
SETTLED = 1e-14
"""Change of the frequency by a doubling of the nodes between kinks, relative, that counts as none."""
FIRST_POINTS, DIED = 16, 1e-14
"""Chebyshev points that are tried first, and what the last coefficients then are of the largest, at most."""


@dataclass(frozen=True)
class OrbitPosition:
    """A state (u, u') on its undamped orbit: the peak of that orbit, omega0, J and the phase since the peak.

    ``excess`` is the integral of u'^2 - omega0 J over the time since the peak: what a damping force would have taken
    by now beyond its average rate.
    """

    peak: float
    omega: float
    action: float
    phase: float
    """In -pi..pi, negative while u rises."""
    excess: float


@dataclass(frozen=True)
class OrbitHarmonics:
    """u = sum over m of ``cosine[m, orbit] cos(m phi)``, m = 0 to count, phi = omega0 t from the peak."""

    peak: Array
    cosine: Array
    error: float
    """Largest change of a coefficient over the last doubling of the nodes, relative to the peak."""


def orbit_position(dynamics: Dynamics, u: float, velocity: float) -> OrbitPosition:
    """Locate a state on its undamped orbit; InputError outside the well.

    >>> from ridgeback.numeric.motion.dynamics import linear
    >>> place = orbit_position(linear(k=2.0), 0.0, -2.0)  # a quarter cycle after the peak u = 1
    >>> round(place.peak, 12), round(place.phase / np.pi, 12)
    (1.0, 0.5)
    """
    energy = 0.5 * velocity**2 + float(potential_at(dynamics, u)[0])
    if energy == 0:
        raise InputError(f"{dynamics.name}: the state (0, 0) is at rest and has no phase; start elsewhere")
    high = peak_of_potential(dynamics, energy)
    low = troughs(dynamics, high)
    sign = -1.0 if velocity > 0 else 1.0
    if dynamics.is_kinked_in_u:
        return _between_kinks(dynamics, low, high, u, velocity, sign)
    grid = _grid(dynamics, low, high, _enough_nodes(dynamics, low, high))
    half, period = 0.5 * float(high[0] - low[0]), 1 / np.sqrt(grid.g[0]) * grid.weight[0]
    omega = math.sqrt(2) / float(np.mean(period))
    loop = math.sqrt(2) * half**2 * grid.weight[0] * np.sin(grid.theta[0]) ** 2 * np.sqrt(grid.g[0])
    J = float(np.mean(loop))
    psi = _psi_of(u, velocity, dynamics, float(low[0]), float(high[0]))
    phase = math.pi - _integral_to(omega / math.sqrt(2) * period, psi)
    work = math.pi * J - _integral_to(loop, psi)
    return OrbitPosition(float(high[0]), omega, J, sign * phase, sign * (work - J * phase))


def _between_kinks(
    dynamics: Dynamics, low: Array, high: Array, u: float, velocity: float, sign: float
) -> OrbitPosition:
    """The same of a force with kinks in u: time and work from the turning point on the side of u."""
    orbit, _ = settled_half_orbit(dynamics, low, high, SETTLED)
    half, J = float(orbit.duration[0]), float(orbit.action[0])
    omega = math.pi / half
    turn, side = (float(high[0]), 1) if u >= 0 else (float(low[0]), -1)
    time, work = (0.0, 0.0) if velocity == 0 else since_turning(dynamics, turn, side, u)
    if side < 0:
        time, work = half - time, math.pi * J - work
    return OrbitPosition(float(high[0]), omega, J, sign * omega * time, sign * (work - omega * J * time))


def _psi_of(u: float, velocity: float, dynamics: Dynamics, low: float, high: float) -> float:
    """Return psi of u between low and high; tan(psi) = tan(theta) / c."""
    _, c = stretch(dynamics, np.array([low]), np.array([high]))
    if velocity == 0:
        return math.pi if u > 0 else 0.0
    rise, fall = math.sqrt(max(u - low, 0.0)), math.sqrt(max(high - u, 0.0))
    theta = 2 * math.atan2(rise, fall)
    return math.atan2(math.sin(theta), float(c[0]) * math.cos(theta))


def _integral_to(samples: Array, psi: float) -> float:
    """Integral from 0 to psi of an even periodic function given at the midpoints, by its cosine series."""
    b = fft.dct(samples, type=2) / samples.size
    j = np.arange(1, samples.size)
    return float(0.5 * b[0] * psi + np.sum(b[1:] * np.sin(j * psi) / j))


def orbit_harmonics(dynamics: Dynamics, peak: ArrayLike, *, count: int = 9) -> OrbitHarmonics:
    """Return the Fourier coefficients of u of the undamped motion at each peak amplitude.

    Parameters
    ----------
    dynamics : Dynamics
        The oscillator with numbers, which has a potential.
    peak : array of float, shape (M,)
        Peak amplitudes.
    count : int
        The highest multiple, 1 to 200.

    Returns
    -------
    OrbitHarmonics
        ``cosine[m, amplitude]``, m = 0 .. ``count``, phases counted from the peak.

    Raises
    ------
    InputError
        Without a potential, beyond its limit, and for a count outside 1 to 200.

    Examples
    --------
    >>> from ridgeback.numeric.motion.dynamics import linear
    >>> np.allclose(orbit_harmonics(linear(), [2.0], count=2).cosine, [[0.0], [2.0], [0.0]], atol=1e-15)
    True
    """
    if not 1 <= count <= 200:
        raise InputError(f"harmonic count {count} is outside 1 to 200")
    A = check_peaks(dynamics, peak)
    cosine, moving = np.zeros((count + 1, A.size)), A > 0
    high = A[moving]
    low = troughs(dynamics, high)
    if dynamics.is_kinked_in_u:
        cosine[:, moving], error = _cosines_between_kinks(dynamics, low, high, count)
        cosine.flags.writeable = False
        return OrbitHarmonics(frozen(A), cosine, error)
    nodes, error = 32, math.inf
    while nodes < 4 * count:
        nodes *= 2
    cosine[:, moving] = _cosines(dynamics, low, high, nodes, count)
    while error > 1e-13 and nodes < _LAST_NODES:
        nodes *= 2
        finer = _cosines(dynamics, low, high, nodes, count)
        error = float((np.abs(finer - cosine[:, moving]) / high).max(initial=0.0))
        cosine[:, moving] = finer
    cosine.flags.writeable = False
    return OrbitHarmonics(frozen(A), cosine, error)


def harmonics_along(dynamics: Dynamics, peak: ArrayLike, *, count: int = 9) -> OrbitHarmonics:
    """The same at many peak amplitudes of one range: between Chebyshev points, where the coefficients die away there.

    They are smooth functions of the peak; as many points are taken as it needs until the last coefficients of their
    Chebyshev series are at rounding (Trefethen, Approximation Theory and Approximation Practice, 2013, ch. 3).

    Parameters
    ----------
    dynamics, peak, count
        As of :func:`orbit_harmonics`.

    Returns
    -------
    OrbitHarmonics
        At each of the peaks.

    Examples
    --------
    >>> from ridgeback.numeric.motion.dynamics import linear
    >>> A = np.linspace(1.0, 2.0, 200)
    >>> bool(np.abs(harmonics_along(linear(), A, count=2).cosine[1] - A).max() < 1e-13)
    True
    """
    A = check_peaks(dynamics, peak)
    low, high = float(A.min(initial=np.inf)), float(A.max(initial=0.0))
    middle, half = 0.5 * (high + low), 0.5 * (high - low)
    points = FIRST_POINTS
    while low > 0.0 and 2 * points < A.size:
        x = np.cos(np.pi * (np.arange(points) + 0.5) / points)
        at = orbit_harmonics(dynamics, middle + half * x, count=count)
        series = fft.dct(at.cosine.T, type=2, axis=0) / points
        series[0] *= 0.5
        if np.abs(series[-2:]).max() <= DIED * np.abs(series).max():
            cosine = np.asarray(chebval((A - middle) / half if half > 0.0 else np.zeros(A.size), series), dtype=float)
            cosine.flags.writeable = False
            return OrbitHarmonics(frozen(A), cosine, at.error)
        points *= 2
    return orbit_harmonics(dynamics, A, count=count)


def _cosines_between_kinks(dynamics: Dynamics, low: Array, high: Array, count: int) -> tuple[Array, float]:
    """Coefficients ``[m, orbit]`` of a force with kinks in u, twice the mean of u cos(m phi) over half a cycle."""
    nodes, error, found = max(32, 16 * math.ceil(count / 16)), math.inf, np.zeros((count + 1, low.size))
    while error > 1e-13 and nodes <= MOST:
        orbit = half_orbit(dynamics, low, high, nodes)
        phase = np.pi * orbit.time / orbit.duration[:, None]
        finer = np.array([(2.0 if m else 1.0) * orbit.mean(orbit.u * np.cos(m * phase)) for m in range(count + 1)])
        error = float((np.abs(finer - found) / high).max(initial=0.0))
        found, nodes = finer, 2 * nodes
    return found, error


def _cosines(dynamics: Dynamics, low: Array, high: Array, nodes: int, count: int) -> Array:
    """Coefficients ``[m, orbit]`` by the midpoint rule in psi: (2/pi) integral of u cos(m phi) d phi."""
    chunk = max(1, 500_000 // nodes)
    parts = [
        _cosines_of(dynamics, low[i : i + chunk], high[i : i + chunk], nodes, count) for i in range(0, low.size, chunk)
    ]
    return np.concatenate(parts, axis=1) if parts else np.zeros((count + 1, 0))


def _cosines_of(dynamics: Dynamics, low: Array, high: Array, nodes: int, count: int) -> Array:
    grid = _grid(dynamics, low, high, nodes)
    slope = grid.weight / np.sqrt(grid.g)
    slope /= np.mean(slope, axis=1, keepdims=True)
    b = fft.dct(slope, type=2, axis=1) / nodes
    b[:, 1:] /= np.arange(1, nodes)
    sine = np.hstack((b[:, 1:], np.zeros((low.size, 1))))  # DST-III takes the terms j = 1 .. nodes
    phase = math.pi - (0.5 * b[:, :1] * grid.psi + 0.5 * fft.dst(sine, type=3, axis=1))
    middle, half = 0.5 * (low + high)[:, None], 0.5 * (high - low)[:, None]
    weighted = 2 * slope * (middle - half * np.cos(grid.theta))
    rows = [np.mean(weighted * np.cos(m * phase), axis=1) for m in range(count + 1)]
    rows[0] = 0.5 * rows[0]
    return np.array(rows)


def _grid(dynamics: Dynamics, low: Array, high: Array, nodes: int) -> OrbitGrid:
    restoring = restoring_of(dynamics)
    inner, _ = inner_points(restoring, low, high)
    return orbit_grid(restoring, low, high, stretch(dynamics, low, high)[1], nodes, inner)


def _enough_nodes(dynamics: Dynamics, low: Array, high: Array) -> int:
    """Double the nodes until the cosine series of d phi / d psi has died away."""
    nodes = 32
    while nodes < _LAST_NODES:
        grid = _grid(dynamics, low, high, nodes)
        b = np.abs(fft.dct(grid.weight[0] / np.sqrt(grid.g[0]), type=2))
        if b[-nodes // 4 :].max() <= 1e-14 * b[0]:
            break
        nodes *= 2
    return nodes
