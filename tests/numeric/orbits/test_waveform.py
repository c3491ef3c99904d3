"""Phase on the orbit and Fourier coefficients of the undamped motion."""

import math

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.numeric.motion.dynamics import helmholtz_duffing, linear, pendulum
from ridgeback.numeric.motion.trajectory import integrate
from ridgeback.numeric.orbits.waveform import orbit_harmonics, orbit_position
from tests.numeric.orbits.closed_forms import pendulum_harmonics


@settings(deadline=None, max_examples=25)
@given(k=st.floats(0.3, 20), peak=st.floats(0.01, 5), phase=st.floats(-3.1, 3.1))
def test_position_on_the_linear_orbit(k, peak, phase):
    """Phase, action and excess in closed form: X = -(A^2 k / 4) sin(2 phi)."""
    place = orbit_position(linear(k), peak * math.cos(phase), -k * peak * math.sin(phase))
    assert place.peak == pytest.approx(peak, rel=1e-12)
    assert place.phase == pytest.approx(phase, abs=1e-7)
    assert place.action == pytest.approx(0.5 * k * peak**2, rel=1e-12)
    assert place.excess == pytest.approx(-0.25 * k * peak**2 * math.sin(2 * phase), abs=1e-6 * k * peak**2)


@pytest.mark.parametrize("start", [(1.0, 2.0), (-1.2, 0.5), (0.3, -1.9), (2.9, 0.0), (-2.9, 0.0)])
@pytest.mark.parametrize("oscillator", [pendulum(1.3), helmholtz_duffing(1.0, 0.2, 0.3)], ids=lambda d: d.name)
def test_position_against_integration(oscillator, start):
    """From the state, the next peak comes when the phase is complete."""
    place = orbit_position(oscillator, *start)
    run = integrate(oscillator, start, duration=12.0, rate=4.0, rtol=1e-13)
    peaks = run.turnings.time[run.turnings.value > 0]
    assert run.turnings.value.max() == pytest.approx(place.peak, rel=1e-10)
    remaining = (-place.phase) % (2 * math.pi) / place.omega
    assert min(abs(peaks - remaining)) < 1e-9


def test_rest_is_refused():
    with pytest.raises(InputError, match="no phase"):
        orbit_position(pendulum(), 0.0, 0.0)
    with pytest.raises(InputError, match="outside the well"):
        orbit_position(pendulum(), 0.0, 2.1)


@pytest.mark.parametrize("peak", [1e-3, 1.0, 0.95 * math.pi, 3.14])
def test_pendulum_coefficients_by_quadrature_and_by_the_nome(peak):
    """Two independent routes, and the nome expansion evaluated by mpmath."""
    cosine = orbit_harmonics(pendulum(2.0), peak, count=15).cosine[:, 0]
    assert np.allclose(cosine, pendulum_harmonics(peak, count=15)[:, 0], rtol=0, atol=1e-14)
    with mp.workdps(30):
        q = mp.qfrom(k=mp.sin(mp.mpf(peak) / 2))
        exact = [float(8 * (-1) ** n * q ** (n + 0.5) / ((2 * n + 1) * (1 + q ** (2 * n + 1)))) for n in range(8)]
    assert np.allclose(cosine[1::2], exact, rtol=0, atol=2e-14)


def test_coefficients_of_an_asymmetric_orbit_against_integration():
    """The slow twin: integrate one period and take the discrete Fourier transform."""
    oscillator = helmholtz_duffing(1.0, 0.3, 0.1)
    place = orbit_position(oscillator, 1.5, 0.0)
    period, n = 2 * math.pi / place.omega, 64
    run = integrate(oscillator, (1.5, 0.0), duration=period * 1.01, rate=1.0, rtol=1e-13)
    u, _ = run.at(np.arange(n) * period / n)
    transform = np.fft.rfft(u).real / n
    transform[1:] *= 2
    cosine = orbit_harmonics(oscillator, 1.5, count=8).cosine[:, 0]
    assert np.allclose(cosine, transform[:9], atol=1e-11)
    assert cosine[0] < -0.1  # the drift of a well that is softer on the left


@settings(deadline=None, max_examples=20)
@given(peak=st.floats(0.01, 3.0))
def test_sum_of_the_harmonics_is_the_peak_and_parseval_the_action(peak):
    """At phi = 0, u = A; and J = omega0 times the sum of m^2 a_m^2 / 2."""
    m = np.arange(121)
    result = orbit_harmonics(pendulum(1.0), peak, count=120)
    place = orbit_position(pendulum(1.0), peak, 0.0)
    assert result.cosine[:, 0].sum() == pytest.approx(peak, rel=1e-9)
    assert place.omega * 0.5 * np.sum((m * result.cosine[:, 0]) ** 2) == pytest.approx(place.action, rel=1e-9)
    assert result.error < 1e-12


def test_harmonics_of_rest_are_zero_and_counts_are_checked():
    assert not orbit_harmonics(pendulum(), [0.0], count=3).cosine.any()
    with pytest.raises(InputError, match="harmonic count 0"):
        orbit_harmonics(pendulum(), [1.0], count=0)
