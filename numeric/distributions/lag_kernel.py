"""The lag kernel: the one core of the Wigner family.

    K[n, m] = z[n + D m] conj(z[n - D m]),   m = 0 .. M,   z = 0 outside the record,   D = 1 unless lags are decimated.

Only m >= 0 is formed, because K[n, -m] = conj K[n, m]; a Hermitian FFT over m then gives a real column

    W[n, k] = (2 D / rate) * sum over m = -M .. M of  h[m] K[n, m] exp(-2 pi i m k / n_fft),

which samples  W(t, omega) = integral of z(t + tau/2) conj z(t - tau/2) h exp(-i omega tau) d tau  at the lags
tau = 2 D m / rate, hence at omega_k = pi rate k / (D n_fft): for D = 1 *half* the spacing of an ordinary DFT, and a
period of pi rate, not 2 pi rate.  (Claasen and Mecklenbräuker, Philips J. Res. 35 (1980) 217, 276, 372.)

A complex64 signal makes everything single precision.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.distributions.bin_interpolation import OVERSAMPLING
from ridgeback.numeric.signal.samples import Floats

Complexes = NDArray[np.complexfloating]

BLOCK_BYTES = 2_000_000
"""Working memory of one block of columns with its spectra: about what a core's own cache holds (measured best)."""
SMOOTHING_BYTES = 4_000_000
"""The same where columns are smoothed along time: a block must be long against the smoothing window."""
REACHES = 8
"""Steps in which the number of lags grows from the border inwards: each is one length of transform, with one plan."""


def lagged(z: Complexes, reach: int, *, spare: int = 0) -> Complexes:
    """View z[n + m], row n + spare for n = -spare .. N - 1 + spare, column m = 0 .. reach; zero outside the record.

    >>> lagged(np.array([1.0 + 0j, 2.0, 3.0]), 1).real.tolist()
    [[1.0, 2.0], [2.0, 3.0], [3.0, 0.0]]
    """
    padded = np.pad(z, (spare, spare + reach))
    return np.asarray(np.lib.stride_tricks.sliding_window_view(padded, reach + 1))


@dataclass(frozen=True)
class LagKernel:
    """A complex signal with its lag window ``h[0..M]`` (h[0] = 1) and its time smoothing ``g[-G..G]``.

    ``decimation`` is D; ``origin`` is the frequency that the signal was turned down by.
    """

    signal: Complexes
    rate: float
    lag_window: Array
    smoothing: Array
    n_fft: int
    decimation: int = 1
    origin: float = 0.0

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
    def lags(self) -> Array:
        """The lags tau = 2 D m / rate, m = 0 .. M, in time units."""
        return np.asarray(2.0 * self.decimation / self.rate * np.arange(self.lag_window.size), dtype=np.float64)

    @property
    def period(self) -> float:
        """pi rate / D: one period of the frequency axis."""
        return math.pi * self.rate / self.decimation

    @property
    def omega(self) -> Array:
        """The bins of a plane, k = 0 .. n_fft - 1, in rad per time unit."""
        return self.origin + self.period * np.arange(self.n_fft) / self.n_fft

    @cached_property
    def _factors(self) -> tuple[Complexes, Complexes]:
        """The two factors of (2 D / rate) K, row n + G, column m."""
        reach, scale = self.decimation * self.half_lags, self.signal.real.dtype.type(2.0 * self.decimation / self.rate)
        ahead = lagged(self.signal * scale, reach, spare=self.half_smoothing)
        behind = lagged(self.signal[::-1].conj(), reach, spare=self.half_smoothing)[::-1]
        return ahead[:, :: self.decimation], behind[:, :: self.decimation]

    def reach(self, start: int, stop: int) -> int:
        """The largest lag index at which a column from ``start`` to ``stop`` is not zero, or a little above it."""
        size, G, M = self.signal.size, self.half_smoothing, self.half_lags
        samples = min(stop - 1 + G, size - 1 - start + G, (size - 1) // 2)
        step = -(-M // REACHES)
        return min(M, -(-samples // max(1, step * self.decimation)) * step)

    def columns(self, start: int, stop: int, *, width: int | None = None) -> Complexes:
        """(2 D / rate) h[m] * (sum over l of g[l] K[n + l, m]), n = start .. stop - 1; zeros fill up to ``width``.

        The smoothing is the plain convolution of the zero-extended record's kernel: nothing is wrapped round and
        nothing is renormalised near the border, so that every lag is treated alike and no bias is brought in.
        """
        count = self.reach(start, stop) + 1
        out = np.empty((stop - start, self.half_lags + 1 if width is None else width), dtype=self.signal.dtype)
        out[:, count:] = 0.0
        kernel = out[:, :count]
        if self.smoothing.size > 1:
            kernel[:] = self._smoothed(start, stop, count).T
        else:
            ahead, behind = self._factors
            np.multiply(ahead[start:stop, :count], behind[start:stop, :count], out=kernel)
        weights = self.lag_window[:count]
        if weights.min() < 1.0:
            kernel *= weights.astype(kernel.real.dtype)
        return out

    # Convolution along time by the FFT, one lag after the other: K[m, n] with n contiguous, its own 2 G columns to
    # spare on both sides, so that what wraps round is dropped (overlap-save).
    def _smoothed(self, start: int, stop: int, count: int) -> Complexes:
        G = self.half_smoothing
        length = fft.next_fast_len(stop - start + 2 * G)
        ahead, behind = (factor[start : stop + 2 * G, :count].T for factor in self._factors)
        kernel = np.multiply(ahead, behind, order="C")
        g = np.zeros(length)
        g[: 2 * G + 1] = self.smoothing[::-1]
        response = fft.fft(g).astype(kernel.dtype)
        spectrum = fft.fft(kernel, n=length, axis=1)
        spectrum *= response
        smooth = fft.ifft(spectrum, axis=1, overwrite_x=True)
        return np.asarray(smooth[:, 2 * G : 2 * G + stop - start])

    def spans(self, n_fft: int) -> Iterator[tuple[int, int]]:
        """Consecutive (start, stop) that cover the record, in blocks that fit into the working memory."""
        size, block = self.signal.size, self._rows(n_fft)
        if self.half_smoothing:
            column = self.signal.dtype.itemsize * 2 * (self.half_lags + 1)
            block = max(2 * self.half_smoothing, min(8 * self.half_smoothing, SMOOTHING_BYTES // column))
        for start in range(0, size, block):
            yield start, min(start + block, size)

    def _rows(self, n_fft: int) -> int:
        """How many columns are transformed at a time."""
        return max(4, BLOCK_BYTES // (self.signal.dtype.itemsize * n_fft))

    def spectra(self, start: int, stop: int, n_fft: int) -> Iterator[tuple[int, int, Floats]]:
        """W of the columns from ``start`` to ``stop`` on ``n_fft`` bins: (first, last, ``(last - first, n_fft)``)."""
        rows = self._rows(n_fft)
        columns = self.columns(start, stop, width=n_fft // 2 + 1 if stop - start <= rows else None)
        for first in range(0, stop - start, rows):
            part = columns[first : first + rows]
            yield start + first, start + first + len(part), np.asarray(fft.hfft(part, n=n_fft, axis=1))

    def searched(self) -> Iterator[tuple[int, int, Floats]]:
        """All spectra on OVERSAMPLING bins per lag or a few more; near the border, where lags are few, bins are few."""
        for start, stop in self.spans(self.search_length(self.half_lags)):
            yield from self.spectra(start, stop, self.search_length(self.reach(start, stop)))

    @staticmethod
    def search_length(lags: int) -> int:
        """Bins on which the transform of the lags -lags .. lags can be read between the bins."""
        return int(fft.next_fast_len(math.ceil(OVERSAMPLING * (2 * lags + 1)), real=True))
