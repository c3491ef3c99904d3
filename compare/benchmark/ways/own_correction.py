"""An estimate corrected by its own track: no other estimator has a word in it.

The bias of a method at work on a signal with frequency omega(t) is found by letting it loose on a signal whose
frequency is known and nearly the same: the one that its own track describes.  With M the method and S[w] the signal
of frequency w(t) whose slowly varying harmonics are fitted to the samples,

    w_1 = w_0 - (M(S[w_0]) - w_0),   w_0 = M(x),

and once more from w_1 (iterated bias correction; Hall, The Bootstrap and Edgeworth Expansion, 1992, section 1.4).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.polynomial import Polynomial
from scipy.interpolate import BSpline, make_interp_spline

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.tracking.track import Track

Method = Callable[[Array], Track]
"""Samples to a track, at the rate and with the settings of the estimate that is corrected."""

HARMONICS = 3
KNOTS_PER_CYCLE = 0.25
ROUNDS = 2
REACH = 6.0
"""Cycles at either end of the valid part that say how it goes on beyond."""


def corrected(track: Track, method: Method, x: Array, rate: float) -> Track:
    """Return the track less the bias that its method shows on the signal that the track describes.

    Parameters
    ----------
    track : Track
        ``method(x)``.
    method : callable
        Samples, shape ``(N,)``, to a Track.
    x : ndarray, shape (N,)
        The samples.
    rate : float
        Samples per time unit.

    Returns
    -------
    Track
        Valid where the given track is; the standard deviation is that of the given track.
    """
    time = np.arange(x.size) / rate + track.start
    omega = held_beyond(track, time)
    for _ in range(ROUNDS):
        shown = method(described(x, omega, rate))
        known = np.interp(shown.time, time, omega)
        bias = np.where(shown.valid, shown.omega - known, np.nan)
        good = np.isfinite(bias)
        if not good.any():
            break
        omega = held_beyond(track, time) - np.interp(time, shown.time[good], bias[good])
    return replace(track, omega=np.interp(track.time, time, omega))


def held_beyond(track: Track, time: Array) -> Array:
    """The valid part of a track on all samples; beyond it, the parabola through its last and first cycles."""
    keep = track.valid & np.isfinite(track.omega)
    t, w = track.time[keep], track.omega[keep]
    if t.size < 4:
        return np.full(time.size, float(w.mean()) if t.size else np.nan)
    inside = np.interp(time, t, w)
    for beyond, edge in ((time < t[0], 0), (time > t[-1], -1)):
        near = np.abs(t - t[edge]) <= REACH * 2 * np.pi / w[edge]
        if beyond.any() and near.sum() > 3:
            shape = Polynomial.fit(t[near], w[near], 2)
            inside[beyond] = w[edge] + (shape(time[beyond]) - shape(t[edge]))
    return np.asarray(np.clip(inside, 0.5 * w.min(), 1.5 * w.max()))


def described(x: Array, omega: Array, rate: float) -> Array:
    """The signal offset(t) + sum of |c_m(t)| cos(m phi), phi = int omega dt, its envelopes fitted to the samples.

    The envelopes c_m are complex splines, so that a small error of phi does not spoil their size; only their modulus
    is used, or the signal would have the frequency of the samples again and not omega.
    """
    time = np.arange(x.size) / rate
    phase = make_interp_spline(time, omega, k=3).antiderivative()(time)
    cycles = float(phase[-1] / (2 * np.pi))
    basis = slow_basis(time, max(2, int(KNOTS_PER_CYCLE * cycles)))
    waves = [np.ones(x.size)]
    for m in range(1, HARMONICS + 1):
        waves += [np.cos(m * phase), np.sin(m * phase)]
    coefficients, *_ = np.linalg.lstsq(np.hstack([basis * wave[:, None] for wave in waves]), x, rcond=None)
    offset, *parts = (basis @ part for part in coefficients.reshape(len(waves), -1))
    sizes = [np.hypot(a, b) for a, b in zip(parts[::2], parts[1::2], strict=True)]
    return np.asarray(offset + sum(size * waves[2 * m + 1] for m, size in enumerate(sizes)))


def slow_basis(time: Array, pieces: int) -> Array:
    """Cubic B-splines on equal pieces of the record, ``[sample, spline]``."""
    inner = np.linspace(time[0], time[-1], pieces + 1)
    knots = np.concatenate((np.full(3, time[0]), inner, np.full(3, time[-1])))
    return np.asarray(BSpline.design_matrix(time, knots, 3).toarray())
