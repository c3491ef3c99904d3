"""Why models of one oscillation cannot be trusted, though they settled: what they leave of the samples says so."""

from __future__ import annotations

import math

import numpy as np
from scipy.fft import irfft, rfft, rfftfreq
from scipy.optimize import isotonic_regression
from scipy.special import chdtri

from ridgeback.common.errors import InputError
from ridgeback.common.quantities import angular
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.components.jumps import jump
from ridgeback.numeric.components.lines import LEAST, clearest_line
from ridgeback.numeric.components.wander import EXACT, wandering
from ridgeback.numeric.harmonics.local_fit import harmonic_fit
from ridgeback.numeric.harmonics.signal_model import SignalModels
from ridgeback.numeric.harmonics.spline_model import SplineModel
from ridgeback.numeric.harmonics.window_steps import Shape
from ridgeback.numeric.signal.samples import TWO_PI

FEWEST, THREE_SIGMA = 16, 3.0
"""Ordinates of a spectrum that tell a level of noise, and deviations by which two levels differ."""
STEADY = 0.05
"""Of the logarithm of an amplitude, that it may swing by in a model of many knots."""
OF_BEATS, CUBIC = 0.3, 3
"""Of the swing of the logarithm of an amplitude, that the phase turns by at least where it is that of beats; and the
degree in time of a phase that does not swing."""
ABOVE = 3.0
"""Times the noise, of the amplitudes whose swing is told."""
MANY, CLOSE = 8, 5.0
"""Intervals between knots and cycles in each, from which on models that gain by them may be following beats."""
NEAR = 1.45
"""Factor from the oscillation within which a line is in its band."""
WINDOW_CYCLES, FEWEST_WINDOWS, MOST_WINDOWS = 4.0, 5, 200
"""Of short stretches whose noise is held against that of the whole: their length, and how many of them."""
QUIET = 0.7
"""Share of those stretches, the less noisy ones, whose mean is what stretches by themselves leave."""
FINE = 3.0
"""Cycles between knots below which a model is at its finest, and what it leaves in one stretch no knots can follow."""
STRETCH_CYCLES, IN_IT, CHANCE = 3.0, (0.5, 1.5), 1e-4
"""Cycles of a stretch that is held against the others, the band in which it is, in the oscillation's frequency, and the
probability in white noise of one that leaves so much."""
ROUGH = 3.0
"""Times the noise of short stretches, that a model of the whole leaves which is not that of one smooth oscillation."""


def doubt(
    models: SignalModels, x: Array, left: Array, rate: float, guide: Array, sound: Mask, *, start: float = 0.0
) -> str:
    """Why models cannot be trusted that leave ``left`` of samples ``x``, tones in them; empty where they can.

    ``sound`` are the samples that count, ``start`` the time of the first one in the record.
    """
    return (
        jump(models, left, sound, start=start)
        or wandering(models, sound)
        or in_the_way(left, rate, models.best)
        or unfinished(models, left)
        or uneven(models.best, x, rate, guide)
        or somewhere(models.best, left, rate, sound, start=start)
    )


# In white noise the energy of a window of L samples in a band of width B, rad per sample, over the noise's variance is
# distributed as chi^2 with L B / pi degrees of freedom.
def somewhere(model: SplineModel, left: Array, rate: float, sound: Mask, *, start: float = 0.0) -> str:
    """Why a model on its finest knots cannot be trusted that leaves far more in one stretch than elsewhere: a jump.

    >>> from ridgeback.numeric.harmonics.signal_model import signal_models
    >>> t, noise = np.arange(480) / 16.0, 0.01 * np.random.default_rng(1).normal(size=480)
    >>> sound = np.ones(480, dtype=bool)
    >>> for second in (6.0, 6.3):
    ...     guide = np.where(t < 15.0, 6.0, second)
    ...     x = np.cos(6.0 * t + (guide - 6.0) * (t - 15.0)) + noise
    ...     best = signal_models(x, 16.0, guide, half=30, multiples=()).best
    ...     print(somewhere(best, x - best.samples(), 16.0, sound)[:29])
    <BLANKLINE>
    a model of the whole leaves 4
    """
    if model.cycles > FINE:
        return ""
    clear = model.size > LEAST * float(model.size.max())
    low, high = IN_IT[0] * float(model.omega[clear].min()), IN_IT[1] * float(model.omega[clear].max())
    width = min(high, math.pi * rate) - low
    length = round(STRETCH_CYCLES * TWO_PI * rate / model.mean_omega)
    power, there = (
        in_windows(band_passed(left * sound, low / rate, high / rate) ** 2, length),
        in_windows(sound.astype(float), length),
    )
    known = there > 0.5
    if known.sum() < FEWEST_WINDOWS:
        return ""
    power = np.where(known, power / np.maximum(there, 0.5), 0.0)
    usual, freedom, at = float(np.median(power[known])), length * width / rate / math.pi, int(power.argmax())
    rare = chdtri(freedom, CHANCE / power.size) / chdtri(freedom, 0.5)
    if power[at] <= max(rare * usual, (LEAST * float(model.size.max())) ** 2):
        return ""
    begin = start + float(model.time[at * (length // 2)])
    return (
        f"a model of the whole leaves {math.sqrt(power[at] / usual) if usual else math.inf:.2g} times as much from "
        f"t = {begin:.6g} to {begin + length / rate:.6g} as elsewhere, as it does where the motion "
        "jumps; give a --span in which it goes on smoothly"
    )


def band_passed(x: Array, low: float, high: float) -> Array:
    """The part of samples in a band, rad per sample."""
    spectrum, w = rfft(x), TWO_PI * rfftfreq(x.size)
    return np.asarray(irfft(np.where((w > low) & (w < high), spectrum, 0.0), x.size), dtype=np.float64)


def in_windows(values: Array, length: int) -> Array:
    """Means over windows of so many samples, half overlapping.

    >>> in_windows(np.arange(8.0), 4).tolist()
    [1.5, 3.5, 5.5]
    """
    total, half = np.concatenate([[0.0], np.cumsum(values, dtype=float)]), max(1, length // 2)
    first = np.arange(0, values.size - length + 1, half)
    return np.asarray((total[first + length] - total[first]) / length, dtype=np.float64)


def uneven(model: SplineModel, x: Array, rate: float, guide: Array) -> str:
    """Why a model cannot be trusted that leaves far more than short stretches by themselves do: a jump in its way.

    Tones beside the oscillation stay in ``x``: what was taken for them may be the jump.

    >>> from ridgeback.numeric.harmonics.signal_model import signal_models
    >>> t, noise = np.arange(480) / 16.0, 0.003 * np.random.default_rng(1).normal(size=480)
    >>> for second in (6.0, 8.0):
    ...     guide = np.where(t < 15.0, 6.0, second)
    ...     x = np.cos(guide * t) + noise
    ...     print(uneven(signal_models(x, 16.0, guide, half=30, multiples=()).best, x, 16.0, guide)[:39])
    <BLANKLINE>
    a model of the whole leaves 48 times as
    """
    if model.noise < LEAST * float(model.size.max()):
        return ""
    half = round(0.5 * WINDOW_CYCLES * TWO_PI * rate / float(np.median(model.omega)))
    centres = np.arange(half, x.size - half, max(half, x.size // MOST_WINDOWS))
    if centres.size < FEWEST_WINDOWS:
        return ""
    try:
        fit = harmonic_fit(x, rate, guide, half=half, shape=Shape(model.multiples), centres=centres)
    except InputError:
        return ""
    quiet = np.sort(fit.noise)[: math.ceil(QUIET * centres.size)]  # a jump is in a few of them, loud noise in many
    typical = float(np.sqrt(np.mean(quiet**2)))
    if model.noise <= ROUGH * typical:
        return ""
    ratio = f"{model.noise / typical:.2g}" if typical > 0.0 else "many"
    return (
        f"a model of the whole leaves {ratio} times as much as stretches of {WINDOW_CYCLES:g} cycles by themselves, as "
        "it does where the motion jumps; give a --span in which it goes on smoothly"
    )


def in_the_way(left: Array, rate: float, model: SplineModel) -> str:
    """Why a model cannot be trusted: a line in its band that is left; empty where there is none."""
    line = clearest_line(left, rate, LEAST * float(model.size.max()))
    low, high = float(model.omega.min()) / NEAR, float(model.omega.max()) * NEAR
    if line is None or not low < line < high:
        return ""
    return (
        f"another component near {angular(line)} shares the band, and no model of both fits; "
        "give a --band or a --span in which there is one oscillation"
    )


def unfinished(models: SignalModels, left: Array) -> str:
    """Why models cannot be trusted that go on gaining to fine knots; empty where they do not.

    Where what they leave in their band is as weak as beyond it, they have come to the noise, and the end is at hand;
    an amplitude that swings all the same is that of beats, unless the phase does not swing with it.
    """
    best = min(models.others, key=lambda model: model.criterion)
    exact = best.noise < EXACT * float(best.size.max())
    if exact or best.breaks.size - 1 < MANY or best.cycles > CLOSE:
        return ""
    swings = swing(models.best)
    if is_white(left, models.best.band) and (swings < STEADY or turns(models.best) < OF_BEATS * swings):
        return ""
    return (
        f"models of one oscillation go on gaining down to a knot every {best.cycles:.2g} cycles, as they do with "
        "several components or jumps; give a --band or a --span in which there is one oscillation"
    )


def swing(model: SplineModel) -> float:
    """How far the logarithm of a model's amplitude goes from a parabola in its phase, or from falling or rising, rms.

    The amplitude of a decay under drag is far from a parabola, and that of beats from both.  Falling or rising is asked
    of what stands ABOVE the noise.
    """
    log, turned = np.log(model.size), model.phase / float(model.phase[-1])
    bent = float(np.std(log - np.polyval(np.polyfit(turned, log, 2), turned)))
    there = log[model.size > ABOVE * model.noise]
    one_way = (float(np.std(there - isotonic_regression(there, increasing=up).x)) for up in (True, False))
    return min(bent, *one_way) if there.size else bent


# In beats, 1 + r e^(i d t) over one of the components, logarithm and phase are conjugate harmonics: as large, rms.
def turns(model: SplineModel) -> float:
    """How far a model's phase goes from a cubic in time, rms, in radians."""
    u = model.time / float(model.time[-1])
    return float(np.std(model.phase - np.polyval(np.polyfit(u, model.phase, CUBIC), u)))


# Means of n ordinates of the periodogram of white noise scatter by 1/sqrt(n) of their expectation.
def is_white(left: Array, band: tuple[float, float]) -> bool:
    """Whether the power per ordinate in a band, rad per sample, is not above that beyond it by THREE_SIGMA or more.

    >>> white, t = np.random.default_rng(1).normal(size=800), np.arange(800)
    >>> is_white(white, (0.1, 0.8)), is_white(white + np.cos(0.4 * t), (0.1, 0.8))
    (True, False)
    """
    power, w = np.abs(rfft(left)) ** 2, TWO_PI * rfftfreq(left.size)
    inside, beyond = power[(w > band[0]) & (w < band[1])], power[w > band[1]]
    if min(inside.size, beyond.size) < FEWEST:
        return False
    allowed = 1.0 + THREE_SIGMA * math.sqrt(1.0 / inside.size + 1.0 / beyond.size)
    return bool(inside.mean() < allowed * beyond.mean())
