"""How a recording shows itself: what it is of in a line, its samples as a table and a picture."""

from __future__ import annotations

from collections.abc import Mapping
from html import escape
from typing import Any, ClassVar

from ridgeback.common.show.displayed import Displayed, signal_units
from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.numeric.arrays import Array, Mask


class ShownRecording(Displayed):
    """What a recording shows of itself."""

    INDEX: ClassVar[tuple[str, ...]] = ("time_s",)

    time: Array
    values: Array
    rate: float
    name: str
    units: str
    source: str
    notes: tuple[str, ...]
    clipped: Mask
    filled: Mask

    @property
    def channel(self) -> str:
        """The name with its unit."""
        raise NotImplementedError

    @property
    def label(self) -> str:
        """What tells the signal from others."""
        raise NotImplementedError

    def rows(self) -> list[dict[str, Any]]:
        """One row per sample: time_s, value, clipped, filled."""
        columns = (self.time.tolist(), self.values.tolist(), self.clipped.tolist(), self.filled.tolist())
        names = ("time_s", "value", "clipped", "filled")
        return [dict(zip(names, row, strict=True)) for row in zip(*columns, strict=True)]

    def own_units(self) -> Mapping[str, str]:
        """Values in the unit of the signal, where it is known."""
        return signal_units(self.units)

    def headline(self) -> str:
        """Label, number of samples, rate and span."""
        return (
            f"{self.label}, {self.values.size} samples, {self.rate:.6g} per time unit, "
            f"t = {self.time[0]:.6g} to {self.time[-1]:.6g}"
        )

    def _repr_html_(self) -> str:
        notes = "".join(f"<li>{escape(note)}</li>" for note in self.notes)
        return super()._repr_html_() + (f"<ul>{notes}</ul>" if notes else "")

    def picture(self) -> Picture:
        """The samples over time."""
        return Picture(self.label, "time, s", self.channel, (Stroke(self.time, self.values),))
