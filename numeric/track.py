"""A frequency track: omega(t) with its uncertainty, its bias, and where it may be trusted."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np

from numeric.arrays import frozen, frozen_flags
from numeric.errors import InputError
from numeric.samples import TWO_PI, Array, Mask


@dataclass(frozen=True)
class Track:
    """One estimate of a frequency against time; all arrays have the same length.

    ``omega`` is in rad per time unit.  ``standard_deviation`` is the random error, one sigma.  ``bias`` is the
    estimated systematic error *of the values as given* (true = omega - bias); when it has been removed,
    ``settings["bias_removed"]`` is True and ``bias`` holds what was taken off.  ``valid`` is False in the border
    zones, where the estimator does not see a whole window of data.

    >>> track = Track(np.arange(3.0), np.full(3, 6.0), np.array([False, True, True]), "example")
    >>> track.inside().time.tolist()
    [1.0, 2.0]
    """

    time: Array
    omega: Array
    valid: Mask
    method: str
    standard_deviation: Array | None = None
    bias: Array | None = None
    settings: Mapping[str, object] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name in ("time", "omega", "standard_deviation", "bias"):
            value = getattr(self, name)
            if value is not None:
                object.__setattr__(self, name, frozen(value))
                self._check_length(name, np.size(value))
        object.__setattr__(self, "valid", frozen_flags(self.valid))
        self._check_length("valid", self.valid.size)
        object.__setattr__(self, "settings", MappingProxyType(dict(self.settings)))

    def _check_length(self, name: str, size: int) -> None:
        if size != np.size(self.time):
            raise InputError(f"track {self.method}: {name} has {size} values for {np.size(self.time)} times")

    @property
    def frequency_hz(self) -> Array:
        """Cycles per time unit."""
        return self.omega / TWO_PI

    @property
    def start(self) -> float:
        """Time of the first sample of the signal: what the estimator noted, else the first time of the track."""
        noted = self.settings.get("start")
        return float(noted) if isinstance(noted, (int, float)) else float(self.time[0])

    def inside(self) -> Track:
        """Return the valid part of the track."""
        return self._select(self.valid)

    def between(self, low: float, high: float) -> Track:
        """Return the part with ``low <= time <= high``, valid or not."""
        return self._select((self.time >= low) & (self.time <= high))

    def _select(self, keep: Mask) -> Track:
        def part(values: Array | None) -> Array | None:
            return None if values is None else values[keep]

        return Track(
            time=self.time[keep],
            omega=self.omega[keep],
            valid=self.valid[keep],
            method=self.method,
            standard_deviation=part(self.standard_deviation),
            bias=part(self.bias),
            settings=self.settings,
        )

    def rows(self) -> list[dict[str, float | bool]]:
        """One row per time: time_s, omega_rad_s, frequency_hz, the uncertainty columns it has, valid."""
        columns: dict[str, Array] = {
            "time_s": self.time,
            "omega_rad_s": self.omega,
            "frequency_hz": self.frequency_hz,
        }
        if self.standard_deviation is not None:
            columns["standard_deviation_rad_s"] = self.standard_deviation
        if self.bias is not None:
            columns["bias_rad_s"] = self.bias
        return [
            {**{name: float(values[i]) for name, values in columns.items()}, "valid": bool(self.valid[i])}
            for i in range(self.time.size)
        ]
