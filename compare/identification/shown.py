"""How an identification and a prediction show themselves: in a line, as a table, as a picture."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from ridgeback.common.numbers import number, relative
from ridgeback.common.show.displayed import Displayed
from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.numeric.arrays import Array

DRAWN = 4
"""Candidates whose backbones are drawn."""


class ShownIdentification(Displayed):
    """What an identification shows of itself."""

    INDEX: ClassVar[tuple[str, ...]] = ("candidate", "parameter")

    unit: str
    candidates: tuple[Any, ...]
    data: Any

    @property
    def verdict(self) -> str:
        """Which class, how sure, and which others cannot be told apart from it."""
        raise NotImplementedError

    def rows(self) -> list[dict[str, Any]]:
        """One row per parameter of each candidate, best first: value, standard_deviation, unit, delta, weight."""
        return [
            {
                "candidate": candidate.name,
                "parameter": parameter.name,
                "value": parameter.value,
                "standard_deviation": parameter.standard_deviation,
                "unit": parameter.unit,
                "delta": candidate.delta,
                "weight": candidate.weight,
            }
            for candidate in self.candidates
            for parameter in candidate.parameters
        ]

    def own_units(self) -> dict[str, str]:
        """Each parameter has a unit of its own, in the column ``unit``."""
        return {"value": "see unit", "standard_deviation": "see unit"}

    def headline(self) -> str:
        """The verdict."""
        return self.verdict

    def picture(self) -> Picture:
        """The measured backbone and those of the best candidates with their 95 % bands."""
        found = self.data
        low, high = found.omega - found.omega_sd, found.omega + found.omega_sd
        strokes = [Stroke(found.amplitude, found.omega, "measured, one sigma", low, high)]
        strokes += [Stroke(c.amplitude, c.omega, c.name, c.omega_low, c.omega_high) for c in self.candidates[:DRAWN]]
        unit = self.unit or "unit of the signal"
        return Picture("what made it", f"amplitude (fundamental), {unit}", "omega, rad/s", tuple(strokes))


class ShownPrediction(Displayed):
    """What a prediction shows of itself."""

    INDEX: ClassVar[tuple[str, ...]] = ("time_s",)

    candidate: str
    cycles: float
    time: Array
    amplitude: Array
    amplitude_low: Array
    amplitude_high: Array
    measured_amplitude: Array
    omega: Array
    omega_low: Array
    omega_high: Array
    measured_omega: Array
    phase_error: Array
    phase_band: Array
    errors: Mapping[str, float]

    def rows(self) -> list[dict[str, Any]]:
        """One row per time: amplitude and frequency predicted, their 95 % bands, and what was measured."""
        columns = {
            "time_s": self.time,
            "amplitude": self.amplitude,
            "amplitude_low_95": self.amplitude_low,
            "amplitude_high_95": self.amplitude_high,
            "amplitude_measured": self.measured_amplitude,
            "omega_rad_s": self.omega,
            "low_95_rad_s": self.omega_low,
            "high_95_rad_s": self.omega_high,
            "omega_measured_rad_s": self.measured_omega,
            "phase_error_rad": self.phase_error,
        }
        return [
            dict(zip(columns, row, strict=True)) for row in zip(*(c.tolist() for c in columns.values()), strict=True)
        ]

    def headline(self) -> str:
        """What predicted how much, and how well."""
        amplitude, omega, phase = (self.errors.get(name, float("nan")) for name in ("amplitude", "omega", "phase"))
        return (
            f"{self.candidate}, from the first {number(self.cycles)} cycles, t = {number(float(self.time[0]))} to "
            f"{number(float(self.time[-1]))}; rms error {relative(amplitude)} in amplitude, {relative(omega)} in "
            f"frequency, {number(phase)} rad in phase"
        )

    def picture(self) -> Picture:
        """The amplitude predicted with its 95 % band, and the one measured."""
        strokes = (
            Stroke(self.time, self.amplitude, "predicted, 95 %", self.amplitude_low, self.amplitude_high),
            Stroke(self.time, self.measured_amplitude, "measured", dots=True),
        )
        return Picture(f"{self.candidate}, predicted", "time, s", "amplitude, unit of the signal", strokes)
