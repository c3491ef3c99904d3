"""Local harmonic least squares: a phase polynomial and its harmonics, fitted in a sliding window by Gauss-Newton.

In a window of n samples, with s = -1 .. 1 across it,

    x = a(s) cos phi + sum over h of [b_h(s) cos h phi + c_h(s) sin h phi] + d + d' s + noise,
    phi = p_0 + p_1 s + .. + p_D s^D,      a, b_h, c_h polynomials in s times one exponential e^(g s),

with g such that a / e^(g s) is level in the middle: a plain damped oscillation is in the model at any damping, and the
polynomial has only what changes in its growth rate to follow.  So phi is by definition the phase of the fundamental,
the higher harmonics may drift against it, and omega = phi'.
For white Gaussian noise this is maximum likelihood, and the standard deviation is the Cramer-Rao bound of this model
with the residual variance put in (Kay, Fundamentals of Statistical Signal Processing: Estimation Theory, 1993, ch. 3).
All windows have the same length; near the border they stop moving and omega is read off-centre, one-sidedly.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import cumulative_trapezoid

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, Mask, freeze
from ridgeback.numeric.harmonics.window_steps import (
    ITERATIONS,
    NEAR_REST,
    Shape,
    Solution,
    gauss_newton,
    powers,
    slopes,
)
from ridgeback.numeric.signal.samples import checked_work

MOST_HARMONICS = 12
KEPT = 16
"""Records whose harmonics are kept: several parts of an estimate ask for those of the same windows."""
ONE_WINDOW = 12.0
"""Gain of the criterion in a single window that shows a harmonic: chance reaches it in one of a million windows."""


BLOCK_VALUES = 2_000_000
"""Jacobian entries that one block of windows may hold (16 MB)."""


@dataclass(frozen=True)
class HarmonicFit:
    """Fundamental frequency and amplitude per window, with standard deviations from the Fisher information.

    ``amplitude`` has the definition ``fundamental`` and ``growth`` is a'/a, negative in a decay.  ``noise`` is the
    residual's standard deviation per window.  ``settled`` says that the iteration came to rest, ``valid`` that the
    window also lies wholly inside the record, round its time.
    """

    time: Array
    omega: Array
    standard_deviation: Array
    amplitude: Array
    amplitude_sd: Array
    growth: Array
    growth_sd: Array
    offset: Array
    noise: Array
    settled: Mask
    valid: Mask
    shape: Shape
    window_seconds: float

    def __post_init__(self) -> None:
        freeze(self)


def quadratic_form(vector: Array, matrix: Array) -> Array:
    """v^T M v for each window."""
    return np.asarray(np.einsum("wp,wpq,wq->w", vector, matrix, vector), dtype=np.float64)


def harmonic_fit(
    x: Array,
    rate: float,
    guide: Array,
    *,
    half: int,
    shape: Shape,
    start_time: float = 0.0,
    centres: NDArray[np.intp] | None = None,
) -> HarmonicFit:
    """Fit phase, amplitudes and offset as polynomials in a window around each centre.

    Parameters
    ----------
    x : array of float, shape (N,)
        The samples, without their mean.
    rate : float
        Samples per time unit.
    guide : array of float, shape (N,)
        Frequencies to start from, rad per time unit.
    half : int
        Samples on each side of a window.
    shape : Shape
        Degrees and harmonics.
    start_time : float
        Time of the first sample.
    centres : array of int, optional
        All samples by default.

    Returns
    -------
    HarmonicFit
        Frequency, amplitude, growth rate, offset and noise at the centres, with deviations.

    Raises
    ------
    InputError
        When the record is shorter than one window, the window holds too few samples for the model, or the work is over
        the budget.

    Examples
    --------
    >>> t = np.arange(320) / 32.0
    >>> x = 2.0 * np.cos(2 * np.pi * (1.0 * t + 0.02 * t**2)) + 0.3
    >>> fit = harmonic_fit(x, 32.0, np.full(320, 2 * np.pi * 1.2), half=48, shape=Shape())
    >>> bool(np.abs(fit.omega / (2 * np.pi) - 1.0 - 0.04 * t).max() < 1e-9), round(float(fit.amplitude[160]), 9)
    (True, 2.0)
    """
    length = 2 * half + 1
    if x.size < length:
        raise InputError(f"signal has {x.size} samples, the window of harmonic least squares needs {length}")
    if length < shape.size + 4:
        raise InputError(
            f"window of {length} samples is too short for the {shape.size} parameters of the harmonics fitted; "
            f"use at least {shape.size + 4} samples ({(shape.size + 4) / rate:.4g} time units) by a longer lag, "
            "fewer harmonics, or another method"
        )
    centres = np.arange(x.size) if centres is None else centres
    work = float(centres.size) * length * shape.size**2 * ITERATIONS
    checked_work(work, f"harmonic least squares of {centres.size} windows of {length} samples", "shorten the window")
    begins = np.clip(centres - half, 0, x.size - length)
    s = np.arange(-half, half + 1) / half
    guide_phase = cumulative_trapezoid(guide, dx=1.0 / rate, initial=0)
    block = max(1, BLOCK_VALUES // (length * shape.size))
    parts = []
    for first in range(0, centres.size, block):
        window = begins[first : first + block, None] + np.arange(length)
        parts.append(gauss_newton(s, x[window], guide_phase[window], shape))
    return read_off(parts, (centres - begins - half) / half, centres, rate, half, shape, start_time)


def read_off(
    parts: list[Solution], at: Array, centres: NDArray[np.intp], rate: float, half: int, shape: Shape, start_time: float
) -> HarmonicFit:
    """Frequency, amplitude and offset at ``s = at`` of each window, with their standard deviations."""
    p, a, d = (np.concatenate([getattr(part, name) for part in parts]) for name in ("p", "a", "d"))
    p_cov, a_cov = (
        np.concatenate([getattr(part, name) for part in parts]) for name in ("p_covariance", "a_covariance")
    )
    variance = np.concatenate([part.variance for part in parts])
    settled = np.concatenate([part.settled for part in parts])
    phase_slope, value = slopes(at, shape.phase_degree) * (rate / half), powers(at, shape.amplitude_degree)
    amplitude_slope = slopes(at, shape.amplitude_degree) * (rate / half)
    exponent = np.concatenate([part.growth for part in parts])
    grown = np.exp(exponent * at)
    level = (value * a).sum(axis=1)
    safe = np.where(level == 0.0, 1.0, level)
    steeper = (amplitude_slope * a).sum(axis=1) / safe
    return HarmonicFit(
        time=start_time + centres / rate,
        omega=(phase_slope * p).sum(axis=1),
        standard_deviation=np.sqrt(variance * quadratic_form(phase_slope, p_cov)),
        amplitude=grown * level,
        amplitude_sd=grown * np.sqrt(variance * quadratic_form(value, a_cov)),
        growth=exponent * (rate / half) + steeper,
        growth_sd=np.sqrt(variance * quadratic_form(amplitude_slope - steeper[:, None] * value, a_cov)) / np.abs(safe),
        offset=(powers(at, 1) * d).sum(axis=1),
        noise=np.sqrt(variance),
        settled=settled,
        valid=settled & (at == 0.0),
        shape=shape,
        window_seconds=2.0 * half / rate,
    )


def choose_multiples(x: Array, rate: float, guide: Array, *, half: int) -> tuple[int, ...]:
    """Choose the harmonics to fit: each multiple in turn, kept when it lowers the Bayesian information criterion.

    The criterion is summed over windows that tile the record; in one of them alone, as at the top of a fast decay, it
    must fall by ONE_WINDOW.  Multiples stay below nine tenths of the Nyquist
    frequency, and the model below a third of the window's samples.

    Parameters
    ----------
    x : array of float, shape (N,)
        The samples, without their mean.
    rate : float
        Samples per time unit.
    guide : array of float, shape (N,)
        Frequency of the fundamental, rad per time unit.
    half : int
        Samples on each side of a window.

    Returns
    -------
    tuple of int
        Multiples beside the fundamental, rising.
    """
    length = 2 * half + 1
    begins = np.unique(np.linspace(0, x.size - length, min(12, max(1, x.size // length))).astype(int))
    window = begins[:, None] + np.arange(length)
    guide_phase = cumulative_trapezoid(guide, dx=1.0 / rate, initial=0)[window]
    highest = min(MOST_HARMONICS, int(0.9 * math.pi * rate / guide.max()))
    floor = (1e-9 * float(np.abs(x).max())) ** 2
    return shown_in(x[window].tobytes(), guide_phase.tobytes(), length, highest, floor)


@lru_cache(maxsize=KEPT)
def shown_in(windows: bytes, phases: bytes, length: int, highest: int, floor: float) -> tuple[int, ...]:
    """The harmonics that windows of so many samples show, from their samples and guide phases, kept for the next asker.

    Each fit begins where that without the last harmonic came to rest, which is a step or two away.
    """
    x, phase = (np.frombuffer(values).reshape(-1, length) for values in (windows, phases))
    s = np.arange(-(length // 2), length // 2 + 1) / (length // 2)

    def criterion(shape: Shape, fit: Solution) -> Array:
        return np.asarray(length * np.log(fit.variance + floor) + shape.size * math.log(length))

    kept = Shape(())
    fit = gauss_newton(s, x, phase, kept, rest=NEAR_REST)
    best = criterion(kept, fit)
    for h in range(2, highest + 1):
        trial = Shape((*kept.multiples, h))
        if 3 * trial.size > length:
            break
        new = gauss_newton(s, x, phase, trial, rest=NEAR_REST, begin=fit)
        score = criterion(trial, new)
        if score.sum() < best.sum() or (best - score).max() > ONE_WINDOW:
            kept, fit, best = trial, new, score
    return kept.multiples
