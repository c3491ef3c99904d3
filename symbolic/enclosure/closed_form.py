r"""omega0 in closed form, by the arithmetic-geometric mean M, for the two families that have one (units with k = 1).

A third one, potentials of a single power, is in ``power_law``.

Pendulum type, force sin(c u)/c:  omega0 = M(1, cos(c A / 2)).

Quartic potentials (Duffing, Helmholtz-Duffing and all that lie between): with V(A) - V(u) = (A - u)(u - B) Q(u),
P^2 = Q(A), R^2 = Q(B) and q the coefficient of u^2 in Q,

    omega0 = sqrt(2) M( sqrt(P R), sqrt((P + R)^2 - q (A - B)^2) / 2 ),

because T = sqrt(2) * integral of du / sqrt((A - u)(u - B) Q(u)) is 2 sqrt(2) R_F(0, x^2, y^2) with x y = P R and
(x + y)^2 = (P + R)^2 - q (A - B)^2 (DLMF 19.29.4, complete case), R_F(0, x^2, y^2) = pi / (2 M(x, y)) (DLMF 19.22.8)
and M(x, y) = M(sqrt(x y), (x + y)/2).  Dividing V(A) - V(u) by its factors and setting u = A, u = B gives
Q(A) = V'(A)/(A - B) and Q(B) = -V'(B)/(A - B).  Duffing: omega0 = M(sqrt(1 + eps A^2 / 2), sqrt(1 + eps A^2)).
"""

from __future__ import annotations

from flint import arb, fmpq, fmpq_poly

from ridgeback.symbolic.arithmetic.balls import polynomial_at, rational
from ridgeback.symbolic.enclosure.power_law import power_law
from ridgeback.symbolic.enclosure.turning_points import Orbit
from ridgeback.symbolic.enclosure.well import Well
from ridgeback.symbolic.systems.elliptic import sine_force


def closed_form(well: Well, orbit: Orbit) -> arb | None:
    """omega0/k of the orbit at the present precision, or None when the well is of neither family.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> from ridgeback.symbolic.enclosure.turning_points import orbit
    >>> from ridgeback.symbolic.enclosure.well import well_of
    >>> duffing = well_of(find("duffing"))
    >>> closed_form(duffing, orbit(duffing, fmpq(1), 53)).str(12, radius=False)
    '1.31777606497'
    """
    if well.polynomial is not None:
        law = power_law(well.polynomial) if well.polynomial.degree() > 4 else None
        if law is not None:
            return law.frequency(orbit.peak)
        return quartic(well.polynomial, orbit) if well.polynomial.degree() <= 4 else None
    rate = pendulum_rate(well)
    return None if rate is None else pendulum(rate, orbit.peak)


def pendulum_rate(well: Well) -> fmpq | None:
    """c when the force is sin(c u)/c with a rational c, else None.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> from ridgeback.symbolic.enclosure.well import well_of
    >>> pendulum_rate(well_of(find("pendulum")))
    1
    """
    sine = sine_force(well.restoring) if well.inertia == 1 else None
    rational_rate = sine is not None and sine.rate.is_Rational and sine.rate * sine.factor == 1
    return rational(sine.rate) if sine is not None and rational_rate else None


def pendulum(rate: fmpq, peak: arb) -> arb:
    """M(1, cos(c A / 2)).

    >>> pendulum(fmpq(1), arb(0)) == 1
    True
    """
    return arb(1).agm((peak * rate / 2).cos())


def quartic(potential: fmpq_poly, orbit: Orbit) -> arb:
    """The formula for potentials of degree at most four, between certified turning points."""
    force, width = potential.derivative(), orbit.peak - orbit.trough
    at_peak = (polynomial_at(force.coeffs(), orbit.peak) / width).sqrt()
    at_trough = (-polynomial_at(force.coeffs(), orbit.trough) / width).sqrt()
    leading = arb(potential[4])
    inner = (at_peak + at_trough) ** 2 - leading * width**2
    return arb(2).sqrt() * (at_peak * at_trough).sqrt().agm(inner.sqrt() / 2)
