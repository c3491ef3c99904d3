"""A jump of the frequency that splines would follow is named, and no smooth motion is taken for one."""

from __future__ import annotations

import numpy as np
import pytest

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.components.jumps import OFFSET, jump, left_over, moments
from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.harmonics.signal_model import signal_models

T = np.arange(800) / 40.0
W = 18.85


def found(x: Array, noise: float, seed: int = 1) -> str:
    """The jump that is seen in samples with noise."""
    x = x + noise * np.random.default_rng(seed).normal(size=x.size)
    models = signal_models(x, 40.0, np.full(x.size, W), half=60, multiples=())
    return jump(models, x - models.best.samples(), np.ones(x.size, dtype=np.bool_))


@pytest.mark.parametrize(("ratio", "noise"), [(0.05, 0.03), (0.01, 0.01), (0.002, 0.01)])
def test_a_small_jump_is_seen_at_its_place(ratio: float, noise: float) -> None:
    said = found(np.cos(W * (T + ratio * np.maximum(T - 8.0, 0.0))), noise)
    assert said.startswith("the frequency jumps near ")
    assert abs(float(said.split()[6].rstrip(",")) - 8.0) < 0.4


@pytest.mark.parametrize("noise", [0.01, 0.05])
def test_smooth_motions_do_not_jump(noise: float) -> None:
    drag = np.exp(-0.1 * T) / (1.0 + 8.0 * (1.0 - np.exp(-0.1 * T)))
    bend = W * (T + 0.01 * np.cumsum(drag**2) / 40.0)
    swing = W * (T + 0.02 * np.sin(0.6 * T))
    for x in (np.exp(-0.1 * T) * np.cos(W * T), drag * np.cos(bend), np.cos(swing)):
        assert not found(x, noise)


def test_an_amplitude_that_bends_is_no_jump_of_the_frequency() -> None:
    assert not found(np.exp(-0.05 * np.maximum(T - 8.0, 0.0)) * np.cos(W * T), 0.01)


def test_moments_give_the_least_squares_of_the_columns_written_out() -> None:
    x = np.cos(W * T + 0.3 * np.sin(0.5 * T)) + 0.02 * np.random.default_rng(2).normal(size=T.size)
    model = signal_models(x, 40.0, np.full(T.size, W), half=60, multiples=()).best
    left, sound = x - model.samples(), np.ones(T.size, dtype=np.bool_)
    of = moments(model, left, sound, np.array([0, 300, 500]))
    u = np.linspace(-1.0, 1.0, T.size)
    weights = (-model.size * np.sin(model.phase), model.size * np.cos(model.phase), np.ones(T.size))
    log = np.log(model.size)
    ends = [v[0] + (v[-1] - v[0]) * 0.5 * (u + 1.0) for v in (model.phase, log)]
    y = left + model.samples(keep=lambda h: h == 0)
    y = y + weights[0] * (model.phase - ends[0]) + weights[1] * (log - ends[1])

    smooth = [w * u**n for w, degree in zip(weights, (3, 3, OFFSET), strict=True) for n in range(degree + 1)]
    for place, at in ((1, 300), (2, 500)):
        bend = np.maximum(u - u[at], 0.0)
        matrix = np.array([*smooth, weights[0] * bend, weights[1] * bend]).T
        off = y - matrix @ np.linalg.lstsq(matrix, y, rcond=None)[0]
        assert left_over(of, 3, (0, 1))[place] == pytest.approx(float(off @ off), rel=1e-6)


@pytest.mark.parametrize("jumps", [0.0, 5e-4])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_many_turns_do_not_hide_the_noise_in_rounding(jumps: float, seed: int) -> None:
    """A chirp of 800 cycles is smooth to every place, the first cycles too, and a small jump in it is seen."""
    t = np.arange(10_000) / 1333.0
    phase = 2 * np.pi * (100.0 * t + t**2 + 100.0 * jumps * np.maximum(t - 3.0, 0.0))
    x = np.cos(phase) + 0.02 * np.random.default_rng(seed).normal(size=t.size)
    guide = 2 * np.pi * (100.0 + 2.0 * t)
    models = signal_models(x, 1333.0, guide, half=40, multiples=())
    said = jump(models, x - models.best.samples(), np.ones(x.size, dtype=np.bool_))
    assert bool(said) == bool(jumps)
    assert not said or abs(float(said.split()[6].rstrip(",")) - 3.0) < 0.1


@pytest.mark.parametrize("of_frequency", [True, False])
def test_a_frequency_that_wanders_at_random_is_not_claimed(of_frequency: bool) -> None:
    t, rng = np.arange(1200) / 20.0, np.random.default_rng(4)
    steps = 0.02 * rng.normal(size=t.size)
    walk = np.cumsum(np.cumsum(steps) / 20.0) if of_frequency else np.cumsum(steps)
    reason = str(estimate(np.cos(9.0 * t + walk) + 0.01 * rng.normal(size=t.size), 20.0).no_interval)
    assert "wanders at random" in reason
