"""The best class over the samples themselves, and what its residual says: only noise, or that the class is not it.

A residual without a line is told from one with a line by Fisher's test: of m ordinates I_j of the periodogram of white
noise, the largest one's share g = max I / sum I exceeds x with a probability of at most m (1 - x)^(m - 1) (R. A.
Fisher, Proc. R. Soc. A 125 (1929) 54).

A class with p parameters that leaves the sum of squares S of n samples is held against a model with P > p without any
oscillator in mind, which leaves R: where the class is right, n ln(S / R) is chi-square distributed with P - p degrees
of freedom (S. S. Wilks, Ann. Math. Stat. 9 (1938) 60), times the colour of the noise, its power near the oscillation
over its mean power.  Without such a model the ordinates of its periodogram near the oscillation are held against the
others: their means are as F of twice their numbers.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum

import numpy as np
from scipy.special import chdtrc, fdtrc

from ridgeback.common.numbers import number
from ridgeback.common.show.brief import Brief
from ridgeback.numeric.arrays import Array, freeze
from ridgeback.numeric.harmonics.spline_model import SplineModel
from ridgeback.numeric.signal.averaged_spectrum import averaged_spectrum

RARE = 0.01
"""Probability of so high a line in white noise below which it is called one."""
SEGMENTS = 4
"""Segments of the record, half overlapping with each other, over which a spectrum is averaged, about."""
TOP = 8.5
"""Highest multiple of the fundamental that a spectrum shows."""
OUT = 1e-4
"""Chance of so much more than noise below which a class is out, and nothing of its parameters is claimed."""
NEVER = 1e-12
"""Chance below which it is not told."""
AROUND = 0.2
"""Distance from the frequencies of the motion, in the fundamental, within which ordinates are near it."""
FEWEST = 8
"""Ordinates, near and far, that can be held against each other."""
NEAR = 0.1
"""Distance from a whole multiple of the fundamental, in fundamentals, within which a line is called by it."""


class Against(Enum):
    """What the residual of a class is held against."""

    MODEL = "model"
    """A model of the samples without any oscillator in mind."""
    ELSEWHERE = "elsewhere"
    """What the class itself leaves away from the oscillation."""
    NOTHING = "nothing"


@dataclass(frozen=True)
class Misfit:
    """How much more a class leaves than noise."""

    ratio: float = math.nan
    """Root mean square left over that of the noise."""
    chance: float = math.nan
    """How often noise alone would leave so much, or more; NaN where nothing tells."""
    against: Against = Against.NOTHING

    @property
    def known(self) -> bool:
        """Whether anything tells."""
        return not math.isnan(self.chance)

    @property
    def out(self) -> bool:
        """Whether the class is out."""
        return self.chance < OUT

    @property
    def better(self) -> bool:
        """Whether the class leaves less than what it is held against, which then tells nothing."""
        return self.chance > 1.0 - OUT

    @property
    def agrees(self) -> bool:
        """Whether something tells that it leaves noise alone."""
        return self.chance >= OUT

    def sentence(self) -> str:
        """The judgement in words, without a full stop."""
        chance = f"would once in {number(1.0 / self.chance, 1)} records" if self.chance > NEVER else "never does"
        beside = self.against is Against.ELSEWHERE
        where = " near the oscillation" if beside else ""
        what = "it leaves away from the oscillation" if beside else "a model without any oscillator in mind leaves"
        return f"leaves{where} {self.ratio:.3g} times the noise that {what}, as noise alone {chance}"


UNKNOWN = Misfit()


def over_model(residual: Array, free: Array, parameters: int, model: SplineModel, floor: float = 0.0) -> Misfit:
    """Hold what a class leaves against what a model of the same samples without any oscillator in mind does.

    Both are held from below the oscillation on: slow drift beside it is no misfit of a class.

    Parameters
    ----------
    residual, free
        Samples less the class and less the model, 0 where they do not count, shape (N,).
    parameters
        How many of the class were fitted.
    model
        That model.
    floor
        Root mean square below which nothing is told.
    """
    first, last = max(round(model.band[0] / (2 * np.pi) * residual.size), 1), residual.size // 2
    (left, best), share = (in_band(x, first, last) for x in (residual, free)), model.count / residual.size
    n = 2.0 * (last - first) * share
    least = floor**2 * n / share
    more = model.parameters - model.basis.count
    if n <= more or not max(best, least) > 0.0:
        return UNKNOWN
    left, best = max(left, least), max(best, least)
    close = model.colour * float(np.mean(free**2)) * n / share / best
    beyond = n * math.log(left / best) / max(close, 1.0)
    chance = float(chdtrc(max(more - parameters + 1, 1), max(beyond, 0.0)))
    return Misfit(math.sqrt(left / best * (1.0 - more / n)), chance, Against.MODEL)


def in_band(x: Array, first: int, last: int) -> float:
    """The sum of squares in ordinates ``first`` to ``last`` of the spectrum."""
    return float((2.0 * np.abs(np.fft.rfft(x))[first:last] ** 2).sum()) / x.size


def over_elsewhere(
    residual: Array,
    parameters: int,
    rate: float,
    band: tuple[float, float],
    colour: float = 1.0,
    floor: float = 0.0,
) -> Misfit:
    """Hold what a class leaves near the oscillation, the ``band`` in rad per time unit, against what it does elsewhere.

    ``colour`` is the noise's power there over its mean power, as far as it is known; ``floor`` the root mean square
    below which nothing is told.

    >>> t, noise = np.arange(640) / 32.0, 0.01 * np.random.default_rng(1).normal(size=640)
    >>> [over_elsewhere(x, 5, 32.0, (6.0, 6.5)).out for x in (noise, noise + 0.01 * np.cos(6.2 * t))]
    [False, True]
    """
    power = np.abs(np.fft.rfft(residual - residual.mean()))[1:-1] ** 2
    omega = 2 * np.pi * rate / residual.size * np.arange(1, power.size + 1)
    middle = 0.5 * (band[0] + band[1])
    near = (omega > band[0] - AROUND * middle) & (omega < band[1] + AROUND * middle)
    freedom = 2 * int(near.sum()) - parameters
    far = 2 * int((~near).sum())
    least = 0.5 * residual.size * floor**2
    if freedom < FEWEST or far < FEWEST or not power[~near].sum() + least > 0.0:
        return UNKNOWN
    here, beyond = float(power[near].sum()) / freedom, float(power[~near].sum()) / far
    ratio = max(here, least) / max(beyond, least) / max(colour, 1.0)
    return Misfit(math.sqrt(ratio), float(fdtrc(freedom, far, ratio)), Against.ELSEWHERE)


@dataclass(frozen=True, repr=False)
class SampleFit(Brief):
    """Samples, the model of the best class, and levels of their spectra; arrays of shape (N,) over ``time``."""

    time: Array
    samples: Array
    model: Array
    omega: Array
    """Angular frequencies of the spectra, shape (M,), rad per time unit."""
    samples_level: Array
    """dB of the highest level of the samples' spectrum, shape (M,)."""
    residual_level: Array
    """The same of samples less model, against the same level."""
    fundamental: float
    """The typical omega0, rad per time unit."""
    line: float | None
    """Where the residual has a line that white noise would not show, rad per time unit; None without one."""
    share: float
    """Of the residual's power, that of its highest ordinate."""

    def __post_init__(self) -> None:
        freeze(self)

    @property
    def multiple(self) -> int | None:
        """The multiple of the fundamental that the line is near, 0 for a drift; None elsewhere."""
        if self.line is None:
            return None
        ratio = self.line / self.fundamental
        return round(ratio) if abs(ratio - round(ratio)) < NEAR else None


def sample_fit(time: Array, samples: Array, model: Array, rate: float, fundamental: float) -> SampleFit:
    """Put a fitted model beside its samples.

    Parameters
    ----------
    time, samples, model
        Shape (N,).
    rate
        Samples per time unit.
    fundamental
        A typical frequency of the motion, rad per time unit.

    Examples
    --------
    >>> t = np.arange(640) / 32.0
    >>> noise = 0.01 * np.random.default_rng(1).normal(size=640)
    >>> x = np.cos(6.0 * t)
    >>> sample_fit(t, x + noise, x, 32.0, 6.0).line is None
    True
    >>> sample_fit(t, x + noise + 0.01 * np.cos(12.0 * t), x, 32.0, 6.0).multiple
    2
    """
    residual = samples - model
    omega, of_samples = spectrum(samples, rate)
    _, of_residual = spectrum(residual, rate)
    kept = omega <= TOP * fundamental
    top = max(float(of_samples.max()), np.finfo(float).tiny)
    line, share = strongest_line(residual, rate)
    return SampleFit(
        time,
        samples,
        model,
        omega[kept],
        level(of_samples[kept], top),
        level(of_residual[kept], top),
        fundamental,
        line,
        share,
    )


def spectrum(x: Array, rate: float) -> tuple[Array, Array]:
    """Welch's spectrum under a Hann window, and its angular frequencies."""
    length = max(16, 2 * x.size // (SEGMENTS + 1))
    frequency, power = averaged_spectrum(x, rate, min(length, x.size))
    return 2 * np.pi * frequency, power


def level(power: Array, top: float) -> Array:
    """Decibels of ``top``."""
    return np.asarray(10 * np.log10(np.maximum(power, np.finfo(float).tiny) / top))


def strongest_line(residual: Array, rate: float) -> tuple[float | None, float]:
    """The angular frequency of the highest ordinate where it is no accident of white noise, and its share."""
    power = np.abs(np.fft.rfft(residual - residual.mean()))[1:-1] ** 2
    total = float(power.sum())
    if power.size < 2 or not total > 0:
        return None, 0.0
    at = int(np.argmax(power))
    share = float(power[at] / total)
    chance = power.size * (1.0 - share) ** (power.size - 1)
    return (2 * np.pi * rate * (at + 1) / residual.size if chance < RARE else None), share
