"""Tables of orbits and the motion along a slow flow, against the certified quadrature and integrated equations."""

from __future__ import annotations

import math

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.motion.bilinear import Bilinear, as_dynamics
from ridgeback.numeric.motion.cycle_frequency import cycle_frequency
from ridgeback.numeric.motion.dynamics import Dynamics, duffing, helmholtz_duffing, linear, pendulum, van_der_pol
from ridgeback.numeric.motion.trajectory import integrate
from ridgeback.numeric.orbits.averaging import averaged_decay
from ridgeback.numeric.orbits.orbit_table import bilinear_table, orbit_table
from ridgeback.numeric.orbits.period import exact_frequency
from ridgeback.numeric.orbits.slow_flow import Flow, decay_flow, motion, refine
from ridgeback.numeric.orbits.waveform import orbit_harmonics

WELLS = (
    (pendulum(), 2.9),
    (duffing(eps=-0.5), 1.3),
    (duffing(eps=3.0), 2.0),
    (helmholtz_duffing(alpha=0.3, eps=0.2), 1.2),
    (helmholtz_duffing(alpha=-0.4, eps=0.0), 1.5),
)
NAMES = ("pendulum", "softening", "hardening", "asymmetric", "one-sided")


def flow_of(dynamics: Dynamics, top: float, rates: tuple[float, float, float]) -> Flow:
    peaks = top * np.sin(np.pi / 48 * np.arange(1, 25))
    orbits = refine(orbit_table(dynamics, peaks), np.geomspace(2e-3 * top, top, 240))
    return decay_flow(orbits, k=1.0, length=1.0, rates=rates)


@pytest.mark.parametrize(("dynamics", "top"), WELLS, ids=NAMES)
def test_the_table_is_that_of_the_certified_quadrature(dynamics: Dynamics, top: float) -> None:
    peaks = np.linspace(0.05, top, 12)
    table, exact = orbit_table(dynamics, peaks), exact_frequency(dynamics, peaks)
    assert np.allclose(table.omega, exact.omega, rtol=1e-11)
    assert np.allclose(table.action, exact.action, rtol=1e-11)
    assert np.abs(table.cosine - orbit_harmonics(dynamics, peaks, count=11).cosine).max() < 1e-11


def test_velocity_means_are_those_of_the_orbit() -> None:
    """Twin: the means over an integrated cycle; |u'|^3 has corners at the turning points, which cost digits."""
    dynamics, peak = helmholtz_duffing(alpha=0.3, eps=0.2), 1.1
    table = orbit_table(dynamics, [peak])
    period = 2 * math.pi / float(table.omega[0])
    run = integrate(dynamics, (peak, 0.0), duration=1.01 * period, rate=100.0)
    velocity = run.at(np.arange(4096) * (period / 4096))[1]
    assert float(table.cubic[0]) == pytest.approx(np.mean(np.abs(velocity) ** 3), rel=3e-7)
    assert float(table.quartic[0]) == pytest.approx(np.mean(velocity**4), rel=1e-9)


def test_an_orbit_that_just_reaches_a_hilltop_is_refused() -> None:
    """V = (u^2 - 2)^2 - 4: at the peak 2 the motion comes to rest at 0, where one of 63 nodes lies."""
    hill = Dynamics(
        "hill",
        lambda u, _: 4 * u * (u * u - 2),
        1.0,
        restoring=lambda u: 4 * np.asarray(u) * (np.asarray(u) ** 2 - 2),
        potential=lambda u: (np.asarray(u) ** 2 - 2) ** 2 - 4,
    )
    assert float(orbit_table(hill, [2.1], nodes=63).peak[0]) == 2.1
    with pytest.raises(InputError, match="peak amplitude 2 does not turn back"):
        orbit_table(hill, [2.0], nodes=63)


def test_bilinear_table_agrees_with_the_smooth_quadrature() -> None:
    """The general table does not see the corner, so 1e-4 with 64 nodes."""
    oscillator = Bilinear(1.0, 1.6, 0.4)
    ours = bilinear_table(oscillator, [0.3, 0.8, 1.5])
    general = orbit_table(as_dynamics(oscillator), [0.3, 0.8, 1.5])
    for name in ("omega", "action", "cosine", "cubic", "quartic"):
        assert np.allclose(getattr(ours, name), getattr(general, name), atol=3e-4), name


def test_an_orbit_outside_the_well_is_refused() -> None:
    with pytest.raises(InputError, match=r"pendulum: peak amplitude 3.2"):
        orbit_table(pendulum(), [1.0, 3.2, 6.5])
    with pytest.raises(InputError, match="no potential"):
        orbit_table(van_der_pol(), [1.0])


@pytest.mark.parametrize("mu", [0.01, 0.02])
def test_linear_motion_is_exact(mu: float) -> None:
    """The damped sine: amplitude exp(-mu t), frequency sqrt(k^2 - mu^2)."""
    flow = flow_of(linear(), 1.0, (2 * mu, 0.0, 0.0))
    time = np.linspace(0, 200.0, 1001)
    at = motion(flow, float(np.interp(0.0, flow.log_amplitude[::-1], flow.level[::-1])), 0.3, time)
    expected = np.exp(-mu * time) * np.cos(math.sqrt(1 - mu**2) * time + 0.3)
    assert np.abs(at.u - expected).max() < 1e-9


@pytest.mark.parametrize("start", [1.0, 2.5])
def test_frequency_along_the_decay_is_that_of_the_averaged_action(start: float) -> None:
    mu = 0.005
    time = np.linspace(0.0, 150.0, 31)
    averaged = averaged_decay(pendulum(mu=mu), (start, 0.0), time)
    flow = flow_of(pendulum(), 2.8, (2 * mu, 0.0, 0.0))
    first = -math.log(float(averaged.action[0]))
    at = motion(flow, first, 0.0, time)
    # the difference is of second order: mu^2/2 at small amplitudes, some 10 mu^2 next to the separatrix
    assert np.allclose(at.omega, averaged.omega, rtol=0.0, atol=(10.0 if start > 2 else 0.5) * mu**2)


# u'' + 2 mu u' + beta |u'| u' + gamma u'^3 + V'(u) = 0, integrated as it stands
def damped(dynamics: Dynamics, mu: float, beta: float, gamma: float) -> Dynamics:
    force = dynamics.force
    return Dynamics(
        name="damped",
        force=lambda u, v: force(u, v) + 2 * mu * v + beta * abs(v) * v + gamma * v**3,
        natural_frequency=dynamics.natural_frequency,
    )


@pytest.mark.parametrize("rates", [(0.01, 0.0, 0.0), (0.004, 0.01, 0.0), (0.004, 0.0, 0.01)])
def test_motion_follows_the_integrated_equation(rates: tuple[float, float, float]) -> None:
    """The averaging error is of second order in the damping: it falls fourfold when the damping is halved."""
    potential = helmholtz_duffing(alpha=0.2, eps=0.3)

    def error(scale: float) -> float:
        r = tuple(scale * x for x in rates)
        run = integrate(damped(potential, r[0] / 2, r[1], r[2]), (1.0, 0.0), duration=80.0 / scale, rate=4.0)
        cycles = cycle_frequency(run)
        flow = flow_of(potential, 1.5, (r[0], r[1], r[2]))
        table = orbit_table(potential, [1.0])
        time = np.linspace(10.0, 70.0, 7) / scale
        at = motion(flow, -math.log(float(table.action[0])), 0.0, time)
        return float(np.abs(at.omega / cycles.at(time) - 1).max())

    coarse, fine = error(1.0), error(0.5)
    assert coarse < 2e-4
    assert fine < 0.4 * coarse or fine < 2e-6


def test_waveform_is_that_of_the_integrated_equation() -> None:
    mu = 0.002
    potential = duffing(eps=0.5, mu=mu)
    run = integrate(potential, (1.0, 0.0), duration=100.0, rate=8.0)
    flow = flow_of(duffing(eps=0.5), 1.5, (2 * mu, 0.0, 0.0))
    first = -math.log(float(orbit_table(duffing(eps=0.5), [1.0]).action[0]))
    at = motion(flow, first, 0.0, run.time)
    assert float(np.abs(at.u - run.u).max()) < 3 * mu


def test_beyond_the_table_the_motion_goes_on() -> None:
    level: Array = np.linspace(0.0, 1.0, 40)
    ones = np.ones(40)
    flow = Flow(level, 0.1 * ones, 2 * ones, -0.05 * ones, np.exp(-level / 2), np.array([0 * ones, ones]))
    late = motion(flow, 0.0, 0.0, np.array([5.0, 50.0]))
    assert np.allclose(late.phase, [10.0, 100.0])
    assert np.allclose(late.amplitude, np.exp([-0.25, -2.5]))
