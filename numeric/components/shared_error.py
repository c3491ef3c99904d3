"""How much less is known of one component beside others: by the Fisher information of all of them together."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.components.tones import Tone
from ridgeback.numeric.harmonics.spline_model import SplineModel

MOST_POWERS, FREE = 4, 3.0
"""Powers of time by which the tangent of an oscillation is spanned at most; and coefficients of a spline by which the
component is measured: what noise does to all of them is about that many times what it does to a growth rate."""


# The variance of a parameter is that diagonal element of the inverse of J^T J, J the derivatives of the signal by all
# parameters (Kay, Fundamentals of Statistical Signal Processing: Estimation Theory, 1993, ch. 3).
def shared_error(tone: Tone, others: tuple[Tone, ...], model: SplineModel) -> float:
    """The variance of what is measured of a tone beside an oscillation and other tones, over that of the tone alone.

    The errors of the others enter its growth rate and its frequency, which stand for a part of what is free in it.

    >>> from ridgeback.numeric.harmonics.signal_model import signal_models
    >>> t = np.arange(800) / 40.0
    >>> model = signal_models(np.exp(-0.1 * t) * np.cos(9.0 * t), 40.0, np.full(800, 9.0), half=60, multiples=()).best
    >>> far, near = (shared_error(Tone(omega, -0.1, 0.5 + 0j), (), model) for omega in (15.0, 9.4))
    >>> far < 1.01, near > 1.5
    (True, True)
    """
    time = model.time
    own = scaled(replace(tone, growth=tone.growth or -1e-300).tangent(time))
    wave = model.size * np.exp(1j * model.phase)
    powers = (time / time[-1])[:, None] ** np.arange(min(model.basis.count, MOST_POWERS))
    every = np.concatenate([own, powers * wave.real[:, None], powers * wave.imag[:, None]], axis=1)
    every = np.concatenate([every, *(other.tangent(time) for other in others)], axis=1)
    alone, beside = (float(np.linalg.pinv(j.T @ j)[3, 3]) for j in (own, scaled(every)))
    return 1.0 + max(0.0, beside / alone - 1.0) / FREE


def scaled(columns: Array) -> Array:
    """Columns of length 1."""
    return np.asarray(columns / np.maximum(np.linalg.norm(columns, axis=0), 1e-300))
