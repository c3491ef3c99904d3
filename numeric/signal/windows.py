"""Symmetric windows with their widths in seconds, defined once."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array

# Each is a function of s in (-1, 1), 1 at s = 0.  Harris, Proc. IEEE 66 (1978) 51.
WINDOWS: Mapping[str, Callable[[Array], Array]] = MappingProxyType(
    {
        "rectangular": np.ones_like,
        "hann": lambda s: np.cos(0.5 * math.pi * s) ** 2,
        "hamming": lambda s: 0.54 + 0.46 * np.cos(math.pi * s),
        "blackman": lambda s: 0.42 + 0.5 * np.cos(math.pi * s) + 0.08 * np.cos(2 * math.pi * s),
        "gaussian": lambda s: np.exp(-4.5 * s * s),
    }
)


# dw/ds of those that end at zero; the others jump at their ends, where a slope says nothing.
SLOPES: Mapping[str, Callable[[Array], Array]] = MappingProxyType(
    {
        "hann": lambda s: -0.5 * math.pi * np.sin(math.pi * s),
        "blackman": lambda s: -0.5 * math.pi * np.sin(math.pi * s) - 0.16 * math.pi * np.sin(2 * math.pi * s),
    }
)


def window(name: str, half: int) -> Array:
    """Return the ``2 half + 1`` samples at s = j / (half + 1), j = -half .. half, so that no end sample is zero.

    >>> window("hann", 1).round(12).tolist()
    [0.5, 1.0, 0.5]
    """
    if name not in WINDOWS:
        raise InputError(f"window {name!r} is unknown; use one of {', '.join(WINDOWS)}")
    if half < 0:
        raise InputError(f"half width {half} of a window is negative; use 0 or more")
    return WINDOWS[name](np.arange(-half, half + 1) / (half + 1.0))


def window_slope(name: str, half: int) -> Array:
    """Return the slope per sample of :func:`window` at its ``2 half + 1`` samples.

    Raises InputError for a window that does not end at zero.

    >>> window_slope("hann", 1).round(6).tolist()
    [0.785398, -0.0, -0.785398]
    """
    if name not in SLOPES:
        raise InputError(f"window {name!r} does not end at zero; reassignment needs one of {', '.join(SLOPES)}")
    return SLOPES[name](np.arange(-half, half + 1) / (half + 1.0)) / (half + 1.0)


def half_width(seconds: float, rate: float, *, name: str = "lag_seconds", longest: int | None = None) -> int:
    """Samples on each side of the centre of a window that spans ``seconds`` of signal, ``2 half / rate``.

    Raises InputError when the width is not positive and finite, below one step, or longer than ``longest`` samples.

    >>> half_width(3.0, 32.0)
    48
    """
    if not (math.isfinite(seconds) and seconds > 0.0):
        raise InputError(f"{name} {seconds} is not a positive width; use for example {8 / rate:.4g}")
    if seconds * rate < 1.0:
        raise InputError(
            f"{name} {seconds:.4g} is shorter than the step between two samples, {1.0 / rate:.4g}; "
            f"use for example {8 / rate:.4g}"
        )
    half = max(1, round(0.5 * seconds * rate))
    if longest is not None and 2 * half + 1 > longest:
        raise InputError(
            f"{name} {seconds:.6g} needs {2 * half + 1} samples, the signal has {longest}; "
            f"use at most {(longest - 1) / rate:.6g}"
        )
    return half
