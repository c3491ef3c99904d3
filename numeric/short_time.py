"""The short-time Fourier kernel: windowed segments of a complex signal, for the ridge of its spectrogram.

S(omega, t_n) = sum over j of z[n + j] w[j] exp(-i omega j / rate); the ridge is the maximum of |S|^2.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy import fft

from numeric.lag_kernel import BLOCK_BYTES
from numeric.lag_moments import lag_moments
from numeric.samples import TWO_PI, Array, ComplexArray


@dataclass(frozen=True)
class ShortTimeKernel:
    """A complex signal and its symmetric window ``w[-half..half]``; zero outside the record."""

    signal: ComplexArray
    rate: float
    window: Array
    n_fft: int

    @property
    def omega(self) -> Array:
        """The bins 2 pi rate k / n_fft of the non-negative half."""
        return TWO_PI * self.rate * np.arange(self.n_fft // 2 + 1) / self.n_fft

    def blocks(self) -> Iterator[tuple[int, int, ComplexArray]]:
        """All segments, a few at a time: (start, stop, segments)."""
        half, size = self.window.size // 2, self.signal.size
        padded = np.pad(self.signal, half)
        segments = np.lib.stride_tricks.sliding_window_view(padded, self.window.size)
        block = max(1, BLOCK_BYTES // (32 * self.n_fft))
        for start in range(0, size, block):
            stop = min(start + block, size)
            yield start, stop, np.asarray(segments[start:stop] * self.window, dtype=np.complex128)

    def spectra(self, columns: ComplexArray) -> Array:
        """|S|^2 on the bins."""
        spectra = fft.fft(columns, n=self.n_fft, axis=1)[:, : self.n_fft // 2 + 1]
        return np.asarray(np.abs(spectra) ** 2, dtype=np.float64)

    # P = |S|^2 with S_j = sum j^k z w e^{..}:  P' = 2 Im conj(S_0) S_1,  P'' = 2 (|S_1|^2 - Re conj(S_0) S_2).
    def derivatives(self, columns: ComplexArray, omega: Array) -> tuple[Array, Array]:
        """First and second derivative of |S|^2 at each column's own omega (scaled by rate)."""
        s0, s1, s2 = lag_moments(columns, omega / self.rate).T
        return 2.0 * (s0.conj() * s1).imag, 2.0 / self.rate * (np.abs(s1) ** 2 - (s0.conj() * s2).real)
