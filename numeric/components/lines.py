"""Lines that stand out of what a model leaves of a signal, and how strong its noise is near the oscillation.

The periodogram of white noise is exponentially distributed round the level of its neighbourhood: among n ordinates the
largest exceeds level (ln n + SURE) with probability e^-SURE.  The level is the median of the neighbourhood over ln 2.
Halves of a Hann window are used beside the whole, since another mode may have decayed long before the record ends.
"""

from __future__ import annotations

import math

import numpy as np
from scipy import fft
from scipy.ndimage import median_filter

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.harmonics.harmonic_zones import Zone, in_zones
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.signal.search_band import tapers

SURE = 8.0
"""A line that is none has a probability of e^-8, 3 in 10,000."""
LEAST = 1e-3
"""Of the oscillation's amplitude, that another component must have: what a model of a clean signal leaves is none."""
NEIGHBOURS = 0.2
"""Of the spectrum, whose median is the level."""
FEWEST_NEIGHBOURS = 101
LOWEST_CYCLES = 3.0
STRETCHES, CLEARLY = 4, 3.5
"""Of a record, in which noise may differ, and deviations by which it does."""
FEWEST_BINS = 8
"""Ordinates beside the oscillation from which on their mean says more than that of all."""
BESIDE = 0.35
"""Relative distance from the oscillation up to which noise matters."""
WIDE = 4.0
"""Factor from the oscillation within which its spectrum is taken for a power law."""
SHRINK = 2.0
"""Times its variance over its square, by which a logarithm is shrunk to 0 like those of James and Stein."""


def clearest_line(left: Array, rate: float, least: float = 0.0, taken: tuple[Zone, ...] = ()) -> float | None:
    """Angular frequency of the line that stands out most of a residual, of amplitude ``least`` at least; else None.

    What is in the zones that are ``taken`` does not count.

    >>> t, noise = np.arange(600) / 20.0, np.random.default_rng(1).normal(size=600)
    >>> clearest_line(noise, 20.0) is None, round(clearest_line(noise + 0.4 * np.cos(14.0 * t), 20.0), 1)
    (True, 14.0)
    """
    omega = TWO_PI * rate * fft.rfftfreq(left.size)
    usable = (omega >= TWO_PI * rate * LOWEST_CYCLES / left.size) & ~in_zones(omega, taken)
    width = max(FEWEST_NEIGHBOURS, round(NEIGHBOURS * omega.size)) | 1
    best, beyond = None, 1.0
    for taper in tapers(left.size):
        spectrum = np.abs(fft.rfft(left * taper)) ** 2
        level = median_filter(spectrum, min(width, omega.size), mode="mirror") / math.log(2.0)
        large = usable & (2.0 * np.sqrt(spectrum) > least * float(taper.sum()))
        ratio = np.where(large, spectrum / np.maximum(level, np.finfo(float).tiny), 0.0)
        ratio /= math.log(3.0 * omega.size) + SURE
        at = int(ratio.argmax())
        if ratio[at] > beyond:
            best, beyond = float(omega[at]), float(ratio[at])
    return best


def colour(left: Array, rate: float, omega: float, taken: int) -> float:
    """The noise's power near a frequency over its mean power: 1 for white noise, and where too little is known.

    A power law is fitted to the ordinates within a factor of WIDE, and the mean of those close by, within BESIDE, held
    against it: either is shrunk by what it is known to.

    Parameters
    ----------
    left : array of float, shape (N,)
        What a model leaves of the samples.
    rate : float
        Samples per time unit.
    omega : float
        The oscillation's frequency, rad per time unit.
    taken : int
        Coefficients of each of the model's splines: they take up the noise up to half as many ordinates away, about 0
        and about each harmonic.

    References
    ----------
    J. Geweke and S. Porter-Hudak, J. Time Ser. Anal. 4 (1983) 221 (a power law by regression of the log periodogram).

    Examples
    --------
    >>> noise = np.random.default_rng(1).normal(size=2000)
    >>> bool(abs(colour(noise, 20.0, 14.0, 8) - 1.0) < 0.2), round(colour(np.cumsum(noise), 20.0, 14.0, 8), 4) < 0.05
    (True, True)
    """
    spectrum, at = np.abs(fft.rfft(left)) ** 2, fft.rfftfreq(left.size) * left.size
    here = omega / TWO_PI / rate * left.size
    mean = float(spectrum[at > 0].mean())
    free = np.abs(at - here * np.round(at / here)) > 0.5 * taken + 1.0
    around = free & (at > here / WIDE) & (at < here * WIDE)
    if int(around.sum()) < FEWEST_BINS or not mean > 0.0:
        return 1.0
    law, variance = log_law(np.log(at[around] / here), np.log(np.maximum(spectrum[around] / mean, 1e-300)))
    log, close = shrunk(law[0], variance), around & (np.abs(at - here) < BESIDE * here)
    if int(close.sum()) >= FEWEST_BINS:
        along = np.exp(log + law[1] * np.log(at[close] / here))
        ratio = float((spectrum[close] / along).mean()) / mean
        log += shrunk(math.log(max(ratio, 1e-300)), 1.0 / float(close.sum()))
    return math.exp(log)


# A least-squares estimate sum(w y) / sum(w^2) has the variance sum(w^2 s^2) / sum(w^2)^2 in white noise of variances
# s^2: that in noise of one variance times sum(w^2 s^2) / (sum w^2 mean s^2): H. White, Econometrica 48 (1980) 817.
# A phase has w = a sin phi, a logarithm of the amplitude a cos phi.
def unlike(left: Array, size: Array, phase: Array, sound: Array) -> float:
    """The noise's power where an oscillation is measured over its mean power, where that is clearly more; else 1.

    The largest of those of phase and amplitude in STRETCHES stretches of the record, each by the squares of what a
    model leaves and the weight of each sample in the estimate.

    >>> rng, t = np.random.default_rng(1), np.arange(2000.0)
    >>> noise, size, phase = rng.normal(size=2000), np.exp(-0.001 * t), 0.3 * t
    >>> round(unlike(noise, size, phase, np.ones(2000)), 2), unlike(size * noise, size, phase, np.ones(2000)) > 1.5
    (1.0, True)
    """
    square, found = left**2 / float(np.average(left**2, weights=sound) + 1e-300), 1.0
    for weight in ((size * np.sin(phase)) ** 2 * sound, (size * np.cos(phase)) ** 2 * sound):
        for some in np.array_split(np.arange(left.size), STRETCHES):
            w = weight[some] / max(float(weight[some].sum()), 1e-300)
            ratio, scatter = float(w @ square[some]), math.sqrt(2.0 * float(w @ w))
            found = max(found, ratio if ratio > 1.0 + CLEARLY * scatter else 1.0)
    return found


# an exponential ordinate has E log I = log P - gamma, gamma Euler's constant, and var log I = pi^2 / 6
def log_law(x: Array, log: Array) -> tuple[Array, float]:
    """Value at x = 0 and slope of a line through logarithms of ordinates, and the variance of that value."""
    columns = np.stack([np.ones_like(x), x], axis=1)
    inverse = np.linalg.pinv(columns.T @ columns)
    return inverse @ (columns.T @ (log + np.euler_gamma)), math.pi**2 / 6.0 * float(inverse[0, 0])


def shrunk(log: float, variance: float) -> float:
    """A logarithm drawn to 0 by what it is known to.

    >>> round(shrunk(1.0, 0.1), 12), shrunk(0.1, 0.1)
    (0.8, 0.0)
    """
    return log * max(0.0, 1.0 - SHRINK * variance / max(log**2, 1e-300))
