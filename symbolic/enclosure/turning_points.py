r"""Certified turning points: peak A and trough B < 0 < A with V(B) = V(A), and no equilibrium but 0 between them.

Polynomial potentials: V(A) - V(u) = (A - u) P(u) with P exact, B is the largest negative root of P, and the barriers
are the roots of V'; FLINT isolates all complex roots with proof, and a shared root is told by an exact gcd.  Others:
walks with interval tests (``walk``).  An even potential has B = -A without any search.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Final

from flint import acb, arb, ctx, fmpq, fmpq_poly

from ridgeback.symbolic.enclosure.walk import UndecidedError, level, walk
from ridgeback.symbolic.enclosure.well import Curves, Well, curves

REACH: Final = 2**20
"""How far from the origin walks along a force that is not a polynomial go, in the unit of u."""


@dataclass(frozen=True)
class Orbit:
    """The closed orbit through a peak, in balls: B <= u <= A."""

    peak: arb
    trough: arb

    @property
    def middle(self) -> arb:
        """Half-way between the turning points."""
        return (self.peak + self.trough) / 2

    @property
    def half(self) -> arb:
        """Half the distance of the turning points."""
        return (self.peak - self.trough) / 2


@dataclass(frozen=True)
class PolynomialOrbit(Orbit):
    """The same for a polynomial potential, with (V(A) - V(u)) / (A - u) exactly."""

    quotient: fmpq_poly


def orbit(well: Well, peak: fmpq, bits: int) -> Orbit | None:
    """The orbit through u = peak > 0 at rest; None when it is at or beyond a separatrix, or nothing turns it back.

    Raises UndecidedError when ``bits`` do not tell.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> from ridgeback.symbolic.enclosure.well import well_of
    >>> orbit(well_of(find("pendulum")), fmpq(1), 64).trough == -1
    True
    >>> orbit(well_of(find("pendulum")), fmpq(22, 7), 64) is None
    True
    """
    with ctx.workprec(bits):
        if well.polynomial is not None:
            return _polynomial_orbit(well, well.polynomial, peak, bits)
        return _general_orbit(well, curves(well, bits), peak)


@lru_cache(maxsize=256)
def equilibria(well: Well, bits: int) -> tuple[arb | None, arb | None]:
    """The equilibria next to u = 0 of a polynomial potential, left and right; None: there is none on that side.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> from ridgeback.symbolic.enclosure.well import well_of
    >>> [float(place) for place in equilibria(well_of(find("duffing-softening")), 64)]
    [-1.0, 1.0]
    """
    if well.polynomial is None:
        return None, None
    with ctx.workprec(bits):
        real = real_roots(well.polynomial.derivative())
        left, right = [r for r in real if r < 0], [r for r in real if r > 0]
        return (max(left) if left else None), (min(right) if right else None)


def real_roots(polynomial: fmpq_poly) -> list[arb]:
    """Return the distinct real roots of a polynomial.

    Parameters
    ----------
    polynomial : fmpq_poly
        With exact coefficients.

    Returns
    -------
    list of arb
        Disjoint balls, in rising order.

    Examples
    --------
    >>> [float(r) for r in real_roots(fmpq_poly([0, -4, 0, 1]))]
    [-2.0, 0.0, 2.0]
    """
    return sorted(z.real for z, _ in complex_roots(polynomial) if z.imag.is_zero())


def complex_roots(polynomial: fmpq_poly) -> list[tuple[acb, int]]:
    """All roots with their multiplicities, as disjoint balls; real ones have an imaginary part of exactly 0.

    >>> complex_roots(fmpq_poly([0, 0, 1]))
    [(0, 2)]
    """
    found: Any = polynomial.complex_roots()  # a list of pairs, which its annotation does not say
    return [(acb(z), int(count)) for z, count in found]


def _polynomial_orbit(well: Well, potential: fmpq_poly, peak: fmpq, bits: int) -> Orbit | None:
    left, right = equilibria(well, bits)
    if right is not None and not _below(arb(peak), right, potential.derivative()(peak) == 0):
        return None
    quotient = (potential(peak) - potential) / fmpq_poly([peak, -1])
    if well.even:
        return PolynomialOrbit(arb(peak), -arb(peak), quotient)
    negative = [root for root in real_roots(quotient) if root < 0]
    if not negative:
        return None
    trough = max(negative)
    if left is not None and not _below(left, trough, _meets(quotient, potential.derivative(), left)):
        return None
    return PolynomialOrbit(arb(peak), trough, quotient)


def _below(low: arb, high: arb, equal: bool) -> bool:
    """Whether low < high, given whether they are known to be equal."""
    if equal:
        return False
    if low.overlaps(high):
        raise UndecidedError
    return bool(low < high)


def _meets(quotient: fmpq_poly, force: fmpq_poly, equilibrium: arb) -> bool:
    """Whether the equilibrium lies exactly at the energy of the orbit."""
    common = quotient.gcd(force)
    return common.degree() > 0 and any(r.overlaps(equilibrium) for r in real_roots(common))


def _general_orbit(well: Well, forward: Curves, peak: fmpq) -> Orbit | None:
    A = arb(peak)
    found = walk(forward.force, forward.slope, step=A / 2, stop=_never, last=A)
    if found.end in ("undecided", "exhausted"):
        raise UndecidedError
    if found.end != "stopped":
        return None
    if well.even:
        return Orbit(A, -A)
    back = reflected(forward)
    depth = level(back.value, back.force, back.slope, forward.value(A), step=A / 2, last=arb(REACH))
    return None if depth is None else Orbit(A, -depth)


def reflected(forward: Curves) -> Curves:
    """The curves of the mirrored well.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> from ridgeback.symbolic.enclosure.well import well_of
    >>> reflected(curves(well_of(find("helmholtz")), 64)).force(arb(2)) == 6
    True
    """
    return Curves(
        value=lambda u: forward.value(-u),
        force=lambda u: -forward.force(-u),
        slope=lambda u: forward.slope(-u),
        inertia=lambda u: forward.inertia(-u),
        analytic=lambda u: forward.analytic(-u),
    )


def _never(_: arb, __: arb) -> bool:
    return False
