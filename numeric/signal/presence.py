r"""Whether a record holds an oscillation at all, or what noise alone would show as well.

Noise is a Gaussian process whose spectrum is a power law S(f) = c f^(-a), 0 <= a <= 2: white, 1/f, up to a random walk.
Its periodogram over a Hann window is S(f) times a mean-one exponential variable at every frequency.  A line stands out
of the fitted continuum by the ratio r = I / S; were S the mean of m independent ordinates, r would have the F
distribution with 2 and 2 m degrees of freedom,

    P(ratio > r) = (1 + r / m)^(-m),

and among n ordinates the largest exceeds r with at most n times that probability (Fisher, Proc. R. Soc. A 125 (1929)
54; Vaughan, Astron. Astrophys. 431 (2005) 391, for a fitted power law).  The fit takes the least absolute deviations of
log I, which a line and its harmonics hardly move.  Since it is no mean, the m that makes the false alarms right was
found by trials: one in ORDINATES ordinates counts (benchmarks/trials/false_alarms.py).  A frequency that moves spreads
over the record's spectrum and not over that of a part: the halves, quarters and eighths are looked at as well, and all
their ordinates count in n.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.signal.samples import TWO_PI

FALSE_ALARM = 1e-3
"""Probability that noise alone passes for an oscillation, at most."""
ORDINATES = 6.0
"""Ordinates of the fit that know as much of the continuum as one of a mean."""
FEWEST_CYCLES = 4
"""Cycles in a window from which on a peak is looked at: slower ones cannot be told from drift."""
SHORTEST = 64
"""Samples of the shortest part."""
PARTS = 4
"""The record, its halves, quarters and eighths."""
SHORT_RECORD = 128
"""Samples below which no slope can be fitted and noise is supposed white."""
SLOPES = np.linspace(0.0, 2.0, 21)
MOST_FITTED = 50_000
"""Ordinates that the fit of the continuum takes, evenly spread."""
TINY = 1e-300


@dataclass(frozen=True)
class Presence:
    """How well noise alone explains a record.

    ``probability`` is that of noise alone showing a peak that stands out as much; ``omega`` is where the clearest peak
    is, rad per time unit.
    """

    probability: float
    omega: float

    @property
    def found(self) -> bool:
        """Whether there is an oscillation to be followed."""
        return self.probability <= FALSE_ALARM

    @property
    def reason(self) -> str:
        """Why nothing can be claimed, as a sentence without a full stop; empty where there is an oscillation."""
        if self.found:
            return ""
        return (
            f"no oscillation stands out of the noise: noise alone shows as clear a peak with probability "
            f"{self.probability:.2g}, and at most {FALSE_ALARM:g} is accepted"
        )


def presence(x: Array, rate: float, *, limits: tuple[float, float] | None = None, whole: bool = True) -> Presence:
    """Test a record against noise with a spectrum that is a power law.

    Parameters
    ----------
    x : array of float, shape (N,)
        The samples, at least 16.
    rate : float
        Samples per time unit.
    limits : tuple of float, optional
        Lowest and highest angular frequency, rad per time unit, at which a peak counts.
    whole : bool
        Whether ``limits`` were themselves found in the spectrum, so that every frequency counts as looked at.

    Returns
    -------
    Presence
        The false-alarm probability of the clearest peak.  At most 1 in 1000 records of white or 1/f noise of 200 to
        5000 samples have one below ``FALSE_ALARM``.

    References
    ----------
    S. Vaughan, A simple test for periodic signals in red noise, Astron. Astrophys. 431 (2005) 391.

    Examples
    --------
    >>> t, noise = np.arange(400) / 20.0, np.random.default_rng(1).standard_normal(400)
    >>> presence(noise, 20.0).found, presence(noise + 1.4 * np.cos(9.0 * t), 20.0).found
    (False, True)
    """
    centred = x - x.mean()
    if not np.any(centred):
        return Presence(1.0, 0.0)
    low, high = (0.0, math.inf) if limits is None else limits
    views = short_record(centred) if x.size < SHORT_RECORD else parts_of(centred)
    looked, best, omega = 0, 0.0, 0.0
    for frequency, ratio, freedom in views:
        angular = TWO_PI * rate * frequency
        step = angular[1] - angular[0] if angular.size > 1 else 0.0
        inside = (angular >= low - step) & (angular <= high + step)
        looked += (ratio if whole else ratio[:, inside]).size
        if not inside.any():
            continue
        peaks = np.where(inside, ratio.max(axis=0), 0.0)
        found = log_tail(float(peaks.max()), freedom)
        if found <= best:
            best, omega = found, float(angular[np.argmax(peaks)])
    return Presence(math.exp(min(0.0, best + math.log(max(looked, 1)))), omega)


View = tuple[Array, Array, float]
"""Frequencies in cycles per sample, the ratio of every ordinate to the continuum by part, and m of the formula."""


def parts_of(x: Array) -> Iterator[View]:
    """The record and its halves, quarters and eighths, each overlapping the next by half."""
    for length in lengths(x.size):
        ordinates = periodograms(x, length)
        if ordinates.shape[1] < 2:
            continue
        k = np.arange(FEWEST_CYCLES, FEWEST_CYCLES + ordinates.shape[1], dtype=np.float64)
        freedom = max(ordinates.shape[1] * (x.size / length) / ORDINATES, 1.0)
        yield k / length, ordinates / continuum(ordinates, k), freedom


def lengths(size: int) -> list[int]:
    """Samples of the record and of its parts.

    >>> lengths(1000), lengths(200)
    ([1000, 500, 250, 125], [200, 100])
    """
    return [size >> i for i in range(PARTS) if i == 0 or size >> i >= SHORTEST]


def periodograms(x: Array, length: int) -> Array:
    """Squared spectra of the parts under a Hann window, ``[part, frequency]``, from FEWEST_CYCLES up to Nyquist."""
    parts = sliding_window_view(x, length)[:: max(length // 2, 1)]
    window = np.hanning(length + 2)[1:-1]
    spectra = np.fft.rfft((parts - parts.mean(axis=1, keepdims=True)) * window, axis=1)
    return np.asarray(np.abs(spectra[:, FEWEST_CYCLES : (length + 1) // 2]) ** 2)


def continuum(ordinates: Array, k: Array) -> Array:
    """The power law c k^(-a) of least absolute deviations from the logarithms; an exponential's median is log 2."""
    values = np.log(np.maximum(ordinates, TINY)).ravel()
    places = np.broadcast_to(np.log(k), ordinates.shape).ravel()
    every = max(1, values.size // MOST_FITTED)
    best = min((fitted(values[::every], places[::every], float(slope)) for slope in SLOPES), key=lambda fit: fit[0])
    return np.asarray(np.exp(best[1] - best[2] * np.log(k)) / math.log(2.0))


def fitted(values: Array, places: Array, slope: float) -> tuple[float, float, float]:
    """Mean absolute deviation, level and slope of the law with this slope."""
    flat = values + slope * places
    level = float(np.median(flat))
    return float(np.abs(flat - level).mean()), level, slope


# The line of least squares at one frequency takes the share R^2 of the squares; for white noise P(R^2 > s) =
# (1 - s)^((N - 3) / 2), which is the formula above with m = (N - 3) / 2 and r = m R^2 / (1 - R^2).
def short_record(x: Array) -> Iterator[View]:
    """The whole record against white noise, at twice as many frequencies as are independent."""
    freedom = 0.5 * (x.size - 3)
    spectrum = np.abs(np.fft.rfft(x, 2 * x.size)) ** 2
    share = np.minimum(2.0 * spectrum / (x.size * float(x @ x)), 1.0 - 1e-12)[4:-1]
    frequency = np.arange(4, 4 + share.size) / (2.0 * x.size)
    yield frequency, (freedom * share / (1.0 - share))[None, :], freedom


def log_tail(ratio: float, freedom: float) -> float:
    """log of (1 + r / m)^(-m).

    >>> round(math.exp(log_tail(3.0, 1e9)), 4)  # of many ordinates an exponential: exp(-3)
    0.0498
    """
    return -freedom * math.log1p(ratio / freedom)
