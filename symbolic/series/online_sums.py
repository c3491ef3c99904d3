r"""Sums of products of two growing series, each as soon as its orders exist, in blocks: over the rationals.

    sum over first <= j <= last of x_j y_(n-j)

Pairs with one of the lowest orders are multiplied one by one; the others in the blocks of ``relaxed_product``, as soon
as their orders are final, and brought to lowest terms once an order is asked for (``integral_parts``).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Final

from flint import fmpq

from ridgeback.common.recurrences import Fixed, Node, Product, Ring, Sums
from ridgeback.symbolic.series.block_products import products
from ridgeback.symbolic.series.integral_parts import Row, Terms, add_product, integral, integral_scalar, total
from ridgeback.symbolic.series.spaces import Rationals, Scalar, Space, is_zero
from ridgeback.symbolic.series.trigonometric import NOTHING, Trig, constant

BASE: Final = 8
"""Length of the shortest blocks; a power of two."""


class Factor:
    """A growing series as integers over denominators; a coefficient that was corrected is converted again."""

    def __init__(self, known: Sequence[Any], convert: Callable[[Any], Row]) -> None:
        self.known, self.convert = known, convert
        self.rows: list[tuple[Any, Row]] = []

    def row(self, j: int) -> Row:
        """Coefficient j."""
        if j < len(self.rows):
            value, row = self.rows[j]
            if value is self.known[j]:
                return row
            del self.rows[j:]
        for value in self.known[len(self.rows) : j + 1]:
            self.rows.append((value, self.convert(value)))
        return self.rows[j][1]

    def block(self, start: int, size: int) -> list[Row]:
        """Some consecutive coefficients."""
        return [self.row(j) for j in range(start, start + size)]

    def leading_zeros(self) -> int | None:
        """How many coefficients vanish before the first that does not, ``BASE`` at most; None while none is known."""
        for j in range(min(BASE, len(self.known))):
            if self.row(j):
                return j
        return BASE if len(self.known) >= BASE else None


class OnlineSums:
    """The sums for two series, which may be one and the same; ``last`` is the highest order ever asked for.

    The blocks due at order n hold orders below n - s, s being the leading zeros of both series together; these must be
    final when n is asked for.  The sums of a series with itself are taken over all pairs.
    """

    def __init__(self, space: Space, x: Factor, y: Factor, last: int) -> None:
        self.space, self.x, self.y, self.last = space, x, y, last
        self.skip: tuple[int, int] | None = None
        self.reached = 2 * BASE - 1
        """The order, counted without leading zeros, up to which blocks have been multiplied."""
        self.waiting: dict[int, Terms] = {}
        """What the blocks have contributed to orders not yet passed."""

    def __call__(self, n: int, first: int, last: int) -> Trig:
        s, t = self._skips()
        m = n - s - t
        while self.reached < m:
            self.reached += 1
            self._multiply_blocks(self.reached, s, t)
        terms = {key: list(those) for key, those in self.waiting.get(m, {}).items()}
        if self.x is self.y:
            self._add_squares(terms, n, s)
        else:
            top = min(last, n - t)
            low = range(max(first, s), min(top, s + BASE - 1) + 1)
            for j in (*low, *range(max(n - t - BASE + 1, low.stop), top + 1)):
                if x := self.x.row(j):
                    add_product(terms, x, self.y.row(n - j))
        return Trig(self.space, total(terms))

    def _skips(self) -> tuple[int, int]:
        if self.skip is None:
            s, t = self.x.leading_zeros(), self.y.leading_zeros()
            if s is None or t is None:
                return len(self.x.known) if s is None else s, len(self.y.known) if t is None else t
            self.skip = s, t
        return self.skip

    def _add_squares(self, terms: Terms, n: int, s: int) -> None:
        """The pairs of a square with one of the lowest orders, each multiplied once."""
        for j in range(s, min(s + BASE, n // 2 + 1)):
            if x := self.x.row(j):
                add_product(terms, x, self.x.row(n - j), 1 if 2 * j == n else 2)

    def _multiply_blocks(self, m: int, s: int, t: int) -> None:
        """Multiply the blocks due at order m; what they hold of orders beyond the last is left out."""
        self.waiting.pop(m - 1, None)
        room, length, square = self.last - s - t + 1 - m, BASE, self.x is self.y
        while m % length == 0 and 2 * length <= m:
            size, high, alone = min(length, room), m - length, 2 * length == m
            self._add(m, self.x.block(s + length, size), self.y.block(t + high, size), 2 if square and not alone else 1)
            if not square and not alone:
                self._add(m, self.x.block(s + high, size), self.y.block(t + length, size), 1)
            length *= 2

    def _add(self, m: int, left: list[Row], right: list[Row], times: int) -> None:
        for r, key, (numerator, d) in products(left, right):
            own = self.waiting.setdefault(m + r, {}).setdefault(key, [])
            own.append((numerator * times if times > 1 else numerator, d))


def last_order(space: Space) -> int | None:
    """Return the highest order that blocks are taken for; None where products are taken one by one."""
    return space.last if isinstance(space, Rationals) else None


def sums_of_products(space: Space, x: list[Trig], y: list[Trig], last: int) -> Sums:
    """Return the sums for two growing series of trigonometric polynomials."""
    left = Factor(x, _row)
    return OnlineSums(space, left, left if x is y else Factor(y, _row), last)


def weighted_sums(space: Space, weights: list[Scalar], series: list[Trig]) -> Sums:
    """Return the sums of w_j u_(n-j) for two growing series, the first of numbers."""
    last_of_all = last_order(space)
    if last_of_all is not None:
        return OnlineSums(space, Factor(weights, integral_scalar), Factor(series, _row), last_of_all)
    zero = constant(space, fmpq(0))

    def plain(n: int, first: int, last: int) -> Trig:
        total = zero
        for j in range(first, last + 1):
            if not is_zero(weights[j]):
                total = total + series[n - j].scale(weights[j])
        return total

    return plain


def _row(p: Trig) -> Row:
    return integral(p.parts)


class OnlineProduct(Product):
    """x y in blocks; a factor that is given (a small parameter) is multiplied plainly, so that the other may lag."""

    def __init__(self, ring: Ring, x: Node, y: Node) -> None:
        super().__init__(ring, x, y)
        self.sums, self.nothing = ring.sums(x.known, y.known), Trig(x.get(0).space, NOTHING)

    def step(self, n: int) -> Trig:
        if isinstance(self.x, Fixed) or isinstance(self.y, Fixed):
            plain: Trig = super().step(n)
            return plain
        first = next((j for j in range(n + 1) if not self.ring.absent(self.x.get(j))), n + 1)
        last = n - first if self.x is self.y else n
        if first > last:
            return self.nothing
        self.x.get(last)
        self.y.get(n - first)
        found: Trig = self.sums(n, first, last)
        return found
