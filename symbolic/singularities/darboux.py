r"""Where a power series is singular, read off its last coefficients.

Darboux: a singularity (1 - x/x_c)^p, or with p = 0, 1, ... its logarithm, adds to c_n a term n^(-1-p) x_c^(-n) times a
series in 1/n, and the nearest singularities dominate.  When there are m of them, the coefficients obey

    c_n + sum_(j=1..m) (b_j0 + b_j1/n + ... + b_j(K-1)/n^(K-1)) c_(n-j) = 0

up to O(n^-K), for the m terms are independent solutions of such a recurrence.  Fitted to m K successive n,

* m = 1, K = 1 is the ratio test, K = 2 the line of Domb and Sykes (Proc. R. Soc. London A 240 (1957) 214), K > 2 its
  Neville table;
* m = 2, K = 1 is the three-term ratio of Mercer and Roberts (SIAM J. Appl. Math. 50 (1990) 1547), K > 1 its
  extrapolation, for a complex pair.

The singularities are the zeros of 1 + sum_j b_j0 x^j, and the first correction gives their exponents:

    -1 - p = sum_j b_j1 x_c^j / sum_j j b_j0 x_c^j.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Final

from flint import acb, arb, arb_mat, ctx, fmpq

HIGHEST_DEGREE: Final = 14
"""Most unknowns fitted; beyond this the next singularities, not the powers of 1/n, limit the estimate (empirical)."""

_SCATTER: Final = 5
_SCATTERED_ROWS: Final = range(1, 7)
"""Weight of the changes over the last rows, about which further singularities make the estimate swing (empirical)."""

_TAIL: Final = 3
"""Weight of the change since 3/4 of the terms: an error that falls only like 1/n is three times that change."""

_NARROW: Final = arb(2) ** -52
"""Widest ball of a place or an exponent, relative, that is still used: coefficients that are balls may not suffice."""


@dataclass(frozen=True)
class Point:
    """A singularity (1 - x/place)^exponent; both numbers are midpoints, without an error of their own."""

    place: acb
    exponent: acb


@dataclass(frozen=True)
class Estimate:
    """The nearest singularities of a series, with the errors seen in the estimates that led to them."""

    points: tuple[Point, ...]
    place_error: float
    """Relative error of the places; for a complex place also the error of its argument in rad."""
    exponent_error: float
    degree: int
    """K, the number of powers of 1/n fitted."""


def nearest_singularities(coefficients: Sequence[fmpq | arb], count: int) -> Estimate | None:
    """Estimate the ``count`` (1 or 2) nearest singularities; None when no fit exists, as with too few terms.

    Among the fits with K = 2, 3, ... the one whose place is least uncertain is taken.

    >>> found = nearest_singularities([fmpq(3, 4**n * (n + 1)) for n in range(20)], 1)
    >>> found.points[0].place.real.str(6, radius=False), abs(float(found.points[0].exponent.real)) < 1e-9
    ('4.00000', True)
    """
    highest = HIGHEST_DEGREE // count
    with ctx.workprec(256 + 32 * HIGHEST_DEGREE):
        values = [arb(c) for c in coefficients]
        fit = cache(lambda degree, last: _fit(values, count, degree, last))
        found = [e for degree in range(2, highest + 1) if (e := _estimate(fit, degree, len(values) - 1))]
    return min(found, key=lambda e: e.place_error, default=None)


def _estimate(fit: Callable[[int, int], tuple[Point, ...]], degree: int, last: int) -> Estimate | None:
    """Fit with K = degree to the last terms, and judge it by K - 1, by earlier last terms and by 3/4 of the terms."""
    best = fit(degree, last)
    scattered = [(degree, last - i, _SCATTER) for i in _SCATTERED_ROWS]
    rows = [(degree - 1, last, 1), *scattered, (degree, last - last // 4, _TAIL)]
    others = [(fit(k, row), weight) for k, row, weight in rows]
    if not best or not all(points for points, _ in others):
        return None
    changes = [[weight * change for change in _change(best, points)] for points, weight in others]
    place, exponent = (max(column) for column in zip(*changes, strict=True))
    return Estimate(best, place, exponent, degree)


def _change(best: tuple[Point, ...], other: tuple[Point, ...]) -> tuple[float, float]:
    """The largest change of a place, relative, and of an exponent, each point against the nearest of the others."""
    pairs = [(p, min(other, key=lambda q: float(abs(q.place - p.place)))) for p in best]
    return (
        max(float(abs(p.place - q.place) / abs(p.place)) for p, q in pairs),
        max(float(abs(p.exponent - q.exponent)) for p, q in pairs),
    )


def _fit(c: Sequence[arb], count: int, degree: int, last: int) -> tuple[Point, ...]:
    """Solve for the b_jk from the rows n = last - count * degree + 1, ..., last; empty when that cannot be done."""
    rows = range(last - count * degree + 1, last + 1)
    if rows.start < count:
        return ()
    left = [[c[n - j] / arb(n) ** k for j in range(1, count + 1) for k in range(degree)] for n in rows]
    try:
        solved = arb_mat(left).solve(arb_mat([[-c[n]] for n in rows]))
    except ZeroDivisionError:
        return ()
    values = [solved[i, 0] for i in range(count * degree)]
    return _points([values[j * degree : (j + 1) * degree] for j in range(count)])


def _points(b: list[list[arb]]) -> tuple[Point, ...]:
    """The zeros of 1 + sum_j b_j0 x^j with their exponents, nearest first; empty when a zero runs to infinity."""
    powers = range(1, len(b) + 1)
    points = []
    for x in _zeros([row[0] for row in b]):
        slope = sum((j * b[j - 1][0] * x**j for j in powers), acb(0))
        first = sum((b[j - 1][1] * x**j for j in powers), acb(0)) if len(b[0]) > 1 else acb(0)
        exponent = -1 - first / slope
        if _narrow(x, x) and _narrow(exponent, acb(1)):
            points.append(Point(_midpoint(x), _midpoint(exponent)))
    usable = points if len(points) == len(b) else []
    return tuple(sorted(usable, key=lambda p: float(abs(p.place))))


def _narrow(z: acb, scale: acb) -> bool:
    """Whether a ball is so narrow that its radius does not count beside the rounding to a float."""
    size = abs(scale).abs_lower()
    return bool(z.is_finite() and size > 0 and z.real.rad() <= _NARROW * size and z.imag.rad() <= _NARROW * size)


def _zeros(b: list[arb]) -> list[acb]:
    if len(b) == 1:
        return [acb(-1 / b[0])]
    root = acb(b[0] ** 2 - 4 * b[1]).sqrt()  # x = 2 / (-b_1 +- root), the form without cancellation at infinity
    return [2 / (-b[0] - root), 2 / (-b[0] + root)]


def _midpoint(z: acb) -> acb:
    return acb(z.real.mid(), z.imag.mid())
