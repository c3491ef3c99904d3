"""A time-frequency distribution: values over its own frequency and time axes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, frozen
from ridgeback.numeric.distributions.shown import ShownDistribution
from ridgeback.numeric.signal.samples import TWO_PI

Plane = NDArray[np.inexact[Any]]
"""float32, float64, complex64 or complex128."""


@dataclass(frozen=True, repr=False)
class Distribution(ShownDistribution):
    """A plane of values over frequency and time, with its axes.

    Parameters
    ----------
    values : array, shape (omega.size, time.size)
        ``values[frequency, time]``: real, or complex for a cross distribution, in single or double precision.  Kept as
        a read-only view, because a copy would double the largest array here.
    omega : array of float, shape (M,)
        Frequencies of the rows in equal steps, rad per time unit.
    time : array of float, shape (N,)
        Times of the columns in equal steps, in the signal's time unit.
    name : str
        Which distribution it is, as in ``"pseudo-wigner"``.
    settings : mapping, optional
        How it was computed, for display.
    border : float, optional
        Time at each end within which a column sees less of the signal than its whole window.  0 (the default) where
        there is no window.

    Raises
    ------
    InputError
        Where the shape of ``values`` is not that of the axes.

    Examples
    --------
    >>> plane = Distribution(np.ones((2, 3)), np.array([0.0, np.pi]), np.arange(3.0), "example")
    >>> plane.values.shape, plane.frequency_hz.tolist()
    ((2, 3), [0.0, 0.5])
    """

    values: Plane
    omega: Array
    time: Array
    name: str
    settings: Mapping[str, object] = field(default_factory=dict)
    border: float = 0.0

    def __post_init__(self) -> None:
        plane = np.asarray(self.values)
        plane = plane.view() if plane.dtype.kind in "fc" else plane.astype(np.float64)
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

    @property
    def spacing(self) -> float:
        """Step of the frequency axis, rad per time unit; raises InputError where there is one row alone."""
        if self.omega.size < 2:
            raise InputError(f"{self.name}: a step of the frequency axis needs two points on it")
        return float(self.omega[1] - self.omega[0])

    def size(self) -> NDArray[np.floating]:
        """The values where they are real, their moduli where they are complex."""
        return np.abs(self.values) if np.iscomplexobj(self.values) else np.real(self.values)

    def energy(self) -> float:
        """The double integral of real values over time and omega / 2 pi, by the rectangle rule on the axes.

        For a Wigner distribution over all its bins this is the signal's energy, exactly.

        Raises
        ------
        InputError
            For a complex distribution, or an axis of one point.
        """
        if np.iscomplexobj(self.values):
            raise InputError(f"{self.name} is complex, and has no energy; take that of a distribution of one signal")
        if self.omega.size < 2 or self.time.size < 2:
            raise InputError(f"{self.name}: the energy needs two points on each axis")
        cell = self.spacing * (self.time[1] - self.time[0]) / TWO_PI
        return float(np.real(self.values).sum() * cell)
