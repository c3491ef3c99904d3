"""What a track says of itself, held against its samples: borders, deviation, window, harmonics of trials."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.estimators.auto import with_window
from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.estimators.window_choice import Window
from ridgeback.numeric.recording.stretches import Stamped
from ridgeback.numeric.recording.uniform import off_grid
from ridgeback.numeric.signal.decimation import Samples
from ridgeback.numeric.tracking.choices import Choices
from ridgeback.numeric.tracking.request import Options, prepared

RATE = 32.0
TIME = np.arange(641) / RATE
TONE = np.cos(2 * np.pi * 1.02 * TIME + 0.3)


@pytest.mark.parametrize(("lag", "smoothing"), [(4.0, 2.0), (6.0, 1.0), (3.0, 3.0)])
def test_a_smoothed_window_is_whole_where_its_track_is_valid(lag: float, smoothing: float) -> None:
    """Lag window and smoothing reach half their lengths to each side: together that much is no estimate."""
    track = estimate(TONE, RATE, method="smoothed-pseudo-wigner", lag_seconds=lag, smoothing_seconds=smoothing)
    inside = track.time[track.valid]
    border = 0.5 * (lag + smoothing)
    assert inside[0] == pytest.approx(border, abs=1.5 / RATE)
    assert TIME[-1] - inside[-1] == pytest.approx(border, abs=1.5 / RATE)


@pytest.mark.parametrize(("steps", "first"), [(10.0, 10), (10.5, 11), (0.0, 0)])
def test_a_sample_just_as_far_from_the_border_as_asked_is_inside(steps: float, first: int) -> None:
    request = prepared(Samples(TONE, RATE, 7.0), Options())
    inside = np.flatnonzero(request.away_from_border(steps / RATE))
    assert (inside[0], inside[-1], inside.size) == (first, TONE.size - 1 - first, TONE.size - 2 * first)


@pytest.mark.parametrize("band", [(1.0, 7.0), (5.5, 12.0)])
def test_the_deviation_of_a_band_that_is_not_centred(band: tuple[float, float]) -> None:
    """The noise of the whole band counts, below the tone as above it: 4000 samples against what is stated."""
    t = np.arange(4000) / RATE
    noise = 0.02 * np.random.default_rng(5).standard_normal(t.size)
    track = estimate(np.cos(2 * np.pi * t) + noise, RATE, method="hilbert", band=band, bias=False)
    inside = (track.time > 10.0) & (track.time < t[-1] - 10.0) & track.valid
    assert track.standard_deviation is not None
    stated = float(np.median(track.standard_deviation[inside]))
    assert float(np.std(track.omega[inside] - 2 * np.pi)) == pytest.approx(stated, rel=0.15)


@pytest.mark.parametrize("lag", [3.0, 4.5])
def test_the_window_of_the_polynomial_distribution_is_the_one_asked_for(lag: float) -> None:
    track = estimate(TONE, RATE, method="polynomial-wigner", lag_seconds=lag, bias=False)
    assert track.settings["lag_seconds"] == pytest.approx(lag, abs=1.0 / RATE)


def test_a_trial_fits_the_harmonics_of_its_track_beside_the_fundamental() -> None:
    request = prepared(Samples(TONE, RATE, 0.0), Options())
    like = request.like(Choices(harmonics=(1, 2, 5), hysteresis=0.25))
    assert (like.plan.multiples, like.plan.hysteresis) == ((2, 5), 0.25)
    assert request.like(Choices(harmonics=(1,))).plan.multiples == ()
    assert request.like(Choices()).plan.multiples is None


@pytest.mark.parametrize(("last", "rate", "count"), [(0.29, 100.0, 30), (0.57, 100.0, 58), (1.1, 10.0, 12)])
def test_resampling_keeps_the_last_sample(last: float, rate: float, count: int) -> None:
    """0.29*100 is 28.999999999999996: the thirtieth sample lies on the last one all the same."""
    time = np.sort(np.append(np.random.default_rng(1).uniform(0.0, last, 60), (0.0, last)))
    none = np.zeros(time.size, dtype=np.bool_)
    found = off_grid(Stamped(time, np.sin(time), np.arange(time.size), 0), none, rate, last)
    assert found.values.size == count
    assert found.values[-1] == pytest.approx(np.sin(last), abs=1e-6)


def test_a_local_fit_takes_the_window_that_suits_the_signal() -> None:
    """A tone that hardly moves is known best over a long window, a fast chirp over a short one."""
    rng = np.random.default_rng(8)
    noise = 0.1 * rng.standard_normal(TIME.size)
    chirp = np.cos(2 * np.pi * (TIME + 0.02 * TIME**2 + 0.15 * np.sin(0.9 * TIME)))
    long, short = (
        estimate(x + noise, RATE, method="harmonic-least-squares", scope="local").used.lag_seconds
        for x in (TONE, chirp)
    )
    assert long is not None
    assert short is not None
    assert long > 8.0 > short


def test_a_request_takes_the_window_that_was_chosen() -> None:
    known: Any = SimpleNamespace()
    request = replace(prepared(Samples(TONE, RATE, 0.0), Options()), known_models=known)
    for half in (30, 47):
        taken = with_window(request, Window(half, 5, 0.1))
        assert (taken.half, taken.plan.phase_degree) == (half, 5)


def test_some_three_cycles_are_enough_and_a_step_less_is_not() -> None:
    search: Any = SimpleNamespace(centre=2 * np.pi)
    whole, shorter = Samples(TONE[:52], 20.0, 0.0), Samples(TONE[:51], 20.0, 0.0)
    assert prepared(whole, Options(), search=search).plan.smoothing_seconds == 1.0
    with pytest.raises(InputError, match=r"signal spans 2\.55 cycles .* \(1 each\); 2\.6 are needed"):
        prepared(shorter, Options(), search=search)


def test_a_straight_line_is_told_from_few_cycles() -> None:
    line = Samples(3.0 * np.arange(400) / 100.0, 100.0, 0.0)
    with pytest.raises(InputError, match=r"2\.6 are needed: .* \(--detrend linear\)"):
        prepared(line, Options())
