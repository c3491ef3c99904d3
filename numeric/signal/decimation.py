"""A long record at a rate far above its oscillation, brought down to what an estimator of the fundamental needs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import maximum_filter1d
from scipy.signal import resample_poly

from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.signal.search_band import find_corridor

LONG = 16_384
"""Samples above which a record is decimated."""
PER_CYCLE = 10.0
"""Samples per fastest cycle that are kept: room for the corridor and the third harmonic."""
RINGING = 10
"""Samples at each end, after decimation, that the filter reaches beyond the record for: they are cut off."""
FLAT = 8.0
"""Shape of the filter's Kaiser window: its gain is 1 to 1e-4 up to three quarters of the new Nyquist frequency."""


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
    """Decimate a record of more than LONG samples by a linear-phase filter; a shorter one is handed back as is.

    >>> t = np.arange(40_000) / 8000.0
    >>> few = decimated(np.cos(2 * np.pi * 100.0 * t), 8000.0, start=0.0, band=None)
    >>> expected = np.cos(2 * np.pi * 100.0 * (few.start + np.arange(few.x.size) / few.rate))
    >>> few.factor, round(few.rate, 2), bool(np.abs(few.x - expected).max() < 1e-4)
    (7, 1142.86, True)
    """
    same = Decimated(x, rate, start, 1)
    if x.size <= LONG or not np.ptp(x) > 0.0:
        return same
    fastest = float(find_corridor(x - x.mean(), rate, band=band).guide.max())
    factor = int(TWO_PI * rate / (fastest * per_cycle))
    if factor < 2:
        return same
    return every(x, rate, factor, start=start)


def every(x: Array, rate: float, factor: int, *, start: float) -> Decimated:
    """Every ``factor``-th sample of the low-passed signal, without the RINGING ones at either end.

    >>> few = every(np.ones(400), 100.0, 5, start=2.0)
    >>> few.x.size, few.rate, few.start, bool(np.allclose(few.x, 1.0))
    (60, 20.0, 2.5, True)
    """
    few = resample_poly(x, 1, factor, window=("kaiser", FLAT))[RINGING:-RINGING]
    return Decimated(np.asarray(few, dtype=np.float64), rate / factor, start + RINGING * factor / rate, factor)


def every_flag(flags: Mask, factor: int) -> Mask:
    """Which samples of :func:`every` have a flagged one within the main part of their filter, a step to either side.

    >>> np.flatnonzero(every_flag(np.arange(400) == 42, 4)).tolist()
    [0, 1]
    """
    return np.asarray(maximum_filter1d(flags, 2 * factor + 1)[::factor][RINGING:-RINGING], dtype=np.bool_)
