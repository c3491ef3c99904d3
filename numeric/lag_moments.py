"""Sums over lags with a factor exp(-i theta m) and their derivatives, without an exponential per lag."""

from __future__ import annotations

import math

import numpy as np

from numeric.samples import Array, ComplexArray


# Writing m = a + q b turns the sum into one matrix product and a short sum: no exponential per lag.
def lag_moments(columns: ComplexArray, theta: Array) -> ComplexArray:
    """Return sum over m of m^j K[:, m] exp(-i theta m), j = 0, 1, 2; shape ``(columns, 3)``.

    >>> lag_moments(np.array([[1.0 + 0j, 1.0, 1.0]]), np.zeros(1)).real.tolist()
    [[3.0, 3.0, 5.0]]
    """
    count, lags = columns.shape
    q = max(1, math.isqrt(lags))
    rows = -(-lags // q)
    padded = columns
    if rows * q > lags:
        padded = np.zeros((count, rows * q), dtype=np.complex128)
        padded[:, :lags] = columns
    a = np.arange(q)
    turns = np.exp(-1j * theta[:, None] * a)
    inner = padded.reshape(count, rows, q) @ np.stack([turns, turns * a, turns * a * a], axis=2)
    shift = q * np.arange(rows)
    outer = np.exp(-1j * theta[:, None] * shift)
    t0, t1, t2 = inner[..., 0], inner[..., 1], inner[..., 2]
    parts = (t0, t1 + shift * t0, t2 + 2.0 * shift * t1 + shift * shift * t0)
    return np.stack([(outer * part).sum(axis=1) for part in parts], axis=1)
