r"""The potential well of an oscillator, ready for enclosures: energy, force and inertia as exact expressions.

In units with k = 1, u'' + a(u) + b(u) u'^2 = 0 keeps the energy

    E = I(u)^2 u'^2 / 2 + V(u),      I = exp(integral of b),   V' = a I^2,

since dE/dt = I^2 u' (u'' + b u'^2 + a).  A force without velocity terms has I = 1.  (Position-dependent mass: Mathews
and Lakshmanan, Quarterly of Applied Mathematics 32 (1974) 215-218.)
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import sympy
from flint import fmpq_poly

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import rational
from ridgeback.symbolic.enclosure.ball_functions import Function, ball_function
from ridgeback.symbolic.enclosure.ball_integral import BallIntegral
from ridgeback.symbolic.systems.oscillator import Oscillator, U, V
from ridgeback.symbolic.systems.potential import potential_of
from ridgeback.symbolic.systems.structure import free_names

MAX_DEGREE = 128
"""Largest degree of a polynomial potential; the certified roots take time like its cube."""


@dataclass(frozen=True, eq=False)
class Well:
    """Energy E = inertia(u)^2 u'^2 / 2 + potential(u), in units with k = 1; potential(0) = 0."""

    name: str
    restoring: sympy.Expr
    """a(u)."""
    potential: sympy.Expr | None
    """V(u), None where no rule integrates it: it is then integrated in balls."""
    inertia: sympy.Expr | None
    """I(u), 1 for a force that depends on u only, None where no rule integrates ``drag``."""
    drag: sympy.Expr
    """b(u), 0 for a force that depends on u only."""
    scale: sympy.Expr
    """k, in rad per time unit."""
    even: bool
    """Whether V and I are known to be even, so that trough = -peak exactly."""
    polynomial: fmpq_poly | None
    """V when it is a polynomial with rational coefficients and I = 1."""

    def mirrored(self) -> Well:
        """The well seen from the other side: u -> -u."""
        exact = self.polynomial
        return replace(
            self,
            restoring=-self.restoring.subs(U, -U),
            potential=None if self.potential is None else self.potential.subs(U, -U),
            inertia=None if self.inertia is None else self.inertia.subs(U, -U),
            drag=-self.drag.subs(U, -U),
            polynomial=None if exact is None else exact(fmpq_poly([0, -1])),
        )


@dataclass(frozen=True)
class Curves:
    """V, V', V'' and I as functions on balls.

    ``analytic`` is finite on a ball only if V is analytic there; it costs less than V where that is integrated.
    """

    value: Function
    force: Function
    slope: Function
    inertia: Function
    analytic: Function


class NoEnergyError(InputError):
    """Orbits close, but by no energy of the form I(u)^2 u'^2/2 + V(u)."""


@lru_cache(maxsize=64)
def well_of(oscillator: Oscillator) -> Well:
    """Return the well of a conservative oscillator, in units with k = 1.

    Parameters
    ----------
    oscillator : Oscillator
        Conservative, with numbers for its parameters.

    Returns
    -------
    Well
        Force, potential and inertia.

    Raises
    ------
    InputError
        With the alternative, for self-excited and damped oscillators, symbolic parameters, velocity terms other than
        b(u) u'^2.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> well_of(find("duffing")).polynomial
    1/4*x^4 + 1/2*x^2
    """
    _check_kind(oscillator)
    force = oscillator.normalised.bound
    restoring, drag = force.subs(V, 0), _drag(oscillator, force)
    inertia = _inertia(drag)
    known = oscillator.normalised.potential if drag == 0 else None
    potential = known if known is not None or inertia is None else _integral(restoring * inertia**2)
    return Well(
        name=oscillator.name,
        restoring=restoring,
        potential=potential,
        inertia=inertia,
        drag=drag,
        scale=oscillator.natural_frequency,
        even=all(sympy.expand(e + e.subs(U, -U)) == 0 for e in (restoring, drag)),
        polynomial=exact_polynomial(potential) if drag == 0 and potential is not None else None,
    )


@lru_cache(maxsize=256)
def curves(well: Well, bits: int, *, complex_: bool = False) -> Curves:
    """V, V', V'' and I on real or complex balls, constants known to ``bits`` bits."""
    if well.inertia is None:
        return _integrated_curves(well, bits, complex_)
    return _closed_curves(well, well.inertia, bits, complex_)


def _closed_curves(well: Well, inertia: sympy.Expr, bits: int, complex_: bool) -> Curves:
    """With the inertia in closed form; the potential in closed form or as the integral of its derivative."""
    force = well.restoring * inertia**2 if well.potential is None or well.drag == 0 else well.potential.diff(U)
    slope, curve, mass = (ball_function(e, bits, complex_=complex_) for e in (force, force.diff(U), inertia))
    if well.potential is not None:
        value = ball_function(well.potential, bits, complex_=complex_)
        return Curves(value, slope, curve, mass, analytic=value)
    return Curves(BallIntegral(ball_function(force, bits, complex_=True)), slope, curve, mass, analytic=slope)


def _integrated_curves(well: Well, bits: int, complex_: bool) -> Curves:
    """With I = exp(B), V' = a I^2 and V'' = (a' + 2 a b) I^2, B and V as integrals of b and V'."""

    def by_inertia(expression: sympy.Expr, wide: bool) -> Function:
        inner, log = ball_function(expression, bits, complex_=wide), logarithm
        return lambda u: inner(u) * (2 * log(u)).exp()

    logarithm = BallIntegral(ball_function(well.drag, bits, complex_=True))
    slope = well.restoring.diff(U) + 2 * well.restoring * well.drag
    return Curves(
        value=BallIntegral(by_inertia(well.restoring, True)),
        force=by_inertia(well.restoring, complex_),
        slope=by_inertia(slope, complex_),
        inertia=lambda u: logarithm(u).exp(),
        analytic=ball_function(well.restoring * well.drag, bits, complex_=complex_),
    )


def _check_kind(oscillator: Oscillator) -> None:
    name = oscillator.name
    if oscillator.kind == "limit-cycle":
        raise InputError(
            f"{name} is self-excited: it has limit cycles and no family of orbits with a frequency for each amplitude; "
            "they are enclosed at values of the small parameter (derive --at), which must be one that it has"
        )
    if oscillator.kind == "damped":
        raise InputError(
            f"{name} loses energy, so no orbit has the exact frequency omega0(A) that an enclosure is of; "
            "use --method multiple-scales, or set its damping to 0"
        )
    if oscillator.kind == "reversible":
        raise NoEnergyError(
            f"{name} closes its orbits by a symmetry under (u, t) -> (-u, -t) and not by an energy of the form "
            "I(u)^2 u'^2/2 + V(u); derive --at encloses its frequency by integration"
        )
    unset = free_names(oscillator.substituted_force)
    if unset:
        raise InputError(f"{name}: an enclosure needs numbers, and {', '.join(unset)} has none; set it, e.g. to 1")


def _drag(oscillator: Oscillator, force: sympy.Expr) -> sympy.Expr:
    """b(u) of a force a(u) + b(u) u'^2."""
    drag = force.diff(V, 2) / 2
    if drag.has(V):  # the force is even in u', so nothing but a(u) + b(u) u'^2 is left
        raise NoEnergyError(
            f"{oscillator.name} has velocity terms other than b(u) u'^2, for which there is no energy to integrate; "
            "derive --at encloses its frequency by integration"
        )
    return drag


def _inertia(drag: sympy.Expr) -> sympy.Expr | None:
    """I(u) in closed form, None where no rule integrates its logarithm."""
    if drag == 0:
        return sympy.S.One
    exponent = _integral(drag)
    if exponent is None:
        return None
    exponent = exponent.replace(sympy.log, _log_from_origin)
    return sympy.exp(exponent - exponent.subs(U, 0))


def _integral(integrand: sympy.Expr) -> sympy.Expr | None:
    """By the rules of ``potential_of``, as it stands or brought to a common denominator."""
    as_it_stands = potential_of(integrand)
    return potential_of(sympy.factor(integrand)) if as_it_stands is None else as_it_stands


def _log_from_origin(argument: sympy.Expr) -> sympy.Expr:
    """log(x / x(0)), which differs by a constant and is 0 at the origin, also where x is negative there."""
    return sympy.log(sympy.expand(argument / argument.subs(U, 0)))


def exact_polynomial(potential: sympy.Expr) -> fmpq_poly | None:
    """A potential as a polynomial with rational coefficients, None when it is none.

    >>> exact_polynomial(U**4 / 4)
    1/4*x^4
    """
    if not potential.is_polynomial(U):
        return None
    coefficients = sympy.Poly(potential, U).all_coeffs()[::-1]
    if not all(isinstance(c, sympy.Rational) for c in coefficients):
        return None
    if len(coefficients) - 1 > MAX_DEGREE:
        raise InputError(
            f"the potential has degree {len(coefficients) - 1}, and certified roots are kept to {MAX_DEGREE}; "
            "use a lower degree"
        )
    return fmpq_poly([rational(c) for c in coefficients])
