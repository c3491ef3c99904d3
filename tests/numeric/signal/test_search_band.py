"""Where the fundamental is looked for in a record of few cycles, and what is said of a window that does not fit it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.signal import search_band
from ridgeback.numeric.signal.samples import checked_rate
from ridgeback.numeric.signal.search_band import guide_path, strongest_frequency
from ridgeback.numeric.signal.windows import half_width


@pytest.mark.parametrize("size", [60, 61, 62, 63])
def test_a_record_shorter_than_the_guides_window_guides_itself(size: int) -> None:
    x = np.cos(6.0 * np.arange(size) / 20.0)
    path = guide_path(x, 20.0, 6.0, 3.0, 12.0)
    assert path.shape == x.shape
    assert np.abs(path - 6.0).max() < 1.0


def test_a_window_beyond_the_record_is_refused_with_the_longest_that_fits() -> None:
    with pytest.raises(InputError, match=r"lag_seconds 10 needs 201 samples, the signal has 50; use at most 2\.45$"):
        half_width(10.0, 20.0, longest=50)
    assert half_width(2.45, 20.0, longest=50) == 24


@pytest.mark.parametrize("unit", [1e-12, 1e12])
def test_the_unit_of_the_samples_does_not_move_the_strongest_frequency(unit: float) -> None:
    x = np.cos(6.0 * np.arange(200) / 20.0)
    band = (5.0, 20.0)
    assert strongest_frequency(unit * x, 20.0, band=band) == strongest_frequency(x, 20.0, band=band)
    assert 5.9 < strongest_frequency(unit * x, 20.0) < 6.1


def test_a_window_may_be_as_long_as_the_record_and_no_longer() -> None:
    assert half_width(2.0, 20.0, longest=41) == 20
    with pytest.raises(InputError, match="needs 41 samples, the signal has 40"):
        half_width(2.0, 20.0, longest=40)


@pytest.mark.parametrize("rate", [1e-3, 1.0, 1e3])
def test_a_long_record_has_its_guide_in_any_unit_of_time(rate: float, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(search_band, "LONG", 2000)
    n = np.arange(6000)
    x = np.cos(0.06 * n + 2.0 * np.sin(0.002 * n))
    path = guide_path(x, rate, 0.06 * rate, 0.03 * rate, 0.12 * rate)
    assert np.abs(path / rate - 0.06 - 0.004 * np.cos(0.002 * n))[500:-500].max() < 2e-3


@pytest.mark.parametrize("rate", [1e-6, 0.5, 1.0, 1e6])
def test_any_positive_rate_is_one(rate: float) -> None:
    assert checked_rate(rate) == rate
    for wrong in (0.0, -rate):
        with pytest.raises(InputError, match="is not positive"):
            checked_rate(wrong)


@pytest.mark.parametrize("ratio", [0.02, 0.15])
def test_a_record_of_three_cycles_shows_them(ratio: float) -> None:
    t, omega = np.arange(90) / 210.0, 14 * np.pi
    x = np.exp(-ratio * omega * t) * np.cos(omega * t + 0.3)
    assert strongest_frequency(x, 210.0) == pytest.approx(omega, rel=0.12)


def test_a_straight_line_has_no_cycles() -> None:
    t = np.arange(400) / 100.0
    assert strongest_frequency(3.0 * t, 100.0) * 4.0 / (2 * np.pi) == pytest.approx(2.5)


@pytest.mark.parametrize(
    "drift", [lambda t: 0.4 * t, lambda t: 5.0 * np.exp(-t / 3.0)], ids=["straight", "exponential"]
)
def test_a_drift_beneath_a_decay_does_not_draw_the_guide_away_from_its_tail(drift: Callable[[Array], Array]) -> None:
    t, w = np.arange(800) / 80.0, 10.0 * np.pi
    noise = 0.01 * np.random.default_rng(1).normal(size=t.size)
    track = estimate(np.exp(-0.01 * w * t) * np.cos(w * t) + 30.0 + drift(t) + noise, 80.0)
    assert track.used.span is None
    assert track.interval is not None
    assert np.mean(track.interval.holds(np.full(t.size, w))[track.valid]) > 0.8
