"""How an accuracy-order study shows itself: its grid in a line, its errors over amplitude as a picture."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ridgeback.common.show.displayed import Displayed
from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.numeric.arrays import Array


class ShownStudy(Displayed):
    """What a study shows of itself."""

    system: str
    title: str
    method: str
    variable: str
    amplitude_definition: str
    amplitude_unit: str
    orders: tuple[int, ...]
    amplitudes: Array
    relative_error: Array

    def index(self) -> tuple[str, ...]:
        """The grid: orders, and amplitudes or values of eps."""
        return "order", "amplitude" if self.variable == "A" else self.variable

    def own_units(self) -> Mapping[str, str]:
        """Amplitudes are those of the unknown."""
        return {"amplitude": self.amplitude_unit or "unit of the unknown"}

    def headline(self) -> str:
        """System, grid and the worst error of the highest order."""
        worst = float(np.max(np.abs(self.relative_error[-1]), initial=0.0))
        span = f"{self.variable} {self.amplitudes[0]:.4g} to {self.amplitudes[-1]:.4g}"
        return (
            f"{self.system}, {self.method}, orders {', '.join(map(str, self.orders))}, {span} "
            f"({self.amplitudes.size} values); at order {self.orders[-1]} the error is at most {worst:.2g}"
        )

    def picture(self) -> Picture:
        """Relative error over amplitude, a curve per order, on a logarithmic axis."""
        errors = np.where(self.relative_error == 0.0, np.nan, np.abs(self.relative_error))
        strokes = tuple(
            Stroke(self.amplitudes, line, f"order {order}") for order, line in zip(self.orders, errors, strict=True)
        )
        unit = f", {self.amplitude_unit}" if self.amplitude_unit else ""
        axis = f"amplitude ({self.amplitude_definition}){unit}" if self.variable == "A" else self.variable
        return Picture(self.title, axis, "relative error of omega0", strokes, logarithmic=True)
