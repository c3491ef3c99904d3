"""The reassigned and the synchrosqueezed spectrogram, on the axes of ``spectrogram``.

Both take the analytic signal of real samples.  Reassignment moves each value |S|^2 to the cell in which its energy
sits, in time and in frequency; synchrosqueezing moves the complex S in frequency only, so that the signal can be had
back: the sum over frequency of T is z itself.  (Auger and Flandrin 1995; Thakur and Wu, SIAM J. Math. Anal. 43 (2011)
2078; Oberlin, Meignen and Perrier 2015 for the second order, used here.)
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import fft

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Wanted, showing
from ridgeback.numeric.arrays import Array, ComplexArray
from ridgeback.numeric.distributions.distribution import Distribution
from ridgeback.numeric.distributions.lag_kernel import BLOCK_BYTES
from ridgeback.numeric.distributions.reassignment import WindowFamily, first_order, second_order, window_family
from ridgeback.numeric.distributions.shared_parameters import documented
from ridgeback.numeric.distributions.short_time import short_time_spectra
from ridgeback.numeric.signal.analytic import analytic_signal
from ridgeback.numeric.signal.samples import MEMORY_BUDGET, TWO_PI, checked_budget, checked_rate, checked_real_samples
from ridgeback.numeric.signal.windows import half_width, window


def blocks(size: int, n_fft: int, windows: int) -> list[tuple[int, int]]:
    """Consecutive (start, stop) whose spectra under so many windows fit into the working memory."""
    step = max(1, 2 * BLOCK_BYTES // (16 * n_fft * (windows + 3)))
    return [(start, min(start + step, size)) for start in range(0, size, step)]


def told_blocks(size: int, n_fft: int, windows: int, name: str, progress: Wanted) -> Iterator[tuple[int, int]]:
    """The same blocks; the progress is told as each begins."""
    with showing(progress) as told:
        for start, stop in blocks(size, n_fft, windows):
            told(start / size, name)
            yield start, stop


def summed(cells: NDArray[np.intp], weights: Array, count: int) -> Array:
    """Sum of the weights in each of ``count`` cells; those in cells below 0 or beyond the last are left out."""
    keep = (cells >= 0) & (cells < count)
    return np.bincount(cells[keep], weights=weights[keep], minlength=count).astype(np.float64, copy=False)


def nearest(values: Array) -> NDArray[np.intp]:
    """The nearest integers, kept within reach of an integer type."""
    return np.rint(np.clip(values, -1e9, 1e9)).astype(np.intp)


def prepared(
    x: ArrayLike, rate: float, *, window_seconds: float, n_fft: int | None, remove_mean: bool
) -> tuple[ComplexArray, float, int, int]:
    """Analytic signal, rate, half window and transform length, all checked."""
    samples, rate = checked_real_samples(x, what="a reassigned spectrogram", at_least=3), checked_rate(rate)
    half = half_width(window_seconds, rate, name="window_seconds", longest=samples.size)
    length = fft.next_fast_len(4 * half + 2) if n_fft is None else int(n_fft)
    if length < 2 * half + 1:
        raise InputError(f"n_fft {n_fft} is below the window of {2 * half + 1} samples; use at least {2 * half + 1}")
    return analytic_signal(samples, remove_mean=remove_mean), rate, half, length


@documented
def reassigned_spectrogram(
    x: ArrayLike,
    rate: float,
    *,
    window_seconds: float,
    window_name: str = "hann",
    n_fft: int | None = None,
    start: float = 0.0,
    remove_mean: bool = True,
    memory: int = MEMORY_BUDGET,
    progress: Wanted = None,
) -> Distribution:
    """Return the reassigned spectrogram of a real signal: each value moved to where its energy sits.

    The values are those of the spectrogram (A^2 on the ridge of a cosine) and keep their sum; nothing moves by more
    than half a window in time, and what moves beyond the plane is dropped.

    Parameters
    ----------
    {real_signal}
    {rate}
    {window_seconds}
    {closed_window}
    {transform}
    {start}
    {remove_mean}
    {memory}
    {progress}

    Returns
    -------
    Distribution
        ``values[n_fft // 2 + 1, N]``, ``omega`` from 0 to the Nyquist frequency, every sample in ``time``.

    Raises
    ------
    InputError
        For complex or non-finite samples, ``rate`` <= 0, a window that does not end at zero or is longer than
        the signal, ``n_fft`` shorter than the window, or work over ``memory``.

    References
    ----------
    Auger and Flandrin, IEEE Trans. Signal Process. 43 (1995) 1068.

    Examples
    --------
    >>> tone = np.cos(2 * np.pi * 4.1 * np.arange(256) / 32.0)
    >>> plane = reassigned_spectrogram(tone, 32.0, window_seconds=2.0, n_fft=256)
    >>> column = plane.values[:, 128]
    >>> float(plane.frequency_hz[column.argmax()]), bool(column.max() > 0.99 * column.sum())
    (4.125, True)
    """
    z, rate, half, n_fft = prepared(x, rate, window_seconds=window_seconds, n_fft=n_fft, remove_mean=remove_mean)
    size, bins = z.size, n_fft // 2 + 1
    checked_budget(32 * size * bins, memory, f"reassigned spectrogram of {size} columns", "use a shorter signal")
    family = window_family(window_name, half, rate, scale=1.0 / float(window(window_name, half).sum()))
    omega = TWO_PI * rate * np.arange(n_fft) / n_fft
    columns = np.zeros((size, bins))
    for first, last in told_blocks(size, n_fft, 3, "reassigned-spectrogram", progress):
        s, s_slope, s_lag = (short_time_spectra(z, w, first, last, n_fft) for w in family.three)
        shift, moved = first_order(omega, s, s_slope, s_lag)
        row = nearest(moved / omega[1])
        column = np.arange(first, last)[:, None] + nearest(np.clip(shift * rate, -half, half))
        begin, end = max(0, first - half), min(size, last + half)
        inside = (row >= 0) & (row < bins) & (column >= begin) & (column < end)
        cells = np.where(inside, (column - begin) * bins + row, -1).ravel()
        energy = summed(cells, (s.real**2 + s.imag**2).ravel(), (end - begin) * bins)
        columns[begin:end] += energy.reshape(-1, bins)
    settings = {"rate": rate, "n_fft": n_fft, "window": window_name, "window_seconds": 2 * half / rate}
    time = start + np.arange(size) / rate
    return Distribution(columns.T, omega[:bins], time, "reassigned-spectrogram", settings, half / rate)


def squeezed(z: ComplexArray, family: WindowFamily, omega: Array, first: int, last: int) -> tuple[ComplexArray, Array]:
    """Short-time spectra on all bins ``omega`` and the second-order frequency of each, for some columns."""
    spectra = [short_time_spectra(z, w, first, last, omega.size) for w in family.five]
    return spectra[0], second_order(omega, *spectra)


@documented
def synchrosqueezed_spectrogram(
    x: ArrayLike,
    rate: float,
    *,
    window_seconds: float,
    window_name: str = "hann",
    n_fft: int | None = None,
    start: float = 0.0,
    remove_mean: bool = True,
    memory: int = MEMORY_BUDGET,
    progress: Wanted = None,
) -> Distribution:
    """Return ``|T|^2`` of the second-order synchrosqueezed spectrum T of a real signal.

    T[k, n] = sum of S / (n_fft w(0)) over the bins whose frequency falls nearest omega_k; its sum over k is the
    analytic signal, but for what falls below 0 or beyond the Nyquist frequency.  A cosine of amplitude A has A^2.

    Parameters
    ----------
    {real_signal}
    {rate}
    {window_seconds}
    {closed_window}
    {transform}
    {start}
    {remove_mean}
    {memory}
    {progress}

    Returns
    -------
    Distribution
        ``values[n_fft // 2 + 1, N]``, ``omega`` from 0 to the Nyquist frequency, every sample in ``time``.

    Raises
    ------
    InputError
        For complex or non-finite samples, ``rate`` <= 0, a window that does not end at zero or is longer than
        the signal, ``n_fft`` shorter than the window, or work over ``memory``.

    References
    ----------
    Oberlin, Meignen and Perrier, IEEE Trans. Signal Process. 63 (2015) 1335.

    Examples
    --------
    >>> tone = 3.0 * np.cos(2 * np.pi * 4.1 * np.arange(256) / 32.0)
    >>> plane = synchrosqueezed_spectrogram(tone, 32.0, window_seconds=2.0, n_fft=256)
    >>> round(float(plane.values[33, 128]), 1), float(plane.frequency_hz[33])
    (9.0, 4.125)
    """
    z, rate, half, n_fft = prepared(x, rate, window_seconds=window_seconds, n_fft=n_fft, remove_mean=remove_mean)
    size, bins = z.size, n_fft // 2 + 1
    checked_budget(8 * size * bins, memory, f"synchrosqueezed spectrogram of {size} columns", "use a shorter signal")
    family = window_family(window_name, half, rate, scale=1.0 / n_fft)
    omega = TWO_PI * rate * np.arange(n_fft) / n_fft
    columns = np.empty((size, bins))
    for first, last in told_blocks(size, n_fft, 5, "synchrosqueezed", progress):
        s, moved = squeezed(z, family, omega, first, last)
        t = gathered(s, nearest(moved / omega[1]), bins)
        columns[first:last] = t.real**2 + t.imag**2
    settings = {"rate": rate, "n_fft": n_fft, "window": window_name, "window_seconds": 2 * half / rate}
    time = start + np.arange(size) / rate
    return Distribution(columns.T, omega[:bins], time, "synchrosqueezed", settings, half / rate)


def gathered(s: ComplexArray, cell: NDArray[np.intp], cells: int) -> ComplexArray:
    """Sum of each row of ``s`` over the bins with the same cell, shape ``(rows, cells)``.

    >>> gathered(np.array([[1.0 + 0j, 2j, 4.0]]), np.array([[1, 1, 7]]), 3).tolist()
    [[0j, (1+2j), 0j]]
    """
    rows = s.shape[0]
    flat = np.where((cell >= 0) & (cell < cells), cell + cells * np.arange(rows)[:, None], -1).ravel()
    real, imaginary = (summed(flat, part.ravel(), rows * cells) for part in (s.real, s.imag))
    return (real + 1j * imaginary).reshape(rows, cells)
