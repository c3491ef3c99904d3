"""The two families of restoring forces whose frequency is an arithmetic-geometric mean, recognised by their form.

    c sin(b u), c b > 0:        omega0 = sqrt(c b) M(1, cos(b A/2))
    a u + e u^3, a > 0:         omega0 = M(sqrt(a + e A^2), sqrt(a + e A^2/2))

for the peak amplitude A (DLMF 19.8.5 with 22.19.2 and 22.19.6); M is evaluated where the numbers are.
"""

from __future__ import annotations

from typing import NamedTuple

import sympy

from ridgeback.symbolic.grammar.parse import U


class SineForce(NamedTuple):
    """c sin(b u)."""

    factor: sympy.Expr
    rate: sympy.Expr


class CubicForce(NamedTuple):
    """a u + e u^3."""

    linear: sympy.Expr
    cubic: sympy.Expr


def sine_force(force: sympy.Expr) -> SineForce | None:
    """Recognise c sin(b u) with numbers c b > 0.

    Parameters
    ----------
    force
        The restoring force, in ``U``.

    Returns
    -------
    SineForce or None
        c and b, exact; None for any other force.

    Examples
    --------
    >>> sine_force(4 * sympy.sin(U / 2))
    SineForce(factor=4, rate=1/2)
    """
    factor, wave = force.as_independent(U, as_Add=False)
    if not isinstance(wave, sympy.sin):
        return None
    rate = sympy.cancel(wave.args[0] / U)
    numbers = rate.is_number and factor.is_number and (factor * rate).is_positive
    return SineForce(factor, rate) if numbers else None


def cubic_force(force: sympy.Expr) -> CubicForce | None:
    """Recognise a u + e u^3 with numbers, a > 0; e may be 0.

    Parameters
    ----------
    force
        The restoring force, in ``U``.

    Returns
    -------
    CubicForce or None
        a and e, exact; None for any other force.

    Examples
    --------
    >>> cubic_force(2 * U - U**3), cubic_force(U - U**2)
    (CubicForce(linear=2, cubic=-1), None)
    """
    if not force.is_polynomial(U):
        return None
    terms = sympy.Poly(force, U).as_dict()
    linear, cubic = terms.get((1,), sympy.S.Zero), terms.get((3,), sympy.S.Zero)
    known = set(terms) <= {(1,), (3,)} and linear.is_number and cubic.is_number and linear.is_positive
    return CubicForce(linear, cubic) if known else None
