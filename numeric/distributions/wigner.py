"""Wigner, pseudo-Wigner and smoothed pseudo-Wigner distributions, from one lag kernel.

Scaling: with omega in rad per time unit, ``sum(values[:, n]) * d_omega / (2 pi) = |z(t_n)|^2`` and
``sum(values[k, :]) / rate = |Z(omega_k)|^2 + |Z(omega_k + pi rate)|^2`` with Z = sum of z exp(-i omega t) / rate;
for an analytic signal of even N the second term vanishes on the bins of its own DFT (even k when n_fft = N).
The axis runs over [0, pi rate), that is 0 .. rate / 2 in cycles: all that an analytic signal holds.  A complex
signal is taken as it is; what it holds at a negative frequency omega appears at omega + pi rate.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy import fft

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, Wanted, showing
from ridgeback.numeric.arrays import ComplexArray
from ridgeback.numeric.distributions.distribution import Distribution
from ridgeback.numeric.distributions.lag_kernel import Complexes, LagKernel
from ridgeback.numeric.distributions.shared_parameters import documented
from ridgeback.numeric.signal.analytic import as_analytic
from ridgeback.numeric.signal.band_limit import BandLimited, band_limited
from ridgeback.numeric.signal.samples import MEMORY_BUDGET, checked_budget, checked_rate
from ridgeback.numeric.signal.windows import half_width, window

SINGLE_SWING = (1e-12, 1e12)
"""Magnitudes that single precision takes: products of two, summed, stay far inside float32."""


def as_single(z: ComplexArray) -> Complexes:
    """The samples as complex64; refuses those whose products, summed over lags, would leave float32."""
    largest = float(np.abs(z).max())
    if largest and not SINGLE_SWING[0] <= largest <= SINGLE_SWING[1]:
        low, high = SINGLE_SWING
        raise InputError(f"signal reaches {largest:.3g}, outside {low:g} .. {high:g} in single precision; scale it")
    return z.astype(np.complex64)


def wigner_kernel(
    x: ArrayLike,
    rate: float,
    *,
    lag_seconds: float | None = None,
    lag_window: str = "hann",
    smoothing_seconds: float | None = None,
    smoothing_window: str = "hann",
    n_fft: int | None = None,
    remove_mean: bool = True,
    band: tuple[float, float] | None = None,
    single: bool = False,
) -> LagKernel:
    """Build the lag kernel of a member of the family from samples that have not been checked: see :func:`kernel_of`."""
    return kernel_of(
        as_analytic(x, remove_mean=remove_mean),
        checked_rate(rate),
        lag_seconds=lag_seconds,
        lag_window=lag_window,
        smoothing_seconds=smoothing_seconds,
        smoothing_window=smoothing_window,
        n_fft=n_fft,
        band=band,
        single=single,
    )


def kernel_of(
    z: ComplexArray,
    rate: float,
    *,
    lag_seconds: float | None = None,
    lag_window: str = "hann",
    smoothing_seconds: float | None = None,
    smoothing_window: str = "hann",
    n_fft: int | None = None,
    band: tuple[float, float] | None = None,
    single: bool = False,
) -> LagKernel:
    """Build the lag kernel of a member of the family; None leaves the lag window or the smoothing out.

    Parameters
    ----------
    z : array of complex, shape (N,)
        The analytic signal, checked.
    rate : float
        Samples per time unit, checked.
    lag_seconds : float, optional
        The stretch of signal that a column sees: z from t - lag_seconds/2 to t + lag_seconds/2 (rounded to whole
        samples on each side), so that tau runs over -lag_seconds .. lag_seconds.
    lag_window, smoothing_window : str
        Windows over the lags and along time.
    smoothing_seconds : float, optional
        The full width of the time smoothing window, whose samples sum to 1.
    n_fft : int, optional
        Bins of a plane.
    band : (float, float), optional
        In rad per time unit: limits the signal to that band and decimates its lags.
    single : bool
        Work in complex64: half the memory, seven digits.
    """
    limited = BandLimited(z, 0.0, 1) if band is None else band_limited(z, rate, *band)
    step = limited.decimation
    half = (z.size - 1) // 2 if lag_seconds is None else half_width(lag_seconds, rate, longest=z.size)
    h = window("rectangular" if lag_seconds is None else lag_window, half)[half:]
    g = np.ones(1)
    if smoothing_seconds is not None:
        reach = half_width(smoothing_seconds, rate, name="smoothing_seconds", longest=z.size)
        g = window(smoothing_window, reach)
    if n_fft is None:
        n_fft = (
            -(-z.size // step) if lag_seconds is None else fft.next_fast_len(2 * (2 * (half // step) + 1), real=True)
        )
    signal = as_single(limited.signal) if single else limited.signal
    return LagKernel(signal, rate, h[::step], g / g.sum(), int(n_fft), step, limited.origin)


def plane(
    kernel: LagKernel, name: str, *, start: float, memory: int, progress: Progress, border: float = 0.0
) -> Distribution:
    """Evaluate every column of a kernel; refuses before the work when the plane is over the budget ``memory``."""
    size, real = kernel.signal.size, kernel.signal.real.dtype
    remedy = "shorten the signal, lower n_fft, or follow the ridge with estimate(...), which stores no plane"
    checked_budget(
        real.itemsize * size * kernel.n_fft, memory, f"{name} of {size} samples by {kernel.n_fft} bins", remedy
    )
    columns = np.empty((size, kernel.n_fft), dtype=real)
    for start_block, stop_block in kernel.spans(kernel.n_fft):
        progress(start_block / size, name)
        for first, last, spectra in kernel.spectra(start_block, stop_block, kernel.n_fft):
            columns[first:last] = spectra
    settings = {
        "rate": kernel.rate,
        "n_fft": kernel.n_fft,
        "lag_seconds": float(kernel.lags[-1]),
        "precision": real.name,
        "smoothing_seconds": 2.0 * kernel.half_smoothing / kernel.rate,
    }
    time = start + np.arange(size) / kernel.rate
    return Distribution(columns.T, kernel.omega, time, name, settings, border)


@documented
def wigner(
    x: ArrayLike,
    rate: float,
    *,
    n_fft: int | None = None,
    start: float = 0.0,
    remove_mean: bool = True,
    single: bool = False,
    memory: int = MEMORY_BUDGET,
    progress: Wanted = None,
) -> Distribution:
    """Return the Wigner distribution of a signal, over all lags that the record has.

    Parameters
    ----------
    {signal}
    {rate}
    n_fft : int, optional
        Rows of the plane, one per sample by default.
    {start}
    {remove_mean}
    {single}
    {memory}
    {progress}

    Returns
    -------
    Distribution
        Real ``values[n_fft, N]``, ``omega`` from 0 to pi ``rate`` (the Nyquist frequency), every sample in ``time``.

    Raises
    ------
    InputError
        For values that are not finite, ``rate`` <= 0, ``n_fft`` below the number of lags, or a plane over ``memory``.

    References
    ----------
    Claasen and Mecklenbräuker, Philips J. Res. 35 (1980) 217, 276, 372.

    Examples
    --------
    >>> tone = np.exp(2j * np.pi * 3.0 * np.arange(64) / 32.0)
    >>> plane = wigner(tone, 32.0)
    >>> float(plane.frequency_hz[plane.values[:, 30].argmax()])
    3.0
    >>> round(plane.energy(), 12)
    2.0
    """
    kernel = wigner_kernel(x, rate, n_fft=n_fft, remove_mean=remove_mean, single=single)
    with showing(progress) as told:
        return plane(kernel, "wigner", start=start, memory=memory, progress=told)


@documented
def pseudo_wigner(
    x: ArrayLike,
    rate: float,
    *,
    lag_seconds: float,
    lag_window: str = "hann",
    n_fft: int | None = None,
    start: float = 0.0,
    remove_mean: bool = True,
    single: bool = False,
    memory: int = MEMORY_BUDGET,
    progress: Wanted = None,
) -> Distribution:
    """Return the pseudo-Wigner distribution: the lag product under a window, so that a column sees what is near it.

    The window is 1 at tau = 0, and the sum over frequency is the signal's power at each time still.

    Parameters
    ----------
    {signal}
    {rate}
    {lag_seconds}
    {lag_window}
    {n_fft}
    {start}
    {remove_mean}
    {single}
    {memory}
    {progress}

    Returns
    -------
    Distribution
        Real ``values[n_fft, N]``, ``omega`` from 0 to pi ``rate`` (the Nyquist frequency), every sample in ``time``.

    Raises
    ------
    InputError
        For values that are not finite, ``rate`` <= 0, ``n_fft`` below the number of lags, a window unknown or longer
        than the signal, or a plane over ``memory``.

    References
    ----------
    Claasen and Mecklenbräuker, Philips J. Res. 35 (1980) 217, 276, 372.

    Examples
    --------
    >>> tone = np.cos(2 * np.pi * 3.0 * np.arange(256) / 32.0)
    >>> plane = pseudo_wigner(tone, 32.0, lag_seconds=2.0, n_fft=256)
    >>> float(plane.frequency_hz[plane.values[:, 128].argmax()])
    3.0
    """
    kernel = wigner_kernel(
        x, rate, lag_seconds=lag_seconds, lag_window=lag_window, n_fft=n_fft, remove_mean=remove_mean, single=single
    )
    with showing(progress) as told:
        return plane(kernel, "pseudo-wigner", start=start, memory=memory, progress=told, border=0.5 * lag_seconds)


@documented
def smoothed_pseudo_wigner(
    x: ArrayLike,
    rate: float,
    *,
    lag_seconds: float,
    smoothing_seconds: float,
    lag_window: str = "hann",
    smoothing_window: str = "hann",
    n_fft: int | None = None,
    start: float = 0.0,
    remove_mean: bool = True,
    single: bool = False,
    memory: int = MEMORY_BUDGET,
    progress: Wanted = None,
) -> Distribution:
    """Return the smoothed pseudo-Wigner distribution: convolved along time with a window of sum 1.

    Smoothing takes out cross terms, which oscillate along time.  Outside the record the signal counts as zero; the
    convolution is neither wrapped nor renormalised at the border.

    Parameters
    ----------
    {signal}
    {rate}
    {lag_seconds}
    smoothing_seconds : float
        Full width of the smoothing window, in time units.
    lag_window, smoothing_window : str
        Windows over the lags and along time: ``"rectangular"``, ``"hann"``, ``"hamming"``, ``"blackman"`` or
        ``"gaussian"``.
    {n_fft}
    {start}
    {remove_mean}
    {single}
    {memory}
    {progress}

    Returns
    -------
    Distribution
        Real ``values[n_fft, N]``, ``omega`` from 0 to pi ``rate`` (the Nyquist frequency), every sample in ``time``.

    Raises
    ------
    InputError
        For values that are not finite, ``rate`` <= 0, ``n_fft`` below the number of lags, a window unknown or longer
        than the signal, or a plane over ``memory``.

    References
    ----------
    Claasen and Mecklenbräuker, Philips J. Res. 35 (1980) 217, 276, 372.

    Examples
    --------
    >>> tone = np.cos(2 * np.pi * 3.0 * np.arange(256) / 32.0)
    >>> plane = smoothed_pseudo_wigner(tone, 32.0, lag_seconds=2.0, smoothing_seconds=0.5, n_fft=256)
    >>> float(plane.frequency_hz[plane.values[:, 128].argmax()])
    3.0
    """
    kernel = wigner_kernel(
        x,
        rate,
        lag_seconds=lag_seconds,
        lag_window=lag_window,
        smoothing_seconds=smoothing_seconds,
        smoothing_window=smoothing_window,
        n_fft=n_fft,
        remove_mean=remove_mean,
        single=single,
    )
    border = 0.5 * (lag_seconds + smoothing_seconds)
    with showing(progress) as told:
        return plane(kernel, "smoothed-pseudo-wigner", start=start, memory=memory, progress=told, border=border)
