"""Irrational numbers in a force as symbols of their own, so that the rational engine carries them exactly.

u'' - 2 u + u^3 about sqrt(2) is w'' + 4 w + 3 sqrt(2) w^2 + w^3: with a symbol for sqrt(2) it is an equation with
rational coefficients and a parameter.  The coefficients of its expansion are polynomials in that symbol; with its value
inserted and multiplied out they are exact, whatever algebraic relations the numbers obey.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy

from ridgeback.symbolic.grammar.parse import U, V

MARK = "*"
"""Ends the name of such a symbol; no parameter can have it."""


@dataclass(frozen=True)
class Named:
    """A force without irrational numbers, and the values of the symbols that stand for them."""

    force: sympy.Expr
    values: Mapping[str, sympy.Expr]


def named(force: sympy.Expr) -> Named:
    """Replace the irrational numbers of a force in natural units by symbols; as it is where that changes the force.

    A force must vanish at rest and restore with slope 1 whatever the values of the symbols are: else they may not be
    treated as parameters, and the force is returned unchanged.

    >>> found = named(U + 3 * sympy.sqrt(2) * U**2 / 4)
    >>> found.force == U + 3 * sympy.Symbol("c1*", real=True) * U**2 / 4, found.values
    (True, {'c1*': sqrt(2)})
    >>> named(sympy.sin(U)).values
    {}
    """
    if not any(_irrational(atom) for atom in force.atoms(sympy.Pow, sympy.NumberSymbol, sympy.Function)):
        return Named(force, {})
    found: dict[sympy.Expr, sympy.Symbol] = {}
    changed = _replaced(_opened(force), found)
    at_rest = {U: 0, V: 0}
    if sympy.expand(changed.subs(at_rest)) != 0 or sympy.expand(changed.diff(U).subs(at_rest)) != 1:
        return Named(force, {})
    return Named(changed, {str(symbol.name): value for value, symbol in found.items()})


def _irrational(e: sympy.Expr) -> bool:
    return bool(e.is_number) and not e.is_Rational


def _opened(force: sympy.Expr) -> sympy.Expr:
    """sin(u + c) as sin u cos c + cos u sin c and the like, multiplied out."""
    apart = force.replace(lambda e: e.func in _ADDITION and e.args[0].is_Add, _apart)
    return sympy.Add(*_collected(sympy.expand(apart, power_base=False, log=False)))


_ADDITION = {
    sympy.sin: lambda a, c: sympy.sin(a) * sympy.cos(c) + sympy.cos(a) * sympy.sin(c),
    sympy.cos: lambda a, c: sympy.cos(a) * sympy.cos(c) - sympy.sin(a) * sympy.sin(c),
    sympy.sinh: lambda a, c: sympy.sinh(a) * sympy.cosh(c) + sympy.cosh(a) * sympy.sinh(c),
    sympy.cosh: lambda a, c: sympy.cosh(a) * sympy.cosh(c) + sympy.sinh(a) * sympy.sinh(c),
}
"""The addition theorems."""


def _apart(e: sympy.Expr) -> sympy.Expr:
    """A function of a sum with a number in it, by its addition theorem."""
    number, rest = e.args[0].as_independent(U, V, as_Add=True)
    return e if number == 0 or not number.is_number else _ADDITION[e.func](rest, number)


def _collected(e: sympy.Expr) -> list[sympy.Expr]:
    """Terms with the same dependence on u and u' made one, so that numbers that cancel do."""
    rows: dict[sympy.Expr, sympy.Expr] = {}
    for term in sympy.Add.make_args(e):
        number, rest = term.as_independent(U, V, as_Add=False)
        rows[rest] = rows.get(rest, sympy.S.Zero) + number
    return [sympy.expand(number) * rest for rest, number in rows.items()]


def _replaced(e: sympy.Expr, found: dict[sympy.Expr, sympy.Symbol]) -> sympy.Expr:
    if e.is_Rational or e.is_Symbol:
        return e
    if _irrational(e) and not (e.is_Add or e.is_Mul):
        return found.setdefault(e, sympy.Symbol(f"c{len(found) + 1}{MARK}", real=True))
    return e.func(*(_replaced(part, found) for part in e.args))
