"""Harmonics of a motion whose frequency changes, seen at constant phase: order analysis.

Sampled at equal steps of phase instead of time, harmonic m of the motion is a line at m cycles per cycle, however
fast the frequency itself moves; the lines are as narrow as the amplitude is slow.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from ridgeback.numeric.arrays import Array

POINTS_PER_CYCLE = 64
MOST = 15


@dataclass(frozen=True)
class Orders:
    """Share of the energy of each multiple 0 .. MOST of the fundamental, and of what lies between none of them."""

    share: Array

    def level_db(self, multiple: int) -> float:
        """Level of a multiple relative to the fundamental."""
        return float(10 * np.log10(max(self.share[multiple], 1e-300) / self.share[1]))


def phase_clock(crossings: Array) -> CubicSpline:
    """Time as a function of phase (in cycles) through crossings in one direction, one per cycle."""
    return CubicSpline(np.arange(crossings.size), crossings)


def orders(value_at: Callable[[Array], Array], crossings: Array) -> Orders:
    """Energy by multiples of the fundamental over whole cycles, Hann-weighted so that the ends do not leak.

    ``value_at`` gives the signal at any times; ``crossings`` are the times of crossings in one direction.

    >>> found = orders(lambda t: np.cos(2 * np.pi * t) + 0.1 * np.cos(6 * np.pi * t), np.arange(0.25, 20.0))
    >>> round(float(found.share[3] / found.share[1]), 6)
    0.01
    """
    clock = phase_clock(crossings)
    cycles = crossings.size - 1
    phase = np.arange(cycles * POINTS_PER_CYCLE) / POINTS_PER_CYCLE
    weighted = value_at(clock(phase)) * np.sin(np.pi * phase / cycles) ** 2
    power = 2 * np.abs(np.fft.rfft(weighted)) ** 2
    power[0] /= 2  # the mean has no mirror image at negative frequency
    nearest = np.rint(np.arange(power.size) / cycles).astype(int)
    energy = np.bincount(nearest, weights=power, minlength=MOST + 1)[: MOST + 1]
    return Orders(np.asarray(energy / energy.sum()))


@dataclass(frozen=True)
class Ripple:
    """Strongest oscillation of a quantity against the phase of the motion."""

    per_cycle: float
    amplitude: float
    """Of the strongest component, averaged over the record."""


def ripple(
    value_at: Callable[[Array], Array], crossings: Array, *, lowest: float = 0.75, highest: float = 8.0
) -> Ripple:
    """How often per cycle a quantity oscillates: the strongest line between ``lowest`` and ``highest`` per cycle.

    >>> found = ripple(lambda t: t + 0.02 * np.cos(4 * np.pi * t), np.arange(0.25, 20.0))
    >>> round(found.per_cycle, 3), round(found.amplitude, 4)
    (2.0, 0.02)
    """
    clock = phase_clock(crossings)
    cycles = crossings.size - 1
    phase = np.arange(cycles * POINTS_PER_CYCLE) / POINTS_PER_CYCLE
    values = value_at(clock(phase))
    window = np.sin(np.pi * phase / cycles) ** 2
    smooth = np.polynomial.Polynomial.fit(phase, values, 5)(phase)
    padded = 8 * phase.size
    line = np.abs(np.fft.rfft((values - smooth) * window, padded)) * 2 / window.sum()
    frequency = np.arange(line.size) * POINTS_PER_CYCLE / padded
    band = np.flatnonzero((frequency >= lowest) & (frequency <= highest))
    at = band[np.argmax(line[band])]
    return Ripple(float(frequency[at]), float(line[at]))
