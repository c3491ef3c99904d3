"""Averaged decay: its error is of second order in mu/k, the start correction of first, and both are seen."""

import math

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.motion.cycle_frequency import cycle_frequency
from ridgeback.numeric.motion.dynamics import helmholtz_duffing, linear, pendulum, van_der_pol
from ridgeback.numeric.motion.trajectory import integrate
from ridgeback.numeric.orbits.averaging import averaged_decay
from ridgeback.numeric.orbits.energy import amplitude_from_energy, energy_of
from ridgeback.numeric.orbits.period import action

K = 4 * math.pi
RESTING, MOVING = (2.5, 0.0), (1.0, 2 * K * math.cos(1.2))


def worst_error(mu, start, *, correct_start=True, build=pendulum):
    """Largest relative difference from the cycle frequency over 0.1 < t / T < 0.9, mu T = 0.1."""
    oscillator, duration = build(K, mu=mu), 0.1 / mu
    run = integrate(oscillator, start, duration=duration, rate=4.0, rtol=1e-13)
    time = np.linspace(0.1, 0.9, 30) * duration
    model = averaged_decay(oscillator, start, time, correct_start=correct_start).omega
    return float(np.abs(model / cycle_frequency(run, dynamics=oscillator).at(time) - 1).max())


@pytest.mark.parametrize("start", [RESTING, MOVING])
def test_error_is_of_second_order_in_the_damping(start):
    errors = [worst_error(mu, start) for mu in (0.02, 0.01, 0.005)]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(np.abs(orders - 2) < 0.1)


def test_without_the_start_correction_the_error_is_of_first_order():
    errors = [worst_error(mu, MOVING, correct_start=False) for mu in (0.04, 0.02, 0.01)]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(np.abs(orders - 1) < 0.1)
    assert errors[-1] > 100 * worst_error(0.01, MOVING)


@pytest.mark.parametrize("start", [RESTING, (-2.5, 0.0), (0.0, 5.0), (0.0, -5.0)])
def test_no_correction_at_a_turning_point_or_in_the_middle_of_a_symmetric_well(start):
    assert abs(averaged_decay(pendulum(K, 0.01), start, [0.0]).correction) < 1e-15


def test_correction_keeps_second_order_in_an_asymmetric_well():
    def build(k, *, mu):
        return helmholtz_duffing(k, 0.2 * k * k, 0.1 * k * k, mu)

    errors = [worst_error(mu, (0.3, 8.0), build=build) for mu in (0.02, 0.01)]
    assert math.log2(errors[0] / errors[1]) == pytest.approx(2, abs=0.15)


def test_error_for_the_linear_oscillator_is_known_exactly():
    """omega_c = sqrt(k^2 - mu^2), eq. (3); averaging gives k."""
    decay = averaged_decay(linear(2.0, 0.1), (1.0, 0.0), [0.0, 5.0])
    assert np.allclose(decay.omega, 2.0, rtol=1e-14)
    assert np.allclose(decay.peak, np.exp([0.0, -0.5]), rtol=1e-13)
    assert np.allclose(decay.action_amplitude, decay.peak, rtol=1e-13)


@pytest.fixture(scope="module")
def paper():
    oscillator = pendulum(K, 0.01)
    run = integrate(oscillator, (0.95 * math.pi, 0.0), duration=20.0, rate=64.0)
    instantaneous = amplitude_from_energy(oscillator, energy_of(oscillator, run.u, run.velocity)).peak
    return oscillator, run, instantaneous, averaged_decay(oscillator, run.initial, run.time)


def test_the_papers_case(paper):
    """0.798 to 1.470 Hz at either end (1.469 by averaging: the last steps of (21) lie half a ripple higher)."""
    _, _, _, decay = paper
    assert decay.omega[[0, -1]] / (2 * math.pi) == pytest.approx([0.7982, 1.4688], abs=5e-5)
    assert decay.peak[-1] / math.pi == pytest.approx(0.659, abs=5e-4)


def test_equation_21_ripples_about_the_averaged_model(paper):
    """Measured beforehand: about 1.5 % rms of omega before 1 s and 0.05 % after 16 s."""
    oscillator, run, instantaneous, decay = paper
    ripple = oscillator.closed_form(instantaneous) / decay.omega - 1
    early, late = run.time < 1, run.time > 16
    assert np.sqrt(np.mean(ripple[early] ** 2)) == pytest.approx(0.015, abs=0.001)
    assert np.sqrt(np.mean(ripple[late] ** 2)) == pytest.approx(0.0005, abs=0.0001)
    changes = np.count_nonzero(np.diff(np.sign(ripple[run.time > 5])))
    assert changes == pytest.approx(4 * 15 * 1.33, rel=0.1)  # two ripples per cycle, mean 1.33 Hz


def test_averaged_action_passes_through_the_ripple(paper):
    """At the turning points both agree to second order in mu/k; half a ripple away they do not."""
    oscillator, run, instantaneous, decay = paper
    values = np.abs(run.turnings.value[5:])
    there = np.interp(run.turnings.time[5:], run.time, decay.action)
    at_turnings = np.abs(action(oscillator, values) / there - 1).max()
    everywhere = np.abs(action(oscillator, instantaneous) / decay.action - 1)[run.time > 2].max()
    assert at_turnings < 1.5e-4
    assert everywhere > 5 * at_turnings


def test_model_lies_within_the_uncertainty_of_the_cycle_frequency(paper):
    oscillator, run, _, decay = paper
    cycles = cycle_frequency(run, dynamics=oscillator)
    difference = np.abs(decay.omega - cycles.at(run.time))
    inside = (run.time > 2) & (run.time < 18)
    assert np.max((difference / decay.omega)[inside]) < 2e-4
    assert np.mean((difference / cycles.uncertainty_at(run.time))[inside]) < 10


def test_refusals():
    with pytest.raises(InputError, match="has no potential"):
        averaged_decay(van_der_pol(0.1), (1.0, 0.0), [0.0])
    with pytest.raises(InputError, match="outside the well"):
        averaged_decay(pendulum(), (0.0, 3.0), [0.0])
    with pytest.raises(InputError, match="times must be finite"):
        averaged_decay(pendulum(), (1.0, 0.0), [math.nan])
    with pytest.raises(InputError, match="initial state"):
        averaged_decay(pendulum(), (math.inf, 0.0), [0.0])
    with pytest.raises(InputError, match="at rest"):
        averaged_decay(pendulum(), (0.0, 0.0), [0.0])
