"""Lines near the multiples of an oscillation that are not its harmonics: other modes, whose phase slips from its own.

    y = Re[Z e^((g + i d) t + i h phi(t))],

is a line near h times the oscillation of phase phi.  A harmonic turns h times as often as the oscillation does,
whatever its frequency: d = 0.  A mode at a ratio near h, such as 1.99 or the partials of a stiff string, slips.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from scipy import fft

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, ComplexArray
from ridgeback.numeric.components.given import Given
from ridgeback.numeric.components.tones import (
    SETTLED,
    Tone,
    each_refitted,
    fitted_tone,
    least_squares,
    refitted,
    total,
)
from ridgeback.numeric.harmonics.signal_model import shown_multiples
from ridgeback.numeric.harmonics.spline_model import SplineModel
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.signal.search_band import tapers

REACH = 0.3
"""Distance from a multiple, in the oscillation's frequency, within which a line is looked for."""
SLIP, SURE = 0.5, 5.0
"""Radians by which a phase must slip while there is something of the line, and times its deviation that d must be."""
FAINT, MUCH = 0.01, 0.05
"""Of the oscillation's amplitude, that another mode must have; of its power, by which it must explain more of the
samples than a harmonic that keeps its phase does, though its own frequency be the same on the mean."""
ITERATIONS, ROUNDS = 12, 3
"""Steps of a fit of one line, and rounds in which lines are fitted one beside the other."""
SHALLOWEST, FALLS = 2.0, 2.0
"""Growth rates that a fit begins from: the first times the length of the record, one over the one before."""


@dataclass(frozen=True)
class Riding:
    """A line on a multiple: d and g (per time unit), Z, and the deviation of d."""

    slope: float
    growth: float
    size: complex
    deviation: float = math.inf

    def wave(self, time: Array, turn: ComplexArray) -> ComplexArray:
        """What multiplies Z."""
        return np.asarray(np.exp((self.growth + 1j * self.slope) * time) * turn, dtype=np.complex128)

    def slips(self, time: Array) -> bool:
        """Whether it is no harmonic."""
        weight = np.exp(2.0 * self.growth * (time - time[0]))
        middle = float(np.average(time, weights=weight))
        length = math.sqrt(12.0 * float(np.average((time - middle) ** 2, weights=weight)))
        return abs(self.slope) > SURE * self.deviation and abs(self.slope) * length > SLIP


def riding(left: Array, time: Array, turn: ComplexArray, reach: float, sound: Array) -> Riding:
    """The strongest line within ``reach`` of a multiple, whose turning factor is ``turn``, by least squares.

    >>> t = np.arange(1500) / 250.0
    >>> x = 0.3 * np.exp(-t) * np.cos(128.0 * t + 1.0)
    >>> line = riding(x, t, np.exp(126j * t), 20.0, np.ones(1500))
    >>> round(line.slope, 6), round(line.growth, 6), round(abs(line.size), 6)
    (2.0, -1.0, 0.3)
    """
    heard, span = left * sound, float(time[-1])
    line = begin(heard, time, turn, reach)
    for _ in range(ITERATIONS):
        wave = line.wave(time, turn) * sound
        size = complex(*least_squares(np.stack([wave.real, -wave.imag]), heard)[0].tolist())
        whole = size * wave
        later, off = whole * time, heard - whole.real
        step, variance = least_squares(np.stack([wave.real, -wave.imag, -later.imag, later.real]), off)
        most = max(0.5 / span, 0.3 * abs(line.growth))
        slope, growth = (float(np.clip(one, -most, most)) for one in step[2:])
        line = Riding(
            float(np.clip(line.slope + slope, -reach, reach)),
            float(np.clip(line.growth + growth, -reach, 2.0 / span)),
            size,
            math.sqrt(max(float(variance[2]), 0.0) * float(np.mean(off**2))),
        )
        if float(np.abs(step[2:]).max()) * span < SETTLED:
            break
    return line


def begin(left: Array, time: Array, turn: ComplexArray, reach: float) -> Riding:
    """Where a fit begins: at the highest line of any taper, with the growth rate that explains most."""
    turned, size = left * turn.conj(), 2 * time.size
    omega = TWO_PI * fft.fftfreq(size, float(time[1] - time[0]))
    heights = np.max([np.abs(fft.fft(turned * w, size)) / float(w.sum()) for w in tapers(time.size)], axis=0)
    at = float(omega[np.where(np.abs(omega) < reach, heights, 0.0).argmax()])
    growths, fall = [0.0], SHALLOWEST / float(time[-1])
    while fall < reach:
        growths.append(-fall)
        fall *= FALLS

    def explained(one: Riding) -> float:
        wave = one.wave(time, turn)
        return float(abs(np.vdot(wave, left)) ** 2 / np.sum(np.abs(wave) ** 2))

    return max((Riding(at, growth, 0j) for growth in growths), key=explained)


def slipping(left: Array, model: SplineModel, multiples: tuple[int, ...], sound: Array) -> dict[int, Tone]:
    """Tones for the multiples of an oscillation that are none of its harmonics, the strongest taken first.

    ``left`` is what a model of the oscillation without harmonics leaves of the samples.
    """
    time, omega = model.time, model.mean_omega
    turns = {h: np.exp(1j * h * model.phase) for h in multiples}
    lines = {h: riding(left, time, turns[h], REACH * omega, sound) for h in multiples}
    found, order = dict[int, Tone](), sorted(multiples, key=lambda h: -abs(lines[h].size))
    for h in order:
        line = lines[h] if h == order[0] else riding(left, time, turns[h], REACH * omega, sound)
        harmonic = (line.size * line.wave(time, turns[h])).real
        tone = fitted_tone(left, time, h * omega + line.slope, sound)
        mode = tone.samples(time)
        strong = tone.amplitude > FAINT * float(model.size.max())
        near = abs(tone.omega - h * omega) < REACH * omega
        if strong and near and (line.slips(time) or fits_better(left * sound, mode * sound, harmonic * sound)):
            found[h] = tone
        left = left - (mode if h in found else harmonic)
    return found


# Two models of as many parameters: n log of the ratio of what they leave is twice that of their likelihoods.
def fits_better(x: Array, one: Array, other: Array) -> bool:
    """Whether one model of samples leaves far less of them than another, in view of their noise and of what they say.

    >>> x, noise = np.cos(np.arange(200.0)), 0.1 * np.random.default_rng(1).normal(size=200)
    >>> fits_better(x + noise, x, 0.5 * x), fits_better(x + noise, x, 0.999 * x)
    (True, False)
    """
    left, rest = float(np.sum((x - one) ** 2)), float(np.sum((x - other) ** 2))
    sure = x.size * math.log(max(rest, 1e-300) / max(left, 1e-300)) > SURE**2
    return sure and rest - left > MUCH * float(np.sum(one**2))


def unlocked(given: Given) -> tuple[tuple[int, ...] | None, tuple[Tone, ...]]:
    """The harmonics that are locked to an oscillation, and tones for other modes near its multiples.

    Parameters
    ----------
    given : Given
        Samples of the oscillation; its ``multiples`` do not count.

    Returns
    -------
    multiples : tuple of int, or None
        None where all that the samples show are harmonics, or no model tells.
    tones : tuple of Tone
        The strongest first.

    Examples
    --------
    >>> t, noise = np.arange(1500) / 250.0, 0.01 * np.random.default_rng(1).normal(size=1500)
    >>> x = np.exp(-0.5 * t) * np.cos(63.0 * t + 0.2 * np.exp(-t)) + noise
    >>> mode, harmonic = np.exp(-t) * np.cos(128.0 * t), np.exp(-t) * np.cos(126.0 * t + 0.4 * np.exp(-t))
    >>> given = Given(x + 0.3 * mode, 250.0, np.full(1500, 63.0), 50, (), np.ones(1500, dtype=bool))
    >>> multiples, (tone,) = unlocked(given)
    >>> multiples, round(tone.omega), round(tone.growth)
    ((), 128, -1)
    >>> unlocked(replace(given, x=x + 0.1 * harmonic))
    (None, ())
    """
    try:
        multiples = shown_multiples(given.x, given.rate, given.guide, half=given.half)
        models = replace(given, multiples=()).models(given.x, given.known) if multiples else None
    except InputError:
        return None, ()
    if models is None:
        return None, ()
    return locked_and_others(given.x, models.best, multiples, given.known.sound_of(given.x.size))


def locked_and_others(
    x: Array, model: SplineModel, multiples: tuple[int, ...], sound: Array
) -> tuple[tuple[int, ...] | None, tuple[Tone, ...]]:
    """The same by a model of the oscillation, of which its harmonics do not count."""
    left = x - model.samples(keep=lambda h: h < 2)
    others = slipping(left, model, multiples, sound)
    if not others:
        return None, ()
    tones, time = tuple(others.values()), model.time
    left, refit = left - total(tones, time), partial(refitted, time=time, sound=sound)
    for _ in range(ROUNDS):
        tones, left = each_refitted(left, time, tones, refit)
    return tuple(h for h in multiples if h not in others), tones
