r"""Trigonometric polynomials in balls, by their harmonics.

Powers of cos tau are exact but badly conditioned: about 1.27 bits are lost per harmonic.  Balls therefore hold

    sum c_k cos 2k tau + sum c_k cos (2k+1) tau + sum s_k sin (2k+1) tau + sum s_k sin (2k+2) tau

as the four parts of a ``Trig``, in this order, each an ``arb_poly`` in the place of a polynomial in y.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from flint import arb, arb_poly, fmpq

from ridgeback.symbolic.series.laurent import products
from ridgeback.symbolic.series.spaces import Basis, Parts, Scalar

EMPTY: Final[Parts] = (None, None, None, None)


class Harmonics:
    """The rules of this basis, as ``spaces.Basis`` wants them.

    >>> basis = Harmonics()
    >>> basis.derivative(basis.lowest(1))[2][0]
    -1.00000000000000
    """

    def lowest(self, part: int) -> Parts:
        a, b, c, d = (arb_poly([1]) if part == i else None for i in range(4))
        return a, b, c, d

    def derivative(self, p: Parts) -> Parts:
        even, odd, sine_odd, sine_even = (None if q is None else q.coeffs() for q in p)
        return (
            None if sine_even is None else arb_poly([0, *(x * (2 * k + 2) for k, x in enumerate(sine_even))]),
            None if sine_odd is None else arb_poly([x * (2 * k + 1) for k, x in enumerate(sine_odd)]),
            None if odd is None else arb_poly([x * -(2 * k + 1) for k, x in enumerate(odd)]),
            None if even is None else arb_poly([x * (-2 * k) for k, x in enumerate(even)][1:]),
        )

    def dot(self, left: Sequence[Parts], right: Sequence[Parts]) -> Parts:
        total = EMPTY
        for x, y in zip(left, right, strict=True):
            total = plus(total, products([x], [y])[0])
        return total

    def solve(self, right: Parts) -> tuple[Parts, Scalar, Scalar]:
        """Divide every harmonic m by 1 - m^2 but the first."""
        a, b, c, d = (None if p is None else _divided(p, (part & 1) + (part >> 1)) for part, p in enumerate(right))
        return (a, b, c, d), _entry(right[1], 0), _entry(right[2], 0)

    def harmonic(self, p: Parts, multiple: int) -> tuple[Scalar, Scalar]:
        cosine, sine = p[multiple % 2], p[2 + 1 - multiple % 2]
        return _entry(cosine, multiple // 2), _entry(sine, (multiple - 1) // 2)

    def at_zero(self, p: Parts) -> Scalar:
        return sum((x for q in p[:2] if q is not None for x in q.coeffs()), fmpq(0))

    def absent(self, p: arb_poly) -> bool:
        return bool(p.length() == 0)


def _divided(p: arb_poly, lowest: int) -> arb_poly | None:
    """Divide the coefficient of harmonic m = lowest, lowest + 2, ... by 1 - m^2, and leave out harmonic 1."""
    values = [arb(0) if (m := 2 * k + lowest) == 1 else x / (1 - m**2) for k, x in enumerate(p.coeffs())]
    quotient = arb_poly(values)
    return quotient if quotient.length() else None


def plus(p: Parts, q: Parts) -> Parts:
    """Return the sum.

    >>> plus(EMPTY, EMPTY) == EMPTY
    True
    """
    a, b, c, d = (y if x is None else x if y is None else x + y for x, y in zip(p, q, strict=True))
    return a, b, c, d


def _entry(p: arb_poly | None, k: int) -> Scalar:
    return p[k] if p is not None and 0 <= k < p.length() else fmpq(0)


class Balls:
    """Ball coefficients at FLINT's working precision, by harmonics.

    ``last`` is the highest order that will be asked for, so that no product is taken beyond it.

    >>> Balls(4).coefficients(Balls(4).constant(fmpq(1, 2)))
    [0.500000000000000]
    """

    names: tuple[str, ...] = ()

    def __init__(self, last: int) -> None:
        self.last = last
        self.basis: Basis | None = Harmonics()

    def constant(self, value: Scalar) -> arb_poly:
        return arb_poly([arb(value)])

    def gen(self, name: str) -> arb_poly:
        raise KeyError(name)

    def coefficients(self, p: arb_poly) -> list[Scalar]:
        return list(p.coeffs())

    def assemble(self, coefficients: Sequence[Scalar]) -> arb_poly:
        return arb_poly(list(coefficients))

    def shift(self, p: arb_poly) -> arb_poly:
        raise TypeError(f"a polynomial with {p.length()} harmonics has no powers of y; use the basis's own rules")

    def derivative(self, p: arb_poly) -> arb_poly:
        raise TypeError(f"a polynomial with {p.length()} harmonics has no powers of y; use the basis's own rules")

    def at_one(self, p: arb_poly) -> arb:
        return p(arb(1))

    def length(self, p: arb_poly) -> int:
        return int(p.length())

    def paired(self, p: arb_poly, weights: Sequence[int], denominator: int) -> Scalar:
        raise TypeError(f"{p.length()} harmonics, {len(weights)}, {denominator}: the basis has its own rules")

    def solve_part(self, p: arb_poly, *, odd: int, shift: int) -> tuple[arb_poly | None, Scalar]:
        raise TypeError(f"{p.length()} harmonics, {odd}, {shift}: the basis has its own rules")
