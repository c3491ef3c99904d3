"""A time-frequency distribution: values over its own frequency and time axes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, frozen
from ridgeback.numeric.signal.samples import TWO_PI, Floats


@dataclass(frozen=True)
class Distribution:
    """``values[frequency, time]``, shape ``(omega.size, time.size)``; omega in rad per time unit.

    ``values`` are float64, or float32 where they were computed so; the plane is kept as a read-only view (a copy would
    double the largest array here), the axes are copies.

    >>> plane = Distribution(np.ones((2, 3)), np.array([0.0, np.pi]), np.arange(3.0), "example")
    >>> plane.values.shape, plane.frequency_hz.tolist()
    ((2, 3), [0.0, 0.5])
    """

    values: Floats
    omega: Array
    time: Array
    name: str
    settings: Mapping[str, object] = field(default_factory=dict)

    def __post_init__(self) -> None:
        plane = np.asarray(self.values)
        plane = plane.astype(np.float64, copy=False).view() if plane.dtype != np.float32 else plane.view()
        if plane.shape != (np.size(self.omega), np.size(self.time)):
            raise InputError(
                f"{self.name}: values have shape {plane.shape}, the axes need "
                f"({np.size(self.omega)}, {np.size(self.time)})"
            )
        plane.flags.writeable = False
        object.__setattr__(self, "values", plane)
        object.__setattr__(self, "omega", frozen(self.omega))
        object.__setattr__(self, "time", frozen(self.time))
        object.__setattr__(self, "settings", MappingProxyType(dict(self.settings)))

    @property
    def frequency_hz(self) -> Array:
        """The frequency axis in cycles per time unit."""
        return self.omega / TWO_PI

    def energy(self) -> float:
        """The double integral of the values over time and omega / 2 pi, by the rectangle rule on the axes.

        For a Wigner distribution over all its bins this is the signal's energy, exactly.
        """
        if self.omega.size < 2 or self.time.size < 2:
            raise InputError(f"{self.name}: the energy needs two points on each axis")
        cell = (self.omega[1] - self.omega[0]) * (self.time[1] - self.time[0]) / TWO_PI
        return float(self.values.sum() * cell)
