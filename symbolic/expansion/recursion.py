"""What the two Lindstedt-Poincaré expansions share: the orders found so far, normalisation, and the residual.

Notation as in ``lindstedt``: time is rescaled to tau = omega t, ' = d/dtau, omega^2 = sum X^n w_n.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import sympy
from flint import fmpq

from ridgeback.common.recurrences import Element
from ridgeback.symbolic.arithmetic.expression_series import Program
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.grammar.parse import U, V
from ridgeback.symbolic.series.online_sums import weighted_sums
from ridgeback.symbolic.series.ring import TrigRing
from ridgeback.symbolic.series.spaces import Scalar, Space, is_zero
from ridgeback.symbolic.series.trigonometric import Trig, at_zero, cosine, harmonic, sine


class Recursion:
    """The orders found so far: u, its tau-derivatives, omega^2 and omega, and the force program that follows them."""

    def __init__(self, program: Program, start: list[Trig], space: Space) -> None:
        self.program, self.space = program, space
        self.u = list(start)
        self.slope = [p.derivative() for p in start]
        self.curve = [p.derivative() for p in self.slope]
        self.squared: list[Scalar] = [fmpq(1)]
        self.later: list[Scalar] = []
        """omega^2 without its first coefficient, which is 1."""
        self.omega: list[Scalar] = [fmpq(1)]
        self._inertia = weighted_sums(space, self.later, self.curve)
        self._velocity = weighted_sums(space, self.omega, self.slope)

    def inertia(self, n: int, last: int) -> Trig:
        """Sum of w_j u''_(n-j) over 1 <= j <= last; u''_(n-1) may be provisional, orders below it are final."""
        found: Trig = self._inertia(n - 1, 0, last - 1)
        return found

    def velocity(self, n: int, first: int, last: int) -> Trig:
        """Sum of omega_j du_(n-j)/dtau over first <= j <= last."""
        found: Trig = self._velocity(n, first, last)
        return found

    def extend_omega(self, w: Scalar) -> None:
        """Append omega^2's next coefficient and omega's: 2 omega_n = w_n - sum of omega_j omega_(n-j)."""
        n = len(self.squared)
        low = ((j, c) for j, c in enumerate(self.omega[1 : (n + 1) // 2], 1) if not is_zero(c))
        half: Scalar = sum((c * self.omega[n - j] for j, c in low), fmpq(0))
        inner = 2 * half if n % 2 else 2 * half + self.omega[n // 2] * self.omega[n // 2]
        self.squared.append(w)
        self.later.append(w)
        self.omega.append((w - inner) * fmpq(1, 2))

    def append(self, p: Trig) -> None:
        self.u.append(p)
        self.slope.append(p.derivative())
        self.curve.append(self.slope[-1].derivative())


BetweenOrders: TypeAlias = Callable[[Recursion, int], None]
"""Called before each order, with the recursion and the order about to be found."""


def no_watch(recursion: Recursion, order: int) -> None:
    """Do nothing between two orders."""


def normalise(p: Trig, amplitude: str, *, size: bool) -> Trig:
    """Add the homogeneous solution that the amplitude definition asks for (its cosine only if ``size``)."""
    space = p.space
    if amplitude == "peak":
        alpha, beta = -at_zero(p), -at_zero(p.derivative())
    else:
        alpha, beta = (-value for value in harmonic(p, 1))
    result = p + sine(space).scale(beta)
    return result + cosine(space).scale(alpha) if size else result


def compiled(
    expression: sympy.Expr, names: tuple[str, ...], start: Trig, fixed: dict[sympy.Symbol, list[Element]] | None = None
) -> Program:
    """Compile an expression in u, u' over the trigonometric polynomials, starting from u_0."""
    ring = TrigRing(start.space)
    parameters = {sympy.Symbol(name, real=True): [ring.parameter(name)] for name in names}
    inputs = {U: [start], V: [start.derivative()]}
    return Program(expression, ring, inputs, U, V, fixed={**parameters, **(fixed or {})})


def residual(expansion: Expansion, force: sympy.Expr, fixed: dict[sympy.Symbol, list[Element]]) -> list[int]:
    """Substitute u and omega into omega^2 u'' + f(u, omega u') again; return the orders that do not cancel.

    The force is evaluated with complete coefficients from the start, not the provisional ones of the recursion.
    """
    assert expansion.waveform is not None  # noqa: S101 - only what has one is given this residual
    u, omega = list(expansion.waveform), list(expansion.coefficients)
    last = len(u) - 1
    omega += [fmpq(0)] * (last + 1 - len(omega))  # omega_last multiplies u_0 only, which is zero then
    velocity = _apply(omega, [p.derivative() for p in u])
    program = compiled(force, expansion.names, u[0], fixed)
    for p, v in zip(u[1:], velocity[1:], strict=True):
        program.supply(U, p)
        program.supply(V, v)
    acceleration = _apply(omega, [p.derivative() for p in velocity])
    total = [acceleration[n] + program.root.get(n) for n in range(last + 1)]
    return [n for n, p in enumerate(total) if p]


def _apply(omega: list[Scalar], series: list[Trig]) -> list[Trig]:
    """Multiply a series of trigonometric polynomials by a scalar series of the same length."""
    zero = series[0].scale(fmpq(0))
    result = []
    for n in range(len(series)):
        total = zero
        for j in range(n + 1):
            if omega[j] != 0:
                total = total + series[n - j].scale(omega[j])
        result.append(total)
    return result
