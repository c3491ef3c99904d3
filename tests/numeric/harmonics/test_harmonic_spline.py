"""The model of the whole signal against dense linear algebra, its own Fisher information, and repeated trials."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.harmonics import spline_basis as spline_basis_module
from ridgeback.numeric.harmonics.signal_model import signal_models
from ridgeback.numeric.harmonics.spline_basis import DEGREE, SplineBasis, alone, normal_equations, spline_basis
from ridgeback.numeric.harmonics.spline_fit import MUCH, Known, adapted, best_model, changing, fit_on, harmonic_splines
from ridgeback.numeric.harmonics.spline_model import SplineModel, weights_of

RATE = 32.0
T = np.arange(641) / RATE
PHASE = 2 * np.pi * (1.0 * T + 0.01 * T**2) + 0.3 * np.sin(0.4 * T)
OMEGA = 2 * np.pi * (1.0 + 0.02 * T) + 0.12 * np.cos(0.4 * T)


def values_of(basis: SplineBasis) -> Array:
    return np.concatenate([part.values.toarray() for part in basis.parts()])


def slopes_of(basis: SplineBasis) -> Array:
    return np.concatenate([part.slopes.toarray() for part in basis.parts()])


def test_a_record_in_parts_is_the_record_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    x = np.cos(PHASE) + 0.2 * np.cos(3 * PHASE - 1.0) + 0.05 * np.random.default_rng(2).normal(size=T.size)
    breaks = np.array([0.0, 4.0, 9.0, 20.03125]) * T[-1] / 20.03125

    def measured() -> tuple[Array, ...]:
        model = fit_on(x, T, PHASE, np.ones(T.size), breaks, (3,))
        change, taken = model.response(x)
        third = model.tone(3, change)
        return model.coefficients, model.omega_deviation, model.samples(keep=lambda h: h == 3), taken, *third

    whole = measured()
    monkeypatch.setattr(spline_basis_module, "ROWS", 100)
    monkeypatch.setattr(spline_basis_module, "PRODUCTS", 1)
    monkeypatch.setattr(spline_basis_module, "UNKNOWNS", 1)
    for part, at_once in zip(measured(), whole, strict=True):
        assert_allclose(part, at_once, rtol=1e-7, atol=1e-9)


@given(st.integers(0, 500), st.integers(1, 4), st.integers(1, 5))
@settings(deadline=None, max_examples=25)
def test_banded_least_squares_are_the_dense_ones(seed: int, families: int, intervals: int) -> None:
    rng = np.random.default_rng(seed)
    time, weights = np.linspace(0.0, 2.0, 160), rng.normal(size=(160, families))
    breaks = np.concatenate([[0.0], np.sort(rng.uniform(0.2, 1.8, intervals - 1)), [2.0]])
    basis = spline_basis(time, breaks)
    equations = normal_equations(basis, lambda part: weights[part.rows], families)
    dense = (values_of(basis)[:, :, None] * weights[:, None, :]).reshape(160, -1)
    x = rng.normal(size=160)
    if np.linalg.cond(dense) < 1e4:
        assert_allclose(equations.solve(x).ravel(), np.linalg.lstsq(dense, x, rcond=None)[0], rtol=1e-4, atol=1e-5)
        covariance = np.linalg.inv(dense.T @ dense)[::families, ::families]
        for rows, slopes in ((values_of(basis), False), (slopes_of(basis), True)):
            expected = np.einsum("nk,kl,nl->n", rows, covariance, rows)
            assert_allclose(equations.variance(0, slopes=slopes), expected, rtol=1e-4)


def test_slopes_are_those_of_the_splines() -> None:
    basis = spline_basis(T, np.array([0.0, 3.0, 11.0, 20.03125]) * T[-1] / 20.03125)
    assert_allclose(basis.slopes(np.ones(basis.count)), 0.0, atol=1e-10)
    p = normal_equations(basis, alone, 1).solve(T**DEGREE)[:, 0]
    assert_allclose(basis.slopes(p), DEGREE * T ** (DEGREE - 1), rtol=1e-6, atol=1e-2)


def test_exact_where_the_model_holds_up_to_the_very_ends() -> None:
    x = (2.0 - 0.05 * T) * np.cos(PHASE) + (0.2 + 0.01 * T) * np.cos(3 * PHASE - 1.0) + 0.7 - 0.02 * T
    model = best_model(harmonic_splines(x, RATE, OMEGA * 1.1, multiples=(3,)))
    assert np.abs(model.omega / OMEGA - 1.0).max() < 3e-6
    assert np.abs(model.amplitude - (2.0 - 0.05 * T)).max() < 3e-5
    third, size = model.tone(3)
    assert np.abs(third / (3.0 * OMEGA) - 1.0).max() < 1e-5
    assert np.abs(size - (0.2 + 0.01 * T)).max() < 3e-5
    assert np.abs(model.samples(keep=lambda h: h == 0) - (0.7 - 0.02 * T)).max() < 3e-5
    assert np.abs(model.samples() - x).max() < 3e-5


@given(ratio=st.floats(0.0, 0.1), phase=st.floats(0.0, 6.0), intervals=st.integers(1, 3))
@settings(deadline=None, max_examples=15)
def test_a_damped_oscillation_is_in_the_model_on_any_knots(ratio: float, phase: float, intervals: int) -> None:
    rate, omega = ratio * 2 * np.pi, 2 * np.pi
    t = T[:320]
    x = np.exp(-rate * t) * np.cos(omega * t + phase)
    guess = np.exp(-1.1 * rate * t)
    for degree in (1, DEGREE):
        model = fit_on(x, t, 1.01 * omega * t + phase, guess, np.linspace(0.0, t[-1], intervals + 1), (), degree)
        assert np.abs(model.omega / omega - 1.0).max() < 1e-5
        assert np.abs(model.growth + rate).max() < 1e-5 * omega


def test_deviation_is_the_cramer_rao_bound_and_is_met() -> None:
    # The bound is computed from the Jacobian written out in full, at the truth; the trials are fits on the same knots.
    sigma, breaks = 0.1, np.array([0.0, 7.0, 14.0, 20.0])
    phase, omega = 2 * np.pi * (1.0 * T + 0.01 * T**2), 2 * np.pi * (1.0 + 0.02 * T)
    basis = spline_basis(T, breaks)
    jacobian = (values_of(basis)[:, :, None] * weights_of(phase, np.ones(T.size), ())[:, None, :]).reshape(641, -1)
    slopes = slopes_of(basis)
    covariance = np.linalg.inv(jacobian.T @ jacobian)[2::3, 2::3]
    bound = sigma * np.sqrt(np.einsum("nk,kl,nl->n", slopes, covariance, slopes))
    found, claimed = [], []
    for seed in range(100):
        x = np.cos(phase) + sigma * np.random.default_rng(seed).normal(size=T.size)
        model = fit_on(x, T, phase, np.ones(T.size), breaks, ())
        found.append(model.omega - omega)
        claimed.append(model.omega_deviation)
    assert_allclose(np.mean(claimed, axis=0), bound, rtol=0.05)
    ratio = np.sqrt(np.mean(np.square(found), axis=0)) / bound
    assert np.sqrt(np.mean(ratio**2)) == pytest.approx(1.0, abs=0.08)


def test_a_deviation_is_the_bound_wherever_the_fit_started_and_down_into_the_noise() -> None:
    """A plain damped sine whose last third lies under the noise, by the Fisher matrix of its four parameters.

    From where it comes to rest a fit takes few steps, and what holds it firm there is no knowledge.
    """
    t, g, w, noise = np.arange(1200) / 400.0, 1.26, 125.7, 0.1
    a, phase = np.exp(-g * t), w * t + 0.4
    x = a * np.cos(phase) + noise * np.random.default_rng(3).normal(size=t.size)
    first = fit_on(x, t, phase + 0.2, 1.1 * a, t[[0, -1]], (), 1)
    again = fit_on(x, t, first.phase, first.size, t[[0, -1]], (), 1)
    even, odd = first.size * np.cos(first.phase), -first.size * np.sin(first.phase)
    columns = np.stack([even, t * even, odd, t * odd], axis=1)
    bound = first.noise * np.sqrt(np.linalg.inv(columns.T @ columns)[3, 3])
    for model in (first, again):
        assert_allclose(model.omega_deviation, bound, rtol=0.01)


def test_answer_to_noise_is_the_change_of_the_fit() -> None:
    rng = np.random.default_rng(3)
    clean, breaks = np.cos(PHASE) + 0.3 * np.cos(2 * PHASE + 0.5), np.array([0.0, 7.0, 14.0, 20.0])
    model = fit_on(clean, T, PHASE, np.ones(T.size), breaks, (2,))
    noise = 1e-5 * rng.normal(size=T.size)
    again = fit_on(model.samples() + noise, T, PHASE, np.ones(T.size), breaks, (2,))
    change, taken = model.response(noise)
    for h in (1, 2):
        for moved, predicted, before in zip(again.tone(h), model.tone(h, change), model.tone(h), strict=True):
            assert np.abs(moved - predicted).max() < 2e-2 * np.abs(moved - before).max()
    assert abs(float(taken @ (noise - taken))) < 1e-6 * float(noise @ noise)


def test_knots_go_where_the_phase_bends() -> None:
    phase = 2 * np.pi * 1.5 * T + 3.0 * np.exp(-T)
    x = np.cos(phase) + 0.001 * np.random.default_rng(5).normal(size=T.size)
    model = best_model(harmonic_splines(x, RATE, np.gradient(phase, T)))
    assert np.diff(model.breaks)[0] < 0.92 * np.diff(model.breaks)[-1]


def test_the_level_by_which_knots_are_put_rises_from_nothing() -> None:
    breaks, size = np.linspace(0.0, T[-1], 9), np.exp(-0.2 * T)
    level = adapted(fit_on(size * np.cos(PHASE), T, PHASE, size, breaks, ()))
    assert level[0] == 0.0
    assert level[-1] == pytest.approx(1.0, rel=1e-9)
    assert np.all(np.diff(level) > 0.0)


def test_a_swell_before_a_decay_gets_knots_of_its_own() -> None:
    """Risen in six cycles and fallen in forty: on knots even in cycles the best model needs one every two to three."""
    t = np.arange(1600) / 400.0
    size = (1.02 - np.exp(-t / 0.3)) * np.exp(-2.0 * t)
    x = size / size.max() * np.cos(125.7 * t) + 0.004 * np.random.default_rng(1).normal(size=t.size)
    best = best_model(harmonic_splines(x, 400.0, np.full(t.size, 125.7)))
    assert best.cycles > 5.0
    assert np.mean(np.diff(best.breaks)[:3]) < 0.7 * np.mean(np.diff(best.breaks))


@pytest.mark.parametrize("fall", [0.1, 0.5, 8.0])
def test_a_fall_of_the_amplitude_counts_as_much_as_it_is_large(fall: float) -> None:
    """Beside the cycles, whose share is 1, by the square of the fall as far as that is not MUCH."""
    found = changing(PHASE, np.exp(-fall * T / T[-1]))
    assert found[0] == 0.0
    assert found[-1] == pytest.approx(1.0 + min(1.0, fall / MUCH) ** 2)


def test_another_unit_adds_its_logarithm_to_the_criterion() -> None:
    """n log(unit^2), also where nothing but rounding is left."""
    breaks, wave, size = np.linspace(0.0, T[-1], 9), np.cos(2 * np.pi * T), np.ones(T.size)
    less, same, more = (fit_on(c * wave, T, 2 * np.pi * T, c * size, breaks, ()).criterion for c in (1e-9, 1.0, 1e9))
    assert more - same == pytest.approx(same - less, rel=0.02)
    assert more - same > 100 * math.log(1e18)


def test_samples_that_are_no_sound_ones_change_nothing() -> None:
    breaks, x = np.linspace(0.0, T[-1], 9), np.cos(PHASE) + 0.01 * np.random.default_rng(5).normal(size=T.size)
    wrong, sound = x.copy(), np.ones(T.size)
    wrong[200:215], sound[200:215] = 1e3, 0.0
    found = [fit_on(y, T, PHASE, np.ones(T.size), breaks, (), known=Known(sound=sound)) for y in (x, wrong)]
    assert np.array_equal(found[0].coefficients, found[1].coefficients)
    assert np.abs(found[0].omega / OMEGA - 1.0).max() < 0.03


def test_an_amplitude_is_clear_at_five_of_its_deviations() -> None:
    for deviation, clear in ((0.19, True), (0.21, False)):
        model: Any = SimpleNamespace(
            band_noise=1.0, equations=SimpleNamespace(variance=lambda _, d=deviation: d**2 + np.zeros(3))
        )
        assert SplineModel.clear.func(model) is clear


def test_more_noise_asks_for_fewer_knots() -> None:
    rng = np.random.default_rng(9)
    noise = rng.normal(size=T.size)
    x = np.cos(PHASE + np.sin(T))
    fine, rough = (best_model(harmonic_splines(x + s * noise, RATE, OMEGA)) for s in (1e-3, 0.3))
    assert fine.cycles < rough.cycles


def test_harmonics_of_the_data_are_found_and_steps_kept() -> None:
    x = np.cos(PHASE) + 0.1 * np.cos(3 * PHASE) + 0.02 * np.random.default_rng(2).normal(size=T.size)
    models = signal_models(x, RATE, OMEGA, half=40)
    assert models.best.multiples == (3,)
    assert models.coarse.parameters < models.best.parameters <= models.fine.parameters
    assert models.coarse.criterion <= min(models.best.criterion, models.fine.criterion)
    assert 0.0 < models.remainder < 0.2
    with pytest.raises(InputError, match=r"harmonic 2 is not in the model of the signal; it holds \(1, 3\)"):
        models.fine.tone(2)


def test_what_no_model_fits_is_said() -> None:
    with pytest.raises(InputError, match="cycles in 40 samples; a model of all of it with 3 splines needs"):
        harmonic_splines(np.cos(PHASE[:40]), RATE, OMEGA[:40])
    with pytest.raises(InputError, match="operations, over the budget"):
        harmonic_splines(np.ones(5_000_000), RATE, np.ones(5_000_000), multiples=(2, 3, 4, 5))
