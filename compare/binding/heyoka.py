"""A third, independent integrator where it is installed: heyoka's adaptive Taylor method with its own event location.

F. Biscani and D. Izzo, Revisiting high-order Taylor methods for astrodynamics and celestial mechanics, Monthly Notices
of the Royal Astronomical Society 504 (2021) 2614-2628.  Nothing of SciPy's or of our own integrators is in it, not even
the derivatives of the force, which heyoka forms from the equation itself.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

import numpy as np
import sympy

from ridgeback.common.errors import InputError
from ridgeback.compare.binding.bind import bind
from ridgeback.numeric.arrays import Array, frozen, frozen_mask
from ridgeback.numeric.motion.dynamics import Dynamics, well
from ridgeback.numeric.motion.events import CrossingEvents, TurningEvents
from ridgeback.numeric.motion.request import check_inside, check_request
from ridgeback.numeric.motion.trajectory import Trajectory, sample_times
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.oscillator import Oscillator, U, V

TOLERANCE = 1e-16
"""heyoka's tolerance for the truncation error of a step, relative: below the rounding of a double."""


def heyoka() -> Any:
    """The library; OSError, which is a matter of the environment, where it is not installed."""
    try:
        return import_module("heyoka")
    except ImportError:
        raise OSError("method heyoka needs the library heyoka, which is missing; pip install heyoka") from None


def integrate_heyoka(
    oscillator: OscillatorLike, initial: tuple[float, float], *, duration: float, rate: float
) -> Trajectory:
    """Solve the oscillator's equation from ``initial = (u, u')`` over ``0 .. duration``, sampled at ``rate``.

    Raises OSError without the library, and InputError as ``trajectory.integrate`` does and for a function that
    heyoka does not know.
    """
    oscillator = as_oscillator(oscillator)
    library, dynamics = heyoka(), bind(oscillator)
    state = check_request(dynamics, initial, duration=duration, rate=rate)
    u, v = library.make_vars("u", "v")
    force = translated(library, oscillator, {U: u, V: v})
    found: dict[str, list[float]] = {"crossing": [], "turning": []}
    events = [library.nt_event(e, _noting(found[name])) for name, e in (("crossing", u), ("turning", v))]
    solver = library.taylor_adaptive([(u, v), (v, -force)], list(state), nt_events=events, tol=TOLERANCE)
    outcome, _, _, steps, dense, *_ = solver.propagate_until(duration, c_output=True)
    if outcome != library.taylor_outcome.time_limit or dense is None:
        raise InputError(
            f"{oscillator.name}: heyoka stops at t = {solver.time:.6g} ({outcome}); start with less energy"
        )

    def interpolant(times: Array) -> tuple[Array, Array]:
        values = np.array(dense(np.asarray(times, dtype=np.float64)))
        return values[:, 0], values[:, 1]

    time = np.minimum(sample_times(duration, rate), duration)
    positions, velocities = interpolant(time)
    _check_inside(dynamics, time, positions)
    crossings, turnings = (with_start(found[n], state[i] == 0.0) for i, n in enumerate(("crossing", "turning")))
    speed = interpolant(crossings)[1]
    return Trajectory(
        name=dynamics.name,
        time=frozen(time),
        u=frozen(positions),
        velocity=frozen(velocities),
        rate=float(rate),
        duration=float(duration),
        crossings=CrossingEvents(frozen(crossings), frozen_mask(speed > 0), frozen(speed)),
        turnings=TurningEvents(frozen(turnings), frozen(interpolant(turnings)[0])),
        method=f"heyoka {library.__version__}",
        rtol=TOLERANCE,
        evaluations=int(steps),
        steps=frozen(np.asarray(dense.times, dtype=np.float64)),
        interpolant=interpolant,
    )


def _check_inside(dynamics: Dynamics, time: Array, positions: Array) -> None:
    left, right = well(dynamics)
    outside = np.flatnonzero((positions <= left) | (positions >= right))
    if outside.size:
        check_inside(dynamics, float(positions[outside[0]]), float(time[outside[0]]), (left, right))


def translated(library: Any, oscillator: Oscillator, variables: dict[sympy.Symbol, Any]) -> Any:
    """The force in heyoka's own expressions, every constant rounded once."""
    force = oscillator.substituted_force
    numbers = {a: sympy.Float(a, 20) for a in force.atoms(sympy.Number, sympy.NumberSymbol) if not a.is_Integer}
    try:
        return library.from_sympy(force.xreplace(numbers), variables)
    except (TypeError, ValueError) as reason:
        first = str(reason).splitlines()[0]
        raise InputError(
            f"{oscillator.name}: heyoka does not take this force ({first}); use DOP853 or taylor"
        ) from None


def _noting(times: list[float]) -> Any:
    def note(_: object, time: float, __: int) -> None:
        times.append(time)

    return note


def with_start(times: list[float], at_start: bool) -> Array:
    """Event times in order, the start among them when the motion begins on the event.

    >>> with_start([2.0, 1.0], True).tolist()
    [0.0, 1.0, 2.0]
    """
    later = [time for time in sorted(times) if time > 0.0]
    return np.array([0.0, *later] if at_start else later)
