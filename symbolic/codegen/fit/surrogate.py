r"""omega0/k of an even potential over a whole range, as a polynomial with a proved remainder.

With f(u) = u g(u^2) and x = A^2 (units with k = 1),

    omega0(x) = 1 / mean_theta (2 Q)^(-1/2),      2 Q = mean of g(y) over the segment from x cos^2(theta) to x,

because V(A) - V(A s) is the integral of f.  Where Re g > 0 on a convex set that holds 0, so is Re 2Q there; then the
principal root is analytic, Re (2Q)^(-1/2) >= (2 L)^(-1/2) with L = max |g|, and |omega0| <= M = sqrt(2 L).  If that
holds on the ellipse with foci 0 and X and parameter rho, the polynomial through N Chebyshev points of [0, X] errs by at
most 4 M rho^(1-N)/(rho - 1) (L. N. Trefethen, Approximation Theory and Approximation Practice, SIAM, 2013, th. 8.2).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import Final

from flint import acb, arb, arb_poly, ctx, fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import ball
from ridgeback.symbolic.codegen.number import fraction
from ridgeback.symbolic.enclosure.ball_functions import Function
from ridgeback.symbolic.enclosure.enclosure import enclose_in
from ridgeback.symbolic.enclosure.well import Well, curves

GUARD: Final = 192
"""Working precision is this plus two bits a node: in powers of t Chebyshev polynomials cancel, by 1.3 bits a degree."""
COVER_BITS: Final = 64
GOAL: Final = 100
"""The remainder is below 2^-GOAL."""
RATES: Final = tuple(fmpq(n, 20) for n in (120, 100, 80, 70, 60, 50, 44, 40, 36, 32, 29, 27, 25, 24, 23, 22, 21))
"""Parameters rho of ellipses that are tried, from wide to narrow."""
MOST_BOXES: Final = 4000
FINEST: Final = fmpq(1, 4096)


@dataclass(frozen=True)
class Surrogate:
    """|omega0/k - polynomial(t)| <= remainder for A^2 = X (1 + t)/2, -1 <= t <= 1."""

    end: Fraction
    """The largest amplitude; X is its square."""
    polynomial: arb_poly
    remainder: arb
    nodes: int

    @property
    def bits(self) -> int:
        """The precision that work with the polynomial needs."""
        return GUARD + 2 * self.nodes


def surrogate(well: Well, end: Fraction) -> Surrogate:
    """Enclose omega0/k for |A| <= end.

    Raises InputError for a potential that is not even, a force that u' changes, and a range of which no ellipse is
    found on which Re g > 0.

    >>> from ridgeback.symbolic.enclosure.well import well_of
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> found = surrogate(well_of(find("duffing")), Fraction(1))
    >>> bool(found.remainder < 1e-30), found.nodes < 60
    (True, True)
    """
    if not well.even or well.inertia != 1:
        raise InputError(f"{well.name}: a fit is proved for even potentials of u alone; generate the series instead")
    square = fmpq(end.numerator, end.denominator) ** 2
    rate, bound = _ellipse(well, square)
    count = _nodes(rate, bound)
    with ctx.workprec(GUARD + 2 * count):
        values, nodes = _values(well, square, count, rate, bound)
        remainder = 4 * bound * arb(rate) ** (1 - count) / (rate - 1)
        return Surrogate(end, _interpolant(values, nodes), arb(remainder.upper()), count)


def _nodes(rate: fmpq, bound: arb) -> int:
    """N with 4 M rho^(1-N)/(rho - 1) < 2^-GOAL."""
    with ctx.workprec(COVER_BITS):
        digits = (4 * bound / (rate - 1)).log() + GOAL * arb(2).log()
        return math.ceil(float((digits / arb(rate).log()).upper())) + 2


def _ellipse(well: Well, square: fmpq) -> tuple[fmpq, arb]:
    """The widest ellipse of those tried on which Re g > 0, and the bound M there."""
    with ctx.workprec(COVER_BITS):
        found = curves(well, COVER_BITS, complex_=True)
        for rate in RATES:
            largest = _largest(found.force, found.slope, square, rate)
            if largest is not None:
                return rate, (2 * largest).sqrt()
    raise InputError(
        f"{well.name}: the frequency could not be enclosed over the whole range up to A = "
        f"{float(fraction(square)) ** 0.5:.6g}; give a shorter one"
    )


def _largest(force: Function, slope: Function, square: fmpq, rate: fmpq) -> arb | None:
    """max |g| over boxes that cover the upper half of the ellipse, or None where Re g > 0 is not shown.

    The lower half is its mirror image, g being real on the real axis.
    """
    half = square / 2
    wide, high = half * (rate + 1 / rate) / 2, half * (rate - 1 / rate) / 2
    waiting = [(half - wide, half + wide, fmpq(0), high)]
    largest, seen = arb(0), 0
    while waiting:
        left, right, low, top = waiting.pop()
        seen += 1
        if _outside(left - half, right - half, low, wide, high):
            continue
        values = _g(force, slope, acb(arb(left).union(arb(right)), arb(low).union(arb(top))))
        if values.is_finite() and values.real > 0:
            largest = arb(arb.max(largest, arb(abs(values).upper())))
        elif seen > MOST_BOXES or right - left < FINEST * wide:
            return None
        else:
            middle, level = (left + right) / 2, (low + top) / 2
            waiting += [(left, middle, low, level), (middle, right, low, level)]
            waiting += [(left, middle, level, top), (middle, right, level, top)]
    return largest


def _outside(left: fmpq, right: fmpq, low: fmpq, wide: fmpq, high: fmpq) -> bool:
    """Whether a box in the upper half plane has no point of the ellipse about 0."""
    nearest = left if left > 0 else -right if right < 0 else fmpq(0)
    return bool((nearest / wide) ** 2 + (low / high) ** 2 > 1)


def _g(force: Function, slope: Function, y: acb) -> acb:
    """g on a box: f(u)/u at u^2 = y, and around 0 the mean of f' over the segment from 0 to u."""
    size = arb(abs(y)).upper()
    if y.contains(acb(0)):
        reach = arb(0, size.sqrt().upper())
        return acb(slope(acb(reach, reach)))
    u = y.sqrt() if y.real > 0 or not y.imag.contains(0) else acb(0, 1) * (-y).sqrt()
    return acb(force(u)) / u


def _values(well: Well, square: fmpq, count: int, rate: fmpq, bound: arb) -> tuple[list[arb], list[arb]]:
    """omega0/k at the Chebyshev points t_j, from amplitudes next to theirs, and the angles' cosines."""
    half = arb(square) / 2
    distance = half * ((rate + 1 / rate) / 2 - 1)
    bits = ctx.prec - GUARD // 3
    k = enclose_in(well, 0, bits=bits).omega
    values, nodes = [], []
    for j in range(count):
        t = arb.cos_pi_fmpq(fmpq(2 * j + 1, 2 * count))
        x = half * (1 + t)
        amplitude = fraction(x.sqrt().mid().fmpq())
        moved = abs(ball(amplitude) ** 2 - x) * bound / distance  # |f'| <= M/distance by Cauchy's estimate
        omega = enclose_in(well, amplitude, bits=bits).omega / k
        values.append(omega + arb(0, moved.upper()))
        nodes.append(t)
    return values, nodes


def _interpolant(values: list[arb], nodes: list[arb]) -> arb_poly:
    """The polynomial in t through the values at the Chebyshev points, from its Chebyshev coefficients."""
    count, total = len(values), arb_poly([0])
    before, here, t = arb_poly([1]), arb_poly([0, 1]), arb_poly([0, 1])
    for n in range(count):
        angle = [arb.cos_pi_fmpq(fmpq(n * (2 * j + 1), 2 * count)) for j in range(count)]
        weighted = sum((v * c for v, c in zip(values, angle, strict=True)), arb(0))
        share = weighted * (1 if n == 0 else 2) / count
        total += arb_poly([share]) * before
        before, here = here, 2 * t * here - before
    assert len(nodes) == count  # noqa: S101 - one value for each point
    return total
