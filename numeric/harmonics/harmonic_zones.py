"""Where in a spectrum the harmonics of an oscillation may be: what is there is the oscillation's own, and no other.

Harmonic h is within h times the range of the oscillation's frequency, an ordinate of the spectrum to either
side; above the Nyquist frequency it is seen folded.
"""

from __future__ import annotations

import math

import numpy as np

from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.harmonics.spline_model import SplineModel
from ridgeback.numeric.signal.samples import TWO_PI

ASIDE = 1.0
"""Ordinates of the spectrum of the record, by which a line may miss its place."""
RANGE, WIDEST = 2.0, 0.3
"""Standard deviations of the oscillation's frequency, weighted with its power, that make its range, and how far a zone
goes to either side at most, in that frequency."""
FURTHER, FEWEST = 2, 3
"""Harmonics that are expected above the highest which is modelled, and the highest expected at least."""

Zone = tuple[float, float]


def harmonic_zones(model: SplineModel) -> tuple[Zone, ...]:
    """Lowest and highest frequency, rad per time unit, of each harmonic above the first that a model may have.

    >>> from ridgeback.numeric.harmonics.signal_model import signal_models
    >>> t = np.arange(640) / 32.0
    >>> model = signal_models(np.cos(7.0 * t + 0.01 * t**2), 32.0, np.full(640, 7.2), half=40, multiples=()).best
    >>> [(round(low, 1), round(high, 1)) for low, high in harmonic_zones(model)]
    [(13.6, 15.2), (20.6, 22.6)]
    """
    step = float(model.time[1] - model.time[0])
    mean = model.mean_omega
    reach = RANGE * math.sqrt(float(np.average((model.omega - mean) ** 2, weights=model.size**2)))
    near = ASIDE * TWO_PI / (step * model.time.size)
    highest = max(FEWEST, max(model.multiples, default=1) + FURTHER)
    aside = ((h, min(h * reach + near, WIDEST * mean)) for h in range(2, highest + 1))
    return tuple(folded((h * mean - off, h * mean + off), math.pi / step) for h, off in aside)


def folded(zone: Zone, nyquist: float) -> Zone:
    """Where frequencies are seen in samples.

    >>> folded((1.0, 2.0), 10.0), folded((11.0, 13.0), 10.0), folded((9.0, 13.0), 10.0)
    ((1.0, 2.0), (7.0, 9.0), (7.0, 10.0))
    """
    low, high = (abs(f - 2.0 * nyquist * round(f / (2.0 * nyquist))) for f in zone)
    if math.floor(zone[0] / nyquist) != math.floor(zone[1] / nyquist):
        turn = nyquist if math.floor(zone[1] / nyquist) % 2 else 0.0
        return min(low, high, turn), max(low, high, turn)
    return min(low, high), max(low, high)


def in_zones(omega: Array, zones: tuple[Zone, ...]) -> Mask:
    """Which frequencies are in one of some zones.

    >>> in_zones(np.array([1.0, 2.5, 4.0]), ((2.0, 3.0), (3.5, 4.5))).tolist()
    [False, True, True]
    """
    found = np.zeros(np.shape(omega), dtype=np.bool_)
    for low, high in zones:
        found |= (omega >= low) & (omega <= high)
    return found
