"""The error that a window is expected to make, beside the plain filter over every sample."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.signal import savgol_coeffs, savgol_filter

from ridgeback.numeric.estimators import window_choice
from ridgeback.numeric.estimators.window_choice import best_window, expected_error, middle_slope
from ridgeback.numeric.harmonics.spline_fit import best_model, harmonic_splines

RATE = 32.0


@pytest.fixture(scope="module")
def model():
    t = np.arange(640) / RATE
    x = np.exp(-0.05 * t) * np.cos(2 * np.pi * (t - 0.3 * np.exp(-0.2 * t)))
    x += 0.01 * np.random.default_rng(2).normal(size=t.size)
    return best_model(harmonic_splines(x, RATE, np.full(640, 2 * np.pi)))


def over_every_sample(model, half, degree, margin):
    """Its own signal filtered whole: scipy fits the end's window where there is no room round a sample."""
    size, (omega, amplitude) = 2 * half + 1, model.tone(1)
    bias = savgol_filter(model.phase, size, degree, deriv=1, delta=1 / RATE) - omega
    response = np.linalg.norm(savgol_coeffs(size, degree, deriv=1, delta=1 / RATE))
    noise = np.sqrt(2) * model.noise * response / np.abs(amplitude)
    return np.sqrt(np.mean(((bias**2 + noise**2) / omega**2)[margin : omega.size - margin]))


@pytest.mark.parametrize("half", [16, 48, 160])
@pytest.mark.parametrize("degree", [3, 5])
def test_windows_of_every_length_are_judged_over_the_same_samples(model, half, degree, monkeypatch):
    whole = over_every_sample(model, half, degree, 32)
    assert expected_error(model, half, degree, 32) == pytest.approx(whole, rel=1e-9)
    monkeypatch.setattr(window_choice, "CENTRES", 160)
    assert expected_error(model, half, degree, 32) == pytest.approx(whole, rel=0.05)


@pytest.mark.parametrize("half", [4, 60, 1024, 3000])
def test_the_slope_in_the_middle_is_exact_for_polynomials_and_reads_the_least_noise(half):
    """In windows of thousands of samples as well, where powers of the sample's number leave no digits of degree 5."""
    s = np.arange(-half, half + 1) / half
    weights = middle_slope(half, 5) * half
    assert weights @ (2.0 + 3.0 * s - s**2 + 5.0 * s**3 + s**5) == pytest.approx(3.0, rel=1e-12)
    assert weights @ s**3 == pytest.approx(0.0, abs=1e-12)
    assert np.linalg.norm(weights) == pytest.approx(1 / np.linalg.norm(_rest(s, s, 5)), rel=1e-9)


def _rest(of, s, degree):
    """What of the first power no other power up to a degree gives: its norm is one over that of the weights."""
    others = np.stack([s**n for n in range(degree + 1) if n != 1], axis=1)
    return of - others @ np.linalg.lstsq(others, of, rcond=None)[0]


def test_a_window_holds_three_samples_for_two_parameters(monkeypatch):
    """Of degree 3 with its 9 parameters 15 samples are needed, of degree 5 with its 13 there are 21."""
    t = np.arange(200) / 6.0
    monkeypatch.setattr(window_choice, "expected_error", lambda _, half, degree, __: half - degree / 10)
    found = best_window(SimpleNamespace(time=t), 1.0, (), 0)
    assert (found.half, found.degree) == (9, 3)  # not 6, over two cycles, nor degree 5 in 19
    monkeypatch.setattr(window_choice, "expected_error", lambda _, half, degree, __: half - 10 * degree)
    found = best_window(SimpleNamespace(time=t), 1.0, (), 0)
    assert (found.half, found.degree) == (12, 5)


@pytest.mark.parametrize(("degree", "half"), [(3, 60), (5, 90)])
def test_a_window_is_half_a_cycle_for_each_power_of_the_phase(monkeypatch, degree, half):
    """Two cycles of degree 3, three of degree 5, of 60 samples each."""
    t = np.arange(2000) / 60.0
    monkeypatch.setattr(window_choice, "expected_error", lambda _, half, of, __: half + 1000 * (of != degree))
    found = best_window(SimpleNamespace(time=t), 1.0, (), 0)
    assert (found.half, found.degree) == (half, degree)
