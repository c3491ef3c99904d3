"""The cross-Wigner distribution: the sum written out, its symmetries, its integral, and what it says of cross terms."""

from __future__ import annotations

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.distributions.cross_wigner import cross_wigner
from ridgeback.numeric.distributions.wigner import pseudo_wigner, wigner


def noise(size: int, seed: int) -> np.ndarray:
    rng = np.random.default_rng([seed, size])
    return rng.normal(size=size) + 1j * rng.normal(size=size)


@pytest.mark.parametrize("size", [1, 2, 5, 8, 17])
def test_is_the_sum_written_out(size: int) -> None:
    x, y, rate, half = noise(size, 1), noise(size, 2), 5.0, (size - 1) // 2
    expected = np.zeros((size, size), dtype=complex)
    for n in range(size):
        for m in range(-half, half + 1):
            if 0 <= n + m < size and 0 <= n - m < size:
                turn = np.exp(-2j * np.pi * m * np.arange(size) / size)
                expected[:, n] += 2.0 / rate * x[n + m] * np.conj(y[n - m]) * turn
    assert np.abs(cross_wigner(x, y, rate).values - expected).max() < 1e-12 * np.abs(expected).max()


def test_window_and_bins_are_those_of_the_pseudo_wigner_distribution() -> None:
    x = noise(60, 3)
    own = pseudo_wigner(x, 6.0, lag_seconds=3.0, n_fft=50)
    plane = cross_wigner(x, x, 6.0, lag_seconds=3.0, n_fft=50)
    assert np.abs(plane.values - own.values).max() < 1e-12 * np.abs(own.values).max()
    assert np.array_equal(plane.omega, own.omega)


@pytest.mark.parametrize("size", [40, 41])
def test_symmetry_cross_term_and_integral(size: int) -> None:
    x, y, rate = noise(size, 4), noise(size, 5), 8.0
    plane = cross_wigner(x, y, rate).values
    scale = np.abs(plane).max()
    assert np.abs(cross_wigner(y, x, rate).values - plane.conj()).max() < 1e-12 * scale
    cross = wigner(x + y, rate).values - wigner(x, rate).values - wigner(y, rate).values
    assert np.abs(cross - 2.0 * plane.real).max() < 1e-12 * scale
    # d_omega / (2 pi) sum over omega is x conj y; over time as well, the inner product.
    assert np.abs(plane.sum(axis=0) * rate / 2 / size - x * y.conj()).max() < 1e-12 * scale


def test_single_precision_is_the_plane_to_seven_digits() -> None:
    x, y = noise(90, 6), noise(90, 7)
    double, single = cross_wigner(x, y, 8.0), cross_wigner(x, y, 8.0, single=True)
    assert single.values.dtype == np.complex64
    assert single.settings["precision"] == "float32"
    error = np.abs(single.values - double.values).max() / np.abs(double.values).max()
    assert 1e-10 < error < 1e-6


def test_unusable_pairs_are_named() -> None:
    with pytest.raises(InputError, match="signals have 8 and 9 samples"):
        cross_wigner(noise(8, 0), noise(9, 0), 1.0)
    with pytest.raises(InputError, match=r"cross-wigner of 64 samples by 64 bins needs .* over the budget"):
        cross_wigner(noise(64, 0), noise(64, 1), 1.0, memory=1000)
