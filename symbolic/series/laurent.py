r"""Products of blocks of trigonometric polynomials in balls.

With E = exp(i tau), 2 cos is a symmetric and 2i sin an antisymmetric Laurent polynomial in E with real coefficients F,
and these multiply as polynomials in E^2:

    4 (cos cos) = F G,    4i (cos sin) = F G,    4 (sin sin) = -F G

A block of consecutive orders is multiplied at once, packed into one polynomial with room between the orders (Kronecker
substitution).  FLINT's ball product scales its blocks, so that small coefficients keep their digits.

The parts are packed apart, but for one case that halves the work: when cosines and sines alternate from order to order
(van der Pol), u_n = i^(-t) G_n / 2 with t = n or n + 1 and real G_n = +-F_n, and then all the orders multiply as one
real polynomial.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

from flint import arb, arb_poly, fmpq

from ridgeback.symbolic.series.spaces import Parts

TILE: Final = 128
"""Orders packed at most: twice as many save little time, and take gigabytes beyond order 500."""


@dataclass(frozen=True)
class Rows:
    """The orders that hold one part, at first, first + step, ...: their Laurent coefficients, none where missing.

    With ``turning``, cosines and sines in turn, ``part`` the first of them: row r has t = r, or r + 1 if it is a sine.
    """

    part: int
    first: int
    step: int
    laurent: tuple[list[arb], ...]
    turning: bool = False

    def lengths(self) -> list[int]:
        """Number of coefficients of each row."""
        return [len(row) for row in self.laurent]

    def packed(self, room: int) -> arb_poly:
        """All rows in one polynomial, each centred alike in a window of ``room`` coefficients.

        Rounded to the working precision, because a product is as slow as its longest mantissa.
        """
        longest, window = max(self.lengths()), [arb(0)] * (room * len(self.laurent))
        for r, row in enumerate(self.laurent):
            start = r * room + (longest - len(row)) // 2
            window[start : start + len(row)] = row
        return arb_poly(window) * 1


def laurent(p: arb_poly, part: int) -> list[arb]:
    """Coefficients of 2 (cosine) or 2i (sine) times one part, in powers of E^2 from the lowest to the highest.

    >>> laurent(arb_poly([1, 2]), 0) == [2, 2, 2], laurent(arb_poly([1]), 2) == [-1, 1]
    (True, True)
    """
    upper = p.coeffs()
    if part == 0:
        return [*upper[:0:-1], 2 * upper[0], *upper[1:]]
    if part == 1:
        return [*reversed(upper), *upper]
    return [*(-x for x in reversed(upper)), *([arb(0)] if part == 3 else []), *upper]


def products(left: Sequence[Parts], right: Sequence[Parts]) -> list[Parts]:
    """Multiply two blocks of orders: element r is the sum of left[a] right[b] over a + b = r.

    >>> cosine = (None, arb_poly([1]), None, None)
    >>> products([cosine], [cosine])[0][0]
    0.500000000000000*x + 0.500000000000000
    """
    result: list[list[arb_poly | None]] = [[None] * 4 for _ in range(len(left) + len(right) - 1)]
    for a, b in itertools.product(range(0, len(left), TILE), range(0, len(right), TILE)):
        for x, y in _pairs(left[a : a + TILE], right[b : b + TILE]):
            for n, part, p in _product(x, y):
                old = result[a + b + n][part]
                result[a + b + n][part] = p if old is None else old + p
    return [(a, b, c, d) for a, b, c, d in result]


def _pairs(left: Sequence[Parts], right: Sequence[Parts]) -> list[tuple[Rows, Rows]]:
    """What has to be multiplied: all in one, or part by part."""
    x, y = alternating(left), alternating(right)
    if x is not None and y is not None:
        return [(x, y)]
    apart = [[r for part in range(4) if (r := rows(block, part)) is not None] for block in (left, right)]
    return [(x, y) for x in apart[0] for y in apart[1]]


def alternating(block: Sequence[Parts]) -> Rows | None:
    """Collect a block in which every order has just one part, cosine and sine of one parity in turn; else None."""
    present = [[(i, p) for i, p in enumerate(row) if p is not None and p.length()] for row in block]
    first = present[0][0][0] if present[0] else 0
    if len(block) < 2 or any([i for i, _ in row] != [3 - first if n % 2 else first] for n, row in enumerate(present)):
        return None
    coefficients = [laurent(p, i) for ((i, p),) in present]
    turned = [c if ((first >> 1) + n) % 4 < 2 else [-v for v in c] for n, c in enumerate(coefficients)]
    return Rows(first, 0, 1, tuple(turned), turning=True)


def rows(block: Sequence[Parts], part: int) -> Rows | None:
    """Collect one part of a block of orders; None when no order has it."""
    present = {n: p for n, parts in enumerate(block) if (p := parts[part]) is not None and p.length()}
    if not present:
        return None
    first = min(present)
    step = math.gcd(*(b - a for a, b in itertools.pairwise(present))) or 1
    found = [present.get(n) for n in range(first, max(present) + 1, step)]
    return Rows(part, first, step, tuple([] if p is None else laurent(p, part) for p in found))


def _product(x: Rows, y: Rows) -> list[tuple[int, int, arb_poly]]:
    """Multiply the rows of two parts; every order of the result with its part and polynomial."""
    x, y = _same_step(x, y)
    room = max(x.lengths()) + max(y.lengths()) - 1
    coefficients = (x.packed(room) * y.packed(room)).coeffs()
    found = []
    for r, length in enumerate(_lengths(x.lengths(), y.lengths())):
        if length:
            start = r * room + (room - length) // 2
            window = coefficients[start : start + length]
            window += [arb(0)] * (length - len(window))
            part, sign = _part_and_sign(x, y, r)
            found.append((x.first + y.first + r * x.step, part, _folded(window, sine=part > 1, sign=sign)))
    return found


def _part_and_sign(x: Rows, y: Rows, r: int) -> tuple[int, int]:
    """The part of row r of a product, and the sign of 4 times it, or 4i times it, in F G."""
    if not x.turning:
        return x.part ^ y.part, -1 if x.part & y.part & 2 else 1
    turns = (x.part >> 1) + (y.part >> 1) + r
    cosine = 1 if (x.part in (1, 2)) != (y.part in (1, 2)) else 0  # 1: odd harmonics
    return 3 - cosine if turns % 2 else cosine, -1 if turns % 4 > 1 else 1


def _same_step(x: Rows, y: Rows) -> tuple[Rows, Rows]:
    """Bring the rows of both to one step; a single row has any."""
    if len(x.laurent) == 1 or len(y.laurent) == 1:
        step = y.step if len(x.laurent) == 1 else x.step
    else:
        step = math.gcd(x.step, y.step)
    return _refined(x, step), _refined(y, step)


def _refined(x: Rows, step: int) -> Rows:
    factor = x.step // step if len(x.laurent) > 1 else 1
    full: list[list[arb]] = [[] for _ in range((len(x.laurent) - 1) * factor + 1)]
    full[::factor] = x.laurent
    return replace(x, step=step, laurent=tuple(full))


def _lengths(x: list[int], y: list[int]) -> list[int]:
    """Length of each row of a product: the longest of x_a y_b over a + b = r.

    Beyond it a packed product has only rounding errors of zeros, which are dropped.
    """
    result = [0] * (len(x) + len(y) - 1)
    for a, m in enumerate(x):
        for b, n in enumerate(y):
            if m and n and m + n - 1 > result[a + b]:
                result[a + b] = m + n - 1
    return result


def _folded(window: list[arb], *, sine: bool, sign: int) -> arb_poly:
    """One part of a product from its Laurent coefficients F G, which are ``sign`` times 4 or 4i times it."""
    middle, odd = divmod(len(window), 2)
    upper = window[middle + (1 if odd and sine else 0) :]
    if odd and not sine:
        upper[0] = upper[0] / 2
    return arb_poly(upper) * fmpq(sign, 2)
