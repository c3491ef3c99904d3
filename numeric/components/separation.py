"""One oscillation out of a record: what shares its band is modelled with it and taken off, or said to be in the way.

Models of one smooth oscillation are tried on more and more knots.  Where what such a model leaves shows a line, a tone
at that line is fitted together with it, in turns (backfitting: Breiman and Friedman, J. Am. Stat. Assoc. 80 (1985)
580), and kept where the criterion of both falls by GAIN below that of the best model of one: beats of two components
take many knots to follow, their two components few parameters.  Parameters count about as in the criterion of Schwarz
(Ann. Stat. 6 (1978) 461), which finds the true model where Akaike's finds the best predictor.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.components.bends import GAIN, STRICTER, with_bends
from ridgeback.numeric.components.doubts import doubt
from ridgeback.numeric.components.lines import LEAST, clearest_line, colour
from ridgeback.numeric.components.spikes import spikes
from ridgeback.numeric.components.tones import Tone, fitted_tone, total
from ridgeback.numeric.harmonics.signal_model import SignalModels, signal_models
from ridgeback.numeric.harmonics.spline_fit import Known, akaike, fit_on
from ridgeback.numeric.harmonics.spline_model import SplineModel
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.signal.search_band import strongest_frequency

MOST_TONES = 6
TURNS, RESTED = 30, 0.02
"""Of fitting in turns: most of them, and the fall of the criterion in one with which it ends."""
SAME = 0.1
"""Of the noise, by which tones may differ between two models."""
ROUNDS = 3
"""In which spikes are looked for."""
OF_A_HARMONIC, AT_A_MULTIPLE = 0.3, 0.1
"""Distance from a multiple of the oscillation, in its frequency, within which a line is taken for that harmonic's: left
by a model that holds it, and by one that was fitted without."""


@dataclass(frozen=True)
class Separated:
    """The samples of one oscillation, with models of it.

    ``x`` are the samples less the ``tones``, those that are no part of the motion (not ``sound``) replaced by the
    model; ``spikes`` says how many were outside the noise.  ``reason`` is why no model of it can be trusted, if so.
    """

    x: Array
    models: SignalModels
    sound: Mask
    tones: tuple[Tone, ...]
    spikes: int
    reason: str = ""


def separated(
    x: Array,
    rate: float,
    guide: Array,
    *,
    half: int,
    multiples: tuple[int, ...] | None,
    excluded: Mask | None = None,
    most: int = MOST_TONES,
    band: tuple[float, float] | None = None,
    beyond: tuple[Tone, ...] = (),
) -> Separated:
    """Model one oscillation and what is beside it.

    Parameters
    ----------
    x : array of float, shape (N,)
        Samples without their mean.
    rate : float
        Samples per time unit.
    guide : array of float, shape (N,)
        About the frequency of the oscillation, rad per time unit.
    half : int
        Half the window in which harmonics are chosen.
    multiples : tuple of int, optional
        The harmonics; by default those that the data show.
    excluded : array of bool, shape (N,), optional
        Samples that are known to be wrong, such as clipped ones.
    most : int
        Tones that are looked for at most.
    band : (float, float), optional
        Where the oscillation is, rad per time unit.
    beyond : tuple of Tone
        Tones in the samples that are known to be there, about; they do not count among ``most``.

    Raises
    ------
    InputError
        Where no model of the whole signal settles.

    Examples
    --------
    >>> t = np.arange(900) / 15.0
    >>> noise = 0.003 * np.random.default_rng(1).normal(size=900)
    >>> x = np.exp(-0.06 * t) * np.cos(12.6 * t) + 0.02 * np.cos(14.0 * t) + noise
    >>> found = separated(x, 15.0, np.full(900, 12.6), half=14, multiples=None)
    >>> [(round(tone.omega, 1), tone.growth) for tone in found.tones], round(found.models.best.noise, 3)
    ([(14.0, 0.0)], 0.003)
    """
    sound = np.ones(x.size, dtype=np.bool_) if excluded is None else ~excluded
    filled = x
    if not sound.all():
        apart = total(beyond, np.arange(x.size) / rate)
        bare = signal_models(x - apart, rate, guide, half=half, multiples=(), known=Known(sound.astype(float)))
        filled = np.where(sound, x, bare.best.samples() + apart)
    given = Given(filled, rate, guide, half, multiples, sound)
    most += len(beyond)
    models, tones = with_tones(given, beyond, most)
    count = 0
    for _ in range(ROUNDS):
        left, cycle = residual(given.x, models.best, tones), TWO_PI * rate / float(np.median(guide))
        off = spikes(left, cycle, float(models.best.size.max())) & given.sound
        if not off.any():
            break
        sound, count = given.sound & ~off, count + int(off.sum())
        filled = np.where(sound, x, models.best.samples() + total(tones, given.time))
        given = replace(given, x=filled, sound=sound)
        models, tones = with_tones(given, tones, most)
    left = residual(given.x, models.best, tones)
    omega = float(np.average(models.best.omega, weights=models.best.size**2))
    known = models.coloured(colour(left, rate, omega, models.best.basis.count))
    single = np.where(given.sound, given.x - total(tones, given.time), models.best.samples())
    reason = off_the_band(models.best, band) or doubt(known, given.x, left, rate, guide, given.sound)
    return Separated(single, known, given.sound, tones, count, reason)


@lru_cache(maxsize=2)
def separated_once(
    x: bytes,
    rate: float,
    guide: bytes,
    half: int,
    multiples: tuple[int, ...] | None,
    excluded: bytes | None,
    most: int,
    band: tuple[float, float] | None,
    beyond: tuple[Tone, ...],
) -> Separated:
    """``separated`` of arrays as their bytes, kept for the next method that asks for the same of the same samples."""
    return separated(
        np.frombuffer(x),
        rate,
        np.frombuffer(guide),
        half=half,
        multiples=multiples,
        excluded=None if excluded is None else np.frombuffer(excluded, dtype=np.bool_),
        most=most,
        band=band,
        beyond=beyond,
    )


def residual(x: Array, model: SplineModel, tones: tuple[Tone, ...]) -> Array:
    """What a model and tones leave of samples."""
    return x - model.samples() - total(tones, model.time)


@dataclass(frozen=True)
class Given:
    """Samples with what is known of them: ``separated`` says what each is; ``sound`` those that count."""

    x: Array
    rate: float
    guide: Array
    half: int
    multiples: tuple[int, ...] | None
    sound: Mask

    @property
    def time(self) -> Array:
        """From the first sample on."""
        return np.arange(self.x.size) / self.rate

    @property
    def known(self) -> Known:
        """In the words of the models."""
        return Known(None if self.sound.all() else self.sound.astype(float))

    def beside(self, tones: tuple[Tone, ...]) -> SignalModels:
        """Models of the oscillation beside tones, whose error is in theirs."""
        time, known = self.time, self.known
        if tones:
            known = replace(known, beside=np.concatenate([tone.tangent(time) for tone in tones], axis=1))
        left = self.x - total(tones, time)
        return signal_models(left, self.rate, self.guide, half=self.half, multiples=self.multiples, known=known)


def off_the_band(model: SplineModel, band: tuple[float, float] | None) -> str:
    """Why a model cannot be trusted that left the band it was to be in; empty where it did not, or there is none."""
    omega = float(np.average(model.omega, weights=model.size**2))
    if band is None or band[0] <= omega <= band[1]:
        return ""
    return (
        f"the band {band[0]:.4g} to {band[1]:.4g} rad per time unit holds no oscillation that stands out beside a "
        f"stronger one near {omega:.4g}; give another --band"
    )


def with_tones(given: Given, here: tuple[Tone, ...], most: int) -> tuple[SignalModels, tuple[Tone, ...]]:
    """Models of the oscillation, and the tones beside it: those that are here, and more as long as they gain."""
    models, here = settled(given, here) if here else (given.beside(here), here)
    while len(here) < most:
        found = one_more(given, models, here)
        if found is None:
            break
        try:
            models, here = settled(given, found)
        except InputError:
            break
    return models, here


def settled(given: Given, tones: tuple[Tone, ...]) -> tuple[SignalModels, tuple[Tone, ...]]:
    """Models beside tones, and the tones beside those models."""
    models = given.beside(tones)
    new = in_turns(given.x, models.best, tones, given.known)[1]
    bent = all_with_bends(given, models.best, new)
    if bent != new:
        models, tones = given.beside(bent), bent
        new = in_turns(given.x, models.best, bent, given.known)[1]
    moved = float(np.abs(total(new, given.time) - total(tones, given.time)).max())
    return (given.beside(new), new) if moved > SAME * models.best.noise else (models, tones)


def all_with_bends(given: Given, model: SplineModel, tones: tuple[Tone, ...]) -> tuple[Tone, ...]:
    """Tones with bends where these gain, each judged by what the model and the others leave."""
    sound, floor = given.known.sound_of(given.x.size), 1e-14 * float(model.size.max())

    def bent(i: int) -> Tone:
        left = residual(given.x, model, (*tones[:i], *tones[i + 1 :]))
        return with_bends(left, given.rate, tones[i], sound, floor=floor)

    return tuple(bent(i) for i in range(len(tones)))


def one_more(given: Given, models: SignalModels, tones: tuple[Tone, ...]) -> tuple[Tone, ...] | None:
    """The tones with one more beside the oscillation; None where none is worth its parameters."""
    x, rate, known = given.x, given.rate, replace(given.known, band=models.best.band)
    goal = min(model.criterion + STRICTER * (model.parameters - model.basis.count) for model in models.others) - GAIN
    tried: list[float] = []
    found: tuple[Tone, ...] | None = None
    simple = tuple(plain(x - total(tones, given.time), models.best, known))
    every = models.others if suspicious(x, rate, models, tones) else ()
    for model in (*simple, *every):
        line = clearest_line(residual(x, model, tones), rate, LEAST * float(model.size.max()))
        if line is None or any(abs(line - before) < TWO_PI * rate / x.size for before in tried):
            continue
        if is_harmonic(line, model, models.best.multiples):
            continue
        tried += [] if any(model is one for one in simple) else [line]
        score, more = together(x, model, tones, line, known, goal)
        small = any(tone.amplitude < LEAST * float(model.size.max()) for tone in more)
        if not small and score < goal:
            goal, found = score, more
    return found


def suspicious(x: Array, rate: float, models: SignalModels, tones: tuple[Tone, ...]) -> bool:
    """Whether the best model of one oscillation leaves a line, or needed all the knots that there are."""
    best = min(models.others, key=lambda model: model.criterion)
    line = clearest_line(residual(x, best, tones), rate, LEAST * float(best.size.max()))
    return line is not None or best is models.others[-1]


def plain(x: Array, like: SplineModel, known: Known) -> Iterator[SplineModel]:
    """A plain damped oscillation at the strongest line: where beats lead the other models away from it."""
    time, step = like.time, float(like.time[1] - like.time[0])
    low, high = like.band
    try:
        omega = strongest_frequency(x, 1.0 / step, band=(low / step, min(high, math.pi) / step))
    except InputError:
        return
    turned = x * np.exp(-1j * omega * time)
    begin = turned[: max(8, time.size // 4)].mean()
    phase, size = omega * time + float(np.angle(begin)), np.full(time.size, 2.0 * float(np.abs(begin)) + 1e-300)
    for multiples in dict.fromkeys((like.multiples, ())):  # what was taken for harmonics may be a mode that dies soon
        yield fit_on(x, time, phase, size, like.breaks[[0, -1]], multiples, 1, known)


def is_harmonic(line: float, model: SplineModel, multiples: tuple[int, ...]) -> bool:
    """Whether a line that a model leaves lies at one of the multiples of the oscillation."""
    base = float(np.average(model.omega, weights=model.size**2))
    near = OF_A_HARMONIC if model.multiples else AT_A_MULTIPLE
    return any(abs(line - h * base) < near * base for h in multiples)


def together(
    x: Array, model: SplineModel, tones: tuple[Tone, ...], line: float, known: Known, goal: float
) -> tuple[float, tuple[Tone, ...]]:
    """Akaike's criterion of a model and its tones with one more, fitted in turns, and the tones."""
    more = fitted_tone(residual(x, model, tones), model.time, line, known.sound_of(x.size))
    return in_turns(x, model, (*tones, more), known, goal=goal)


def in_turns(
    x: Array, model: SplineModel, found: tuple[Tone, ...], known: Known, *, goal: float = math.inf
) -> tuple[float, tuple[Tone, ...]]:
    """The criterion of a model and tones, each fitted to what the others leave until nothing moves, and the tones.

    Given up where the criterion falls too slowly to come to the ``goal`` in the turns that are left.
    """
    time, sound, score = model.time, known.sound_of(x.size), math.inf
    for turn in range(1, TURNS + 1):
        model = again(x - total(found, time), model, known)
        for i, tone in enumerate(found):
            others = (*found[:i], *found[i + 1 :])
            new = fitted_tone(residual(x, model, others), time, tone.omega, sound, tone)
            found = (*found[:i], new, *found[i + 1 :])
        parameters = model.parameters - model.basis.count + sum(tone.tangent(time).shape[1] for tone in found)
        off, floor = residual(x, model, found) * sound, 1e-14 * float(model.size.max())
        before, score = score, akaike(off, model.band, count=model.count, parameters=parameters, floor=floor)
        if before - score < RESTED or score + STRICTER * parameters - (before - score) * (TURNS - turn) > goal:
            break
    return score + STRICTER * parameters, found


def again(x: Array, model: SplineModel, known: Known) -> SplineModel:
    """The same model of other samples, from where it was."""
    return fit_on(x, model.time, model.phase, model.size, model.breaks, model.multiples, model.basis.degree, known)
