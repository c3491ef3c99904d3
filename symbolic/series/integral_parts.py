r"""Sums of products of rational trigonometric polynomials through integers, in lowest terms once at the end.

A part p(y) is N(y)/d with integers N, so that

    sum of p_j q_j = (1/L) sum of (L / (d_j e_j)) N_j M_j,      L = lcm of all d_j e_j.

Adding fractions one by one would take a greatest common divisor of every coefficient every time.  Blocks of consecutive
orders are multiplied at once: brought to a common denominator, each order in a window of its own of one long polynomial
(Kronecker substitution; von zur Gathen and Gerhard, Modern Computer Algebra, 8.4).
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import reduce
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


@dataclass(frozen=True)
class Rows:
    """The orders of a block that hold one part, at first, first + step, ...; None where one is missing."""

    part: int
    first: int
    step: int
    values: tuple[Integral | None, ...]

    @property
    def width(self) -> int:
        """Coefficients of the longest row."""
        return max(v[0].length() for v in self.values if v is not None)

    def refined(self, step: int) -> Rows:
        """The same rows at a step that divides this one."""
        if len(self.values) == 1 or step == self.step:
            return Rows(self.part, self.first, step, self.values)
        full: list[Integral | None] = [None] * ((len(self.values) - 1) * (self.step // step) + 1)
        full[:: self.step // step] = self.values
        return Rows(self.part, self.first, step, tuple(full))

    def packed(self, room: int) -> Integral:
        """All rows over their common denominator in one polynomial, each in a window of ``room`` coefficients."""
        common = reduce(fmpz.lcm, [v[1] for v in self.values if v is not None], ONE)
        window = [fmpz(0)] * (room * len(self.values))
        for r, v in enumerate(self.values):
            if v is not None:
                numerator = v[0] if v[1] == common else v[0] * (common // v[1])
                window[r * room : r * room + numerator.length()] = numerator.coeffs()
        return fmpz_poly(window), common


def rows(block: Sequence[Row]) -> list[Rows]:
    """Collect the parts of a block of orders, those that no order has left out.

    >>> one = ((0, fmpz_poly([1]), fmpz(1)),)
    >>> rows([one, (), one])
    [Rows(part=0, first=0, step=2, values=((1, 1), (1, 1)))]
    """
    parts: dict[int, dict[int, Integral]] = {}
    for n, row in enumerate(block):
        for part, numerator, denominator in row:
            parts.setdefault(part, {})[n] = numerator, denominator
    found = []
    for part, present in parts.items():
        first, last = next(iter(present)), next(reversed(present))
        step = math.gcd(*(n - first for n in present)) or 1
        found.append(Rows(part, first, step, tuple(present.get(n) for n in range(first, last + 1, step))))
    return found


def products(left: Sequence[Row], right: Sequence[Row]) -> Iterator[tuple[int, tuple[int, int], Integral]]:
    """Multiply two blocks of orders: order, key as in ``Terms`` and value of everything that their product holds.

    >>> one = ((1, fmpz_poly([1]), fmpz(1)),)
    >>> list(products([one], [one]))
    [(0, (0, 1), (1, 1))]
    """
    for x, y in itertools.product(rows(left), rows(right)):
        step = y.step if len(x.values) == 1 else x.step if len(y.values) == 1 else math.gcd(x.step, y.step)
        yield from _product(x.refined(step), y.refined(step))


def _product(x: Rows, y: Rows) -> Iterator[tuple[int, tuple[int, int], Integral]]:
    room = x.width + y.width - 1
    (p, d), (q, e) = x.packed(room), y.packed(room)
    coefficients, key = (p * q).coeffs(), (x.part ^ y.part, x.part & y.part)
    for r in range(len(x.values) + len(y.values) - 1):
        numerator = fmpz_poly(coefficients[r * room : (r + 1) * room])
        if not numerator.is_zero():
            yield x.first + y.first + r * x.step, key, (numerator, d * e)
