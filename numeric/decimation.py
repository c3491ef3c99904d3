"""A long record at a rate far above its oscillation, brought down to what an estimator of the fundamental needs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.signal import decimate

from numeric.samples import TWO_PI, Array
from numeric.search_band import find_corridor

LONG = 16_384
"""Samples above which a record is decimated."""
PER_CYCLE = 10.0
"""Samples per fastest cycle that are kept: room for the corridor and the third harmonic."""
RINGING = 10
"""Samples at each end, after decimation, that scipy's filter reaches beyond the record for: they are cut off."""


@dataclass(frozen=True)
class Decimated:
    """Every ``factor``-th sample of a low-passed signal, the first one at ``start``."""

    x: Array
    rate: float
    start: float
    factor: int


def decimated(
    x: Array, rate: float, *, start: float, band: tuple[float, float] | None, per_cycle: float = PER_CYCLE
) -> Decimated:
    """Decimate a record of more than LONG samples by scipy's linear-phase filter; a shorter one is handed back as is.

    >>> t = np.arange(40_000) / 8000.0
    >>> few = decimated(np.cos(2 * np.pi * 100.0 * t), 8000.0, start=0.0, band=None)
    >>> expected = np.cos(2 * np.pi * 100.0 * (few.start + np.arange(few.x.size) / few.rate))
    >>> few.factor, round(few.rate, 2), bool(np.abs(few.x - expected).max() < 2e-3)
    (7, 1142.86, True)
    """
    same = Decimated(x, rate, start, 1)
    if x.size <= LONG or not np.ptp(x) > 0.0:
        return same
    fastest = float(find_corridor(x - x.mean(), rate, band=band).guide.max())
    factor = int(TWO_PI * rate / (fastest * per_cycle))
    if factor < 2:
        return same
    few = decimate(x, factor, ftype="fir", zero_phase=True)[RINGING:-RINGING]
    return Decimated(np.asarray(few, dtype=np.float64), rate / factor, start + RINGING * factor / rate, factor)
