"""The analytic signal by the discrete Fourier transform, for every N."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy import fft

from ridgeback.numeric.arrays import Array, ComplexArray
from ridgeback.numeric.signal.samples import checked_real_samples, checked_samples


def positive_frequency_weights(size: int) -> Array:
    """Weights on the DFT bins of a real signal that leave its analytic signal: 1 at zero, 2 at positive, 0 at negative.

    The bin at the Nyquist frequency, which only even N has, belongs to both halves and keeps the weight 1.

    >>> positive_frequency_weights(5).tolist(), positive_frequency_weights(4).tolist()
    ([1.0, 2.0, 2.0, 0.0, 0.0], [1.0, 2.0, 1.0, 0.0])
    """
    weights = np.zeros(size)
    weights[0] = 1.0
    weights[1 : (size + 1) // 2] = 2.0
    if size % 2 == 0:
        weights[size // 2] = 1.0
    return weights


# z = x + i H[x]; by the DFT (Marple, IEEE Trans. Signal Process. 47 (1999) 2600): Z_k = w_k X_k.
def analytic_of(samples: Array) -> ComplexArray:
    """The analytic signal of samples that have been checked."""
    z = fft.ifft(positive_frequency_weights(samples.size) * fft.fft(samples))
    return np.asarray(samples + 1j * z.imag, dtype=np.complex128)


def analytic_signal(x: ArrayLike, *, remove_mean: bool = False) -> ComplexArray:
    """Return the analytic signal of real samples.

    The DFT takes the record as one period: where the end does not continue into the beginning the imaginary part is
    wrong near both borders, by a share that falls like one over the distance from the border in cycles.  It is exact
    for a periodic record.

    Parameters
    ----------
    x : array of float, shape (N,)
        The samples, any N >= 1.
    remove_mean : bool
        Whether their mean is taken off first.

    Returns
    -------
    array of complex, shape (N,)
        Its real part is ``x`` itself (less its mean when ``remove_mean``).

    Raises
    ------
    InputError
        For complex, non-finite or non-one-dimensional input.

    References
    ----------
    Marple, IEEE Trans. Signal Process. 47 (1999) 2600.

    Examples
    --------
    >>> np.round(analytic_signal([1.0, 0.0, -1.0, 0.0]), 12).tolist()
    [(1+0j), 1j, (-1+0j), -1j]
    """
    samples = checked_real_samples(x, what="analytic_signal")
    return analytic_of(samples - samples.mean() if remove_mean else samples)


def as_analytic(x: ArrayLike, *, remove_mean: bool = True) -> ComplexArray:
    """Real samples become their analytic signal (less the mean, by default); complex samples stay as they are."""
    samples = checked_samples(x)
    if np.iscomplexobj(samples):
        return np.asarray(samples, dtype=np.complex128)
    real = np.asarray(samples, dtype=np.float64)
    return analytic_of(real - real.mean() if remove_mean else real)
