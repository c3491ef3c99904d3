from __future__ import annotations

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.harmonics.local_fit import choose_multiples, harmonic_fit
from ridgeback.numeric.harmonics.window_steps import Shape, fill_linear, gauss_newton, powers, turning

RATE = 32.0
T = np.arange(321) / RATE
PHASE = 2 * np.pi * (1.2 * T + 0.02 * T**2)
OMEGA = 2 * np.pi * (1.2 + 0.04 * T)


def test_exact_where_the_model_holds_up_to_the_very_ends() -> None:
    decay = np.exp(-0.05 * T)
    x = decay * (2.0 * np.cos(PHASE + 0.4) + (0.2 + 0.01 * T) * np.cos(3 * PHASE - 1.0)) + 0.7 - 0.02 * T
    fit = harmonic_fit(x, RATE, OMEGA * 1.01, half=50, shape=Shape((3,)), start_time=5.0)
    assert np.abs(fit.omega - OMEGA).max() < 1e-7
    assert np.abs(fit.amplitude - 2.0 * decay).max() < 1e-8
    assert np.abs(fit.growth + 0.05).max() < 1e-7
    assert np.abs(fit.offset - (0.7 - 0.02 * T)).max() < 1e-8
    assert fit.settled.all()
    assert fit.valid.sum() == T.size - 100
    assert fit.time[0] == 5.0


def test_rows_that_enter_linearly_make_up_the_model() -> None:
    s, shape = np.arange(-30, 31) / 30, Shape((2,))
    phase, grown = powers(s, 3) @ np.array([0.3, 12.0, 1.0, 0.2]), np.exp(0.3 * s)
    a, b, c, d = (
        np.array([1.0, 0.1, -0.05]),
        np.array([0.2, 0.0, 0.1]),
        np.array([0.0, 0.3, 0.0]),
        np.array([0.5, -0.2]),
    )
    rows = np.empty((1, shape.size - 4, s.size))
    fill_linear(rows, turning(phase)[None], grown[None], shape, powers(s, 2))
    first, second = powers(s, 2) @ a * np.cos(phase), np.cos(2 * phase) * (powers(s, 2) @ b)
    model = grown * (first + second + np.sin(2 * phase) * (powers(s, 2) @ c)) + d[0] + d[1] * s
    assert np.abs(np.concatenate([a, b, c, d]) @ rows[0] - model).max() < 1e-14


def test_deviation_is_the_cramer_rao_bound_and_is_met() -> None:
    # For a tone of known shape the bound is computed here from the Fisher information written out, not by the module.
    half, sigma = 40, 0.1
    j = np.arange(-half, half + 1)
    w = 2 * np.pi * 1.3 / RATE
    x = np.cos(w * j)
    s = j / half
    amplitude, phase = [np.cos(w * j) * s**d for d in range(3)], [-np.sin(w * j) * s**d for d in range(4)]
    columns = np.stack([*amplitude, *phase, np.ones(j.size), s], axis=1)
    bound = sigma * np.sqrt(np.linalg.inv(columns.T @ columns)[4, 4]) * RATE / half
    rng = np.random.default_rng(11)
    trials = x + sigma * rng.normal(size=(400, j.size))
    guide = np.broadcast_to(w * j, trials.shape)
    solution = gauss_newton(s, trials, guide, Shape())
    omega = solution.p[:, 1] * RATE / half
    claimed = np.sqrt(solution.variance * solution.p_covariance[:, 1, 1]) * RATE / half
    assert np.median(claimed) == pytest.approx(bound, rel=0.05)
    assert np.std(omega) == pytest.approx(bound, rel=0.12)  # 400 trials: the spread of the spread is 3.5 %
    covered = np.mean(np.abs(omega - w * RATE) < 1.96 * claimed)
    assert 0.91 < covered < 0.98


def test_only_the_harmonics_in_the_data_are_fitted() -> None:
    rng = np.random.default_rng(4)
    x = np.cos(PHASE) + 0.2 * np.cos(3 * PHASE) + 0.05 * np.cos(4 * PHASE) + 0.01 * rng.normal(size=T.size)
    assert choose_multiples(x, RATE, OMEGA, half=50) == (3, 4)
    assert choose_multiples(np.cos(PHASE) + 0.5 * rng.normal(size=T.size), RATE, OMEGA, half=50) == ()


def test_multiples_stay_below_the_nyquist_frequency() -> None:
    x = np.cos(PHASE) + 0.2 * np.cos(3 * PHASE)
    slow = x[::8]  # 4 Hz sampling, Nyquist 2 Hz: harmonic 3 has folded back
    assert choose_multiples(slow, RATE / 8, OMEGA[::8], half=12) == ()


def test_windows_that_do_not_fit_are_refused() -> None:
    x = np.cos(PHASE)
    with pytest.raises(InputError, match="has 321 samples, the window of harmonic least squares needs 401"):
        harmonic_fit(x, RATE, OMEGA, half=200, shape=Shape())
    with pytest.raises(
        InputError,
        match=r"window of 21 samples is too short for the 21 parameters.*at least 25 samples \(0\.7812 time units\)",
    ):
        harmonic_fit(x, RATE, OMEGA, half=10, shape=Shape((3, 5)))
    with pytest.raises(InputError, match="operations, over the budget"):
        harmonic_fit(np.ones(400_000), RATE, np.ones(400_000), half=9_000, shape=Shape((3, 5)))
