r"""One step of a validated Taylor method: a polynomial, and a proof of how far the motion may be from it.

Let p be a polynomial of degree N with p(0) = u_0, p'(0) = v_0, whose coefficients cancel those of p'' + f(p, p') up to
rounding.  On |t| <= r, a circle on which p stays within a complex box where f is analytic and |f| <= M, Cauchy's
estimate bounds the coefficients of f(p, p') by M/r^n, so that on [0, h], h < r, the defect is at most

    d = sum_{n <= N-2} |d_n| h^n + M (h/r)^(N-1) / (1 - h/r).

A motion that starts within e_0 of p differs from it by e(t) <= (e_0 + d t/s) exp(m t) in the norm
max(|u|, |u'|/s), with m the logarithmic norm of the Jacobian over a tube about p that e does not leave:
m = max(s, |f_u|/s - f_v).  Where m is bounded piece by piece, m t is the sum over the pieces.

T. Ström, On logarithmic norms, SIAM J. Numer. Anal. 12 (1975) 741-753; E. Hairer, S. P. Nørsett and G. Wanner, Solving
Ordinary Differential Equations I, Springer, 1993, theorem I.10.6; step and order after À. Jorba and M. Zou,
Experimental Mathematics 14 (2005) 99-117.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

from flint import acb, arb, arb_poly

from ridgeback.common.recurrences import Element, Input
from ridgeback.symbolic.cycles.field import BALLS, Field
from ridgeback.symbolic.enclosure.walk import UndecidedError

OUTER: Final = 0.65
"""The circle of Cauchy's estimate, as a part of the radius of convergence read off the last coefficients."""
INNER: Final = 0.15
"""The longest step, likewise."""
TRIES: Final = 30
PIECES: Final = 8
"""Of a step, on each of which the logarithmic norm is bounded: half of the bits that one bound for all would lose."""
UNITS: Final = 64.0
"""How far the unit of u' may depart from that of the field, up and down."""
PATIENCE: Final = 8
"""Steps within which a change of the unit must pay."""


@dataclass(frozen=True)
class Step:
    """u = p(t) for 0 <= t <= length, and how the distance of a motion from it grows.

    Parameters
    ----------
    u, v : arb_poly
        p and its derivative; the coefficients of p are exact.
    length : arb
        Exact.
    unit : arb
        s, the velocity per unit of u in which u' is weighed here.
    factor, added : arb
        A motion within e of p at the start is within factor * e + added of it throughout, in the norm
        max(|u|, |u'|/unit), provided that this is less than ``tube``.
    tube : arb
        Up to which the Jacobian was looked at.
    circle : arb
        Radius of the circle of Cauchy's estimate.
    """

    u: arb_poly
    v: arb_poly
    length: arb
    unit: arb
    factor: arb
    added: arb
    tube: arb
    circle: arb

    def end(self) -> tuple[arb, arb]:
        """The polynomial and its derivative at the end of the step, in balls of their rounding."""
        return self.u(self.length), self.v(self.length)


def step_from(field: Field, u0: arb, v0: arb, *, unit: arb, degree: int, error: arb, longest: float = math.inf) -> Step:
    """Make a step from an exact state whose neighbours within ``error`` are wanted, too.

    Parameters
    ----------
    field : Field
        The equation.
    u0, v0 : arb
        Exact.
    unit : arb
        Of the norm in which ``error`` is given; the step may choose another.
    degree : int
        N, of the polynomial.
    error : arb
        The distance, in the norm of ``Step``, up to which the step must hold.
    longest : float, optional
        The step is no longer than this.

    Returns
    -------
    Step
        As long as the coefficients let it be.

    Raises
    ------
    UndecidedError
        Where balls of this precision cannot bound the motion.

    Examples
    --------
    >>> from flint import ctx
    >>> from ridgeback.symbolic.cycles.field import field_of
    >>> from ridgeback.symbolic.systems.oscillator import U
    >>> with ctx.workprec(80):
    ...     step = step_from(field_of(U, arb(1)), arb(1), arb(0), unit=arb(1), degree=30, error=arb("1e-20"))
    ...     bool(abs(step.end()[0] - step.length.cos()) < step.added)
    True
    """
    u, defects = _polynomial(field, u0, v0, degree)
    p = arb_poly(u)
    radius = convergence_radius(u)
    length = arb(_short(min(INNER * radius, longest)))
    best = _best_unit(field, u0, v0, unit, float(length))
    error = error * changed(unit, best)
    for _ in range(TRIES):
        made = _bounded(field, p, defects, length, arb(_short(OUTER * radius)), error, best)
        if made is not None:
            return made
        length, radius = length / 2, radius * 0.75
    raise UndecidedError


def changed(before: arb, after: arb) -> arb:
    """By how much a distance may grow when u' is weighed in another unit.

    >>> changed(arb(2), arb(1)), changed(arb(1), arb(2))
    (2.00000000000000, 1.00000000000000)
    """
    return arb.max(arb(1), before / after).upper()


def _best_unit(field: Field, u: arb, v: arb, unit: arb, length: float) -> arb:
    """The unit with the least logarithmic norm here, s^2 + f_u' s = |f_u|, if the change pays within a few steps."""
    pull, loss, old = (float(x.mid()) for x in (abs(field.slope_u(u, v)), field.slope_v(u, v), unit))
    if not (math.isfinite(pull) and math.isfinite(loss)):
        raise UndecidedError
    best = (math.sqrt(loss * loss + 4 * pull) - loss) / 2
    low, high = (float(field.unit.mid()) * factor for factor in (1 / UNITS, UNITS))
    best = min(max(best, low), high)
    gain = (max(old, pull / old - loss) - max(best, pull / best - loss)) * length * PATIENCE
    return arb(_short(best)) if gain > math.log(max(1.0, old / best)) else unit


def _polynomial(field: Field, u0: arb, v0: arb, degree: int) -> tuple[list[arb], list[arb]]:
    """Exact coefficients of p, and balls of the lower coefficients of its defect p'' + f(p, p')."""
    u, v = Input(BALLS, [u0]), Input(BALLS, [v0])
    force = field.node(field.force, u, v)
    defects = []
    u.known.append(v0)
    for n in range(degree - 1):
        ball = force.get(n)
        following = BALLS.scale(ball, -1, (n + 1) * (n + 2)).mid()
        u.known.append(following)
        v.known.append(following * (n + 2))
        defects.append(following * ((n + 1) * (n + 2)) + ball)
    if not all(c.is_finite() for c in u.known[-2:]):
        raise UndecidedError
    return u.known, defects


def convergence_radius(coefficients: Sequence[Element]) -> float:
    """The radius of convergence read off the last two coefficients, against the size of the first two.

    >>> round(convergence_radius([arb(2) ** -n for n in range(20)]), 3)
    2.0
    """
    size = max(map(_log2, coefficients[:2]))
    last = [(n, _log2(c)) for n, c in enumerate(coefficients)][-2:]
    return float(min(2.0 ** min((size - x) / n, 40.0) for n, x in last))


def _log2(x: arb) -> float:
    """The binary logarithm of a size; -10000 for 0."""
    if abs(x).upper() <= 0:
        return -10000.0
    mantissa, exponent = abs(x).upper().man_exp()
    return math.log2(int(mantissa)) + int(exponent)


def _short(x: float) -> float:
    """A number next to x of a few bits, so that sums of steps stay exact."""
    mantissa, exponent = math.frexp(x)
    return math.ldexp(math.floor(mantissa * 256), exponent - 8)


def _bounded(
    field: Field, p: arb_poly, defects: list[arb], length: arb, circle: arb, error: arb, unit: arb
) -> Step | None:
    """The step of this length; None where f is not known to be analytic or the motion leaves the tube."""
    v = p.derivative()
    size = abs(field.complex_value(disc(p, circle), disc(v, circle)))
    if not size.is_finite():
        return None
    ratio = length / circle
    tail = size.upper() * ratio ** len(defects) / (1 - ratio)
    defect = _size_at(defects, length) + tail
    tube = (4 * error + defect).upper()
    for _ in range(TRIES):
        parted = _parted(field, p, v, length, tube, unit)
        if not parted.is_finite():
            return None
        factor = parted.exp().upper()
        added = (defect * length / unit * factor).upper()
        if factor * error + added < tube:
            return Step(p, v, length, unit, factor, added, tube, circle)
        if factor > 1e6:
            return None
        tube = (2 * (factor * error + added)).upper()
    return None


def _parted(field: Field, p: arb_poly, v: arb_poly, length: arb, tube: arb, unit: arb) -> arb:
    """The integral of the logarithmic norm over a step, from above: by pieces, on each of which its ball is small."""
    slack, steep = arb(0, tube), arb(0, (tube * unit).upper())
    places = [*((length * n / PIECES).mid() for n in range(PIECES)), length]
    parted = arb(0)
    for start, end in pairwise(places):
        rate = _rate(field, over(p, start, end) + slack, over(v, start, end) + steep, unit)
        parted += rate * (end - start)
    return arb(parted.upper())


def _rate(field: Field, u: arb, v: arb, unit: arb) -> arb:
    """The logarithmic norm of the Jacobian over a box, from above."""
    along = abs(field.slope_u(u, v)) / unit - field.slope_v(u, v)
    return arb.max(along.upper(), unit)


def disc(p: arb_poly, radius: arb) -> acb:
    """A complex box that holds p(t) for |t| <= radius.

    >>> disc(arb_poly([1, 1]), arb(1)).contains(acb(1, 1))
    True
    """
    first, *rest = p.coeffs() or [arb(0)]
    spread = (_size_at(rest, radius) * radius).upper()
    return acb(first + arb(0, spread), arb(0, spread))


def _size_at(coefficients: Sequence[arb], t: arb) -> arb:
    """sum |c_n| t^n from above."""
    return arb_poly([abs(c).upper() for c in coefficients])(t).upper() if coefficients else arb(0)


def within(p: arb_poly, length: arb, error: arb) -> arb:
    """A ball that holds p(t) for 0 <= t <= length and whatever is within ``error`` of it.

    >>> ball = within(arb_poly([0, 1]), arb(1), arb(1))
    >>> ball.contains(2), ball.contains(-1)
    (True, True)
    """
    return over(p, arb(0), length) + arb(0, error.upper())


def over(p: arb_poly, start: arb, end: arb) -> arb:
    """A ball that holds p(t) for start <= t <= end."""
    return p(start.union(end))
