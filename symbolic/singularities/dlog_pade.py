r"""D-log Padé: the poles of a Padé approximant of a logarithmic derivative (Baker, Phys. Rev. 124 (1961) 768).

Near x_c let f = A(x) (1 - x/x_c)^p + B(x) with A, B analytic, or with a logarithm in place of the power when p = 0.
Then f''/f' has at x_c a simple pole of residue p - 1, whatever B is: that is why f' is taken and not f.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from flint import acb_poly, arb, ctx, fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic import truncated
from ridgeback.symbolic.arithmetic.ball_ring import midpoint
from ridgeback.symbolic.arithmetic.rational_function import approximant, zeros
from ridgeback.symbolic.singularities.darboux import Estimate, Point

MOST_TERMS: Final = 25
"""Beyond it exact arithmetic costs more than the whole of ``darboux``, for a second opinion of three digits."""
MOST_BITS: Final = 700
"""Of a coefficient of f''/f': a quotient of irrational coefficients in decimals has fifty times the digits of each."""


def dlog_singularities(series: Sequence[fmpq], first: Estimate) -> Estimate | None:
    """Return the poles of f''/f' next to the places of a first estimate; None when there is no approximant.

    The errors are the changes from the approximant of one degree less, or from the first estimate if that is more.

    >>> from flint import acb
    >>> root = truncated.square_root([fmpq(1), fmpq(-1, 2), *[fmpq(0)] * 8])
    >>> found = dlog_singularities(root, Estimate((Point(acb(2), acb(0.5)),), 0.0, 0.0, 2))
    >>> found.points[0].place.real.contains(2), found.place_error < 1e-9
    (True, True)
    """
    ratio = _ratio(series[:MOST_TERMS])
    degree = len(ratio) // 2
    points, fewer = (_poles(ratio, k, first.points) for k in (degree, degree - 1))
    if not points:
        return None
    pairs = [(p, q) for other in (fewer, first.points) for p, q in zip(points, other, strict=False)]
    return Estimate(
        points,
        max(float(abs((p.place - q.place) / p.place).mid()) for p, q in pairs),
        max(float(abs(p.exponent - q.exponent).mid()) for p, q in pairs),
        degree,
    )


def _ratio(series: Sequence[fmpq]) -> list[fmpq]:
    """f''/f' as a series, f' divided by its first coefficient that is not zero."""
    first = [n * c for n, c in enumerate(series)][1:]
    while first and first[0] == 0:
        first = first[1:]  # a factor x^j of f' changes nothing but adds j/x to its logarithmic derivative
    second = [n * c for n, c in enumerate(first)][1:]
    exact = truncated.multiply([c / first[0] for c in second], truncated.reciprocal([c / first[0] for c in first]))
    return [value if value.q.bit_length() <= MOST_BITS else _short(value) for value in exact]


def _short(value: fmpq) -> fmpq:
    with ctx.workprec(MOST_BITS):
        mantissa, exponent = midpoint(arb(value))
    return fmpq(mantissa) * fmpq(2) ** exponent


def _poles(ratio: list[fmpq], degree: int, near: Sequence[Point]) -> tuple[Point, ...]:
    try:
        numerator, denominator = approximant(ratio, degree - 1, degree)
    except InputError:
        return ()
    poles = zeros(denominator)
    if not poles:
        return ()
    top, slope = acb_poly(list(numerator)), acb_poly(list(denominator)).derivative()
    chosen = [min(poles, key=lambda z: float(abs(z - p.place))) for p in near]
    return tuple(Point(z, 1 + top(z) / slope(z)) for z in chosen)
