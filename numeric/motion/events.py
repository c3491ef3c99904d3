"""What happens along a motion: its zero crossings, its turning points, and the kinks of the force that it passes."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Callable
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


@dataclass(frozen=True)
class Switches:
    """The smooth laws of a force with kinks at places in u, or at u' = 0.

    Parameters
    ----------
    places : tuple of float
        The u at which it has kinks, rising; they part the line into stretches, numbered from 0 at the left.
    in_velocity : bool
        Whether it has a kink at u' = 0.
    force : callable
        (stretch of u, side of u': 1 or -1) to the f(u, u') that holds there and goes on smoothly beyond.
    """

    places: tuple[float, ...]
    in_velocity: bool
    force: Callable[[int, int], Callable[[float, float], float]]

    def stretch(self, u: float, velocity: float) -> int:
        """The number of the stretch that a state is in; at a kink the one it moves into, at rest there that nearer 0.

        >>> law = Switches((-1.0, 0.0, 1.0), False, lambda _, side: lambda u, v: u)
        >>> law.stretch(0.5, 1.0), law.stretch(1.0, -1.0), law.stretch(1.0, 1.0), law.stretch(-1.0, 0.0)
        (2, 2, 3, 1)
        """
        forward = velocity > 0 or (velocity == 0 and u <= 0)
        return bisect_right(self.places, u) if forward else bisect_left(self.places, u)

    def pull(self, stretch: int, u: float) -> float:
        """V' at a place by the law of a stretch: the mean of f over both sides of u' = 0."""
        return 0.5 * (self.force(stretch, 1)(u, 0.0) + self.force(stretch, -1)(u, 0.0))
