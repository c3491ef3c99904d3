"""A frequency that runs away from where the spectrum is strongest: followed to its end."""

from __future__ import annotations

import math
from itertools import groupby
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.harmonics.local_fit import choose_multiples, harmonic_fit
from ridgeback.numeric.harmonics.window_steps import Shape
from ridgeback.numeric.tracking.choices import Held
from ridgeback.numeric.tracking.clear_stretch import FOLLOWED, TURN, clear_once, followed_stretch, smooth_from
from ridgeback.numeric.tracking.followed import lengthened

T = np.arange(700) / 140.0
LEFT = 1.0 - T / 5.05
OMEGA = 4.0 * np.pi * LEFT**-0.6


@pytest.mark.parametrize("growing", [0.0, 0.36])
def test_a_chirp_that_rises_to_fifteen_times_is_followed_to_its_end(growing: float) -> None:
    noise = 0.002 * np.random.default_rng(3).normal(size=T.size)
    track = estimate(0.3 * LEFT**-growing * np.cos(50.5 * np.pi * (1.0 - LEFT**0.4)) + noise, 140.0)
    assert track.interval is not None
    assert track.time.size > 650
    truth = OMEGA[: track.time.size]
    assert np.abs(track.omega / truth - 1.0).max() < 0.05
    assert np.mean(track.interval.holds(truth)) > 0.9


def test_following_ends_where_there_is_nothing() -> None:
    x = np.where(T < 3.0, np.cos(50.5 * np.pi * (1.0 - LEFT**0.4)), 0.0)
    guide, stretch = lengthened(x, 140.0, np.minimum(OMEGA, 20.0), slice(0, 300))
    assert stretch.start == 0
    assert 380 < stretch.stop < 480
    assert np.abs(guide / OMEGA - 1.0)[20:380].max() < 0.15


@pytest.mark.parametrize(
    "runs", [(60, 140), (140, 60), (30, 90, 80), (30, 80, 90), (40, 62, 50, 48), (59, 47, 45, 49), (200,), (61, 61, 78)]
)
def test_the_longest_run_of_slow_changes_is_followed(runs: tuple[int, ...]) -> None:
    """Between jumps of a guide that else keeps its frequency: the twin asks sample by sample."""
    guide = np.repeat(6.0 * 1.5 ** np.arange(len(runs)), runs)
    slope = [0.5 * (math.log(guide[min(i + 1, 199)]) - math.log(guide[max(i - 1, 0)])) for i in range(200)]
    slow = [abs(8.0 * change) * 2.0 * math.pi / omega <= TURN for change, omega in zip(slope, guide, strict=True)]
    found, begin = list[tuple[int, int]](), 0
    for good, part in groupby(slow):
        size = len(list(part))
        found += [(size, -begin)] if good else []
        begin += size
    size, begin = max(found)
    request: Any = SimpleNamespace(signal=SimpleNamespace(search=SimpleNamespace(guide=guide), rate=8.0))
    enough = FOLLOWED * 200 <= size < 200
    assert followed_stretch(request) == (slice(-begin, size - begin) if enough else None)


@pytest.mark.parametrize(("rest", "cut"), [(0.05, True), (0.6, False)])
def test_what_is_loud_is_not_cut(rest: float, cut: bool) -> None:
    """Thirty cycles and then noise: a fifth of the amplitude may be a motion that is not followed."""
    rng, t = np.random.default_rng(4), np.arange(800) / 20.0
    x = np.where(t < 30.0, np.cos(2 * np.pi * t) + 0.01 * rng.normal(size=800), rest * rng.normal(size=800))
    found = clear_once(x.tobytes(), 20.0, np.full(800, 2 * np.pi).tobytes(), 2 * np.pi)
    assert (found is not None) == cut
    assert found is None or 580 <= found.stop <= 620


@pytest.mark.parametrize("rest", [0.0, 1.0])
@pytest.mark.parametrize("cycles", [2.6, 4.3, 6.1])
def test_a_short_rest_before_the_motion_is_cut(rest: float, cycles: float) -> None:
    """Most windows that hold some of the rest hold the jump, too, and are loud."""
    rate, omega = 20.0, 2.0 * math.pi
    t = np.arange(500) / rate
    there = t >= cycles
    moving = np.exp(-0.1 * (t - cycles)) * np.cos(omega * (t - cycles))
    x = np.where(there, moving, rest) + 0.004 * np.random.default_rng(2).normal(size=t.size)
    cut = clear_once(x.tobytes(), rate, np.full(t.size, omega).tobytes(), omega)
    assert cut is not None
    assert -1 <= cut.start - int(np.argmax(there)) <= 0.3 * rate
    assert cut.stop == t.size


def test_a_decay_is_kept_as_far_as_it_stands_five_deviations_above_the_noise() -> None:
    rng, t = np.random.default_rng(2), np.arange(1600) / 20.0
    x = np.exp(-0.08 * t) * np.cos(2 * np.pi * t) + 0.05 * rng.normal(size=t.size)
    guide, half = np.full(t.size, 2 * np.pi), 40
    shape = Shape(choose_multiples(x, 20.0, guide, half=half))
    fit = harmonic_fit(x, 20.0, guide, half=half, shape=shape, centres=np.arange(half, t.size - half, half))
    last = int(np.flatnonzero(fit.settled & (np.abs(fit.amplitude) > 5.0 * fit.amplitude_sd))[-1])
    found = clear_once(x.tobytes(), 20.0, guide.tobytes(), 2 * np.pi)
    assert found is not None
    assert found == slice(0, (last + 2) * half + 1)


def test_the_end_is_no_further_in_than_a_whole_window_fits() -> None:
    x = np.random.default_rng(1).normal(size=200)
    first = smooth_from(x, 20.0, np.full(200, 2 * np.pi), Shape(), half=40, near=100, typical=1e-9)
    assert first == 200 - 81


def test_a_guide_that_strays_before_its_end_is_taken_up_where_it_is_right() -> None:
    x = np.cos(50.5 * np.pi * (1.0 - LEFT**0.4))
    guide, stretch = lengthened(x, 140.0, np.minimum(OMEGA, 15.0), slice(0, 600))
    assert stretch == slice(0, 700)
    assert np.abs(guide / OMEGA - 1.0)[-150:].max() < 0.05


def test_the_steep_start_of_a_swell_is_left_out_since_it_may_be_a_mode_that_dies() -> None:
    t, rng = np.arange(1200) / 20.0, np.random.default_rng(1)
    size = (1.0 - 0.98 * np.exp(-0.6 * t)) * np.exp(-0.02 * t)
    x = size * np.cos(2 * np.pi * t) + 0.01 * rng.normal(size=t.size)
    found = estimate(x, 20.0)
    assert found.used.span is not None
    assert found.interval is not None
    assert 8.0 < found.used.span[0] < 20.0  # 0.98 exp(-0.6 t) is below the noise from t = 7.6 on
    assert found.used.span_why[0] is Held.STARTED
    assert "swells, falls or dies" in found.used.span_notes()[0]
    assert found.interval.holds(np.full(t.size, 2 * np.pi)[: found.omega.size]).mean() > 0.5
    short = estimate(x[:400], 20.0)
    assert short.interval is None
    assert "not told from a mode that dies" in str(short.no_interval)


def test_a_mode_that_dies_in_a_few_cycles_well_beside_the_oscillation_leaves_its_start_claimed() -> None:
    t, rng = np.arange(1200) / 20.0, np.random.default_rng(1)
    x = np.exp(-0.02 * t) * np.cos(6.0 * t) + 0.4 * np.exp(-1.5 * t) * np.cos(8.5 * t) + 1e-3 * rng.normal(size=t.size)
    found = estimate(x, 20.0)
    assert found.used.span is None
    assert found.interval is not None
    assert found.interval.holds(np.full(t.size, 6.0))[:60].mean() > 0.9


def test_a_mode_at_half_the_frequency_is_no_noise_that_ends_the_motion() -> None:
    t, noise = np.arange(2000) / 100.0, 0.01 * np.random.default_rng(2).normal(size=2000)
    growth = -0.006 * math.pi
    mode = 0.35 * np.exp(growth * t) * np.cos(6.0 * math.pi * t + 1.0)
    track = estimate(np.exp(6.0 * growth * t) * np.cos(12.0 * math.pi * t) + mode + noise, 100.0, method="hilbert")
    assert track.used.span is None
    assert [round(tone.omega / math.pi, 2) for tone in track.used.tones] == [6.0]
    assert track.interval is not None
    assert np.mean(track.interval.holds(np.full(track.time.size, 12.0 * math.pi))) > 0.7
