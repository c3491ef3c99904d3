r"""Exact trigonometric polynomials in one phase.

With ``x = cos tau`` and ``S = sin tau`` every real trigonometric polynomial is ``c(x) + S s(x)`` for exactly one
pair of polynomials ``c, s``, because ``S**2 = 1 - x**2``.  The pair is the whole representation: it needs no complex
numbers, a signal even in time has ``s = 0``, and the operator of every perturbation equation is triangular in it:

    (d^2/dtau^2 + 1) x^m   =   (1 - m^2) x^m       + m (m-1) x^(m-2)
    (d^2/dtau^2 + 1) S x^m = S [(1 - (m+1)^2) x^m  + m (m-1) x^(m-2)]

The polynomials live in a ``Space``: rational coefficients (dense, FLINT ``fmpq_poly``), or coefficients that are
themselves polynomials in named parameters (sparse, FLINT ``fmpq_mpoly`` with ``x`` as first generator).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Protocol

from flint import Ordering as FlintOrdering
from flint import fmpq, fmpq_mpoly_ctx, fmpq_poly

Polynomial = Any
"""A FLINT polynomial: ``fmpq_poly`` or ``fmpq_mpoly``."""
Scalar = Any
"""What multiplies a power of x: ``fmpq``, or an ``fmpq_mpoly`` that is free of x."""


class Space(Protocol):
    """Where the polynomials in ``x = cos tau`` live."""

    names: tuple[str, ...]

    def constant(self, value: Scalar) -> Polynomial:
        """Return the constant polynomial."""

    def gen(self, name: str) -> Polynomial:
        """Return the polynomial of one named parameter."""

    def x(self) -> Polynomial:
        """Return the polynomial x."""

    def derivative(self, p: Polynomial) -> Polynomial:
        """Return dp/dx."""

    def coefficients(self, p: Polynomial) -> list[Scalar]:
        """Return the coefficients of x**0, x**1, ..."""

    def assemble(self, coefficients: Sequence[Scalar]) -> Polynomial:
        """Undo ``coefficients``."""


class Rationals:
    """Rational coefficients, dense in x.

    >>> Rationals().coefficients(Rationals().x() ** 2)
    [0, 0, 1]
    """

    names: tuple[str, ...] = ()
    zero = fmpq(0)

    def constant(self, value: Scalar) -> Polynomial:
        return fmpq_poly([value])

    def gen(self, name: str) -> Polynomial:
        raise KeyError(name)

    def x(self) -> Polynomial:
        return fmpq_poly([0, 1])

    def derivative(self, p: Polynomial) -> Polynomial:
        return p.derivative()

    def coefficients(self, p: Polynomial) -> list[Scalar]:
        return list(p.coeffs())

    def assemble(self, coefficients: Sequence[Scalar]) -> Polynomial:
        return fmpq_poly(list(coefficients))


class Parametric:
    """Coefficients polynomial in named parameters, sparse.

    >>> space = Parametric(("mu",))
    >>> space.derivative(space.x() ** 2 * space.gen("mu"))
    2*x*mu
    """

    def __init__(self, names: tuple[str, ...]) -> None:
        self.names = names
        # The letters of the context are positions, so that a parameter may itself be called x.
        self._context = fmpq_mpoly_ctx.get(("x", *names), FlintOrdering.lex)
        self.zero = self._context.constant(0)

    def constant(self, value: Scalar) -> Polynomial:
        return self._context.constant(value) if isinstance(value, int | fmpq) else value

    def gen(self, name: str) -> Polynomial:
        return self._context.gen(1 + self.names.index(name))

    def x(self) -> Polynomial:
        return self._context.gen(0)

    def derivative(self, p: Polynomial) -> Polynomial:
        return p.derivative(0)

    def coefficients(self, p: Polynomial) -> list[Scalar]:
        rows: dict[int, dict[tuple[int, ...], Any]] = {}
        for powers, value in p.to_dict().items():
            rows.setdefault(powers[0], {})[(0, *powers[1:])] = value
        top = max(rows, default=-1)
        return [self._context.from_dict(rows.get(m, {})) for m in range(top + 1)]

    def assemble(self, coefficients: Sequence[Scalar]) -> Polynomial:
        total, power = self.constant(0), self.constant(1)
        for coefficient in coefficients:
            total, power = total + coefficient * power, power * self.x()
        return total


@lru_cache(maxsize=64)
def space_for(names: tuple[str, ...]) -> Space:
    """Return the space for coefficients in the named parameters (none: plain rationals).

    >>> space_for(()).x()
    x
    """
    return Parametric(names) if names else Rationals()


@dataclass(frozen=True, slots=True, eq=False)
class Trig:
    """``c(x) + S s(x)`` with ``x = cos tau``, ``S = sin tau``: one exact trigonometric polynomial.

    >>> tau = space_for(())
    >>> x = Trig(tau, tau.x(), tau.constant(0))
    >>> x.derivative().derivative() == -x
    True
    """

    space: Space
    c: Polynomial
    s: Polynomial

    def __add__(self, other: Trig) -> Trig:
        return Trig(self.space, self.c + other.c, self.s + other.s)

    def __sub__(self, other: Trig) -> Trig:
        return Trig(self.space, self.c - other.c, self.s - other.s)

    def __neg__(self) -> Trig:
        return Trig(self.space, -self.c, -self.s)

    def __mul__(self, other: Trig) -> Trig:
        """Multiply, with S**2 = 1 - x**2; absent halves cost nothing."""
        c, s = self.c * other.c, self.c * other.s
        if self.s != 0:
            s = s + self.s * other.c
            if other.s != 0:
                product = self.s * other.s
                c = c + product - product * self.space.x() ** 2
        return Trig(self.space, c, s)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Trig) and bool(self.c == other.c and self.s == other.s)

    def __hash__(self) -> int:
        return hash((str(self.c), str(self.s)))

    def __bool__(self) -> bool:
        return bool(self.c != 0 or self.s != 0)

    def scale(self, factor: Scalar) -> Trig:
        """Multiply by a scalar (a rational, or a polynomial in the parameters)."""
        return Trig(self.space, self.c * factor, self.s * factor)

    def derivative(self) -> Trig:
        """d/dtau: c' -> -S c',  S s -> x s - (1 - x^2) s'."""
        x, ds = self.space.x(), self.space.derivative(self.s)
        return Trig(self.space, x * self.s - ds + ds * x * x, -self.space.derivative(self.c))


def constant(space: Space, value: Scalar) -> Trig:
    """Return a constant as a trigonometric polynomial.

    >>> bool(constant(space_for(()), 0))
    False
    """
    return Trig(space, space.constant(value), space.constant(0))


def cosine(space: Space) -> Trig:
    """Return cos tau.

    >>> cosine(space_for(())).c
    x
    """
    return Trig(space, space.x(), space.constant(0))


def sine(space: Space) -> Trig:
    """Return sin tau.

    >>> sine(space_for(())).derivative() == cosine(space_for(()))
    True
    """
    return Trig(space, space.constant(0), space.constant(1))


def solve_oscillator(right: Trig) -> tuple[Trig, Scalar, Scalar]:
    r"""Solve ``w'' + w = right`` exactly, apart from the resonant part of ``right``.

    Returns ``(w, p, q)`` where ``w`` has no ``x^1`` term in c and no ``x^0`` term in s, and ``p cos tau + q sin tau``
    is what remains of the right-hand side: the secular terms that the solvability condition must remove.

    >>> t = space_for(())
    >>> w, p, q = solve_oscillator(cosine(t) * cosine(t))   # cos^2 = 1/2 + cos(2 tau)/2
    >>> w.derivative().derivative() + w == cosine(t) * cosine(t), p, q
    (True, 0, 0)
    """
    space = right.space
    c, p = _back_substitute(space.coefficients(right.c), free=1)
    s, q = _back_substitute(space.coefficients(right.s), free=0)
    return Trig(space, space.assemble(c), space.assemble(s)), p, q


def _back_substitute(right: list[Scalar], *, free: int) -> tuple[list[Scalar], Scalar]:
    """Solve the triangular system of one half; ``free`` is the power whose diagonal vanishes."""
    shift = 1 - free  # diagonal 1 - (m + shift)^2, zero at m = free
    solution: list[Scalar] = [fmpq(0)] * len(right)
    remainder: Scalar = fmpq(0)
    for m in range(len(right) - 1, -1, -1):
        known = right[m]
        if m + 2 < len(right):
            known = known - solution[m + 2] * ((m + 2) * (m + 1))
        if m == free:
            remainder = known
        elif known != 0:
            solution[m] = known * fmpq(1, 1 - (m + shift) ** 2)
    return solution, remainder


def harmonic(p: Trig, multiple: int) -> tuple[Scalar, Scalar]:
    """Return the coefficients of ``cos(multiple tau)`` and ``sin(multiple tau)`` (the mean for 0).

    x^m = 2^(1-m) sum_j binom(m, j) cos((m - 2j) tau) (half of it for the mean), and
    S x^m = 2^(-m) sum_j [binom(m, j) - binom(m, j-1)] sin((m + 1 - 2j) tau).

    >>> x = cosine(space_for(()))
    >>> harmonic(x * x * x, 3)
    (1/4, 0)
    """
    cos_part: Scalar = fmpq(0)
    sin_part: Scalar = fmpq(0)
    for m, value in enumerate(p.space.coefficients(p.c)):
        if m >= multiple and (m - multiple) % 2 == 0 and value != 0:
            weight = fmpq(_binomial(m, (m - multiple) // 2), 2**m)
            cos_part = cos_part + value * (weight if multiple == 0 else 2 * weight)
    for m, value in enumerate(p.space.coefficients(p.s)):
        j = m + 1 - multiple
        if multiple > 0 and j >= 0 and j % 2 == 0 and value != 0:
            weight = fmpq(_binomial(m, j // 2) - _binomial(m, j // 2 - 1), 2**m)
            sin_part = sin_part + value * weight
    return cos_part, sin_part


def degree(p: Trig) -> int:
    """Return the highest harmonic present (0 for a constant).

    >>> degree(sine(space_for(())))
    1
    """
    return max(len(p.space.coefficients(p.c)) - 1, len(p.space.coefficients(p.s)), 0)


def at_zero(p: Trig) -> Scalar:
    """Return the value at tau = 0, where x = 1 and S = 0.

    >>> at_zero(cosine(space_for(())))
    1
    """
    total: Scalar = fmpq(0)
    for value in p.space.coefficients(p.c):
        total = total + value
    return total


def _binomial(n: int, k: int) -> int:
    return math.comb(n, k) if 0 <= k <= n else 0
