r"""Products of blocks of consecutive orders, each block one long polynomial of integers (Kronecker substitution).

A block is brought to a common denominator, each order in a window of its own (von zur Gathen and Gerhard, Modern
Computer Algebra, 8.4).  The parts of ``trigonometric`` are multiplied apart but for two cases.  Where both blocks hold
p_0(y) and x p_1(y), or S times such, these are one polynomial in x: one product of twice the length in place of four.
Where cosines and sines of one parity take turns, as in limit cycles, both are a + theta b with theta = S/x and
theta^2 = (1 - y)/y:

    p_0 + S x p_3 = p_0 + theta (y p_3),      x p_1 + S p_2 = x (p_1 + theta p_2),

and a c, b d, a d + b c = (a + b)(c + d) - a c - b d take three (Karatsuba).
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import reduce
from typing import Final, TypeAlias

from flint import fmpz, fmpz_poly

from ridgeback.symbolic.series.integral_parts import ONE, Integral, Row

Found: TypeAlias = Iterator[tuple[int, tuple[int, int], Integral]]
"""Order, key as in ``Terms`` and value of everything that a product holds."""

PAIRS: Final = ((0, 1), (2, 3))
"""Parts that are together one polynomial in x, behind 1 or S."""


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

    @property
    def denominator(self) -> fmpz:
        """The common denominator."""
        return reduce(fmpz.lcm, [v[1] for v in self.values if v is not None], ONE)

    def refined(self, step: int) -> Rows:
        """The same rows at a step that divides this one."""
        if len(self.values) == 1 or step == self.step:
            return replace(self, step=step)
        full: list[Integral | None] = [None] * ((len(self.values) - 1) * (self.step // step) + 1)
        full[:: self.step // step] = self.values
        return Rows(self.part, self.first, step, tuple(full))

    def packed(self, room: int, common: fmpz) -> fmpz_poly:
        """All rows over a common denominator in one polynomial, each in a window of ``room`` coefficients."""
        window = [fmpz(0)] * (room * len(self.values))
        for r, v in enumerate(self.values):
            if v is not None:
                numerator = v[0] if v[1] == common else v[0] * (common // v[1])
                window[r * room : r * room + numerator.length()] = numerator.coeffs()
        return fmpz_poly(window)


def rows(block: Sequence[Row]) -> dict[int, Rows]:
    """Collect the parts of a block of orders, those that no order has left out.

    >>> one = ((0, fmpz_poly([1]), fmpz(1)),)
    >>> rows([one, (), one])
    {0: Rows(part=0, first=0, step=2, values=((1, 1), (1, 1)))}
    """
    parts: dict[int, dict[int, Integral]] = {}
    for n, row in enumerate(block):
        for part, numerator, denominator in row:
            parts.setdefault(part, {})[n] = numerator, denominator
    return {part: _stepped(part, present) for part, present in parts.items()}


def _stepped(part: int, present: dict[int, Integral]) -> Rows:
    first, last = next(iter(present)), next(reversed(present))
    step = math.gcd(*(n - first for n in present)) or 1
    return Rows(part, first, step, tuple(present.get(n) for n in range(first, last + 1, step)))


def products(left: Sequence[Row], right: Sequence[Row]) -> Found:
    """Multiply two blocks of orders.

    >>> one = ((1, fmpz_poly([1]), fmpz(1)),)
    >>> list(products([one], [one]))
    [(0, (0, 1), (1, 1))]
    """
    x, y = rows(left), rows(right)
    turns = _turning(x, y)
    if turns is not None:
        yield from _three(*turns)
        return
    for p, q in itertools.product(PAIRS, PAIRS):
        if x.keys() >= set(p) and y.keys() >= set(q):
            yield from _in_x(_merged(x[p[0]], x[p[1]]), _merged(y[q[0]], y[q[1]]))
        else:
            for i, j in itertools.product(p, q):
                if i in x and j in y:
                    yield from _plain(x[i], y[j])


def _plain(x: Rows, y: Rows) -> Found:
    x, y = _same_step(x, y)
    room, d, e = x.width + y.width - 1, x.denominator, y.denominator
    yield from _parted(x.packed(room, d) * y.packed(room, e), room, x, y, x.part & y.part, drop=0, over=d * e)


def _parted(product: fmpz_poly, room: int, x: Rows, y: Rows, shared: int, *, drop: int, over: fmpz) -> Found:
    """What the windows hold, the lowest ``drop`` coefficients left out, over a denominator."""
    for n, own in _windows(product, room, x.first + y.first, x.step):
        numerator = fmpz_poly(own[drop:])
        if not numerator.is_zero():
            yield n, (x.part ^ y.part, shared), (numerator, over)


def _same_step(x: Rows, y: Rows) -> tuple[Rows, Rows]:
    """Both at one step; a single row has any."""
    step = y.step if len(x.values) == 1 else x.step if len(y.values) == 1 else math.gcd(x.step, y.step)
    return x.refined(step), y.refined(step)


def _windows(product: fmpz_poly, room: int, first: int, step: int) -> Iterator[tuple[int, list[fmpz]]]:
    """The order and the coefficients of every window."""
    coefficients = product.coeffs()
    for r in range(-(-len(coefficients) // room)):
        yield first + r * step, coefficients[r * room : (r + 1) * room]


def _merged(even: Rows, odd: Rows) -> Rows:
    """p(y) and x q(y), or S times them, as one polynomial in x."""
    step = math.gcd(*(r.step for r in (even, odd) if len(r.values) > 1), even.first - odd.first) or 1
    present: dict[int, list[Integral | None]] = {}
    for which, part in enumerate((even, odd)):
        for r, v in enumerate(part.values):
            present.setdefault(part.first + r * part.step, [None, None])[which] = v
    first, last = min(present), max(present)
    values = tuple(_woven(*present[n]) if n in present else None for n in range(first, last + 1, step))
    return Rows(even.part, first, step, values)


def _woven(even: Integral | None, odd: Integral | None) -> Integral | None:
    """Coefficients in turn."""
    present = [(k, v) for k, v in enumerate((even, odd)) if v is not None]
    if not present:
        return None
    common = reduce(fmpz.lcm, [v[1] for _, v in present], ONE)
    coefficients = [fmpz(0)] * (2 * max(v[0].length() for _, v in present))
    for k, (numerator, d) in present:
        coefficients[k : 2 * numerator.length() + k : 2] = (numerator * (common // d)).coeffs()
    return fmpz_poly(coefficients), common


def _in_x(x: Rows, y: Rows) -> Found:
    """The product of two merged parts, apart again; S^2 = 1 - y."""
    x, y = _same_step(x, y)
    room, d, e = x.width + y.width - 1, x.denominator, y.denominator
    product = x.packed(room, d) * y.packed(room, e)
    for n, own in _windows(product, room, x.first + y.first, x.step):
        for odd in (0, 1):
            numerator = fmpz_poly(own[odd::2])
            if not numerator.is_zero():
                yield n, ((x.part ^ y.part) + odd, x.part & y.part), (numerator, d * e)


def _turning(x: dict[int, Rows], y: dict[int, Rows]) -> tuple[Rows, Rows, Rows, Rows] | None:
    """a, b of both blocks where each holds cosines and sines of one parity, aligned in their orders; else None."""
    if any(sorted(z) not in ([0, 3], [1, 2]) for z in (x, y)):
        return None
    a, b, c, d = (z[part] for z in (x, y) for part in sorted(z))
    step = a.step
    if any(r.step != step or len(r.values) < 2 for r in (a, b, c, d)):
        return None
    lag = (b.first - a.first) - (d.first - c.first)
    if lag == step:
        c = _earlier(c)
    elif lag == -step:
        a = _earlier(a)
    elif lag:
        return None
    return a, b, c, d


def _earlier(x: Rows) -> Rows:
    """With an empty row in front."""
    return Rows(x.part, x.first - x.step, x.step, (None, *x.values))


def _three(a: Rows, b: Rows, c: Rows, d: Rows) -> Found:
    """(a + theta b)(c + theta d) by three products; a factor y that theta brought in is taken out again."""
    up, over = b.part & 1, d.part & 1
    room = max(a.width, b.width + up) + max(c.width, d.width + over) - 1
    left, right = a.denominator.lcm(b.denominator), c.denominator.lcm(d.denominator)
    p, q = a.packed(room, left), b.packed(room, left).left_shift(up)
    r, s = c.packed(room, right), d.packed(room, right).left_shift(over)
    pr, qs = p * r, q * s
    cross = (p + q) * (r + s) - pr - qs
    yield from _parted(pr, room, a, c, a.part & c.part, drop=0, over=left * right)
    yield from _parted(qs, room, b, d, b.part & d.part, drop=up + over, over=left * right)
    yield from _parted(cross, room, a, d, 0, drop=up & over, over=left * right)
