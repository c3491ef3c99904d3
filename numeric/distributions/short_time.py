"""The short-time Fourier kernel: windowed segments of a complex signal, for the ridge of its spectrogram.

S(omega, t_n) = sum over j of z[n + j] w[j] exp(-i omega j / rate); the ridge is the maximum of |S|^2.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy import fft

from ridgeback.numeric.arrays import Array, ComplexArray
from ridgeback.numeric.distributions.bin_interpolation import OVERSAMPLING
from ridgeback.numeric.distributions.lag_kernel import BLOCK_BYTES
from ridgeback.numeric.signal.samples import TWO_PI


def short_time_spectra(signal: ComplexArray, window: Array, start: int, stop: int, n_fft: int) -> ComplexArray:
    """S on the bins 2 pi rate k / n_fft, k = 0 .. n_fft - 1, for n = start .. stop - 1; zero outside the record.

    >>> short_time_spectra(np.array([1.0, 2.0, 3.0 + 0j]), np.array([1.0, 1.0, 1.0]), 1, 2, 4).round(12).tolist()
    [[(6+0j), (2-2j), (-2+0j), (2+2j)]]
    """
    half = window.size // 2
    padded = np.pad(signal, half)[start : stop + 2 * half]
    segments = np.lib.stride_tricks.sliding_window_view(padded, window.size)
    filled = np.zeros((stop - start, n_fft), dtype=np.complex128)
    np.multiply(segments[:, half:], window[half:], out=filled[:, : half + 1])
    if half:
        np.multiply(segments[:, :half], window[:half], out=filled[:, -half:])
    return np.asarray(fft.fft(filled, axis=1, overwrite_x=True), dtype=np.complex128)


@dataclass(frozen=True)
class ShortTimeKernel:
    """A complex signal and its symmetric window ``w[-half..half]``; zero outside the record."""

    signal: ComplexArray
    rate: float
    window: Array

    @property
    def n_fft(self) -> int:
        """Bins enough for |S|^2, whose lags reach as far as the window is long, to be read between the bins."""
        return int(fft.next_fast_len(math.ceil(OVERSAMPLING * (2 * self.window.size - 1))))

    @property
    def origin(self) -> float:
        """The bins begin at 0."""
        return 0.0

    @property
    def period(self) -> float:
        """2 pi rate."""
        return TWO_PI * self.rate

    def spans(self) -> Iterator[tuple[int, int]]:
        """Consecutive (start, stop) that cover the record."""
        size, block = self.signal.size, max(1, BLOCK_BYTES // (40 * self.n_fft))
        for start in range(0, size, block):
            yield start, min(start + block, size)

    def searched(self) -> Iterator[tuple[int, int, Array]]:
        """|S|^2 on the bins 2 pi rate k / n_fft, a few columns at a time."""
        for start, stop in self.spans():
            spectra = short_time_spectra(self.signal, self.window, start, stop, self.n_fft)
            yield start, stop, np.asarray(spectra.real**2 + spectra.imag**2, dtype=np.float64)
