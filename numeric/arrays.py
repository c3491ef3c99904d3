"""Read-only float64 and boolean arrays, the form in which values are handed over."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


def frozen(values: ArrayLike) -> Array:
    """Return a read-only float64 copy.

    >>> frozen([1, 2]).flags.writeable
    False
    """
    copy = np.array(values, dtype=float)
    copy.flags.writeable = False
    return copy


def frozen_flags(values: ArrayLike) -> Flags:
    """Return a read-only boolean copy.

    >>> frozen_flags([True]).flags.writeable
    False
    """
    copy = np.array(values, dtype=bool)
    copy.flags.writeable = False
    return copy
