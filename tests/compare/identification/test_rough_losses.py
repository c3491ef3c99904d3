"""Rough losses in a decay: found with their parameters from integrated motions, the stiffness beside them."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import ridgeback
from ridgeback.compare.identification.identify import identify
from ridgeback.compare.identification.preparation import Prepared, local_track
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.motion.dynamics import duffing
from ridgeback.numeric.orbits.orbit_table import orbit_table
from ridgeback.numeric.orbits.slow_flow import decay_flow, refine
from ridgeback.numeric.recording.recording import Recording


def test_friction_is_found_beside_linear_damping() -> None:
    run = ridgeback.simulate("u'' + 0.006*u' + 0.004*sign(u') + u + 2/5*u**3 = 0", (1.0, 0.0), duration=90.0, rate=1.0)
    values = run.u + 0.002 * np.random.default_rng(2).normal(size=run.u.size)
    best = ridgeback.identify(values, 1.0, candidates=["duffing-hardening"], damping="coulomb").best
    assert best.damping_law == "linear + coulomb"
    for name, true in (("F", 0.004), ("mu", 0.003)):
        found = best.parameter(name)
        assert abs(found.value - true) < 4.0 * found.standard_deviation + 0.03 * true


def test_the_stiffness_is_right_under_heavy_quadratic_drag() -> None:
    """a'/a is 8 % of omega at first: without the second order in the drag k is low by 5e-4, six deviations."""

    def slope(_: float, state: Array) -> list[float]:
        return [state[1], -0.032 * state[1] - 0.4 * abs(state[1]) * state[1] - state[0]]

    time = np.arange(0.0, 250.0, 0.16)
    u = solve_ivp(slope, (0.0, time[-1]), (1.0, 0.0), "DOP853", time, rtol=1e-9, atol=1e-11).y[0]
    decay = Recording.from_arrays(u + 0.004 * np.random.default_rng(1).normal(size=u.size), 1 / 0.16)
    ready = Prepared(decay, local_track(decay).of_oscillation(), (), ~decay.clipped)
    best = identify(ready, candidates=["linear"], laws=["linear", "linear + quadratic"]).best
    k, beta = best.parameter("k"), best.parameter("beta")
    assert abs(k.value - 1.0) < 3.0 * k.standard_deviation < 4e-4
    assert abs(beta.value - 0.4) < 3.0 * beta.standard_deviation < 0.02


def test_the_growth_rate_of_dry_friction_is_that_of_averaging() -> None:
    """-2 F/(pi a) + 23 F e a/(16 pi), by multiple scales, of u'' + u + e u^3 in the first harmonic."""
    e, friction = 0.3, 1e-4  # so little that its third order is none
    orbits = refine(orbit_table(duffing(eps=e), np.linspace(0.05, 1.0, 40)), np.geomspace(0.1, 0.2, 201))
    flow = decay_flow(orbits, k=1.0, length=1.0, rates=(0.0, 0.0, 0.0, friction))
    averaged = ridgeback.derive("u'' + F*sign(u') + u + 3/10*u**3 = 0", 8)
    expected = averaged.growth_rate_at(flow.amplitude, friction)
    assert flow.growth[1:-1] == pytest.approx(expected[1:-1], rel=1e-5)
