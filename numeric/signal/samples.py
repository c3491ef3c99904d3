"""Samples of a signal, checked once, where they come in.

A signal is one-dimensional: float64 when real, complex128 when complex, sampled at a constant rate (samples per
time unit).  Everything behind these checks may rely on it.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, ComplexArray

Floats = NDArray[np.floating]

TWO_PI = 2.0 * math.pi
LARGEST = 1e140
"""Magnitude that a sample may have: products of two still fit into float64."""
SWING = (1e-40, 1e40)
"""Magnitudes whose sixth powers (the polynomial kernel) and their squares stay within float64."""
RATES = (1e-18, 1e18)
"""Sampling rates whose powers in a fit stay far from overflow: any unit of time comes nearer to 1 than that."""
MEMORY_BUDGET = 1_000_000_000
"""Bytes that a plane may take unless the caller says otherwise."""
WORK_BUDGET = 1e12
"""Floating-point operations that one estimate may take: about ten minutes on one core."""


def checked_samples(x: ArrayLike, *, name: str = "signal", at_least: int = 1) -> Array | ComplexArray:
    """Return ``x`` as a one-dimensional float64 or complex128 array of finite values.

    Raises InputError naming the first offending index when a value is not finite, when the shape is not
    one-dimensional, when there are fewer than ``at_least`` samples, or when one is too large to be squared.

    >>> checked_samples([0, 1, 2])
    array([0., 1., 2.])
    >>> checked_samples([0.0, float("nan")])
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: signal[1] is nan; every sample must be finite (cut or fill the gap first)
    """
    array = np.asarray(np.ma.filled(x.astype(np.float64), np.nan) if isinstance(x, np.ma.MaskedArray) else x)
    if array.dtype.kind not in "biufc":
        what = array.dtype if array.ndim else type(x).__name__
        raise InputError(f"{name} is of type {what}; use an array of real or complex numbers")
    if array.ndim != 1:
        raise InputError(f"{name} has shape {array.shape}; use a one-dimensional array")
    if array.size < at_least:
        raise InputError(f"{name} has {array.size} samples; at least {at_least} are needed")
    samples: Array | ComplexArray
    samples = array.astype(np.complex128) if array.dtype.kind == "c" else array.astype(np.float64)
    wrong = np.flatnonzero(~np.isfinite(samples))
    if wrong.size:
        index = int(wrong[0])
        raise InputError(
            f"{name}[{index}] is {samples[index]}; every sample must be finite (cut or fill the gap first)"
        )
    largest = float(np.abs(samples).max())
    if largest > LARGEST:
        raise InputError(f"{name} reaches {largest:.3g}; its square would overflow, scale it below {LARGEST:g}")
    return samples


def checked_real_samples(x: ArrayLike, *, what: str, at_least: int = 1) -> Array:
    """Return real samples as float64; ``what`` names the work that cannot take complex ones.

    >>> checked_real_samples([1j], what="the spectrogram")
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: signal is complex; the spectrogram takes real samples (pass one part of it)
    """
    samples = checked_samples(x, at_least=at_least)
    if np.iscomplexobj(samples):
        raise InputError(f"signal is complex; {what} takes real samples (pass one part of it)")
    return np.asarray(samples, dtype=np.float64)


def checked_rate(rate: float) -> float:
    """Return the sampling rate as a positive finite float.

    >>> checked_rate(0)
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: sampling rate 0 is not positive; give samples per time unit, such as 32.0
    """
    value = float(rate)
    if not (math.isfinite(value) and value > 0.0):
        raise InputError(f"sampling rate {rate} is not positive; give samples per time unit, such as 32.0")
    if not RATES[0] <= value <= RATES[1]:
        raise InputError(
            f"sampling rate {rate:g} is outside {RATES[0]:g} .. {RATES[1]:g}; give it per another unit of time"
        )
    return value


def checked_swing(x: Array, *, name: str = "signal") -> Array:
    """Return samples that are constant, or swing by what their squares and sixth powers leave within float64.

    >>> checked_swing(np.array([0.0, 2e200]))
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: signal swings by 1e+200, outside 1e-40 .. 1e+40; scale it to order 1
    """
    swing = 0.5 * float(x.max()) - 0.5 * float(x.min())
    if swing and not SWING[0] <= swing <= SWING[1]:
        raise InputError(f"{name} swings by {swing:.3g}, outside {SWING[0]:g} .. {SWING[1]:g}; scale it to order 1")
    return x


def checked_budget(needed: int, budget: int, what: str, remedy: str) -> None:
    """Refuse, before the work, what would need more than ``budget`` bytes.

    >>> checked_budget(3_000_000, 1_000_000, "wigner of 600 samples", "pass step=2")
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: wigner of 600 samples needs 3 MB, over the budget of 1 MB; pass step=2
    """
    if needed > budget:
        raise InputError(f"{what} needs {needed / 1e6:.3g} MB, over the budget of {budget / 1e6:.3g} MB; {remedy}")


def checked_work(operations: float, what: str, remedy: str) -> None:
    """Refuse, before the work, what would take more than WORK_BUDGET floating-point operations (about ten minutes).

    >>> checked_work(1e15, "wigner of 10 million samples", "use pseudo-wigner")
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: wigner of 10 million samples needs about 1e+15 operations, over ...
    """
    if operations > WORK_BUDGET:
        raise InputError(
            f"{what} needs about {operations:.2g} operations, over the budget of {WORK_BUDGET:.2g}; {remedy}"
        )
