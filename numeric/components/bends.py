"""Bends of a tone: a mode that is not linear changes its frequency and its growth rate as it decays.

They are kept where the criterion of Schwarz's kind (``components.separation``) falls by GAIN or more.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.components.tones import Tone, bent_start, bent_tone
from ridgeback.numeric.harmonics.spline_fit import akaike, corrected_phase

GAIN, STRICTER = 12.0, 3.0
"""Fall of the criterion that is wanted, and what a parameter counts beyond Akaike's 2."""
DEGREES, JUDGED = (2, 3, 5), (0.6, 1.4)
"""Of the exponent of a tone with bends, and the band in which it is judged, in its frequency."""


def with_bends(left: Array, rate: float, tone: Tone, sound: Array, *, floor: float) -> Tone:
    """A tone with bends where they gain, fitted to what all else leaves of samples; a steady one has none.

    One with bends may get more.  ``floor`` is the size of what is left that counts as nothing.

    >>> t = np.arange(600) / 20.0
    >>> noise = 0.001 * np.random.default_rng(1).normal(size=600)
    >>> left = 0.5 * np.exp(-0.1 * t) * np.cos(9.0 * t + 0.02 * t**2)
    >>> bent = with_bends(left + noise, 20.0, Tone(9.2, -0.1, 0.4), np.ones(600), floor=1e-9)
    >>> round(bent.omega, 2), round(bent.growth, 2), len(bent.bends)
    (9.0, -0.1, 1)
    """
    time = np.arange(left.size) / rate
    if tone.growth == 0.0:
        return tone
    starts = bent_starts(left, time, tone)
    tried = [bent for start in starts if (bent := bent_or_none(left, time, start, sound)) is not None]
    scores = [score_beside(left, rate, one, sound, floor=floor, near=tone.omega) for one in (tone, *tried)]
    return tried[int(np.argmin(scores[1:]))] if min(scores) < scores[0] - GAIN else tone


def score_beside(left: Array, rate: float, tone: Tone | None, sound: Array, *, floor: float, near: float) -> float:
    """The criterion of what is left of samples in the band about a frequency, less a tone if there is one."""
    time, band = np.arange(left.size) / rate, (JUDGED[0] * near / rate, JUDGED[1] * near / rate)
    parameters = 0 if tone is None else tone.parameters
    off = (left if tone is None else left - tone.samples(time)) * sound
    score = akaike(off, band, count=int(sound.sum()), parameters=parameters, floor=floor)
    return float(score + STRICTER * parameters)


def bent_starts(left: Array, time: Array, tone: Tone) -> Iterator[Tone]:
    """Tones of more bends to begin a fit from: those of a tone with bends, else those of what is near its frequency."""
    if tone.bends:
        missing = (degree - 1 - len(tone.bends) for degree in DEGREES)
        yield from (replace(tone, bends=(*tone.bends, *[0j] * more)) for more in missing if more > 0)
        return
    phase, size = corrected_phase(left, 1.0 / float(time[1] - time[0]), np.full(time.size, tone.omega))
    yield from (bent_start(time, phase, size, degree) for degree in DEGREES)


def bent_or_none(left: Array, time: Array, start: Tone, sound: Array) -> Tone | None:
    """The tone with bends that fits from a start; None where its exponent leaves the range of numbers."""
    try:
        with np.errstate(over="raise", invalid="raise"):
            return bent_tone(left, time, start, sound)
    except (FloatingPointError, np.linalg.LinAlgError):
        return None
