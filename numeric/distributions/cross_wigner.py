"""The cross-Wigner distribution of two signals.

    W_xy(t, omega) = integral of x(t + tau/2) conj y(t - tau/2) h(tau) exp(-i omega tau) d tau

is complex; W_yx = conj W_xy, W_xx = W_x, and W_{x+y} = W_x + W_y + 2 Re W_xy: its real part is half the cross term that
a Wigner distribution shows between two components.  Scaling and axes are those of ``distributions.wigner``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike
from scipy import fft

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, frozen
from ridgeback.numeric.distributions.lag_kernel import Complexes, LagKernel, lagged
from ridgeback.numeric.distributions.wigner import MEMORY_BUDGET, wigner_kernel
from ridgeback.numeric.signal.samples import TWO_PI, checked_budget


@dataclass(frozen=True)
class CrossDistribution:
    """Complex ``values[frequency, time]``, omega in rad per time unit; the plane is a read-only view."""

    values: Complexes
    omega: Array
    time: Array
    name: str
    settings: Mapping[str, object] = field(default_factory=dict)

    def __post_init__(self) -> None:
        kept = self.values.dtype if self.values.dtype == np.complex64 else np.complex128
        plane = np.asarray(self.values, dtype=kept).view()
        plane.flags.writeable = False
        object.__setattr__(self, "values", plane)
        object.__setattr__(self, "omega", frozen(self.omega))
        object.__setattr__(self, "time", frozen(self.time))
        object.__setattr__(self, "settings", MappingProxyType(dict(self.settings)))

    @property
    def frequency_hz(self) -> Array:
        """The frequency axis in cycles per time unit."""
        return self.omega / TWO_PI


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
) -> CrossDistribution:
    """Return the cross-Wigner distribution of two signals of one length, over all lags or under a window of them.

    Real signals are made analytic (less their means unless ``remove_mean`` is False), complex ones taken as they are.
    ``single=True`` works in complex64: half the memory, an error near 3e-7 of the largest value.
    Raises InputError as ``wigner`` does, and for signals of different length.

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
    for begin, end in first.spans(2 * bins):
        columns[begin:end] = fft.fft(cross_columns(first, second, begin, end), axis=1, overwrite_x=True)
    settings = {
        "rate": first.rate,
        "n_fft": bins,
        "lag_seconds": float(first.lags[-1]),
        "precision": first.signal.real.dtype.name,
    }
    time = start + np.arange(size) / first.rate
    return CrossDistribution(columns.T, first.omega, time, "cross-wigner", settings)


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
