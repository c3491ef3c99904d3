"""An oscillator and its sensitivities, stepped from sample to sample by the Runge-Kutta method of Dormand and Prince.

Beside u'' = -f(u, u'; p) the variational equations are integrated (Hairer, Norsett and Wanner, Solving Ordinary
Differential Equations I, 1993, section I.14),

    S' = (S_u, S_v)' = (S_v, -f_u S_u - f_v S_v - f_p),       S = d(u, v) / d(u0, v0, p),

by the same method of order 8 with a fixed number of steps per sample, so that every sample is a step's end and the
result is a smooth function of the parameters, as a least-squares fit wants it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.integrate import DOP853

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.model_fit.family import Family, Scalars

MOST_STEPS = 64
"""Steps per sample; a rate that needs more is far below the oscillation's own."""


@dataclass(frozen=True)
class Response:
    """u and u' at the samples, and their sensitivities ``[sample, parameter]`` in the order u0, v0, p.

    ``length`` samples were reached; fewer than asked for when the solution left all bounds.
    """

    u: Array
    v: Array
    u_by: Array
    v_by: Array

    @property
    def length(self) -> int:
        """The number of samples reached."""
        return self.u.size


@lru_cache(maxsize=1)
def tableau() -> tuple[tuple[Array, ...], Array]:
    """Rows of A and the weights B of the method of order 8."""
    A = np.asarray(DOP853.A, dtype=np.float64)
    return tuple(A[i, :i].copy() for i in range(A.shape[0])), np.asarray(DOP853.B, dtype=np.float64)


def respond(
    family: Family, p: Scalars, state: tuple[float, float], *, samples: int, rate: float, steps: int, bound: float
) -> Response:
    """Integrate from ``state = (u0, v0)``, ``steps`` to each of ``samples - 1`` intervals, while |u| < ``bound``.

    >>> from ridgeback.numeric.motion.dynamics import linear
    >>> family = Family("linear", ("k",), np.array([2.0]), lambda u, v, p: p[0] ** 2 * u,
    ...     lambda u, v, p: p[0] ** 2 * u, lambda u, v, p: (p[0] ** 2, 0.0, 2 * p[0] * u), lambda p: linear(p[0]))
    >>> run = respond(family, (2.0,), (1.0, 0.0), samples=11, rate=10.0, steps=2, bound=10.0)
    >>> t = np.arange(11) / 10.0
    >>> bool(np.abs(run.u - np.cos(2 * t)).max() < 1e-10), bool(np.abs(run.u_by[:, 2] + t * np.sin(2 * t)).max() < 1e-9)
    (True, True)
    """
    size = 3 + len(family.names)
    y = np.zeros((2, size))
    y[:, 0] = state
    y[0, 1] = y[1, 2] = 1.0
    out = np.empty((samples, 2, size))
    out[0] = y
    stages = np.empty((len(tableau()[0]), 2 * size))
    with np.errstate(all="ignore"):  # a solution that escapes is stopped at the bound
        for n in range(1, samples):
            for _ in range(steps):
                y = _stepped(family, p, y, 1.0 / (rate * steps), stages)
                if not abs(y[0, 0]) < bound:
                    return _response(out[:n])
            out[n] = y
    return _response(out)


def _stepped(family: Family, p: Scalars, y: Array, h: float, stages: Array) -> Array:
    """One step of the solution and its sensitivities; NaN where f has no value on the way."""
    rows, weights = tableau()
    flat = y.reshape(-1)
    for i, row in enumerate(rows):
        point = y if i == 0 else (flat + h * (row @ stages[:i])).reshape(y.shape)
        if not _slope(family, p, point, stages[i].reshape(y.shape)):
            return np.full_like(y, np.nan)
    return np.asarray((flat + h * (weights @ stages)).reshape(y.shape))


def _slope(family: Family, p: Scalars, y: Array, into: Array) -> bool:
    """Right-hand side for the state (column 0) and its sensitivities; False where f has no value."""
    u, v = float(y[0, 0]), float(y[1, 0])
    try:
        force = family.force(u, v, p)
        by_u, by_v, *by_p = family.partials(u, v, p)
    except (OverflowError, ValueError, ZeroDivisionError):
        return False
    into[0] = y[1]
    np.multiply(y[0], -by_u, out=into[1])
    into[1] -= by_v * y[1]
    into[1, 3:] -= by_p
    into[1, 0] = -force
    return math.isfinite(force)


def _response(out: Array) -> Response:
    return Response(out[:, 0, 0].copy(), out[:, 1, 0].copy(), out[:, 0, 1:].copy(), out[:, 1, 1:].copy())


def steps_needed(
    family: Family, p: Scalars, state: tuple[float, float], *, samples: int, rate: float, bound: float, tolerance: float
) -> int:
    """Steps per sample from which on doubling them moves u by less than ``tolerance`` over ``samples``.

    Raises InputError when MOST_STEPS are not enough.
    """
    steps, coarse = 1, respond(family, p, state, samples=samples, rate=rate, steps=1, bound=bound)
    while steps <= MOST_STEPS:
        fine = respond(family, p, state, samples=samples, rate=rate, steps=2 * steps, bound=bound)
        if coarse.length == fine.length > 1 and np.abs(coarse.u - fine.u).max() < tolerance:
            return steps
        steps, coarse = 2 * steps, fine
    raise InputError(
        f"{family.name}: {MOST_STEPS} steps per sample do not follow the solution from {state[0]:.4g}, {state[1]:.4g}; "
        "the sampling rate is far below the oscillation, or the parameters are"
    )
