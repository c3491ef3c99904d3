"""One oscillation out of a record: what shares its band is modelled with it and taken off, or said to be in the way.

Models of one smooth oscillation are tried on more and more knots.  Where what such a model leaves shows a line, a tone
at that line is fitted together with it, in turns (backfitting: Breiman and Friedman, J. Am. Stat. Assoc. 80 (1985)
580), and kept where the criterion of both falls by GAIN below that of the best model of one: beats of two components
take many knots to follow, their two components few parameters.  Parameters count about as in the criterion of Schwarz
(Ann. Stat. 6 (1978) 461), which finds the true model where Akaike's finds the best predictor.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.components.bends import with_bends
from ridgeback.numeric.components.beyond import nothing_in
from ridgeback.numeric.components.candidates import first_tones, in_turns, more_tones
from ridgeback.numeric.components.doubts import doubt, in_the_way
from ridgeback.numeric.components.given import Given, residual
from ridgeback.numeric.components.lines import LEAST, clearest_line, colour, unlike
from ridgeback.numeric.components.modulation import Swing, unfollowed, with_swing
from ridgeback.numeric.components.overlap import PLAIN, Found, least_of, overlap_doubt, overlapping, told
from ridgeback.numeric.components.tones import Tone, total
from ridgeback.numeric.components.unlocked import locked_and_others, unlocked
from ridgeback.numeric.harmonics.signal_model import SignalModels, signal_models
from ridgeback.numeric.harmonics.spline_fit import Known, rounding
from ridgeback.numeric.harmonics.spline_model import SplineModel
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.signal.spikes import FAR, TO_SIGMA, spikes, without_isolated

MOST_TONES = 6
SAME = 0.1
"""Of the noise, by which tones may differ between two models."""
KEPT = 6
"""Records that are kept separated: a method asks for a few parts of one, and so does the next."""
ROUNDS, FEW = 3, 0.01
"""In which spikes, and other modes among the harmonics, are looked for; and the share of samples that are few."""


@dataclass(frozen=True)
class Separated:
    """The samples of one oscillation, with models of it.

    ``x`` are the samples less the ``tones``, those that are no part of the motion (not ``sound``) replaced by the
    model; ``spikes`` says how many were outside the noise.  ``reason`` is why no model of it can be trusted, if so;
    ``swing`` how it swings, if it does.
    """

    x: Array
    models: SignalModels
    sound: Mask
    tones: tuple[Tone, ...]
    spikes: int
    reason: str = ""
    swing: Swing | None = None


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
    shared: float = 1.0,
    start: float = 0.0,
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
    shared : float
        Variance of the oscillation's parameters beside components that are off the samples, over that without them.
    start : float
        Time of the first sample in the record, in which a doubt is told.

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
    sound, raw = np.ones(x.size, dtype=np.bool_) if excluded is None else ~excluded, x
    x, odd = without_isolated(x)
    filled, odd, sound = x, odd & sound, sound & ~odd
    if not sound.all():
        apart = total(beyond, np.arange(x.size) / rate)
        bare = signal_models(x - apart, rate, guide, half=half, multiples=(), known=Known(sound.astype(float)))
        filled = np.where(sound, x, bare.best.samples() + apart)
    free = multiples is None and most > 0
    if free:
        apart = filled - total(beyond, np.arange(x.size) / rate)
        multiples, others = unlocked(Given(apart, rate, guide, half, (), sound, band))
        beyond = (*beyond, *others)
    given = Given(filled, rate, guide, half, multiples, sound, band)
    most += len(beyond)
    models, tones = with_tones(given, beyond, most)
    if tones and not sound.all():  # they were filled as if the oscillation were alone
        given = given.filled(x, models, tones)
        models, tones = with_tones(given, beyond, most)
        given = given.filled(x, models, tones)
        models, tones = with_tones(given, tones, most)
    if free and tones:
        given, models, tones = with_other_modes(given, models, tones, most)
    pair, found = overlapping(given, models, tones) if most > len(beyond) else None, models
    models, tones = with_overlapping(given, models, tones, most, pair)
    if odd.any():
        given = with_returned(given, raw, models.best, tones, odd)
        x = given.x
    count = int((odd & ~given.sound).sum())
    for _ in range(ROUNDS):
        left, cycle = residual(given.x, models.best, tones), TWO_PI * rate / float(np.median(guide))
        off = spikes(left, cycle, float(models.best.size.max())) & given.sound
        if not off.any() or (off.mean() > FEW and clearest_line(left, rate, LEAST * float(models.best.size.max()))):
            break  # so many, where a line is left, are its tops
        sound, count = given.sound & ~off, count + int(off.sum())
        given = replace(given, sound=sound).filled(x, models, tones)
        models, tones = with_tones(given, tones, most)
    mean, lines = models.best, tones
    models, tones, swing = with_swing(given, models, tones)
    left = residual(given.x, models.best, tones)
    loud = unlike(left, models.best.size, models.best.phase, given.sound.astype(float))
    known = models.coloured(shared * loud * colour(left, rate, models.best.mean_omega, models.best.basis.count))
    single = np.where(given.sound, given.x - total(tones, given.time), models.best.samples())
    if swing:
        missed = in_the_way(residual(given.x, mean, lines), rate, mean)
        reason = unfollowed(swing, mean) if tones == lines else missed
    else:
        if models is not found and most > len(beyond):
            pair = overlapping(given, models, tones)
        reason = (overlap_doubt(pair[0], tones) if pair else "") or doubt(
            known, given.x, left, rate, given.guided(tones).guide, given.sound, start=start
        )
    reason = off_the_band(models.best, band) or reason
    return Separated(single, known, given.sound, tones, count, reason, swing)


def with_returned(given: Given, raw: Array, model: SplineModel, tones: tuple[Tone, ...], odd: Mask) -> Given:
    """What is given with the samples back that stood out of their neighbours, and do not of a model of the whole."""
    left = residual(raw, model, tones)
    near = odd & (np.abs(left) <= FAR * TO_SIGMA * float(np.median(np.abs(left[given.sound]))))
    return replace(given, x=np.where(near, raw, given.x), sound=given.sound | near)


@lru_cache(maxsize=KEPT)
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
    shared: float,
    start: float,
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
        shared=shared,
        start=start,
    )


def off_the_band(model: SplineModel, band: tuple[float, float] | None) -> str:
    """Why a model cannot be trusted that left the band it was to be in; empty where it did not, or there is none."""
    omega = model.mean_omega
    if band is None or band[0] <= omega <= band[1]:
        return ""
    return nothing_in(band, omega)


def with_tones(given: Given, here: tuple[Tone, ...], most: int) -> tuple[SignalModels, tuple[Tone, ...]]:
    """Models of the oscillation, and the tones beside it: those that are here, and more as long as they gain."""
    try:
        models, here = settled(given, here) if here else (given.beside(here), here)
    except InputError:
        first = first_tones(given, here, most)
        if first is None:
            raise
        models, here = settled(given, first)
    while len(here) < most:
        found = more_tones(given, models, here, most)
        if found is None:
            break
        try:
            models, here = settled(given, found)
        except InputError:
            break
    return models, here


def with_overlapping(
    given: Given, models: SignalModels, tones: tuple[Tone, ...], most: int, found: Found
) -> tuple[SignalModels, tuple[Tone, ...]]:
    """The same with the lesser of two modes as a tone, where these explain more and can be told apart.

    It was fitted together with a plain oscillation: where that is what is left, intervals are those of both together.
    """
    if found is None or not told(found[0]):
        return models, tones
    both = (*found[1], found[0][1])
    try:
        beside = given.beside(both)
        plain = least_of(beside)
        return (beside.only(plain), both) if plain.basis.count <= PLAIN else with_tones(given, both, most)
    except InputError:
        return models, tones


def with_other_modes(
    given: Given, models: SignalModels, tones: tuple[Tone, ...], most: int
) -> tuple[Given, SignalModels, tuple[Tone, ...]]:
    """The same with tones for what was taken for harmonics and is none, which shows once other tones are off."""
    sound = given.known.sound_of(given.x.size)
    for _ in range(ROUNDS):
        apart = given.x - total(tones, given.time)
        kept, others = locked_and_others(apart, models.best, models.best.multiples, sound)
        if not others:
            break
        told = replace(given, multiples=kept)
        try:
            models, tones = with_tones(told, (*tones, *others), most + len(others))
        except InputError:
            break
        given, most = told, most + len(others)
    return given, models, tones


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
    sound, floor = given.known.sound_of(given.x.size), rounding(model.size)
    left, time = residual(given.x, model, tones), given.time
    return tuple(with_bends(left + tone.samples(time), given.rate, tone, sound, floor=floor) for tone in tones)
