"""Whether samples that nobody named are a displacement: their waveform against their backbone says so.

An oscillator's force makes both its backbone and the harmonics of its displacement.  The h-th harmonic of a velocity
is h times, that of an acceleration h^2 times as strong beside the fundamental: where no equation comes down to the
noise, and one does once the samples are taken for another quantity, they are of that.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, silent
from ridgeback.compare.identification.candidates import BACKBONE, VAN_DER_POL, Model
from ridgeback.compare.identification.fits import Ranked
from ridgeback.compare.identification.fitting import Data, Fit, fit, prepare
from ridgeback.compare.identification.preparation import ARTICLES, Prepared
from ridgeback.numeric.backbone.backbone import Backbone
from ridgeback.numeric.recording.quantity import GIVEN, ORDERS, displaced

CONTRADICTED = 60.0
"""Twice the fall of the log likelihood below that of the noise alone, from which on an equation is out."""
AGREES = 0.05
"""Share of that fall, beside a third of CONTRADICTED, that may be left for the right one: slow flows are series."""
NOTHING = 1e-3
"""Noise over amplitude below which an equation's slow flow, a series, is not held against it."""
NEAR_BEST = 9.0
"""Times the least sum of squares, that an equation may leave which is tried for another quantity."""
AS_OTHER = ("duffing-hardening", "duffing-softening", "pendulum", "helmholtz-duffing")
"""Smooth laws with harmonics, one of which the quantity must agree with."""


def refuse_another_quantity(ready: Prepared, data: Data, ranked: Ranked, progress: Progress = silent) -> None:
    """Refuse samples that an equation describes down to the noise once they are taken for a velocity or acceleration.

    Raises
    ------
    InputError
        That names the quantity, where nobody said what was measured.
    """
    equations = [found for found in ranked.fits if found.model.name not in (BACKBONE, VAN_DER_POL)]
    if GIVEN in ready.recording.facts or ready.noise is None or not equations:
        return
    lost = min(fall(found, ready.noise / data.length) for found in equations)
    if lost < CONTRADICTED:
        return
    others = [found.model for found in near_best(equations) if found.model.name in AS_OTHER]
    for quantity, left in described_as(ready, data.measured, others, ready.noise / data.length, progress):
        if left < AGREES * lost + CONTRADICTED / 3.0:
            raise InputError(
                f"{ready.recording.label}: the waveform contradicts a displacement, and is that of {ARTICLES[quantity]}"
                f" of an oscillator that leaves no more than the noise; give --quantity {quantity}, which converts it, "
                "or --quantity displacement to have it taken for one all the same"
            )


def near_best(fits: list[Fit]) -> list[Fit]:
    """Those that leave little more than the best of them: their backbone bends the right way."""
    least = min(found.sum_of_squares for found in fits)
    return [found for found in fits if found.sum_of_squares <= NEAR_BEST * least]


def described_as(
    ready: Prepared, measured: Backbone, others: list[Model], noise: float, progress: Progress
) -> Iterator[tuple[str, float]]:
    """The fall of the best model for the samples taken for each other quantity; ``noise`` over the amplitude.

    A law of damping makes amplitudes fall, which are nearly in proportion: each model keeps its own.
    """
    for quantity in ARTICLES if others and ready.models is not None else ():
        progress(0.9, f"the waveform as that of {ARTICLES[quantity]}")
        falls = [fall(found, noise) for found in fits_as(ready, measured, quantity, others)]
        if falls:
            yield quantity, min(falls)


def fits_as(ready: Prepared, measured: Backbone, quantity: str, others: list[Model]) -> Iterator[Fit]:
    """The models fitted to the displacement behind the samples, taken for this quantity; not those that cannot be."""
    assert ready.models is not None  # noqa: S101 - it is only asked for where there are
    if measured.omega.size < 2:
        return
    x = ready.recording.values - ready.recording.values.mean()
    turned = replace(ready.recording, values=displaced(x, ready.models.best, quantity))
    with suppress(InputError):
        data = prepare(turned, ready.track, kept=ready.kept, measured=behind(measured, ORDERS[quantity]))
        for model in others:
            with suppress(InputError):
                yield fit(model, data)


# x = (d/dt)^q u with a slowly changing wave: a_u = a_x / omega^q, so a_u'/a_u = a_x'/a_x - q omega'/omega
def behind(measured: Backbone, order: int) -> Backbone:
    """The backbone of what was measured as that of the displacement, near enough for fits of the samples to start."""
    scale = measured.omega**order
    turn = np.gradient(np.log(measured.omega), measured.time)
    return replace(
        measured,
        amplitude=measured.amplitude / scale,
        amplitude_sd=measured.amplitude_sd / scale,
        growth_rate=measured.growth_rate - order * turn,
        offset=0.0,
    )


# -2 ln L = n ln(RSS / n) + const
def fall(found: Fit, noise: float) -> float:
    """Twice the fall of the log likelihood of a fit below that of what a free model leaves, over the amplitude."""
    left, n = found.sum_of_squares / found.residual.size, found.residual.size
    return n * math.log(max(left, math.ulp(0.0)) / max(noise, NOTHING) ** 2)
