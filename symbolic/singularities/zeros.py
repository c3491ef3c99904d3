"""Zeros of the period inside its circle of convergence: there omega0 = 2 pi / T has a pole, nearer than what stops T.

A zero of the truncated series well inside the circle is near one of the period itself (A. Hurwitz's theorem); how near
is judged by the truncation to three quarters of the terms.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from flint import acb, acb_poly, arb, ctx, fmpq

from ridgeback.symbolic.singularities.darboux import Estimate, Point

WELL_INSIDE: Final = 0.95
"""Zeros beyond this part of the radius may be those of the truncation (Jentzsch's theorem: they crowd the circle)."""
SAFETY: Final = 4
BITS: Final = 192
ROOT_BITS: Final = 96
LARGEST: Final = 0.1
"""Relative change of a zero by the last quarter of the terms beyond which it is not taken for one."""


def zero_inside(series: Sequence[fmpq | arb], radius: arb) -> Estimate | None:
    """Return the nearest zero of a power series inside its circle of convergence, as a pole of its reciprocal.

    Parameters
    ----------
    series : sequence of fmpq or arb
        Coefficients.
    radius : arb
        Of convergence.

    Returns
    -------
    Estimate or None
        The zero and its conjugate, exponent -1; None where there is none well inside.

    Examples
    --------
    1 - x/3 - x^2/9 - ..., which vanishes at x = 3/2::

        >>> found = zero_inside([fmpq(1 if n == 0 else -1, 3**n) for n in range(40)], arb(3))
        >>> round(float(found.points[0].place.real), 9), found.place_error < 1e-7
        (1.5, True)
    """
    with ctx.workprec(BITS):
        scaled = [arb(c) * radius**n for n, c in enumerate(series)]
        zeros, fewer = _zeros(scaled), _zeros(scaled[: len(scaled) - len(scaled) // 4])
        inside = sorted((z for z in zeros if float(abs(z)) < WELL_INSIDE), key=lambda z: float(abs(z)))
        if not inside or not fewer:
            return None
        nearest = inside[0]
        change = min(float(abs(z - nearest)) for z in fewer) / float(abs(nearest))
        if change > LARGEST:
            return None
        pair = (nearest,) if float(abs(nearest.imag)) < change + 2.0**-50 else (nearest, nearest.conjugate())
        places = [acb(z.real.mid(), 0 if len(pair) == 1 else z.imag.mid()) for z in pair]
        points = tuple(Point(place * radius, acb(-1)) for place in places)
        return Estimate(points, SAFETY * change, 2.0**-50, len(scaled) - 1)


def _zeros(scaled: list[arb]) -> list[acb]:
    try:
        return list(acb_poly([acb(c) for c in scaled]).roots(tol=arb(2) ** -ROOT_BITS))
    except ValueError:
        return []  # a multiple zero, or coefficients known to too few digits
