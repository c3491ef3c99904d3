"""Where the coefficients of a derivation live, and the polynomials in ``y`` over them, all by FLINT.

* ``Rationals``: exact rationals, dense ``fmpq_poly``.
* ``Parametric``: polynomials in named parameters, sparse ``fmpq_mpoly`` with ``y`` as first generator.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from operator import mul
from typing import Any, Protocol

from flint import Ordering, fmpq, fmpq_mpoly_ctx, fmpq_poly, fmpz

from ridgeback.symbolic.series.triangular import back_substitute, solve_rational

Polynomial = Any
"""A FLINT polynomial in y: ``fmpq_poly`` or ``fmpq_mpoly``."""
Scalar = Any
"""What multiplies a power of y: ``fmpq``, or an ``fmpq_mpoly`` that is free of y."""


Parts = tuple[Polynomial | None, Polynomial | None, Polynomial | None, Polynomial | None]
"""The four polynomials of a trigonometric polynomial; None stands for zero.  See ``fourier``."""


class Basis(Protocol):
    """Another meaning of the four polynomials than powers of cos tau, with its own rules; see ``harmonic_basis``."""

    def lowest(self, part: int) -> Parts:
        """Return 1, cos tau, sin tau or sin 2 tau by the index of its part."""

    def derivative(self, p: Parts) -> Parts:
        """Return d/dtau."""

    def dot(self, left: Sequence[Parts], right: Sequence[Parts]) -> Parts:
        """Return the sum of products."""

    def solve(self, right: Parts) -> tuple[Parts, Scalar, Scalar]:
        """Solve w'' + w = right; also return the resonant cosine and sine left over."""

    def harmonic(self, p: Parts, multiple: int) -> tuple[Scalar, Scalar]:
        """Return the coefficients of cos(multiple tau) and sin(multiple tau)."""

    def at_zero(self, p: Parts) -> Scalar:
        """Return the value at tau = 0."""

    def absent(self, p: Polynomial) -> bool:
        """Whether a part is zero at a glance."""


class Space(Protocol):
    """Polynomials in one variable y."""

    names: tuple[str, ...]
    basis: Basis | None
    """None: powers of cos tau, the exact spaces' own."""

    def constant(self, value: Scalar) -> Polynomial:
        """Return the constant polynomial."""

    def gen(self, name: str) -> Polynomial:
        """Return the polynomial of one named parameter."""

    def shift(self, p: Polynomial) -> Polynomial:
        """Return y p."""

    def derivative(self, p: Polynomial) -> Polynomial:
        """Return dp/dy."""

    def coefficients(self, p: Polynomial) -> list[Scalar]:
        """Return the coefficients of y**0, y**1, ..."""

    def assemble(self, coefficients: Sequence[Scalar]) -> Polynomial:
        """Undo ``coefficients``."""

    def at_one(self, p: Polynomial) -> Scalar:
        """Return the value at y = 1."""

    def length(self, p: Polynomial) -> int:
        """Return how many coefficients there are."""

    def paired(self, p: Polynomial, weights: Sequence[int], denominator: int) -> Scalar:
        """Return the sum of coefficients times weights, over a denominator."""

    def solve_part(self, p: Polynomial, *, odd: int, shift: int) -> tuple[Polynomial | None, Scalar]:
        """Solve the triangular system of one part; also return what is left at the resonance."""


class Rationals:
    """Rational coefficients, dense in y.

    >>> Rationals().coefficients(Rationals().shift(Rationals().constant(fmpq(3))))
    [0, 3]
    """

    names: tuple[str, ...] = ()
    basis: Basis | None = None

    def __init__(self, last: int | None = None) -> None:
        self.last = last

    def constant(self, value: Scalar) -> Polynomial:
        return fmpq_poly([value])

    def gen(self, name: str) -> Polynomial:
        raise KeyError(name)

    def shift(self, p: Polynomial) -> Polynomial:
        return p.left_shift(1)

    def derivative(self, p: Polynomial) -> Polynomial:
        return p.derivative()

    def coefficients(self, p: Polynomial) -> list[Scalar]:
        return list(p.coeffs())

    def assemble(self, coefficients: Sequence[Scalar]) -> Polynomial:
        return fmpq_poly(list(coefficients))

    def at_one(self, p: Polynomial) -> Scalar:
        return p(1)

    def length(self, p: Polynomial) -> int:
        return int(p.length())

    def paired(self, p: Polynomial, weights: Sequence[int], denominator: int) -> Scalar:
        return fmpq(sum(map(mul, p.numer().coeffs(), weights), fmpz(0)), p.denom() * denominator)

    def solve_part(self, p: Polynomial, *, odd: int, shift: int) -> tuple[Polynomial | None, Scalar]:
        return solve_rational(p, odd=odd, shift=shift)


class Parametric:
    """Coefficients polynomial in named parameters, sparse.

    >>> space = Parametric(("mu",))
    >>> space.derivative(space.shift(space.gen("mu")))
    mu
    """

    basis: Basis | None = None

    def __init__(self, names: tuple[str, ...]) -> None:
        self.names = names
        self._context = fmpq_mpoly_ctx.get(("y*", *names), Ordering.lex)  # no parameter can be called y*

    def constant(self, value: Scalar) -> Polynomial:
        return self._context.constant(value) if isinstance(value, int | fmpq) else value

    def gen(self, name: str) -> Polynomial:
        return self._context.gen(1 + self.names.index(name))

    def shift(self, p: Polynomial) -> Polynomial:
        return p * self._context.gen(0)

    def derivative(self, p: Polynomial) -> Polynomial:
        return p.derivative(0)

    def coefficients(self, p: Polynomial) -> list[Scalar]:
        rows: dict[int, dict[tuple[int, ...], Any]] = {}
        for powers, value in p.to_dict().items():
            rows.setdefault(int(powers[0]), {})[(0, *powers[1:])] = value
        top = max(rows, default=-1)
        return [self._context.from_dict(rows.get(m, {})) for m in range(top + 1)]

    def assemble(self, coefficients: Sequence[Scalar]) -> Polynomial:
        total: dict[tuple[int, ...], Any] = {}
        for m, coefficient in enumerate(coefficients):
            for powers, value in self.constant(coefficient).to_dict().items():
                total[(m, *powers[1:])] = value
        return self._context.from_dict(total)

    def at_one(self, p: Polynomial) -> Scalar:
        return sum(self.coefficients(p), fmpq(0))

    def length(self, p: Polynomial) -> int:
        return len(self.coefficients(p))

    def paired(self, p: Polynomial, weights: Sequence[int], denominator: int) -> Scalar:
        return _paired(self, p, weights, denominator)

    def solve_part(self, p: Polynomial, *, odd: int, shift: int) -> tuple[Polynomial | None, Scalar]:
        return _solved(self, p, odd=odd, shift=shift)


def _paired(space: Space, p: Polynomial, weights: Sequence[int], denominator: int) -> Scalar:
    """Pair coefficient by coefficient."""
    return sum((c * fmpq(w, denominator) for c, w in zip(space.coefficients(p), weights, strict=True)), fmpq(0))


def _solved(space: Space, p: Polynomial, *, odd: int, shift: int) -> tuple[Polynomial | None, Scalar]:
    """Solve coefficient by coefficient."""
    found, left = back_substitute(space.coefficients(p), odd=odd, shift=shift)
    return space.assemble(found) if any(value != 0 for value in found) else None, left


def is_zero(value: Scalar) -> bool:
    """Whether a scalar is zero; of a ball, whether it is certainly zero (``!= 0`` would mean certainly not).

    >>> from flint import arb
    >>> is_zero(fmpq(0)), is_zero(arb(0)), is_zero(arb(0, 1))
    (True, True, False)
    """
    return bool(value == 0)


@lru_cache(maxsize=64)
def space_for(names: tuple[str, ...], last: int | None = None) -> Space:
    """Return the exact space for coefficients in the named parameters.

    Parameters
    ----------
    names : tuple of str
        The parameters left symbolic; none for plain rationals.
    last : int, optional
        The highest order of the series whose coefficients these are, where it is known: sums of products over the
        rationals are then taken in blocks of orders.

    Returns
    -------
    Space
        The coefficients' space.

    Examples
    --------
    >>> space_for(("mu",)).names
    ('mu',)
    """
    return Parametric(names) if names else Rationals(last)
