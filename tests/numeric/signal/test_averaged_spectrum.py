"""Welch's spectrum beside SciPy's."""

import numpy as np
import pytest
from scipy.signal import welch

from ridgeback.numeric.signal.averaged_spectrum import averaged_spectrum


@pytest.mark.parametrize(("size", "length"), [(1000, 64), (1001, 101), (333, 333), (40, 17), (4643, 1857)])
def test_it_is_that_of_scipy(size: int, length: int) -> None:
    x = 3.0 + np.random.default_rng(size).normal(size=size).cumsum()
    frequency, power = averaged_spectrum(x, 7.0, length)
    expected = welch(x, 7.0, "hann", length, detrend="constant")
    assert np.allclose(frequency, expected[0], rtol=1e-14)
    assert np.allclose(power, expected[1], rtol=1e-9, atol=1e-12 * expected[1].max())
