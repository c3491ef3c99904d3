"""One integration by SciPy's steps: located events, switches of a force with kinks, rest by dry friction.

A force with kinks at places in u or at u' = 0 is integrated from kink to kink: between them it is smooth, the time at
which the motion passes to another stretch is located on the dense output, and the solver starts anew there.  Where u'
vanishes and the force pulls back on both sides, dry friction holds the motion: it stays at rest (A. F. Filippov,
Differential Equations with Discontinuous Righthand Sides, 1988, section 4).
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from scipy.integrate import BDF, DOP853, LSODA, RK45, OdeSolution, Radau
from scipy.optimize import brentq

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, silent
from ridgeback.numeric.arrays import Array, frozen, frozen_mask
from ridgeback.numeric.motion.dynamics import Dynamics, well
from ridgeback.numeric.motion.events import CrossingEvents, Switches, TurningEvents
from ridgeback.numeric.motion.request import MAX_EVALUATIONS, check_inside
from ridgeback.numeric.motion.roots import bracketed_newton

Interpolant = Callable[[Array], tuple[Array, Array]]

SOLVERS: dict[str, Any] = {"DOP853": DOP853, "RK45": RK45, "Radau": Radau, "BDF": BDF, "LSODA": LSODA}
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


@dataclass(frozen=True)
class Drift:
    """A force whose parameters change with time.

    Parameters
    ----------
    force : callable
        (t, u, u') to f, on plain floats.
    changing : callable
        (t, u) to dV/dt at fixed u, of arrays of u, where there is a potential.
    frozen : callable
        A time to the oscillator with the parameters of that time.
    linear : bool
        Whether u' enters as 2 mu(t) u' or not at all, so that the action decays by the integral of mu alone.
    text : str
        What drifts how, for messages.
    """

    force: Callable[[float, float, float], float]
    changing: Callable[[float, Array], Array]
    frozen: Callable[[float], Dynamics]
    linear: bool
    text: str


@dataclass(frozen=True)
class Solution:
    """All that an integration finds; ``rest_from`` is when friction holds the motion, None where it goes on."""

    steps: Array
    dense: Interpolant
    crossings: CrossingEvents
    turnings: TurningEvents
    evaluations: int
    rest_from: float | None


class TooManyStepsError(InputError):
    """The first steps show that the others would be too many."""


def stepped(solver: Any) -> str | None:
    """One step: SciPy's message when it fails, which an implicit solver does not give where its Jacobian overflows."""
    try:
        return str(message) if (message := solver.step()) else None
    except InputError:
        raise
    except (ValueError, ArithmeticError, np.linalg.LinAlgError):
        solver.status = "failed"
        return "the derivatives of the force are no finite numbers"


class Integration:
    """One integration under way: counts evaluations and guards against escape."""

    def __init__(
        self,
        dynamics: Dynamics,
        method: str,
        rtol: float,
        atol: Array,
        most: float = MAX_EVALUATIONS,
        progress: Progress = silent,
        drift: Drift | None = None,
    ) -> None:
        self.drift = drift
        self.dynamics, self.method, self.rtol, self.atol, self.most = dynamics, method, rtol, atol, most
        self.progress = progress
        self.limits = well(dynamics)
        self.evaluations = 0
        self.switches = dynamics.switches
        self.stretch, self.side_v = 0, 1

    def slope(self, t: float, y: Array) -> Any:
        """Right-hand side of the first-order system; NaN (a rejected step) where f overflows."""
        self.evaluations += 1
        if self.evaluations > MAX_EVALUATIONS:
            raise InputError(
                f"{self.dynamics.name}: more than {MAX_EVALUATIONS} evaluations by {self.method}; "
                "use method Radau if the equation is stiff, a shorter duration or a larger rtol"
            )
        u, v = float(y[0]), float(y[1])
        try:
            return v, -(self.force(u, v) if self.drift is None else self.drift.force(t, u, v))
        except (OverflowError, ValueError, ZeroDivisionError):
            return v, math.nan

    def force(self, u: float, v: float) -> float:
        """f on the present sides of its kinks."""
        return self.on_side(self.side_v)(u, v)

    def on_side(self, side_v: int) -> Callable[[float, float], float]:
        """f on the present stretch of u and a side of u'."""
        return self.dynamics.force if self.switches is None else self.switches.force(self.stretch, side_v)

    def run(self, state: tuple[float, float], duration: float) -> Solution:
        """The whole motion and its events."""
        with np.errstate(all="ignore"), warnings.catch_warnings():
            warnings.filterwarnings("ignore", "lsoda:", UserWarning)  # a failed step is said in our words
            steps, states, dense, rest = self.solve(np.array(state), duration)
            moving = steps.size if rest is None else int(np.searchsorted(steps, rest, side="right"))
            crossings, turnings = self.events(steps[:moving], states[:moving], dense)
        return Solution(steps, dense, crossings, turnings, self.evaluations, rest)

    def solve(self, state: Array, duration: float) -> tuple[Array, Array, Interpolant, float | None]:
        """All steps from t = 0 to the end: times, states ``[step, 2]``, dense output, and when it comes to rest."""
        self.begin(state)
        solver = self.solver(0.0, state, duration)
        times, states, pieces = [0.0], [state], []
        rest: float | None = None
        bound = 1e6 * max(1.0, float(np.abs(state).max()))
        while solver.status == "running":
            message = stepped(solver)
            self.guard(solver, message, bound)
            if len(times) % TOLD == 0:
                self.progress(float(solver.t) / duration, f"integrating by {self.method}")
                self.limits = self.limits if self.drift is None else well(self.drift.frozen(float(solver.t)))
            if len(times) % PILOT == 0:
                self.refuse_too_much(len(times), float(solver.t), float(solver.t) - times[-RECENT], duration)
            pieces.append(solver.dense_output())
            reached, y, switched = self.switched(times[-1], float(solver.t), np.array(solver.y), pieces[-1])
            times.append(reached)
            states.append(y)
            if switched and self.sticks(y):
                rest = reached
                if reached < duration:
                    times.append(duration)
                    states.append(y)
                    pieces.append(lambda t, still=y: np.multiply.outer(still, np.ones_like(t)))
                break
            if switched and reached < duration:
                solver = self.solver(reached, y, duration)
            elif switched:
                break
        solution = OdeSolution(times, pieces)

        def dense(t: Array) -> tuple[Array, Array]:
            u, v = solution(t)
            return u, v

        return np.array(times), np.array(states), dense, rest

    def solver(self, time: float, state: Array, duration: float) -> Any:
        """SciPy's solver from a state on."""
        return SOLVERS[self.method](self.slope, time, state, duration, rtol=self.rtol, atol=self.atol)

    def begin(self, state: Array) -> None:
        """Choose the stretch and the side on which the motion begins; raises InputError where friction holds it."""
        if self.switches is None:
            return
        u, v = float(state[0]), float(state[1])
        self.stretch = self.switches.stretch(u, v)
        side = self.side_of_motion(state) if v == 0 else (1 if v > 0 else -1)
        if side is None:
            raise InputError(
                f"{self.dynamics.name}: friction holds (u, u') = ({u:g}, 0) at rest, where it stays; start further out"
            )
        self.side_v = side

    def side_of_motion(self, state: Array) -> int | None:
        """Which way a motion at u' = 0 goes on; None where neither way: it sticks."""
        u, force = float(state[0]), self.on_side
        ways = [side for side in (-1, 1) if -side * force(side)(u, 0.0) > 0]
        return ways[0] if ways else None

    def sticks(self, state: Array) -> bool:
        """Whether the motion ends in the state that a switch was found at; else the laws are those behind it."""
        if self.switches is not None and float(state[0]) in self.switches.places:
            self.stretch = self.switches.stretch(float(state[0]), float(state[1]))
        if state[1] != 0:
            return False
        side = self.side_of_motion(state)
        self.side_v = self.side_v if side is None else side
        return side is None

    def switched(self, start: float, end: float, y: Array, piece: Any) -> tuple[float, Array, bool]:
        """The end of a step, or the first time in it at which u or u' passes a kink."""
        if self.switches is None:
            return end, y, False
        grid = np.linspace(start, end, _SUBDIVISIONS + 1)
        values = np.asarray(piece(grid))
        found: list[tuple[float, int, float]] = []
        for part, place, side in self.bounds():
            ahead = side * (values[part] - place)
            behind = np.flatnonzero(ahead[1:] < 0) + 1
            if behind.size and ahead[behind[0] - 1] >= 0:
                low, high = grid[behind[0] - 1], grid[behind[0]]
                found.append((self.crossed(piece, part, place, float(low), float(high)), part, place))
        if not found:
            return end, y, False
        time, part, place = min(found)
        state = np.asarray(piece(time), dtype=float)
        state[part] = place
        return time, state, True

    def bounds(self) -> list[tuple[int, float, int]]:
        """What bounds the present laws: the part of the state, its value at the kink, and the side that it is on."""
        switches = cast(Switches, self.switches)
        places = switches.places
        below = [(0, places[self.stretch - 1], 1)] if self.stretch > 0 else []
        above = [(0, places[self.stretch], -1)] if self.stretch < len(places) else []
        return below + above + ([(1, 0.0, self.side_v)] if switches.in_velocity else [])

    @staticmethod
    def crossed(piece: Any, part: int, place: float, low: float, high: float) -> float:
        """When a part of the state passes a kink on the dense output, to rounding."""
        if piece(low)[part] == place:
            return low
        return float(brentq(lambda t: float(piece(t)[part]) - place, low, high, xtol=4 * np.spacing(high), rtol=1e-15))

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
        if not math.isfinite(u):
            raise InputError(f"{name}: {self.method} leaves the doubles before t = {t:.6g}; start with less energy")
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
            return (u, v) if part == 0 else (v, self.accelerations(t, u, v))

        fine = np.unique(np.linspace(steps[:-1], steps[1:], _SUBDIVISIONS + 1))
        values = value_and_slope(fine)[0]
        values[0] = states[0, part]
        after = np.flatnonzero((values[:-1] * values[1:] < 0) | (values[1:] == 0)) + 1
        times = bracketed_newton(value_and_slope, fine[after - 1], fine[after])
        points = np.column_stack(dense(times)) if times.size else np.zeros((0, 2))
        if values[0] == 0:
            times, points = np.append(0.0, times), np.vstack((states[0], points))
        return times, points

    def accelerations(self, t: Array, u: Array, v: Array) -> Array:
        if self.drift is not None:
            states = zip(t.tolist(), u.tolist(), v.tolist(), strict=True)
            return np.array([-self.drift.force(*state) for state in states])
        return np.array([-self.dynamics.force(a, b) for a, b in zip(u.tolist(), v.tolist(), strict=True)])
