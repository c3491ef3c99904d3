"""The frequency of a fitted oscillator: omega0(t) of its solution, with what the fit knows of it.

omega(t) is read off the located events of the fitted solution (``motion.cycle_frequency``), the same definition as the
reference of a simulation.  Its deviation is propagated from the covariance of the fit: an event at time t_i moves by

    d t_i = -S_u(t_i) / u'(t_i)  (crossing, u = 0),        d t_i = S_v(t_i) / f(u, 0)  (turning point, u' = 0),

S being the sensitivities, and omega(t) follows the events.  What events of different kinds disagree by is how well
omega0(t) of a damped motion is defined at all; it counts as the unknown part of the bias.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicHermiteSpline

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.model_fit.fit import ModelFit
from ridgeback.numeric.model_fit.sensitivity import respond
from ridgeback.numeric.motion.cycle_frequency import cycle_frequency
from ridgeback.numeric.motion.events import CrossingEvents, TurningEvents
from ridgeback.numeric.motion.trajectory import Trajectory, integrate
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.tracking.choices import Choices
from ridgeback.numeric.tracking.track import Misfit, Track

SHIFT = 1e-5
"""Share of a cycle by which events are moved to differentiate omega by their times."""


def model_track(fit: ModelFit) -> Track:
    """Return the frequency of the fitted solution at the samples.

    Parameters
    ----------
    fit : ModelFit
        The fit.

    Returns
    -------
    Track
        Frequency in rad per time unit with the deviation that the fit's covariance gives it.  A fit that is called a
        misfit claims no bias and no interval.

    Raises
    ------
    InputError
        Where the fitted motion leaves the potential well or has too few cycles.

    Examples
    --------
    >>> from ridgeback.numeric.motion.dynamics import linear
    >>> from ridgeback.numeric.model_fit.family import Family
    >>> from ridgeback.numeric.model_fit.fit import model_fit
    >>> family = Family("linear", ("k",), np.array([5.0]), lambda u, v, p: p[0] ** 2 * u,
    ...     lambda u, v, p: p[0] ** 2 * u, lambda u, v, p: (p[0] ** 2, 0.0, 2 * p[0] * u), lambda p: linear(p[0]))
    >>> t = np.arange(400) / 20.0
    >>> x = np.cos(7.0 * t) + 0.01 * np.random.default_rng(1).standard_normal(400)
    >>> fit = model_fit(x, 20.0, family)
    >>> track = model_track(fit)
    >>> bool(np.allclose(track.omega, fit.parameters["k"], rtol=1e-9)), bool(track.valid.all())
    (True, True)
    >>> bool(np.allclose(track.standard_deviation, fit.deviations[3], rtol=1e-2))
    True
    """
    dynamics, size = fit.dynamics, fit.residual.size
    run = integrate(dynamics, fit.initial, duration=(size - 1) / fit.rate, rate=fit.rate)
    cycle = cycle_frequency(run, dynamics=dynamics)
    time = np.minimum(np.arange(size) / fit.rate, run.duration)
    omega = cycle.at(time)
    valid = np.isfinite(omega)
    slopes = omega_slopes(fit, run, time)
    variance = np.einsum("nj,jk,nk->n", slopes, fit.covariance, slopes)
    return Track(
        time=fit.start + time,
        omega=continued(time, omega),
        valid=valid,
        method="model-fit",
        standard_deviation=np.sqrt(np.maximum(variance, 0.0)),
        bias=None if fit.misfit else np.zeros(size),
        bias_deviation=None if fit.misfit else continued(time, cycle.uncertainty_at(time)),
        used=Choices(start=fit.start, noise=fit.noise),
        details=details_of(fit),
        misfit=misfit_of(fit),
    )


def details_of(fit: ModelFit) -> dict[str, object]:
    """What the track reports of its fit."""
    fitted = {str(row["parameter"]): row["value"] for row in fit.rows()}
    deviations = {f"{row['parameter']}_sd": row["standard_deviation"] for row in fit.rows()}
    return {
        "oscillator": fit.family.name,
        **fitted,
        **deviations,
        "residual_white": "unknown" if fit.white is None else not fit.misfit,
        "residual_probability": None if fit.white is None else fit.white.probability,
        "rate": fit.rate,
    }


def misfit_of(fit: ModelFit) -> Misfit | None:
    """That the equation did not make the samples, where the residual says so."""
    return Misfit(fit.family.name, fit.white.probability) if fit.misfit and fit.white is not None else None


def omega_slopes(fit: ModelFit, run: Trajectory, time: Array) -> Array:
    """Derivatives of omega(t) by each entry of theta, ``[time, entry]``; that by the offset is 0."""
    crossing, turning = event_slopes(fit, run)
    dynamics, cycle = fit.dynamics, TWO_PI * run.crossings.time.size / max(run.duration, 1e-300)
    slopes = np.zeros((time.size, fit.theta.size))
    for j, entry in enumerate(entries(fit)):
        largest = max(np.abs(crossing[:, j]).max(initial=0.0), np.abs(turning[:, j]).max(initial=0.0))
        if not largest > 0.0:
            continue
        step = SHIFT * TWO_PI / (cycle * largest)
        both = [
            cycle_frequency(moved(run, s * crossing[:, j], s * turning[:, j]), dynamics=dynamics).at(time)
            for s in (step, -step)
        ]
        slopes[:, entry] = continued(time, (both[0] - both[1]) / (2.0 * step))
    return slopes


def continued(time: Array, values: Array) -> Array:
    """Hold the nearest value where events, moved, leave the ends uncovered.

    >>> continued(np.arange(4.0), np.array([np.nan, 1.0, 2.0, np.nan])).tolist()
    [1.0, 1.0, 2.0, 2.0]
    """
    known = np.isfinite(values)
    return np.interp(time, time[known], values[known]) if known.any() else np.zeros_like(values)


def entries(fit: ModelFit) -> NDArray[np.intp]:
    """Places in theta of u0, v0 and the parameters."""
    return np.array([i for i in range(fit.theta.size) if i != 2])


def event_slopes(fit: ModelFit, run: Trajectory) -> tuple[Array, Array]:
    """Derivatives of the times of crossings and turning points by u0, v0 and the parameters, ``[event, entry]``."""
    sampled = respond(
        fit.family,
        fit.theta[3:].tolist(),
        fit.initial,
        samples=run.time.size,
        rate=fit.rate,
        steps=fit.steps,
        bound=np.inf,
    )
    force = fit.dynamics.force
    pull = np.array([force(u, 0.0) for u in run.turnings.value.tolist()])
    by_u = CubicHermiteSpline(run.time, sampled.u_by, sampled.v_by)(run.crossings.time)
    by_v = CubicHermiteSpline(run.time, sampled.u_by, sampled.v_by).derivative()(run.turnings.time)
    return -by_u / run.crossings.velocity[:, None], by_v / pull[:, None]


def moved(run: Trajectory, crossing: Array, turning: Array) -> Trajectory:
    """The trajectory with its events moved in time."""
    crossings, turnings = run.crossings, run.turnings
    return replace(
        run,
        crossings=CrossingEvents(crossings.time + crossing, crossings.rising, crossings.velocity),
        turnings=TurningEvents(turnings.time + turning, turnings.value),
    )
