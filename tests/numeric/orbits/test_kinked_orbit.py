"""Orbits of a force with kinks, where the kink is none: those of the linear oscillator in closed form."""

from __future__ import annotations

import math

import numpy as np
import pytest

from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.numeric.motion.events import Switches
from ridgeback.numeric.orbits.kinked_orbit import half_orbit, since_turning
from ridgeback.numeric.orbits.waveform import orbit_harmonics

PLACES = Switches((-0.4, 0.5), False, lambda _, __: lambda u, _: u)
LINEAR = Dynamics("linear", lambda u, _: u, 1.0, restoring=np.asarray, switches=PLACES)


@pytest.mark.parametrize("u", [0.9, 0.45, 0.0])
@pytest.mark.parametrize("side", [1, -1])
def test_time_and_work_since_the_turning_point(u: float, side: int) -> None:
    """Of A cos t: t = arccos(u/A), and the integral of A^2 sin^2 from 0 to it."""
    peak = 2.0
    t = math.acos(u / peak)
    found = since_turning(LINEAR, side * peak, side, side * u)
    assert found == pytest.approx((t, 0.5 * peak**2 * (t - math.sin(t) * math.cos(t))), rel=1e-13)


def test_the_half_orbit_is_half_a_circle() -> None:
    orbit = half_orbit(LINEAR, np.array([-2.0]), np.array([2.0]), 16)
    assert np.allclose(orbit.u, 2.0 * np.cos(orbit.time), atol=1e-12)
    assert np.allclose(orbit.speed, 2.0 * np.sin(orbit.time), atol=1e-12)
    assert float(orbit.duration[0]) == pytest.approx(math.pi, rel=1e-14)
    assert float(orbit.action[0]) == pytest.approx(2.0, rel=1e-14)


def test_an_orbit_that_only_just_passes_a_kink_needs_no_more_nodes() -> None:
    """d = e/f_b is how far beyond the kink its law turns: with it the integrand is smooth up to the end."""
    for beyond in (1e-3, 1e-6, 1e-9):
        orbit = half_orbit(LINEAR, np.array([-0.5 - beyond]), np.array([0.5 + beyond]), 16)
        assert float(orbit.duration[0]) == pytest.approx(math.pi, rel=1e-9)


def test_its_waveform_is_a_cosine_and_known_as_well_as_that() -> None:
    found = orbit_harmonics(LINEAR, [2.0], count=4)
    assert np.allclose(found.cosine[:, 0], [0.0, 2.0, 0.0, 0.0, 0.0], atol=1e-13)
    assert found.error < 1e-12
