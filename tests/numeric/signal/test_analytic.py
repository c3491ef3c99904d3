from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.signal import hilbert

from ridgeback.common.errors import InputError
from ridgeback.numeric.signal.analytic import analytic_signal, positive_frequency_weights

signals = st.integers(1, 40).flatmap(lambda n: arrays(np.float64, n, elements=st.floats(-1e3, 1e3)))


@given(signals)
@settings(deadline=None, max_examples=60)
def test_real_part_is_the_signal_and_negative_frequencies_vanish(x: np.ndarray) -> None:
    z = analytic_signal(x)
    assert np.array_equal(z.real, x)
    spectrum = np.fft.fft(z)
    negative = np.fft.fftfreq(x.size) < 0
    if x.size % 2 == 0:
        negative[x.size // 2] = False  # the Nyquist bin belongs to both halves
    assert np.abs(spectrum[negative]).max(initial=0.0) <= 1e-10 * max(1.0, np.abs(x).sum())


@pytest.mark.parametrize("size", [1, 2, 3, 5, 8, 13, 641])
def test_agrees_with_scipy_and_with_the_sum_written_out(size: int) -> None:
    x = np.random.default_rng(size).normal(size=size)
    n = np.arange(size)
    spectrum = np.array([np.sum(x * np.exp(-2j * np.pi * k * n / size)) for k in range(size)])
    weighted = positive_frequency_weights(size) * spectrum
    slow = np.array([np.sum(weighted * np.exp(2j * np.pi * n * j / size)) / size for j in range(size)])
    assert np.abs(analytic_signal(x) - slow).max() < 1e-11
    assert np.abs(analytic_signal(x) - hilbert(x)).max() < 1e-12


def test_cosine_over_whole_cycles_becomes_an_exponential() -> None:
    t = np.arange(60) / 60.0
    assert (
        np.abs(analytic_signal(np.cos(2 * np.pi * 7 * t + 0.3)) - np.exp(1j * (2 * np.pi * 7 * t + 0.3))).max() < 1e-13
    )


def test_border_error_falls_away_from_the_border() -> None:
    t = np.arange(2000) / 100.0
    phase = 2 * np.pi * 1.03 * t + 0.4  # 20.6 cycles: the record does not join on to itself
    error = np.abs(analytic_signal(np.cos(phase)) - np.exp(1j * phase))
    assert error[0] > 0.1
    assert error[300:1700].max() < 0.05
    assert error[900:1100].max() < 0.02


def test_mean_is_removed_only_when_asked() -> None:
    x = np.array([3.0, 5.0, 4.0])
    assert np.isclose(analytic_signal(x).real.mean(), 4.0)
    assert np.isclose(analytic_signal(x, remove_mean=True).real.mean(), 0.0)


@pytest.mark.parametrize(
    ("x", "message"),
    [
        ([0.0, np.nan, 1.0], r"signal\[1\] is nan"),
        ([0.0, 1.0, np.inf], r"signal\[2\] is inf"),
        ([1j, 0j], "complex"),
        ([[1.0, 2.0]], r"shape \(1, 2\)"),
        ([], "0 samples"),
        (["a"], "is of type"),
    ],
)
def test_what_is_not_a_real_signal_is_refused_by_name(x: list[object], message: str) -> None:
    with pytest.raises(InputError, match=message):
        analytic_signal(x)  # type: ignore[arg-type]
