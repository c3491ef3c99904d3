"""The band of the Hilbert frequency: one inside, nothing outside, raised cosines between."""

from __future__ import annotations

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.estimators import reassigned_ridge
from ridgeback.numeric.estimators.hilbert import TAPER, band_mask
from ridgeback.numeric.estimators.phase import by_hilbert
from ridgeback.numeric.signal.decimation import Samples
from ridgeback.numeric.signal.windows import window
from ridgeback.numeric.tracking.request import Options, prepared


def test_the_edges_of_the_band_are_raised_cosines() -> None:
    low, high = 2.0, 7.0
    edge = TAPER * (high - low)
    omega = np.linspace(0.0, 10.0, 2001)
    found = band_mask(omega, low, high)
    share = (omega[(omega >= low) & (omega <= low + edge)] - low) / edge
    assert np.allclose(band_mask(low + share * edge, low, high), 0.5 * (1.0 - np.cos(np.pi * share)), atol=1e-12)
    assert np.allclose(found, band_mask(low + high - omega, low, high), atol=1e-12)  # both edges alike
    assert np.all(found[(omega > low + edge) & (omega < high - edge)] == 1.0)
    assert not found[(omega < low) | (omega > high)].any()


def test_a_record_within_two_cycles_of_its_ends_is_refused_with_that_distance() -> None:
    request = prepared(Samples(np.cos(4 * np.pi * np.arange(56) / 32.0), 32.0, 0.0), Options())
    with pytest.raises(InputError, match=rf"samples of 56 lie {2 * request.signal.cycle:.4g} inside the record"):
        by_hilbert(request)
    assert request.signal.cycle == pytest.approx(0.5, rel=0.05)


def test_the_lobe_of_the_widest_window_ends_where_its_mean_is_taken_to() -> None:
    """Blackman's: its transform falls up to the third bin of its own length, where it vanishes."""
    half = 200
    j = np.arange(-half, half + 1)
    turning = 2 * np.pi / (2 * half + 2) * np.multiply.outer(np.linspace(0.0, reassigned_ridge.LOBE, 40), j)
    transform = np.cos(turning) @ window("blackman", half)
    assert np.all(np.diff(transform) < 0.0)
    assert abs(transform[-1]) < 1e-9 * transform[0]
