"""Taylor integration: closed forms at full precision, energy, reversal, order, and agreement with scipy."""

import math

import mpmath as mp
import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.motion.dynamics import Dynamics, linear, pendulum, van_der_pol
from ridgeback.numeric.motion.taylor import integrate_taylor, taylor_solution
from ridgeback.numeric.motion.trajectory import integrate


def linear_solution(k, mu, t):
    omega = mp.sqrt(mp.mpf(k) ** 2 - mp.mpf(mu) ** 2)
    return mp.exp(-mu * t) * (mp.cos(omega * t) + mu / omega * mp.sin(omega * t))


@pytest.mark.parametrize("digits", [15, 30, 60])
def test_closed_form_of_the_linear_damped_oscillator(digits):
    solution = taylor_solution(linear(3.0, 0.25), (1, 0), duration=8.0, digits=digits)
    with mp.workdps(digits + 10):
        for t in (mp.mpf("0.3"), mp.mpf("4.7"), mp.mpf(8)):
            error = abs(solution.state(t)[0] - linear_solution(3, mp.mpf("0.25"), t))
            assert error < mp.mpf(10) ** (2 - digits)


def test_energy_of_the_undamped_pendulum_is_kept_to_the_working_precision():
    solution = taylor_solution(pendulum(2.0), (2.8, 0), duration=10.0, digits=30)
    with mp.workdps(40):
        states = [solution.state(t) for t in (0, mp.mpf("3.3"), 10)]
        energies = [v**2 / 2 - 4 * mp.cos(u) for u, v in states]
        assert max(abs(e - energies[0]) for e in energies) < mp.mpf("1e-28")


def test_pendulum_period_from_its_crossings_is_the_elliptic_integral():
    solution = taylor_solution(pendulum(1.0), (2, 0), duration=20.0, digits=30)
    crossings = solution.crossings()
    with mp.workdps(38):
        period = 2 * mp.pi / mp.agm(1, mp.cos(1))
        assert abs(crossings[2].time - crossings[0].time - period) < mp.mpf("1e-28")
        assert abs(solution.turnings()[2].time - period) < mp.mpf("1e-28")


def test_time_reversal():
    out = taylor_solution(pendulum(1.0), (mp.mpf(2), mp.mpf("0.5")), duration=7.0, digits=25)
    with mp.workdps(33):  # mpmath rounds to the working precision even on negation
        u, v = out.state(7)
        back = taylor_solution(pendulum(1.0), (u, -v), duration=7.0, digits=25)
        u, v = back.state(7)
        assert abs(u - 2) < mp.mpf("1e-22")
        assert abs(v + mp.mpf("0.5")) < mp.mpf("1e-22")


def test_damping_run_backwards_is_negative_damping():
    """u(T - t) of mu obeys the equation with -mu."""
    out = taylor_solution(pendulum(1.0, 0.1), (2, 0), duration=5.0, digits=25)
    with mp.workdps(33):
        u, v = out.state(5)
        back = taylor_solution(pendulum(1.0, -0.1), (u, -v), duration=5.0, digits=25)
        assert abs(back.state(5)[0] - 2) < mp.mpf("1e-21")


def fixed_step_error(degree, steps):
    """Error after one time unit with equal steps, from the jet alone: the order without the step rule."""
    oscillator = pendulum(1.0)
    with mp.workdps(40):
        u, v, h = mp.mpf(2), mp.mpf(0), mp.mpf(1) / steps
        for _ in range(steps):
            c = oscillator.jet(u, v, degree)
            u, v = mp.polyval(c[::-1], h, derivative=True)
        exact = taylor_solution(oscillator, (2, 0), duration=1.0, digits=35).state(1)[0]
        return abs(u - exact)


@pytest.mark.parametrize("degree", [4, 8, 12])
def test_observed_order_of_convergence(degree):
    """u' is known to one power less than u, so that the global order is degree - 1 (or better)."""
    order = mp.log(fixed_step_error(degree, 16) / fixed_step_error(degree, 32), 2)
    assert degree - 1.3 < order < degree + 1.5


def test_more_digits_give_more_digits():
    reference = taylor_solution(van_der_pol(1.0), (1, 0), duration=10.0, digits=45).state(10)[0]
    with mp.workdps(50):
        errors = [
            abs(taylor_solution(van_der_pol(1.0), (1, 0), duration=10.0, digits=d).state(10)[0] - reference)
            for d in (10, 20, 30)
        ]
    assert all(e < mp.mpf(10) ** (2 - d) for e, d in zip(errors, (10, 20, 30), strict=True))


@pytest.fixture(scope="module")
def paper_pair():
    """The paper's case, its first 5 s, by both integrators."""
    case = {"duration": 5.0, "rate": 64.0}
    oscillator, start = pendulum(4 * math.pi, 0.01), (0.95 * math.pi, 0.0)
    return integrate(oscillator, start, **case), integrate_taylor(oscillator, start, digits=25, **case)


def test_the_two_integrators_agree_on_the_papers_case(paper_pair):
    scipy, taylor = paper_pair
    assert np.abs(scipy.u - taylor.u).max() < 1e-8
    assert scipy.crossings.time.size == taylor.crossings.time.size
    assert np.abs(scipy.crossings.time - taylor.crossings.time).max() < 1e-9


def test_tighter_tolerance_brings_scipy_nearer(paper_pair):
    _, taylor = paper_pair
    oscillator = pendulum(4 * math.pi, 0.01)
    errors = [
        np.abs(integrate(oscillator, (0.95 * math.pi, 0.0), duration=5.0, rate=64.0, rtol=r).u - taylor.u).max()
        for r in (1e-9, 1e-11, 1e-13)
    ]
    assert errors[0] > 20 * errors[1] > 400 * errors[2]


def test_dense_output_of_the_rounded_solution(paper_pair):
    _, taylor = paper_pair
    u, velocity = taylor.at(taylor.time)
    assert np.abs(u - taylor.u).max() < 1e-13
    assert np.abs(velocity - taylor.velocity).max() < 1e-11
    assert np.abs(taylor.at(taylor.crossings.time)[0]).max() < 1e-12


def test_events_at_a_start_on_zero_and_at_rest():
    solution = taylor_solution(linear(1.0), (0, 1), duration=3.5, digits=20)
    assert [float(e.time) for e in solution.crossings()] == pytest.approx([0.0, math.pi], abs=1e-16)
    resting = taylor_solution(linear(1.0), (1, 0), duration=3.5, digits=20)
    assert [float(e.u) for e in resting.turnings()] == pytest.approx([1.0, -1.0], abs=1e-16)


def test_refusals():
    bare = Dynamics("bare", lambda u, v: u + 0 * v, 1.0)
    with pytest.raises(InputError, match="no Taylor coefficients"):
        taylor_solution(bare, (1, 0), duration=1.0)
    with pytest.raises(InputError, match="digits = 2"):
        taylor_solution(linear(), (1, 0), duration=1.0, digits=2)
    with pytest.raises(InputError, match="fewer digits or duration"):
        taylor_solution(pendulum(100.0), (3, 0), duration=1e5, digits=50)
    with pytest.raises(InputError, match="outside the potential well"):
        integrate_taylor(pendulum(), (0.0, 2.1), duration=10.0, rate=4.0, digits=15)
    with pytest.raises(InputError, match="equilibrium"):
        integrate_taylor(pendulum(), (0.0, 0.0), duration=10.0, rate=4.0)
    with pytest.raises(InputError, match="within 0 and 1"):
        taylor_solution(linear(), (1, 0), duration=1.0).state(2)
