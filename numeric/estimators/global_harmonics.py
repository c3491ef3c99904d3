"""The track of the global harmonic least squares: the model of the whole signal is the estimate itself."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.tracking.choices import Scope
from ridgeback.numeric.tracking.request import Request
from ridgeback.numeric.tracking.track import Track
from ridgeback.numeric.tracking.uncertainty import moving_mean, room_of_definition

ONE_MODEL = "models of the whole signal settle on one number of knots only: nothing shows their bias"


def by_harmonic_splines(request: Request) -> Track:
    """The best model's frequency, at all samples: a spline fit is one-sided at the borders by itself."""
    model = request.models.best
    used = replace(
        request.used,
        scope=Scope.GLOBAL,
        noise=model.noise,
        harmonics=(1, *model.multiples),
        cycles_per_knot=model.cycles,
        one_sided_borders=True,
    )
    everywhere = np.ones(request.signal.x.size, dtype=np.bool_)
    details = request.details(parameters=model.parameters)
    sigma = model.omega_deviation
    return Track(request.signal.time, model.omega, everywhere, "harmonic-least-squares", sigma, None, used, details)


def surplus(difference: Array, wider: Array, narrower: Array, request: Request) -> Array:
    """Mean square of the difference of two nested models over a window, less what noise makes of it.

    For nested least-squares models var(fine - coarse) = var(fine) - var(coarse).
    """
    noise = np.maximum(wider**2 - narrower**2, 0.0)
    return moving_mean(difference**2 - noise, max(1, round(request.plan.lag_seconds * request.signal.rate)))


def with_spline_interval(track: Track, request: Request) -> Track:
    """The same track with the difference from the finer model as its bias, and the interval that the finer one has."""
    models = request.models
    best, fine, coarse = models.best, models.fine, models.coarse
    if fine is coarse:
        return replace(track, no_interval=ONE_MODEL)
    correction = np.maximum(fine.omega_deviation**2 - best.omega_deviation**2, 0.0)
    left = surplus(coarse.omega - fine.omega, fine.omega_deviation, coarse.omega_deviation, request)
    ambiguous, room = room_of_definition(fine.omega, fine.time, best)
    how = {"bias_by": "a model with more knots", "deviation_by": "Fisher information"}
    return replace(
        track,
        bias=best.omega - fine.omega,
        bias_deviation=np.sqrt(correction + models.remainder**2 * left + room**2),
        ambiguous=ambiguous,
        details={**track.details, **how},
    )


def spline_error(request: Request) -> float:
    """Relative rms error that the best model should have: its noise, and its bias as the finer one shows it."""
    best, fine = request.models.best, request.models.fine
    bias = surplus(best.omega - fine.omega, fine.omega_deviation, best.omega_deviation, request)
    inner = slice(request.margin, best.time.size - request.margin)
    return float(np.sqrt(np.mean(((best.omega_deviation**2 + bias) / best.omega**2)[inner])))
