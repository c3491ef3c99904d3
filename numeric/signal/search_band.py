"""Where to look for the fundamental: a search band around the strongest component, found from the data.

The search band follows the ridge of a spectrogram some six cycles long and keeps a factor away from it on both sides,
so that the constant, the second and the third harmonic stay outside even when omega0 itself moves by more than that.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy import fft
from scipy.ndimage import gaussian_filter1d

from ridgeback.common.errors import InputError
from ridgeback.common.quantities import angular
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.late import signal
from ridgeback.numeric.signal.local_line import local_line
from ridgeback.numeric.signal.samples import TWO_PI, Floats, checked_budget
from ridgeback.numeric.signal.windows import half_width, window

MARGIN = 1.45
"""Half width of a search band as a factor: below 1.5, so that a second harmonic 1.45 times off it stays out."""
GUIDE_CYCLES = 6.0
FEWEST_CYCLES, LEAST_CYCLES = 3.0, 2.5
"""Cycles per record from which on a line is looked for, and from which on one of which the first shows a flank."""
NO_DRIFT = 0.5
"""Share of such a flank that is left when a straight line is taken off the samples, where it is that of a line."""
CLEAR = 100.0
"""Of the median of the spectrum, that its highest line exceeds in white noise with hardly any probability."""
CLEAR_AT_AN_END = 40.0
"""The same for a line of a record that holds nothing else than noise for the most of it."""
WANDERING = 0.05
"""Of the signal's rms, by which a local mean wanders that is drift."""
LONG = 100_000
BLOCK_VALUES = 60_000
"""Values that the segments of one block of columns hold, padded: half a megabyte."""
ENOUGH_COLUMNS, MOST_STEPS = 10_000, 4
"""Columns of a path from which on they are further apart, up to so many quarters of a cycle."""
MEMORY, MEMORY_PER_LEVEL = 1_000_000_000, 6
THINNED = 1.25
"""Nyquist frequency of a thinned record over the highest frequency looked for."""


@dataclass(frozen=True)
class SearchBand:
    """Band limits per sample (rad per time unit), the guide between them, its strongest line, and how it was found."""

    low: Array
    high: Array
    guide: Array
    centre: float
    why: str

    @property
    def limits(self) -> tuple[float, float]:
        """The lowest low and the highest high."""
        return float(self.low.min()), float(self.high.max())

    def at(self, places: Array, nyquist: float) -> SearchBand:
        """The same band at some places (in samples, between them too), cut off at a Nyquist frequency.

        >>> SearchBand(np.ones(3), np.full(3, 9.0), np.arange(2.0, 5.0), 3.0, "example").at(np.array([0.5]), 6.0).limits
        (1.0, 6.0)
        """
        n = np.arange(self.guide.size)
        low, high, guide = (np.interp(places, n, values) for values in (self.low, self.high, self.guide))
        return replace(self, low=low, high=np.minimum(high, nyquist), guide=guide)


def strongest_frequency(x: Array, rate: float, *, band: tuple[float, float] | None = None) -> float:
    """Angular frequency of the highest line of the Hann-windowed spectrum within ``band``.

    By default everything above FEWEST_CYCLES per record counts: the constant and slow drift are left out.  Where the
    highest ordinate is on the flank of a peak below, that peak counts if it is above LEAST_CYCLES and no drift.  A
    motion at one end of the record is under the edge of a Hann window: where no line is CLEAR, the falling and the
    rising half of a window twice as long are tried too, and the clearest line counts.

    >>> t = np.arange(320) / 32.0
    >>> round(strongest_frequency(np.cos(2 * np.pi * 1.5 * t), rate=32.0) / (2 * np.pi), 2)
    1.5
    """
    padded = 4 * x.size if x.size <= LONG else fft.next_fast_len(x.size, real=True)
    omega = TWO_PI * rate * np.arange(padded // 2 + 1) / padded
    low, high = band or (TWO_PI * rate * FEWEST_CYCLES / x.size, math.pi * rate)
    within = (omega >= low) & (omega <= high)
    best, clearest = 0.0, 0.0
    for taper in tapers(x.size):
        power = power_of(x - x.mean(), taper, padded)
        spectrum = np.where(within, power, 0.0)
        at, typical = int(spectrum.argmax()), float(np.median(spectrum[within])) if within.any() else 0.0
        clear = float(spectrum[at]) / max(typical, np.finfo(float).tiny)
        if band is None and power[at - 1] > power[at] > 0.0:
            level = power_of(signal.detrend(x), taper, padded)
            least = math.ceil(LEAST_CYCLES * padded / x.size)
            at = peak_below(level, at, least) if level[at] > NO_DRIFT * power[at] else least
        if clear > max(clearest, CLEAR_AT_AN_END if clearest else 0.0):
            best, clearest = float(omega[at]), clear
        if clear > CLEAR:
            break
    if not clearest > 0.0:
        raise InputError(
            f"signal of {x.size} samples shows no oscillation in the band {angular(low, high)}; "
            f"give a longer record or another --band"
        )
    return best


def power_of(x: Array, taper: Array, padded: int) -> Array:
    """The periodogram under a taper."""
    return np.asarray(np.abs(fft.rfft(x * taper, padded)) ** 2)


def peak_below(power: Array, at: int, least: int) -> int:
    """The peak whose upper flank an ordinate stands on; ``least`` where that is lower, as on the flank of a drift.

    >>> power = np.array([9.0, 2, 3, 5, 4, 1])
    >>> peak_below(power, 4, 2), peak_below(power, 3, 2), peak_below(power[::-1].cumsum()[::-1], 4, 2)
    (3, 3, 2)
    """
    peak = at
    while peak > least and power[peak - 1] > power[peak]:
        peak -= 1
    return peak


def tapers(size: int) -> Iterator[Array]:
    """A Hann window, and the falling and the rising half of one over the whole record: for a motion at one of its ends.

    >>> [taper.round(2).tolist() for taper in tapers(3)]
    [[0.0, 1.0, 0.0], [1.0, 0.5, 0.0], [0.0, 0.5, 1.0]]
    """
    yield np.hanning(size)
    falling = np.hanning(2 * size - 1)[size - 1 :]
    yield falling
    yield falling[::-1]


def continuous_path(level: Floats, reach: int) -> NDArray[np.intp]:
    """Row indices of the path through ``level[row, column]`` with the largest sum, moving at most ``reach`` a column.

    >>> continuous_path(np.array([[9.0, 0, 0], [0, 9, 0], [0, 0, 9]]), reach=1).tolist()
    [0, 1, 2]
    """
    rows, columns = level.shape
    came, every = np.zeros((rows, columns), dtype=np.int16), np.arange(rows)
    padded = np.full(rows + 2 * reach, -np.inf)
    best, choices = padded[reach : reach + rows], np.lib.stride_tricks.sliding_window_view(padded, 2 * reach + 1)
    best[:] = level[:, 0]
    for column in range(1, columns):
        pick = choices.argmax(axis=1)
        came[:, column] = pick - reach
        best[:] = choices[every, pick] + level[:, column]
    path = np.empty(columns, dtype=np.intp)
    path[-1] = best.argmax()
    for column in range(columns - 1, 0, -1):
        path[column - 1] = path[column] + came[path[column], column]
    return path


def guide_path(x: Array, rate: float, centre: float, low: float, high: float) -> Array:
    """Frequency per sample along the strongest continuous path of a spectrogram between ``low`` and ``high``.

    A long record with far more samples a cycle than the path needs is thinned first.
    """
    factor = int(math.pi * rate / (THINNED * high)) if x.size > LONG else 1
    if factor > 1:
        thin = guide_path(signal.decimate(x, factor, ftype="fir"), rate / factor, centre, low, high)
        return np.asarray(np.interp(np.arange(x.size), factor * np.arange(thin.size), thin), dtype=np.float64)
    seconds = min(GUIDE_CYCLES * TWO_PI / centre, (x.size - 1) / rate * 0.999)
    x = without_drift(x, half_width(seconds, rate, longest=x.size))
    fine = max(1, round(0.25 * TWO_PI / centre * rate))
    hop = max(fine, min(MOST_STEPS * fine, x.size // ENOUGH_COLUMNS))
    n_fft = fft.next_fast_len(max(int(8 * seconds * rate), 64), real=True)
    ridge = Columns(half_width(seconds, rate, longest=x.size), hop, n_fft)
    omega = TWO_PI * rate * np.arange(n_fft // 2 + 1) / n_fft
    rows = np.flatnonzero((omega >= low) & (omega <= high))
    if not rows.size:
        return np.full(x.size, centre)
    path = omega[rows][continuous_path(ridge.levels(x, slice(rows[0], rows[-1] + 1)), reach=round(3 * hop / fine))]
    smooth = gaussian_filter1d(path, GUIDE_CYCLES * fine / hop, mode="nearest")
    return np.asarray(np.interp(np.arange(x.size), hop * np.arange(path.size), smooth), dtype=np.float64)


def without_drift(x: Array, half: int) -> Array:
    """Samples less what wanders beneath, where that is notable: its foot in a spectrum hides the tail of a decay.

    That is the local mean, and at the ends, where it sees half a window, its tangent.

    >>> t = np.arange(800) / 20.0
    >>> left = without_drift(0.3 * t + np.cos(6.0 * t), 63)
    >>> bool(np.abs(left - np.cos(6.0 * t)).max() < 0.01)
    True
    """
    if x.size < 4 * half:
        return x
    mean, slope = (part.real for part in local_line(x.astype(np.complex128), window("blackman", half), 1.0))
    inside = np.arange(half, x.size - half)
    if float(np.ptp(mean[inside])) <= WANDERING * float(np.std(x)):
        return x
    nearest = np.clip(np.arange(x.size), inside[0], inside[-1])
    return np.asarray(x - mean[nearest] - slope[nearest] * (np.arange(x.size) - nearest), dtype=np.float64)


@dataclass(frozen=True)
class Columns:
    """Columns of a Hann spectrogram, every ``hop`` samples: half a window, and the length of the transform."""

    half: int
    hop: int
    n_fft: int

    def levels(self, x: Array, rows: slice) -> Floats:
        """Logarithms of the bins ``rows`` relative to the highest of them, ``[row, column]``, a block at a time."""
        frames, height = -(-x.size // self.hop), rows.stop - rows.start
        checked_budget(MEMORY_PER_LEVEL * frames * height, MEMORY, f"the search for a path through {frames} columns by "
            f"{height} bins", "give a narrower band")  # fmt: skip
        w, padded = window("hann", self.half), np.pad(x - x.mean(), self.half)
        segments = np.lib.stride_tricks.sliding_window_view(padded, w.size)[:: self.hop]
        found, block = np.empty((height, frames), dtype=np.float32), max(1, BLOCK_VALUES // self.n_fft)
        for first in range(0, frames, block):
            spectra = fft.rfft(segments[first : first + block] * w, self.n_fft, axis=1)[:, rows]
            values = (spectra.real**2 + spectra.imag**2).T
            highest = np.maximum(values.max(axis=0), np.finfo(float).tiny)
            found[:, first : first + block] = np.log(values / highest + 1e-6)
        return found


def checked_band(band: tuple[float, float], rate: float) -> tuple[float, float]:
    """Return a band (low, high) in rad per time unit that lies within 0 .. Nyquist."""
    low, high = float(band[0]), float(band[1])
    nyquist = math.pi * rate
    if not (math.isfinite(low) and math.isfinite(high) and 0.0 <= low < high <= nyquist * (1 + 1e-12)):
        raise InputError(
            f"band ({low:g}, {high:g}) rad per time unit is not usable; need 0 <= low < high <= "
            f"{nyquist:.6g} (Nyquist, {0.5 * rate:.6g} Hz)"
        )
    return low, high


def find_search_band(x: Array, rate: float, *, band: tuple[float, float] | None = None) -> SearchBand:
    """Return where to look for the fundamental of a signal.

    Parameters
    ----------
    x : array of float, shape (N,)
        Samples, without their mean.
    rate : float
        Samples per time unit.
    band : (float, float), optional
        Lowest and highest frequency, rad per time unit; by default a factor MARGIN around the strongest line, along the
        ridge of a spectrogram.

    Returns
    -------
    SearchBand
        Limits and a guide between them, per sample.

    Raises
    ------
    InputError
        For a band outside 0 .. Nyquist, and where there is no oscillation.

    Examples
    --------
    >>> t = np.arange(640) / 32.0
    >>> search = find_search_band(np.cos(2 * np.pi * 1.5 * t), 32.0)
    >>> [round(limit / (2 * np.pi), 1) for limit in search.limits]
    [1.0, 2.2]
    """
    if band is not None:
        low, high = checked_band(band, rate)
        centre = strongest_frequency(x, rate, band=(low, high))
        ones = np.ones(x.size)
        return SearchBand(low * ones, high * ones, guide_path(x, rate, centre, low, high), centre, "band given")
    centre = strongest_frequency(x, rate)
    guide = guide_path(x, rate, centre, 0.25 * centre, 4.0 * centre)
    why = f"a factor {MARGIN} around the strongest component, near {angular(centre)}"
    return SearchBand(guide / MARGIN, np.minimum(guide * MARGIN, math.pi * rate), guide, centre, why)
