"""What every estimator is given: the checked signal, where to look, and how long a window."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from numeric.curvature import held
from numeric.errors import InputError
from numeric.noise import Level, measure_level
from numeric.samples import TWO_PI, Array, ComplexArray, Mask
from numeric.search_band import Corridor
from numeric.windows import half_width

FEWEST_VALID = 8


@dataclass(frozen=True)
class Request:
    """What an estimator needs to know, checked."""

    x: Array
    z: ComplexArray
    rate: float
    start: float
    corridor: Corridor
    lag_seconds: float
    lag_window: str
    smoothing_seconds: float
    harmonics: int | None
    remove_bias: bool
    bias: bool

    @property
    def time(self) -> Array:
        """Sample times."""
        return self.start + np.arange(self.x.size) / self.rate

    @property
    def half(self) -> int:
        """Half the lag window, in samples."""
        return half_width(self.lag_seconds, self.rate, longest=self.x.size)

    @property
    def cycle(self) -> float:
        """The longest period that the corridor's guide shows."""
        return TWO_PI / float(self.corridor.guide.min())

    def away_from_border(self, seconds: float) -> Mask:
        """True at samples at least ``seconds`` inside the record."""
        t = self.time - self.start
        slack = 1e-9 / self.rate
        return np.asarray((t >= seconds - slack) & (t <= t[-1] - seconds + slack), dtype=np.bool_)

    def level(self, omega: Array, valid: Mask) -> Level:
        """Amplitude and noise along a track."""
        return measure_level(self.x, self.rate, held(self.time, omega, valid), half=self.half)

    def settings(self, **more: object) -> dict[str, object]:
        """What every track reports, and more."""
        low, high = self.corridor.limits
        return {"rate": self.rate, "start": self.start, "band_rad": (low, high), "band_why": self.corridor.why, **more}


def need(valid: Mask, method: str, border: float) -> None:
    """Refuse a track with hardly a valid sample."""
    if np.count_nonzero(valid) < FEWEST_VALID:
        raise InputError(
            f"{method}: {np.count_nonzero(valid)} samples of {valid.size} lie {border:.4g} inside the record "
            f"and have a peak in the band; give a longer record, a shorter lag_seconds or another band"
        )
