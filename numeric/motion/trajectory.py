"""Integrated solutions with located crossings and turning points (scipy's embedded and multistep methods)."""

from __future__ import annotations

import math
from contextlib import suppress
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, silent
from ridgeback.numeric.arrays import Array, frozen
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.numeric.motion.events import CrossingEvents, TurningEvents
from ridgeback.numeric.motion.integration import (
    SOLVERS,
    Drift,
    Integration,
    Interpolant,
    Solution,
    TooManyStepsError,
)
from ridgeback.numeric.motion.request import EVALUATIONS_PER_CYCLE, MAX_EVALUATIONS, check_request
from ridgeback.numeric.motion.shown import ShownTrajectory

AUTO = "auto"
"""DOP853, or Radau where the first steps show that the equation is stiff."""
METHODS = (AUTO, *SOLVERS)
STIFF = 100_000
"""Evaluations beyond twenty times those of as many cycles by which an equation counts as stiff."""


@dataclass(frozen=True, repr=False)
class Trajectory(ShownTrajectory):
    """A solution sampled from t = 0, with its events.

    Parameters
    ----------
    name : str
        The oscillator's.
    time, u, velocity : array of float, shape (N,)
        Sample times, and u and u' there.
    rate, duration : float
        Samples per time unit, and how long it was asked for.
    crossings : CrossingEvents
        Zero crossings of u.
    turnings : TurningEvents
        Turning points, u' = 0.
    method : str
        The solver.
    rtol : float
        Its relative tolerance.
    evaluations : int
        How often the force was evaluated.
    steps : array of float
        The integrator's own times, between which ``at`` is smooth.
    interpolant : callable
        u and u' at any times between.
    rest_from : float, optional
        When dry friction brings the motion to rest for good; None where it goes on.

    Examples
    --------
    >>> from ridgeback.numeric.motion.dynamics import pendulum
    >>> run = integrate(pendulum(), (1.0, 0.0), duration=10.0, rate=8.0)
    >>> run.u.shape, round(float(run.crossings.time[0]), 4)
    ((81,), 1.675)
    """

    name: str
    time: Array
    u: Array
    velocity: Array
    rate: float
    duration: float
    crossings: CrossingEvents
    turnings: TurningEvents
    method: str
    rtol: float
    evaluations: int
    steps: Array
    interpolant: Interpolant
    rest_from: float | None = None

    @property
    def initial(self) -> tuple[float, float]:
        """The state (u, u') at t = 0."""
        return float(self.u[0]), float(self.velocity[0])

    def at(self, times: ArrayLike) -> tuple[Array, Array]:
        """Return u and u' at any times within 0 and ``duration`` by dense output; InputError outside."""
        t = np.atleast_1d(np.asarray(times, dtype=float))
        if not np.all((t >= 0) & (t <= self.duration)):
            raise InputError(f"times must lie within 0 and {self.duration:g}, the span of the trajectory")
        return self.interpolant(t)


def integrate(
    dynamics: Dynamics,
    initial: tuple[float, float],
    *,
    duration: float,
    rate: float,
    method: str = AUTO,
    rtol: float = 1e-12,
    atol: float | None = None,
    progress: Progress = silent,
    drift: Drift | None = None,
) -> Trajectory:
    """Solve ``u'' + f(u, u') = 0`` from an initial state.

    Parameters
    ----------
    dynamics : Dynamics
        The oscillator with numbers.
    initial : (float, float)
        u and u' at t = 0.
    duration : float
        How long, in the oscillator's time unit.
    rate : float
        Samples per time unit.
    method : str
        One of METHODS; ``"auto"`` is DOP853, or Radau where DOP853's first steps show that it would take too many, as
        of a stiff equation.
    rtol : float
        Relative tolerance of the solver.
    atol : float, optional
        Absolute tolerance on u, by default ``rtol`` times the size of the initial state; that on u' is k times it.
    progress : callable
        Told the share of the time that is integrated.
    drift : Drift, optional
        How its force changes with time; ``dynamics`` is then the oscillator of time 0.

    Returns
    -------
    Trajectory
        Samples over 0 .. ``duration``, with located zero crossings and turning points.

    Raises
    ------
    InputError
        For a start at rest in an equilibrium, a motion that leaves the potential well (rotation, escape) or grows
        without bound, and for work or memory that the first few hundred steps show to be beyond the budget.

    Examples
    --------
    >>> from ridgeback.numeric.motion.dynamics import linear
    >>> run = integrate(linear(), (1.0, 0.0), duration=7.0, rate=10.0)
    >>> bool(abs(run.crossings.time[0] - np.pi / 2) < 1e-12), run.time.size
    (True, 71)
    """
    state = check_request(dynamics, initial, duration=duration, rate=rate)
    if method not in METHODS:
        raise InputError(f"unknown method {method!r}; use one of {', '.join(METHODS)}")
    if not 1e-13 <= rtol <= 1e-3:
        raise InputError(f"rtol = {rtol!r} is outside 1e-13 to 1e-3, where double precision can follow")
    k = dynamics.natural_frequency
    size = math.hypot(state[0], state[1] / k)
    absolute = rtol * size if atol is None else atol
    if not (math.isfinite(absolute) and absolute > 0):
        raise InputError(f"atol = {atol!r} must be finite and positive")
    tolerance = np.array([absolute, absolute * k])
    if method != AUTO:
        solution = Integration(dynamics, method, rtol, tolerance, progress=progress, drift=drift).run(state, duration)
        return _sampled(dynamics, solution, method, duration, rate, rtol)
    usual = EVALUATIONS_PER_CYCLE * duration * k / (2 * math.pi)
    for chosen, most in (("DOP853", min(STIFF + 20.0 * usual, MAX_EVALUATIONS)), ("Radau", MAX_EVALUATIONS)):
        with suppress(TooManyStepsError):
            solution = Integration(dynamics, chosen, rtol, tolerance, most, progress, drift).run(state, duration)
            return _sampled(dynamics, solution, chosen, duration, rate, rtol)
    solution = Integration(dynamics, "DOP853", rtol, tolerance, progress=progress, drift=drift).run(state, duration)
    return _sampled(dynamics, solution, "DOP853", duration, rate, rtol)


def _sampled(
    dynamics: Dynamics, solution: Solution, method: str, duration: float, rate: float, rtol: float
) -> Trajectory:
    time = np.minimum(sample_times(duration, rate), duration)
    u, velocity = solution.dense(time)
    return Trajectory(
        name=dynamics.name,
        time=frozen(time),
        u=frozen(u),
        velocity=frozen(velocity),
        rate=float(rate),
        duration=float(duration),
        crossings=solution.crossings,
        turnings=solution.turnings,
        method=method,
        rtol=rtol,
        evaluations=solution.evaluations,
        steps=frozen(solution.steps),
        interpolant=solution.dense,
        rest_from=solution.rest_from,
    )


def sample_times(duration: float, rate: float) -> Array:
    """Return the times 0, 1/rate, 2/rate, ... that do not exceed ``duration``.

    >>> sample_times(1.0, 4.0)
    array([0.  , 0.25, 0.5 , 0.75, 1.  ])
    """
    count = math.floor(duration * rate * (1 + 1e-14)) + 1
    return np.arange(count) / rate
