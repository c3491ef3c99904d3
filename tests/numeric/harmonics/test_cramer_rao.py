"""The Cramer-Rao bound against closed forms, an independent Fisher matrix, and an estimator that attains it."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.numeric.harmonics.cramer_rao import Order, deviation, local_bound
from ridgeback.numeric.harmonics.harmonic_signal import HarmonicSignal, decompose
from ridgeback.numeric.harmonics.local_fit import harmonic_fit
from ridgeback.numeric.harmonics.window_steps import Shape

NOISE = 0.1


def tone(samples: int, omega: float = 0.7, amplitude: float = 1.0, rate: float = 1.0) -> HarmonicSignal:
    phase = 0.4 + omega * np.arange(samples) / rate
    flat = np.zeros((1, samples))
    return HarmonicSignal(rate, phase, np.full(samples, omega), (1,), flat + amplitude, flat, np.zeros(samples))


def chirp(samples: int = 300, rate: float = 20.0) -> HarmonicSignal:
    """Three harmonics with amplitudes and phases of their own, the frequency rising from 1.2 to 1.8 Hz."""
    t = np.arange(samples) / rate
    omega = 2 * np.pi * (1.2 + 0.04 * t)
    phase = 2 * np.pi * (1.2 * t + 0.02 * t**2)
    cosine = np.stack([1.0 - 0.02 * t, 0.1 + 0 * t, 0.15 * np.exp(-0.05 * t)])
    sine = np.stack([0 * t, 0.05 + 0.001 * t, -0.1 + 0 * t])
    return HarmonicSignal(rate, phase, omega, (1, 2, 3), cosine, sine, 0.2 + 0 * t)


def central(signal: HarmonicSignal, half: int, order: Order) -> float:
    centre = signal.phase.size // 2
    return float(local_bound(signal, NOISE, half=half, order=order, centres=np.array([centre]))[0])


@pytest.mark.parametrize(("amplitude", "rate"), [(1.0, 1.0), (3.0, 25.0)])
def test_single_tone_tends_to_the_closed_form(amplitude: float, rate: float) -> None:
    """Rife and Boorstyn 1974: var omega >= 12 sigma^2 rate^2 / (A^2/2 N (N^2 - 1)); the real tone differs by O(1/N)."""
    plain = Order(phase_degree=1, amplitude_degree=0, drift_degree=0)
    for half in (50, 200, 800):
        n = 2 * half + 1
        closed = NOISE * rate * np.sqrt(12 / (0.5 * amplitude**2 * n * (n * n - 1)))
        assert abs(central(tone(n, 0.7 * rate, amplitude, rate), half, plain) / closed - 1) < 1.5 / n


# Continuous limit: var d phi/ds = (2 sigma^2 / A^2 n) sum_j (2 j + 1) P_j'(s)^2 over Legendre polynomials.
@pytest.mark.parametrize(
    ("degree", "centre", "end"), [(1, 3.0, 3.0), (2, 3.0, 48.0), (3, 18.75, 300.0), (4, 18.75, 1200.0)]
)
def test_polynomial_phase_in_the_closed_form(degree: int, centre: float, end: float) -> None:
    half = 4000
    order = Order(phase_degree=degree, amplitude_degree=0, drift_degree=0)
    bound = local_bound(tone(2 * half + 1), NOISE, half=half, order=order, centres=np.array([half, 2 * half]))
    closed = NOISE / half * np.sqrt(2 / (2 * half + 1) * np.array([centre, end]))
    np.testing.assert_allclose(bound, closed, rtol=4e-3)


def test_fisher_matrix_by_finite_differences() -> None:
    """The bound of a whole window from x(theta) itself, without Legendre polynomials or QR."""
    signal, half = chirp(201), 100
    s = np.linspace(-1, 1, 201)
    order = Order((2, 3), phase_degree=3, amplitude_degree=1, harmonic_degree=0, drift_degree=1)

    def samples(theta: np.ndarray) -> np.ndarray:
        shift, factor, b2, c2, b3, c3, drift = np.split(theta, [4, 6, 7, 8, 9, 10])
        phase = signal.phase + np.polynomial.polynomial.polyval(s, shift)
        x = (signal.cosine[0] + np.polynomial.polynomial.polyval(s, factor)) * np.cos(phase)
        x = x + (signal.cosine[1] + b2) * np.cos(2 * phase) + (signal.sine[1] + c2) * np.sin(2 * phase)
        x = x + (signal.cosine[2] + b3) * np.cos(3 * phase) + (signal.sine[2] + c3) * np.sin(3 * phase)
        return np.asarray(x + np.polynomial.polynomial.polyval(s, drift))

    step = 1e-5
    jacobian = np.stack(
        [(samples(step * row) - samples(-step * row)) / (2 * step) for row in np.eye(order.size)], axis=1
    )
    covariance = NOISE**2 * np.linalg.inv(jacobian.T @ jacobian)
    at = np.array([0.0, 1.0])
    gradient = np.stack([np.zeros(2), np.ones(2), 2 * at, 3 * at**2], axis=1) * signal.rate / half
    expected = np.sqrt(np.einsum("wp,pq,wq->w", gradient, covariance[:4, :4], gradient))
    # s runs over one window only, so that its centre and its end are sample 100 and sample 200.
    bound = local_bound(signal, NOISE, half=half, order=order, centres=np.array([100, 200]))
    np.testing.assert_allclose(bound, expected, rtol=1e-6)


def test_three_samples_are_a_window_and_one_is_none() -> None:
    """Phase, its slope and a constant amplitude from as many samples."""
    phase = 0.7 * np.arange(201.0) + 0.3
    none = np.zeros((1, 201))
    signal = HarmonicSignal(8.0, phase, np.full(201, 5.6), (1,), none + 1.0, none, none[0])
    shape = Order(phase_degree=1, amplitude_degree=0, drift_degree=-1)
    bound = local_bound(signal, NOISE, half=1, order=shape, centres=np.array([100]))
    s, here = np.array([-1.0, 0.0, 1.0]), phase[99:102]
    columns = np.stack([np.sin(here), s * np.sin(here), np.cos(here)], axis=1)
    expected = NOISE * signal.rate * np.sqrt(np.linalg.inv(columns.T @ columns)[1, 1])
    assert float(bound[0]) == pytest.approx(expected, rel=1e-6)
    with pytest.raises(InputError, match="window of 1 samples does not fit a signal of 201; use 3 to 201"):
        local_bound(signal, NOISE, half=0, order=shape)


def test_harmonics_tied_to_the_phase_add_what_they_know() -> None:
    """With constant amplitudes locked to the phase the information is that of sum h^2 a_h^2; free ones hide it."""
    n, half = 801, 400
    phase, one = 0.3 + 0.2 * np.arange(n), np.ones(n)
    signal = HarmonicSignal(1.0, phase, 0.2 * one, (1, 3), np.stack([one, 0.5 * one]), np.zeros((2, n)), 0 * one)
    alone = central(tone(n, 0.2), half, Order(phase_degree=2, amplitude_degree=0, drift_degree=0))
    locked = central(signal, half, Order((3,), 2, 0, harmonic_degree=0, drift_degree=0))
    free = central(signal, half, Order((3,), 2, 0, harmonic_degree=2, drift_degree=0))
    assert locked / alone == pytest.approx(1 / np.sqrt(1 + 9 * 0.25), rel=0.01)
    assert free / alone == pytest.approx(1.0, rel=0.01)


@settings(deadline=None, max_examples=15)
@given(degree=st.integers(1, 4), amplitude=st.integers(0, 3), more=st.sampled_from(["phase", "amplitude", "harmonic"]))
def test_more_parameters_never_lower_the_bound(degree: int, amplitude: int, more: str) -> None:
    signal = chirp()
    small = Order((), degree, amplitude)
    large = {
        "phase": Order((), degree + 1, amplitude),
        "amplitude": Order((), degree, amplitude + 1),
        "harmonic": Order((2,), degree, amplitude),
    }[more]
    centres = np.array([0, 60, 150, 299])
    fewer = local_bound(signal, NOISE, half=60, order=small, centres=centres)
    assert np.all(local_bound(signal, NOISE, half=60, order=large, centres=centres) >= fewer * (1 - 1e-9))


def test_harmonic_least_squares_attains_the_bound() -> None:
    """Its own deviation, at vanishing noise, is the bound of the same orders in the same windows."""
    signal = tone(200)
    noise = 1e-6
    x = signal.values() + noise * np.random.default_rng(1).standard_normal(200)
    fit = harmonic_fit(x, 1.0, np.full(200, 0.7), half=60, shape=Shape())
    bound = local_bound(signal, 1.0, half=60, order=Order())
    np.testing.assert_allclose(fit.standard_deviation / fit.noise, bound, rtol=1e-3)


def test_decomposition_gives_the_harmonics_back() -> None:
    signal = chirp()
    found = decompose(signal.values(), signal.omega * 1.01, signal.rate, multiples=(1, 2, 3))
    np.testing.assert_allclose(found.values(), signal.values(), atol=2e-4)
    np.testing.assert_allclose(found.omega[20:-20], signal.omega[20:-20], rtol=1e-3)
    np.testing.assert_allclose(found.cosine[:, 20:-20], signal.cosine[:, 20:-20], atol=2e-3)
    np.testing.assert_allclose(np.gradient(found.phase, 1 / found.rate)[5:-5], found.omega[5:-5], rtol=2e-3)


def test_what_cannot_be_bounded_is_refused() -> None:
    signal = tone(50)
    with pytest.raises(InputError, match="does not fit a signal of 50"):
        local_bound(signal, NOISE, half=40, order=Order())
    with pytest.raises(InputError, match="too short for the 45 parameters"):
        local_bound(signal, NOISE, half=20, order=Order((2, 3, 4, 5, 6, 7)))
    with pytest.raises(InputError, match="two of its parts look alike"):
        local_bound(tone(50, np.pi / 2), NOISE, half=20, order=Order((3,)))  # 3 omega aliases onto omega
    with pytest.raises(InputError, match="has no effect"):
        deviation(np.array([[1.0, 0.0], [1.0, 0.0]]), np.array([[1.0]]))
    with pytest.raises(InputError, match="do not begin with the fundamental"):
        decompose(np.ones(50), np.ones(50), 1.0, multiples=(2,))
    with pytest.raises(InputError, match=r"signal spans 0\.78 cycles; "):
        decompose(np.ones(50), np.full(50, 0.1), 1.0)
