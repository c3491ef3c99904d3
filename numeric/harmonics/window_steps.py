"""Gauss and Newton's steps of local harmonic least squares, in many windows of one length at once.

The model and its source stand in ``harmonics.local_fit``.  A window takes steps until its noise would not show another.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ridgeback.numeric.arrays import Array, Mask

ITERATIONS, SETTLED = 8, 1e-3
AT_REST, NEAR_REST = 1e-10, 1e-5
"""Last steps, in radians, at which a fit ends, and at which it is near enough for its residual to be compared."""
PHASE_DEGREE, AMPLITUDE_DEGREE = 3, 2
UNSEEN_IN_A_WINDOW = 1e-3
"""Last step of the phase at which the fit of a window ends, relative to what the noise leaves open of it by one
parameter."""
MOST_GROWTH = 2.0
"""Bound of g: from one end of a window to the other the exponential changes by a factor of e^4 at most."""


@dataclass(frozen=True)
class Shape:
    """What the local model holds: the multiples beside the fundamental, and the degrees of phase and amplitudes.

    >>> Shape((3, 5)).size
    21
    """

    multiples: tuple[int, ...] = ()
    phase_degree: int = PHASE_DEGREE
    amplitude_degree: int = AMPLITUDE_DEGREE

    @property
    def size(self) -> int:
        """The number of parameters."""
        return self.phase_degree + 1 + (self.amplitude_degree + 1) * (1 + 2 * len(self.multiples)) + 2


def powers(s: Array, degree: int) -> Array:
    """Columns s^0 .. s^degree."""
    columns = np.ones((*s.shape, degree + 1))
    columns[..., 1:] = s[..., None]
    return np.asarray(np.multiply.accumulate(columns, axis=-1))


def slopes(s: Array, degree: int) -> Array:
    """Columns of the derivatives of s^0 .. s^degree."""
    orders = np.arange(degree + 1)
    return np.asarray(orders * s[..., None] ** np.maximum(orders - 1, 0), dtype=np.float64)


def turning(phase: Array) -> NDArray[np.complex128]:
    """exp(i phase)."""
    turn = np.empty(phase.shape, dtype=np.complex128)
    np.cos(phase, out=turn.real)
    np.sin(phase, out=turn.imag)
    return turn


def fill_linear(rows: Array, turn: NDArray[np.complex128], grown: Array, shape: Shape, raised: Array) -> None:
    """Put what enters the model linearly into rows, ``(windows, columns, n)``: amplitude, harmonics, offset.

    Samples lie side by side in memory.  ``grown`` is exp(growth s), and ``raised`` has the powers of s.
    """
    width = shape.amplitude_degree + 1
    slow = grown[:, None] * raised[:, :width].T
    np.multiply(slow, turn.real[:, None], out=rows[:, :width])
    begin, power, reached = width, turn, 1
    for h in shape.multiples:
        power, reached = power * turn ** (h - reached), h
        for part in (power.real, power.imag):
            np.multiply(slow, part[:, None], out=rows[:, begin : begin + width])
            begin += width
    rows[:, begin:] = raised[:, :2].T


def solve(jacobian: Array, target: Array) -> tuple[Array, Array]:
    """Least squares of every window by normal equations: coefficients and the inverse of J^T J."""
    normal = np.swapaxes(jacobian, 1, 2) @ jacobian
    scale = np.sqrt(np.einsum("wii->wi", normal))
    scale = np.where(scale > 0.0, scale, 1.0)
    equilibrated = normal / (scale[:, :, None] * scale[:, None, :])
    # A floor far below any resolved direction keeps a column that the data leave empty from being singular.
    inverse = np.linalg.inv(equilibrated + 1e-13 * np.eye(scale.shape[1]))
    inverse /= scale[:, :, None] * scale[:, None, :]
    moment = np.einsum("wnp,wn->wp", jacobian, target)
    return np.einsum("wpq,wq->wp", inverse, moment), inverse


def start(s: Array, x: Array, guide: Array, shape: Shape) -> tuple[Array, Array]:
    """Phase and amplitude polynomials from a guide phase, its constant set so that the sine part vanishes."""
    p = guide @ np.linalg.pinv(powers(s, shape.phase_degree)).T
    phase = p @ powers(s, shape.phase_degree).T
    columns = np.stack([np.cos(phase), np.sin(phase), np.ones_like(phase)], axis=2)
    even, odd, _ = solve(columns, x)[0].T
    p[:, 0] += np.arctan2(-odd, even)
    amplitude = np.zeros((x.shape[0], shape.amplitude_degree + 1))
    amplitude[:, 0] = np.hypot(even, odd)
    return p, amplitude


@dataclass(frozen=True)
class Solution:
    """Coefficients of all windows: phase ``p``, amplitude ``a`` times e^(``growth`` s), offset ``d``; covariances.

    The covariances are per unit ``variance``, that of the residual.
    """

    p: Array
    a: Array
    growth: Array
    d: Array
    p_covariance: Array
    a_covariance: Array
    variance: Array
    settled: Mask


@dataclass(frozen=True)
class Steps:
    """Where the fits of some windows stand after a step: one row a window."""

    p: Array
    a: Array
    growth: Array
    steeper: Array
    """What the growth still lacks."""
    last: Array
    """Radians that the step moved the phase by, weighted with the amplitude."""
    coefficients: Array
    inverse: Array
    variance: Array
    moving: Mask
    """Whether another step would change anything."""

    def some(self, rows: NDArray[np.intp]) -> Steps:
        """Those of some windows."""
        return Steps(*(getattr(self, name.name)[rows] for name in fields(self)))

    def changed(self, rows: NDArray[np.intp], to: Steps) -> Steps:
        """The same with those of some windows replaced."""
        values = [getattr(self, name.name).copy() for name in fields(self)]
        for name, value in zip(fields(self), values, strict=True):
            value[rows] = getattr(to, name.name)
        return Steps(*values)


def gauss_newton(
    s: Array, x: Array, guide: Array, shape: Shape, *, rest: float = AT_REST, begin: Solution | None = None
) -> Solution:
    """Fit every window ``x[window, n]`` from its guide phase; at most ITERATIONS steps, each half a radian at most.

    With ``begin``, of as many degrees, from its phase and amplitude.

    The steps of a window end when its last one is below ``rest``, or below UNSEEN_IN_A_WINDOW of what its noise leaves
    open; the residual then errs by its square.

    It has settled when the last step moved the phase by less than SETTLED radians, weighted with the amplitude: where a
    decay has sunk into the noise its phase goes on wandering.
    """
    at = first_steps(s, x, guide, shape, begin)
    for _ in range(ITERATIONS):
        live = np.flatnonzero(at.moving)
        if live.size == x.shape[0]:
            at = one_step(s, x, shape, at, rest)
        elif live.size:
            at = at.changed(live, one_step(s, x[live], shape, at.some(live), rest))
    first, width = shape.size - shape.phase_degree - 1, shape.amplitude_degree + 1
    return Solution(
        at.p,
        at.a,
        at.growth,
        at.coefficients[:, first - 2 : first],
        at.inverse[:, first:, first:],
        at.inverse[:, :width, :width],
        at.variance,
        at.last < SETTLED,
    )


def first_steps(s: Array, x: Array, guide: Array, shape: Shape, begin: Solution | None) -> Steps:
    """Where the fits start."""
    count, size, nothing = x.shape[0], shape.size, np.zeros(x.shape[0])
    p, a, growth = (*start(s, x, guide, shape), nothing) if begin is None else (begin.p, begin.a, begin.growth)
    everywhere = np.ones(count, dtype=np.bool_)
    none, inverse = np.zeros((count, size)), np.zeros((count, size, size))
    return Steps(p, a, growth, nothing, nothing, none, inverse, nothing, everywhere)


def one_step(s: Array, x: Array, shape: Shape, at: Steps, rest: float) -> Steps:
    """One step of Gauss and Newton in every window."""
    raised, linear = powers(s, max(1, shape.phase_degree, shape.amplitude_degree)), shape.size - shape.phase_degree - 1
    phase_powers, amplitude_powers = raised[:, : shape.phase_degree + 1], raised[:, : shape.amplitude_degree + 1]
    growth = np.clip(at.growth + at.steeper, -MOST_GROWTH, MOST_GROWTH)
    turn, grown = turning(at.p @ phase_powers.T), np.exp(np.multiply.outer(growth, s))
    rows = np.empty((x.shape[0], shape.size, s.size))
    fill_linear(rows[:, :linear], turn, grown, shape, raised)
    np.multiply(-((at.a @ amplitude_powers.T) * grown * turn.imag)[:, None], phase_powers.T, out=rows[:, linear:])
    jacobian = np.swapaxes(rows, 1, 2)
    coefficients, inverse = solve(jacobian, x)
    step, a = coefficients[:, linear:], coefficients[:, : shape.amplitude_degree + 1]
    moved, size = np.abs(step @ phase_powers.T), np.abs(a @ amplitude_powers.T) * grown
    largest = np.maximum(size.max(axis=1), np.finfo(float).tiny)
    last, steeper = (moved * size).max(axis=1) / largest, steepening(a)
    p = at.p + step * np.minimum(1.0, 0.5 / np.maximum(moved.max(axis=1), 1e-300))[:, None]
    squares = ((x - (jacobian @ coefficients[..., None])[..., 0]) ** 2).sum(axis=1)
    variance = squares / max(1, x.shape[1] - shape.size)
    seen = np.maximum(rest, UNSEEN_IN_A_WINDOW * left_open(variance, 1.0 / x.shape[1], largest))
    moving = np.maximum(last, np.abs(steeper)) >= seen
    return Steps(p, a, growth, steeper, last, coefficients, inverse, variance, moving)


def left_open(variance: ArrayLike, share: float, largest: ArrayLike) -> Array:
    """Radians of the phase of an amplitude that noise leaves open, by ``share`` parameters a sample.

    >>> float(left_open(0.04, 0.25, 2.0))
    0.05
    """
    return np.asarray(np.sqrt(np.asarray(variance) * share) / np.asarray(largest), dtype=np.float64)


def steepening(a: Array) -> Array:
    """What g lacks, a_1 / a_0, half at most in a step.

    >>> steepening(np.array([[2.0, 0.2, 0.0], [0.1, -3.0, 0.0]])).tolist()
    [0.1, -0.5]
    """
    if a.shape[1] < 2:
        return np.zeros(a.shape[0])
    return np.clip(a[:, 1] / np.where(a[:, 0] == 0.0, np.inf, a[:, 0]), -0.5, 0.5)
