"""Names for linear losses that an equation writes as numbers or through a reciprocal, so that they can be small.

An expansion in a linear damping needs a parameter that is small: 0.02*u' is read as 2*mu*u' with mu = 1/100, a numeric
excitation -0.1*(1 - u**2)*u' as -eps*(1 - u**2)*u' with eps = 1/10, and u'/Q as inv_Q*u' with inv_Q = 1/Q.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Final

import sympy

from ridgeback.symbolic.grammar.parse import U, V
from ridgeback.symbolic.systems.parameters import Parameters, reciprocal, symbol_of
from ridgeback.symbolic.systems.structure import dissipative_names, free_names, slope_at_rest, without_kinks

INVERSE: Final = "inv_"
"""Begins the name of the reciprocal of a parameter."""


@dataclass(frozen=True)
class Lossy:
    """A force whose losses carry parameters, and the values of all parameters."""

    force: sympy.Expr
    parameters: Parameters


def with_named_losses(force: sympy.Expr, parameters: Parameters) -> Lossy:
    """Give a linear loss a parameter that it vanishes with, where the equation has none.

    Parameters
    ----------
    force : sympy.Expr
        f(u, u', parameters) of u'' + f = 0.
    parameters : mapping of str to sympy.Rational or None
        The value of each parameter, None for a symbolic one.

    Returns
    -------
    Lossy
        The same oscillator; what was given where nothing is to be named.

    Examples
    --------
    >>> found = with_named_losses(U + V / 50 + U**3, {})
    >>> found.force, dict(found.parameters)
    (2*mu*u' + u**3 + u, {'mu': 1/100})
    >>> dict(with_named_losses(U + V / sympy.Symbol("Q", real=True), {"Q": sympy.Integer(40)}).parameters)
    {'inv_Q': 1/40}
    """
    for name in [name for name in parameters if _by_reciprocal(force, name)]:
        force = force.subs(symbol_of(name), 1 / symbol_of(INVERSE + name))
        value = parameters[name]
        renamed = {INVERSE + name: None if value is None else reciprocal(name, value)}
        parameters = {**{n: v for n, v in parameters.items() if n != name}, **renamed}
    return _numbers_named(force, parameters)


def _by_reciprocal(force: sympy.Expr, name: str) -> bool:
    """Whether a parameter that is not analytic at 0 is the reciprocal of one that a loss vanishes with."""
    symbol, other = symbol_of(name), symbol_of(INVERSE + name)
    if other in force.free_symbols or not force.subs(symbol, 0).has(sympy.zoo, sympy.nan, sympy.oo):
        return False
    turned = force.subs(symbol, 1 / other)
    return str(other.name) in dissipative_names(turned) and turned.subs(other, 0).is_finite is not False


def _numbers_named(force: sympy.Expr, parameters: Parameters) -> Lossy:
    """The part that neither reversal of time keeps, with a parameter where none carries it and it has a linear term."""
    lossless = {symbol_of(name): 0 for name in dissipative_names(force)}
    left = force.subs(lossless)
    odd = (left - left.subs(V, -V)) / 2
    lost = without_kinks((odd + odd.subs(U, -U)) / 2)
    slope = slope_at_rest(lost, V)
    if not slope.is_Rational or slope == 0:
        return Lossy(force, parameters)
    named, factor = ("mu", 2) if slope > 0 else ("eps", -1)
    name = _free(named, {*parameters, *free_names(force)})
    unit = sympy.expand(lost / slope)
    carried = factor * symbol_of(name) * sympy.factor_terms(unit)
    return Lossy(sympy.expand_mul(force - lost) + carried, {**parameters, name: slope / factor})


def _free(name: str, taken: Collection[str]) -> str:
    names = (name, *(f"{name}{n}" for n in range(1, 100)))
    return next(each for each in names if each not in taken)


def by_reciprocals(given: Mapping[str, object], known: Collection[str]) -> dict[str, str]:
    """Names that were given for parameters that are known by their reciprocals.

    >>> by_reciprocals({"Q": 40, "k": 1}, ("k", "inv_Q"))
    {'Q': 'inv_Q'}
    """
    return {name: INVERSE + name for name in given if name not in known and INVERSE + name in known}
