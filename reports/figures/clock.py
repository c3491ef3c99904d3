"""How time and frequency are written on a figure: in Hz or per hour, day or year of a clock, else in rad per unit."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ridgeback.common.quantities import DAY, HOUR, SECOND, YEAR
from ridgeback.compare.motion.results import Curve
from ridgeback.numeric.arrays import Array

TAU = 2 * np.pi
PACES = {pace.sign: pace for pace in (SECOND, HOUR, DAY, YEAR)}


@dataclass(frozen=True)
class Clock:
    """Units of a figure over time."""

    time_unit: str
    seconds: float = 1.0
    """Of a time unit."""

    @property
    def factor(self) -> float:
        """What an angular frequency is multiplied with for display."""
        return 1 / TAU if self.time_unit in PACES else 1.0

    @property
    def unit(self) -> str:
        """The unit of displayed frequencies.

        >>> Clock("s").unit, Clock("d").unit, Clock("").unit
        ('Hz', 'cycles per day', '')
        """
        if self.time_unit == SECOND.sign:
            return "Hz"
        if self.time_unit in PACES:
            return f"cycles per {self.word}"
        return f"rad/{self.time_unit}" if self.time_unit else ""

    @property
    def word(self) -> str:
        """A time unit in a sentence; s stays s.

        >>> Clock("s").word, Clock("d").word
        ('s', 'day')
        """
        slow = self.time_unit in PACES and self.time_unit != SECOND.sign
        return PACES[self.time_unit].name if slow else self.time_unit

    @property
    def growth_title(self) -> str:
        """The title of an axis of growth rates.

        >>> Clock("s").growth_title, Clock("d").growth_title
        ('growth rate a′/a, 1/s', 'growth rate a′/a, per day')
        """
        return f"growth rate a′/a, {f'1/{self.word}' if self.word == self.time_unit else f'per {self.word}'}"

    @property
    def time_title(self) -> str:
        """The title of a time axis.

        >>> Clock("s").time_title, Clock("").time_title
        ('t, s', 't')
        """
        return f"t, {self.time_unit}" if self.time_unit else "t"

    def title(self, symbol: str = "ω₀") -> str:
        """The title of a frequency axis.

        >>> Clock("s").title(), Clock("").title()
        ('ω₀ / 2π, Hz', 'ω₀')
        """
        named = f"{symbol} / 2π" if self.time_unit in PACES else symbol
        return f"{named}, {self.unit}" if self.unit else named


SECONDS = Clock("s")


def shown(curve: Curve) -> Array:
    """The angular frequency of a curve, not a number where it is not valid."""
    return np.where(curve.valid, curve.omega, np.nan)
