"""What happens along a motion: its zero crossings and its turning points."""

from __future__ import annotations

from dataclasses import dataclass

from ridgeback.common.show.brief import Brief
from ridgeback.numeric.arrays import Array, Mask


@dataclass(frozen=True, repr=False)
class CrossingEvents(Brief):
    """Zero crossings of u in order of time: when, upward or not, and the velocity there."""

    time: Array
    rising: Mask
    velocity: Array


@dataclass(frozen=True, repr=False)
class TurningEvents(Brief):
    """Turning points (u' = 0) in order of time: when, and the value of u there."""

    time: Array
    value: Array
