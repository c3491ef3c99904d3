r"""How wide a strip the period's integrand is analytic in, proved.

cos maps |Im theta| <= a onto the filled ellipse with foci -1, 1 and semi-axis cosh a.  A point z lies on the ellipse
with cosh a_z = (|z - 1| + |z + 1|) / 2, a function whose slope is at most 1; so between z and any point of the filled
ellipse of a < a_z there is at least cosh a_z - cosh a.  With the certified roots z_r of q(w) = c prod (w - z_r),

    |F| = |q|^(-1/2) <= (|c| prod (cosh a_r - cosh a))^(-1/2)   for |Im theta| <= a < min a_r.

For other potentials the strip is covered by boxes, on each of which a ball of q is finite and does not hold 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from flint import acb, arb, ctx, fmpq

from ridgeback.symbolic.enclosure.integrand import GeneralIntegrand
from ridgeback.symbolic.enclosure.turning_points import Orbit, PolynomialOrbit, complex_roots
from ridgeback.symbolic.enclosure.walk import UndecidedError
from ridgeback.symbolic.enclosure.well import Well

COVER_BITS: Final = 64
"""Precision of strips: their bounds need not be sharp."""

MAX_BOXES: Final = 256
"""Boxes after which a strip is given up."""

CHEAP_BOXES: Final = 32
"""A strip that took no more is tried at twice the width: boxes cost several times what the points saved cost."""

FINEST: Final = 64
"""A box is not made smaller than this part of the strip's width: about there q has a zero."""

WIDTHS: Final = tuple(fmpq(1, 1 << k) for k in range(2, 7))
"""Strips that are tried until one can be covered, from wide to narrow."""


@dataclass(frozen=True)
class Strip:
    """|Im theta| <= width, and a bound of |F| there."""

    width: arb
    bound: arb


def strip_of(well: Well, orbit: Orbit) -> Strip | None:
    """A strip without singularities, nearly the widest; None when none of a useful width is found.

    Raises UndecidedError when the precision of the orbit does not tell roots apart.
    """
    with ctx.workprec(COVER_BITS):
        return polynomial_strip(orbit) if isinstance(orbit, PolynomialOrbit) else covered_strip(well, orbit)


def polynomial_strip(orbit: PolynomialOrbit) -> Strip:
    """The strip from the certified roots of V(A) - V(u).

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> from ridgeback.symbolic.enclosure.turning_points import orbit
    >>> from ridgeback.symbolic.enclosure.well import well_of
    >>> duffing = orbit(well_of(find("duffing")), fmpq(1), 64)  # roots at +-i sqrt(3), so sinh a = sqrt(3)
    >>> polynomial_strip(duffing).width < arb(3).sqrt().asinh()
    True
    """
    middle, half = orbit.middle, orbit.half
    axes = [_semi_axis((z - middle) / half) for z in _without_trough(orbit)]
    if not all(axis > 1 for axis in axes):
        raise UndecidedError
    widest = min((axis.lower() for axis in axes), default=arb(4).cosh())
    width = (widest.acosh() * 15 / 16).lower()
    size = abs(arb(orbit.quotient.leading_coefficient())) * half ** len(axes)
    for axis in axes:
        size *= axis - width.cosh()
    if not size > 0:
        raise UndecidedError
    return Strip(width, size.rsqrt())


def _without_trough(orbit: PolynomialOrbit) -> list[acb]:
    """The roots of V(A) - V(u) other than the turning points, repeated ones repeated."""
    roots = [z for z, count in complex_roots(orbit.quotient) for _ in range(count)]
    others = [z for z in roots if not z.overlaps(acb(orbit.trough))]
    if len(others) != len(roots) - 1:
        raise UndecidedError
    return others


def _semi_axis(z: acb) -> arb:
    """cosh of the parameter of the ellipse through z with foci -1 and 1."""
    return (abs(z - 1) + abs(z + 1)) / 2


def covered_strip(well: Well, orbit: Orbit) -> Strip | None:
    """A strip that boxes can cover, not the widest but wide for the effort; |F| is bounded box by box."""
    integrand = GeneralIntegrand(well, orbit)
    for narrow in WIDTHS:
        width = arb(narrow)
        cover = _cover(integrand, width, MAX_BOXES)
        if cover is not None:
            return _wider(integrand, width, *cover)
    return None


def _wider(integrand: GeneralIntegrand, width: arb, bound: arb, boxes: int) -> Strip:
    """Twice the width for as long as that is cheap."""
    if boxes <= CHEAP_BOXES:
        cover = _cover(integrand, 2 * width, 2 * CHEAP_BOXES)
        if cover is not None:
            return _wider(integrand, 2 * width, *cover)
    return Strip(width, bound)


def _cover(integrand: GeneralIntegrand, width: arb, limit: int) -> tuple[arb, int] | None:
    """The largest |F| over 0 <= Im theta <= width (the other half is its mirror image), and the boxes it took.

    An even F needs only half of the real range.
    """
    pieces = 2 if integrand.even else 4
    step = arb.pi() / 4
    boxes = [(step * j, step * (j + 1), arb(0), width) for j in range(pieces)]
    largest, finest = arb(0), width / FINEST
    for used in range(limit):
        if not boxes:
            return largest, used
        left, right, low, high = boxes.pop()
        size = integrand.size(acb(left.union(right), low.union(high)))
        if size is not None:
            largest = largest.max(size)
        elif right - left < finest and high - low < finest:
            return None
        elif right - left > high - low:
            middle = ((left + right) / 2).mid()
            boxes += [(left, middle, low, high), (middle, right, low, high)]
        else:
            middle = ((low + high) / 2).mid()
            boxes += [(left, right, low, middle), (left, right, middle, high)]
    return None
