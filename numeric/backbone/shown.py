"""How a backbone shows itself: its range in a line, frequency against amplitude with one-sigma bands."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar, NamedTuple

import numpy as np

from ridgeback.common.show.displayed import Displayed, signal_units
from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.numeric.arrays import Array


class Curve(NamedTuple):
    """Frequency and its standard deviation against amplitude."""

    amplitude: Array
    omega: Array
    omega_sd: Array


class ShownBackbone(Displayed):
    """What a backbone shows of itself."""

    INDEX: ClassVar[tuple[str, ...]] = ("amplitude",)

    definition: str
    units: str

    def along(self) -> Curve:
        """The curve that is drawn."""
        raise NotImplementedError

    def own_units(self) -> Mapping[str, str]:
        """Amplitudes in the unit of the signal, where it is known."""
        return signal_units(self.units)

    def headline(self) -> str:
        """Ranges of amplitude and frequency."""
        a, omega, _ = self.along()
        unit = f" {self.units}" if self.units else ""
        return (
            f"{self.definition} amplitude {a.min():.4g} to {a.max():.4g}{unit}, "
            f"omega {omega.min():.6g} to {omega.max():.6g} rad/s, {a.size} points"
        )

    def picture(self) -> Picture:
        """Frequency over amplitude."""
        a, omega, deviation = self.along()
        order = np.argsort(a)
        a, omega, deviation = a[order], omega[order], deviation[order]
        stroke = Stroke(a, omega, "measured, one sigma", omega - deviation, omega + deviation)
        unit = self.units or "unit of the signal"
        return Picture("backbone", f"amplitude ({self.definition}), {unit}", "omega, rad/s", (stroke,))
