"""How a plane shows itself: its shape in a line, its levels as a picture, and labelled axes for xarray and pandas."""

from __future__ import annotations

from html import escape
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ridgeback.common.show.columns import QUANTITIES, Quantity
from ridgeback.common.show.displayed import Displayed, described_as
from ridgeback.common.show.optional import optional
from ridgeback.common.show.picture import Picture, Plane
from ridgeback.numeric.arrays import Array


class ShownDistribution(Displayed):
    """What a distribution shows of itself."""

    values: NDArray[np.inexact[Any]]
    omega: Array
    time: Array
    name: str

    def rows(self) -> list[dict[str, Any]]:
        """One row per frequency and time, time the faster: as many rows as there are values."""
        return [
            {"omega_rad_s": omega, "time_s": time, "value": value}
            for omega, line in zip(self.omega.tolist(), self.values.tolist(), strict=True)
            for time, value in zip(self.time.tolist(), line, strict=True)
        ]

    def headline(self) -> str:
        """Name, shape and span of the axes."""
        return (
            f"{self.name}, {self.omega.size} frequencies from {self.omega[0]:.4g} to {self.omega[-1]:.4g} rad/s, "
            f"{self.time.size} times from {self.time[0]:.4g} to {self.time[-1]:.4g}"
        )

    def picture(self) -> Picture:
        """The levels over time and frequency; of a complex plane those of its modulus."""
        size = np.abs(self.values) if np.iscomplexobj(self.values) else self.values
        return Picture(self.name, "time, s", "omega, rad/s", plane=Plane(self.time, self.omega, size, self.name))

    def to_dataframe(self) -> Any:
        """The plane as a pandas DataFrame: frequencies down, times across; units are in ``attrs``."""
        frame = optional("pandas", "to_dataframe").DataFrame(np.array(self.values), self.omega, self.time)
        frame.index.name, frame.columns.name = "omega_rad_s", "time_s"
        frame.attrs.update(title=self.headline(), units={"omega_rad_s": "rad/s", "time_s": "s", "value": VALUE.unit})
        return frame

    def to_xarray(self) -> Any:
        """The plane as an xarray DataArray over ``omega`` and ``time``, with units."""
        library = optional("xarray", "to_xarray")
        coordinates = {
            "omega": library.Variable(("omega",), self.omega, described_as(QUANTITIES["omega_rad_s"])),
            "time": library.Variable(("time",), self.time, described_as(QUANTITIES["time_s"])),
        }
        values, about = np.array(self.values), described_as(VALUE)
        return library.DataArray(values, coordinates, ("omega", "time"), name=self.name, attrs=about)

    def _repr_html_(self) -> str:
        return f"<p>{escape(self.headline())}</p>"

    def _repr_latex_(self) -> None:
        """None: a plane has no formula, and its table no end."""


VALUE = Quantity("(unit of the signal)**2 per unit of the plane", "value of the distribution")
