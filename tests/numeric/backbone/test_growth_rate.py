"""The 95 % intervals of growth rate and amplitude hold the truth; the wide trial is benchmarks/growth_rate.py."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.numeric.backbone.backbone import backbone
from ridgeback.numeric.backbone.curve import Backbone
from ridgeback.numeric.backbone.damping import damping
from ridgeback.numeric.backbone.local_rates import rows
from ridgeback.numeric.backbone.windows import furthest, half_widths
from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.harmonics.local_fit import Shape, harmonic_fit

RATE, OMEGA, NOISE = 400.0, 40 * np.pi, 0.01


def damped(ratio: float, cycles: float, seed: int) -> np.ndarray:
    t = np.arange(int(cycles / 20.0 * RATE)) / RATE
    rng = np.random.default_rng(seed)
    clean = np.exp(-ratio * OMEGA * t) * np.cos(OMEGA * t + rng.uniform(0, 6))
    return np.asarray(clean + NOISE * rng.normal(size=t.size))


def dragged(a: np.ndarray | float) -> np.ndarray | float:
    """a'/a of quadratic drag beside viscous damping."""
    return -(0.6 + 8.0 * a)


def drag(seed: int) -> np.ndarray:
    t = np.arange(800) / RATE
    rng = np.random.default_rng(seed)
    a = 0.6 / (8.6 * np.exp(0.6 * t) - 8.0)
    return np.asarray(a * np.cos(OMEGA * t + rng.uniform(0, 6)) + 0.3 * NOISE * rng.normal(size=t.size))


def measured(x: np.ndarray) -> Backbone:
    return backbone(estimate(x, RATE, method="harmonic-least-squares", bias=False), x, RATE)


@pytest.mark.parametrize(("ratio", "cycles"), [(0.003, 40.0), (0.01, 25.0), (0.03, 14.0), (0.05, 9.0), (0.1, 5.0)])
def test_growth_rates_of_damped_oscillations_hold(ratio: float, cycles: float) -> None:
    found = [measured(damped(ratio, cycles, seed)) for seed in range(10)]
    off = np.concatenate([(f.curve_growth_rate + ratio * OMEGA) / f.curve_growth_rate_sd for f in found])
    assert np.mean(np.abs(off) < 1.96) > 0.85
    assert 0.6 < np.sqrt(np.mean(off**2)) < 1.3
    ratios = [damping(f.curve_growth_rate, f.curve_growth_rate_sd, f.curve_omega, f.curve_omega_sd) for f in found]
    assert np.mean(np.concatenate([np.abs(d.ratio - ratio) < 1.96 * d.ratio_sd for d in ratios])) > 0.85
    sizes = np.concatenate([(f.amplitude - np.exp(-ratio * OMEGA * f.time)) / f.amplitude_sd for f in found])
    assert 0.8 < np.sqrt(np.mean(sizes**2)) < 1.25


def test_growth_rates_of_quadratic_drag_hold_to_the_top() -> None:
    found = [measured(drag(seed)) for seed in range(6)]
    off = np.concatenate([(f.curve_growth_rate - dragged(f.curve_amplitude)) / f.curve_growth_rate_sd for f in found])
    assert np.mean(np.abs(off) < 1.96) > 0.85
    assert 0.6 < np.sqrt(np.mean(off**2)) < 1.3
    assert all(f.curve_amplitude[-1] > 0.8 for f in found)


@settings(max_examples=15, deadline=None)
@given(ratio=st.floats(0.0, 0.15), phase=st.floats(0.0, 6.0), third=st.floats(0.0, 0.1))
def test_a_damped_oscillation_is_in_the_local_model_at_any_damping(ratio: float, phase: float, third: float) -> None:
    t = np.arange(160) / RATE
    angle = OMEGA * t + phase
    x = np.exp(-ratio * OMEGA * t) * (np.cos(angle) + third * np.cos(3 * angle + 1.0)) + 0.2
    fit = harmonic_fit(x, RATE, np.full(160, OMEGA), half=40, shape=Shape((3,)), centres=np.arange(0, 160, 16))
    assert np.abs(fit.growth + ratio * OMEGA).max() < 1e-6 * OMEGA
    assert np.abs(fit.amplitude / np.exp(-ratio * OMEGA * fit.time) - 1.0).max() < 1e-6


def test_the_error_of_a_mean_is_that_of_its_noise() -> None:
    # The mean slope of windows that tile a stretch depends on its ends alone: the slow obvious twin is a simulation.
    half, centres = 30, np.arange(30, 400, 5)
    _, slope, _ = rows(half, 0.0, 4)
    rng = np.random.default_rng(0)
    noise = rng.normal(size=(2000, 460))
    means = np.mean([noise[:, c - half : c + half + 1] @ slope for c in centres], axis=0)
    kernel = np.zeros(460)
    for c in centres:
        kernel[c - half : c + half + 1] += slope / centres.size
    assert np.std(means) == pytest.approx(np.linalg.norm(kernel), rel=0.05)
    assert np.linalg.norm(kernel) < 0.25 * np.linalg.norm(slope)


def test_windows_follow_the_local_rate_of_change() -> None:
    t = np.arange(2400) / RATE
    a = 0.6 / (8.6 * np.exp(0.6 * t) - 8.0)
    guide = np.full(t.size, OMEGA)
    pilot = harmonic_fit(a * np.cos(OMEGA * t), RATE, guide, half=40, shape=Shape(), centres=np.arange(0, 2400, 20))
    halves = half_widths(pilot, guide, RATE, fewest=20, clean=guide > 0)
    assert halves[0] == 30  # three cycles where the amplitude halves in two
    assert halves[-1] >= 160  # sixteen and more in the tail
    assert np.all(np.diff(halves) >= 0)
    assert np.all(furthest(pilot)[:3] * 8.6 < 0.6)
