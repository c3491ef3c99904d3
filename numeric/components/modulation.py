"""An oscillation whose amplitude or frequency swings: the lines about it are its own, and no components.

    (1 + m cos W t) cos w t = cos w t + m/2 cos (w + W) t + m/2 cos (w - W) t

A frequency that swings has lines at w +- k W, of Bessel functions of its index (J. R. Carson, Proc. IRE 10 (1922) 57).
Over e^(i phi), phi the phase of a carrier that may decay, the lines y_1 at w + W and y_2 at w - W agree:

    y_1 = conj(y_2) for an amplitude that swings,        y_1 = -conj(y_2) for a frequency.

Two components agree so in distance, size, growth rate and phase only by accident.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.common.quantities import angular
from ridgeback.numeric.arrays import ComplexArray
from ridgeback.numeric.components.given import Given
from ridgeback.numeric.components.lines import LEAST
from ridgeback.numeric.components.tones import Tone, total
from ridgeback.numeric.harmonics.signal_model import SignalModels, among
from ridgeback.numeric.harmonics.spline_fit import (
    FINEST_CYCLES,
    breaks_of,
    counted,
    fit_on,
    splines_tried,
    until_no_better,
)
from ridgeback.numeric.harmonics.spline_model import SplineModel
from ridgeback.numeric.harmonics.spline_parts import DEGREE
from ridgeback.numeric.signal.samples import TWO_PI

MIRRORED, CLEARLY, MOST = 0.1, 3.0, 0.25
"""Relative difference of a line from the mirror of another up to which it is it: that, or so many of its deviations,
and the most of all."""
OF_A_LINE = 6
"""Parameters of two lines."""
NEAR = 0.5
"""Of the distance of ordinates of the spectrum, within which a line lies at a multiple of the rate of a swing."""
KNOTS = 2.0
"""In a swing, at least."""
COMB, APART, SLOW = 4, 2.0, 0.1
"""Lines beside one of them from which on even distances are no accident; ordinates of the spectrum that these distances
are at least; and of the frequency, at most."""


@dataclass(frozen=True)
class Swing:
    """At what rate, rad per time unit, the frequency of an oscillation swings, or its amplitude."""

    rate: float
    of_frequency: bool
    mirrored: bool = True
    """Whether its lines are mirrored about the strongest, which is its mean; else they are at even distances."""

    def said(self) -> str:
        """The swing in words.

        >>> Swing(3.0 * TWO_PI, False).said()
        'its amplitude swings at 3 cycles per unit (the lines beside it are mirrored about it)'
        """
        what = "frequency" if self.of_frequency else "amplitude"
        how = "mirrored about it" if self.mirrored else "at even distances"
        return f"its {what} swings at {self.rate / TWO_PI:.4g} cycles per unit (the lines beside it are {how})"


def turned_back(tone: Tone, model: SplineModel) -> ComplexArray:
    """A tone over the phase of an oscillation."""
    return np.asarray(tone.size * tone.wave(model.time) * np.exp(-1j * model.phase), dtype=np.complex128)


def mirrored(one: Tone, other: Tone, model: SplineModel) -> int:
    """1 where two tones are mirrored about an oscillation as those of an amplitude, -1 as of a frequency; else 0."""
    y, mirror = turned_back(one, model), np.conj(turned_back(other, model))
    least = min(float(np.linalg.norm(y)), float(np.linalg.norm(mirror)))
    deviation = model.noise * math.sqrt(2.0 * OF_A_LINE) / max(least, 1e-300)
    within = min(MOST, max(MIRRORED, CLEARLY * deviation))
    return next((sign for sign in (1, -1) if float(np.linalg.norm(y - sign * mirror)) < within * least), 0)


def swing_of(model: SplineModel, tones: tuple[Tone, ...]) -> Swing | None:
    """What the strongest pair of tones that is mirrored about an oscillation says of it; None where none is.

    >>> from ridgeback.numeric.harmonics.signal_model import signal_models
    >>> t = np.arange(800) / 40.0
    >>> model = signal_models(np.cos(9.0 * t), 40.0, np.full(800, 9.0), half=60, multiples=()).best
    >>> swing_of(model, (Tone(10.5, 0.0, 0.1j), Tone(7.5, 0.0, 0.1j)))
    Swing(rate=1.5, of_frequency=True, mirrored=True)
    >>> swing_of(model, (Tone(10.5, 0.0, 0.1j), Tone(7.5, 0.0, 0.1))), swing_of(model, (Tone(10.5, 0.0, 0.1j),))
    (None, None)
    """
    omega = model.mean_omega
    above, below = ([t for t in tones if sign * (t.omega - omega) > 0.0] for sign in (1.0, -1.0))
    found = [(one, other, sign) for one in above for other in below if (sign := mirrored(one, other, model))]
    if not found:
        return comb_of(model, tones)
    one, other, sign = max(found, key=lambda pair: pair[0].amplitude)
    return Swing(0.5 * (one.omega - other.omega), sign < 0)


def comb_of(model: SplineModel, tones: tuple[Tone, ...]) -> Swing | None:
    """A frequency that swings so far that the strongest of its lines is not that of its mean; None where none does.

    >>> from ridgeback.numeric.harmonics.signal_model import signal_models
    >>> t = np.arange(800) / 40.0
    >>> model = signal_models(np.cos(19.0 * t), 40.0, np.full(800, 19.0), half=60, multiples=()).best
    >>> comb_of(model, tuple(Tone(omega, 0.0, 0.1 + 0j) for omega in (20.5, 17.5, 22.0, 23.5)))
    Swing(rate=1.5, of_frequency=True, mirrored=False)
    >>> comb_of(model, tuple(Tone(omega, 0.0, 0.1 + 0j) for omega in (20.5, 17.5, 22.0, 24.0)))
    """
    away = np.array([abs(tone.omega - model.mean_omega) for tone in tones])
    if away.size < COMB or not APART * TWO_PI / float(model.time[-1]) < away.min() < SLOW * model.mean_omega:
        return None
    multiples = np.rint(away / away.min())
    swing = Swing(round(float(away @ multiples / (multiples @ multiples)), 12), of_frequency=True, mirrored=False)
    return swing if len(its_lines(swing, model, tones)) >= COMB else None


def its_lines(swing: Swing, model: SplineModel, tones: tuple[Tone, ...]) -> tuple[Tone, ...]:
    """The tones that are lines of a swing: at its rate from the oscillation, at twice it where one is at once it, ...

    >>> from ridgeback.numeric.harmonics.signal_model import signal_models
    >>> t = np.arange(800) / 40.0
    >>> model = signal_models(np.cos(9.0 * t), 40.0, np.full(800, 9.0), half=60, multiples=()).best
    >>> tones = tuple(Tone(omega, 0.0, 0.1 + 0j) for omega in (10.0, 8.0, 7.0, 10.5, 14.0))
    >>> [tone.omega for tone in its_lines(Swing(1.0, True), model, tones)]
    [10.0, 8.0, 7.0]
    """
    near, found = NEAR * TWO_PI / float(model.time[-1]), list[Tone]()
    for multiple in range(1, len(tones) + 1):
        away = multiple * swing.rate
        more = [tone for tone in tones if abs(abs(tone.omega - model.mean_omega) - away) < near]
        if not more:
            break
        found += more
    return tuple(dict.fromkeys(found))


def swinging(
    given: Given, model: SplineModel, swing: Swing, own: tuple[Tone, ...], rest: tuple[Tone, ...]
) -> SignalModels | None:
    """Models in which an oscillation swings instead of having lines of its ``own``, beside the ``rest`` of the tones.

    They begin from what it and its lines are together.  None where they leave more than those do.
    """
    time = given.time
    swings = swing.rate * float(time[-1]) / TWO_PI
    whole = model.size + np.sum([turned_back(tone, model) for tone in own], axis=0)
    phase, size = model.phase + np.unwrap(np.angle(whole)), np.abs(whole)
    beside = np.concatenate([tone.tangent(time) for tone in rest], axis=1) if rest else None
    band = counted(np.gradient(phase), size, model.multiples)
    known, x = replace(given.known, beside=beside, band=band), given.x - total(rest, time)
    cycles = float(phase[-1] - phase[0]) / TWO_PI
    tried = [s.intervals for s in splines_tried(cycles, x.size, model.families) if s.intervals > KNOTS * swings]
    finest = int(min(cycles / FINEST_CYCLES, x.size / (3 * model.families) - DEGREE))
    breaks = (breaks_of(phase, time, n) for n in (*tried, *(() if finest in tried else (finest,))))
    if finest <= KNOTS * swings:
        return None
    try:
        fits = (fit_on(x, time, phase, size, at, model.multiples, known=known) for at in breaks)
        found = among(until_no_better(fits))
    except InputError:
        return None
    return found if explains(found.best, model) else None


# What a spline of K' coefficients leaves beyond noise, in units of the noise, next to sqrt(2 K'), the scatter of chi^2.
def explains(model: SplineModel, other: SplineModel) -> bool:
    """Whether a model leaves no more than another and its tones in view of the noise, or as good as nothing."""
    if model.noise < LEAST * float(model.size.max()):
        return True
    more = model.count * ((model.noise / max(other.noise, 1e-300)) ** 2 - 1.0)
    return more < CLEARLY * math.sqrt(2.0 * model.parameters)


def with_swing(
    given: Given, models: SignalModels, tones: tuple[Tone, ...]
) -> tuple[SignalModels, tuple[Tone, ...], Swing | None]:
    """Models of an oscillation that swings, if it does and they follow it, and the tones that are no lines of it.

    Examples
    --------
    >>> t, noise = np.arange(900) / 45.0, 0.01 * np.random.default_rng(1).normal(size=900)
    >>> x = (1.0 + 0.3 * np.cos(1.5 * t)) * np.cos(46.0 * t) + noise
    >>> given = Given(x, 45.0, np.full(900, 46.0), 12, (), np.ones(900, dtype=bool))
    >>> lines = (Tone(47.5, 0.0, 0.15), Tone(44.5, 0.0, 0.15))
    >>> models, tones, swing = with_swing(given, given.beside(lines), lines)
    >>> tones, swing, bool(np.std(models.best.size - 0.3 * np.cos(1.5 * t)) < 0.01)
    ((), Swing(rate=1.5, of_frequency=False, mirrored=True), True)
    """
    swing = swing_of(models.best, tones)
    if swing is None:
        return models, tones, None
    own = its_lines(swing, models.best, tones)
    rest = tuple(tone for tone in tones if tone not in own)
    found = swinging(given, models.best, swing, own, rest)
    return (models, tones, swing) if found is None else (found, rest, swing)


def unfollowed(swing: Swing, model: SplineModel) -> str:
    """Why nothing is claimed of an oscillation that swings faster than models of it follow.

    Parameters
    ----------
    swing : Swing
        Of the oscillation.
    model : SplineModel
        Of its mean, its lines beside it.
    """
    each = model.mean_omega / swing.rate
    return (
        f"{swing.said()}; models in which it swings, every {each:.3g} cycles, leave more of the samples than those "
        f"lines do, so that its swing about {angular(model.mean_omega)} is not followed"
    )


def swing_notes(swing: Swing | None) -> tuple[str, ...]:
    """That an oscillation swings, in words.

    >>> swing_notes(Swing(3.0 * TWO_PI, True))[0][:47]
    'Its frequency swings at 3 cycles per unit (the '
    >>> swing_notes(None)
    ()
    """
    if swing is None:
        return ()
    said = swing.said()
    return (f"{said[0].upper()}{said[1:]}, which are taken for its own and for no components.",)
