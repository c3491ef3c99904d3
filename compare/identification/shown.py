"""How an identification and a prediction show themselves: in a line, as a table, as a picture."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from typing import Any, ClassVar

import numpy as np

from ridgeback.common.numbers import number, relative
from ridgeback.common.show.displayed import Displayed
from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.numeric.arrays import Array

DRAWN = 4
"""Candidates whose backbones are drawn."""
HELD = 0.8
"""Share of what was measured later that must lie near a forecast, by the 95 % bands of both, for it to have held."""
TELLING = 0.5
"""A forecast says something when its band is, in the middle of its times, narrower than this either side, of it."""


class Standing(Enum):
    """What is claimed of the best candidate; from NEAREST on no interval is."""

    CLAIMED = "claimed"
    """It does better than all others that were tried."""
    UNTOLD = "not told apart"
    """From others, which fit as well."""
    NEAREST = "nearest"
    """It leaves more than noise."""
    HUM = "hum"
    """The samples are those of no oscillator, but of a steady tone of the mains."""
    DOUBTED = "doubted"
    """The samples are not those of one oscillation."""
    NONE = "none"
    """It describes hardly any of the signal."""

    @property
    def refusal(self) -> str:
        """How every sentence begins that claims no class; empty where one is claimed."""
        match self:
            case Standing.NEAREST:
                return "No class comes down to the noise"
            case Standing.HUM | Standing.DOUBTED:
                return "No class is claimed"
            case Standing.NONE:
                return "No class describes this recording"
        return ""


class Outcome(Enum):
    """What became of a forecast."""

    HELD = "held"
    MISSED = "missed"
    """Of what was measured later, more lies outside than the bands of both allow."""
    OPEN = "open"
    """Its bands are not known, or so wide that they say nothing."""

    @property
    def verb(self) -> str:
        """What a forecast did."""
        return {Outcome.HELD: "held", Outcome.MISSED: "did not hold", Outcome.OPEN: "says nothing"}[self]


class ShownIdentification(Displayed):
    """What an identification shows of itself."""

    INDEX: ClassVar[tuple[str, ...]] = ("candidate", "parameter")

    unit: str
    candidates: tuple[Any, ...]
    data: Any
    indistinguishable: tuple[str, ...]
    unexplained: float
    hum: str
    doubt: str

    @property
    def best(self) -> Any:
        """The candidate with the least criterion."""
        raise NotImplementedError

    @property
    def criterion_title(self) -> str:
        """The information criterion as it is printed."""
        raise NotImplementedError

    @property
    def standing(self) -> Standing:
        """What is claimed of the best candidate."""
        raise NotImplementedError

    @property
    def unclaimed(self) -> str:
        """Why no interval of a parameter is claimed; empty where they are."""
        raise NotImplementedError

    @property
    def title(self) -> str:
        """What made the recording, as far as it is claimed, in a few words."""
        others, refusal, named = len(self.indistinguishable) - 1, self.standing.refusal, str(self.best.named)
        match self.standing:
            case Standing.HUM:
                return f"{refusal}: {self.hum}, and no decay"
            case Standing.DOUBTED:
                return f"{refusal}: no model of one oscillation holds"
            case Standing.NONE | Standing.NEAREST:
                return f"{refusal}; the nearest is {self.best.title}"
            case Standing.UNTOLD:
                return f"{named}; {others} other {'class fits' if others == 1 else 'classes fit'} as well"
        return named

    @property
    def verdict(self) -> str:
        """The ranking in one or two sentences: which class, how sure, and which others cannot be told apart from it."""
        named, refusal = self.best.named, self.standing.refusal
        left = f"What it leaves unexplained is {self.unexplained:.2g} of the signal's rms."
        match self.standing:
            case Standing.HUM:
                return f"{refusal}: {self.unclaimed}; give a --band round another oscillation."
            case Standing.NONE:
                return f"{refusal}: {self.unclaimed}. The nearest is {named}."
            case Standing.DOUBTED:
                return f"{refusal}: {self.unclaimed}. The nearest is {named}. {left}"
            case Standing.NEAREST:
                return f"{refusal}: {self.unclaimed}. The nearest is {named}{self._next()}. {left}"
        still = ", though no model without an oscillator in mind holds" if self.doubt else ""
        return f"{named}{still}{self._next()}. {left}"

    def _next(self) -> str:
        """What comes behind the best candidate."""
        best, others = self.best, [c for c in self.candidates[1:] if c.name in self.indistinguishable]
        name, text = self.criterion_title, ""
        if not best.has_equation and not others:
            text = ": no equation among the candidates does as well"
        if others:
            listed = ", ".join(f"{c.title} ({name} {c.delta:.1f} higher)" for c in others)
            return f"{text}; the data cannot tell it apart from: {listed}"
        if len(self.candidates) > 1:
            second = self.candidates[1]
            return f"{text}; next comes {second.title}, {name} {second.delta:.4g} higher"
        return text

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
    coverage: Mapping[str, float]

    @property
    def outcome(self) -> Outcome:
        """Whether what was measured later lies as near to it as the bands of both allow."""
        halves = (self.amplitude_high / self.amplitude - 1.0, self.omega_high / self.omega - 1.0)
        if not self.coverage or not all(float(np.median(np.abs(half))) < TELLING for half in halves):
            return Outcome.OPEN
        return Outcome.HELD if min(self.coverage.values()) >= HELD else Outcome.MISSED

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
