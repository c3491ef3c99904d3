r"""Where omega0(A) of a potential that is not even is analytic, and how large it can be there.

With 2V(u) = S(u)^2, S(u) = u h(u)^(1/2), h = 2V/u^2 (units with k = 1), and U the inverse of S,

    1/omega0(A) = mean of U'(s sin theta) over theta,      s = S(A),      U'(S(u)) = 1/S'(u),   S' = (f/u)/h^(1/2)

(L. D. Landau and E. M. Lifshitz, Mechanics, section 12).  Where Re S' > 0 on a convex set D that holds 0, S is one to
one on D (Noshiro and Warschawski: P. L. Duren, Univalent Functions, Springer, 1983, theorem 2.16), so that U is
analytic on S(D), and Re U' >= m = min Re(1/S') there.  Let N be a rectangle symmetric about 0 that does not meet S of
the boundary of D: then N lies in S(D), and for every A with S(A) in N the mean is over points of N; hence omega0 is
analytic there and |omega0| <= 1/m.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import reduce
from itertools import product
from typing import Final, TypeAlias

from flint import acb, arb, fmpq

from ridgeback.symbolic.enclosure.ball_functions import Function
from ridgeback.symbolic.enclosure.well import Curves

RATES: Final = tuple(fmpq(n, 20) for n in (60, 50, 42, 36, 32, 28, 26, 24, 22))
"""Parameters rho of ellipses that are tried, from wide to narrow."""
MARGINS: Final = (fmpq(3, 2), fmpq(5, 2), fmpq(4))
"""How far D goes beyond the ellipse, in its height."""
MOST_BOXES: Final = 400
MOST_TRIES: Final = 12
FINEST: Final = fmpq(1, 2048)
PIECES: Final = (1, 6)
"""Of a segment from 0."""
LOOSE: Final = 4
"""How far the bound in a box may exceed its size in the middle."""
EDGE: Final = 24
"""Pieces of each edge of D; of the half ellipse four times as many."""

Box: TypeAlias = tuple[fmpq, fmpq, fmpq, fmpq]
"""Left, right, low, top."""


@dataclass(frozen=True)
class _Map:
    """S and S' on boxes."""

    curves: Curves
    bend: Function
    """f''."""

    def ratios(self, u: acb) -> tuple[acb, acb]:
        """g = f(u)/u and h(u) from their values in the middle c and their slopes.

        g' is the mean of t f''(t u) over 0 < t < 1, h' that of 2 (1 - t) t f''(t u): in the hull of f''/2 and f''/3.
        """
        middle = u.mid()
        moved = self.hull(u) * (u - middle)
        if middle == 0:
            return 1 + moved / 2, 1 + moved / 3
        force, value = acb(self.curves.force(middle)), acb(self.curves.value(middle))
        return force / middle + moved / 2, 2 * value / (middle * middle) + moved / 3

    def hull(self, u: acb) -> acb:
        """f'' over the segments from 0 to a box, in one piece or, where balls grow too wide for that, in several."""
        found = acb(arb("nan"), arb("nan"))
        for count in PIECES:
            shares = (arb(fmpq(i, count)).union(arb(fmpq(i + 1, count))) for i in range(count))
            values = [acb(self.bend(share * u)) for share in shares]
            found = reduce(joined, values)
            if found.is_finite():
                break
        return found

    def slope(self, u: acb) -> acb:
        """S'(u)."""
        ratio, h = self.ratios(u)
        return ratio / h.sqrt(analytic=True)

    def at(self, u: acb) -> acb:
        """S(u), in S(c) + S'(u)(u - c) with the middle c."""
        middle = u.mid()
        value = middle * self.ratios(middle)[1].sqrt(analytic=True)
        return value + self.slope(u) * (u - middle)


def joined(a: acb, b: acb) -> acb:
    """A box around two."""
    return acb(a.real.union(b.real), a.imag.union(b.imag))


def widest(curves: Curves, bend: Function, trough: fmpq, end: fmpq) -> tuple[fmpq, arb] | None:
    """rho of the widest ellipse about [0, end] on which omega0 is analytic by this argument, and its bound there."""
    move, tries = _Map(curves, bend), 0
    for rate, margin in product(RATES, MARGINS):
        high = end * (rate - 1 / rate) / 4
        domain = (trough - margin * high, end + margin * high, fmpq(0), margin * high)
        if _plausible(move, domain):
            tries += 1
            if tries > MOST_TRIES:
                break
            bound = _bound(move, domain)
            if bound is not None and _inside(move, domain, end, rate):
                return rate, bound
    return None


def _plausible(move: _Map, domain: Box) -> bool:
    """Whether Re S' > 0 at points of D, which costs little to see."""
    left, right, _, top = domain
    places = (acb(left + (right - left) * i / 24, top * j / 3) for i in range(25) for j in (3, 2, 1, 0))
    return all(bool(move.slope(u).real > 0) for u in places)


def _bound(move: _Map, domain: Box) -> arb | None:
    """1/m over the upper half of D, whose mirror image is the lower; None where Re S' > 0 is not shown."""
    waiting, seen, worst = [domain], 0, arb(0)
    while waiting:
        box = waiting.pop()
        seen += 1
        slope = move.slope(ball_of(box))
        size = arb((abs(slope) ** 2 / slope.real).upper()) if slope.is_finite() and slope.real > 0 else arb("inf")
        if size <= worst or size <= LOOSE * abs(move.slope(ball_of(box).mid())):
            worst = arb(arb.max(worst, size))
        elif seen > MOST_BOXES or box[1] - box[0] < FINEST * (domain[1] - domain[0]):
            return None
        else:
            waiting += halves(box)
    return worst


def halves(box: Box) -> list[Box]:
    """A box in two across its longer side.

    >>> halves((fmpq(0), fmpq(2), fmpq(0), fmpq(1)))
    [(0, 1, 0, 1), (1, 2, 0, 1)]
    """
    left, right, low, top = box
    if right - left >= top - low:
        middle = (left + right) / 2
        return [(left, middle, low, top), (middle, right, low, top)]
    level = (low + top) / 2
    return [(left, right, low, level), (left, right, level, top)]


def ball_of(box: Box) -> acb:
    """A box as a complex ball."""
    left, right, low, top = map(arb, box)
    return acb(left.union(right), low.union(top))


def _inside(move: _Map, domain: Box, end: fmpq, rate: fmpq) -> bool:
    """Whether N keeps clear of S over the edges of D.

    N holds S and -S of the ellipse, and so of all within it, since S is one to one.
    """
    wide, high = arb(0), arb(0)
    for box in _ellipse(end, rate):
        value = move.at(ball_of(box))
        if not value.is_finite():
            return False
        wide = arb(arb.max(wide, abs(value.real).upper()))
        high = arb(arb.max(high, abs(value.imag).upper()))
    return all(_clear(move, piece, wide, high) for piece in _edges(domain))


def _ellipse(end: fmpq, rate: fmpq) -> Iterator[Box]:
    """Boxes that cover the upper half of the ellipse itself, piece by piece."""
    half, count = end / 2, 4 * EDGE
    wide, high = half * (rate + 1 / rate) / 2, half * (rate - 1 / rate) / 2
    for i in range(count):
        angle = arb(fmpq(i, count)).union(arb(fmpq(i + 1, count)))
        x, y = half + wide * arb.cos_pi(angle), high * arb.sin_pi(angle).nonnegative_part()
        yield x.lower().fmpq(), x.upper().fmpq(), y.lower().fmpq(), y.upper().fmpq()


def _edges(domain: Box) -> Iterator[Box]:
    left, right, low, top = domain
    for i in range(EDGE):
        a, b = left + (right - left) * i / EDGE, left + (right - left) * (i + 1) / EDGE
        yield a, b, top, top
        c, d = low + (top - low) * i / EDGE, low + (top - low) * (i + 1) / EDGE
        yield left, left, c, d
        yield right, right, c, d


def _clear(move: _Map, piece: Box, wide: arb, high: arb) -> bool:
    """Whether S over a piece of an edge lies outside |Re| <= wide, |Im| <= high; halved up to five times."""
    waiting = [(piece, 0)]
    while waiting:
        box, depth = waiting.pop()
        value = move.at(ball_of(box))
        if value.is_finite() and (abs(value.real) > wide or abs(value.imag) > high):
            continue
        if depth == 5:
            return False
        waiting += [(part, depth + 1) for part in halves(box)]
    return True
