"""Rounding to steps errs on the mean by what is said of it, and where that matters no interval is claimed."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.signal.steps import mean_rounding, step_of


@pytest.mark.parametrize("noise", [0.02, 0.3, 0.7])
def test_the_mean_error_of_rounding_is_that_of_many_draws(noise: float) -> None:
    values = np.linspace(-1.3, 1.4, 12)
    draws = values + noise * np.random.default_rng(1).normal(size=(20_000, values.size))
    assert_allclose(mean_rounding(values, 1.0, noise), np.rint(draws).mean(axis=0) - values, atol=0.02)


def rounded(step: float, noise: float, per_cycle: float, growth: float = -0.002) -> Array:
    """A slow decay in noise, in steps."""
    n = np.arange(800)
    turn = 2.0 * np.pi * n / per_cycle
    x = np.exp(growth * n) * np.cos(turn + 0.3) + noise * np.random.default_rng(2).normal(size=n.size)
    return np.asarray(step * np.rint(x / step), dtype=np.float64)


@pytest.mark.parametrize(("per_cycle", "growth"), [(16.37, -2e-4), (16.0, 0.0)])
def test_no_interval_is_claimed_where_rounding_errs_alike(per_cycle: float, growth: float) -> None:
    found = estimate(rounded(0.3, 0.01, per_cycle, growth), 16.0)
    assert found.interval is None
    assert "the samples come in steps of 0.3, 3." in str(found.no_interval)


def test_noise_larger_than_the_steps_makes_rounding_harmless() -> None:
    assert estimate(rounded(0.1, 0.06, 16.37), 16.0).interval is not None


@pytest.mark.parametrize(("step", "digits"), [(0.1, 1), (1 / 256, 4), (1 / 256, 9)])
def test_steps_are_found_though_they_were_printed_with_few_digits(step: float, digits: int) -> None:
    x = np.round(rounded(step, 0.01, 16.37), digits)
    assert step_of(x) == pytest.approx(step, abs=10.0**-digits / 100.0)


def test_values_that_repeat_come_in_no_steps() -> None:
    x = np.cos(2.0 * np.pi * 0.031 * np.arange(1200))
    assert step_of(x) is None
    found = estimate(x.round(9), 100.0)
    assert found.interval is not None
    assert_allclose(found.omega, 6.2 * np.pi, rtol=1e-9)
