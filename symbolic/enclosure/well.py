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
from ridgeback.symbolic.grammar.at_origin import brief
from ridgeback.symbolic.systems.oscillator import Oscillator, U, V
from ridgeback.symbolic.systems.potential import potential_of
from ridgeback.symbolic.systems.structure import free_names

MAX_DEGREE = 128
"""Largest degree of a polynomial potential; the certified roots take time like its cube."""


@dataclass(frozen=True, eq=False)
class Well:
    """Energy E = inertia(u)^2 u'^2 / 2 + potential(u), in units with k = 1; potential(0) = 0."""

    name: str
    force: sympy.Expr
    """V'(u)."""
    potential: sympy.Expr
    inertia: sympy.Expr
    """I(u), 1 for a force that depends on u only."""
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
            force=-self.force.subs(U, -U),
            potential=self.potential.subs(U, -U),
            inertia=self.inertia.subs(U, -U),
            polynomial=None if exact is None else exact(fmpq_poly([0, -1])),
        )


@dataclass(frozen=True)
class Curves:
    """V, V', V'' and I as functions on balls."""

    value: Function
    force: Function
    slope: Function
    inertia: Function


@lru_cache(maxsize=64)
def well_of(oscillator: Oscillator, *, mirrored: bool = False) -> Well:
    """Return the well of a conservative oscillator, in units with k = 1.

    Parameters
    ----------
    oscillator : Oscillator
        Conservative, with numbers for its parameters.
    mirrored : bool, optional
        Whether to turn u into -u.

    Returns
    -------
    Well
        Force, potential and inertia.

    Raises
    ------
    InputError
        With the alternative, for self-excited and damped oscillators, symbolic parameters, velocity terms other than
        b(u) u'^2, and where no rule integrates the potential.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> well_of(find("duffing")).polynomial
    1/4*x^4 + 1/2*x^2
    """
    if mirrored:
        return well_of(oscillator).mirrored()
    _check_kind(oscillator)
    force = oscillator.normalised.bound
    if force.has(V):
        potential, inertia = _with_velocity(oscillator, force)
    else:
        known = oscillator.normalised.potential  # None, too, where terms in u' were in the equation and are set to 0
        potential, inertia = _integral(force) if known is None else known, sympy.S.One
    if potential is None:
        raise InputError(_no_potential(oscillator.name, force, inertia))
    return Well(
        name=oscillator.name,
        force=potential.diff(U) if force.has(V) else force,
        potential=potential,
        inertia=inertia,
        scale=oscillator.natural_frequency,
        even=all(sympy.expand(e - e.subs(U, -U)) == 0 for e in (potential, inertia)),
        polynomial=exact_polynomial(potential) if inertia == 1 else None,
    )


@lru_cache(maxsize=256)
def curves(well: Well, bits: int, *, complex_: bool = False) -> Curves:
    """V, V', V'' and I on real or complex balls, constants known to ``bits`` bits."""
    expressions = (well.potential, well.force, well.force.diff(U), well.inertia)
    return Curves(*(ball_function(e, bits, complex_=complex_) for e in expressions))


def _check_kind(oscillator: Oscillator) -> None:
    name = oscillator.name
    if oscillator.kind == "limit-cycle":
        raise InputError(
            f"{name} is self-excited: it has a limit cycle and no family of orbits, so omega0 has no "
            "certified enclosure; instead, study holds the series against the orbit found by shooting (not proved), "
            "and derive --digits certifies the coefficients"
        )
    if oscillator.kind == "damped":
        raise InputError(
            f"{name} loses energy, so no orbit has the exact frequency omega0(A) that an enclosure is of; "
            "use --method multiple-scales, or set its damping to 0"
        )
    if oscillator.kind == "reversible":
        raise InputError(
            f"{name} closes its orbits by a symmetry under (u, t) -> (-u, -t) and not by an energy of the form "
            "I(u)^2 u'^2/2 + V(u), so there is no enclosure; study holds the series against an integrated cycle (not "
            "proved); leave out --at and --certified"
        )
    unset = free_names(oscillator.substituted_force)
    if unset:
        raise InputError(f"{name}: an enclosure needs numbers, and {', '.join(unset)} has none; set it, e.g. to 1")


def _with_velocity(oscillator: Oscillator, force: sympy.Expr) -> tuple[sympy.Expr | None, sympy.Expr]:
    """V and I for a force a(u) + b(u) u'^2."""
    restoring = force.subs(V, 0)
    drag = force.diff(V, 2) / 2
    if drag.has(V):  # the force is even in u', so nothing but a(u) + b(u) u'^2 is left
        raise InputError(
            f"{oscillator.name} has velocity terms other than b(u) u'^2, for which there is no energy to integrate; "
            "no enclosure exists, the series of --method lindstedt does: leave out --at and --certified"
        )
    exponent = _integral(drag)
    if exponent is None:
        raise InputError(
            f"{oscillator.name}: no rule integrates {brief(drag)}, the factor of u'^2, so there is no enclosure; "
            "the series of --method lindstedt needs none: leave out --at and --certified"
        )
    exponent = exponent.replace(sympy.log, _log_from_origin)
    inertia = sympy.exp(exponent - exponent.subs(U, 0))
    return _integral(restoring * inertia**2), inertia


def _no_potential(name: str, force: sympy.Expr, inertia: sympy.Expr) -> str:
    """What is missing for an enclosure, and where it can be given."""
    if not force.has(V):
        return (
            f"{name}: an enclosure needs the potential, and no rule integrates {brief(force)}; give it in a TOML "
            'file beside the equation, as potential = "..."'
        )
    return (
        f"{name}: an enclosure needs the integral of {brief(force.subs(V, 0) * inertia**2)}, the force times its "
        "integrating factor, and no rule has it; the series of --method lindstedt needs none: leave out --at and "
        "--certified"
    )


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
