"""Cycle frequency: exact cases, the curvature bias and its removal, the two readings."""

import math

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import frozen, frozen_mask
from ridgeback.numeric.motion.cycle_frequency import Events, cycle_frequency, is_symmetric
from ridgeback.numeric.motion.dynamics import Dynamics, duffing, helmholtz_duffing, linear, pendulum, van_der_pol
from ridgeback.numeric.motion.events import CrossingEvents, TurningEvents
from ridgeback.numeric.motion.roots import bracketed_newton
from ridgeback.numeric.motion.trajectory import Trajectory, integrate
from ridgeback.numeric.orbits.period import exact_frequency


def events_of(phase, slope, duration, *, offset=0.0):
    """A trajectory that holds only the events of cos(phase(t) + offset), for a known phase."""

    def times(first):
        targets = np.arange(first, (phase(duration) + offset) / math.pi) * math.pi - offset
        guess = np.full(targets.size, duration / 2)
        return bracketed_newton(
            lambda t: (phase(t) - targets, slope(t)),
            np.zeros(targets.size),
            np.full(targets.size, duration),
            guess=guess,
        )

    crossings, turnings = times(0.5), times(0.0 if offset == 0 else 1.0)
    signs = np.where(np.arange(crossings.size) % 2 == 0, -1.0, 1.0)
    return Trajectory(
        name="chirp",
        time=frozen([0.0, duration]),
        u=frozen([1.0, 1.0]),
        velocity=frozen([0.0, 0.0]),
        rate=1 / duration,
        duration=duration,
        crossings=CrossingEvents(frozen(crossings), frozen_mask(signs > 0), frozen(signs)),
        turnings=TurningEvents(frozen(turnings), frozen((-1.0) ** np.arange(turnings.size))),
        method="none",
        rtol=1e-15,
        evaluations=0,
        steps=frozen([0.0, duration]),
        interpolant=lambda t: (t, t),
    )


def chirp(t):
    """omega = 6 + 2 tanh((t - 10) / 6): phase, omega and its second derivative."""
    x = (np.asarray(t) - 10) / 6
    phase = 6 * np.asarray(t) + 12 * np.log(np.cosh(x)) - 12 * math.log(math.cosh(10 / 6))
    omega = 6 + 2 * np.tanh(x)
    curvature = -4 * np.tanh(x) / np.cosh(x) ** 2 / 36
    return phase, omega, curvature


def test_four_events_are_enough_for_a_frequency_and_three_are_not():
    """Crossings at pi/2, 3 pi/2, ... of cos t, turning points at pi, 2 pi, ..."""
    four = integrate(linear(), (1.0, 0.0), duration=11.5, rate=4.0)
    found = cycle_frequency(four, dynamics=linear())
    assert found.omega == pytest.approx(1.0, rel=1e-9)
    three = integrate(linear(), (1.0, 0.0), duration=8.0, rate=4.0)
    with pytest.raises(InputError, match="3 zero crossings or turning points are too few"):
        cycle_frequency(three, dynamics=linear())


@pytest.fixture(scope="module")
def chirp_run():
    return events_of(lambda t: chirp(t)[0], lambda t: chirp(t)[1], 20.0)


def test_cycle_average_has_the_curvature_bias_that_is_stated(chirp_run):
    cycles = cycle_frequency(chirp_run, dynamics=linear())
    _, omega, curvature = chirp(cycles.time)
    predicted = curvature * (2 * math.pi / cycles.omega) ** 2 / 24
    inner = slice(2, -2)
    assert np.abs(cycles.omega - omega)[inner].max() > 20 * np.abs(cycles.omega - omega - predicted)[inner].max()


def test_instantaneous_value_removes_it_and_knows_its_error(chirp_run):
    cycles = cycle_frequency(chirp_run, dynamics=linear())
    t = np.linspace(0, 20, 401)
    _, omega, _ = chirp(t)
    error = np.abs(cycles.at(t) - omega)
    inner = (t > 1.5) & (t < 18.5)
    assert error[inner].max() < 3e-7
    assert np.all(error <= cycles.uncertainty_at(t) + 1e-12)
    assert cycles.span == (0.0, 20.0)


def test_interpolation_converges_with_the_cycles():
    """Twice the carrier, so twice the events: order about 7, that of the derivative of a spline of degree 7."""
    t = np.linspace(5, 15, 101)
    errors = []
    for factor in (1.0, 2.0):
        run = events_of(lambda t, f=factor: f * chirp(t)[0], lambda t, f=factor: f * chirp(t)[1], 20.0)
        errors.append(np.abs(cycle_frequency(run, dynamics=linear()).at(t) / (factor * chirp(t)[1]) - 1).max())
    assert math.log2(errors[0] / errors[1]) > 5.5


@pytest.mark.parametrize("oscillator", [pendulum(2.0), duffing(1.0, 0.5), helmholtz_duffing(1.0, 0.3, 0.1)])
def test_undamped_motion_has_its_exact_frequency(oscillator):
    run = integrate(oscillator, (1.0, 0.0), duration=60.0, rate=4.0)
    cycles = cycle_frequency(run, dynamics=oscillator)
    exact = exact_frequency(oscillator, 1.0).omega[0]
    assert np.allclose(cycles.omega, exact, rtol=1e-10)
    assert np.allclose(cycles.at(run.time[4:-8]), exact, rtol=1e-8)
    assert cycles.uncertainty.max() < 1e-8


def test_damped_linear_oscillator_has_omega_c():
    """Eq. (3)."""
    run = integrate(linear(2.0, 0.1), (1.0, 0.0), duration=40.0, rate=4.0)
    cycles = cycle_frequency(run, dynamics=linear(2.0, 0.1))
    assert np.allclose(cycles.omega, math.sqrt(4 - 0.01), rtol=1e-9)
    assert np.allclose(cycles.at(run.time), math.sqrt(4 - 0.01), rtol=1e-6)


def test_asymmetric_wells_use_the_centres_between_crossings():
    """Half cycles differ; taking them as equal would be wrong by their difference."""
    oscillator = helmholtz_duffing(1.0, 0.3, 0.1)
    run = integrate(oscillator, (1.5, 0.0), duration=60.0, rate=4.0)
    gaps = np.diff(run.crossings.time)
    assert abs(gaps[0] - gaps[1]) > 0.1
    cycles = cycle_frequency(run, dynamics=oscillator)
    assert cycles.kind is Events.CENTRES
    assert cycles.readings[0].name == "centres of upper half swings"


def test_crossings_of_one_direction_would_err_at_first_order_in_an_asymmetric_well():
    """Upward and downward ones deviate from the centres by as much in opposite directions."""
    oscillator = helmholtz_duffing(1.0, 0.3, 0.1, 0.002)
    run = integrate(oscillator, (1.5, 0.0), duration=100.0, rate=4.0)
    centres = cycle_frequency(run, dynamics=oscillator)
    deviation = []
    for direction in (True, False):
        t = run.crossings.time[run.crossings.rising == direction]
        deviation.append(2 * math.pi / (t[6] - t[5]) / centres.at(0.5 * (t[6] + t[5]))[0] - 1)
    assert deviation[0] == pytest.approx(-deviation[1], rel=0.1)
    assert abs(deviation[0]) > 1e-4
    t = np.linspace(20, 80, 30)
    upper, _, peaks, _ = centres.readings
    assert np.abs(upper.omega(t) / peaks.omega(t) - 1).max() < 0.05 * abs(deviation[0])


def test_symmetry_is_found():
    assert is_symmetric(pendulum(1.0, 0.1))
    assert is_symmetric(van_der_pol(2.0))
    assert not is_symmetric(helmholtz_duffing())
    rounded = Dynamics("rounded", force=lambda u, _: 3.0 * (u / 3.0 + 0.1) - 0.3, natural_frequency=1.0)
    assert rounded.force(0.3, 0.0) != -rounded.force(-0.3, 0.0)  # odd but for rounding
    assert is_symmetric(rounded)


def test_without_dynamics_the_result_is_the_same_within_its_uncertainty():
    oscillator = pendulum(4 * math.pi, 0.01)
    run = integrate(oscillator, (2.0, 0.0), duration=10.0, rate=64.0)
    blind, told = cycle_frequency(run), cycle_frequency(run, dynamics=oscillator)
    t = np.linspace(1.5, 8.5, 50)
    assert blind.kind is Events.CENTRES
    assert told.kind is Events.CROSSINGS
    assert np.all(np.abs(blind.at(t) - told.at(t)) <= blind.uncertainty_at(t) + told.uncertainty_at(t))


def test_readings_differ_at_second_order_in_the_damping():
    spreads = []
    for mu in (0.04, 0.02, 0.01):
        oscillator, duration = pendulum(4 * math.pi, mu), 0.1 / mu
        run = integrate(oscillator, (2.5, 0.0), duration=duration, rate=4.0, rtol=1e-13)
        crossings, turnings = cycle_frequency(run, dynamics=oscillator).readings
        t = np.linspace(0.2, 0.8, 20) * duration
        spreads.append(np.abs(crossings.omega(t) / turnings.omega(t) - 1).max())
    orders = np.log2(np.array(spreads[:-1]) / spreads[1:])
    assert np.all(np.abs(orders - 2) < 0.3)


def test_outside_the_events_there_is_no_value():
    oscillator = linear()
    run = integrate(oscillator, (1.0, 0.0), duration=20.0, rate=4.0)
    cycles = cycle_frequency(run, dynamics=oscillator)
    assert np.isnan(cycles.at([-5.0, 40.0])).all()
    assert np.isnan(cycles.uncertainty_at([-5.0, 40.0])).all()


def test_phase_advances_by_pi_per_crossing(chirp_run):
    reading = cycle_frequency(chirp_run, dynamics=linear()).readings[0]
    assert np.allclose(reading.phase(reading.time), math.pi * np.arange(reading.time.size), atol=1e-10)


def test_too_few_cycles_are_refused():
    run = integrate(linear(), (1.0, 0.0), duration=3.0, rate=4.0)
    with pytest.raises(InputError, match="too few for a frequency"):
        cycle_frequency(run, dynamics=linear())
