"""Convolution block by block, beside the sum itself and SciPy's."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.signal import oaconvolve

from ridgeback.numeric.signal.convolution import block_size, convolved


def samples(size, *, turning, seed):
    draw = np.random.default_rng(seed)
    return draw.normal(size=size) + (1j * draw.normal(size=size) if turning else 0.0)


@settings(max_examples=40, deadline=None)
@given(st.integers(1, 400), st.integers(1, 60), st.booleans(), st.integers(0, 99))
def test_it_is_the_sum(length, window, turning, seed):
    x, w = samples(length, turning=turning, seed=seed), samples(window, turning=False, seed=seed + 1)
    whole = np.convolve(x, w)
    first = (window - 1) // 2
    assert np.allclose(convolved(x, w), whole[first : first + length], rtol=0.0, atol=1e-12)


@pytest.mark.parametrize(("length", "window"), [(4643, 65), (1281, 257), (20000, 129), (640, 639)])
@pytest.mark.parametrize("turning", [False, True])
def test_it_is_that_of_scipy(length, window, turning):
    x, w = samples(length, turning=turning, seed=1), samples(window, turning=False, seed=2)
    assert np.allclose(convolved(x, w), oaconvolve(x, w, mode="same"), rtol=0.0, atol=1e-12)


@given(st.integers(2, 100_000), st.integers(2, 3000))
def test_what_runs_over_a_block_ends_in_the_next(length, window):
    size = block_size(length, window, real=True)
    assert size >= length + window - 1 or size - window + 1 >= window - 1
