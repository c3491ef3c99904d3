"""The polynomial Wigner distribution of order q: a lag product of q factors that leaves less of phi'''.

    K(t, tau) = product over k of [z(t + c_k tau) conj z(t - c_k tau)]^b_k,    q = 2 sum |b_k|,
    phase of K = 2 sum b_k c_k phi' tau + (1/3) sum b_k c_k^3 phi''' tau^3 + ...,     2 sum b_k c_k = 1.

q = 4: b = (2), c = (1/4): phi''' counts a quarter of what it does in the Wigner distribution (q = 2, b = 1, c = 1/2).
q = 6: b = (2, 1) with 2 c_1^3 + c_2^3 = 0, hence c_1 = 1 / (4 - 2 * 2^(1/3)) = 0.6756, c_2 = -2^(1/3) c_1 = -0.8512:
exact for phases up to the fourth degree.  (Boashash and O'Shea, IEEE Trans. Signal Process. 42 (1994) 216; Barkat and
Boashash, ibid. 47 (1999) 2480.)  Samples between the grid points come from the signal's own DFT (band-limited).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike
from scipy import fft

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, Wanted, showing, silent
from ridgeback.numeric.arrays import Array, ComplexArray
from ridgeback.numeric.distributions.distribution import Distribution
from ridgeback.numeric.distributions.lag_kernel import BLOCK_BYTES
from ridgeback.numeric.distributions.shared_parameters import documented
from ridgeback.numeric.harmonics.noise import Level, phase_noise
from ridgeback.numeric.signal.analytic import as_analytic
from ridgeback.numeric.signal.samples import MEMORY_BUDGET, checked_budget, checked_rate
from ridgeback.numeric.signal.windows import half_width, window

_C = 1.0 / (4.0 - 2.0 * 2.0 ** (1.0 / 3.0))
DESIGNS: Mapping[int, tuple[tuple[int, float], ...]] = MappingProxyType(
    {2: ((1, 0.5),), 4: ((2, 0.25),), 6: ((2, _C), (1, -(2.0 ** (1.0 / 3.0)) * _C))}
)
"""Pairs (b_k, c_k) for each order."""
STRETCH_BYTES = 192_000_000
"""Lag products that are held at a time."""


def shifted(z: ComplexArray, samples: float) -> ComplexArray:
    """z at n + samples, by its DFT taken as one period; zero where that lies outside the record.

    >>> shifted(np.array([1.0 + 0j, 2.0, 3.0, 4.0]), 1.0).real.round(12).tolist()
    [2.0, 3.0, 4.0, 0.0]
    """
    return moved(fft.fft(z), samples, slice(0, z.size))


def moved(spectrum: ComplexArray, samples: float, rows: slice) -> ComplexArray:
    """Some rows of z at n + samples, from its DFT."""
    turn = np.exp(2j * math.pi * fft.fftfreq(spectrum.size) * samples)
    turn *= spectrum
    there = fft.ifft(turn, overwrite_x=True)[rows]
    at = np.arange(rows.start, rows.stop) + samples
    inside = (at >= -1e-9) & (at <= spectrum.size - 1 + 1e-9)
    return np.asarray(np.where(inside, there, 0.0), dtype=np.complex128)


@dataclass(frozen=True)
class PolynomialKernel:
    """The lag products of one order of complex samples, at tau = 2 m / rate, under the window h[0..M].

    They are formed for a stretch of time after the other, and dropped.
    """

    signal: ComplexArray
    rate: float
    order: int
    half_window: Array
    n_fft: int
    progress: Progress = silent

    @cached_property
    def _spectrum(self) -> ComplexArray:
        return np.asarray(fft.fft(self.signal), dtype=np.complex128)

    def products(self, start: int, stop: int) -> ComplexArray:
        """The products ``[n - start, m]`` for n = start .. stop - 1."""
        found = np.empty((stop - start, self.half_window.size), dtype=np.complex128)
        rows, size = slice(start, stop), self.signal.size
        for m, weight in enumerate(self.half_window):
            self.progress((start + (stop - start) * m / self.half_window.size) / size, "lag products")
            found[:, m] = weight
            for power, c in DESIGNS[self.order]:
                ahead, behind = (moved(self._spectrum, side * 2.0 * c * m, rows) for side in (1.0, -1.0))
                found[:, m] *= (ahead * behind.conj()) ** power
        return found

    @property
    def omega(self) -> Array:
        """The bins pi rate k / n_fft, as for the Wigner distribution."""
        return math.pi * self.rate * np.arange(self.n_fft) / self.n_fft

    @property
    def origin(self) -> float:
        """The bins begin at 0."""
        return 0.0

    @property
    def period(self) -> float:
        """Pi rate, as for the Wigner distribution."""
        return math.pi * self.rate

    def searched(self) -> Iterator[tuple[int, int, Array]]:
        """All real spectra on the bins ``omega``, scaled by 2 / rate, a few at a time."""
        size, block = self.signal.size, max(1, BLOCK_BYTES // (16 * self.n_fft))
        stretch = max(1, STRETCH_BYTES // (16 * self.half_window.size))
        for begin in range(0, size, stretch):
            end = min(begin + stretch, size)
            products = self.products(begin, end)
            for start in range(begin, end, block):
                stop = min(start + block, end)
                spectra = fft.hfft(products[start - begin : stop - begin], n=self.n_fft, axis=1)
                yield start, stop, np.asarray(spectra * (2.0 / self.rate), dtype=np.float64)


def half_lags(lag_seconds: float, rate: float, order: int, size: int) -> int:
    """M such that the farthest factors, at +-2 c M samples, stay within ``lag_seconds`` of signal."""
    if order not in DESIGNS:
        raise InputError(f"order {order} of the polynomial Wigner distribution is unknown; use 2, 4 or 6")
    farthest = max(abs(c) for _, c in DESIGNS[order])
    half = half_width(lag_seconds, rate, longest=size)
    return max(1, int(half / (2.0 * farthest)))


def polynomial_kernel(
    z: ComplexArray,
    rate: float,
    *,
    lag_seconds: float,
    order: int = 6,
    lag_window: str = "hann",
    n_fft: int | None = None,
    progress: Progress = silent,
) -> PolynomialKernel:
    """Build the polynomial lag kernel of complex samples, which have been checked, over ``lag_seconds`` of signal.

    Raises InputError for an order other than 2, 4, 6, a or a window longer than the signal.

    >>> t = np.arange(129) / 16.0
    >>> kernel = polynomial_kernel(np.exp(2j * np.pi * 3.0 * t), 16.0, lag_seconds=2.0)
    >>> spectra = next(kernel.searched())[2]
    >>> round(float(kernel.omega[spectra[64].argmax()] / (2 * np.pi)), 1)
    3.0
    """
    M = half_lags(lag_seconds, rate, order, z.size)
    bins = fft.next_fast_len(2 * (2 * M + 1), real=True) if n_fft is None else int(n_fft)
    if bins < 2 * M + 1:
        raise InputError(f"n_fft {bins} is below the {2 * M + 1} lags of the kernel; use at least {2 * M + 1}")
    return PolynomialKernel(z, rate, order, window(lag_window, M)[M:], bins, progress)


@documented
def polynomial_wigner(
    x: ArrayLike,
    rate: float,
    *,
    lag_seconds: float,
    order: int = 6,
    lag_window: str = "hann",
    n_fft: int | None = None,
    start: float = 0.0,
    remove_mean: bool = True,
    memory: int = MEMORY_BUDGET,
    progress: Wanted = None,
) -> Distribution:
    """Return the polynomial Wigner distribution, whose ridge is exact for phases of degree 2 (order 2) or 4 (order 6).

    Its lag product of ``order`` factors turns harmonics into cross terms on the fundamental: take them out first.

    Parameters
    ----------
    {signal}
    {rate}
    lag_seconds : float
        Stretch of signal that a column sees, in time units: the farthest factors lie within it.
    {lag_window}
    order : int
        Number of factors: 2 (the pseudo-Wigner distribution), 4 (a quarter of its error from phi''') or 6.
    {n_fft}
    {start}
    {remove_mean}
    {memory}
    {progress}

    Returns
    -------
    Distribution
        Real ``values[n_fft, N]``, ``omega`` from 0 to pi ``rate``, every sample in ``time``.  Integrated over
        omega / 2 pi it is ``|z|^order``.

    Raises
    ------
    InputError
        For an order other than 2, 4, 6, a window unknown or longer than the signal, or work over ``memory``.

    References
    ----------
    Boashash and O'Shea, IEEE Trans. Signal Process. 42 (1994) 216; Barkat and Boashash, ibid. 47 (1999) 2480.

    Examples
    --------
    >>> t = np.arange(257) / 32.0
    >>> plane = polynomial_wigner(np.cos(2 * np.pi * 3.0 * t), 32.0, lag_seconds=4.0, n_fft=256)
    >>> float(plane.frequency_hz[plane.values[:, 128].argmax()])
    3.0
    """
    with showing(progress) as told:
        kernel = polynomial_kernel(
            as_analytic(x, remove_mean=remove_mean),
            checked_rate(rate),
            lag_seconds=lag_seconds,
            order=order,
            lag_window=lag_window,
            n_fft=n_fft,
            progress=lambda share, step: told(0.9 * share, step),
        )
        return _plane(kernel, order=order, start=start, memory=memory, border=0.5 * lag_seconds)


def _plane(kernel: PolynomialKernel, *, order: int, start: float, memory: int, border: float) -> Distribution:
    size, M = kernel.signal.size, kernel.half_window.size - 1
    remedy = "shorten the signal or lower n_fft"
    checked_budget(8 * size * kernel.n_fft, memory, f"polynomial-wigner of {size} samples", remedy)
    columns = np.empty((size, kernel.n_fft))
    for first, last, spectra in kernel.searched():
        columns[first:last] = spectra
    settings = {"rate": kernel.rate, "n_fft": kernel.n_fft, "order": order, "lag_seconds": 2.0 * M / kernel.rate}
    time = start + np.arange(size) / kernel.rate
    return Distribution(columns.T, kernel.omega, time, "polynomial-wigner", settings, border)


# The peak moves by (rate / 2) sum_m h m e[m] / sum_m h m^2, e[m] = sum_k b_k (eta[n + 2 c_k m] - eta[n - 2 c_k m]);
# the correlation of band-limited white noise between the places p is sinc(p_i - p_j).
def polynomial_deviation(level: Level, rate: float, half_window: Array, order: int) -> Array:
    """Standard deviation of the peak in white noise at a high signal-to-noise ratio, rad per time unit, per sample."""
    m = np.arange(half_window.size, dtype=np.float64)
    places = np.concatenate([side * 2.0 * c * m for _, c in DESIGNS[order] for side in (1.0, -1.0)])
    weights = np.concatenate([side * b * half_window * m for b, _ in DESIGNS[order] for side in (1.0, -1.0)])
    variance = weights @ np.sinc(places[:, None] - places[None, :]) @ weights
    return np.asarray(
        0.5 * rate * math.sqrt(variance) / float((half_window * m * m).sum()) * phase_noise(level), dtype=np.float64
    )
