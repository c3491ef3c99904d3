"""Convolution of a long signal with a short window, by Fourier transforms of its blocks.

``scipy.signal.oaconvolve`` gives the same; the import of that package takes as long as a few tracks.
"""

from __future__ import annotations

import math
from typing import TypeVar

import numpy as np
from scipy import fft
from scipy.special import lambertw

from ridgeback.numeric.arrays import Array, ComplexArray

Values = TypeVar("Values", Array, ComplexArray)


# Overlap-add: A. V. Oppenheim and R. W. Schafer, Discrete-Time Signal Processing, 3rd edition, 2010, section 8.7.3.
def convolved(x: Values, w: Array) -> Values:
    """The middle ``x.size`` values of sum_j w_j x_(n - j), x being 0 beyond its ends.

    Parameters
    ----------
    x : array of float or complex, shape (N,)
        The signal.
    w : array of float, shape (K,)
        The window; its middle, the earlier of two, stands at the sample that a value is for.

    Returns
    -------
    array, shape (N,)
        Each block's values, and what the block before it gives beyond its end.

    Examples
    --------
    >>> convolved(np.array([1.0, 0.0, 0.0, 2.0]), np.array([1.0, 2.0, 3.0])).round(12).tolist()
    [2.0, 3.0, 2.0, 4.0]
    """
    size = block_size(x.size, w.size, real=not np.iscomplexobj(x))
    step, first = size - w.size + 1, (w.size - 1) // 2
    blocks = np.zeros((-(-x.size // step), step), dtype=x.dtype)
    blocks.reshape(-1)[: x.size] = x
    parts: Values = np.asarray(products(blocks, w, size), dtype=x.dtype)
    parts[1:, : w.size - 1] += parts[:-1, step:]
    whole = np.concatenate((parts[:, :step].reshape(-1), parts[-1, step:]))
    return whole[first : first + x.size]


def products(blocks: Array | ComplexArray, w: Array, size: int) -> Array | ComplexArray:
    """The convolution of each block with the window, by transforms of so many samples."""
    if np.iscomplexobj(blocks):
        return np.asarray(fft.ifft(fft.fft(blocks, size) * fft.fft(w, size), size))
    return np.asarray(fft.irfft(fft.rfft(blocks.real, size) * fft.rfft(w, size), size))


def block_size(length: int, window: int, *, real: bool) -> int:
    """The length of a transform: the one that takes the least work a sample, or one of all where that is no shorter.

    A block of N costs N log(2 N) and gives N - K samples, K = window - 1; the derivative vanishes at N = K log(2 N e),
    or N = -K W(-1/(2 e K)) on the lower branch of Lambert's function.

    >>> block_size(100000, 1025, real=True), block_size(1281, 257, real=True)
    (11319, 1600)
    """
    overlap, whole = window - 1, int(fft.next_fast_len(length + window - 1, real=real))
    if overlap == 0 or 2 * window >= length:
        return whole
    best = -overlap * float(lambertw(-1.0 / (2.0 * math.e * overlap), -1).real)
    block = int(fft.next_fast_len(math.ceil(best)))
    return block if block < length else whole
