"""A slow drift beside closed forms of the linear oscillator; whole comparisons stand in tests/compare/drift."""

from __future__ import annotations

import numpy as np
import pytest

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.motion.dynamics import Dynamics, linear
from ridgeback.numeric.motion.integration import Drift
from ridgeback.numeric.orbits.adiabatic import INTERVALS, _resolving, adiabatic_motion


def omega(t: float) -> float:
    """3 + 0.02 t + 0.001 t^2."""
    return 3.0 + t * (0.02 + 0.001 * t)


def damped_ever_more(asked: list[float]) -> Drift:
    """u'' + 2 (0.1 + 0.02 t) u' + omega(t)^2 u = 0, which notes the times that it is asked for."""

    def mu(t: float) -> float:
        return 0.1 + 0.02 * t

    def frozen(t: float) -> Dynamics:
        asked.append(t)
        return linear(k=omega(t), mu=mu(t))

    def changing(t: float, u: Array) -> Array:
        return omega(t) * (0.02 + 0.002 * t) * u**2

    return Drift(lambda t, u, v: omega(t) ** 2 * u + 2 * mu(t) * v, changing, frozen, True, "mu = 0.1+0.02*t")


def test_the_expected_error_is_the_one_of_its_formula() -> None:
    """omega''/(4 omega^3) - 3 omega'^2/(8 omega^4) + (mu^2 + mu')/(2 omega^2), and no time beyond is asked for."""
    t, asked = np.linspace(0.0, 20.0, 9), list[float]()
    found = adiabatic_motion(linear(k=3.0, mu=0.1), damped_ever_more(asked), (1.0, 0.0), t)
    w, mu = np.array([omega(x) for x in t.tolist()]), 0.1 + 0.02 * t
    assert found.omega == pytest.approx(w, rel=1e-9)
    drift = 0.002 / (4 * w**3) - 3 * (0.02 + 0.002 * t) ** 2 / (8 * w**4)
    assert found.expected_error == pytest.approx(drift + (mu**2 + 0.02) / (2 * w**2), rel=1e-4)
    assert -1e-9 < min(asked) < 0.1
    assert 19.9 < max(asked) < 20.0 + 1e-9


def test_the_law_is_looked_at_over_all_of_the_time() -> None:
    asked = list[float]()
    assert _resolving(damped_ever_more(asked), 20.0) == INTERVALS
    assert (min(asked), max(asked)) == pytest.approx((0.0, 20.0), abs=1e-9)
