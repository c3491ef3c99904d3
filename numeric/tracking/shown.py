"""How an estimate against time shows itself: method, span and range in a line, and a curve with its 95 % band."""

from __future__ import annotations

from typing import ClassVar, NamedTuple

import numpy as np

from ridgeback.common.show.displayed import Displayed
from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.numeric.arrays import Array, Mask


class Ends(NamedTuple):
    """Lower and upper end of a band."""

    low: Array
    high: Array


class ShownEstimate(Displayed):
    """What a track shows of itself."""

    INDEX: ClassVar[tuple[str, ...]] = ("time_s",)
    QUANTITY: ClassVar[str]
    AXIS: ClassVar[str]
    """What the values are, with their unit."""

    time: Array
    valid: Mask
    method: str

    @property
    def values(self) -> Array:
        """The estimated quantity."""
        raise NotImplementedError

    def band(self) -> Ends | None:
        """The ends of the 95 % interval where it is claimed."""
        raise NotImplementedError

    def headline(self) -> str:
        """Method, span of time, range of the valid values."""
        good = self.values[self.valid & np.isfinite(self.values)]
        told = f"{self.QUANTITY} {good.min():.6g} to {good.max():.6g}" if good.size else "no valid value"
        span = f"t = {self.time[0]:.6g} to {self.time[-1]:.6g}" if self.time.size else "no time"
        return f"{self.method}, {span}, {told} ({good.size} of {self.time.size} values are valid)"

    def picture(self) -> Picture:
        """The valid values with their interval, the others dashed."""
        sure = np.where(self.valid, self.values, np.nan)
        low, high = self.band() or (None, None)
        strokes = [Stroke(self.time, sure, f"{self.method}" + ("" if low is None else ", 95 % interval"), low, high)]
        if not self.valid.all():
            strokes.append(Stroke(self.time, np.where(self.valid, np.nan, self.values), "not valid", dashed=True))
        return Picture(self.method, "time, s", self.AXIS, tuple(strokes))
