"""Integrated solutions with located crossings and turning points (scipy's embedded and multistep methods)."""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import BDF, DOP853, LSODA, RK45, OdeSolution, Radau

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, silent
from ridgeback.numeric.arrays import Array, frozen, frozen_mask
from ridgeback.numeric.motion.dynamics import Dynamics, well
from ridgeback.numeric.motion.events import CrossingEvents, TurningEvents
from ridgeback.numeric.motion.request import EVALUATIONS_PER_CYCLE, MAX_EVALUATIONS, check_inside, check_request
from ridgeback.numeric.motion.roots import bracketed_newton
from ridgeback.numeric.motion.shown import ShownTrajectory

Interpolant = Callable[[Array], tuple[Array, Array]]

_SOLVERS: dict[str, Any] = {"DOP853": DOP853, "RK45": RK45, "Radau": Radau, "BDF": BDF, "LSODA": LSODA}
AUTO = "auto"
"""DOP853, or Radau where the first steps show that the equation is stiff."""
METHODS = (AUTO, *_SOLVERS)
STIFF = 100_000
"""Evaluations beyond twenty times those of as many cycles by which an equation counts as stiff."""
TOLD = 64
"""Steps between two words of progress."""
PILOT = 400
"""Steps after which the number of all is predicted."""
RECENT = 100
"""Steps by whose mean length it is."""
MEMORY_BUDGET = 1_000_000_000
"""Bytes that the steps of a solution may take."""
_BYTES_PER_STEP = 1_000  # of DOP853 with its dense output
_SUBDIVISIONS = 4  # of each step, when looking for sign changes


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
        return _Integration(dynamics, method, rtol, tolerance, progress=progress).run(state, duration, rate)
    usual = EVALUATIONS_PER_CYCLE * duration * k / (2 * math.pi)
    for chosen, most in (("DOP853", min(STIFF + 20.0 * usual, MAX_EVALUATIONS)), ("Radau", MAX_EVALUATIONS)):
        with suppress(TooManyStepsError):
            return _Integration(dynamics, chosen, rtol, tolerance, most, progress).run(state, duration, rate)
    return _Integration(dynamics, "DOP853", rtol, tolerance, progress=progress).run(state, duration, rate)


class TooManyStepsError(InputError):
    """The first steps show that the others would be too many."""


class _Integration:
    """One integration under way: counts evaluations and guards against escape."""

    def __init__(
        self,
        dynamics: Dynamics,
        method: str,
        rtol: float,
        atol: Array,
        most: float = MAX_EVALUATIONS,
        progress: Progress = silent,
    ) -> None:
        self.dynamics, self.method, self.rtol, self.atol, self.most = dynamics, method, rtol, atol, most
        self.progress = progress
        self.limits = well(dynamics)
        self.evaluations = 0

    def slope(self, _: float, y: Array) -> Any:
        """Right-hand side of the first-order system; NaN (a rejected step) where f overflows."""
        self.evaluations += 1
        if self.evaluations > MAX_EVALUATIONS:
            raise InputError(
                f"{self.dynamics.name}: more than {MAX_EVALUATIONS} evaluations by {self.method}; "
                "use method Radau if the equation is stiff, a shorter duration or a larger rtol"
            )
        u, v = float(y[0]), float(y[1])
        try:
            return v, -self.dynamics.force(u, v)
        except (OverflowError, ValueError, ZeroDivisionError):
            return v, math.nan

    def run(self, state: tuple[float, float], duration: float, rate: float) -> Trajectory:
        with np.errstate(all="ignore"):
            steps, states, dense = self.solve(np.array(state), duration)
            crossings, turnings = self.events(steps, states, dense)
        time = np.minimum(sample_times(duration, rate), duration)
        u, velocity = dense(time)
        return Trajectory(
            name=self.dynamics.name,
            time=frozen(time),
            u=frozen(u),
            velocity=frozen(velocity),
            rate=float(rate),
            duration=float(duration),
            crossings=crossings,
            turnings=turnings,
            method=self.method,
            rtol=self.rtol,
            evaluations=self.evaluations,
            steps=frozen(steps),
            interpolant=dense,
        )

    def solve(self, state: Array, duration: float) -> tuple[Array, Array, Interpolant]:
        """All steps from t = 0 to the end: their times, their states ``[step, 2]`` and the dense output."""
        solver = _SOLVERS[self.method](self.slope, 0.0, state, duration, rtol=self.rtol, atol=self.atol)
        times, states, pieces = [0.0], [state], []
        bound = 1e6 * max(1.0, float(np.abs(state).max()))
        while solver.status == "running":
            message = solver.step()
            self.guard(solver, message, bound)
            if len(times) % TOLD == 0:
                self.progress(float(solver.t) / duration, f"integrating by {self.method}")
            if len(times) % PILOT == 0:
                self.refuse_too_much(len(times), float(solver.t), float(solver.t) - times[-RECENT], duration)
            times.append(float(solver.t))
            states.append(np.array(solver.y))
            pieces.append(solver.dense_output())
        solution = OdeSolution(times, pieces)

        def dense(t: Array) -> tuple[Array, Array]:
            u, v = solution(t)
            return u, v

        return np.array(times), np.array(states), dense

    def refuse_too_much(self, steps: int, t: float, recent: float, duration: float) -> None:
        """Refuse what the last steps show to take too many evaluations or too much memory."""
        coming = RECENT * (duration - t) / recent if recent > 0.0 else math.inf
        evaluations, size = self.evaluations * (1.0 + coming / steps), (steps + coming) * _BYTES_PER_STEP
        if evaluations <= self.most and size <= MEMORY_BUDGET:
            return
        advice = (
            "a shorter duration or a larger rtol"
            if self.method == "Radau"
            else ("method Radau if the equation is stiff, a shorter duration or a larger rtol")
        )
        raise TooManyStepsError(
            f"{self.dynamics.name}: {self.method} is at t = {t:.4g} after {steps} steps, and would take about "
            f"{evaluations:.2g} evaluations and {size / 1e9:.2g} GB, over {self.most:.2g} and "
            f"{MEMORY_BUDGET / 1e9:.2g} GB; use {advice}"
        )

    def guard(self, solver: Any, message: str | None, bound: float) -> None:
        name, t, u = self.dynamics.name, float(solver.t), float(solver.y[0])
        if solver.status == "failed":
            raise InputError(
                f"{name}: {self.method} stops at t = {t:.6g}, u = {u:.6g} ({message}): the solution probably "
                "grows without bound; start with less energy, or use method Radau if the equation is stiff"
            )
        check_inside(self.dynamics, u, t, self.limits)
        if not abs(u) < bound:
            raise InputError(f"{name}: u = {u:.3g} at t = {t:.6g} grows beyond {bound:.3g}; start with less energy")

    def events(self, steps: Array, states: Array, dense: Interpolant) -> tuple[CrossingEvents, TurningEvents]:
        times, points = self.locate(0, steps, states, dense)
        turning_times, turning_points = self.locate(1, steps, states, dense)
        return (
            CrossingEvents(frozen(times), frozen_mask(points[:, 1] > 0), frozen(points[:, 1])),
            TurningEvents(frozen(turning_times), frozen(turning_points[:, 0])),
        )

    def locate(self, part: int, steps: Array, states: Array, dense: Interpolant) -> tuple[Array, Array]:
        """Zeros of u (part 0) or u' (part 1) on the dense output, with the states there.

        At rtol 1e-12 a step of DOP853 re-integrated up to the event moves it by less than 1e-12 of the paper's
        seconds, a hundredth of the solution's own error, so that the interpolant is good enough.
        """

        def value_and_slope(t: Array) -> tuple[Array, Array]:
            u, v = dense(t)
            return (u, v) if part == 0 else (v, self.accelerations(u, v))

        fine = np.unique(np.linspace(steps[:-1], steps[1:], _SUBDIVISIONS + 1))
        values = value_and_slope(fine)[0]
        values[0] = states[0, part]
        after = np.flatnonzero((values[:-1] * values[1:] < 0) | (values[1:] == 0)) + 1
        times = bracketed_newton(value_and_slope, fine[after - 1], fine[after])
        points = np.column_stack(dense(times)) if times.size else np.zeros((0, 2))
        if values[0] == 0:
            times, points = np.append(0.0, times), np.vstack((states[0], points))
        return times, points

    def accelerations(self, u: Array, v: Array) -> Array:
        return np.array([-self.dynamics.force(a, b) for a, b in zip(u.tolist(), v.tolist(), strict=True)])


def sample_times(duration: float, rate: float) -> Array:
    """Return the times 0, 1/rate, 2/rate, ... that do not exceed ``duration``.

    >>> sample_times(1.0, 4.0)
    array([0.  , 0.25, 0.5 , 0.75, 1.  ])
    """
    count = math.floor(duration * rate * (1 + 1e-14)) + 1
    return np.arange(count) / rate
