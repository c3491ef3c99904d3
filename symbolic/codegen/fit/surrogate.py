r"""omega0/k over a whole range, as a polynomial with a proved remainder.

Of an even potential, f(u) = u g(u^2) and x = A^2 (units with k = 1),

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
from ridgeback.symbolic.codegen.fit.uneven import widest
from ridgeback.symbolic.codegen.number import fraction
from ridgeback.symbolic.enclosure.ball_functions import Function, ball_function
from ridgeback.symbolic.enclosure.enclosure import enclose_in
from ridgeback.symbolic.enclosure.well import Well, curves
from ridgeback.symbolic.grammar.parse import U

GUARD: Final = 92
"""Working precision is the goal, this and two bits a node: in powers of t Chebyshev polynomials cancel, by 1.3 bits a
degree."""
COVER_BITS: Final = 64
GOAL: Final = 100
"""The remainder is below 2^-GOAL."""
RATES: Final = tuple(fmpq(n, 20) for n in (120, 100, 80, 70, 60, 50, 44, 40, 36, 32, 29, 27, 25, 24, 23, 22, 21))
"""Parameters rho of ellipses that are tried, from wide to narrow."""
MOST_BOXES: Final = 4000
FINEST: Final = fmpq(1, 4096)


@dataclass(frozen=True)
class Surrogate:
    """|omega0/k - polynomial(t)| <= remainder for -1 <= t <= 1."""

    end: Fraction
    """The largest amplitude."""
    step: int
    """X = A^step is end^step (1 + t)/2: 2 for an even potential, 1 for another."""
    polynomial: arb_poly
    remainder: arb
    bits: int
    """The precision that work with the polynomial needs."""

    @property
    def half(self) -> arb:
        """Half of the largest X."""
        return ball(self.end) ** self.step / 2


@dataclass(frozen=True)
class Region:
    """An ellipse about the range of X on which omega0/k is analytic, and what bounds it there."""

    step: int
    rate: fmpq
    """rho."""
    bound: arb
    """M."""

    def nodes(self, goal: int) -> int:
        """N with 4 M rho^(1-N)/(rho - 1) < 2^-goal."""
        with ctx.workprec(COVER_BITS):
            digits = (4 * self.bound / (self.rate - 1)).log() + goal * arb(2).log()
            return math.ceil(float((digits / arb(self.rate).log()).upper())) + 2


def region(well: Well, end: Fraction) -> Region:
    """Where omega0/k is analytic around |A| <= end, or 0 <= A <= end where the potential is not even.

    Raises InputError for a force that u' changes, and a range for which no ellipse is found.

    >>> from ridgeback.symbolic.enclosure.well import well_of
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> region(well_of(find("duffing")), Fraction(1)).step, region(well_of(find("toda")), Fraction(1)).step
    (2, 1)
    """
    if well.inertia != 1:
        raise InputError(
            f"{well.name}: the frequency over a whole range is enclosed for forces of u alone; generate the series"
        )
    if well.even:
        return _even_region(well, fmpq(end.numerator, end.denominator) ** 2)
    trough = enclose_in(well, end, bits=COVER_BITS).trough
    with ctx.workprec(COVER_BITS):
        known, last = curves(well, COVER_BITS, complex_=True), fmpq(end.numerator, end.denominator)
        bend = ball_function(well.restoring.diff(U, 2), COVER_BITS, complex_=True)
        found = widest(known, bend, trough.lower().fmpq(), last)
    if found is None:
        raise InputError(_not_enclosed(well, end))
    return Region(1, *found)


def _not_enclosed(well: Well, end: Fraction) -> str:
    return (
        f"{well.name}: the frequency could not be enclosed over the whole range up to A = {float(end):.6g}; give a "
        "shorter one"
    )


def surrogate(well: Well, end: Fraction, *, goal: int = GOAL, found: Region | None = None) -> Surrogate:
    """Enclose omega0/k over the range by a polynomial with a remainder below 2^-goal; errors as for ``region``.

    >>> from ridgeback.symbolic.enclosure.well import well_of
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> found = surrogate(well_of(find("duffing")), Fraction(1))
    >>> bool(found.remainder < 1e-30), found.polynomial.degree() < 60
    (True, True)
    """
    around = found or region(well, end)
    count = around.nodes(goal)
    bits = goal + GUARD + 2 * count
    with ctx.workprec(bits):
        values, nodes = _values(well, end, around, count)
        remainder = 4 * around.bound * arb(around.rate) ** (1 - count) / (around.rate - 1)
        return Surrogate(end, around.step, _interpolant(values, nodes), arb(remainder.upper()), bits)


def _even_region(well: Well, square: fmpq) -> Region:
    """The widest ellipse of those tried on which Re g > 0, and the bound M there."""
    with ctx.workprec(COVER_BITS):
        found = curves(well, COVER_BITS, complex_=True)
        for rate in RATES:
            largest = _largest(found.force, found.slope, square, rate)
            if largest is not None:
                return Region(2, rate, (2 * largest).sqrt())
    raise InputError(_not_enclosed(well, Fraction(float(fraction(square)) ** 0.5)))


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


def _values(well: Well, end: Fraction, around: Region, count: int) -> tuple[list[arb], list[arb]]:
    """omega0/k at the Chebyshev points t_j, from amplitudes next to theirs, and the angles' cosines."""
    half = ball(end) ** around.step / 2
    distance = half * ((around.rate + 1 / around.rate) / 2 - 1)
    bits = ctx.prec - GUARD // 2
    k = enclose_in(well, 0, bits=bits).omega
    values, nodes = [], []
    for j in range(count):
        t = arb.cos_pi_fmpq(fmpq(2 * j + 1, 2 * count))
        x = half * (1 + t)
        amplitude = fraction((x.sqrt() if around.step == 2 else x).mid().fmpq())
        moved = abs(ball(amplitude) ** around.step - x) * around.bound / distance  # |f'| <= M/distance, by Cauchy
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
