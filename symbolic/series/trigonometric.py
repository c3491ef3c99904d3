r"""Exact trigonometric polynomials in one phase.

With ``x = cos tau``, ``y = x^2`` and ``S = sin tau`` every real trigonometric polynomial is

    p_0(y) + x p_1(y) + S p_2(y) + S x p_3(y)

for exactly one quadruple of polynomials, because ``S^2 = 1 - y``.  The quadruple is the whole representation.  It
needs no complex numbers; a signal even in time has no p_2, p_3; one with odd harmonics only has no p_0 and p_3; and
what a symmetry removes costs nothing.  The operator of every perturbation equation is triangular in it:

    (d^2/dtau^2 + 1) x^m   =   (1 - m^2) x^m       + m (m-1) x^(m-2)
    (d^2/dtau^2 + 1) S x^m = S [(1 - (m+1)^2) x^m  + m (m-1) x^(m-2)]

(solved in ``triangular``).

The polynomials live in a ``Space`` (see ``spaces``), which decides what the coefficients are.  A space may bring a
``basis`` of its own, which gives the four polynomials another meaning (harmonics, for balls) and its own rules.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from flint import fmpq

from ridgeback.symbolic.series.spaces import Parts, Polynomial, Scalar, Space

NOTHING: Parts = (None, None, None, None)
"""p_0 ... p_3; None stands for zero.  Index = 2 * (sine) + (odd power of x)."""


@dataclass(frozen=True, slots=True, eq=False)
class Trig:
    """One exact trigonometric polynomial.

    >>> from ridgeback.symbolic.series.spaces import space_for
    >>> x = cosine(space_for(()))
    >>> x.derivative().derivative() == -x
    True
    """

    space: Space
    parts: Parts

    def __add__(self, other: Trig) -> Trig:
        p, q = self.parts, other.parts
        if q == NOTHING:
            return self
        return Trig(
            self.space,
            (_plus(p[0], q[0]), _plus(p[1], q[1]), _plus(p[2], q[2]), _plus(p[3], q[3])),
        )

    def __sub__(self, other: Trig) -> Trig:
        return self + -other

    def __neg__(self) -> Trig:
        return self.map(lambda p: -p)

    def __mul__(self, other: Trig) -> Trig:
        return dot(self.space, [self], [other])

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Trig) and not self - other

    def __hash__(self) -> int:
        return hash(tuple(str(p) for p in self.parts))

    def __bool__(self) -> bool:
        if self.space.basis is not None:
            absent = self.space.basis.absent
            return any(p is not None and not absent(p) for p in self.parts)
        return self.parts != NOTHING and any(p is not None and p != 0 for p in self.parts)

    def map(self, change: Callable[[Polynomial], Polynomial]) -> Trig:
        """Apply a linear map to each part that is there."""
        a, b, c, d = (None if p is None else change(p) for p in self.parts)
        return Trig(self.space, (a, b, c, d))

    def scale(self, factor: Scalar) -> Trig:
        """Multiply by a scalar (a rational, or a polynomial in the parameters)."""
        return self.map(lambda p: p * factor)

    def derivative(self) -> Trig:
        r"""d/dtau, with D = d/dy.

        p_0 -> -2 S x D p_0,   x p_1 -> -S (p_1 + 2 y D p_1),
        S p_2 -> x (p_2 - 2 (1 - y) D p_2),   S x p_3 -> y p_3 - (1 - y)(p_3 + 2 y D p_3).
        """
        if self.space.basis is not None:
            return Trig(self.space, self.space.basis.derivative(self.parts))
        shift, d = self.space.shift, self.space.derivative
        p0, p1, p2, p3 = self.parts
        even = odd = sine_even = sine_odd = None
        if p0 is not None:
            sine_odd = d(p0) * -2
        if p1 is not None:
            sine_even = -(p1 + shift(d(p1)) * 2)
        if p2 is not None:
            odd = p2 + (shift(d(p2)) - d(p2)) * 2
        if p3 is not None:
            inner = p3 + shift(d(p3)) * 2
            even = shift(p3) - inner + shift(inner)
        return Trig(self.space, (even, odd, sine_even, sine_odd))

    def coefficients(self, part: int) -> list[Scalar]:
        """Coefficients of y**0, y**1, ... of one part."""
        p = self.parts[part]
        return [] if p is None else self.space.coefficients(p)


def dot(space: Space, left: list[Trig], right: list[Trig]) -> Trig:
    """Return the sum of products of two lists of trigonometric polynomials.

    Part by part: odd times odd gives a factor y, sine times sine a factor 1 - y; both are applied once to the sums.

    Parameters
    ----------
    space : Space
        What the coefficients are.
    left, right : list of Trig
        Of one length.

    Returns
    -------
    Trig
        The sum.

    Examples
    --------
    >>> from ridgeback.symbolic.series.spaces import space_for
    >>> c, s = cosine(space_for(())), sine(space_for(()))
    >>> dot(c.space, [c, s], [c, s]) == constant(c.space, fmpq(1))
    True
    """
    if space.basis is not None:
        return Trig(space, space.basis.dot([x.parts for x in left], [y.parts for y in right]))
    sums: dict[tuple[int, int], Polynomial] = {}
    for x, y in zip(left, right, strict=True):
        for i, p in enumerate(x.parts):
            if p is not None:
                for j, q in enumerate(y.parts):
                    if q is not None:
                        key = (i ^ j, i & j)
                        sums[key] = sums[key] + p * q if key in sums else p * q
    result: list[Polynomial | None] = [None, None, None, None]
    for (part, shared), total in sums.items():
        product = space.shift(total) if shared & 1 else total
        result[part] = _plus(result[part], product - space.shift(product) if shared & 2 else product)
    return Trig(space, (result[0], result[1], result[2], result[3]))


def _plus(p: Polynomial | None, q: Polynomial | None) -> Polynomial | None:
    if p is None:
        return q
    return p if q is None else p + q


def constant(space: Space, value: Scalar) -> Trig:
    """Return a constant as a trigonometric polynomial.

    >>> from ridgeback.symbolic.series.spaces import space_for
    >>> bool(constant(space_for(()), fmpq(0)))
    False
    """
    return Trig(space, NOTHING if value == 0 else (space.constant(value), None, None, None))


def cosine(space: Space) -> Trig:
    """Return cos tau.

    >>> from ridgeback.symbolic.series.spaces import space_for
    >>> cosine(space_for(())).coefficients(1)
    [1]
    """
    if space.basis is not None:
        return Trig(space, space.basis.lowest(1))
    return Trig(space, (None, space.constant(fmpq(1)), None, None))


def sine(space: Space) -> Trig:
    """Return sin tau.

    >>> from ridgeback.symbolic.series.spaces import space_for
    >>> sine(space_for(())).derivative() == cosine(space_for(()))
    True
    """
    if space.basis is not None:
        return Trig(space, space.basis.lowest(2))
    return Trig(space, (None, None, space.constant(fmpq(1)), None))


def solve_oscillator(right: Trig) -> tuple[Trig, Scalar, Scalar]:
    r"""Solve ``w'' + w = right`` exactly, apart from the resonant part of ``right``.

    Parameters
    ----------
    right : Trig
        The right-hand side.

    Returns
    -------
    w : Trig
        A solution with neither x nor S by themselves.
    p, q : Scalar
        ``p cos tau + q sin tau`` is what remains of the right-hand side: the secular terms that the solvability
        condition must remove.

    Examples
    --------
    >>> from ridgeback.symbolic.series.spaces import space_for
    >>> t = space_for(())
    >>> w, p, q = solve_oscillator(cosine(t) * cosine(t))   # cos^2 = 1/2 + cos(2 tau)/2
    >>> w.derivative().derivative() + w == cosine(t) * cosine(t), p, q
    (True, 0, 0)
    """
    space = right.space
    if space.basis is not None:
        parts, p, q = space.basis.solve(right.parts)
        return Trig(space, parts), p, q
    solutions: list[Polynomial | None] = []
    resonant: list[Scalar] = [fmpq(0), fmpq(0)]
    for part, p in enumerate(right.parts):
        if p is None:
            solutions.append(None)
            continue
        solution, left = space.solve_part(p, odd=part & 1, shift=part >> 1)
        solutions.append(solution)
        if part in (1, 2):
            resonant[part - 1] = left
    return Trig(space, (solutions[0], solutions[1], solutions[2], solutions[3])), resonant[0], resonant[1]


def harmonic(p: Trig, multiple: int) -> tuple[Scalar, Scalar]:
    """Return one harmonic of a trigonometric polynomial.

    x^m = 2^(1-m) sum_j binom(m, j) cos((m - 2j) tau) (half of it for the mean), and
    S x^m = 2^(-m) sum_j [binom(m, j) - binom(m, j-1)] sin((m + 1 - 2j) tau).

    Parameters
    ----------
    p : Trig
        The polynomial.
    multiple : int
        Which harmonic; 0 for the mean.

    Returns
    -------
    tuple of two Scalar
        The coefficients of ``cos(multiple tau)`` and ``sin(multiple tau)``.

    Examples
    --------
    >>> from ridgeback.symbolic.series.spaces import space_for
    >>> x = cosine(space_for(()))
    >>> harmonic(x * x * x, 3)
    (1/4, 0)
    """
    if p.space.basis is not None:
        return p.space.basis.harmonic(p.parts, multiple)
    parity = multiple % 2
    cos_part = _paired(p, parity, lambda m: _binomial(m, (m - multiple) // 2) * (2 if multiple else 1))
    sin_part = _paired(p, 3 - parity, lambda m: _ballot(m, (m + 1 - multiple) // 2)) if multiple else fmpq(0)
    return cos_part, sin_part


def _paired(p: Trig, part: int, weight: Callable[[int], int]) -> Scalar:
    """Sum of the coefficients at x^m, each times weight(m) / 2^m."""
    q = p.parts[part]
    if q is None:
        return fmpq(0)
    powers = range(part & 1, 2 * p.space.length(q), 2)
    top = powers[-1] if powers else 0
    return p.space.paired(q, [weight(m) << (top - m) for m in powers], 2**top)


def degree(p: Trig) -> int:
    """Return the highest harmonic present (0 for a constant).

    >>> from ridgeback.symbolic.series.spaces import space_for
    >>> degree(sine(space_for(())))
    1
    """
    tops = [2 * len(p.coefficients(part)) - 2 + (part & 1) + (part >> 1) for part in range(4) if p.coefficients(part)]
    return max(tops, default=0)


def at_zero(p: Trig) -> Scalar:
    """Return the value at tau = 0, where x = 1 and S = 0.

    >>> from ridgeback.symbolic.series.spaces import space_for
    >>> at_zero(cosine(space_for(())))
    1
    """
    if p.space.basis is not None:
        return p.space.basis.at_zero(p.parts)
    return sum((p.space.at_one(q) for q in p.parts[:2] if q is not None), fmpq(0))


def _binomial(n: int, k: int) -> int:
    return math.comb(n, k) if 0 <= k <= n else 0


def _ballot(n: int, k: int) -> int:
    return _binomial(n, k) - _binomial(n, k - 1)
