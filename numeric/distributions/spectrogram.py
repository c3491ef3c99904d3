"""The spectrogram, by real transforms of a block of windowed segments at a time."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy import fft

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Wanted, showing
from ridgeback.numeric.distributions.distribution import Distribution
from ridgeback.numeric.distributions.shared_parameters import documented
from ridgeback.numeric.signal.samples import MEMORY_BUDGET, TWO_PI, checked_budget, checked_rate, checked_real_samples
from ridgeback.numeric.signal.windows import half_width, window

WORKING_BYTES = 1_000_000
"""Memory of the columns that are transformed at a time: what a core's cache holds is fastest."""


@documented
def spectrogram(
    x: ArrayLike,
    rate: float,
    *,
    window_seconds: float,
    window_name: str = "hann",
    hop: int = 1,
    n_fft: int | None = None,
    start: float = 0.0,
    remove_mean: bool = True,
    memory: int = MEMORY_BUDGET,
    progress: Wanted = None,
) -> Distribution:
    """Return the spectrogram ``|S(omega, t)|^2`` of a real signal, S its short-time Fourier transform.

    S(omega_k, t_n) = sum over j of x[n + j] w[j] exp(-i omega_k j / rate), j = -half .. half, with w symmetric about n
    and divided by half its sum, so that a cosine of amplitude A has a ridge of A^2.  Within half a window of the border
    the record is extended by zeros and the level falls.

    Parameters
    ----------
    {real_signal}
    {rate}
    {window_seconds}
    window_name : str
        ``"rectangular"``, ``"hann"``, ``"hamming"``, ``"blackman"`` or ``"gaussian"``.
    hop : int
        Samples from one column to the next.
    {transform}
    {start}
    {remove_mean}
    {memory}
    {progress}

    Returns
    -------
    Distribution
        ``values[n_fft // 2 + 1, ceil(N / hop)]``, ``omega`` from 0 to the Nyquist frequency, each column's centre in
        ``time``.

    Raises
    ------
    InputError
        For complex or non-finite samples, ``rate`` <= 0, a window longer than the signal, ``n_fft`` shorter
        than the window, or work over ``memory``.

    Examples
    --------
    >>> tone = 3.0 * np.cos(2 * np.pi * 4.0 * np.arange(256) / 32.0)
    >>> plane = spectrogram(tone, 32.0, window_seconds=2.0, n_fft=256)
    >>> round(float(plane.values[32, 128]), 2), float(plane.frequency_hz[32])
    (9.0, 4.0)
    """
    samples, rate = checked_real_samples(x, what="the one-sided spectrogram", at_least=3), checked_rate(rate)
    if hop < 1:
        raise InputError(f"hop {hop} is below one sample; use 1 or more")
    if remove_mean:
        samples = samples - samples.mean()
    half = half_width(window_seconds, rate, name="window_seconds", longest=samples.size)
    w = window(window_name, half)
    n_fft = fft.next_fast_len(2 * w.size, real=True) if n_fft is None else n_fft
    if n_fft < w.size:
        raise InputError(f"n_fft {n_fft} is below the window of {w.size} samples; use at least {w.size}")
    frames = -(-samples.size // hop)
    remedy = "use a larger hop"
    checked_budget(24 * frames * (n_fft // 2 + 1), memory, f"spectrogram of {frames} columns", remedy)
    taper, segments = 2.0 * w / w.sum(), np.lib.stride_tricks.sliding_window_view(np.pad(samples, half), w.size)[::hop]
    columns = np.empty((frames, n_fft // 2 + 1))
    block = max(1, WORKING_BYTES // (16 * n_fft))
    with showing(progress) as told:
        for first in range(0, frames, block):
            told(first / frames, "spectrogram")
            spectra = fft.rfft(segments[first : first + block] * taper, n_fft, axis=1)
            np.add(spectra.real**2, spectra.imag**2, out=columns[first : first + block])
    settings = {"rate": rate, "n_fft": n_fft, "hop": hop, "window": window_name, "window_seconds": 2 * half / rate}
    time = start + np.arange(frames) * hop / rate
    return Distribution(columns.T, TWO_PI * rate * fft.rfftfreq(n_fft), time, "spectrogram", settings, half / rate)
