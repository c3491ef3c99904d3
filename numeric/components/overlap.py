"""Two modes nearer to each other than about their damping: their sum looks like one oscillation that changes.

    y = Re[Z_1 e^((g_1 + i w_1) t) + Z_2 e^((g_2 + i w_2) t)]

beats less than once before it is gone, so that no line is left of a smooth model of it.  Its two exponentials are
looked for by themselves: first those of a matrix pencil of the envelope (Y. Hua and T. K. Sarkar, IEEE Trans. Acoust.
Speech Signal Process. 38 (1990) 814), then by least squares of all of the samples.

One oscillation that is not linear is nearly such a sum, too: of one frequency and of growth rates g, 2 g, .. under
drag, g, 3 g, .. with a cubic spring.  So exponentials count as two modes only where their frequencies are further apart
than their growth rates.  One that dry friction brings to rest ends as two modes do that come out of step; that is held
against them, too:

    a = (A + c) e^(-g t) - c  until it is 0,        w = w_0 + b a^2 + d / a^2,

dry friction changing the frequency in its second order over a.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.linalg import hankel
from scipy.optimize import least_squares

from ridgeback.numeric.arrays import Array, ComplexArray
from ridgeback.numeric.components.bends import STRICTER
from ridgeback.numeric.components.candidates import scored
from ridgeback.numeric.components.given import Given
from ridgeback.numeric.components.tones import Tone, total
from ridgeback.numeric.harmonics.signal_model import SignalModels
from ridgeback.numeric.harmonics.spline_fit import Known, akaike, rounding
from ridgeback.numeric.harmonics.spline_model import SplineModel
from ridgeback.numeric.signal.samples import TWO_PI

POINTS, MANY, MOST = 160, 2000, 20_000
"""Of the envelope, of which the pencil is made; those that stand for more samples than the last number."""
STEPS = 40
"""Of the fit to the samples."""
ASIDE = 1.0
"""Times the difference of their growth rates, by which the frequencies of two modes differ at least."""
PLAIN = 2
"""Coefficients of the splines of a plain oscillation, which is no sum of two."""
AS_GOOD = 6.0
"""Of the criterion, by which one smooth oscillation that changes must be better than two modes to be it."""
CLEARLY = 30.0
"""The same, by which two modes must be better than one that friction brings to rest."""
RUBBING, SMALLEST = 7, 0.05
"""Parameters of an oscillation that friction slows down; and its amplitude, of the first, below which it has none."""
STEEPEST = 10.0
"""Logarithm of a loss in the length of the record."""
FAINT = 0.01
"""Of the amplitude of one mode, that the other has at least."""
TOLD = 1.0
"""Times the mean of their growth rates, by which the frequencies of two modes differ at least that can be modelled."""

Pair = tuple[Tone, Tone]
Found = tuple[Pair, tuple[Tone, ...]] | None
"""Two modes that explain samples as well as one smooth oscillation, and the other tones; None where none do."""


def overlapping(given: Given, models: SignalModels, tones: tuple[Tone, ...]) -> Found:
    """Two modes that explain samples as well as one smooth oscillation, and the other tones; None where none do.

    That of more energy comes first.

    A tone that was found near the oscillation may be a part of what is the other mode's.
    """
    least = least_of(models)
    if least.basis.count <= PLAIN:
        return None
    known = replace(given.known, band=models.best.band)
    goal, found = scored(given.x, least, tones, known) + AS_GOOD, None
    harmonics = least.samples(keep=lambda h: h != 1)
    nearest = min(tones, key=lambda tone: abs(tone.omega - least.mean_omega), default=None)
    for others in dict.fromkeys((tones, tuple(tone for tone in tones if tone is not nearest))):
        x = given.x - total(others, given.time) - harmonics
        pair = two_modes(x, given.rate, least.mean_omega, given.known.sound_of(x.size))
        if pair is None or not apart(pair):
            continue
        score = score_of(x - total(pair, given.time), least, known, sum(t.parameters for t in (*pair, *others)))
        if score >= goal:
            continue
        rubbed = rubbing(x, least, given.known.sound_of(x.size))
        rest = score_of(x - rubbed, least, known, RUBBING + sum(t.parameters for t in others))
        if score < rest - CLEARLY:
            goal, found = score, (pair, others)
    return found and (by_energy(found[0]), found[1])


def least_of(models: SignalModels) -> SplineModel:
    """The model of the least criterion, as strict as that of tones."""
    return min(models.others, key=lambda model: model.criterion + STRICTER * (model.parameters - model.basis.count))


def by_energy(pair: Pair) -> Pair:
    """Two modes, that of more energy |Z|^2 / (4 |g|) first."""
    one, other = pair
    return pair if one.amplitude**2 * abs(other.growth) >= other.amplitude**2 * abs(one.growth) else (other, one)


def score_of(left: Array, least: SplineModel, known: Known, parameters: int) -> float:
    """The criterion of what is left, as ``candidates.scored`` is that of an oscillation with the same harmonics."""
    count = least.parameters - 3 * least.basis.count + parameters
    off, floor = left * known.sound_of(left.size), rounding(least.size)
    score = akaike(off, known.band or least.band, count=least.count, parameters=count, floor=floor)
    return float(score + STRICTER * count)


def rubbing(x: Array, least: SplineModel, sound: Array) -> Array:
    """The samples of one oscillation that dry and viscous friction slow down, as near to given ones as it comes."""
    time, largest, few = least.time / float(least.time[-1]), float(least.size[0]), slice(None, None, 1 + x.size // MOST)
    heard = sound[few]

    def size(loss: Array, at: Array) -> Array:
        viscous, dry = np.exp(np.minimum(loss, STEEPEST))
        return np.asarray(np.maximum((1.0 + dry) * np.exp(-viscous * at) - dry, 0.0), dtype=np.float64)

    def samples(values: Array, at: Array) -> Array:
        a = values[0] * size(values[1:3], at)
        bent = values[5] * a**2 + values[6] * (SMALLEST / np.maximum(a, SMALLEST)) ** 2
        turned = np.cumsum(bent) * at[1]
        return np.asarray(largest * a * np.cos(values[3] + values[4] * at + turned), dtype=np.float64)

    def swing(values: Array) -> Array:
        return np.asarray((values[0] * size(values[1:], time[few]) - least.size[few] / largest) * heard, dtype=float)

    def left(values: Array) -> Array:
        return np.asarray((samples(values, time[few]) - x[few]) * heard, dtype=np.float64)

    start = least_squares(swing, (1.0, 0.0, 0.0), max_nfev=STEPS).x
    line = np.polynomial.polynomial.polyfit(time[few], least.phase[few], 1, w=(least.size * sound)[few])
    return samples(least_squares(left, (*start, *line, 0.0, 0.0), max_nfev=STEPS).x, time)


def told(pair: Pair) -> bool:
    """Whether two modes are so far apart, for their damping, that each can be modelled beside the other.

    >>> told((Tone(9.0, -0.2, 1j), Tone(9.5, -0.3, 1j))), told((Tone(9.0, -0.2, 1j), Tone(9.1, -0.2, 1j)))
    (True, False)
    """
    one, other = pair
    return 2.0 * abs(one.omega - other.omega) > TOLD * abs(one.growth + other.growth)


def is_modelled(pair: Pair, tones: tuple[Tone, ...]) -> bool:
    """Whether one of two modes that can be told apart is among the tones beside the oscillation, which is the other."""
    near = 0.5 * abs(pair[0].omega - pair[1].omega)
    return told(pair) and any(abs(tone.omega - mode.omega) < near for tone in tones for mode in pair)


def overlap_doubt(pair: Pair, tones: tuple[Tone, ...]) -> str:
    """Why nothing is claimed of two modes that are not told apart; empty where they are, as tones beside one.

    >>> overlap_doubt((Tone(9.0, -0.2, 1j), Tone(9.1, -0.2, 1j)), ())[:42]
    'two modes overlap within their damping, ne'
    """
    if is_modelled(pair, tones):
        return ""
    low, high = sorted(tone.omega / TWO_PI for tone in pair)
    return (
        f"two modes overlap within their damping, near {low:.5g} and {high:.5g} cycles per unit, and explain the "
        "samples as well as one oscillation that changes; what is one's and what the other's cannot be "
        "told: excite or sense one of them alone"
    )


def two_modes(x: Array, rate: float, omega: float, sound: Array) -> Pair | None:
    """The two exponentials near a frequency that fit samples best; None where none fit.

    >>> t = np.arange(600) / 20.0
    >>> x = np.exp(-0.2 * t) * np.cos(9.0 * t) + 0.5 * np.exp(-0.15 * t) * np.cos(9.2 * t + 1.0)
    >>> [(round(tone.omega, 6), round(tone.growth, 6)) for tone in two_modes(x, 20.0, 9.1, np.ones(600))]
    [(9.0, -0.2), (9.2, -0.15)]
    """
    time = np.arange(x.size) / rate
    if x.size > MOST:
        return of_many(x, rate, omega, sound)
    start = begun(x, time, pencil(*envelope(x, rate, omega)) + 1j * omega, sound)
    unit = np.tile([1.0, 1.0, 1.0 / time[-1], 1.0 / time[-1]], 2)

    def left(values: Array) -> Array:
        return np.asarray((total(as_pair(values * unit), time) - x) * sound, dtype=np.float64)

    def slopes(values: Array) -> Array:
        columns = np.concatenate([tone.tangent(time) for tone in as_pair(values * unit)], axis=1)
        return np.asarray(columns * sound[:, None] * unit, dtype=np.float64)

    with np.errstate(over="ignore", invalid="ignore"):
        try:
            found = as_pair(least_squares(left, start / unit, slopes, method="lm", max_nfev=STEPS).x * unit)
        except ValueError:  # where an exponent leaves the range of numbers
            return None
    return found if all(tone.growth < 0.0 < tone.omega for tone in found) else None


def of_many(x: Array, rate: float, omega: float, sound: Array) -> Pair | None:
    """The same of many samples: exponents by their envelope, on a carrier of four points a cycle; sizes by them all."""
    step, values = envelope(x, rate, omega, points=MANY)
    carrier = 0.5 * np.pi / step
    slow = (values * np.exp(1j * carrier * step * np.arange(values.size))).real
    pair = two_modes(slow, 1.0 / step, carrier, np.ones(values.size))
    if pair is None:
        return None
    exponents = np.array([complex(tone.growth, tone.omega - carrier + omega) for tone in pair])
    return as_pair(begun(x, np.arange(x.size) / rate, exponents, sound))


def begun(x: Array, time: Array, exponents: ComplexArray, sound: Array) -> Array:
    """The parameters of two modes of these exponents that fit samples best: Re Z, Im Z, w and g of each."""
    rates = np.minimum(exponents.real, 0.0) + 1j * exponents.imag
    wave = np.exp(np.outer(time, rates))
    linear = np.concatenate([wave.real, -wave.imag], axis=1) * sound[:, None]
    sizes = np.linalg.lstsq(linear, x * sound, rcond=None)[0]
    return np.stack([sizes[:2], sizes[2:], rates.imag, rates.real], axis=1).ravel()


def as_pair(values: Array) -> Pair:
    """Two modes of eight parameters; each has a growth rate."""
    one, other = (Tone(w, g or -1e-300, complex(re, im)) for re, im, w, g in values.reshape(2, 4).tolist())
    return (one, other)


def envelope(x: Array, rate: float, omega: float, *, points: int = POINTS) -> tuple[float, ComplexArray]:
    """The complex amplitude about a frequency, in means over a cycle and more, and the time from one to the next."""
    turned = 2.0 * x * np.exp(-1j * omega * np.arange(x.size) / rate)
    length = max(round(TWO_PI * rate / omega), x.size // points)
    count = x.size // length
    weights = np.sin(np.pi * (np.arange(length) + 0.5) / length) ** 2  # of Hann: what turns the other way leaks less
    means = turned[: count * length].reshape(count, length) @ (weights / weights.sum())
    return length / rate, np.asarray(means, dtype=np.complex128)


def pencil(step: float, values: ComplexArray) -> ComplexArray:
    """The exponents of the two exponentials nearest to values at equal steps.

    >>> t = 0.5 * np.arange(40)
    >>> found = pencil(0.5, np.exp((-0.1 + 0.2j) * t) + np.exp((-0.3 + 0.1j) * t))
    >>> np.sort_complex(found).round(6).tolist()
    [(-0.3+0.1j), (-0.1+0.2j)]
    """
    half = values.size // 2
    vectors = np.linalg.svd(hankel(values[: values.size - half], values[values.size - half - 1 :]))[0][:, :2]
    turns = np.linalg.eigvals(np.linalg.pinv(vectors[:-1]) @ vectors[1:])
    return np.asarray(np.log(turns) / step, dtype=np.complex128)


def apart(pair: Pair) -> bool:
    """Whether two exponentials are two modes, and not one that changes as it decays.

    >>> apart((Tone(9.0, -0.2, 1j), Tone(9.3, -0.3, 1j))), apart((Tone(9.0, -0.2, 1j), Tone(9.1, -0.6, 1j)))
    (True, False)
    """
    one, other = pair
    if min(one.amplitude, other.amplitude) < FAINT * max(one.amplitude, other.amplitude):
        return False
    return abs(one.omega - other.omega) > ASIDE * abs(one.growth - other.growth)
