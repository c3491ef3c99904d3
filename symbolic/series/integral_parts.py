r"""Sums of products of rational trigonometric polynomials through integers, in lowest terms once at the end.

A part p(y) is N(y)/d with integers N, so that

    sum of p_j q_j = (1/L) sum of (L / (d_j e_j)) N_j M_j,      L = lcm of all d_j e_j.

Adding fractions one by one would take a greatest common divisor of every coefficient every time.  Blocks of consecutive
orders are multiplied at once (``block_products``).
"""

from __future__ import annotations

from collections.abc import Sequence
from operator import itemgetter
from typing import Final, TypeAlias

from flint import fmpq, fmpq_poly, fmpz, fmpz_poly

from ridgeback.symbolic.series.spaces import Parts

Integral: TypeAlias = tuple[fmpz_poly, fmpz]
"""Numerator and denominator of a part."""
Row: TypeAlias = tuple[tuple[int, fmpz_poly, fmpz], ...]
"""The parts of one order that are not zero: index, numerator and denominator of each."""
Terms: TypeAlias = dict[tuple[int, int], list[Integral]]
"""What is to be added up, by the part it belongs to and the factors (y: 1, 1 - y: 2) that its two parts share."""

ONE: Final = fmpz(1)


def integral(parts: Parts) -> Row:
    """Return the parts as integers over denominators.

    >>> integral((fmpq_poly([fmpq(1, 2), 1]), fmpq_poly([]), None, None))
    ((0, 2*x + 1, 2),)
    """
    return tuple((i, p.numer(), p.denom()) for i, p in enumerate(parts) if p is not None and not p.is_zero())


def integral_scalar(value: fmpq) -> Row:
    """Return a rational number as a row.

    >>> integral_scalar(fmpq(2, 3)), integral_scalar(fmpq(0))
    (((0, 2, 3),), ())
    """
    return () if value == 0 else ((0, fmpz_poly([value.p]), value.q),)


def add_product(terms: Terms, x: Row, y: Row, times: int = 1) -> None:
    """Add a multiple of the product of two rows to the terms."""
    for i, p, d in x:
        for j, q, e in y:
            product = p * q
            terms.setdefault((i ^ j, i & j), []).append((product * times if times > 1 else product, d * e))


def total(terms: Terms) -> Parts:
    """Add the terms up, each part in lowest terms.

    >>> total({(0, 0): [(fmpz_poly([1]), fmpz(2)), (fmpz_poly([1]), fmpz(3))]})[0]
    5/6
    """
    found: list[list[Integral]] = [[], [], [], []]
    for (part, shared), those in terms.items():
        numerator, denominator = added(those)
        numerator = numerator.left_shift(1) if shared & 1 else numerator
        found[part].append((numerator - numerator.left_shift(1) if shared & 2 else numerator, denominator))
    a, b, c, d = (_reduced(*added(those)) if those else None for those in found)
    return a, b, c, d


def added(those: Sequence[Integral]) -> Integral:
    """Return the sum over a common denominator.

    From the shortest denominator to the longest, each of which the next nearly holds, so that factors stay short.
    """
    if len(those) == 1:
        return those[0]
    total, common = fmpz_poly([]), ONE
    for numerator, d in sorted(those, key=itemgetter(1)):
        if d != common:
            before, common = common, common.lcm(d)
            total = total * (common // before)
        total += numerator if d == common else numerator * (common // d)
    return total, common


def _reduced(numerator: fmpz_poly, denominator: fmpz) -> fmpq_poly | None:
    return None if numerator.is_zero() else fmpq_poly(numerator, denominator)
