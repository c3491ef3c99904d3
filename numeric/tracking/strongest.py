"""Which component of a record is the oscillation: the one of the most energy, though a hum may outlast it.

The highest line of a spectrum can be a hum that lasts beside a mode which is larger and dies: a tone of amplitude m
over a time T has a line of m T / 2, a mode of amplitude A and growth rate -g one of A / (2 g), but their energies are
m^2 T / 2 and A^2 / (4 g).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.components.tones import Tone, fitted_tone, iterated
from ridgeback.numeric.signal.decimation import Samples
from ridgeback.numeric.signal.search_band import strongest_frequency
from ridgeback.numeric.tracking.choices import Held
from ridgeback.numeric.tracking.own_stretch import in_its_stretch
from ridgeback.numeric.tracking.request import FEWEST_SAMPLES, Request, prepared

STRONGER = 1.5
"""Times the energy of the hum, of an oscillation that it outlasts."""
APART, AS_GOOD = 0.02, 1.1
"""Relative distance of a hum's frequency from the mean one of an oscillation, and a ratio of what two models leave."""
DEAD, WEAKER = 0.3, 0.3
"""Of its largest amplitude: the last one of an oscillation that a hum outlasts, and that of the hum."""
LARGEST = 2.0
"""Of the largest sample, that an oscillation may have as amplitude at the first one: it may fall and have harmonics."""
ELSE = 0.03
"""Of the square of a hum's amplitude: the mean square of what else may be where it has outlasted the oscillation."""
AT_THE_END = 1.0 / 3.0, 1.0 / 6.0
"""Shares of a record at its end, in which a hum is looked for that outlasts the oscillation."""


def of_most_energy(request: Request, samples: Samples) -> Request:
    """The request for the component of the most energy, alone: a mode that a steady hum outlasts.

    Parameters
    ----------
    request : Request
        For one oscillation alone, with models of it and tones beside it if there are any.
    samples : Samples
        Of the whole record.
    """
    if request.options.band is not None or request.options.most_tones < 1:
        return request
    larger, unsure = has_larger(request), is_unsure(request)
    if not (larger or unsure) and any(tone.growth == 0.0 for tone in request.signal.tones):
        return request
    hum = own_hum(request, samples) if larger else outlasting(samples)
    if hum is None or not (larger or unsure or ends_in(hum, request)) or is_all(hum, samples):
        return request
    try:
        found = above(hum, request, samples)
    except InputError:
        return request
    if found.known_models is None or found.signal.doubt or not outlasts(hum, found):
        return request
    if unsure or (ends_in(hum, request) and is_simpler(found, request)):
        return found
    own = float(np.sum(found.models.best.size**2))
    return found if own > STRONGER * hum.amplitude**2 * samples.x.size else request


def own_hum(request: Request, samples: Samples) -> Tone:
    """What was taken for the oscillation, as a steady tone at times from the first sample of the record on."""
    best, late = request.models.best, request.signal.start - samples.start
    omega = best.mean_omega
    tone, _ = iterated(best.samples(), best.time, Tone(omega, 0.0, 0j), np.ones(best.time.size), free=False)
    return moved(tone, -late)


def ends_in(hum: Tone, request: Request) -> bool:
    """Whether one oscillation without a steady tone beside it is APART in frequency from a hum at the end."""
    if request.known_models is None:
        return False
    best = request.models.best
    return abs(best.mean_omega / hum.omega - 1.0) > APART


def is_all(hum: Tone, samples: Samples) -> bool:
    """Whether a hum is too large for anything that it outlasts: a record of one even size is that of no mode that dies.

    >>> t = np.arange(200) / 10.0
    >>> is_all(Tone(6.0, 0.0, 1.0), Samples(np.cos(5.0 * t + 0.02 * t**2), 10.0, 0.0))
    True
    """
    return hum.amplitude >= WEAKER * LARGEST * float(np.abs(samples.x - samples.x.mean()).max())


def outlasts(hum: Tone, found: Request) -> bool:
    """Whether a hum is as large beside an oscillation as after it, and that is larger and dies.

    A motion that jumps to another frequency is a hum and the beats of both that end at the jump, of the same size.
    """
    size = found.models.best.size
    if max(float(size[-1]) / DEAD, hum.amplitude / WEAKER) >= float(size.max()):
        return False
    return any(
        abs(tone.omega / hum.omega - 1.0) < 0.5 * APART and 0.5 * hum.amplitude < tone.amplitude < 2.0 * hum.amplitude
        for tone in found.signal.tones
    )


def is_simpler(found: Request, request: Request) -> bool:
    """Whether a model of as much of the samples leaves as little with fewer parameters."""
    ours, theirs = found.models.best, request.models.best
    count = ours.parameters + sum(tone.parameters for tone in found.signal.tones)
    return ours.noise < AS_GOOD * theirs.noise and count < theirs.parameters


def has_larger(request: Request) -> bool:
    """Whether a mode beside the oscillation begins with a larger amplitude than the oscillation ever has."""
    if request.known_models is None:
        return False
    own = float(request.models.best.size.max())
    return any(tone.growth < 0.0 and tone.amplitude > own for tone in request.signal.tones)


def is_unsure(request: Request) -> bool:
    """Whether no model holds for all of the samples."""
    return request.known_models is None or bool(request.signal.doubt) or Held.FOLLOWED in request.signal.span_why


def outlasting(samples: Samples) -> Tone | None:
    """A steady tone at the end of a record, at times from its first sample on; None where there is none.

    >>> t = np.arange(900) / 30.0
    >>> x = np.exp(-t) * np.cos(12.0 * t) + 0.05 * np.cos(10.0 * t + 1.0)
    >>> hum = outlasting(Samples(x, 30.0, 0.0))
    >>> bool(abs(hum.omega - 10.0) < 1e-3), bool(abs(hum.size - 0.05 * np.exp(1j)) < 1e-3)
    (True, True)
    """
    begins = (round((1.0 - share) * samples.x.size) for share in AT_THE_END)
    return next((tone for begin in begins if (tone := steady_from(begin, samples)) is not None), None)


def steady_from(begin: int, samples: Samples) -> Tone | None:
    """The strongest line from one of the samples on, if it is steady and hardly anything else is there."""
    time, left = np.arange(samples.x.size) / samples.rate, samples.x[begin:] - samples.x[begin:].mean()
    if left.size < FEWEST_SAMPLES:
        return None
    try:
        omega = strongest_frequency(left, samples.rate)
    except InputError:
        return None
    sound = np.ones(left.size) if samples.wrong is None else (~samples.wrong[begin:]).astype(float)
    tone = fitted_tone(left, time[: left.size], omega, sound)
    other = float(np.average((left - tone.samples(time[: left.size])) ** 2, weights=sound))
    return None if tone.growth != 0.0 or other > ELSE * tone.amplitude**2 else moved(tone, -time[begin])


def moved(tone: Tone, seconds: float) -> Tone:
    """A steady tone at times that begin so much later.

    >>> tone = Tone(3.0, 0.0, 1.0 + 2.0j)
    >>> bool(np.isclose(moved(tone, 0.5).samples(np.array([1.0]))[0], tone.samples(np.array([1.5]))[0]))
    True
    """
    return replace(tone, size=complex(tone.size * np.exp(1j * tone.omega * seconds)))


def above(hum: Tone, request: Request, samples: Samples) -> Request:
    """The request for what there is without a hum, modelled together with it."""
    time = np.arange(samples.x.size) / samples.rate
    bare = replace(samples, x=samples.x - hum.samples(time))
    found = in_its_stretch(prepared(bare, request.options), bare)
    beside = (moved(hum, found.signal.start - samples.start),)
    return replace(found, signal=replace(found.signal, tones=beside), known_models=None).separated()
