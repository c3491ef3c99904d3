"""The least-squares problems of fitting an oscillator: to the polar angle and radius of its motion, and to the samples.

The samples have false minima, one for each turn that the phase at the end may be off.  The angle of the motion in the
plane (u, -u'/w), unwrapped, and the logarithm of its radius have none: fitted first, to those of the smoothed samples,
they bring every parameter so near that the samples themselves can be fitted over the whole record at once.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.harmonics.harmonic_signal import HarmonicSignal
from ridgeback.numeric.model_fit.family import Family
from ridgeback.numeric.model_fit.sensitivity import Response, respond

OFFSET = 2
"""Place of the offset in theta = (u0, v0, d, p)."""
EVALUATIONS = 60
FAR = 10.0
"""Polar error that a solution which escapes is given at the samples that it does not reach."""
ROOM = 1.3
"""A start whose motion swings further than this many times what was measured is made smaller."""

Loss = Literal["linear", "soft_l1"]
Both = Callable[[Array], tuple[Array, Array]]


@dataclass(frozen=True)
class Polar:
    """Angle and log-radius of a motion about ``level`` in the plane (u, -u'/w), and weights for both."""

    level: float
    w: float
    angle: Array
    radius: Array
    weight: Array


def polar_of(signal: HarmonicSignal, level: float) -> Polar:
    """Polar form of the smoothed samples; weights fall with the radius, as the noise of angles grows.

    >>> t = np.arange(100) / 10.0
    >>> one, none = np.ones((1, 100)), np.zeros((1, 100))
    >>> found = polar_of(HarmonicSignal(10.0, 2.0 * t, np.full(100, 2.0), (1,), one, none, none[0]), 0.0)
    >>> bool(np.allclose(found.angle, 2 * t, atol=1e-9)), bool(np.allclose(found.radius, 0.0, atol=1e-9))
    (True, True)
    """
    w = float(np.median(signal.omega))
    u, v = signal.values() - level, signal.rate_of_change().values() / w
    square = u * u + v * v
    tiny = np.finfo(float).tiny
    return Polar(
        level,
        w,
        np.unwrap(np.arctan2(-v, u)),
        0.5 * np.log(np.maximum(square, tiny)),
        np.sqrt(square / max(float(square.max()), tiny)),
    )


@dataclass(frozen=True)
class Problem:
    """The samples and the family, how finely the equation is stepped, and limits of theta."""

    x: Array
    rate: float
    family: Family
    free_offset: bool
    bound: float
    """Magnitude of u at which a solution counts as escaped."""
    steps: int
    limits: tuple[Array, Array]

    @property
    def kept(self) -> NDArray[np.intp]:
        """Places of the entries of theta that are fitted."""
        size = OFFSET + 1 + len(self.family.names)
        return np.array([i for i in range(size) if self.free_offset or i != OFFSET])

    @property
    def labels(self) -> tuple[str, ...]:
        """Names of what is fitted."""
        names = ("u0", "v0", "offset", *self.family.names)
        return tuple(names[i] for i in self.kept)

    def run(self, theta: Array, n: int) -> Response:
        """The solution over the first ``n`` samples."""
        u0, v0, _, *p = theta.tolist()
        return respond(self.family, p, (u0, v0), samples=n, rate=self.rate, steps=self.steps, bound=self.bound)

    def gap(self, theta: Array, n: int) -> tuple[Array, Array]:
        """Model less samples over the first ``n``, and its Jacobian; a solution that escapes counts as far away."""
        run = self.run(theta, n)
        gap, jacobian = np.full(n, self.bound), np.zeros((n, theta.size))
        gap[: run.length] = run.u + theta[OFFSET] - self.x[: run.length]
        jacobian[: run.length] = np.insert(run.u_by, OFFSET, 1.0, axis=1)
        return gap, jacobian

    # psi = atan2(-v/w, u): d psi = (v du - u dv) / (w r^2);  rho = log r: d rho = (u du + v dv / w^2) / r^2.
    def polar_gap(self, theta: Array, goal: Polar) -> tuple[Array, Array]:
        """Weighted differences in angle and log-radius, and their Jacobian."""
        run = self.run(theta, self.x.size)
        n, size = run.length, self.x.size
        u, v = run.u + theta[OFFSET] - goal.level, run.v / goal.w
        by_u, by_v = np.insert(run.u_by, OFFSET, 1.0, axis=1), np.insert(run.v_by, OFFSET, 0.0, axis=1) / goal.w
        square = np.maximum(u * u + v * v, np.finfo(float).tiny)
        angle = np.unwrap(np.arctan2(-v, u))
        angle += 2.0 * np.pi * np.round((goal.angle[0] - angle[0]) / (2.0 * np.pi))
        gap, jacobian = np.full((2, size), FAR), np.zeros((2, size, theta.size))
        gap[0, :n], gap[1, :n] = angle - goal.angle[:n], 0.5 * np.log(square) - goal.radius[:n]
        jacobian[0, :n] = (v[:, None] * by_u - u[:, None] * by_v) / square[:, None]
        jacobian[1, :n] = (u[:, None] * by_u + v[:, None] * by_v) / square[:, None]
        return (gap * goal.weight).ravel(), (jacobian * goal.weight[:, None]).reshape(2 * size, -1)

    def contained(self, theta: Array, goal: Polar) -> Array:
        """Make the initial state smaller until the motion does not swing much further than what was measured."""
        theta, most = theta.copy(), ROOM * float(np.exp(goal.radius.max()))
        for _ in range(40):
            run = self.run(theta, self.x.size)
            reached = run.length == self.x.size
            if reached and float(np.hypot(run.u + theta[OFFSET] - goal.level, run.v / goal.w).max()) <= most:
                return theta
            theta[:OFFSET] *= 0.95
        return theta

    def solve(self, both: Both, theta: Array, *, tolerance: float, loss: Loss = "linear") -> Array:
        """Least squares from ``theta`` within the limits; ``both`` gives residual and Jacobian."""
        kept, seen = self.kept, _Memory(both, theta, self.kept)
        low, high = (limit[kept] for limit in self.limits)
        found = least_squares(
            seen.residual,
            np.clip(theta[kept], low, high),
            jac=seen.jacobian,
            bounds=(low, high),
            x_scale="jac",
            loss=loss,
            ftol=tolerance,
            xtol=tolerance,
            gtol=tolerance,
            max_nfev=EVALUATIONS,
        )
        return seen.full(found.x)


class _Memory:
    """Residual and Jacobian come from one integration; the solver asks for them one after the other."""

    def __init__(self, both: Both, theta: Array, kept: NDArray[np.intp]) -> None:
        self.both, self.theta, self.kept = both, theta, kept
        self.at: bytes | None = None
        self.values: tuple[Array, Array] | None = None

    def full(self, x: Array) -> Array:
        """Theta with its fitted entries replaced."""
        theta = self.theta.copy()
        theta[self.kept] = x
        return theta

    def evaluated(self, x: Array) -> tuple[Array, Array]:
        """Both at ``x``, from memory when it was asked last."""
        if self.values is None or self.at != x.tobytes():
            gap, jacobian = self.both(self.full(x))
            self.at, self.values = x.tobytes(), (gap, jacobian[:, self.kept])
        return self.values

    def residual(self, x: Array) -> Array:
        """The residual alone."""
        return self.evaluated(x)[0]

    def jacobian(self, x: Array) -> Array:
        """The Jacobian alone."""
        return self.evaluated(x)[1]


def inverse_normal(jacobian: Array, names: tuple[str, ...]) -> Array:
    """(J^T J)^-1 by the singular values of the scaled Jacobian; InputError names what the samples do not determine.

    >>> inverse_normal(np.array([[2.0, 0.0], [0.0, 1.0]]), ("a", "b")).tolist()
    [[0.25, 0.0], [0.0, 1.0]]
    """
    scale = np.linalg.norm(jacobian, axis=0)
    if not np.all(scale > 0.0):
        raise InputError(f"{names[int(np.argmin(scale))]} has no effect on the samples; do not free it")
    _, singular, right = np.linalg.svd(jacobian / scale, full_matrices=False)
    if not singular[-1] > 1e-9 * singular[0]:
        mixed = [name for name, part in zip(names, right[-1], strict=True) if abs(part) > 0.2]
        raise InputError(f"the samples do not tell {' from '.join(mixed)}; free fewer of them")
    root = right / singular[:, None] / scale
    return np.asarray(root.T @ root)
