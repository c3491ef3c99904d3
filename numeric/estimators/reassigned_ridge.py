"""Tracks from reassigned and synchrosqueezed short-time spectra."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ridgeback.numeric.arrays import Array, ComplexArray, Mask
from ridgeback.numeric.distributions.reassigned_spectrogram import blocks, gathered, nearest, squeezed
from ridgeback.numeric.distributions.reassignment import WindowFamily, first_order, window_family
from ridgeback.numeric.distributions.ridge import Ridge, follow
from ridgeback.numeric.distributions.short_time import ShortTimeKernel
from ridgeback.numeric.estimators.peak import peak_estimate, windowed
from ridgeback.numeric.harmonics.noise import Level, phase_noise
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.tracking.request import Request
from ridgeback.numeric.tracking.track import Track

RidgeOf = Callable[[ComplexArray, WindowFamily, float, Array, Array], Ridge]
DeviationOf = Callable[[Level], Array]

LOBE = 3.0
"""Half width of a window's main lobe, in bins of its own length: Blackman's, the widest here."""
NEAR = 2
"""Cells on each side of the highest over which the synchrosqueezed frequency is averaged with the weight |S|^4.

The square of the energy: with the energy itself the flanks of the lobe, where noise counts most, weigh too much (a
fifth more deviation, and one that depends on how much of them the cells catch).
"""


# On a tone, at the ridge, the operator answers to a small phase eta by d omega = -sum w' eta / sum w.
def slope_deviation(level: Level, family: WindowFamily) -> Array:
    """Standard deviation in white noise of a frequency read off w' at the ridge, rad per time unit, per sample."""
    response = float(np.sqrt((family.slope**2).sum())) / float(family.plain.sum())
    return np.asarray(response * phase_noise(level), dtype=np.float64)


# The second-order operator off a tone at 0 by omega: with beta = gamma = 0 both right-hand sides R1, R2 vanish, so that
# d beta = (S_{tau^2 w} dR1 - S_{tau w} dR2) / determinant, dR1 and dR2 being the right-hand sides of i eta itself.
def squeezed_deviation(level: Level, family: WindowFamily, rate: float) -> Array:
    """Standard deviation in weak white noise of the mean over a main lobe, rad per time unit, per sample."""
    tau = np.arange(-family.half, family.half + 1) / rate
    omega = TWO_PI * rate / tau.size * np.linspace(-LOBE, LOBE, 49)[1:-1, None]
    turns = np.exp(-1j * omega * tau)
    s, s_lag, s_square = ((turns @ w)[:, None] for w in (family.plain, family.lag, family.lag_square))
    one = 1j * omega * family.plain - family.slope
    two = 1j * omega * family.lag - family.lag_slope - family.plain
    answer = (1j * turns * (s_square * one - s_lag * two) / (s * s_square - s_lag**2)).imag
    weight = np.abs(s) ** 4
    response = (weight * answer).sum(axis=0) / weight.sum()
    return np.asarray(float(np.sqrt((response**2).sum())) * phase_noise(level), dtype=np.float64)


def at_ridge(z: ComplexArray, family: WindowFamily, rate: float, omega: Array) -> tuple[Array, Array]:
    """Shift in time and reassigned frequency of each column at its own ``omega``, by sums over its segment."""
    tau = np.arange(-family.half, family.half + 1) / rate
    segments = np.lib.stride_tricks.sliding_window_view(np.pad(z, family.half), tau.size)
    windows = np.stack(family.three, axis=1)
    shift, moved = np.empty(z.size), np.empty(z.size)
    for first, last in blocks(z.size, tau.size, 3):
        turned = segments[first:last] * np.exp(-1j * omega[first:last, None] * tau)
        s, s_slope, s_lag = (turned @ windows).T[:, :, None]
        a, b = first_order(omega[first:last, None], s, s_slope, s_lag)
        shift[first:last], moved[first:last] = a[:, 0], b[:, 0]
    return shift, moved


def reassigned_ridge(z: ComplexArray, family: WindowFamily, rate: float, low: Array, high: Array) -> Ridge:
    """The ridge of a spectrogram, moved in time and frequency by reassignment and read at the samples again."""
    ridge = follow(ShortTimeKernel(z, rate, family.plain), low, high)
    shift, moved = at_ridge(z, family, rate, ridge.omega)
    time = np.arange(z.size) + np.clip(shift * rate, -family.half, family.half)
    order = np.argsort(time, kind="stable")
    omega = np.interp(np.arange(z.size), time[order], moved[order])
    return Ridge(np.asarray(omega, dtype=np.float64), ridge.height, ridge.inside)


def by_reassignment(
    request: Request, method: str, ridge_of: RidgeOf, family: WindowFamily, *, windows: int, deviation: DeviationOf
) -> Track:
    """The ridge of a spectrum whose energy is moved, which takes the work of so many ``windows``."""
    signal, search = request.signal, request.signal.search
    return peak_estimate(
        request,
        method,
        lambda z: ridge_of(z, family, signal.rate, search.low, search.high),
        bins=windows * (2 * request.half + 1),
        border=0.5 * request.plan.lag_seconds,
        deviation=deviation,
        used=windowed(request),
        lag_window=request.options.lag_window,
    )


def by_reassigned_spectrogram(request: Request) -> Track:
    """Ridge of the reassigned spectrogram of the analytic signal."""
    family = window_family(request.options.lag_window, request.half, request.signal.rate)
    return by_reassignment(
        request,
        "reassigned-spectrogram",
        reassigned_ridge,
        family,
        windows=3,
        deviation=lambda level: slope_deviation(level, family),
    )


def average_near(moved: Array, weights: Array, cell: NDArray[np.intp], at: NDArray[np.intp]) -> Array:
    """Weighted mean of ``moved`` over the bins that fell within NEAR cells of cell ``at`` of their row.

    >>> average_near(np.array([[3.0, 5.0, 9.0]]), np.array([[1.0, 3.0, 1.0]]), np.array([[3, 5, 9]]), np.array([4]))
    array([4.5])
    """
    weight = np.where(np.abs(cell - at[:, None]) <= NEAR, weights, 0.0)
    total = weight.sum(axis=1)
    return np.asarray((weight * moved).sum(axis=1) / np.where(total > 0.0, total, 1.0), dtype=np.float64)


def squeezed_ridge(z: ComplexArray, family: WindowFamily, rate: float, low: Array, high: Array) -> Ridge:
    """The highest cell of the synchrosqueezed spectrum between ``low`` and ``high``, and the mean frequency there."""
    n_fft = ShortTimeKernel(z, rate, family.plain).n_fft
    omega = TWO_PI * rate * np.arange(n_fft) / n_fft
    found, height, inside = np.empty(z.size), np.empty(z.size), np.empty(z.size, dtype=np.bool_)
    for first, last in blocks(z.size, n_fft, 5):
        part = slice(first, last)
        s, moved = squeezed(z, family, omega, first, last)
        cell = nearest(moved / omega[1])
        power = np.abs(gathered(s, cell, n_fft // 2 + 1)) ** 2
        allowed: Mask = (omega[: power.shape[1]] >= low[part, None]) & (omega[: power.shape[1]] <= high[part, None])
        at = np.where(allowed, power, -1.0).argmax(axis=1)
        found[part] = average_near(moved, (s.real**2 + s.imag**2) ** 2, cell, at)
        height[part] = power[np.arange(last - first), at]
        inside[part] = allowed[np.arange(last - first), at] & (height[part] > 0.0)
    inside &= (found >= low) & (found <= high)
    return Ridge(np.where(found > 0.0, found, low), height, inside)


def by_synchrosqueezing(request: Request) -> Track:
    """Ridge of the second-order synchrosqueezed spectrogram of the analytic signal."""
    family = window_family(request.options.lag_window, request.half, request.signal.rate)
    return by_reassignment(
        request,
        "synchrosqueezed",
        squeezed_ridge,
        family,
        windows=9,
        deviation=lambda level: squeezed_deviation(level, family, request.signal.rate),
    )
