"""Undamped orbits in a table over the peak amplitude: frequency, action, harmonics, and what damping forces take.

One fixed quadrature for all amplitudes, fast enough to sit inside a fit.  With u = m - h cos(theta) between trough and
peak, E - V(u) = (A - u)(u - B) g(u) and dt = d theta / sqrt(2 g): midpoint sums in theta converge geometrically, and 64
nodes reach 1e-9 up to nine tenths of the way to a separatrix (``exact_frequency`` certifies, and is the test).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, freeze, frozen
from ridgeback.numeric.motion.bilinear import Bilinear, bilinear_frequency, bilinear_waveform, potential
from ridgeback.numeric.motion.dynamics import Dynamics

HARMONICS = 11
NODES = 64
_NEWTON_STEPS = 12


@dataclass(frozen=True)
class OrbitTable:
    """Orbits by peak amplitude; u = sum over m of ``cosine[m, orbit] cos(m phi)``, phi counted from the peak.

    ``cubic`` and ``quartic`` are the means of |u'|^3 and u'^4 over a cycle; that of u'^2 is omega J, and that of |u'|
    is omega/pi times ``width``, the distance of the turning points, which a cycle passes twice.
    """

    peak: Array
    omega: Array
    action: Array
    cosine: Array
    cubic: Array
    quartic: Array
    width: Array

    def __post_init__(self) -> None:
        freeze(self)


def orbit_table(dynamics: Dynamics, peak: ArrayLike, *, harmonics: int = HARMONICS, nodes: int = NODES) -> OrbitTable:
    """Tabulate the orbits of a smooth potential.

    Parameters
    ----------
    dynamics : Dynamics
        The oscillator with numbers, which has a potential.
    peak : array of float, shape (M,)
        Positive peak amplitudes inside the well.
    harmonics : int
        The highest multiple.
    nodes : int
        Points of the quadrature.  With 64 of them frequencies are right to 1e-12 up to 0.99 of a separatrix, to 1e-4 at
        0.999 of it, and of no use beyond; ``exact_frequency`` adds points until they are.

    Returns
    -------
    OrbitTable
        Frequency, action, harmonics and mean powers of u' by peak.

    Raises
    ------
    InputError
        Without a potential, and where an amplitude does not turn back.

    Examples
    --------
    >>> from ridgeback.numeric.motion.dynamics import pendulum
    >>> table = orbit_table(pendulum(), [1.0])
    >>> bool(abs(table.omega[0] - pendulum().closed_form(1.0)) < 1e-13)
    True
    """
    if dynamics.potential is None or dynamics.restoring is None:
        raise InputError(f"{dynamics.name}: has no potential, so no orbits by amplitude")
    A = np.atleast_1d(np.asarray(peak, dtype=float))
    energy = dynamics.potential(A)
    B = _troughs(dynamics, A, energy)
    theta = (np.arange(nodes) + 0.5) * (math.pi / nodes)
    middle, half = 0.5 * (A + B)[:, None], 0.5 * (A - B)[:, None]
    u = middle - half * np.cos(theta)
    kinetic = energy[:, None] - dynamics.potential(u)
    held = np.all(kinetic > 0, axis=1) & (dynamics.restoring(A) > 0) & (dynamics.restoring(B) < 0)
    if not held.all():
        bad = A[np.flatnonzero(~held)[0]]
        raise InputError(f"{dynamics.name}: peak amplitude {bad:.6g} does not turn back; use less")
    slope = half * np.sin(theta) / np.sqrt(2 * kinetic)  # dt / d theta
    omega = 1 / slope.mean(axis=1)
    share = slope * omega[:, None]
    speed = np.sqrt(2 * kinetic)
    action = np.mean(share * speed**2, axis=1) / omega
    return OrbitTable(
        A,
        omega,
        action,
        _harmonics(u, share, harmonics),
        np.mean(share * speed**3, axis=1),
        np.mean(share * speed**4, axis=1),
        A - B,
    )


def _troughs(dynamics: Dynamics, A: Array, energy: Array) -> Array:
    """The negative turning points: Newton on sqrt(2 V), which is nearly linear in u."""
    assert dynamics.potential is not None  # noqa: S101 - checked before
    assert dynamics.restoring is not None  # noqa: S101
    if np.allclose(dynamics.potential(-A), energy, rtol=1e-15, atol=0.0):
        return -A
    u, target = -A, np.sqrt(energy)
    with np.errstate(all="ignore"):
        for _ in range(_NEWTON_STEPS):
            root = np.sqrt(dynamics.potential(u))
            step = (root - target) * 2 * root / dynamics.restoring(u)
            u = np.minimum(u - np.clip(step, -0.5 * A, 0.5 * A), -1e-3 * A)
            if np.all(np.abs(step) <= 1e-15 * A):
                break
    level = dynamics.potential(u)
    wrong = ~(np.abs(level - energy) <= 1e-9 * energy)
    if wrong.any():
        raise InputError(f"{dynamics.name}: peak amplitude {A[wrong][0]:.6g} has no trough in its well; use less")
    return np.asarray(u, dtype=np.float64)


def _harmonics(u: Array, share: Array, count: int) -> Array:
    """Fourier coefficients of u in phi; theta runs from trough to peak, phi = pi - integral of the share."""
    phase = math.pi - share @ _integrals(u.shape[1])
    weighted = 2 * share * u
    rows = [np.mean(weighted * np.cos(m * phase), axis=1) for m in range(count + 1)]
    rows[0] = 0.5 * rows[0]
    return np.array(rows)


@lru_cache(maxsize=4)
def _integrals(nodes: int) -> Array:
    """Matrix that integrates an even periodic function, given at midpoints, from 0 to each midpoint.

    By its cosine series b_0/2 + sum of b_j cos(j theta), b_j = (2/n) sum of f cos(j theta).
    """
    theta = (np.arange(nodes) + 0.5) * (math.pi / nodes)
    j = np.arange(1, nodes)
    waves = np.cos(np.outer(theta, j)) * (2 / nodes)
    return frozen(waves @ (np.sin(np.outer(j, theta)) / j[:, None]) + np.outer(np.full(nodes, 1 / nodes), theta))


def bilinear_table(
    oscillator: Bilinear, peak: ArrayLike, *, harmonics: int = HARMONICS, samples: int = 128
) -> OrbitTable:
    """Tabulate a bilinear oscillator from its closed forms; sums over ``samples`` phases of half a cycle.

    >>> table = bilinear_table(Bilinear(1.0, 1.0, 0.5), [2.0])
    >>> [round(float(x[0]), 9) for x in (table.omega, table.action, table.cosine[1], table.quartic)]
    [1.0, 2.0, 2.0, 6.0]
    """
    A = np.atleast_1d(np.asarray(peak, dtype=float))
    omega = np.atleast_1d(bilinear_frequency(oscillator, A))
    phase = (np.arange(samples) + 0.5) * (math.pi / samples)
    u = bilinear_waveform(oscillator, A, phase)
    rows = (u @ np.cos(np.outer(phase, np.arange(harmonics + 1)))).T * (2 / samples)
    rows[0] *= 0.5
    square = np.maximum(2 * (potential(oscillator, A)[:, None] - potential(oscillator, u)), 0.0)
    powers = [np.mean(power, axis=1) for power in (square, square * np.sqrt(square), square * square)]
    width = A - bilinear_waveform(oscillator, A, np.array([math.pi]))[:, 0]
    return OrbitTable(A, omega, powers[0] / omega, rows, powers[1], powers[2], width)
