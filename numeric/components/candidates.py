"""Which tone is to be modelled beside an oscillation next: of the lines that models of it leave, the one that gains."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.components.bends import GAIN, STRICTER, score_beside
from ridgeback.numeric.components.given import Given, residual
from ridgeback.numeric.components.lines import LEAST, clearest_line
from ridgeback.numeric.components.tones import (
    Tone,
    each_refitted,
    fitted_tone,
    refitted,
    total,
)
from ridgeback.numeric.harmonics.harmonic_zones import harmonic_zones, in_zones
from ridgeback.numeric.harmonics.signal_model import SignalModels
from ridgeback.numeric.harmonics.spline_fit import Known, akaike, counted, fit_on, rounding
from ridgeback.numeric.harmonics.spline_model import SplineModel
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.signal.search_band import strongest_frequency

ROUNDS, RESTED = 30, 0.02
"""Of fitting a model and tones in turns: most of them, and the fall of the criterion in one with which it ends."""

Scored = tuple[float, tuple[Tone, ...]]


def more_tones(given: Given, models: SignalModels, tones: tuple[Tone, ...], most: int) -> tuple[Tone, ...] | None:
    """The tones with one more in the band, or some beyond it; None where none is worth its parameters."""
    return within_the_band(given, models, tones, most) or beyond_the_band(given, models, tones, most)


def within_the_band(given: Given, models: SignalModels, tones: tuple[Tone, ...], most: int) -> tuple[Tone, ...] | None:
    """The tones with more in the band in which models are judged, that do better than any number of knots."""
    known = replace(given.known, band=models.best.band)
    goal = min(model.criterion + STRICTER * (model.parameters - model.basis.count) for model in models.others) - GAIN
    tried: list[float] = []
    found: tuple[Tone, ...] | None = None
    for model in plain(given, tones, known, models.best.multiples):
        for score, more in one_after_another(given, model, tones, known, most, goal):
            if score < goal:
                goal, found = score, more
    for model in models.others if suspicious(given, models, tones) else ():
        line = line_in_the_band(given, model, tones, models.best.band)
        if line is None or any(abs(line - before) < TWO_PI * given.rate / given.x.size for before in tried):
            continue
        tried.append(line)
        score, more = together(given.x, model, tones, line, known, goal)
        if score < goal and are_others(more, model, len(tones)):
            goal, found = score, more
    return found


def one_after_another(
    given: Given, model: SplineModel, tones: tuple[Tone, ...], known: Known, most: int, goal: float = math.inf
) -> Iterator[Scored]:
    """Criterion and tones with one more, two more, ..: each at the clearest line that is left, as long as it gains.

    Of several steady tones beside a plain oscillation each by itself may do worse than knots that follow them all; a
    damped one is the last, and given up where it does not come to the ``goal``.
    """
    begun, least = len(tones), scored(given.x, model, tones, known)
    while len(tones) < most and all(tone.growth == 0.0 for tone in tones[begun:]):
        line = line_in_the_band(given, model, tones, model.band if known.band is None else known.band)
        if line is None:
            return
        score, tones = together(given.x, model, tones, line, known, goal, last=False)
        if score > least - GAIN or not are_others(tones, model, begun):
            return
        least, model = score, again(given.x - total(tones, given.time), model, known)
        yield score, tones


def first_tones(given: Given, tones: tuple[Tone, ...], most: int) -> tuple[Tone, ...] | None:
    """The tones with those that a plain oscillation leaves, where no model of any number of knots settles."""
    known = replace(given.known, band=counted(given.guide / given.rate, np.ones(given.x.size), ()))
    models = plain(given, tones, known, ())
    found = [one for model in models for one in one_after_another(given, model, tones, known, most)]
    return min(found, key=lambda one: one[0])[1] if found else None


def line_in_the_band(
    given: Given, model: SplineModel, tones: tuple[Tone, ...], band: tuple[float, float]
) -> float | None:
    """The clearest line in a band, rad per sample, that a model and tones leave, which is none of its harmonics."""
    taken = (*harmonic_zones(model), (0.0, band[0] * given.rate), (band[1] * given.rate, math.inf))
    least = LEAST * float(model.size.max())
    return clearest_line(residual(given.x, model, tones), given.rate, least, taken)


def are_others(tones: tuple[Tone, ...], model: SplineModel, begun: int) -> bool:
    """Whether tones are strong enough, and those after the first so many none of a model's harmonics."""
    strong = all(tone.amplitude >= LEAST * float(model.size.max()) for tone in tones)
    return strong and not in_zones(np.array([tone.omega for tone in tones[begun:]]), harmonic_zones(model)).any()


def beyond_the_band(given: Given, models: SignalModels, tones: tuple[Tone, ...], most: int) -> tuple[Tone, ...] | None:
    """The tones with those beyond the band in which models are judged, each worth its parameters where it is.

    Knots follow nothing there, so that a tone has nothing to compete with but noise.
    """
    model, rate, (low, high) = models.best, given.rate, models.best.band
    taken, found = (*harmonic_zones(model), (low * rate, high * rate)), tones
    left, sound = residual(given.x, model, tones), given.known.sound_of(given.x.size)
    floor = rounding(model.size)
    while len(found) < most:
        line = clearest_line(left, rate, LEAST * float(model.size.max()), taken)
        if line is None:
            break
        tone = fitted_tone(left, given.time, line, sound)
        without, beside = (score_beside(left, rate, one, sound, floor=floor, near=line) for one in (None, tone))
        if beside > without - GAIN or not are_others((tone,), model, 0):
            near = TWO_PI * rate / given.x.size
            taken = (*taken, (line - near, line + near))
            continue
        left, found = left - tone.samples(given.time), (*found, tone)
    return found if len(found) > len(tones) else None


def suspicious(given: Given, models: SignalModels, tones: tuple[Tone, ...]) -> bool:
    """Whether the best model of one oscillation leaves a line, or needed all the knots that there are."""
    best = min(models.others, key=lambda model: model.criterion)
    return best is models.others[-1] or line_in_the_band(given, best, tones, models.best.band) is not None


def plain(given: Given, tones: tuple[Tone, ...], known: Known, multiples: tuple[int, ...]) -> Iterator[SplineModel]:
    """Plain damped oscillations at the strongest line in a band: where beats lead the other models away from it.

    With the multiples as its harmonics, and without any: what was taken for them may be a mode that dies soon.
    """
    x, time, (low, high) = given.x - total(tones, given.time), given.time, known.band or (0.0, math.pi)
    try:
        omega = strongest_frequency(x, given.rate, band=(low * given.rate, min(high, math.pi) * given.rate))
    except InputError:
        return
    turned = x * np.exp(-1j * omega * time)
    begin = turned[: max(8, time.size // 4)].mean()
    phase, size = omega * time + float(np.angle(begin)), np.full(time.size, 2.0 * float(np.abs(begin)) + 1e-300)
    for held in dict.fromkeys((multiples, ())):
        model = fit_on(x, time, phase, size, time[[0, -1]], held, 1, known)
        yield model if model.settled else again(x, model, known)


def together(
    x: Array, model: SplineModel, tones: tuple[Tone, ...], line: float, known: Known, goal: float, *, last: bool = True
) -> Scored:
    """Akaike's criterion of a model and its tones with one more, fitted in turns, and the tones."""
    more = fitted_tone(residual(x, model, tones), model.time, line, known.sound_of(x.size))
    return in_turns(x, model, (*tones, more), known, goal=goal, last=last)


def in_turns(
    x: Array,
    model: SplineModel,
    found: tuple[Tone, ...],
    known: Known,
    *,
    goal: float = math.inf,
    last: bool = True,
) -> Scored:
    """The criterion of a model and tones, each fitted to what the others leave until nothing moves, and the tones.

    Given up where the criterion falls too slowly to come to the ``goal`` in the turns that are left; unless the tones
    are the ``last`` ones only where the last of them is damped.
    """
    time, sound, score = model.time, known.sound_of(x.size), math.inf
    for done in range(1, ROUNDS + 1):
        model = again(x - total(found, time), model, known)
        found = each_refitted(residual(x, model, found), time, found, partial(refitted, time=time, sound=sound))[0]
        before, score = score, scored(x, model, found, known)
        hopeless = score - (before - score) * (ROUNDS - done) > goal and (last or found[-1].growth != 0.0)
        if before - score < RESTED or hopeless:
            break
    return score, found


def scored(x: Array, model: SplineModel, tones: tuple[Tone, ...], known: Known) -> float:
    """The criterion of a model and tones beside it."""
    parameters = model.parameters - model.basis.count + sum(tone.parameters for tone in tones)
    off, floor = residual(x, model, tones) * known.sound_of(x.size), rounding(model.size)
    score = akaike(off, known.band or model.band, count=model.count, parameters=parameters, floor=floor)
    return float(score + STRICTER * parameters)


def again(x: Array, model: SplineModel, known: Known) -> SplineModel:
    """The same model of other samples, from where it was."""
    return fit_on(x, model.time, model.phase, model.size, model.breaks, model.multiples, model.basis.degree, known)
