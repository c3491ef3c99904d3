"""Energy terms and the amplitude of eq. (21): closed forms, the balance, the paper's numbers."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.numeric.motion.dynamics import helmholtz_duffing, linear, pendulum, van_der_pol
from ridgeback.numeric.motion.taylor import integrate_taylor
from ridgeback.numeric.motion.trajectory import integrate
from ridgeback.numeric.orbits.energy import (
    amplitude_from_energy,
    energy_of,
    energy_terms,
    is_linearly_damped,
)
from tests.numeric.orbits.closed_forms import pendulum_amplitude

K, THETA0 = 4 * math.pi, 0.95 * math.pi


@pytest.fixture(scope="module")
def paper():
    oscillator = pendulum(K, 0.01)
    return oscillator, integrate(oscillator, (THETA0, 0.0), duration=20.0, rate=64.0)


def test_balance_closes(paper):
    """(15) to 1e-10 of the energy scale k^2."""
    terms = energy_terms(*paper)
    assert np.abs(terms.balance).max() < 1e-10 * K**2
    assert np.all(np.diff(terms.dissipated) >= 0)
    assert np.allclose(terms.mechanical, terms.kinetic + terms.potential)


def test_what_is_left_of_the_balance_is_the_solver_not_the_quadrature():
    """With a Taylor solution it closes to rounding."""
    oscillator = pendulum(K, 0.01)
    run = integrate_taylor(oscillator, (THETA0, 0.0), duration=3.0, rate=64.0, digits=20)
    assert np.abs(energy_terms(oscillator, run).balance).max() < 3e-14 * K**2


def test_dissipation_of_the_linear_oscillator_in_closed_form():
    mu, omega = 0.1, math.sqrt(4 - 0.01)
    run = integrate(linear(2.0, mu), (1.0, 0.0), duration=10.0, rate=16.0)
    decay = np.exp(-mu * run.time)
    u = decay * (np.cos(omega * run.time) + mu / omega * np.sin(omega * run.time))
    v = -decay * 4 / omega * np.sin(omega * run.time)
    terms = energy_terms(linear(2.0, mu), run)
    assert np.allclose(terms.dissipated, 2 - 0.5 * v**2 - 2 * u**2, atol=1e-10)


def test_balance_with_an_initial_velocity_in_an_asymmetric_well():
    oscillator = helmholtz_duffing(1.0, 0.3, 0.1, 0.02)
    run = integrate(oscillator, (0.5, 1.0), duration=30.0, rate=8.0)
    terms = energy_terms(oscillator, run)
    assert np.abs(terms.balance).max() < 1e-10
    assert terms.potential[0] == 0
    assert terms.kinetic[0] == 0.5


def test_final_amplitude_of_the_papers_case(paper):
    """The paper: A(20) is about 2/3 pi; measured beforehand: 0.659 pi."""
    oscillator, run = paper
    A = pendulum_amplitude(energy_terms(oscillator, run).mechanical, k=K, theta0=THETA0)
    assert A[0] == pytest.approx(THETA0, rel=1e-14)
    assert A[-1] / math.pi == pytest.approx(0.659, abs=0.0005)
    assert oscillator.closed_form(A)[[0, -1]] / (2 * math.pi) == pytest.approx([0.798, 1.470], abs=0.0005)


def test_equation_21_agrees_with_inverting_the_potential(paper):
    oscillator, run = paper
    printed = pendulum_amplitude(energy_terms(oscillator, run).mechanical, k=K, theta0=THETA0)
    inverted = amplitude_from_energy(oscillator, energy_of(oscillator, run.u, run.velocity))
    assert np.allclose(printed, inverted.peak, rtol=1e-13)
    assert np.array_equal(inverted.trough, -inverted.peak)


def test_amplitude_passes_through_the_turning_points(paper):
    oscillator, run = paper
    u, velocity = run.at(run.turnings.time)
    A = amplitude_from_energy(oscillator, energy_of(oscillator, u, velocity)).peak
    assert np.allclose(A, np.abs(run.turnings.value), rtol=1e-9)


def test_amplitude_never_rises_and_descends_twice_per_cycle(paper):
    """dA/dt is proportional to -u'^2: steepest at the crossings, flat at the turning points."""
    oscillator, run = paper
    energy = energy_of(oscillator, run.u, run.velocity)
    A = amplitude_from_energy(oscillator, energy).peak
    assert np.all(np.diff(A) <= 1e-10)
    rate = -np.gradient(A, run.time)
    maxima = np.flatnonzero((rate[1:-1] > rate[:-2]) & (rate[1:-1] > rate[2:])) + 1
    nearest = np.abs(run.time[maxima][:, None] - run.crossings.time).min(axis=1)
    assert maxima.size == pytest.approx(run.crossings.time.size, abs=1)
    assert nearest.max() < 2 / run.rate


@settings(deadline=None, max_examples=25)
@given(alpha=st.floats(-0.3, 0.3), peak=st.floats(0.01, 2.0))
def test_both_turning_points_have_the_energy(alpha, peak):
    oscillator = helmholtz_duffing(1.0, alpha, 0.2)
    level = float(oscillator.potential(peak))
    result = amplitude_from_energy(oscillator, level)
    assert result.peak[0] == pytest.approx(peak, rel=1e-12)
    assert float(oscillator.potential(result.trough[0])) == pytest.approx(level, rel=1e-12)
    assert result.trough[0] < 0


def test_refusals():
    run = integrate(van_der_pol(0.1), (1.0, 0.0), duration=5.0, rate=8.0)
    with pytest.raises(InputError, match="has no potential"):
        energy_terms(van_der_pol(0.1), run)
    with pytest.raises(InputError, match="outside the well"):
        amplitude_from_energy(pendulum(), [2.5])
    with pytest.raises(InputError, match="would rotate"):
        pendulum_amplitude([4.0], k=1.0, theta0=1.0)


def test_the_balance_closes_for_damping_of_any_form():
    oscillator = damped(pendulum(1.0), lambda u, v: 0.02 * v + 0.03 * v**3 + 0.01 * u * u * v)
    terms = energy_terms(oscillator, integrate(oscillator, (2.0, 0.1), duration=30.0, rate=8.0))
    assert np.abs(terms.balance).max() < 1e-9
    assert not is_linearly_damped(oscillator, 2.0)
    assert is_linearly_damped(pendulum(1.0, 0.1), 2.0)


def damped(oscillator, loss):
    """The same oscillator with another damping force d(u, u')."""
    return replace(oscillator, force=lambda u, v: oscillator.force(u, v) + loss(u, v), jet=None)
