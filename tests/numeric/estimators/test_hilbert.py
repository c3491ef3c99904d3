"""The band of the Hilbert frequency: one inside, nothing outside, raised cosines between."""

from __future__ import annotations

import numpy as np

from ridgeback.numeric.estimators.hilbert import TAPER, band_mask


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
