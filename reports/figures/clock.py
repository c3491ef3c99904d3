"""How time and frequency are written on a figure: Hz when time is in seconds, else rad per time unit."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ridgeback.compare.motion.results import Curve
from ridgeback.numeric.arrays import Array

TAU = 2 * np.pi


@dataclass(frozen=True)
class Clock:
    """Units of a figure over time."""

    time_unit: str

    @property
    def factor(self) -> float:
        """What an angular frequency is multiplied with for display."""
        return 1 / TAU if self.time_unit == "s" else 1.0

    @property
    def unit(self) -> str:
        """The unit of displayed frequencies.

        >>> Clock("s").unit, Clock("").unit
        ('Hz', '')
        """
        return "Hz" if self.time_unit == "s" else (f"rad/{self.time_unit}" if self.time_unit else "")

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
        named = f"{symbol} / 2π" if self.time_unit == "s" else symbol
        return f"{named}, {self.unit}" if self.unit else named


def shown(curve: Curve) -> Array:
    """The angular frequency of a curve, not a number where it is not valid."""
    return np.where(curve.valid, curve.omega, np.nan)
