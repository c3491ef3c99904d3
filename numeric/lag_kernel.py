"""The lag kernel: the one core of the Wigner family.

    K[n, m] = z[n + m] conj(z[n - m]),   m = 0 .. M,   z = 0 outside the record.

Only m >= 0 is formed, because K[n, -m] = conj K[n, m]; a Hermitian FFT over m then gives a real column

    W[n, k] = (2 / rate) * sum over m = -M .. M of  h[m] K[n, m] exp(-2 pi i m k / n_fft),

which samples  W(t, omega) = integral of z(t + tau/2) conj z(t - tau/2) h exp(-i omega tau) d tau  at the lags
tau = 2 m / rate, hence at omega_k = pi rate k / n_fft: *half* the spacing of an ordinary DFT, and a period of
pi rate, not 2 pi rate.  (Claasen and Mecklenbräuker, Philips J. Res. 35 (1980) 217, 276, 372.)
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy import fft

from numeric.errors import InputError
from numeric.lag_moments import lag_moments
from numeric.samples import Array, ComplexArray

BLOCK_BYTES = 4_000_000
"""Working memory that one block of columns may take."""


@dataclass(frozen=True)
class LagKernel:
    """A complex signal with its lag window ``h[0..M]`` (h[0] = 1) and its time smoothing ``g[-G..G]``."""

    signal: ComplexArray
    rate: float
    lag_window: Array
    smoothing: Array
    n_fft: int

    def __post_init__(self) -> None:
        if self.n_fft < 2 * self.half_lags + 1:
            raise InputError(
                f"n_fft {self.n_fft} is below the {2 * self.half_lags + 1} lags of the kernel and would fold them; "
                f"use at least {2 * self.half_lags + 1}"
            )

    @property
    def half_lags(self) -> int:
        """M, the largest lag index."""
        return self.lag_window.size - 1

    @property
    def half_smoothing(self) -> int:
        """G, the largest smoothing index."""
        return self.smoothing.size // 2

    @property
    def omega(self) -> Array:
        """The bins pi rate k / n_fft, k = 0 .. n_fft - 1, in rad per time unit."""
        return math.pi * self.rate * np.arange(self.n_fft) / self.n_fft

    @property
    def block(self) -> int:
        """How many columns fit into the working memory (lag columns three times, bins twice)."""
        per_column = 48 * (self.half_lags + 1) + 16 * self.n_fft
        return max(1, BLOCK_BYTES // per_column)

    def products(self, start: int, stop: int) -> ComplexArray:
        """K[n, m] for n = start .. stop - 1 and m = 0 .. M, by two strided views and one multiplication.

        Indices n outside the record are allowed; there, as at every lag that reaches outside, K is zero.
        """
        M = self.half_lags
        first, last = start - M, stop + M
        inside = self.signal[max(0, first) : max(0, last)]
        lead = min(max(0, -first), last - first)
        z = np.concatenate([np.zeros(lead), inside, np.zeros(last - first - lead - inside.size)])
        windows = np.lib.stride_tricks.sliding_window_view(z, M + 1)
        count = stop - start
        return np.asarray(windows[M : M + count] * windows[:count, ::-1].conj(), dtype=np.complex128)

    def columns(self, start: int, stop: int) -> ComplexArray:
        """h[m] * (sum over l of g[l] K[n + l, m]) for n = start .. stop - 1; shape ``(stop - start, M + 1)``.

        The smoothing is the plain convolution of the zero-extended record's kernel: nothing is wrapped round and
        nothing is renormalised near the border, so that every lag is treated alike and no bias is brought in.
        """
        G = self.half_smoothing
        kernel = self.products(start - G, stop + G)
        if G:
            # The convolution as one banded matrix product; float64 pairs, since g is real.
            count = stop - start
            banded = np.zeros((count, count + 2 * G))
            for row in range(count):
                banded[row, row : row + 2 * G + 1] = self.smoothing[::-1]
            kernel = (banded @ kernel.view(np.float64)).view(np.complex128)
        else:
            kernel = kernel * self.smoothing[0]
        return np.asarray(kernel * self.lag_window, dtype=np.complex128)

    def blocks(self) -> Iterator[tuple[int, int, ComplexArray]]:
        """All columns, a few at a time: (start, stop, columns)."""
        size, block = self.signal.size, self.block
        for start in range(0, size, block):
            stop = min(start + block, size)
            yield start, stop, self.columns(start, stop)

    def spectra(self, columns: ComplexArray) -> Array:
        """The real spectra of lag columns, shape ``(columns, n_fft)``, scaled as W above."""
        return np.asarray(fft.hfft(columns, n=self.n_fft, axis=1) * (2.0 / self.rate), dtype=np.float64)

    # P(theta) = K0 + 2 Re sum K_m e^{-i theta m}, theta = 2 omega / rate:  P' = 2 Im sum m K_m e^{..},
    # P'' = -2 Re sum m^2 K_m e^{..}.
    def derivatives(self, columns: ComplexArray, omega: Array) -> tuple[Array, Array]:
        """First and second derivative of each column's exact transform at its own omega (scaled by rate / 2)."""
        moments = lag_moments(columns, 2.0 / self.rate * omega)
        return 2.0 * moments[:, 1].imag, -4.0 / self.rate * moments[:, 2].real
