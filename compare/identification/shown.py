"""How an identification shows itself: its verdict in a line, the candidates as a table, backbones as a picture."""

from __future__ import annotations

from typing import Any, ClassVar

from ridgeback.common.show.displayed import Displayed
from ridgeback.common.show.picture import Picture, Stroke

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
