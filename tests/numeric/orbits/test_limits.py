"""What an estimate costs at most, and where it says no: noise alone, extreme scales and rates, windows too short."""

from __future__ import annotations

import tracemalloc
import warnings
from typing import Any

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.backbone.half_cycles import decrements, half_cycles
from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.model_fit.family import Family
from ridgeback.numeric.model_fit.fit import model_fit

T = np.arange(801) / 20.0
X = np.cos(4.0 * T)


def nothing(*_: object) -> Any:
    raise AssertionError("no work is to be done")


def test_a_wigner_track_never_holds_a_plane() -> None:
    t = np.arange(8192) / 32.0
    x = np.cos(2 * np.pi * t + 2.0 * np.sin(0.05 * t))
    tracemalloc.start()
    track = estimate(x, 32.0, method="wigner", bias=False)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 10e6  # the path through the spectrogram alone once took 26e6
    assert track.valid.sum() > 8000


@pytest.mark.parametrize("seed", [0, 1, 3])
def test_noise_alone_is_not_vouched_for(seed: int) -> None:
    noise = np.random.default_rng(seed).normal(size=801)
    track = estimate(noise, 20.0, method="hilbert")
    assert "no_interval" in track.settings
    assert track.interval is None
    assert not track.valid.any()
    assert track.presence is not None
    assert track.presence.probability > 1e-3


@pytest.mark.parametrize("scale", [1e100, 1e-100])
@pytest.mark.parametrize("size", [801, 20_000])
def test_extreme_swings_are_refused_before_any_work(scale: float, size: int) -> None:
    x = scale * np.cos(0.2 * np.arange(size))
    family = Family("none", (), np.zeros(0), nothing, nothing, nothing, nothing)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for work in (
            lambda: estimate(x, 20.0),
            lambda: half_cycles(x, 20.0),
            lambda: model_fit(x, 20.0, family),
        ):
            with pytest.raises(InputError, match=r"signal swings by 1e[+-]100, outside 1e-40 .. 1e\+40; scale it"):
                work()


@pytest.mark.parametrize("rate", [1e300, 1e-300])
def test_extreme_rates_are_refused(rate: float) -> None:
    with pytest.raises(InputError, match=r"sampling rate 1e[+-]300 is outside 1e-18 .. 1e\+18; give it per another"):
        estimate(X, rate)


@pytest.mark.parametrize("rate", [1e18, 1e-18])
def test_the_largest_and_smallest_rates_change_nothing_but_the_unit(rate: float) -> None:
    expected, found = estimate(X, 20.0), estimate(X, rate)
    assert found.method == expected.method
    assert found.omega / rate == pytest.approx(expected.omega / 20.0, rel=1e-9)


@pytest.mark.parametrize("seed", [0, 1, 3])
def test_half_cycles_of_noise_divide_by_nothing(seed: int) -> None:
    noise = np.random.default_rng(seed).normal(size=801)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = half_cycles(noise, 20.0)
    assert not np.isinf(found.growth_rate).any()


def test_turning_points_at_one_time_or_on_zero_give_no_damping() -> None:
    at, peak, ones = np.array([0.0, 1.0, 2.0, 1.0, 5.0]), np.array([2.0, -1.0, 1.0, -1.0, 0.0]), np.ones(5)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        growth_rate, deviation = decrements(at, peak, ones)
    assert growth_rate[1] == pytest.approx(-0.5 * np.log(2.0))
    assert np.isnan(growth_rate[[0, 2, 3, 4]]).all()
    assert np.isnan(deviation[[0, 2, 3, 4]]).all()


def test_a_window_below_a_sample_is_told_to_be_longer() -> None:
    noise = np.random.default_rng(1).normal(size=801)
    for advice, lag in (("use for example", 0.01), ("a shorter --lag", 39.9)):
        with pytest.raises(InputError, match=advice):
            estimate(noise + X, 20.0, method="pseudo-wigner", lag_seconds=lag, band=(3.9, 4.1), bias=False)
