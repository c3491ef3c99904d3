r"""The period's integrand F = I(u) / sqrt(q(u)), where V(A) - V(u) = (A - u)(u - B) q(u), and where it is analytic.

With u = middle + half w and w = cos(theta), A - u = 2 half sin(theta/2)^2 and u - B = 2 half cos(theta/2)^2 are not
formed by cancellation, and stay sharp for a ball of theta near an end.  A polynomial q is an exact quotient.  Otherwise
q is the plain quotient away from the ends, and near an end the divided difference in the form of Hermite and Genocchi
(C. de Boor, Divided differences, Surveys in Approximation Theory 1 (2005) 46-69, section 9): with
V[A, u] = (V(A) - V(u)) / (A - u),

    V[A, u] = V'(A) + (u - A) V[A, A, u],     2 V[A, A, u] in the convex hull of V'' over the hull of A and u,

since V[A, A, u] is the integral of V'' over a simplex of area 1/2.  A complex ball is a rectangle, which is convex.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

from flint import acb, acb_poly, arb, arb_poly, ctx

from ridgeback.symbolic.enclosure.turning_points import Orbit, PolynomialOrbit
from ridgeback.symbolic.enclosure.well import Curves, Well, curves


class Integrand(Protocol):
    """F as a function of w in [-1, 1] or of theta with w = cos(theta)."""

    @property
    def even(self) -> bool:
        """Whether F(-w) = F(w)."""

    def values(self, w: list[arb]) -> list[arb]:
        """Balls of F at real points."""

    def on_ball(self, theta: acb, *, analytic: bool) -> acb:
        """A ball of F over theta; not finite when F may fail to be analytic there and ``analytic`` is asked for."""

    def typical(self) -> arb:
        """F at the middle of the orbit, the scale that errors are measured by."""


def integrand_of(well: Well, orbit: Orbit) -> Integrand:
    """The integrand of the orbit at the present precision."""
    if isinstance(orbit, PolynomialOrbit):
        return PolynomialIntegrand(orbit, even=well.even)
    return GeneralIntegrand(well, orbit)


class PolynomialIntegrand:
    """F of a polynomial potential: q in powers of w, from an exact quotient."""

    def __init__(self, orbit: PolynomialOrbit, *, even: bool) -> None:
        self.even = even
        self.q = divided(arb_poly(orbit.quotient), orbit.trough)(arb_poly([orbit.middle, orbit.half]))
        self._complex = acb_poly(self.q)

    def values(self, w: list[arb]) -> list[arb]:
        """Balls of F at real points."""
        return [value.rsqrt() for value in self.q.evaluate(w, algorithm="iter")]

    def on_ball(self, theta: acb, *, analytic: bool) -> acb:
        """A ball of F over theta."""
        return self._complex(theta.cos()).rsqrt(analytic=analytic)

    def typical(self) -> arb:
        """F at w = 0."""
        return self.q[0].rsqrt()


def divided(polynomial: arb_poly, root: arb) -> arb_poly:
    """polynomial / (u - root) for a root, by synthetic division.

    >>> divided(arb_poly([-4, 0, 1]), arb(2)).coeffs() == [2, 1]
    True
    """
    total, coefficients = arb(0), []
    for coefficient in reversed(polynomial.coeffs()):
        total = total * root + coefficient
        coefficients.append(total)
    return arb_poly(coefficients[-2::-1])


class GeneralIntegrand:
    """F of any analytic potential."""

    def __init__(self, well: Well, orbit: Orbit) -> None:
        self.even, self.orbit, self.well = well.even, orbit, well
        self.middle, self.half = orbit.middle, orbit.half
        self._real = curves(well, ctx.prec)
        self.energy = self._real.value(orbit.peak)

    def values(self, w: list[arb]) -> list[arb]:
        """Balls of F at real points, away from the ends."""
        return [self._value(x) for x in w]

    def _value(self, w: arb) -> arb:
        u = self.middle + self.half * w
        q = (self.energy - self._real.value(u)) / (self.half**2 * ((1 - w) * (1 + w)))
        return arb(self._real.inertia(u) * q.rsqrt())

    def on_ball(self, theta: acb, *, analytic: bool) -> acb:
        """A ball of F over theta."""
        ball = self.ball(theta)
        for q in ball.small(self.energy):
            root = q.rsqrt(analytic=analytic)
            if root.is_finite():
                return acb(ball.curves.inertia(ball.u) * root)
        return acb("nan")

    def size(self, theta: acb) -> arb | None:
        """An upper bound of |F| over theta, or None when q may vanish or V, I be singular there."""
        ball = self.ball(theta)
        inertia = ball.curves.inertia(ball.u)
        if not ball.curves.analytic(ball.u).is_finite() or not inertia.is_finite():
            return None
        for q in ball.wide(self.energy):
            if q.is_finite() and q.abs_lower() > 0:
                return arb(inertia.abs_upper() / q.abs_lower().sqrt())
        return None

    def ball(self, theta: acb) -> OrbitBall:
        """The ball of u over theta, with what encloses q there."""
        sine, cosine = (theta / 2).sin_cos()
        fall, rise = 2 * self.half * sine * sine, 2 * self.half * cosine * cosine
        near_peak = theta.real.mid() < arb.pi() / 2
        u = self.orbit.peak - fall if near_peak else self.orbit.trough + rise
        return OrbitBall(curves(self.well, ctx.prec, complex_=True), self.orbit, u, fall, rise, near_peak)

    def typical(self) -> arb:
        """F at w = 0."""
        return self._value(arb(0))


@dataclass(frozen=True)
class OrbitBall:
    """A complex ball of u with its distances from peak and trough, and the ways to enclose q over it.

    Each is finite only if V is analytic on the convex hull that it uses.
    """

    curves: Curves
    orbit: Orbit
    u: acb
    fall: acb
    rise: acb
    near_peak: bool

    def small(self, energy: arb) -> Iterator[acb]:
        """Enclosures of q, the sharpest for a small ball first."""
        area = self.fall * self.rise
        if not area.contains(0):
            yield (energy - self.curves.value(self.u)) / area
            yield (energy - self.centred()) / area
        yield self._from_end()

    def wide(self, energy: arb) -> Iterator[acb]:
        """Enclosures of q, the sharpest for a wide ball first."""
        yield self._flat()
        yield self._from_end()
        area = self.fall * self.rise
        if not area.contains(0):
            yield (energy - self.centred()) / area

    def centred(self) -> acb:
        """V in mean-value form, which is sharp where V' is small, as it is close to a saddle."""
        centre = acb(self.u.mid())
        return acb(self.curves.value(centre) + self.curves.force(self.u) * (self.u - centre))

    def _flat(self) -> acb:
        """V[A, B, u], in half of V'' over the hull of the three."""
        hull = self.u.union(acb(self.orbit.peak)).union(acb(self.orbit.trough))
        return acb(self.curves.slope(hull) / 2)

    def _from_end(self) -> acb:
        """V[A, B, u] from V[A, u] or V[B, u] of the nearer end, since V[A, B] = 0."""
        if self.near_peak:
            return self._divided(self.orbit.peak) / self.rise
        return -self._divided(self.orbit.trough) / self.fall

    def _divided(self, end: arb) -> acb:
        """(V(end) - V(u)) / (end - u), where end and u may coincide."""
        hull = self.u.union(acb(end))
        return acb(self.curves.force(acb(end)) + (self.u - end) * self.curves.slope(hull) / 2)
