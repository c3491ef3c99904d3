"""The cross-Wigner distribution of two signals.

    W_xy(t, omega) = integral of x(t + tau/2) conj y(t - tau/2) h(tau) exp(-i omega tau) d tau

is complex; W_yx = conj W_xy, W_xx = W_x, and W_{x+y} = W_x + W_y + 2 Re W_xy: its real part is half the cross term that
a Wigner distribution shows between two components.  Scaling and axes are those of ``distributions.wigner``.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy import fft

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Wanted, showing
from ridgeback.numeric.distributions.distribution import Distribution
from ridgeback.numeric.distributions.lag_kernel import Complexes, LagKernel, lagged
from ridgeback.numeric.distributions.shared_parameters import documented
from ridgeback.numeric.distributions.wigner import wigner_kernel
from ridgeback.numeric.signal.samples import MEMORY_BUDGET, checked_budget


@documented
def cross_wigner(
    x: ArrayLike,
    y: ArrayLike,
    rate: float,
    *,
    lag_seconds: float | None = None,
    lag_window: str = "hann",
    n_fft: int | None = None,
    start: float = 0.0,
    remove_mean: bool = True,
    memory: int = MEMORY_BUDGET,
    single: bool = False,
    progress: Wanted = None,
) -> Distribution:
    """Return the cross-Wigner distribution of two signals of one length, over all lags or under a window of them.

    Parameters
    ----------
    x, y : array, shape (N,)
        The signals.  Real samples are made analytic, complex ones are taken as they are.
    rate : float
        Samples per time unit, of both.
    lag_seconds : float, optional
        Stretch of signal that a column sees, in time units; all of the record by default.
    lag_window : str
        Window over the lags, where ``lag_seconds`` is given.
    n_fft : int, optional
        Rows of the plane; as in ``wigner`` and ``pseudo_wigner`` by default.
    {start}
    {remove_mean}
    {single}
    {memory}
    {progress}

    Returns
    -------
    Distribution
        Complex ``values[n_fft, N]`` on the axes of ``wigner``.

    Raises
    ------
    InputError
        As ``wigner`` does, and for signals of different length.

    Examples
    --------
    >>> tone = np.exp(2j * np.pi * 3.0 * np.arange(64) / 32.0)
    >>> plane = cross_wigner(tone, 1j * tone, 32.0)
    >>> at = np.abs(plane.values[:, 30]).argmax()
    >>> float(plane.frequency_hz[at]), round(float(np.angle(plane.values[at, 30]) / np.pi), 12)
    (3.0, -0.5)
    """
    first, second = (
        wigner_kernel(
            samples,
            rate,
            lag_seconds=lag_seconds,
            lag_window=lag_window,
            n_fft=n_fft,
            remove_mean=remove_mean,
            single=single,
        )
        for samples in (x, y)
    )
    size, bins = first.signal.size, first.n_fft
    if second.signal.size != size:
        raise InputError(f"signals have {size} and {second.signal.size} samples; a cross distribution needs as many")
    remedy = "shorten the signals or lower n_fft"
    kind = first.signal.dtype
    checked_budget(kind.itemsize * size * bins, memory, f"cross-wigner of {size} samples by {bins} bins", remedy)
    columns = np.empty((size, bins), dtype=kind)
    with showing(progress) as told:
        for begin, end in first.spans(2 * bins):
            told(begin / size, "cross-wigner")
            columns[begin:end] = fft.fft(cross_columns(first, second, begin, end), axis=1, overwrite_x=True)
    settings = {
        "rate": first.rate,
        "n_fft": bins,
        "lag_seconds": float(first.lags[-1]),
        "precision": first.signal.real.dtype.name,
    }
    time = start + np.arange(size) / first.rate
    border = 0.0 if lag_seconds is None else 0.5 * lag_seconds
    return Distribution(columns.T, first.omega, time, "cross-wigner", settings, border)


# Two products give both signs of the lag: K_xy[n, -m] = conj K_yx[n, m].
def cross_columns(first: LagKernel, second: LagKernel, start: int, stop: int) -> Complexes:
    """(2 / rate) h[m] x[n + m] conj y[n - m] at place m modulo n_fft, n = start .. stop - 1."""
    M = first.half_lags
    weights = (2.0 / first.rate * first.lag_window).astype(first.signal.real.dtype)
    columns = np.zeros((stop - start, first.n_fft), dtype=first.signal.dtype)
    part = slice(start, stop)
    columns[:, : M + 1] = weights * ahead(first)[part] * behind(second)[part]
    if M:
        columns[:, -M:] = (weights * ahead(second)[part] * behind(first)[part]).conj()[:, :0:-1]
    return columns


def ahead(kernel: LagKernel) -> Complexes:
    """View z[n + m]."""
    return lagged(kernel.signal, kernel.half_lags)


def behind(kernel: LagKernel) -> Complexes:
    """View conj z[n - m]."""
    return lagged(kernel.signal[::-1].conj(), kernel.half_lags)[::-1]
