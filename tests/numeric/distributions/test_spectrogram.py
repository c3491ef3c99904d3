from __future__ import annotations

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.distributions.spectrogram import spectrogram
from ridgeback.numeric.signal.windows import window


def test_is_the_windowed_sum_written_out() -> None:
    rate, half, n_fft, hop = 16.0, 5, 32, 3
    x = np.random.default_rng(1).normal(size=50)
    plane = spectrogram(x, rate, window_seconds=2 * half / rate, n_fft=n_fft, hop=hop, remove_mean=False)
    w = window("hann", half)
    w = 2.0 * w / w.sum()
    for column, centre in enumerate(range(0, 50, hop)):
        for row in range(n_fft // 2 + 1):
            total = sum(
                x[centre + j] * w[j + half] * np.exp(-2j * np.pi * row * j / n_fft)
                for j in range(-half, half + 1)
                if 0 <= centre + j < 50
            )
            assert plane.values[row, column] == pytest.approx(abs(total) ** 2, abs=1e-13)
    assert plane.time.tolist() == [i * hop / rate for i in range(17)]
    assert np.allclose(plane.omega, 2 * np.pi * rate * np.arange(17) / n_fft)


def test_cosine_has_a_ridge_of_amplitude_squared_at_its_frequency() -> None:
    t = np.arange(512) / 32.0
    plane = spectrogram(1.5 * np.cos(2 * np.pi * 6.0 * t) + 4.0, 32.0, window_seconds=4.0, n_fft=512, start=7.0)
    middle = plane.values[:, 256]
    assert plane.frequency_hz[middle.argmax()] == 6.0
    assert middle.max() == pytest.approx(1.5**2, rel=1e-4)
    assert plane.time[0] == 7.0


def test_click_is_centred_on_its_own_time() -> None:
    x = np.zeros(101)
    x[40] = 1.0
    plane = spectrogram(x, 10.0, window_seconds=2.0, remove_mean=False)
    assert plane.time[plane.values.sum(axis=0).argmax()] == 4.0
    assert np.flatnonzero(plane.values[0] > 1e-20).tolist() == list(range(30, 51))


@pytest.mark.parametrize(
    ("x", "arguments", "message"),
    [
        (np.ones(10, dtype=complex), {"window_seconds": 1.0}, "complex"),
        (np.ones(10), {"window_seconds": 20.0}, "the signal has 10"),
        (np.ones(10), {"window_seconds": 4.0, "hop": 0}, "hop 0"),
        (np.ones(10), {"window_seconds": 4.0, "n_fft": 3}, "n_fft 3"),
        (np.ones(10), {"window_seconds": 4.0, "memory": 100}, "over the budget"),
    ],
)
def test_unusable_requests_are_named(x: np.ndarray, arguments: dict[str, float], message: str) -> None:
    with pytest.raises(InputError, match=message):
        spectrogram(x, 1.0, **arguments)  # type: ignore[arg-type]
