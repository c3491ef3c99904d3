"""A straight line fitted to a signal in a window round every sample, by two convolutions."""

from __future__ import annotations

import numpy as np

from ridgeback.numeric.arrays import Array, ComplexArray
from ridgeback.numeric.signal.convolution import convolved


# Weighted least squares of a straight line through c over the window: value and slope decouple for a symmetric w.
def local_line(c: ComplexArray, w: Array, rate: float) -> tuple[ComplexArray, ComplexArray]:
    """Return the value and the slope per time unit of c under the symmetric window ``w``, same length as c.

    Near the border the value is the weighted mean of what there is; the slope is right from half a window inside.
    """
    half = w.size // 2
    j = np.arange(-half, half + 1)
    present = convolved(np.ones(c.size), w)
    value = convolved(c, w) / present
    slope = convolved(c, (w * j)[::-1] / (w * j * j).sum()) * rate
    return np.asarray(value, dtype=np.complex128), np.asarray(slope, dtype=np.complex128)
