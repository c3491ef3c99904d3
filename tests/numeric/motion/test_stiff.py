"""Stiff equations take a stiff integrator, and what would take too long is refused after a few hundred steps."""

from __future__ import annotations

import math

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.compare.binding.bind import bind
from ridgeback.numeric.motion.dynamics import pendulum
from ridgeback.numeric.motion.integration import TooManyStepsError
from ridgeback.numeric.motion.taylor import integrate_taylor
from ridgeback.numeric.motion.trajectory import AUTO, integrate
from ridgeback.symbolic.systems.any_form import as_oscillator


def test_an_overdamped_pendulum_creeps_as_its_slow_equation_says() -> None:
    """u' = -sin(u) / (2 mu) to first order in 1/mu^2, so that tan(u/2) = tan(u0/2) exp(-t / (2 mu))."""
    mu = 1e6
    run = integrate(pendulum(mu=mu), (1.0, 0.0), duration=20.0, rate=4.0)
    assert run.method == "Radau"
    expected = 2 * np.arctan(math.tan(0.5) * np.exp(-run.time / (2 * mu)))
    assert np.abs(run.u - expected)[1:].max() < 1e-9
    with pytest.raises(TooManyStepsError, match="after 400 steps, and would take about"):
        integrate(pendulum(mu=mu), (1.0, 0.0), duration=20.0, rate=4.0, method="DOP853")


def test_a_relaxation_oscillator_of_any_strength_is_followed() -> None:
    """On the slow branch u' (u^2 - 1) eps = -u: log(u) - u^2 / 2 rises by t / eps."""
    for eps in (10**4, 10**12):
        run = integrate(
            bind(as_oscillator("van-der-pol").with_parameters({"eps": eps})), (2.0, 0.0), duration=20.0, rate=1.0
        )
        assert run.method == "Radau"
        gained = (np.log(run.u) - run.u**2 / 2) - (math.log(2.0) - 2.0)
        assert np.abs(gained - run.time / eps)[1:].max() < 1e-6


def test_an_equation_that_is_not_stiff_is_left_to_dop853() -> None:
    chosen = integrate(pendulum(), (1.0, 0.0), duration=200.0, rate=4.0)
    given = integrate(pendulum(), (1.0, 0.0), duration=200.0, rate=4.0, method="DOP853")
    assert chosen.method == "DOP853"
    assert np.array_equal(chosen.u, given.u)


def test_a_taylor_integration_that_takes_too_long_is_refused_early() -> None:
    with pytest.raises(InputError, match=r"would (take|keep) about"):
        integrate_taylor(bind("pendulum"), (1.0, 0.0), duration=1e5, rate=1.0)


@pytest.mark.parametrize("method", [AUTO, "Radau", "BDF", "LSODA"])
@pytest.mark.parametrize("start", [(1e154, 0.0), (0.0, 1e200)])
def test_a_start_where_derivatives_of_the_force_overflow_is_refused(method: str, start: tuple[float, float]) -> None:
    """u^2 u' is finite and the Jacobian of an implicit step is not; no solver's own error comes out, and no nan."""
    dynamics = bind(as_oscillator("van-der-pol").with_parameters({"eps": 1}))
    with pytest.raises(InputError, match=r"start (with less|nearer|elsewhere)") as refusal:
        integrate(dynamics, start, duration=1.0, rate=8.0, method=method)
    assert "nan" not in str(refusal.value)
