"""Limit cycles: van der Pol's period to 30 digits, its series in eps, Rayleigh's twin, and refusals."""

import math

import mpmath as mp
import numpy as np
import pytest
from scipy.integrate import quad

from ridgeback.common.errors import InputError
from ridgeback.numeric.motion.dynamics import Dynamics, linear, pendulum, rayleigh, van_der_pol
from ridgeback.numeric.motion.limit_cycle import _settle, periodic_orbit, precise_orbit
from ridgeback.numeric.motion.taylor import taylor_solution
from ridgeback.numeric.motion.trajectory import integrate

# Converged: Taylor integration at 20, 30 and 40 digits agrees on every digit printed here.
PERIOD = "6.6632868593231301896997"
PEAK = "2.0086198608748431365"


@pytest.fixture(scope="module")
def unit_orbit():
    return periodic_orbit(van_der_pol(1.0))


def test_period_and_peak_of_van_der_pol(unit_orbit):
    assert unit_orbit.period == pytest.approx(float(PERIOD), rel=1e-13)
    assert unit_orbit.peak == pytest.approx(float(PEAK), rel=1e-13)
    assert abs(unit_orbit.period - float(PERIOD)) <= unit_orbit.period_error < 1e-10
    assert unit_orbit.trough == pytest.approx(-unit_orbit.peak, rel=1e-12)
    assert unit_orbit.omega == pytest.approx(2 * math.pi / float(PERIOD), rel=1e-13)


def test_the_same_to_thirty_digits(unit_orbit):
    orbit = precise_orbit(van_der_pol(1.0), unit_orbit, digits=30)
    with mp.workdps(35):
        assert abs(orbit.period - mp.mpf(PERIOD)) < mp.mpf("1e-21")
        assert abs(orbit.peak - mp.mpf(PEAK)) < mp.mpf("1e-18")
        solution = taylor_solution(van_der_pol(1.0), (orbit.peak, 0), duration=6.7, digits=40)
        u, v = solution.state(orbit.period)
        assert abs(u - orbit.peak) < mp.mpf("1e-27")
        assert abs(v) < mp.mpf("1e-27")


def test_frequency_follows_its_series_in_eps():
    """Andersen and Geer 1982; the remainder after eps^6 is the next term, -678899/5096079360 eps^8."""
    remainders = []
    for eps in (0.2, 0.3):
        omega = periodic_orbit(van_der_pol(eps)).omega
        remainders.append(omega - (1 - eps**2 / 16 + 17 * eps**4 / 3072 + 35 * eps**6 / 884736))
    assert math.log(remainders[1] / remainders[0], 1.5) == pytest.approx(8, abs=0.1)
    assert remainders[0] / 0.2**8 == pytest.approx(-678899 / 5096079360, rel=0.02)


def test_peak_follows_its_series_in_eps():
    """2 + eps^2 / 96 - 1033 eps^4 / 552960 + O(eps^6)."""
    eps = 0.1
    series = 2 + eps**2 / 96 - 1033 * eps**4 / 552960
    assert periodic_orbit(van_der_pol(eps)).peak == pytest.approx(series, abs=eps**6 / 100)


def test_two_peaks_within_twenty_natural_periods_are_enough_to_settle() -> None:
    """The peak of a slow relaxation oscillation: 2 + a/3 eps^(-4/3) - (16 ln eps/27 + 0.876) eps^(-2), Ai(-a) = 0."""
    eps = 60.0
    series = 2 + 2.338107 / 3 * eps ** (-4 / 3) - (16 / 27 * math.log(eps) + 0.876127) / eps**2
    assert _settle(van_der_pol(eps), 1.0) == pytest.approx(series, abs=2e-5)


def test_rayleigh_has_van_der_pols_period_and_velocity(unit_orbit):
    orbit = periodic_orbit(rayleigh(1.0))
    assert orbit.period == pytest.approx(unit_orbit.period, rel=1e-11)
    assert orbit.multiplier == pytest.approx(unit_orbit.multiplier, rel=1e-4)
    run = integrate(rayleigh(1.0), (orbit.peak, 0.0), duration=orbit.period, rate=200.0)
    assert np.abs(run.velocity).max() == pytest.approx(unit_orbit.peak, rel=1e-4)


def test_multiplier_is_liouvilles(unit_orbit):
    """exp of the integral of the divergence, eps (1 - u^2), over one period."""
    run = integrate(van_der_pol(1.0), (unit_orbit.peak, 0.0), duration=unit_orbit.period, rate=1.0)
    exponent, _ = quad(lambda t: 1 - run.at(t)[0][0] ** 2, 0, unit_orbit.period, limit=200, epsabs=1e-10)
    assert unit_orbit.multiplier == pytest.approx(math.exp(exponent), rel=1e-4)


def test_start_does_not_matter(unit_orbit):
    for start in (0.1, 4.0):
        orbit = periodic_orbit(van_der_pol(1.0), start=start)
        assert abs(orbit.period - unit_orbit.period) < orbit.period_error + unit_orbit.period_error


def test_refusals():
    with pytest.raises(InputError, match="no isolated limit cycle"):
        periodic_orbit(pendulum())
    with pytest.raises(InputError, match="no limit cycle found"):
        periodic_orbit(pendulum(1.0, 0.05))
    with pytest.raises(InputError, match="dies out"):
        periodic_orbit(linear(1.0, 2.0))
    with pytest.raises(InputError, match="start = -1"):
        periodic_orbit(van_der_pol(1.0), start=-1.0)
    bare = Dynamics("bare", van_der_pol(1.0).force, 1.0)
    with pytest.raises(InputError, match="no Taylor coefficients"):
        precise_orbit(bare, periodic_orbit(bare))
