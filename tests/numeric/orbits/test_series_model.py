"""The paper's series, phase, one-component and multicomponent models."""

import math
import re
from fractions import Fraction
from itertools import pairwise

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.numeric.motion.dynamics import helmholtz_duffing, pendulum, pendulum_frequency
from ridgeback.numeric.motion.trajectory import integrate
from ridgeback.numeric.orbits.averaging import averaged_decay
from ridgeback.numeric.orbits.paper_model import (
    modulus,
    multicomponent_model,
    phase_of_samples,
    series_coefficients,
    series_frequency,
    series_period,
    simple_model,
    slope_of_samples,
)
from tests.numeric.orbits.closed_forms import pendulum_harmonics

K = 4 * math.pi


def test_coefficients_as_the_paper_prints_them():
    assert series_coefficients(3) == (1, Fraction(1, 2) ** 2, Fraction(1 * 3, 2 * 4) ** 2)


def test_long_coefficients_are_the_rounded_exact_ones():
    """Beyond 64 terms they come from their ratio; the exact rationals are the slow twin."""
    peak = np.array([2.0, 3.0])
    z2 = [mp.sin(mp.mpf(float(A)) / 2) ** 2 for A in peak]
    with mp.workdps(30):
        exact = [
            sum(mp.mpf(c.numerator) / c.denominator * x**n for n, c in enumerate(series_coefficients(300))) for x in z2
        ]
        period = [float(2 * mp.pi * e) for e in exact]
    assert np.allclose(series_period(peak, k=1.0, terms=300), period, rtol=1e-13)


@settings(deadline=None, max_examples=20)
@given(peak=st.floats(0.0, 2.0), k=st.floats(0.1, 30))
def test_series_sums_to_the_closed_form_from_above(peak, k):
    exact = float(pendulum_frequency(peak, scale=k))
    partial = [series_frequency(peak, k=k, terms=n)[0] for n in (1, 3, 10, 200)]
    assert partial[0] == pytest.approx(k, rel=1e-15)
    assert all(a >= b * (1 - 1e-15) for a, b in pairwise(partial))
    assert partial[-1] == pytest.approx(exact, rel=1e-14)


def test_truncation_error_falls_like_z_to_the_2n():
    """Leading omitted term: relative error about c_n z^(2n) / (1 - z^2)."""
    peak = 2.0
    z2 = modulus(peak)[0] ** 2
    exact = float(pendulum_frequency(peak))
    errors = [series_frequency(peak, k=1.0, terms=n)[0] / exact - 1 for n in (20, 30)]
    assert math.log(errors[1] / errors[0]) / 10 == pytest.approx(math.log(z2), rel=0.15)


def test_closed_form_at_mpmath_precision():
    with mp.workdps(30):
        exact = [float(3 * mp.pi / (2 * mp.ellipk(mp.sin(mp.mpf(A) / 2) ** 2))) for A in (0.1, 2.0, 3.14)]
    assert np.allclose(pendulum_frequency([0.1, 2.0, 3.14], scale=3.0), exact, rtol=1e-15)


def test_phase_to_1e_9_and_better():
    t = np.linspace(0, 20, 1281)
    smooth = phase_of_samples(t, 2 + np.cos(t))
    assert np.abs(smooth - 2 * t - np.sin(t)).max() < 1e-9


def test_phase_of_samples_is_of_sixth_order():
    errors = []
    for n in (41, 81):
        t = np.linspace(0, 4, n)
        errors.append(np.abs(phase_of_samples(t, np.cos(3 * t)) - np.sin(3 * t) / 3).max())
    assert math.log2(errors[0] / errors[1]) == pytest.approx(6, abs=0.8)


def test_six_samples_carry_a_polynomial_of_degree_five_and_five_do_not() -> None:
    t = np.array([0.0, 0.3, 0.5, 1.1, 1.2, 2.0])
    assert np.allclose(phase_of_samples(t, 6 * t**5 - t), t**6 - 0.5 * t**2, atol=1e-12)
    assert np.allclose(slope_of_samples(t, t**5), 5 * t**4, atol=1e-9)
    for times, omega in ((t[:5], t[:5]), (t, t[:5]), (t[:, None], t[:, None])):
        with pytest.raises(InputError, match=re.escape(f"got shapes {times.shape} and {omega.shape}")):
            phase_of_samples(times, omega)


def test_phase_of_the_averaged_decay_two_ways():
    """By quadrature of the frequency between the samples, and from the samples alone."""
    oscillator, start = pendulum(K, 0.01), (0.95 * math.pi, 0.0)
    t = np.arange(257) / 64

    def omega(x):
        return averaged_decay(oscillator, start, x).omega

    x, w = np.polynomial.legendre.leggauss(8)
    points = t[:-1, None] + 0.5 * (1 + x) * np.diff(t)[:, None]
    pieces = 0.5 * np.diff(t) * (omega(points.ravel()).reshape(points.shape) @ w)
    phase = np.concatenate([[0.0], np.cumsum(pieces)])
    assert np.abs(phase - phase_of_samples(t, omega(t))).max() < 1e-9


def test_slope_of_samples():
    t = np.linspace(0, 2, 101)
    assert np.allclose(slope_of_samples(t, np.exp(-t)), -np.exp(-t), atol=1e-8)


def test_simple_model_is_the_real_part_of_equation_22():
    t = np.linspace(0, 1, 11)
    model = simple_model(t, 2 - t, np.full(11, 3.0), 3 * t)
    assert np.allclose(model.signal, ((2 - t) * np.exp(3j * t)).real)
    with pytest.raises(InputError, match="one length"):
        simple_model(t, t[:5], t, t)


@pytest.mark.parametrize("oscillator", [pendulum(2.0), helmholtz_duffing(1.0, 0.3, 0.1)], ids=lambda d: d.name)
def test_multicomponent_model_of_undamped_motion_is_the_motion(oscillator):
    run = integrate(oscillator, (2.0, 0.0), duration=20.0, rate=10.0, rtol=1e-13)
    decay = averaged_decay(oscillator, (2.0, 0.0), run.time)
    model = multicomponent_model(oscillator, run.time, decay.peak, decay.omega, decay.omega * run.time, count=25)
    assert np.abs(model.signal - run.u).max() < 1e-9


@pytest.fixture(scope="module")
def paper():
    oscillator = pendulum(K, 0.01)
    run = integrate(oscillator, (0.95 * math.pi, 0.0), duration=20.0, rate=64.0)
    decay = averaged_decay(oscillator, run.initial, run.time)
    return oscillator, run, decay, phase_of_samples(run.time, decay.omega)


def relative_rms(model, signal):
    return float(np.sqrt(np.mean((model - signal) ** 2) / np.mean(signal**2)))


def test_more_components_describe_the_paper_case_better(paper):
    oscillator, run, decay, phase = paper
    single = simple_model(run.time, decay.peak, decay.omega, phase)
    errors = [
        relative_rms(multicomponent_model(oscillator, run.time, decay.peak, decay.omega, phase, count=n).signal, run.u)
        for n in (1, 3, 9)
    ]
    assert errors[2] < errors[1] < errors[0] < relative_rms(single.signal, run.u) < 0.15
    assert errors[2] < 0.06  # what is left is the phase: 1e-4 of 156 rad and the start near the separatrix


def test_harmonics_are_multiples_with_multiple_slopes(paper):
    """(24) and (25); even ones are absent in the pendulum."""
    oscillator, run, decay, phase = paper
    model = multicomponent_model(oscillator, run.time, decay.peak, decay.omega, phase, count=5)
    third = model.components[2]
    assert third.multiple == 3
    assert np.allclose(third.omega, 3 * decay.omega, rtol=1e-15)
    assert np.allclose(third.slope, np.gradient(third.omega, run.time), rtol=0.05)
    assert np.abs(model.components[1].amplitude).max() < 1e-13
    assert np.abs(model.offset).max() < 1e-13
    assert np.allclose(third.amplitude, pendulum_harmonics(decay.peak, count=3)[3], atol=1e-13)


def test_nome_series_at_small_amplitude():
    """theta = A cos + (A^3 / 192) (cos - cos 3) + O(A^5), the Lindstedt-Poincare solution."""
    A = 0.01
    table = pendulum_harmonics(A, count=3)[:, 0]
    assert table[1] == pytest.approx(A + A**3 / 192, rel=1e-8)
    assert table[3] == pytest.approx(-(A**3) / 192, rel=1e-3)
    assert not pendulum_harmonics(0.0).any()


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: series_frequency(math.pi, k=1.0, terms=3), "0 <= A < pi"),
        (lambda: series_frequency(math.nan, k=1.0, terms=3), "0 <= A < pi"),
        (lambda: series_frequency(1.0, k=1.0, terms=0), "0 terms"),
        (lambda: series_coefficients(5000), "5000 terms"),
        (lambda: phase_of_samples([0.0, 1.0], [1.0, 1.0]), "6 or more"),
        (lambda: phase_of_samples(np.arange(7.0), [math.nan] * 7), "finite"),
        (lambda: multicomponent_model(pendulum(), np.arange(7.0), [1.0], np.ones(7), np.ones(7)), "one length"),
    ],
)
def test_refusals(call, message):
    with pytest.raises(InputError, match=message):
        call()
