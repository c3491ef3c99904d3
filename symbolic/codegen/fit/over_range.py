"""The relative error of a formula against the exact frequency over a whole range, bounded in balls."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Final

from flint import arb, arb_poly, fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import ball
from ridgeback.symbolic.codegen.fit.surrogate import Surrogate
from ridgeback.symbolic.codegen.proofs.bounds import upper

SHARP: Final = arb("1.002")
"""A part is not halved when its bound is so near to that in its middle."""
MOST_BOXES: Final = 10000


def largest_error(
    exact: Surrogate,
    numerator: Sequence[arb],
    denominator: Sequence[arb] = (arb(1),),
    *,
    shares: Sequence[Fraction] = (Fraction(1),),
) -> tuple[Fraction, ...]:
    """Upper bounds of |p/q - exact|/exact, exact being the frequency over k, each from rest to a share of the range.

    With p and q in X (``Surrogate.step``) and D = p - q s, |exact - s| <= delta, on each part |p/q - exact|/exact =
    |p - q exact|/|q exact| <= (|D| + delta |q|)/(|q s| - delta |q|).  D, q and q s = p - D are expanded about the
    middle: |D(m + r z)| <= sum |d_i| r^i and |q s| >= |c_0| - sum of the other |c_i| r^i for |z| <= 1.  A part on which
    q may vanish is halved: a finite bound proves that no pole lies in the range.

    Raises InputError when no bound is found.

    >>> from ridgeback.symbolic.enclosure.well import well_of
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> from ridgeback.symbolic.codegen.fit.surrogate import surrogate
    >>> duffing = surrogate(well_of(find("duffing")), Fraction(1, 2))
    >>> [float(e) < 2e-2 for e in largest_error(duffing, [arb(1), arb(3) / 8])]
    [True]
    """
    p, q = (arb_poly([*c])(arb_poly([exact.half, exact.half])) for c in (numerator, denominator))
    found, worst, before = [], arb(0), Fraction(-1)
    for share in shares:
        end = 2 * share**exact.step - 1
        worst = _over(exact.remainder, p, q, p - q * exact.polynomial, (before, end), worst, 8 * len(numerator))
        found.append(upper(worst))
        before = end
    return tuple(found)


def _over(
    remainder: arb,
    p: arb_poly,
    q: arb_poly,
    difference: arb_poly,
    part: tuple[Fraction, Fraction],
    worst: arb,
    count: int,
) -> arb:
    """The larger of ``worst`` and the error over a part of -1 <= t <= 1."""
    left, width = rational(part[0]), rational(part[1] - part[0]) / count
    waiting = [(left + i * width, width) for i in range(count)]
    for _ in range(MOST_BOXES):
        if not waiting:
            return worst
        start, size = waiting.pop()
        box = arb_poly([arb(start + size / 2), arb(size / 2)])
        shifted = difference(box)
        (off, off_rest), (value, value_rest), (below, below_rest) = map(_middle, (shifted, p(box) - shifted, q(box)))
        lost = remainder * (abs(below) + below_rest)
        least = abs(value) - value_rest - lost
        bound = arb(((abs(off) + off_rest + lost) / least).upper())
        small = bound <= SHARP * arb(((abs(off) + lost) / abs(value)).lower())
        if least > 0 and (bound <= worst or small):
            worst = arb(arb.max(worst, bound))
        else:
            waiting += [(start, size / 2), (start + size / 2, size / 2)]
    raise InputError("the error over the range could not be bounded; ask for a lower degree or a shorter range")


def _middle(part: arb_poly) -> tuple[arb, arb]:
    """The value in the middle, and the sum of the sizes of what is added to it."""
    middle, *others = part.coeffs() or [arb(0)]
    return middle, sum(map(abs, others), arb(0))


def rational(value: Fraction) -> fmpq:
    """Python's fraction as FLINT's.

    >>> rational(Fraction(1, 3))
    1/3
    """
    return fmpq(value.numerator, value.denominator)


def balls(values: Sequence[Fraction]) -> list[arb]:
    """Fractions as balls."""
    return [ball(value) for value in values]
