"""Dynamics: the force, its mpmath twin, the potential and the Taylor coefficients say the same thing."""

import math

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.numeric.motion import dynamics as dyn
from ridgeback.numeric.motion.roots import bracketed_newton

OSCILLATORS = [
    dyn.linear(2.0, 0.1),
    dyn.pendulum(1.7, 0.03),
    dyn.duffing(1.2, -0.4, 0.02),
    dyn.helmholtz_duffing(1.0, 0.3, 0.2, 0.01),
    dyn.van_der_pol(0.8),
    dyn.rayleigh(0.8),
]
NAMES = [d.name for d in OSCILLATORS]
STATE = st.tuples(st.floats(-2, 2), st.floats(-2, 2))


@pytest.mark.parametrize("oscillator", OSCILLATORS, ids=NAMES)
@settings(deadline=None, max_examples=20)
@given(state=STATE)
def test_force_agrees_with_its_precise_twin(oscillator, state):
    u, v = state
    with mp.workdps(30):
        exact = oscillator.precise_force(mp.mpf(u), mp.mpf(v))
        scale = 1 + abs(u) ** 3 + abs(v) ** 3
        assert abs(exact - oscillator.force(u, v)) < 1e-14 * scale


@pytest.mark.parametrize("oscillator", OSCILLATORS, ids=NAMES)
def test_jet_satisfies_the_equation_to_its_order(oscillator):
    """u'' + f(u, u') of the truncated series, expanded by mpmath, vanishes through degree - 2."""
    degree = 12
    with mp.workdps(60):
        c = oscillator.jet(mp.mpf("0.7"), mp.mpf("-0.4"), degree)
        assert len(c) == degree + 1

        def residual(t):
            u = mp.polyval(c[::-1], t)
            v = mp.polyval([j * c[j] for j in range(degree, 0, -1)], t)
            a = mp.polyval([j * (j - 1) * c[j] for j in range(degree, 1, -1)], t)
            return a + oscillator.precise_force(u, v)

        small = mp.mpf("1e-3")
        ratio = residual(small) / residual(small / 2)
        assert abs(mp.log(abs(ratio), 2) - (degree - 1)) < 0.05


@pytest.mark.parametrize("oscillator", [d for d in OSCILLATORS if d.potential], ids=lambda d: d.name)
def test_restoring_is_the_slope_of_the_potential_and_part_of_the_force(oscillator):
    u = np.linspace(-1.2, 1.2, 25)
    step = 1e-4
    slope = (
        oscillator.potential(u - 2 * step)
        - 8 * oscillator.potential(u - step)
        + 8 * oscillator.potential(u + step)
        - oscillator.potential(u + 2 * step)
    ) / (12 * step)
    assert np.allclose(slope, oscillator.restoring(u), atol=1e-10)
    assert np.allclose([oscillator.force(x, 0.0) for x in u], oscillator.restoring(u), rtol=1e-14, atol=1e-15)
    assert oscillator.force(0.0, 1.0) == pytest.approx(2 * oscillator.damping, abs=1e-16)
    assert oscillator.potential(0.0) == 0
    assert oscillator.restoring(1e-7) / 1e-7 == pytest.approx(oscillator.natural_frequency**2, rel=1e-6)


def test_agm_against_mpmath_and_nan_outside():
    b = np.array([1e-12, 0.3, 1.0, 40.0])
    exact = [float(mp.agm(1, x)) for x in b]
    assert np.allclose(dyn.agm(1.0, b), exact, rtol=5e-16)
    assert np.isnan(dyn.agm(1.0, -0.1))


def test_closed_forms_are_nan_where_nothing_oscillates():
    assert np.isnan(dyn.pendulum().closed_form(3.2))
    assert np.isnan(dyn.duffing(eps=-1.0).closed_form(1.1))


@pytest.mark.parametrize(
    ("oscillator", "ends"),
    [
        (dyn.pendulum(), (-math.pi, math.pi)),
        (dyn.duffing(eps=-0.5), (-math.sqrt(2), math.sqrt(2))),
        (dyn.helmholtz_duffing(1.0, 0.5, 0.0), (-2.0, math.inf)),
    ],
)
def test_ends_of_wells_are_right_to_the_last_digit(oscillator, ends):
    for found, end in zip(dyn.well(oscillator), ends, strict=True):
        assert found == end or abs(found - end) <= math.ulp(end)


def test_well_ends_at_the_nearest_equilibria():
    assert dyn.well(dyn.pendulum()) == pytest.approx((-math.pi, math.pi), rel=1e-14)
    assert dyn.well(dyn.duffing(eps=-0.25)) == pytest.approx((-2.0, 2.0), rel=1e-14)
    left, right = dyn.well(dyn.helmholtz_duffing(1.0, 3.0, 2.0))  # (u + 1)(2 u + 1) u
    assert (left, right) == (pytest.approx(-0.5, rel=1e-13), math.inf)
    assert dyn.well(dyn.van_der_pol(1.0)) == (-math.inf, math.inf)


def test_well_refuses_an_unstable_origin():
    upside_down = dyn.Dynamics("upside-down", lambda u, v: v - u, 1.0, restoring=lambda u: -np.asarray(u))
    with pytest.raises(InputError, match="does not restore"):
        dyn.well(upside_down)


@pytest.mark.parametrize("build", [lambda: dyn.pendulum(k=0.0), lambda: dyn.pendulum(mu=math.nan)])
def test_bad_parameters_are_named(build):
    with pytest.raises(InputError, match="must be finite"):
        build()


@pytest.mark.parametrize("coefficients", [(), (-1.0,), (1.0, math.inf)])
def test_polynomial_refuses_unusable_coefficients(coefficients):
    with pytest.raises(InputError, match="start with a positive one"):
        dyn.polynomial(coefficients)


@settings(deadline=None, max_examples=50)
@given(target=st.floats(-0.999, 0.999), power=st.sampled_from([1, 3, 5]), sign=st.sampled_from([-1.0, 1.0]))
def test_bracketed_newton_inverts_monotone_functions(target, power, sign):
    def function(x):
        return sign * (x**power + x - 2 * target), sign * (power * x ** (power - 1) + 1)

    root = bracketed_newton(function, np.array([-3.0]), np.array([2.0]))[0]
    assert root**power + root == pytest.approx(2 * target, abs=1e-14)


def test_a_pendulum_that_turns_over_has_no_frequency_however_large_its_amplitude():
    assert np.isnan(dyn.pendulum(2.0).closed_form([4.0, 10.0, 25.0])).all()  # cos(5) is positive again
