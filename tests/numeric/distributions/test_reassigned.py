"""Reassignment and synchrosqueezing: where tones, clicks and chirps end up, what is kept, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.distributions.reassigned_spectrogram import (
    gathered,
    nearest,
    reassigned_spectrogram,
    squeezed,
    synchrosqueezed_spectrogram,
)
from ridgeback.numeric.distributions.reassignment import first_order, second_order, window_family
from ridgeback.numeric.distributions.short_time import short_time_spectra
from ridgeback.numeric.distributions.spectrogram import spectrogram
from ridgeback.numeric.estimators.reassigned_ridge import at_ridge
from ridgeback.numeric.signal.windows import SLOPES, window, window_slope

RATE = 32.0
T = (np.arange(513) - 256) / RATE


def fading_chirp() -> np.ndarray:
    return np.exp(-((T / 2.0) ** 2)) * np.cos(2 * np.pi * (6.0 * T + 0.4 * T**2))


@pytest.mark.parametrize("name", list(SLOPES))
def test_slope_is_the_derivative_of_the_window(name: str) -> None:
    half = 2000
    difference = (window(name, half)[2:] - window(name, half)[:-2]) / 2.0
    assert np.abs(window_slope(name, half)[1:-1] - difference).max() < 1e-5 * np.abs(difference).max()


def test_short_time_spectra_are_the_sums_written_out() -> None:
    rng = np.random.default_rng(2)
    z, w, n_fft = rng.normal(size=30) + 1j * rng.normal(size=30), rng.normal(size=9), 16
    spectra = short_time_spectra(z, w, 2, 27, n_fft)
    for n in (2, 3, 15, 26):
        total = np.zeros(n_fft, dtype=complex)
        for j in range(-4, 5):
            if 0 <= n + j < 30:
                total += z[n + j] * w[j + 4] * np.exp(-2j * np.pi * np.arange(n_fft) * j / n_fft)
        assert np.abs(spectra[n - 2] - total).max() < 1e-12


def test_click_moves_to_its_own_time_and_a_tone_to_its_own_frequency() -> None:
    family = window_family("hann", 20, RATE)
    omega = 2 * np.pi * RATE * np.arange(1, 60) / 128
    click = np.zeros(101, dtype=complex)
    click[50] = 1.0
    tone = np.exp(1j * 20.0 * np.arange(101) / RATE)
    for n in (40, 50, 57):
        s, s_slope, s_lag = (short_time_spectra(click, w, n, n + 1, 128)[:, 1:60] for w in family.three)
        assert np.abs(first_order(omega, s, s_slope, s_lag)[0] - (50 - n) / RATE).max() < 1e-12
    s, s_slope, s_lag = (short_time_spectra(tone, w, 50, 51, 128)[:, 1:60] for w in family.three)
    lobe = np.abs(s[0]) > 0.1 * np.abs(s).max()
    assert lobe.sum() > 6
    assert np.abs(first_order(omega, s, s_slope, s_lag)[1][0] - 20.0)[lobe].max() < 0.02
    shift, moved = at_ridge(tone, family, RATE, np.full(101, 20.0))
    assert np.abs(shift[20:-20]).max() < 1e-12
    assert np.abs(moved[20:-20] - 20.0).max() < 1e-10


@pytest.mark.parametrize("name", list(SLOPES))
def test_second_order_is_exact_for_chirps_off_the_ridge_and_the_first_is_not(name: str) -> None:
    family = window_family(name, 320, 256.0)
    tau = np.arange(-320, 321) / 256.0
    z = np.exp((0.2 + 40.0j) * tau + (-0.1 + 3.0j) * tau**2 / 2)  # 40 rad/s at 0, fading and growing too
    omega = np.array([36.0, 38.0, 40.0, 42.5])
    spectra = [((z * w) @ np.exp(-1j * np.outer(tau, omega)))[None] for w in family.five]
    assert np.abs(second_order(omega, *spectra) - 40.0).max() < 1e-4
    assert np.abs(first_order(omega, *spectra[:3])[1] - 40.0)[0, [0, 1, 3]].min() > 0.3


def test_reassigned_plane_keeps_the_energy_and_puts_it_on_the_chirp() -> None:
    x = fading_chirp()
    options = {"window_seconds": 2.0, "n_fft": 256, "remove_mean": False}
    plain = spectrogram(x, RATE, **options)  # type: ignore[arg-type]
    moved = reassigned_spectrogram(x, RATE, start=T[0], **options)  # type: ignore[arg-type]
    assert moved.values.shape == plain.values.shape
    assert moved.values.sum() == pytest.approx(plain.values.sum(), rel=1e-3)
    assert moved.values.min() >= 0.0
    line = np.abs(moved.frequency_hz[:, None] - (6.0 + 0.8 * moved.time)) < 1.5 * RATE / 256
    assert moved.values[line].sum() > 0.95 * moved.values.sum()
    assert plain.values[line].sum() < 0.5 * plain.values.sum()


def test_synchrosqueezed_plane_is_on_the_chirp_and_adds_up_to_the_signal() -> None:
    x = fading_chirp()
    plane = synchrosqueezed_spectrogram(x, RATE, window_seconds=2.0, n_fft=256, start=T[0], remove_mean=False)
    line = np.abs(plane.frequency_hz[:, None] - (6.0 + 0.8 * plane.time)) < 1.5 * RATE / 256
    assert plane.values[line].sum() > 0.98 * plane.values.sum()
    z = np.exp(-((T / 2.0) ** 2) + 2j * np.pi * (6.0 * T + 0.4 * T**2))
    family = window_family("hann", 32, RATE, scale=1.0 / 256)
    omega = 2 * np.pi * RATE * np.arange(256) / 256
    s, moved = squeezed(z, family, omega, 150, 350)
    assert np.abs(gathered(s, nearest(moved / omega[1]) % 256, 256).sum(axis=1) - z[150:350]).max() < 1e-12
    t = gathered(s, nearest(moved / omega[1]), 129)
    assert np.abs(t.sum(axis=1) - z[150:350]).max() < 1e-3


def test_planes_of_noise_are_finite_and_silence_stays_silent() -> None:
    rng = np.random.default_rng(11)
    for transform in (reassigned_spectrogram, synchrosqueezed_spectrogram):
        plane = transform(rng.normal(size=200), RATE, window_seconds=1.0)
        assert np.isfinite(plane.values).all()
        assert plane.values.sum() > 0.0
        assert not transform(np.zeros(100), RATE, window_seconds=1.0).values.any()


@pytest.mark.parametrize("transform", [reassigned_spectrogram, synchrosqueezed_spectrogram])
@pytest.mark.parametrize(
    ("x", "arguments", "message"),
    [
        (np.ones(10, dtype=complex), {"window_seconds": 1.0}, "complex"),
        (np.ones(10), {"window_seconds": 20.0}, "the signal has 10"),
        (np.ones(10), {"window_seconds": 4.0, "n_fft": 3}, "n_fft 3 is below the window of 5"),
        (np.ones(10), {"window_seconds": 4.0, "memory": 100}, "over the budget"),
        (np.ones(10), {"window_seconds": 4.0, "window_name": "hamming"}, "window 'hamming' does not end at zero"),
    ],
)
def test_unusable_requests_are_named(transform: object, x: np.ndarray, arguments: dict, message: str) -> None:
    with pytest.raises(InputError, match=message):
        transform(x, 1.0, **arguments)  # type: ignore[operator]
