"""A long record at a rate far above its oscillation, brought down to what an estimator of the fundamental needs."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.ndimage import maximum_filter1d

from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.late import signal
from ridgeback.numeric.signal.samples import TWO_PI, checked_rate, checked_real_samples, checked_swing
from ridgeback.numeric.signal.search_band import SearchBand, find_search_band

LONG = 16_384
"""Samples above which a record is decimated."""
PER_CYCLE = 10.0
"""Samples per fastest cycle that are kept: room for the search band and the third harmonic."""
RINGING = 10
"""Samples at each end, after decimation, that the filter reaches beyond the record for: they are cut off."""
FLAT, PASSED = 8.0, 0.75
"""Shape of the filter's Kaiser window: its gain is 1 to 1e-4 up to so much of the new Nyquist frequency."""


@dataclass(frozen=True)
class Samples:
    """Real samples that have been checked, the first one at ``start``.

    ``factor`` is above 1 where they are every ``factor``-th one of a low-passed record.
    """

    x: Array
    rate: float
    start: float
    factor: int = 1
    wrong: Mask | None = None
    """Samples that are known to be no part of the motion, such as clipped ones."""

    @property
    def time(self) -> Array:
        """Time of each sample."""
        return self.start + np.arange(self.x.size) / self.rate


def checked(x: ArrayLike, rate: float, *, start: float, what: str, at_least: int = 1) -> Samples:
    """The samples as they come in, checked once; ``what`` names the work that wants them.

    >>> checked([1, 2], 0.0, start=0.0, what="estimate")
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: sampling rate 0.0 is not positive; give samples per time unit, such as 32.0
    """
    samples = checked_swing(checked_real_samples(x, what=what, at_least=at_least))
    return Samples(samples, checked_rate(rate), float(start))


def decimated(
    samples: Samples, *, band: tuple[float, float] | None, per_cycle: float = PER_CYCLE, longest: int = LONG
) -> tuple[Samples, SearchBand | None]:
    """Decimate a record of more than ``longest`` samples by a linear-phase filter; a shorter one is handed back as is.

    The search band that tells how many samples are needed comes with them, None where it was not looked for.

    >>> t = np.arange(40_000) / 8000.0
    >>> few, search = decimated(Samples(np.cos(2 * np.pi * 100.0 * t), 8000.0, 0.0), band=None)
    >>> few.factor, round(few.rate, 2), bool(np.abs(few.x - np.cos(2 * np.pi * 100.0 * few.time)).max() < 1e-4)
    (7, 1142.86, True)
    >>> search.guide.size == few.x.size
    True
    """
    x, rate = samples.x, samples.rate
    if x.size <= longest or not np.ptp(x) > 0.0:
        return samples, None
    search = find_search_band(x - x.mean(), rate, band=band)
    factor = int(TWO_PI * rate / (float(search.guide.max()) * per_cycle))
    if factor < 2:
        return samples, search
    few = every(samples, factor)
    places = factor * (RINGING + np.arange(few.x.size, dtype=np.float64))
    return few, search.at(places, math.pi * few.rate)


def every(samples: Samples, factor: int) -> Samples:
    """Every ``factor``-th sample of the low-passed signal, without the RINGING ones at either end.

    >>> few = every(Samples(np.ones(400), 100.0, 2.0), 5)
    >>> few.x.size, few.rate, few.start, bool(np.allclose(few.x, 1.0))
    (60, 20.0, 2.5, True)
    """
    x = np.asarray(
        signal.resample_poly(samples.x, 1, factor, window=("kaiser", FLAT))[RINGING:-RINGING], dtype=np.float64
    )
    wrong = None if samples.wrong is None else every_flag(samples.wrong, factor)
    return Samples(x, samples.rate / factor, samples.start + RINGING * factor / samples.rate, factor, wrong)


def every_flag(flags: Mask, factor: int) -> Mask:
    """Which samples of :func:`every` have a flagged one within the main part of their filter, a step to either side.

    >>> np.flatnonzero(every_flag(np.arange(400) == 42, 4)).tolist()
    [0, 1]
    """
    return np.asarray(maximum_filter1d(flags, 2 * factor + 1)[::factor][RINGING:-RINGING], dtype=np.bool_)


def decimation_notes(samples: Samples, first: float, last: float) -> tuple[str, ...]:
    """What decimation left out of a record from one time to another; nothing where it was not decimated.

    >>> few = every(Samples(np.ones(400), 100.0, 0.0), 5)
    >>> decimation_notes(few, 0.0, 3.99)[0][:61]
    'Of the low-passed samples one in 5 is used: nothing above 7.5'
    >>> decimation_notes(Samples(np.ones(4), 1.0, 0.0), 0.0, 3.0)
    ()
    """
    if samples.factor < 2:
        return ()
    highest, end = 0.5 * PASSED * samples.rate, float(samples.time[-1])
    return (
        f"Of the low-passed samples one in {samples.factor} is used: nothing above {highest:.4g} Hz is "
        f"looked for, and of the time the first {samples.start - first:.3g} and the last {max(0.0, last - end):.3g} "
        "time units are left out.",
    )
