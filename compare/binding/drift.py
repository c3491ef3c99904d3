"""Bind an oscillator with laws in time to numbers: f(t, u, u'), and the oscillator frozen at any time."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import sympy
from numpy.typing import ArrayLike

from ridgeback.common.errors import InputError
from ridgeback.compare.binding.bind import bind
from ridgeback.compare.binding.closures import ARRAY, SCALAR
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.numeric.motion.integration import Drift
from ridgeback.symbolic.arithmetic.closures import Evaluator, evaluator
from ridgeback.symbolic.flow.drift import Drifting, T
from ridgeback.symbolic.systems.oscillator import U, V

CHECKED = 4097
"""Times over the duration at which the stiffness is seen to stay positive."""


def bind_drift(own: Drifting, duration: float) -> tuple[Dynamics, Drift]:
    """Turn an oscillator with laws in time into the functions that the numeric side works with.

    Parameters
    ----------
    own : Drifting
        The oscillator and its laws.
    duration : float
        Time over which it must go on oscillating.

    Returns
    -------
    tuple of Dynamics and Drift
        The oscillator of time 0, and how it changes.

    Raises
    ------
    InputError
        For a parameter without a number, and where k^2 does not stay positive and finite over the duration.

    Examples
    --------
    >>> from ridgeback.symbolic.flow.drift import drifting
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> _, drift = bind_drift(drifting(find("linear"), {"k": "1 + t/100"}), 50.0)
    >>> drift.frozen(50.0).natural_frequency, drift.force(50.0, 1.0, 0.0)
    (1.5, 2.25)
    """
    start = bind(own.start)
    stiffness = evaluator(own.stiffness, (T,), SCALAR)
    _check_stiffness(own, stiffness, duration)
    force = evaluator(own.force, (T, U, V), SCALAR)
    rate = sympy.diff(own.force, V)
    damping = evaluator(rate.subs({U: 0, V: 0}) / 2, (T,), SCALAR)
    potential = None if start.potential is None or own.potential is None else _over(own.potential)
    restoring = None if potential is None else _over(sympy.diff(own.potential, U))
    changing = None if potential is None else _over(sympy.diff(own.potential, T))

    def frozen(time: float) -> Dynamics:
        return Dynamics(
            name=start.name,
            force=lambda u, v: float(force((time, u, v))),
            natural_frequency=math.sqrt(stiffness((time,))),
            damping=float(damping((time,))),
            potential=None if potential is None else lambda u: potential(time, u),
            restoring=None if restoring is None else lambda u: restoring(time, u),
        )

    return start, Drift(
        force=lambda t, u, v: float(force((t, u, v))),
        changing=lambda t, u: np.zeros_like(u) if changing is None else changing(t, u),
        frozen=frozen,
        linear=not rate.has(U, V),
        text=own.text,
    )


def _over(expression: sympy.Expr) -> Callable[[float, ArrayLike], Array]:
    """A function of a time and an array of u."""
    function = evaluator(expression, (T, U), ARRAY)

    def values(time: float, u: ArrayLike) -> Array:
        points = np.asarray(u, dtype=np.float64)
        return np.asarray(function((time, points)) + np.zeros_like(points), dtype=np.float64)

    return values


def _check_stiffness(own: Drifting, stiffness: Evaluator, duration: float) -> None:
    """Refuse laws under which the rest at u = 0 stops pulling back."""
    times = np.linspace(0.0, duration, CHECKED).tolist() if math.isfinite(duration) else [0.0]
    last, before = 0.0, math.inf
    for time in times:
        try:
            value = float(stiffness((time,)))
        except (ArithmeticError, ValueError):
            value = math.nan
        # What changes by as much as there is from one of so many times to the next passes zero or a pole between.
        jumps = before < math.inf and abs(value - before) >= min(value, before)
        if jumps or not (math.isfinite(value) and value > 0):
            raise InputError(
                f"{own.start.name}: with {own.text} the force stops restoring by t = {time:.4g}, where k^2 passes "
                f"through zero or a pole; use a duration below {last:.4g} or another drift"
            )
        last, before = time, value
