"""The slow part of a signal below its oscillation: how far it wanders, and its removal when that is wanted."""

from __future__ import annotations

import math

import numpy as np
from scipy.fft import rfft
from scipy.ndimage import maximum_filter1d

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.late import signal
from ridgeback.numeric.signal.convolution import convolved
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.signal.search_band import strongest_frequency
from ridgeback.numeric.signal.windows import window

DETRENDS = ("none", "linear", "slow")
CYCLES = 6.0
"""Length of the Blackman low-pass in cycles: its first zero is at half the oscillation's frequency."""
NOTABLE = 0.02
"""Wandering, as a share of the signal's rms, from which on it is mentioned."""
RARELY = 0.01
"""Probability that a local mean of white noise goes beyond what is taken for noise, once in the record."""
MOST_SAMPLES = 4_000_000
"""Samples up to which the slow part is looked for: its spectrum takes 130 bytes a sample."""


def slow_part(x: Array, rate: float) -> Array:
    """Weighted local mean over CYCLES cycles of the strongest component; near an end, over what there is of them.

    >>> t = np.arange(2000) / 20.0
    >>> found = slow_part(np.cos(6.0 * t) + 0.01 * t, 20.0)
    >>> bool(np.abs(found - 0.01 * t)[100:-100].max() < 1e-3)
    True
    """
    half = round(0.5 * CYCLES * TWO_PI / strongest_frequency(x, rate) * rate)
    w = window("blackman", min(half, (x.size - 1) // 2))
    weights = convolved(np.ones(x.size), w)
    return np.asarray(convolved(x, w) / weights, dtype=np.float64)


def wandering(x: Array, rate: float, wrong: Mask | None = None) -> float:
    """How far the slow part moves between the ends, where it sees whole windows, as a share of the signal's rms.

    Windows that see samples which are ``wrong`` do not count.  0 where the record is too short to tell, and where white
    noise of the level of its spectrum moves a local mean as far; NaN where it is longer than MOST_SAMPLES.

    >>> t, noise = np.arange(2000) / 20.0, 0.3 * np.random.default_rng(1).normal(size=2000)
    >>> [round(wandering(np.cos(6.0 * t) + noise + slope * t, 20.0), 1) for slope in (0.0, 0.01)]
    [0.0, 1.2]
    """
    if x.size > MOST_SAMPLES:
        return math.nan
    half = round(0.5 * CYCLES * TWO_PI / strongest_frequency(x, rate) * rate)
    if x.size < 4 * half:
        return 0.0
    inside = slow_part(x, rate)[half:-half]
    if wrong is not None:
        inside = inside[~maximum_filter1d(wrong, 2 * half + 1)[half:-half]]
    far = float(np.ptp(inside)) if inside.size else 0.0
    return far / float(np.std(x)) if far > range_of_noise(x, window("blackman", half)) else 0.0


# A mean with weights w of noise of spectral level s^2 has the variance s^2 sum w^2 / (sum w)^2, and crosses h of its
# deviations upward n sqrt(sum w'^2 / sum w^2) exp(-h^2 / 2) / (2 pi) times in n samples (S. O. Rice, Bell Syst. Tech.
# J. 24 (1945) 46).  The median of an ordinate of a periodogram is ln 2 of its mean.
def range_of_noise(x: Array, w: Array) -> float:
    """How far a mean with weights ``w`` moves up and down in noise of the level of most of the spectrum of ``x``."""
    taper = window("hann", (x.size - 1) // 2)
    power = np.abs(rfft((x[: taper.size] - x.mean()) * taper)) ** 2 / float(taper @ taper)
    deviation = math.sqrt(float(np.median(power)) / math.log(2.0) * float(w @ w)) / float(w.sum())
    slope = np.diff(w)
    crossings = x.size * math.sqrt(float(slope @ slope) / float(w @ w)) / TWO_PI
    return 2.0 * deviation * math.sqrt(2.0 * math.log(max(crossings, 1.0) / RARELY))


def detrended(x: Array, rate: float, how: str) -> Array:
    """The signal without its straight line ("linear", scipy's) or its slow part ("slow"); "none" leaves it.

    >>> detrended(np.arange(5.0), 1.0, "linear").round(9).tolist()
    [0.0, 0.0, 0.0, 0.0, 0.0]
    """
    if how not in DETRENDS:
        raise InputError(f"detrend {how!r} is unknown; use one of {', '.join(DETRENDS)}")
    if how == "linear":
        return np.asarray(signal.detrend(x, type="linear"), dtype=np.float64)
    return x - slow_part(x, rate) if how == "slow" else x


def said_of(drift: float) -> tuple[str, ...]:
    """A share of the rms by which the slow part wanders, in words where it is notable.

    >>> said_of(0.01), said_of(math.nan)
    ((), ('Drift was not looked for in so long a record.',))
    """
    if math.isnan(drift):
        return ("Drift was not looked for in so long a record.",)
    if drift <= NOTABLE:
        return ()
    return (
        f"The local mean wanders by {drift:.2g} of the rms; it is left in (--detrend slow removes it; in an asymmetric "
        "oscillator it belongs to the motion).",
    )
