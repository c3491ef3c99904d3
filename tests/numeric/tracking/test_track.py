"""The Track value, the ridge that feeds it, and the curvature bias."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.polynomial.chebyshev import chebval
from scipy.fft import hfft

from ridgeback.common.errors import InputError
from ridgeback.numeric.distributions.bin_interpolation import (
    DEGREE,
    HALF,
    derivative_weights,
    maximum,
    neighbour_weights,
    neighbours,
    slopes_around,
)
from ridgeback.numeric.distributions.lag_kernel import LagKernel
from ridgeback.numeric.distributions.ridge import follow, highest
from ridgeback.numeric.distributions.short_time import ShortTimeKernel
from ridgeback.numeric.distributions.wigner import wigner_kernel
from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.signal.search_band import continuous_path, find_search_band
from ridgeback.numeric.signal.windows import WINDOWS, window
from ridgeback.numeric.tracking.choices import Choices
from ridgeback.numeric.tracking.curvature_bias import curvature_bias, curvature_coefficient
from ridgeback.numeric.tracking.track import Track


def test_track_is_frozen_and_its_parts_agree_in_length() -> None:
    track = Track(
        np.arange(4.0), np.full(4, 2 * np.pi), np.array([0, 1, 1, 0], bool), "test", np.ones(4), None, {"a": 1}
    )
    assert track.inside().time.tolist() == [1.0, 2.0]
    assert track.between(2.0, 9.0).omega.size == 2
    assert track.frequency_hz.tolist() == [1.0] * 4
    assert track.rows()[0] == {
        "time_s": 0.0,
        "omega_rad_s": 2 * np.pi,
        "frequency_hz": 1.0,
        "standard_deviation_rad_s": 1.0,
        "valid": False,
    }
    with pytest.raises(ValueError, match="read-only"):
        track.omega[0] = 0.0
    with pytest.raises(InputError, match="omega has 3 values for 4 times"):
        Track(np.arange(4.0), np.ones(3), np.ones(4, bool), "test")
    with pytest.raises(InputError, match="valid has 1 values for 4 times"):
        Track(np.arange(4.0), np.ones(4), np.ones(1, bool), "test")


@pytest.mark.parametrize("known", [True, False])
def test_the_picture_of_a_track_says_whether_an_interval_is_drawn(known: bool) -> None:
    flat = np.full(4, 6.0)
    sd, bias = (0.1 + 0.0 * flat, 0.0 * flat) if known else (None, None)
    track = Track(np.arange(4.0), flat, flat > 0, "example", standard_deviation=sd, bias=bias, bias_deviation=bias)
    (stroke,) = track.picture().strokes[:1]
    assert stroke.label == ("example, 95 % interval" if known else "example")
    assert (stroke.low is not None) == known


@given(st.integers(0, 40), st.floats(-1.0, 1.0), st.integers(0, 200))
@settings(deadline=None, max_examples=40)
def test_spectra_are_read_between_the_bins_to_rounding(lags: int, offset: float, at: int) -> None:
    rng = np.random.default_rng(lags)
    lag = rng.normal(size=lags + 1) + 1j * rng.normal(size=lags + 1)
    lag[0] = lag[0].real
    bins = LagKernel.search_length(lags)
    around = neighbours(hfft(lag, n=bins)[None], np.array([at % bins]))
    m = np.arange(lags + 1)
    turned = lag * np.exp(-2j * np.pi * m * (at % bins + offset) / bins) * np.where(m, 2.0, 1.0)
    step = 2 * np.pi * m / bins
    expected = [turned.real.sum(), (step * turned).imag.sum(), -(step**2 * turned).real.sum()]
    weights, slopes = neighbour_weights(), derivative_weights()
    parts = [weights, slopes[:, :DEGREE], slopes[:, DEGREE:]]
    found = [chebval(offset, (around @ part)[0]) for part in parts]
    scale = np.abs(lag).sum()
    for value, exact, tolerance in zip(found, expected, (2e-12, 5e-11, 3e-9), strict=True):
        assert abs(value - exact) < tolerance * scale


def test_refinement_finds_the_maximum_between_the_bins() -> None:
    rate = 16.0
    t = np.arange(101) / rate
    z = np.exp(2j * np.pi * (3.0 * t + 0.2 * np.sin(t)))
    kernel = wigner_kernel(z, rate, lag_seconds=2.0)
    ones = np.ones(t.size)
    ridge = follow(kernel, 10.0 * ones, 30.0 * ones)
    column = kernel.columns(50, 51)[0]
    m = np.arange(column.size)
    fine = ridge.omega[50] + np.linspace(-0.5, 0.5, 4001)
    height = 2 * (column * np.exp(-2j * np.outer(fine, m) / rate)).real.sum(axis=1)
    assert fine[height.argmax()] == pytest.approx(ridge.omega[50], abs=2.6e-4)
    turned = column * m * np.exp(-2j * ridge.omega[50] * m / rate)
    slope, bend = 2 / rate * 2 * turned.imag.sum(), -((2 / rate) ** 2) * 2 * (m * turned).real.sum()
    assert abs(slope / bend) < 1e-10


@pytest.mark.parametrize(("place", "found"), [(5.0, 1.0), (-5.0, -1.0), (0.9, 0.9)])
def test_a_maximum_is_sought_within_a_bin_of_the_highest_one(place: float, found: float) -> None:
    """Further out the polynomial holds for nothing: a spectrum that rises past the next bin is followed up to it."""
    around = np.cos(0.2 * (np.arange(-HALF, HALF + 1.0) - place))[None]
    assert maximum(slopes_around(around), np.zeros(1))[0] == pytest.approx(found, abs=1e-9)


@given(st.integers(0, 200))
@settings(deadline=None, max_examples=60)
def test_highest_bin_is_that_of_the_masked_row(seed: int) -> None:
    rng = np.random.default_rng(seed)
    values = rng.normal(size=(5, 40))
    before, spacing = values.copy(), 0.3
    low, width = rng.uniform(0.0, 9.0, size=5), rng.uniform(0.6, 8.0, size=5)
    if seed % 3 == 0:
        low, width = np.full(5, low[0]), np.full(5, width[0])
    omega = spacing * np.arange(40)
    allowed = (omega >= low[:, None]) & (omega <= (low + width)[:, None])
    expected = np.where(allowed, values, -np.inf).argmax(axis=1)
    assert highest(values, spacing, low, low + width).tolist() == expected.tolist()
    assert np.array_equal(values, before)


def test_peak_on_the_nearest_bin_outside_a_band_without_bins_is_not_inside() -> None:
    rate, ones = 16.0, np.ones(64)
    spacing = np.pi * rate / LagKernel.search_length(8)
    kernel = wigner_kernel(np.exp(8j * spacing * np.arange(64) / rate), rate, lag_seconds=1.0)
    assert kernel.half_lags == 8
    assert follow(kernel, 7.2 * spacing * ones, 8.2 * spacing * ones).inside[16:-16].all()
    assert not follow(kernel, 7.2 * spacing * ones, 7.8 * spacing * ones).inside[16:-16].any()


def test_spectrogram_ridge_of_a_tone_is_exact_between_the_bins() -> None:
    rate, f = 16.0, 3.123456
    z = np.exp(2j * np.pi * f * np.arange(200) / rate)
    kernel = ShortTimeKernel(z, rate, window("hann", 20))
    ones = np.ones(200)
    ridge = follow(kernel, 10.0 * ones, 30.0 * ones)
    assert np.abs(ridge.omega[20:-20] / (2 * np.pi) - f).max() < 1e-10


def test_band_edge_is_not_taken_for_a_peak() -> None:
    rate = 16.0
    z = np.exp(2j * np.pi * 3.0 * np.arange(200) / rate)
    ones = np.ones(200)
    ridge = follow(wigner_kernel(z, rate, lag_seconds=4.0), 20.0 * ones, 30.0 * ones)  # 3 Hz is 18.8 rad/s
    assert not ridge.inside[40:-40].any()


@pytest.mark.parametrize("name", list(WINDOWS))
def test_curvature_bias_follows_the_formula_to_leading_order(name: str) -> None:
    # phi = w t + c t^3 / 6, so phi''' = c: the measured bias over the formula tends to 1 with order c^2.
    rate = 40.0
    t = (np.arange(801) - 400) / rate
    ones = np.ones(t.size)
    departures = []
    for c in (0.4, 0.2):
        z = np.exp(1j * (40.0 * t + c * t**3 / 6.0))
        kernel = wigner_kernel(z, rate, lag_seconds=3.0, lag_window=name)
        omega = follow(kernel, 20.0 * ones, 60.0 * ones).omega[400]
        departures.append((omega - 40.0) / (curvature_coefficient(kernel.lags, kernel.lag_window) * c) - 1.0)
    assert abs(departures[1]) < 0.02
    assert departures[0] / departures[1] == pytest.approx(4.0, rel=0.3)


def test_bias_by_trials_is_that_of_the_formula_where_the_curvature_is_small() -> None:
    rate = 32.0
    t = np.arange(640) / rate
    mean, slow = 2 * np.pi * 26 / 20.0, 2 * np.pi / 20.0  # whole periods: the analytic signal is exact
    true = mean + 1.5 * np.sin(slow * t)
    x = np.cos(mean * t - 1.5 / slow * np.cos(slow * t))
    track = estimate(x, rate, method="pseudo-wigner", lag_seconds=3.0)
    kernel = wigner_kernel(x, rate, lag_seconds=3.0, lag_window="blackman")
    predicted = curvature_bias(t, true, kernel.lags, kernel.lag_window)
    middle = (t > 3.0) & (t < 17.0)
    assert track.bias is not None
    assert np.abs(predicted[middle]).max() > 0.01
    assert np.abs(track.bias - predicted)[middle].max() < 0.05 * np.abs(predicted[middle]).max()
    assert np.abs(track.omega - track.bias - true)[middle].max() < 0.02 * np.abs(predicted[middle]).max()


def test_path_prefers_continuity_to_a_lone_peak() -> None:
    level = np.zeros((9, 30))
    level[2] = 1.0
    level[8, 15] = 5.0
    assert set(continuous_path(level, reach=1).tolist()) == {2}


def test_search_band_keeps_harmonics_out_while_the_fundamental_moves_past_them() -> None:
    t = np.arange(1281) / 32.0
    phase = 2 * np.pi * (1.0 * t + 0.03 * t**2)  # 1.0 to 3.4 Hz: more than the third harmonic's distance
    x = np.cos(phase) + 0.5 * np.cos(2 * phase) + 0.5 * np.cos(3 * phase)
    search = find_search_band(x, 32.0)
    true = 2 * np.pi * (1.0 + 0.06 * t)
    assert np.all((search.low < true) & (true < search.high))
    assert np.all(search.high[64:-64] < 2 * true[64:-64])


def test_settings_for_display_hold_what_code_reads_and_more() -> None:
    used = Choices(start=1.0, multiple=3, harmonics=(1, 3))
    track = Track(np.arange(3.0), np.ones(3), np.ones(3, bool), "test", used=used, details={"rate": 4.0})
    shown = {"start": 1.0, "multiple": 3, "harmonics": (1, 3), "rate": 4.0, "bias_removed": False}
    assert dict(track.settings) == shown
    assert track.between(1.0, 2.0).used is used
    assert track.start == 1.0
    assert dict(Track(np.arange(3.0), np.ones(3), np.ones(3, bool), "test").settings) == {"bias_removed": False}
