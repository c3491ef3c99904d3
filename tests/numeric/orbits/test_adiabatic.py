"""A slow drift beside closed forms of the linear oscillator; whole comparisons stand in tests/compare/drift."""

from __future__ import annotations

import numpy as np
import pytest

from ridgeback.numeric.motion.dynamics import Dynamics, linear
from ridgeback.numeric.motion.integration import Drift
from ridgeback.numeric.orbits.adiabatic import adiabatic_motion

K = 3.0


def damped_ever_more(rate: float, asked: list[float]) -> Drift:
    """u'' + 2 (0.1 + rate t) u' + 9 u = 0, which notes the times that it is asked for."""

    def mu(t: float) -> float:
        return 0.1 + rate * t

    def frozen(t: float) -> Dynamics:
        asked.append(t)
        return linear(k=K, mu=mu(t))

    return Drift(lambda t, u, v: K**2 * u + 2 * mu(t) * v, lambda _, u: 0.0 * u, frozen, True, "mu = 0.1+c*t")


def test_the_expected_error_of_growing_damping_is_the_one_of_its_formula() -> None:
    """(mu^2 + mu')/(2 k^2), W = sqrt(k^2 - mu^2 - mu'); and the law is asked for no time beyond the wanted ones."""
    t, rate, asked = np.linspace(0.0, 20.0, 9), 0.02, list[float]()
    found = adiabatic_motion(linear(k=K, mu=0.1), damped_ever_more(rate, asked), (1.0, 0.0), t).expected_error
    mu = 0.1 + rate * t
    assert found == pytest.approx((mu**2 + rate) / (2 * K**2), rel=1e-4)
    assert found == pytest.approx(K / np.sqrt(K**2 - mu**2 - rate) - 1.0, rel=0.05)
    assert -1e-9 < min(asked) < 0.1
    assert 19.9 < max(asked) < 20.0 + 1e-9
