"""Potentials by a small table of rules, each exact: never a general integrator."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import sympy

from ridgeback.common.errors import InputError
from ridgeback.symbolic.grammar.at_origin import brief, value_at_origin
from ridgeback.symbolic.grammar.parse import U, V, parse_expression, to_sympy
from ridgeback.symbolic.systems.parameters import symbol_of
from ridgeback.symbolic.systems.sides import half, kinked_at_rest, on_stretch, stops_of, whole, without_velocity
from ridgeback.symbolic.systems.structure import dissipative_names, small_name

MAX_OPERATIONS: Final = 300

# Integral of g(x) dx for x = a*u + b; division by a is done by the caller.
_ELEMENTARY: Final[dict[type, Callable[[sympy.Expr], sympy.Expr]]] = {
    sympy.sin: lambda x: -sympy.cos(x),
    sympy.cos: sympy.sin,
    sympy.tan: lambda x: -sympy.log(sympy.cos(x)),
    sympy.sinh: sympy.cosh,
    sympy.cosh: sympy.sinh,
    sympy.tanh: lambda x: sympy.log(sympy.cosh(x)),
    sympy.exp: sympy.exp,
}


def potential_of(restoring: sympy.Expr) -> sympy.Expr | None:
    """Return the potential P(u) with P' = restoring and P(0) = 0.

    The rules: powers of u; sin, cos, tan, sinh, cosh, tanh, exp of a*u + b; c * g'(u) * g(u)**r and c * g'(u) * F(g(u))
    with F one of these functions; and p(u) * exp(q(u)) with polynomials p and q, where that is elementary.  A force
    with a kink at u = 0 is integrated on each side, and one with stops between them, which must be numbers.

    Parameters
    ----------
    restoring : sympy.Expr
        A force in ``U``.

    Returns
    -------
    sympy.Expr or None
        None when a term is in no rule.

    Examples
    --------
    >>> potential_of(U + sympy.sin(2 * U))
    u**2/2 - cos(2*u)/2 + 1/2
    """
    if stops := stops_of(restoring):
        return _beyond_stops(restoring, stops)
    if kinked_at_rest(restoring):
        right, left = (potential_of(half(restoring, side)) for side in (1, -1))
        return None if right is None or left is None else whole(right, left)
    integral = _sum(restoring, lambda term: _sum(_expanded(term), lambda _: None))
    return None if integral is None else _from_zero(integral)


# With the law f_0 about rest, and f_in, f_out on both sides of a stop s, V = V_0 + sum of D(u) - D(s) beyond each s,
# D' = f_out - f_in.
def _beyond_stops(restoring: sympy.Expr, stops: tuple[sympy.Expr, ...]) -> sympy.Expr | None:
    """The potential of a force with stops; None where their order is not known, or no rule integrates."""
    if not all(place.is_number for place in stops):
        return None
    total = potential_of(on_stretch(restoring, sympy.S.Zero))
    for place, inner, outer in _neighbours(stops):
        side = 1 if outer > place else -1
        change = on_stretch(restoring, outer) - on_stretch(restoring, inner)
        gained = potential_of(side * sympy.expand(_one_sided(change, side)).subs(U, side * U))
        if total is None or gained is None:
            return None
        beyond = (1 + side * sympy.sign(U - place)) / 2
        total += beyond * (gained.subs(U, side * U) - gained.subs(U, side * place))
    return total


def _neighbours(stops: tuple[sympy.Expr, ...]) -> list[tuple[sympy.Expr, sympy.Expr, sympy.Expr]]:
    """Each stop with a place between it and the next kink towards rest, and one beyond it."""
    found = []
    for side in (1, -1):
        distances = [sympy.S.Zero, *sorted(side * place for place in stops if side * place > 0)]
        ends = [*distances[1:], 2 * distances[-1] + 1]
        middles = [(low + high) / 2 for low, high in zip(distances, ends, strict=True)]
        found += [(side * d, side * a, side * b) for d, a, b in zip(distances[1:], middles, middles[1:], strict=False)]
    return found


def _one_sided(law: sympy.Expr, side: int) -> sympy.Expr:
    """A law on one side of rest, without the kink at rest."""
    return law.xreplace({sympy.Abs(U): side * U, sympy.sign(U): sympy.Integer(side)})


def force_potential(force: sympy.Expr, given: str | None, unknown: str) -> tuple[sympy.Expr | None, str]:
    """The potential of f(u, 0) and, when that does not set the undamped motion, why."""
    restoring = without_velocity(force)
    velocity = force - restoring
    checked = None
    if given is not None:  # checked wherever it is given, also where it is not all that sets the motion
        checked = checked_potential(to_sympy(parse_expression(given, unknown=unknown)), restoring)
    if sympy.expand(velocity + velocity.subs(V, -V)) != 0:
        return None, "the force has velocity terms that do not dissipate"
    lossless = velocity.subs({symbol_of(name): 0 for name in dissipative_names(force)})
    if sympy.expand(lossless - lossless.subs(U, -U)) != 0:
        return None, f"{brief(lossless)} neither dissipates nor comes from a potential"
    if small_name(force) is not None:
        return None, "a limit cycle is not set by its potential"
    if checked is not None:
        return checked, ""
    potential = potential_of(restoring)
    known = potential is not None or stops_of(restoring)  # the order of stops is known once they are numbers
    return potential, "" if known else f"no rule integrates {brief(restoring)}"


def checked_potential(potential: sympy.Expr, restoring: sympy.Expr) -> sympy.Expr:
    """The given potential, shifted so that it is zero at u = 0, once its derivative is seen to be the force.

    Raises InputError when it is not (or not recognisably) the integral of the restoring force.

    >>> checked_potential(sympy.cosh(U), sympy.sinh(U))
    cosh(u) - 1
    """
    value_at_origin(potential, {})
    difference = potential.diff(U) - restoring
    if sympy.expand(difference) != 0 and not _vanishes(difference):
        raise InputError(
            f"the potential {brief(potential)} does not differentiate to the restoring force {brief(restoring)}; "
            "leave it out or correct it"
        )
    return _from_zero(potential)


def _vanishes(difference: sympy.Expr) -> bool:
    """Whether the difference cancels over a common denominator; not tried where that could take long."""
    return bool(difference.count_ops() <= MAX_OPERATIONS and sympy.cancel(sympy.together(difference)) == 0)


def _from_zero(potential: sympy.Expr) -> sympy.Expr:
    return potential - potential.subs(U, 0)


def _sum(restoring: sympy.Expr, otherwise: Callable[[sympy.Expr], sympy.Expr | None]) -> sympy.Expr | None:
    """The integral term by term; what no rule takes goes ``otherwise``, and None from there is None for all."""
    integrals: list[sympy.Expr] = []
    for term in sympy.Add.make_args(restoring):
        integral = _term(term)
        if integral is None:
            integral = otherwise(term)
        if integral is None:
            return None
        integrals.append(integral)
    return sympy.Add(*integrals)


def _expanded(restoring: sympy.Expr) -> sympy.Expr:
    """Multiply out polynomials fully, anything else only one level, so that each rule sees single terms."""
    return sympy.expand(restoring) if restoring.is_polynomial(U) else sympy.expand_mul(restoring)


def _term(term: sympy.Expr) -> sympy.Expr | None:
    coefficient, rest = term.as_independent(U, as_Add=False)
    if rest == 1:
        return coefficient * U
    base, exponent = rest.as_base_exp() if not isinstance(rest, sympy.exp) else (rest, sympy.S.One)
    if base == U and exponent.is_Rational:
        return _power(coefficient, U, exponent)
    rule = _ELEMENTARY.get(rest.func)
    if rule is not None and not (slope := rest.args[0].diff(U)).has(U):
        return coefficient * rule(rest.args[0]) / slope
    return _chain(coefficient, rest)


def _power(coefficient: sympy.Expr, base: sympy.Expr, exponent: sympy.Rational) -> sympy.Expr:
    if exponent == -1:
        return coefficient * sympy.log(base)
    return coefficient * base ** (exponent + 1) / (exponent + 1)


def _chain(coefficient: sympy.Expr, rest: sympy.Expr) -> sympy.Expr | None:
    """c * g'(u) * g(u)**r for one of the powers that occur, such as u/(1 + u**2) or sin(u)*cos(u)**2."""
    for factor in sympy.Mul.make_args(rest):
        base, exponent = factor.as_base_exp()
        slope = base.diff(U)
        if isinstance(factor, sympy.exp):
            integral = _exponential(rest / factor, factor.args[0])
            if integral is not None:
                return coefficient * integral * factor
            continue
        if factor.func in _ELEMENTARY and factor.args[0].diff(U) != 0:
            ratio = _cancelled(rest / factor, factor.args[0].diff(U))
            if not ratio.has(U):
                return coefficient * ratio * _ELEMENTARY[factor.func](factor.args[0])
        if not exponent.is_Rational or slope == 0:
            continue
        ratio = _cancelled(rest / factor, slope)
        if not ratio.has(U):
            return _power(coefficient * ratio, base, exponent)
    return None


# (r e^q)' = (r' + r q') e^q = p e^q fixes r from the highest power down (Liouville: no other form is elementary).
def _exponential(p: sympy.Expr, q: sympy.Expr) -> sympy.Expr | None:
    """The r of r(u) e^q(u), the integral of p(u) e^q(u) for polynomials; None where there is none."""
    if not (p.is_polynomial(U) and q.is_polynomial(U)):
        return None
    slope, rest, found = sympy.Poly(q.diff(U), U), sympy.Poly(p, U), sympy.Poly(0, U)
    while not slope.is_zero and not rest.is_zero and rest.degree() >= slope.degree():
        term = sympy.Poly(sympy.cancel(rest.LC() / slope.LC()) * U ** (rest.degree() - slope.degree()), U)
        found, rest = found + term, rest - term.diff(U) - term * slope
    return found.as_expr() if rest.is_zero else None


def _cancelled(above: sympy.Expr, below: sympy.Expr) -> sympy.Expr:
    """The quotient, with common factors of polynomials removed; anything else is left to cancel by itself."""
    ratio = above / below
    return sympy.cancel(ratio) if ratio.has(U) and above.is_polynomial(U) and below.is_polynomial(U) else ratio
