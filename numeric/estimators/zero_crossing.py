"""Frequency by zero crossings: full-cycle averages between crossings interpolated below the sample."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import median_filter

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.signal.samples import TWO_PI

BISECTIONS = 60
STENCIL = np.arange(-2, 4)


@dataclass(frozen=True)
class Crossings:
    """Crossing times in samples, whether rising, and |slope| there (per sample)."""

    at: Array
    rising: Mask
    slope: Array


def crossing_samples(x: Array, hysteresis: float) -> NDArray[np.intp]:
    """Indices i with a crossing between i and i + 1, counting one per excursion beyond +-hysteresis.

    Of several crossings within one passage through the dead zone the middle one is taken.

    >>> crossing_samples(np.array([1.0, 0.1, -0.1, 0.1, -0.1, -1.0]), 0.5).tolist()
    [2]
    """
    side = np.where(x > hysteresis, 1, np.where(x < -hysteresis, -1, 0))
    decided = np.flatnonzero(side)
    changes = np.flatnonzero(np.diff(side[decided]) != 0)
    found = []
    for first, last in zip(decided[changes], decided[changes + 1], strict=True):
        positive = x[first : last + 1] >= 0.0
        inside = np.flatnonzero(positive[1:] != positive[:-1])
        found.append(first + inside[inside.size // 2])
    return np.asarray(found, dtype=np.intp)


def interpolate(x: Array, index: NDArray[np.intp]) -> Crossings:
    """Root of the degree-five polynomial through six samples round each crossing, by bisection on 0 .. 1."""
    usable = index[(index + STENCIL[0] >= 0) & (index + STENCIL[-1] < x.size)]
    inverse = np.linalg.inv(np.vander(STENCIL.astype(float), increasing=True))
    polynomials = x[usable[:, None] + STENCIL] @ inverse.T
    orders = np.arange(STENCIL.size)
    low, high = np.zeros(usable.size), np.ones(usable.size)
    sign = np.sign(x[usable + 1] - x[usable])
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        above = sign * (polynomials * middle[:, None] ** orders).sum(axis=1) > 0.0
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    at = 0.5 * (low + high)
    slope = (polynomials[:, 1:] * orders[1:] * at[:, None] ** (orders[1:] - 1)).sum(axis=1)
    return Crossings(usable + at, sign > 0.0, np.abs(slope))


def dead_zone(noise: float, smallest: float) -> float:
    """Half width of the zone around zero in which noise crosses more than once, for a smallest amplitude.

    Three times the noise, but at least a fiftieth and at most a half of that amplitude.

    >>> dead_zone(0.1, 2.0), dead_zone(0.0, 2.0), dead_zone(1.0, 2.0)
    (0.30000000000000004, 0.04, 1.0)
    """
    return min(max(3.0 * noise, 0.02 * smallest), 0.5 * smallest)


def full_cycles(x: Array, rate: float, *, hysteresis: float, noise: float) -> tuple[Array, Array, Array]:
    """Return (time, omega, standard deviation) of full cycles, rising to rising and falling to falling.

    ``time`` is the middle of the cycle and omega its mean, 2 pi / T: a chirp's curvature biases it by omega'' T^2 / 24.
    The standard deviation takes the error of a crossing as ``noise / |slope|``.
    Raises InputError when there is not one full cycle.

    >>> x = np.cos(2 * np.pi * 1.25 * np.arange(128) / 32.0)
    >>> _, omega, _ = full_cycles(x, 32.0, hysteresis=0.1, noise=0.0)
    >>> bool(np.abs(omega / (2 * np.pi) - 1.25).max() < 1e-4)
    True
    """
    crossings = interpolate(x, crossing_samples(x, hysteresis))
    if crossings.at.size < 3:
        raise InputError(f"signal has {crossings.at.size} zero crossings; a full cycle needs 3 (give a longer record)")
    begin, end = crossings.at[:-2], crossings.at[2:]
    period = (end - begin) / rate
    # Noise makes a single slope uncertain, and a small one would count for too much: the median of its neighbours.
    error = noise / median_filter(crossings.slope, size=9, mode="nearest")
    spread = np.hypot(error[:-2], error[2:]) / rate
    return 0.5 * (begin + end) / rate, TWO_PI / period, TWO_PI / period**2 * spread
