r"""The integral of an analytic function from 0 as a function on balls: no closed form is needed.

Round a centre c the function f is bounded by M on the disc |z - c| <= 2 r, by one ball evaluation over the square about
it.  Its Taylor coefficients f_n follow from m values on the circle |z - c| = r (L. N. Trefethen and J. A. C. Weideman,
SIAM Review 56 (2014) 385-458, Theorem 2.1, with Cauchy's |f_n| <= M / (2 r)^n):

    f_n r^n = (1/m) sum_j f(c + r w^j) w^(-j n) + e_n,     w = exp(2 pi i/m),     |e_n| <= M 2^(-n) / (2^m - 1)

and F(u) = F(c) + sum_(n < m) f_n (u - c)^(n+1) / (n + 1) within M |u - c| 2^(-m) for |u - c| <= r.  Such pieces are
laid in a row along the straight line from the nearest known place: a line between two points of a convex region in
which f is analytic stays in it, so that all values belong to one branch.  Over a wide ball u with centre c, F(u) is
enclosed by F(c) + f(u) (u - c).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from flint import acb, acb_poly, arb, ctx, fmpq

from ridgeback.symbolic.enclosure.ball_functions import Ball, Function

MOST_PIECES: Final = 120
"""Pieces after which a place is given up; they grow with their distance from what is singular."""
MOST_HALVINGS: Final = 40
FIRST: Final = 0.5
"""Radius of the disc tried first, in the unit of u."""
REACH: Final = arb(2) / 3
"""Part of the radius that a piece is used in: |Re t| + |Im t| < 1 there, so that Horner's rule does not widen balls."""
STRIDE: Final = arb(5) / 8
"""A piece follows at this part of the radius of the one before."""


@dataclass(frozen=True)
class Piece:
    """F round a centre: ``series`` in (u - centre)/radius without F(centre), and what it may err by there."""

    centre: acb
    value: acb
    radius: arb
    series: acb_poly
    rest: arb

    def at(self, place: acb) -> acb:
        """A ball of F at a place within the radius."""
        t = (place - self.centre) / self.radius
        return self.value + self.series(t) + acb(arb(0, self.rest), arb(0, self.rest))

    def reaches(self, place: acb) -> bool:
        """Whether a place certainly lies where the piece is used."""
        return bool(abs(place - self.centre) <= self.radius * REACH)


class BallIntegral:
    """F(u), the integral of f from 0 to u; ``integrand`` is f on complex balls, not finite where it is not analytic.

    >>> with ctx.workprec(80):
    ...     BallIntegral(lambda z: z.cos())(arb(1)).overlaps(arb(1).sin())
    True
    """

    def __init__(self, integrand: Function) -> None:
        self.integrand = integrand
        self._pieces: list[Piece] = []

    def __call__(self, u: Ball) -> Ball:
        """A ball of F over a real or complex ball; not finite where f is not analytic on it."""
        if isinstance(u, arb):
            return self._on(acb(u)).real
        return self._on(u)

    def _on(self, u: acb) -> acb:
        centre = acb(u.mid())
        value = self._at(centre)
        return value if u.is_exact() else value + self.integrand(u) * (u - centre)

    def _at(self, place: acb) -> acb:
        """F at an exact place, with the pieces on the way to it."""
        while True:
            piece = next((piece for piece in self._pieces if piece.reaches(place)), None)
            if piece is not None:
                return piece.at(place)
            following = self._following(place)
            if following is None:
                return acb("nan")
            self._pieces.append(following)

    def _following(self, place: acb) -> Piece | None:
        if not self._pieces:
            return self._piece(acb(0), acb(0), arb(FIRST))
        if len(self._pieces) >= MOST_PIECES:
            return None
        near = min(self._pieces, key=lambda piece: float((abs(place - piece.centre) - piece.radius).mid()))
        way = place - near.centre
        centre = acb((near.centre + way * (near.radius * STRIDE / abs(way))).mid())
        return self._piece(centre, near.at(centre), 2 * near.radius) if near.reaches(centre) else None

    def _piece(self, centre: acb, value: acb, radius: arb) -> Piece | None:
        """The largest piece round a centre, from a radius tried first."""
        for _ in range(MOST_HALVINGS):
            side = arb(0, 2 * radius)
            bound = self.integrand(acb(centre.real + side, centre.imag + side)).abs_upper()
            if bound.is_finite():
                return self._expanded(centre, value, radius, bound)
            radius = (radius / 2).mid()
        return None

    def _expanded(self, centre: acb, value: acb, radius: arb, bound: arb) -> Piece:
        size = _logarithm(bound)
        count = 2 * ((ctx.prec + max(0, size) + 1) // 2)
        circle = [centre + radius * (acb(fmpq(2 * j, count))).exp_pi_i() for j in range(count)]
        waves = acb.dft([self.integrand(z) for z in circle])
        share = bound / (arb(2) ** count - 1)
        rows = [acb(0)]
        for n, wave in enumerate(waves):
            error = arb(0, (share / arb(2) ** n).upper())
            rows.append((wave / count + acb(error, error)) * radius / (n + 1))
        return Piece(centre, value, radius, acb_poly(rows), (bound * radius / arb(2) ** count).upper())


def _logarithm(bound: arb) -> int:
    """A whole number at or above the binary logarithm of a bound."""
    mantissa, exponent = bound.mid().man_exp() if not bound.is_zero() else (0, 0)
    return int(mantissa).bit_length() + int(exponent)
