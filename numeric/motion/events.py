"""What happens along a motion: its zero crossings and its turning points."""

from __future__ import annotations

from dataclasses import dataclass

from ridgeback.numeric.arrays import Array, Mask


@dataclass(frozen=True)
class CrossingEvents:
    """Zero crossings of u in order of time: when, upward or not, and the velocity there."""

    time: Array
    rising: Mask
    velocity: Array


@dataclass(frozen=True)
class TurningEvents:
    """Turning points (u' = 0) in order of time: when, and the value of u there."""

    time: Array
    value: Array
