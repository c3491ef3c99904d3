"""How wide the local fits may be: the window follows the local rate of change of amplitude and frequency.

Within half a window of h the logarithm of the amplitude may change by REACH, its slope by REACH^2 / h, and the
frequency by TURN of itself:

    h |a'/a| <= REACH,      h^2 |(a'/a)'| <= REACH^2,      h |omega'| <= TURN omega.

With a decay of any power law, a' = -c a^(p + 1), what a quartic under an exponential leaves of a'/a is then some 0.3 %
of it; of a plain exponential decay it leaves nothing.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt, maximum_filter1d, uniform_filter1d

from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.harmonics.local_fit import HarmonicFit
from ridgeback.numeric.signal.samples import TWO_PI

LADDER = (3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0, 32.0)
"""Widths in cycles."""
MOST_SHARE = 0.25
"""Of the record, for all but the narrowest window."""
REACH, TURN = 0.5, 0.1
SURE = 2.0
"""A change counts by what it exceeds this many of its standard deviations."""
POINTS_PER_CYCLE = 4.0
MOST_POINTS, STEPS = 2000, 8
"""Of a longer record there are more points only as far as half a window holds fewer than STEPS of them."""


def furthest(pilot: HarmonicFit) -> Array:
    """The longest half width at the times of a pilot fit, in time units."""
    spacing = float(np.median(np.diff(pilot.time))) if pilot.time.size > 1 else 1.0
    near = max(1, round(pilot.window_seconds / spacing))
    bend = np.gradient(uniform_filter1d(pilot.growth, near, mode="nearest"), pilot.time)
    turn = np.gradient(uniform_filter1d(pilot.omega, near, mode="nearest"), pilot.time)
    growth = beyond(pilot.growth, pilot.growth_sd) / REACH
    steeper = np.sqrt(beyond(bend, pilot.growth_sd / pilot.window_seconds)) / REACH
    faster = beyond(turn, pilot.standard_deviation / pilot.window_seconds) / (TURN * np.abs(pilot.omega))
    fastest = np.maximum(np.maximum(growth, steeper), faster)
    fastest = np.where(np.isfinite(fastest) & pilot.settled, fastest, 0.0)
    return 1.0 / np.maximum(maximum_filter1d(fastest, near + 1, mode="nearest"), np.finfo(float).tiny)


def beyond(values: Array, deviation: Array) -> Array:
    """What of a size is more than noise.

    >>> beyond(np.array([-5.0, 1.0]), np.ones(2)).tolist()
    [3.0, 0.0]
    """
    return np.maximum(np.abs(values) - SURE * deviation, 0.0)


def half_widths(pilot: HarmonicFit, omega: Array, rate: float, *, fewest: int, clean: Mask) -> NDArray[np.intp]:
    """Half width in samples, at each sample, of the widest window of the LADDER that may be used there.

    ``fewest`` is the number of samples that the model in a window needs; wider windows than the narrowest keep to the
    ``clean`` samples.
    """
    time = pilot.time[0] + np.arange(omega.size) / rate
    reach = np.interp(time, pilot.time, furthest(pilot))
    cycle = TWO_PI / float(np.median(omega))
    free = np.full(omega.size, np.inf) if clean.all() else distance_transform_edt(clean)
    found = np.full(omega.size, round(0.5 * LADDER[0] * cycle * rate))
    for cycles in LADDER[1:]:
        half = round(0.5 * cycles * cycle * rate)
        allowed = (half / rate <= reach) & (half < free) & (2 * half + 1 <= MOST_SHARE * omega.size)
        found = np.where((2 * found + 1 < fewest) | allowed, half, found)
    return np.asarray(np.minimum(found, (omega.size - 1) // 2), dtype=np.intp)


def spacing(halves: NDArray[np.intp], cycle: float, rate: float) -> int:
    """Samples from one point to the next: a quarter of a cycle, more in a long record of wide windows.

    >>> spacing(np.full(1_000_000, 320), 1.0, 20.0), spacing(np.full(2_000, 320), 1.0, 20.0)
    (40, 5)
    """
    often = round(cycle * rate / POINTS_PER_CYCLE)
    return max(1, often, min(halves.size // MOST_POINTS, int(halves.min()) // STEPS))
