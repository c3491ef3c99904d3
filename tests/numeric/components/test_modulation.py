"""An oscillation that swings is one oscillation, however regular its swing; what is not mirrored stays beside it."""

from __future__ import annotations

import math

import numpy as np
import pytest

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.components.modulation import Swing, mirrored
from ridgeback.numeric.components.separation import Separated, separated
from ridgeback.numeric.components.tones import Tone
from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.harmonics.signal_model import signal_models

RATE, CARRIER = 60.0, 7.3
T = np.arange(900) / RATE
NOISE = 0.02 * np.random.default_rng(5).normal(size=T.size)


def of_one(x: Array) -> Separated:
    """What is found of one oscillation in samples, and beside it."""
    return separated(x + NOISE, RATE, np.full(T.size, 2 * np.pi * CARRIER), half=20, multiples=None)


@pytest.mark.parametrize("at", [0.16, 0.23, 0.4])
@pytest.mark.parametrize("growth", [0.0, -0.1])
def test_an_amplitude_that_swings_is_no_sum_of_steady_tones(at: float, growth: float) -> None:
    turn = 2 * np.pi * at
    size = np.exp(growth * T) * (1.0 + 0.3 * np.sin(turn * T + 1.0))
    found = of_one(size * np.cos(2 * np.pi * CARRIER * T))
    assert (found.tones, found.reason) == ((), "")
    off = (found.models.fine.size - size) / 0.02
    assert float(np.sqrt(np.mean(off**2))) < math.sqrt(4.0 * found.models.fine.basis.count / T.size)
    rate = 0.3 * turn * np.cos(turn * T + 1.0) / (1.0 + 0.3 * np.sin(turn * T + 1.0)) + growth
    assert float(np.abs(found.models.best.growth - rate)[60:-60].max()) < 0.3 * float(np.ptp(rate))


@pytest.mark.parametrize(("at", "swing"), [(0.35, 0.1), (0.9, 0.8)])
def test_a_frequency_that_swings_is_followed_though_its_lines_are_sharp(at: float, swing: float) -> None:
    turn = 2 * np.pi * at
    phase = 2 * np.pi * CARRIER * T - swing / at * np.cos(turn * T + 2.0)
    found = of_one(np.cos(phase))
    assert (found.tones, found.reason) == ((), "")
    assert found.swing is None or found.swing == Swing(pytest.approx(turn, rel=0.01), of_frequency=True)
    omega = 2 * np.pi * (CARRIER + swing * np.sin(turn * T + 2.0))
    assert float(np.std((found.models.best.omega - omega)[60:-60])) < 0.2 * float(np.std(omega))


@pytest.mark.parametrize("seed", [5, 21])
def test_a_line_beside_the_mean_frequency_is_not_taken_for_it(seed: int) -> None:
    """Of an index of 1.44 the lines J_1 are as high as J_0: which is the highest the noise decides."""
    rng, t, turn = np.random.default_rng(seed), np.arange(1600) / 40.0, 2 * np.pi / 12.0
    begin = rng.uniform(0, 2 * np.pi)
    phase = 6.0 * np.pi * (t + 0.04 / turn * (np.sin(turn * t + begin) - np.sin(begin))) + rng.uniform(0, 2 * np.pi)
    track = estimate(np.cos(phase) + 0.05 * rng.normal(size=t.size), 40.0)
    assert track.used.tones == ()
    assert track.interval is not None
    omega = 6.0 * np.pi * (1.0 + 0.04 * np.cos(turn * track.time + begin))
    assert float(np.mean(track.interval.holds(omega)[track.valid])) > 0.85
    assert float(np.std((track.omega - omega)[track.valid])) < 0.1 * float(np.std(omega))


def test_a_swing_too_fast_for_models_is_named_and_nothing_claimed() -> None:
    found = of_one((1.0 + 0.4 * np.sin(7.5 * T)) * np.cos(2 * np.pi * CARRIER * T))
    assert found.reason.startswith("its amplitude swings at 1.19")
    assert "every 6.12 cycles" in found.reason


@pytest.mark.parametrize(("above", "size", "phase"), [(8.2, 0.15, 0.0), (8.0, 0.25, 0.0), (8.0, 0.15, 1.5)])
def test_a_tone_to_either_side_that_is_no_mirror_of_the_other_stays_one(
    above: float, size: float, phase: float
) -> None:
    beside = 0.15 * np.cos(2 * np.pi * 6.6 * T) + size * np.cos(2 * np.pi * above * T + phase)
    found = of_one(np.cos(2 * np.pi * CARRIER * T) + beside)
    assert sorted(round(tone.omega / (2 * np.pi), 1) for tone in found.tones) == [6.6, above]
    assert (found.swing, found.reason) == (None, "")


def test_modes_that_decay_at_rates_of_their_own_are_no_mirrors() -> None:
    x = np.exp(-0.2 * T) * np.cos(2 * np.pi * CARRIER * T)
    model = signal_models(x, RATE, np.full(T.size, 2 * np.pi * CARRIER), half=20, multiples=()).best
    low, high = (Tone(2 * np.pi * (CARRIER + d), growth, 0.2) for d, growth in ((-0.7, -0.2), (0.7, -0.2)))
    assert mirrored(low, high, model) == mirrored(high, low, model) == 1
    assert mirrored(Tone(low.omega, -0.2, -0.2), high, model) == -1
    assert mirrored(Tone(low.omega, -0.3, 0.2), high, model) == 0
