"""The polynomial Wigner kernel against its product written out, on polynomial phases, and on the paper's case."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.distributions import polynomial_wigner
from ridgeback.numeric.distributions.polynomial_wigner import DESIGNS, polynomial_deviation, polynomial_kernel, shifted
from ridgeback.numeric.distributions.ridge import follow
from ridgeback.numeric.distributions.wigner import wigner_kernel
from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.harmonics.noise import Level, peak_deviation
from ridgeback.numeric.signal.analytic import as_analytic
from ridgeback.numeric.signal.windows import window

RATE = 32.0
T = (np.arange(513) - 256) / RATE


def ridge_at_centre(phase: np.ndarray, order: int) -> float:
    z = np.exp(-((T / 1.6) ** 2) + 1j * phase)  # fades out, so that the DFT's period does no harm
    ones = np.ones(T.size)
    kernel = polynomial_kernel(z, RATE, lag_seconds=4.0, order=order)
    return float(follow(kernel, 20.0 * ones, 60.0 * ones).omega[256])


@pytest.mark.parametrize("order", [2, 4, 6])
def test_design_keeps_the_slope_and_order_six_removes_the_cubic(order: int) -> None:
    b, c = np.array([pair[0] for pair in DESIGNS[order]]), np.array([pair[1] for pair in DESIGNS[order]])
    assert 2 * b @ c == pytest.approx(1.0, abs=1e-15)
    assert 2 * np.abs(b).sum() == order
    assert 8 * b @ c**3 == pytest.approx({2: 1.0, 4: 0.25, 6: 0.0}[order], abs=1e-14)


def test_order_two_is_the_pseudo_wigner_distribution() -> None:
    x = np.cos(8.0 * T + np.sin(T))
    same = polynomial_kernel(as_analytic(x), RATE, lag_seconds=3.0, order=2)
    usual = wigner_kernel(x, RATE, lag_seconds=3.0)
    assert np.abs(same.products(0, T.size) * 2 / RATE - usual.columns(0, T.size)).max() < 1e-12


def test_products_are_those_of_the_interpolated_signal_written_out() -> None:
    # For a tone of whole cycles per record the interpolation is exact, and so is every factor.
    size, cycles = 128, 9
    z = np.exp(2j * np.pi * cycles * np.arange(size) / size)
    kernel = polynomial_kernel(z, 16.0, lag_seconds=2.0, lag_window="rectangular")
    m = np.arange(kernel.half_window.size)
    assert np.abs(kernel.products(0, z.size)[64] - np.exp(2j * np.pi * cycles * 2 * m / size)).max() < 1e-12


@pytest.mark.parametrize("samples", [0.3, -1.7, 5.0])
def test_shift_is_band_limited_interpolation(samples: float) -> None:
    n = np.arange(64)
    z = np.exp(2j * np.pi * 5 * n / 64) + 0.3 * np.exp(2j * np.pi * 11 * n / 64)
    at = n + samples
    expected = np.exp(2j * np.pi * 5 * at / 64) + 0.3 * np.exp(2j * np.pi * 11 * at / 64)
    inside = (at >= 0) & (at <= 63)
    assert np.abs(shifted(z, samples) - np.where(inside, expected, 0.0)).max() < 1e-12


def test_order_six_is_exact_for_cubic_and_quartic_phase_where_order_two_is_not() -> None:
    cubic = 40.0 * T + 0.5 * T**3 / 6.0
    assert abs(ridge_at_centre(cubic, 2) - 40.0) > 0.05
    assert abs(ridge_at_centre(cubic, 6) - 40.0) < 1e-6
    assert abs(ridge_at_centre(cubic + 0.02 * T**4, 6) - 40.0) < 1e-6
    assert abs(ridge_at_centre(40.0 * T + 1e-3 * T**5, 6) - 40.0) > 1e-5  # the fifth degree is beyond it


def test_order_six_in_the_paper_case(pendulum_decay: Callable[..., Any]) -> None:
    decay = pendulum_decay()
    track = estimate(decay.u, RATE, method="polynomial-wigner")
    assert decay.error(track.time, track.omega) < 3.3e-5
    assert track.settings["harmonics_removed"] == (3, 5, 7)


def test_deviation_of_order_two_is_the_known_one_and_order_six_pays_for_its_exactness() -> None:
    level = Level(np.ones(3), 0.01)
    h = window("hann", 24)[24:]
    plain = peak_deviation(level, RATE, h)
    assert polynomial_deviation(level, RATE, h, 2) == pytest.approx(plain, rel=1e-12)
    assert np.all(polynomial_deviation(level, RATE, h, 6) > plain)


def test_unusable_requests_are_named() -> None:
    x = as_analytic(np.cos(8.0 * T))
    with pytest.raises(InputError, match=r"order 5 .* use 2, 4 or 6"):
        polynomial_kernel(x, RATE, lag_seconds=2.0, order=5)
    with pytest.raises(InputError, match=r"n_fft 20 is below the 37 lags"):
        polynomial_kernel(x, RATE, lag_seconds=2.0, n_fft=20)


def test_stretches_of_time_make_the_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    z = as_analytic(np.cos(8.0 * T + np.sin(T)))
    whole = [spectra for *_, spectra in polynomial_kernel(z, RATE, lag_seconds=3.0).searched()]
    monkeypatch.setattr(polynomial_wigner, "STRETCH_BYTES", 16 * 36 * 100)
    parts = list(polynomial_kernel(z, RATE, lag_seconds=3.0).searched())
    assert len(parts) > len(whole)
    assert np.abs(np.concatenate([spectra for *_, spectra in parts]) - np.concatenate(whole)).max() < 1e-12
