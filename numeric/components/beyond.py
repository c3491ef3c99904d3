"""What lies beyond a search band and would disturb what is in it: tones that are fitted together and taken off.

Lines of the spectrum are taken from the highest down, each as a tone, and all of them are fitted again in turns (RELAX:
J. Li and P. Stoica, IEEE Trans. Signal Process. 44 (1996) 281); those in the band stand in for the oscillation there
and stay in the samples.  A filter would ring at the ends of the record; a model does not.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np
from scipy import fft

from ridgeback.common.quantities import angular
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.components.bends import with_bends
from ridgeback.numeric.components.tones import Tone, each_refitted, fitted_tone, refitted, total
from ridgeback.numeric.harmonics.spline_fit import rounding
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.signal.search_band import tapers

MOST = 8
"""Tones that are fitted, those in the band included."""
ROUNDS = 4
"""In which all of them are fitted again after each new one."""
TAKEN_OFF = 0.5
"""Of the height of a line, that a tone which is to be it may leave."""
DISTURBING, UNDERSTOOD = 0.2, 0.1
"""Of the height of the highest line in the band: what counts beyond, and what tones leave of a band that they explain;
as long as they do not, what is weaker beyond may be the foot of what is in it."""
HARMONIC = 0.1
"""Distance from a multiple of the oscillation, in its frequency, within which a weaker line is its harmonic."""
LOWEST_CYCLES = 3.0
"""What turns less often in a record is drift."""


@dataclass(frozen=True)
class Line:
    """A line of a spectrum: its frequency, rad per time unit, and its height, the amplitude of a steady tone."""

    omega: float
    height: float


def tones_beyond(x: Array, rate: float, band: tuple[float, float], sound: Mask | None = None) -> tuple[Tone, ...]:
    """Tones beyond a band that are stronger than what is in it, or nearly so.

    Parameters
    ----------
    x : array of float, shape (N,)
        Samples without their mean.
    rate : float
        Samples per time unit.
    band : (float, float)
        Rad per time unit.
    sound : array of bool, shape (N,), optional
        The samples that count.

    Returns
    -------
    tuple of Tone
        In the order in which they were found; empty where the highest line is in the band and stands alone.

    Examples
    --------
    >>> t = np.arange(2000) / 500.0
    >>> noise = 0.01 * np.random.default_rng(1).normal(size=2000)
    >>> x = 0.2 * np.exp(-1.9 * t) * np.cos(230.0 * t) + np.cos(314.0 * t) + noise
    >>> [(round(tone.omega, 1), tone.growth) for tone in tones_beyond(x, 500.0, (200.0, 260.0))]
    [(314.0, 0.0)]
    """
    time, counted = np.arange(x.size) / rate, np.ones(x.size) if sound is None else sound.astype(float)
    found, left = tuple[Tone, ...](), x
    alone = there = Spectrum.of(x, rate)
    while len(found) < MOST:
        line = next_line(alone, there, band, more=bool(found))
        if line is None:
            break
        new = fitted_tone(left, time, line.omega, counted)
        more, left = one_more(left - new.samples(time), time, rate, (*found, new), counted)
        there, near = Spectrum.of(left, rate), 0.5 * TWO_PI * rate / x.size
        after = there.highest((line.omega - near, line.omega + near))
        if after is not None and after.height > TAKEN_OFF * line.height:
            break
        found = more
        alone = Spectrum.of(x - total(out_of(found, band), time), rate)
    return out_of(found, band)


def out_of(tones: tuple[Tone, ...], band: tuple[float, float]) -> tuple[Tone, ...]:
    """The tones that are not in a band."""
    return tuple(tone for tone in tones if not is_in(tone.omega, band))


def next_line(alone: Spectrum, left: Spectrum, band: tuple[float, float], *, more: bool) -> Line | None:
    """The next line to take: the highest beyond the band that disturbs, or one that stands in for what is in it.

    Parameters
    ----------
    alone : Spectrum
        Of samples without the tones beyond the band that were found.
    left : Spectrum
        Of what all the tones leave.
    band : (float, float)
        Rad per time unit.
    more : bool
        Whether any were found.
    """
    inside, rest, outside = alone.highest(band), left.highest(band), left.highest(band, beyond=True)
    if outside is None or inside is None or rest is None:
        return outside
    if outside.height > inside.height:
        return outside
    disturbs = outside.height > DISTURBING * inside.height and not is_multiple(outside.omega, inside.omega)
    if rest.height > UNDERSTOOD * inside.height and (disturbs or more):
        return rest
    return outside if disturbs else None


def one_more(
    left: Array, time: Array, rate: float, tones: tuple[Tone, ...], sound: Array
) -> tuple[tuple[Tone, ...], Array]:
    """Tones that leave ``left``, each fitted to what the others leave, in turns; with bends where they gain.

    And what they leave then.
    """
    floor = rounding(np.abs(left + total(tones, time)))

    def bent(rest: Array, tone: Tone) -> Tone:
        return with_bends(rest, rate, refitted(rest, tone, time=time, sound=sound), sound, floor=floor)

    plainly = partial(refitted, time=time, sound=sound)
    for done in range(ROUNDS):
        tones, left = each_refitted(left, time, tones, bent if done in (0, ROUNDS - 1) else plainly)
    return tones, left


@dataclass(frozen=True)
class Spectrum:
    """The larger of the Hann spectrum and that of either half of a Hann window, at frequencies in rad per time unit."""

    omega: Array
    heights: Array
    lowest: float
    """Below which what turns is drift: LOWEST_CYCLES a record."""

    @classmethod
    def of(cls, x: Array, rate: float) -> Spectrum:
        """The spectrum of samples."""
        heights = np.max([np.abs(fft.rfft(x * w, 2 * x.size)) * 2.0 / float(w.sum()) for w in tapers(x.size)], axis=0)
        return cls(TWO_PI * rate * fft.rfftfreq(2 * x.size), heights, TWO_PI * rate * LOWEST_CYCLES / x.size)

    def highest(self, band: tuple[float, float], *, beyond: bool = False) -> Line | None:
        """The highest line in a band, or beyond it.

        >>> t = np.arange(1000) / 100.0
        >>> spectrum = Spectrum.of(0.3 * np.cos(20.0 * t) + np.cos(50.0 * t), 100.0)
        >>> line = spectrum.highest((40.0, 60.0), beyond=True)
        >>> round(line.omega, 1), round(line.height, 1)
        (20.1, 0.3)
        """
        inside = (self.omega >= band[0]) & (self.omega <= band[1])
        usable = (inside != beyond) & (self.omega > self.lowest)
        if not usable.any():
            return None
        at = int(np.where(usable, self.heights, 0.0).argmax())
        return Line(float(self.omega[at]), float(self.heights[at]))


def nothing_in(band: tuple[float, float], beyond: float) -> str:
    """Why nothing is given of a band beside which there is an oscillation, and what would work.

    >>> nothing_in((8.0, 12.0), 5.0)[:62]
    'the band 8 to 12 rad/s (1.273 to 1.91 Hz) holds no oscillation'
    """
    return (
        f"the band {angular(*band)} holds no oscillation that stands out beside one near "
        f"{angular(beyond)}; give a --band round that, or a narrower one further from it"
    )


def is_in(omega: float, band: tuple[float, float]) -> bool:
    """Whether a frequency lies in a band."""
    return band[0] <= omega <= band[1]


def is_multiple(omega: float, base: float) -> bool:
    """Whether a frequency lies at a multiple of a base, 2 or more times.

    >>> is_multiple(20.3, 10.0), is_multiple(15.0, 10.0), is_multiple(10.2, 10.0)
    (True, False, False)
    """
    h = round(omega / base)
    return h > 1 and abs(omega - h * base) < HARMONIC * base
