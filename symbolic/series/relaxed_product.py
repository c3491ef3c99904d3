r"""Products of power series on line: coefficient n of x y as soon as x_0 ... x_n and y_0 ... y_n exist.

    (xy)_n = x_0 y_n + x_n y_0 + sum over 0 < j < n of x_j y_(n-j)

The last sum is collected in blocks: when order n is reached, orders below it are final, and for every power of two l
that divides n the block x_l ... x_(2l-1) meets y_(n-l) ... y_(n-1), and likewise with x and y exchanged, in one packed
product each (van der Hoeven, Relax, but don't be too lazy, J. Symb. Comput. 34 (2002) 479).  What a block contributes
to later orders waits until they are asked for.  n^2/2 products become some n log n large ones, which FLINT does by FFT.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ridgeback.common.recurrences import Fixed, Node, Product, Ring
from ridgeback.symbolic.series.harmonic_basis import EMPTY, Balls, plus
from ridgeback.symbolic.series.laurent import products
from ridgeback.symbolic.series.spaces import Parts
from ridgeback.symbolic.series.trigonometric import Trig


@dataclass(frozen=True)
class Waiting:
    """What the blocks have contributed to orders not yet asked for, and what it was before the last order."""

    order: int
    before: dict[int, Parts]
    after: dict[int, Parts]


def blocks(n: int) -> Iterator[tuple[int, bool]]:
    """Yield the block lengths due at order n, and whether the two blocks coincide.

    >>> list(blocks(6)), list(blocks(4))
    ([(1, False), (2, False)], [(1, False), (2, True)])
    """
    length = 1
    while n % length == 0 and 2 * length <= n:
        yield length, 2 * length == n
        length *= 2


def waiting_orders(n: int, last: int) -> range:
    """The orders above n, up to ``last``, to which the blocks of the orders up to n have contributed.

    The blocks of length l due at order m reach from m to m + 2 l - 2.

    >>> waiting_orders(8, 100), waiting_orders(16, 25), waiting_orders(2, 25)
    (range(9, 15), range(17, 26), range(3, 3))
    """
    reach = max((m + 2 * length - 2 for m in range(2, n + 1) for length, _ in blocks(m)), default=n)
    return range(n + 1, max(min(reach, last), n) + 1)


class RelaxedProduct(Product):
    """x y over balls; every value found is kept on a tape, so that an interrupted recursion can be replayed.

    A factor that is given (a small parameter) is multiplied plainly, so that the other may lag behind it.
    """

    def __init__(self, ring: Ring, x: Node, y: Node, space: Balls) -> None:
        super().__init__(ring, x, y)
        self.space = space
        self.tape: list[Parts] = []
        self.replayed: list[Parts] = []
        self.waiting = Waiting(0, {}, {})

    @property
    def plain(self) -> bool:
        """Whether this product is taken term by term, since blocks would gain nothing."""
        return isinstance(self.x, Fixed) or isinstance(self.y, Fixed)

    def step(self, n: int) -> Trig:
        if self.plain:
            plain: Trig = super().step(n)
            return plain
        ends = self._ends(n)
        for factor in (self.x, self.y) if n > 1 else ():
            factor.get(n - 1)  # a replay must ask for the same, or a factor would miss its corrections
        if len(self.tape) < len(self.replayed):
            self.tape.append(self.replayed[len(self.tape)])
        else:
            self.tape.append(plus(ends, self._middle(n)))
        return Trig(self.space, self.tape[-1])

    def _ends(self, n: int) -> Parts:
        """x_0 y_n + x_n y_0; the partner of a zero is not asked for."""
        total: Trig = self.ring.dot([], [])
        for j in dict.fromkeys((0, n)):
            if not self.ring.absent(self.x.get(j)):
                total = total + self.x.get(j) * self.y.get(n - j)
        return total.parts

    def _middle(self, n: int) -> Parts:
        """The sum over 0 < j < n; asked a second time (after ``forget``), the blocks of order n are taken again."""
        before = self.waiting.before if self.waiting.order == n else self.waiting.after
        after = dict(before)
        for length, alone in blocks(n):
            size = min(length, self.space.last + 1 - n)
            for r, parts in enumerate(self._block(n, length, size, alone)[: self.space.last + 1 - n]):
                after[n + r] = plus(after.get(n + r, EMPTY), parts)
        self.waiting = Waiting(n, before, after)
        return after.pop(n, EMPTY)

    def _block(self, n: int, length: int, size: int, alone: bool) -> list[Parts]:
        low, high = range(length, length + size), range(n - length, n - length + size)
        first = products(_parts(self.x, low), _parts(self.y, high))
        if alone:
            return first
        if self.x is self.y:
            return [plus(p, p) for p in first]
        second = products(_parts(self.y, low), _parts(self.x, high))
        return [plus(p, q) for p, q in zip(first, second, strict=True)]


def _parts(node: Node, orders: range) -> list[Parts]:
    return [node.get(j).parts for j in orders]
