"""Integration by scipy: closed forms, observed order, located events, and refusals."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.numeric.motion.dynamics import (
    Dynamics,
    duffing,
    helmholtz_duffing,
    linear,
    pendulum,
    polynomial,
    van_der_pol,
)
from ridgeback.numeric.motion.request import MAX_SAMPLES
from ridgeback.numeric.motion.trajectory import integrate, sample_times

K, MU = 4 * math.pi, 0.05
OMEGA = math.sqrt(K**2 - MU**2)


def damped_cosine(t):
    """Exact solution of the linear damped oscillator from (1, 0)."""
    return np.exp(-MU * t) * (np.cos(OMEGA * t) + MU / OMEGA * np.sin(OMEGA * t))


@pytest.fixture(scope="module")
def linear_run():
    return integrate(linear(K, MU), (1.0, 0.0), duration=10.0, rate=64.0)


@pytest.mark.parametrize(("method", "error"), [("DOP853", 3e-11), ("RK45", 3e-9), ("LSODA", 3e-9), ("Radau", 3e-7)])
def test_every_method_follows_the_closed_form(method, error):
    rtol = 1e-12 if method in ("DOP853", "LSODA") else 1e-9
    rtol = 1e-8 if method == "Radau" else rtol
    rtol = 1e-11 if method == "RK45" else rtol
    run = integrate(linear(K, MU), (1.0, 0.0), duration=5.0, rate=64.0, method=method, rtol=rtol)
    assert np.abs(run.u - damped_cosine(run.time)).max() < error
    assert run.method == method


def test_error_is_proportional_to_the_tolerance():
    runs = [integrate(linear(K, MU), (1.0, 0.0), duration=5.0, rate=64.0, rtol=rtol) for rtol in (1e-6, 1e-8, 1e-10)]
    errors = [np.abs(run.u - damped_cosine(run.time)).max() for run in runs]
    slopes = np.diff(np.log10(errors)) / -2
    assert np.all(slopes > 0.7)
    assert np.all(slopes < 1.3)


def test_crossings_and_turnings_of_the_linear_oscillator(linear_run):
    """Turning points at n pi / omega; crossings where tan(omega t) = -omega / mu."""
    turnings, crossings = linear_run.turnings, linear_run.crossings
    n = np.arange(turnings.time.size)
    assert n.size == 40
    assert np.abs(turnings.time - n * math.pi / OMEGA).max() < 1e-11
    assert np.allclose(turnings.value, (-1.0) ** n * np.exp(-MU * n * math.pi / OMEGA), atol=1e-10)
    first = (math.pi - math.atan(OMEGA / MU)) / OMEGA
    assert np.abs(crossings.time - (first + np.arange(crossings.time.size) * math.pi / OMEGA)).max() < 1e-11
    assert crossings.rising.tolist() == [bool(i % 2) for i in range(crossings.time.size)]
    assert np.array_equal(crossings.velocity > 0, crossings.rising)


def test_events_lie_on_the_dense_output(linear_run):
    u, _ = linear_run.at(linear_run.crossings.time)
    _, velocity = linear_run.at(linear_run.turnings.time)
    assert np.abs(u).max() < 1e-13
    assert np.abs(velocity).max() < 1e-13 * K**2


def test_events_move_little_when_their_step_is_integrated_anew():
    """The dense output is of seventh order only; a run that ends at the event has no use of it."""
    start, case = (0.95 * math.pi, 0.0), pendulum(K, 0.01)
    run = integrate(case, start, duration=3.0, rate=64.0)
    for time in (*run.crossings.time[:3], *run.turnings.time[1:4]):
        restarted = integrate(case, start, duration=float(time), rate=1.0)
        u, velocity = run.at([time])
        end_u, end_velocity = restarted.at([time])
        assert abs(end_u - u)[0] < 1e-10
        assert abs(end_velocity - velocity)[0] < 1e-9


def test_a_start_on_zero_counts_as_a_crossing():
    run = integrate(linear(1.0), (0.0, 1.0), duration=7.0, rate=2.0)
    assert run.crossings.time == pytest.approx([0.0, math.pi, 2 * math.pi], abs=1e-11)
    assert run.crossings.rising.tolist() == [True, False, True]


def test_asymmetric_turning_points_have_one_energy():
    oscillator = helmholtz_duffing(1.0, 0.3, 0.1)
    run = integrate(oscillator, (1.0, 0.0), duration=30.0, rate=4.0)
    levels = oscillator.potential(run.turnings.value)
    assert np.allclose(levels, levels[0], rtol=1e-10)
    trough = max(r.real for r in np.roots([0.025, 0.1, 0.5, 0.0, -0.625]) if r.real < 0 and r.imag == 0)
    assert run.turnings.value.min() == pytest.approx(trough, abs=1e-10)


def test_time_reversal_of_the_undamped_pendulum():
    """From the end state with its velocity turned round the motion runs back to the start."""
    out = integrate(pendulum(2.0), (2.5, 0.3), duration=6.0, rate=10.0)
    back = integrate(pendulum(2.0), (out.u[-1], -out.velocity[-1]), duration=6.0, rate=10.0)
    assert back.u[-1] == pytest.approx(2.5, abs=1e-9)
    assert back.velocity[-1] == pytest.approx(-0.3, abs=1e-9)


@settings(deadline=None, max_examples=20)
@given(duration=st.floats(0.1, 50), rate=st.floats(0.5, 200))
def test_sample_times_stay_inside_and_are_complete(duration, rate):
    t = sample_times(duration, rate)
    assert t[0] == 0
    assert t[-1] <= duration * (1 + 1e-12)
    assert t[-1] + 1 / rate > duration * (1 - 1e-12)


def test_values_are_read_only_and_within_the_span(linear_run):
    with pytest.raises(ValueError, match="read-only"):
        linear_run.u[0] = 3.0
    assert linear_run.initial == (1.0, 0.0)
    with pytest.raises(InputError, match="within 0 and 10"):
        linear_run.at([10.5])


GOOD = {"duration": 1.0, "rate": 10.0}


@pytest.mark.parametrize(
    ("state", "options", "message"),
    [
        ((math.nan, 0.0), {}, "initial state"),
        ((1.0, math.inf), {}, "initial state"),
        ((0.0, 0.0), {}, "equilibrium"),
        ((math.pi, 0.0), {}, "equilibrium|outside the potential well"),
        ((3.5, 0.0), {}, "outside the potential well"),
        ((1.0, 0.0), {"duration": 0.0}, "duration = 0.0"),
        ((1.0, 0.0), {"rate": -1.0}, "rate = -1.0"),
        ((1.0, 0.0), {"rate": math.nan}, "rate = nan"),
        ((1.0, 0.0), {"method": "Euler"}, "unknown method 'Euler'; use one of auto, DOP853"),
        ((1.0, 0.0), {"rtol": 1e-20}, "rtol"),
        ((1.0, 0.0), {"atol": -1.0}, "atol"),
        ((1.0, 0.0), {"rate": 1e9}, "use rate <="),
        ((1.0, 0.0), {"duration": 1e7, "rate": 0.1}, "more cycles"),
    ],
)
def test_bad_requests_are_refused(state, options, message):
    with pytest.raises(InputError, match=message):
        integrate(pendulum(1.0, 0.01), state, **(GOOD | options))


def test_the_sample_limit_that_is_named_would_pass_the_check():
    with pytest.raises(InputError, match="at most") as refused:
        integrate(pendulum(), (1.0, 0.0), duration=2.0, rate=1e8)
    allowed = float(str(refused.value).split("rate <= ")[1].split(" ")[0])
    assert allowed * 2.0 == pytest.approx(MAX_SAMPLES, rel=1e-5)


def test_rotation_and_escape_are_detected_where_they_happen():
    with pytest.raises(InputError, match=r"pendulum: u = 3\.\d+ at t = .* outside the potential well"):
        integrate(pendulum(1.0, 0.001), (0.0, 2.01), duration=20.0, rate=10.0)
    with pytest.raises(InputError, match="outside the potential well -1 < u < 1"):
        integrate(duffing(eps=-1.0), (0.0, 0.72), duration=20.0, rate=10.0)
    integrate(pendulum(1.0, 0.001), (0.0, 1.99), duration=20.0, rate=10.0)
    integrate(duffing(eps=-1.0), (0.0, 0.70), duration=20.0, rate=10.0)


def test_growth_without_bound_is_refused():
    runaway = Dynamics("runaway", lambda u, v: u - 0.5 * v - v**3, 1.0)
    with pytest.raises(InputError, match="grows"):
        integrate(runaway, (1.0, 0.0), duration=50.0, rate=1.0)
    with pytest.raises(InputError, match="grows beyond"):
        integrate(polynomial((1.0,), mu=-0.5), (1.0, 0.0), duration=50.0, rate=1.0)


def test_a_limit_cycle_may_grow_from_a_small_start():
    run = integrate(van_der_pol(1.0), (1e-4, 0.0), duration=60.0, rate=4.0)
    assert run.turnings.value[-2:].max() == pytest.approx(2.0086198608748, abs=1e-9)
