"""One ridge for every distribution: on a chirp whose frequency is known, and what it says where there is none."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from ridgeback.common.errors import InputError
from ridgeback.numeric.distributions.cross_wigner import cross_wigner
from ridgeback.numeric.distributions.distribution import Distribution
from ridgeback.numeric.distributions.plane_ridge import ridge, rows_between
from ridgeback.numeric.distributions.polynomial_wigner import polynomial_wigner
from ridgeback.numeric.distributions.reassigned_spectrogram import reassigned_spectrogram, synchrosqueezed_spectrogram
from ridgeback.numeric.distributions.spectrogram import spectrogram
from ridgeback.numeric.distributions.wigner import pseudo_wigner, smoothed_pseudo_wigner, wigner

RATE = 32.0
T = np.arange(640) / RATE
OMEGA = 2 * np.pi * (2.0 + 0.1 * T)
CHIRP = np.cos(2 * np.pi * (2.0 * T + 0.05 * T**2))

Maker = Callable[[NDArray[np.float64]], Distribution]

# The share of a bin by which each may be off: a reassigned plane holds whole cells, the others a lobe to read between.
PLANES: dict[str, tuple[Maker, float]] = {
    "wigner": (lambda x: wigner(x, RATE), 0.5),
    "pseudo-wigner": (lambda x: pseudo_wigner(x, RATE, lag_seconds=4.0), 0.1),
    "smoothed-pseudo-wigner": (
        lambda x: smoothed_pseudo_wigner(x, RATE, lag_seconds=4.0, smoothing_seconds=0.5),
        0.1,
    ),
    "polynomial-wigner": (lambda x: polynomial_wigner(x, RATE, lag_seconds=4.0), 0.1),
    "cross-wigner": (lambda x: cross_wigner(x, 2.0 * x, RATE, lag_seconds=4.0), 0.1),
    "spectrogram": (lambda x: spectrogram(x, RATE, window_seconds=4.0, hop=3), 0.1),
    "reassigned-spectrogram": (lambda x: reassigned_spectrogram(x, RATE, window_seconds=4.0), 0.6),
    "synchrosqueezed": (lambda x: synchrosqueezed_spectrogram(x, RATE, window_seconds=4.0), 0.6),
}


@pytest.mark.parametrize("name", PLANES)
def test_the_ridge_of_a_chirp_is_its_frequency_to_a_share_of_a_bin(name: str) -> None:
    make, share = PLANES[name]
    plane = make(CHIRP)
    assert plane.name == name
    assert plane.values.shape == (plane.omega.size, plane.time.size)
    track = ridge(plane, band=(6.0, 40.0))
    assert track.interval is None
    inside = track.between(3.0, 17.0)
    assert inside.valid.all()
    off = np.abs(inside.omega - np.interp(inside.time, T, OMEGA)) / plane.spacing
    assert off.max() < share


def test_border_and_edges_of_the_band_are_not_valid() -> None:
    plane = pseudo_wigner(CHIRP, RATE, lag_seconds=4.0, start=5.0)
    track = ridge(plane)
    seen = track.inside().time
    assert (seen[0], seen[-1]) == (pytest.approx(7.0), pytest.approx(5.0 + T[-1] - 2.0))
    beside = ridge(plane, band=(2 * np.pi * 2.9, 2 * np.pi * 5.0))
    assert not beside.valid[(beside.time > 13.0) & (beside.time < 13.8)].any()
    assert beside.between(16.0, 22.0).valid.all()
    assert not ridge(Distribution(np.zeros((4, 3)), np.arange(4.0), np.arange(3.0), "empty")).valid.any()


def test_rows_at_the_very_edges_of_a_band_lie_in_it() -> None:
    plane = Distribution(np.ones((9, 2)), 0.5 * np.arange(9.0), np.arange(2.0), "example")
    assert rows_between(plane, (1.0, 3.0)) == (2, 7)
    assert rows_between(plane, None) == (0, 9)


def test_a_band_without_rows_is_named() -> None:
    with pytest.raises(InputError, match="pseudo-wigner: 0 rows lie in the band; a ridge needs 3"):
        ridge(pseudo_wigner(CHIRP, RATE, lag_seconds=4.0), band=(500.0, 600.0))


def test_the_shares_of_a_polynomial_distribution_that_are_told_rise_from_0_to_1() -> None:
    told = list[float]()
    polynomial_wigner(CHIRP, RATE, lag_seconds=2.0, progress=lambda share, _: told.append(share))
    assert told[0] == 0.0
    assert told == sorted(told)
    assert told[-1] <= 1.0


def test_the_plane_of_order_two_is_the_pseudo_wigner_distribution() -> None:
    two = polynomial_wigner(CHIRP, RATE, lag_seconds=3.0, order=2, n_fft=256)
    usual = pseudo_wigner(CHIRP, RATE, lag_seconds=3.0, n_fft=256)
    assert np.abs(two.values - usual.values).max() < 1e-12 * np.abs(usual.values).max()
    assert np.array_equal(two.omega, usual.omega)
    with pytest.raises(InputError, match="n_fft 10 is below the 97 lags"):
        polynomial_wigner(CHIRP, RATE, lag_seconds=3.0, order=2, n_fft=10)


def test_the_time_marginal_of_order_six_is_the_sixth_power() -> None:
    tone = 1.3 * np.exp(2j * np.pi * 3.0 * np.arange(128) / 16.0)
    plane = polynomial_wigner(tone, 16.0, lag_seconds=2.0)
    marginal = np.real(plane.values).sum(axis=0) * plane.spacing / (2 * np.pi)
    assert np.abs(marginal / 1.3**6 - 1.0).max() < 1e-9
    complex_plane = cross_wigner(tone, tone, 16.0)
    with pytest.raises(InputError, match="is complex, and has no energy"):
        complex_plane.energy()
