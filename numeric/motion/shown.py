"""How a trajectory shows itself: method and span in a line, its samples as a table and a picture."""

from __future__ import annotations

from typing import ClassVar

from ridgeback.common.show.displayed import Displayed
from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.numeric.arrays import Array


class ShownTrajectory(Displayed):
    """What a trajectory shows of itself."""

    INDEX: ClassVar[tuple[str, ...]] = ("time_s",)

    name: str
    time: Array
    u: Array
    velocity: Array
    rate: float
    method: str

    def rows(self) -> list[dict[str, float]]:
        """One row per sample: time_s, u, velocity."""
        columns = (self.time.tolist(), self.u.tolist(), self.velocity.tolist())
        return [{"time_s": t, "u": u, "velocity": v} for t, u, v in zip(*columns, strict=True)]

    def headline(self) -> str:
        """What was integrated, how, and over which time."""
        return (
            f"{self.name} by {self.method}, {self.time.size} samples, {self.rate:.6g} per time unit, "
            f"t = 0 to {self.time[-1]:.6g}, u {self.u.min():.4g} to {self.u.max():.4g}"
        )

    def picture(self) -> Picture:
        """The unknown over time."""
        return Picture(f"{self.name}, {self.method}", "time, s", "u", (Stroke(self.time, self.u),))
