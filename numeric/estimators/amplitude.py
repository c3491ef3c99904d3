"""The amplitude of the fundamental or of a harmonic against time, with its bias and its interval."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.harmonics.spline_model import SplineModel
from ridgeback.numeric.signal.decimation import checked
from ridgeback.numeric.tracking.request import FEWEST_SAMPLES, Options, Request, prepared
from ridgeback.numeric.tracking.track import AmplitudeTrack
from ridgeback.numeric.tracking.uncertainty import SEED, moving_mean, pooled

REPLICATES = 48
"""Of the noise; each costs one solution of the normal equations."""


def estimate_amplitude(
    x: ArrayLike,
    rate: float,
    *,
    harmonic: int = 1,
    band: tuple[float, float] | None = None,
    start: float = 0.0,
    harmonics: int | None = None,
) -> AmplitudeTrack:
    """Estimate the amplitude of a harmonic against time, by global harmonic least squares.

    Parameters
    ----------
    x : array of float, shape (N,)
        Real samples, evenly spaced.
    rate : float
        Samples per time unit.
    harmonic : int
        Which one, 1 the fundamental.
    band : (float, float), optional
        Where the fundamental is looked for, rad per time unit.
    start : float
        Time of the first sample.
    harmonics : int, optional
        The highest multiple that is fitted; by default those that the data show.

    Returns
    -------
    AmplitudeTrack
        The size of that harmonic, a(t) in x = a cos phi + ..., in the unit of ``x``: for the fundamental not the
        turning point.  With deviation, bias and interval; none of it where noise alone explains the signal.

    Raises
    ------
    InputError
        For a signal that no model of the whole fits, and for a harmonic that the data do not show.

    Examples
    --------
    >>> t = np.arange(640) / 32.0
    >>> x = np.exp(-0.05 * t) * (np.cos(7.0 * t) + 0.1 * np.cos(21.0 * t))
    >>> third = estimate_amplitude(x, 32.0, harmonic=3)
    >>> third.definition, bool(np.abs(third.amplitude / (0.1 * np.exp(-0.05 * t)) - 1.0).max() < 1e-4)
    ('harmonic 3', True)
    """
    samples = checked(x, rate, start=start, what="estimate_amplitude", at_least=FEWEST_SAMPLES)
    return amplitude_of(prepared(samples, Options(band=band, harmonics=harmonics)), harmonic)


# The models on more and on fewer knots are nested: var(fine - coarse) = var(fine) - var(coarse) for what noise does.
def amplitude_of(request: Request, multiple: int) -> AmplitudeTrack:
    """The amplitude of a harmonic in the best model; the difference from the finer one is its bias."""
    models = request.models
    best, fine, coarse = (sizes(model, multiple) for model in (models.best, models.fine, models.coarse))
    (a, moved), (a_fine, moved_fine), (a_coarse, moved_coarse) = best, fine, coarse
    width = max(1, request.signal.x.size // 8)
    deviation, apart = (pooled(errors, np.ones(a.size), width) for errors in (moved, moved_fine - moved))
    noise = pooled(moved_fine - moved_coarse, np.ones(a.size), width)
    left = moving_mean((a_fine - a_coarse) ** 2 - noise**2, 2 * request.half + 1)
    used = replace(
        request.used,
        multiple=multiple,
        noise=models.best.noise,
        harmonics=(1, *models.best.multiples),
        cycles_per_knot=models.best.cycles,
    )
    how = {"bias_by": "a model with more knots", "deviation_by": f"{REPLICATES} noisy copies of the model"}
    return AmplitudeTrack(
        time=request.signal.time,
        amplitude=a,
        valid=np.ones(a.size, dtype=np.bool_),
        method="harmonic-least-squares",
        standard_deviation=deviation,
        bias=a - a_fine,
        bias_deviation=np.sqrt(apart**2 + models.remainder**2 * left),
        used=used,
        details=request.details(**how, seed=SEED),
    ).held_against(request.presence)


def sizes(model: SplineModel, multiple: int) -> tuple[Array, Array]:
    """The amplitude in a model, and its changes in replicated noise, the same noise for every model."""
    amplitude = model.tone(multiple)[1]
    rng = np.random.default_rng(SEED)
    changes = np.empty((REPLICATES, amplitude.size))
    for i in range(REPLICATES):
        noise = model.band_noise * rng.normal(size=amplitude.size)
        changes[i] = model.tone(multiple, model.response(noise)[0])[1] - amplitude
    return amplitude, changes
