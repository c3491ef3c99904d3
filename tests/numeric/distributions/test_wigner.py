"""The Wigner family against sums written out, closed forms, its marginals, and the faults seen in other packages."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.numeric.distributions.lag_kernel import LagKernel
from ridgeback.numeric.distributions.ridge import follow
from ridgeback.numeric.distributions.wigner import pseudo_wigner, smoothed_pseudo_wigner, wigner, wigner_kernel
from ridgeback.numeric.signal.analytic import as_analytic
from ridgeback.numeric.signal.windows import window

SIZES = [1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 13, 16, 17, 31]


def noise(size: int, seed: int = 0) -> np.ndarray:
    rng = np.random.default_rng([seed, size])
    return rng.normal(size=size) + 1j * rng.normal(size=size)


def slow_twin(z: np.ndarray, rate: float, h: np.ndarray, g: np.ndarray, n_fft: int) -> np.ndarray:
    """sum over l, m of g[l] h[m] z[n+l+m] conj z[n+l-m] exp(-2 pi i m k / n_fft) * 2 / rate, term by term."""
    half_lag, half_smooth = h.size // 2, g.size // 2
    values = np.zeros((n_fft, z.size), dtype=complex)
    for n in range(z.size):
        for m in range(-half_lag, half_lag + 1):
            total = 0.0 + 0.0j
            for j in range(-half_smooth, half_smooth + 1):
                a, b = n + j + m, n + j - m
                if 0 <= a < z.size and 0 <= b < z.size:
                    total += g[j + half_smooth] * z[a] * np.conj(z[b])
            values[:, n] += h[m + half_lag] * total * np.exp(-2j * np.pi * m * np.arange(n_fft) / n_fft)
    assert np.abs(values.imag).max() < 1e-10
    return values.real * 2.0 / rate


@pytest.mark.parametrize("size", SIZES)
def test_wigner_is_the_sum_written_out(size: int) -> None:
    z, half = noise(size), (size - 1) // 2
    expected = slow_twin(z, 5.0, np.ones(2 * half + 1), np.ones(1), size)
    plane = wigner(z, 5.0)
    assert np.abs(plane.values - expected).max() < 1e-12 * max(1.0, np.abs(expected).max())
    assert np.allclose(plane.omega, np.pi * 5.0 * np.arange(size) / size)


@pytest.mark.parametrize(("size", "half", "smooth"), [(9, 2, 1), (13, 4, 2), (16, 3, 3), (21, 6, 1)])
def test_smoothed_and_plain_pseudo_wigner_are_the_sums_written_out(size: int, half: int, smooth: int) -> None:
    z, rate = noise(size), 4.0
    h, g = window("hann", half), window("hann", smooth)
    expected = slow_twin(z, rate, h, g / g.sum(), 24)
    plane = smoothed_pseudo_wigner(z, rate, lag_seconds=2 * half / rate, smoothing_seconds=2 * smooth / rate, n_fft=24)
    assert np.abs(plane.values - expected).max() < 1e-12 * np.abs(expected).max()
    expected = slow_twin(z, rate, h, np.ones(1), 24)
    plane = pseudo_wigner(z, rate, lag_seconds=2 * half / rate, lag_window="hann", n_fft=24)
    assert np.abs(plane.values - expected).max() < 1e-12 * np.abs(expected).max()


@pytest.mark.parametrize("decimation", [1, 3])
@pytest.mark.parametrize(("half", "smooth"), [(48, 0), (20, 0), (20, 3)])
def test_small_blocks_and_short_lags_near_the_border_leave_nothing_out(
    monkeypatch: pytest.MonkeyPatch, half: int, smooth: int, decimation: int
) -> None:
    monkeypatch.setattr("ridgeback.numeric.distributions.lag_kernel.BLOCK_BYTES", 1)
    monkeypatch.setattr("ridgeback.numeric.distributions.lag_kernel.SMOOTHING_BYTES", 1)
    z, h, g = noise(97), window("blackman", half)[half:], window("hann", smooth)
    kernel = LagKernel(z, 5.0, h[::decimation], g, 200, decimation)
    n = np.arange(97)
    product = np.zeros((97, kernel.half_lags + 1), dtype=complex)
    for m in range(kernel.half_lags + 1):
        ahead, behind = n + decimation * m, n - decimation * m
        both = (ahead < 97) & (behind >= 0)
        product[both, m] = z[ahead[both]] * z[behind[both]].conj()
    smoothed = np.stack([np.convolve(column, g, mode="same") for column in product.T], axis=1)
    exact = 2.0 * decimation / 5.0 * smoothed * h[::decimation]
    m = np.arange(1, kernel.half_lags + 1)
    seen = 0
    for first, last, spectra in kernel.searched():
        assert first == seen
        seen, bins = last, spectra.shape[1]
        turns = np.exp(-2j * np.pi * np.outer(m, np.arange(bins)) / bins)
        expected = exact[first:last, :1].real + 2.0 * (exact[first:last, 1:] @ turns).real
        assert np.abs(spectra - expected).max() < 1e-12 * np.abs(exact).sum(axis=1).max()
    assert seen == 97


@pytest.mark.parametrize("size", [1, 2, 5, 8, 97, 100, 641])
def test_energy_and_both_marginals_are_exact(size: int) -> None:
    z, rate = noise(size), 10.0
    plane = wigner(z, rate)
    d_omega = np.pi * rate / size
    assert (
        np.abs(plane.values.sum(axis=0) * d_omega / (2 * np.pi) - np.abs(z) ** 2).max() < 1e-12 * np.abs(z).max() ** 2
    )

    def spectrum(omega: np.ndarray) -> np.ndarray:
        return np.exp(-1j * np.outer(omega, np.arange(size)) / rate) @ z / rate

    expected = np.abs(spectrum(plane.omega)) ** 2 + np.abs(spectrum(plane.omega + np.pi * rate)) ** 2
    assert np.abs(plane.values.sum(axis=1) / rate - expected).max() < 1e-12 * expected.max()
    if size > 1:
        assert plane.energy() == pytest.approx(np.sum(np.abs(z) ** 2) / rate, rel=1e-12)


def test_analytic_signal_has_its_own_spectrum_as_marginal_on_its_dft_bins() -> None:
    rate, size = 8.0, 100  # for odd N the aliased half falls between the bins
    x = np.random.default_rng(3).normal(size=size)
    plane = wigner(x, rate)
    spectrum = np.fft.fft(as_analytic(x)) / rate
    marginal = plane.values.sum(axis=1) / rate
    positive = np.arange(1, size // 2)
    assert np.abs(marginal[2 * positive] - np.abs(spectrum[positive]) ** 2).max() < 1e-12 * np.abs(spectrum).max() ** 2


def test_pseudo_wigner_keeps_the_time_marginal() -> None:
    z = noise(60)
    plane = pseudo_wigner(z, 6.0, lag_seconds=3.0)
    d_omega = plane.omega[1]
    assert np.abs(plane.values.sum(axis=0) * d_omega / (2 * np.pi) - np.abs(z) ** 2).max() < 1e-12


@pytest.mark.parametrize("size", [64, 65, 67, 641])
def test_axis_is_not_wrong_by_two_and_no_size_crashes(size: int) -> None:
    rate, frequency = 32.0, 5.0
    tone = np.exp(2j * np.pi * frequency * np.arange(size) / rate)
    plane = wigner(tone, rate)
    assert plane.frequency_hz[plane.values[:, size // 2].argmax()] == pytest.approx(frequency, abs=rate / 2 / size)
    assert plane.frequency_hz[-1] < rate / 2


def test_gaussian_atom_is_a_gaussian_in_the_plane() -> None:
    # z = (a/pi)^(1/4) exp(-a t^2/2 + i (w0 t + b t^2/2)):  W = 2 exp(-a t^2 - (omega - w0 - b t)^2 / a).
    rate, a, w0, b = 20.0, 1.5, 12.0, 2.0
    t = (np.arange(241) - 120) / rate
    z = (a / np.pi) ** 0.25 * np.exp(-0.5 * a * t * t + 1j * (w0 * t + 0.5 * b * t * t))
    plane = wigner(z, rate, start=t[0])
    wide = np.arange(-2, 3)[:, None, None] * np.pi * rate  # the axis is periodic in pi * rate
    omega, time = plane.omega[:, None], plane.time[None, :]
    expected = (2 * np.exp(-a * time**2 - (omega - w0 - b * time + wide) ** 2 / a)).sum(axis=0)
    ghost = np.abs(plane.values - expected)
    assert ghost.max() < 1e-9


def test_linear_chirp_ridge_is_exact_so_no_lag_is_off_by_one() -> None:
    rate = 32.0
    t = np.arange(513) / rate
    z = np.exp(2j * np.pi * (2.0 * t + 0.1 * t * t))
    ones = np.ones(t.size)
    ridge = follow(wigner_kernel(z, rate), 0.5 * ones, 60.0 * ones)
    inner = slice(20, -20)
    assert np.abs(ridge.omega / (2 * np.pi) - 2.0 - 0.2 * t)[inner].max() < 1e-9
    assert ridge.inside[inner].all()


@given(st.integers(-6, 6), st.integers(0, 15))
@settings(deadline=None, max_examples=25)
def test_covariance_under_modulation_and_shift(shift: int, bins: int) -> None:
    size, rate = 32, 4.0
    z = np.zeros(size, dtype=complex)
    z[10:20] = noise(10)
    turned = z * np.exp(1j * np.pi * bins * np.arange(size) / size)
    moved = np.roll(turned, shift)
    expected = np.roll(np.roll(wigner(z, rate).values, bins, axis=0), shift, axis=1)
    assert np.abs(wigner(moved, rate).values - expected).max() < 1e-11


def test_smoothing_neither_wraps_round_nor_renormalises_at_the_border() -> None:
    rate = 8.0
    z = np.zeros(64, dtype=complex)
    z[-1] = 1.0
    plane = smoothed_pseudo_wigner(z, rate, lag_seconds=2.0, smoothing_seconds=2.0)
    assert np.abs(plane.values[:, :40]).max() < 1e-14
    g = window("hann", 8) / window("hann", 8).sum()
    assert plane.values[:, -1] == pytest.approx(np.full(plane.omega.size, 2.0 / rate * g[8]))
    tone = np.exp(2j * np.pi * 1.3 * np.arange(64) / rate)
    ones = np.ones(64)
    kernel = wigner_kernel(tone, rate, lag_seconds=4.0, smoothing_seconds=2.0)
    ridge = follow(kernel, 2.0 * ones, 20.0 * ones)
    assert np.abs(ridge.omega[2:-2] / (2 * np.pi) - 1.3).max() < 1e-9


def test_one_bad_sample_is_named_and_does_not_spread() -> None:
    x = np.ones(256)
    x[100] = np.nan
    for transform in (wigner, lambda x, r: pseudo_wigner(x, r, lag_seconds=1.0)):
        with pytest.raises(InputError, match=r"signal\[100\] is nan"):
            transform(x, 32.0)


def test_memory_is_predicted_and_refused_before_the_work() -> None:
    with pytest.raises(
        InputError, match=r"wigner of 200000 samples by 200000 bins needs 3\.2e\+05 MB, over the budget"
    ):
        wigner(np.ones(200_000, dtype=complex), 1.0)
    with pytest.raises(InputError, match=r"over the budget of 0\.001 MB"):
        wigner(np.ones(64, dtype=complex), 1.0, memory=1000)


def test_band_limited_lags_are_decimated_and_the_ridge_stays() -> None:
    rate = 64.0
    t = np.arange(1025) / rate
    fade = np.exp(-(((t - 8.0) / 2.0) ** 2))  # to 1e-7 at both ends, since the DFT takes the record as one period
    inside = fade * np.exp(2j * np.pi * (3.0 * t + 0.04 * t * t))
    outside = 0.7 * fade * np.exp(2j * np.pi * 14.0 * t)
    low, high = np.full(t.size, 15.0), np.full(t.size, 35.0)
    kernel = wigner_kernel(inside + outside, rate, band=(15.0, 35.0))
    assert kernel.decimation == 6
    ridge = follow(kernel, low, high)
    middle = (t > 5.0) & (t < 11.0)
    assert np.abs(ridge.omega / (2 * np.pi) - 3.0 - 0.08 * t)[middle].max() < 1e-6
    alone = wigner_kernel(inside, rate)
    assert np.abs(follow(alone, low, high).omega - ridge.omega)[middle].max() < 1e-5


def test_band_limited_column_is_the_full_one_folded_into_the_band() -> None:
    # Every D-th lag of K gives the sum of D copies of its spectrum, moved by one period each.
    rate, size, n = 32.0, 240, np.arange(240)
    wave = np.exp(2j * np.pi * 40 * n / size) * (1.0 + 0.3 * np.cos(2 * np.pi * 3 * n / size))  # 37 .. 43 cycles
    band = (2 * np.pi * rate * 35 / size, 2 * np.pi * rate * 45 / size)
    kernel = wigner_kernel(wave + np.exp(2j * np.pi * 90 * n / size), rate, lag_seconds=4.0, band=band)
    assert kernel.decimation == 8
    m, column = np.arange(-64, 65), 100
    product = window("hann", 64) * wave[column + m] * wave[column - m].conj()
    copies = kernel.omega[:, None] + kernel.period * np.arange(8)
    full = (np.exp(-2j * copies[..., None] * m / rate) @ product).real * 2.0 / rate
    found = next(kernel.spectra(column, column + 1, kernel.n_fft))[2][0]
    assert np.abs(found - full.sum(axis=1)).max() < 1e-12 * np.abs(full).max()


@pytest.mark.parametrize("smoothing", [None, 0.5])
def test_single_precision_errs_by_its_rounding(smoothing: float | None) -> None:
    z, rate = noise(500), 20.0
    if smoothing is None:
        double, single = wigner(z, rate), wigner(z, rate, single=True)
    else:
        windows = {"lag_seconds": 5.0, "smoothing_seconds": smoothing}
        double, single = (smoothed_pseudo_wigner(z, rate, **windows, single=one) for one in (False, True))
    assert single.values.dtype == np.float32
    assert single.settings["precision"] == "float32"
    error = np.abs(single.values - double.values).max() / np.abs(double.values).max()
    assert 1e-9 < error < 1e-6
    assert not single.values.flags.writeable


def test_single_precision_track_errs_little() -> None:
    rate = 32.0
    t = np.arange(513) / rate
    z = np.exp(2j * np.pi * (2.0 * t + 0.1 * t * t))
    ones = np.ones(t.size)
    ridge = follow(wigner_kernel(z, rate, single=True), 0.5 * ones, 60.0 * ones)
    assert 1e-12 < np.abs(ridge.omega / (2 * np.pi) - 2.0 - 0.2 * t)[40:-40].max() < 1e-5


@pytest.mark.parametrize("scale", [1e-13, 1e13])
def test_single_precision_refuses_what_would_leave_it(scale: float) -> None:
    with pytest.raises(InputError, match="in single precision; scale it"):
        wigner(scale * np.ones(8), 1.0, single=True, remove_mean=False)


@pytest.mark.parametrize("windows", [{}, {"lag_seconds": 4.0, "smoothing_seconds": 1.0}], ids=["full", "smoothed"])
def test_ridge_never_holds_a_plane(windows: dict[str, float]) -> None:
    size, rate = 8192, 100.0
    t = np.arange(size) / rate
    kernel = wigner_kernel(np.exp(2j * np.pi * (5.0 * t + 0.05 * t * t)), rate, **windows)  # type: ignore[arg-type]
    low, high = np.full(size, 10.0), np.full(size, 200.0)
    tracemalloc.start()
    ridge = follow(kernel, low, high)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 10_000_000  # the plane would take 537 MB
    assert np.abs(ridge.omega / (2 * np.pi) - 5.0 - 0.1 * t)[300:-300].max() < 1e-7


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"n_fft": 10}, "n_fft 10 is below the 63 lags"),
        ({"lag_seconds": 99.0}, "lag_seconds 99 needs 793 samples, the signal has 64"),
        ({"lag_seconds": -1.0}, "lag_seconds -1.0 is not a positive width"),
        ({"lag_seconds": 1.0, "lag_window": "round"}, "window 'round' is unknown; use one of rectangular, hann"),
    ],
)
def test_windows_that_do_not_fit_are_refused(arguments: dict[str, float], message: str) -> None:
    with pytest.raises(InputError, match=message):
        wigner_kernel(noise(64), 8.0, **arguments)  # type: ignore[arg-type]


@pytest.mark.parametrize("rate", [0.0, -1.0, np.nan, np.inf])
def test_rate_must_be_positive(rate: float) -> None:
    with pytest.raises(InputError, match="sampling rate"):
        wigner(noise(8), rate)
