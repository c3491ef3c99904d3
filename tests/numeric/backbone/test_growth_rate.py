"""The 95 % intervals of growth rate and amplitude hold the truth (see benchmarks/trials/coverage_of_recordings.py)."""

from __future__ import annotations

import math
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.numeric.backbone.backbone import backbone
from ridgeback.numeric.backbone.curve import Backbone
from ridgeback.numeric.backbone.damping import damping
from ridgeback.numeric.backbone.local_rates import LocalRates, rows
from ridgeback.numeric.backbone.model_rates import ModelRates
from ridgeback.numeric.backbone.windows import furthest, half_widths
from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.harmonics.local_fit import harmonic_fit
from ridgeback.numeric.harmonics.spline_fit import harmonic_splines
from ridgeback.numeric.harmonics.window_steps import Shape
from tests.numeric.holding import excess

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
    apart = np.concatenate([(d.ratio - ratio) / d.ratio_sd for d in ratios])
    assert np.mean(np.abs(apart) < 1.96) > 0.85
    assert np.sqrt(np.mean(apart**2)) > 0.6
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


def test_of_the_bias_a_share_is_left_that_grows_with_the_change_within_a_window() -> None:
    """Of sqrt(3^2 - 2^2 - 0.5^2), (h g)^2/2 with h = 0.5 and growth rates g of 2 and 4: 1/2, and 1 at most."""
    fine: Any = SimpleNamespace(growth=np.array([-2.0, -4.0]))
    coarse: Any = SimpleNamespace(growth=np.array([-5.0, -7.0]))
    found = LocalRates(np.array([40, 60]), np.array([10, 10]), fine, coarse, 100, 20.0)
    index, share, apart = np.array([0, 1]), np.array([0.5, 0.5]), np.array([2.0, 0.5, 0.0])
    assert found.bias_left(index, share, apart) == pytest.approx(0.75 * math.sqrt(4.75))
    assert found.bias_left(index, share, 4.0 * apart) == 0.0
    still = replace(found, half=np.array([1, 1]))
    assert still.bias_left(index, share, apart) == pytest.approx(0.1 * math.sqrt(4.75))


def test_a_window_holds_a_tenth_of_the_change_of_frequency_in_a_half() -> None:
    """h |omega'| <= omega / 10, taken over a window round each time, where nothing else changes."""
    t = np.arange(0.0, 40.0, 0.5)
    none = np.zeros(t.size)
    pilot: Any = SimpleNamespace(
        time=t,
        omega=6.0 + 0.3 * t,
        standard_deviation=none,
        growth=none,
        growth_sd=none,
        settled=np.ones(t.size, dtype=np.bool_),
        window_seconds=2.0,
    )
    found = furthest(pilot)[5:-5]
    before = np.maximum(t[5:-5] - 1.0, 0.0)
    assert found == pytest.approx(0.1 * (6.0 + 0.3 * before) / 0.3, rel=1e-6)


def test_what_differs_beyond_noise_is_bias() -> None:
    """All of it where it is twice what noise makes of it, else the share by the order of the models."""
    models: Any = SimpleNamespace(remainder=0.3)
    found = ModelRates(models, np.arange(3)).with_bias(
        np.array([1.0, 2.0, 2.0]), np.array([1.0, 1.0, 1.0]), np.array([0.5, 2.5, 4.0])
    )
    assert found == pytest.approx([math.sqrt(1.25), math.sqrt(4.0 + 0.09 * 3.25), math.sqrt(4.0 + 13.0)])


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


def test_noise_alone_has_no_model_to_take_an_interval_from() -> None:
    guide = np.full(640, OMEGA)
    for seed in range(4):
        with pytest.raises(InputError, match="no model of the whole signal settled"):
            harmonic_splines(np.random.default_rng(seed).normal(size=640), RATE, guide)


def held_and_released(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Held at 1 for 4.1 s, an oscillation of 0.95 Hz, stopped at 40 s."""
    t = np.arange(900) / 20.0
    moving = np.exp(-0.004 * (t - 4.1)) * np.cos(2 * np.pi * 0.95 * (t - 4.1))
    clean = np.where(t < 4.1, 1.0, np.where(t < 40.0, moving, 0.0))
    return t, clean + 0.003 * np.random.default_rng(seed).normal(size=t.size)


def test_a_release_and_a_stop_are_found_and_nothing_beyond_them_counts() -> None:
    off = []
    for seed in range(4):
        _, x = held_and_released(seed)
        track = estimate(x, 20.0)
        assert track.used.span is not None
        assert 4.05 <= track.used.span[0] <= 4.6
        assert 39.4 <= track.used.span[1] <= 40.0
        found = backbone(track, x, 20.0)
        off.append((found.curve_growth_rate + 0.004) / found.curve_growth_rate_sd)
        assert track.interval is not None
        assert np.abs(found.curve_omega / (2 * np.pi * 0.95) - 1.0).max() < 2e-3
        assert "stands above the noise from t = 4." in found.notes[0]
    assert np.mean(np.abs(np.concatenate(off)) < 1.96) > 0.85
    assert np.sqrt(np.mean(np.concatenate(off) ** 2)) > 0.4


def test_a_tail_in_the_noise_costs_the_tail_and_not_the_interval() -> None:
    for seed in range(4):
        x = damped(0.03, 60.0, seed)
        track = estimate(x, RATE)
        assert track.used.span is not None
        assert 1.0 < track.used.span[1] < 2.2
        assert track.interval is not None
        inside = track.inside()
        assert inside.interval is not None
        assert excess(inside.interval.low, inside.interval.high, OMEGA) < 8.0


def test_a_steady_oscillation_is_left_whole() -> None:
    t = np.arange(640) / 32.0
    for size in (0.05, 0.3):
        x = np.cos(2 * np.pi * (1.0 * t + 0.01 * t**2)) + size * np.random.default_rng(2).normal(size=640)
        assert estimate(x, 32.0, bias=False).used.span is None


def test_windows_widen_until_strong_harmonics_are_told_apart():
    time = np.arange(397) / 40.0
    amplitude = 5 * np.exp(-0.09 * time)
    phase = 7.85 * time - 0.0176 * np.cumsum(amplitude**2) / 40
    x = amplitude * np.cos(phase) + 0.012 * amplitude**2 * np.cos(2 * phase) + 8e-4 * amplitude**3 * np.cos(3 * phase)
    x += 0.02 * np.random.default_rng(1).normal(size=time.size)
    found = backbone(estimate(x, 40.0), x, 40.0)  # over three cycles no window of 33 parameters comes to rest
    assert np.all(np.abs(found.growth_rate + 0.09) < 4 * found.growth_rate_sd)
    assert np.median(found.growth_rate_sd) < 0.01
