"""The paper's damped pendulum, integrated here once by scipy alone, with its phase read off the zero crossings."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.interpolate import BSpline, make_interp_spline

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Decay:
    """Samples of a decaying pendulum and omega0(t), the derivative of a spline through phase = pi * crossing number."""

    time: Array
    u: Array
    velocity: Array
    omega: BSpline
    rate: float

    def error(self, time: Array, omega: Array, *, multiple: int = 1, low: float = 2.0, high: float = 18.0) -> float:
        """Relative rms distance from omega0 between low and high."""
        within = (time >= low) & (time <= high)
        return float(np.sqrt(np.mean((omega[within] / (multiple * self.omega(time[within])) - 1.0) ** 2)))


@lru_cache
def integrated(rate: float, mu: float) -> Decay:
    k, duration = 4.0 * np.pi, 20.0

    def right_side(_t: float, y: Array) -> list[float]:
        return [y[1], -2.0 * mu * y[1] - k * k * np.sin(y[0])]

    solution = solve_ivp(
        right_side,
        (0.0, 1.2 * duration),
        [0.95 * np.pi, 0.0],
        method="DOP853",
        rtol=1e-12,
        atol=1e-13,
        events=lambda _t, y: y[0],
        dense_output=True,
    )
    time = np.arange(round(duration * rate) + 1) / rate
    u, velocity = solution.sol(time)
    crossings = solution.t_events[0]
    phase = make_interp_spline(crossings, np.pi * np.arange(crossings.size), k=5)
    return Decay(time, u, velocity, phase.derivative(), rate)


@pytest.fixture(scope="session")
def pendulum_decay() -> Callable[..., Decay]:
    return lambda rate=32.0, mu=0.01: integrated(rate, mu)
