r"""A force in natural units, u'' + u + ... = 0, with rational coefficients: what is not rational gets a name.

The expansions compute with polynomials over the rationals.  A number such as sqrt(2), and a function of the parameters
alone that is no polynomial in them, such as 1/k in m x'' + k x + k3 x^3 = 0 or 1/(1 + w^2) in sin(u) beside w^2 u,
is replaced by a symbol of its own; coefficients that come out are polynomials in these symbols, and exact once their
values are inserted, whatever relations the values obey.

A symbol may stand for its value only where the equation keeps its form whatever the value: a term with one enters
without its value at rest and its slope there.  Both are known: the force vanishes at rest and has the slope 1.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from itertools import product
from typing import Final

import sympy

from ridgeback.symbolic.grammar.parse import U, V
from ridgeback.symbolic.systems.structure import without_sizes

MARK: Final = "*"
"""Ends the name of such a symbol; no parameter can have it."""
AT_REST: Final = {U: 0, V: 0}


@dataclass(frozen=True)
class Natural:
    """A force in natural units and the values of the symbols in it that stand for something."""

    force: sympy.Expr
    values: Mapping[str, sympy.Expr]


def in_natural_units(force: sympy.Expr, stiffness: sympy.Expr, small: Collection[sympy.Symbol] = ()) -> Natural:
    """The force over its stiffness, with names for what is not polynomial over the rationals.

    Parameters
    ----------
    force : sympy.Expr
        f(u, u') of u'' + f = 0, zero at rest.
    stiffness : sympy.Expr
        The slope of the force in u at rest, where every small parameter vanishes.
    small : collection of sympy.Symbol
        Parameters whose terms may have a slope of their own.

    Returns
    -------
    Natural
        The force u + ..., and the values of the names in it.

    Examples
    --------
    >>> k, b = sympy.symbols("k b", real=True)
    >>> in_natural_units(k**2 * sympy.sin(U), k**2).force
    sin(u)
    >>> found = in_natural_units(k**2 * U + b * U**3, k**2)
    >>> found.force == U + b * U**3 * sympy.Symbol("c1*", real=True) ** 2, found.values
    (True, {'c1*': 1/k})
    >>> in_natural_units(U + 3 * sympy.sqrt(2) * U**2 / 4, sympy.S.One).values
    {'c1*': sqrt(2)}
    """
    names: dict[sympy.Expr, sympy.Symbol] = {}
    clean: list[sympy.Expr] = []
    held: list[sympy.Expr] = []
    for term in _terms(force, stiffness):
        changed = _named(term, names)
        (clean if changed == term else held).append(changed)
    whole = sympy.Add(*clean)
    if held or not _is_natural(whole, small):
        whole = U + _without_rest(whole, small) + _without_rest(sympy.Add(*held), small)
    return Natural(whole, {str(symbol.name): value for value, symbol in names.items()})


def over_leading(force: sympy.Expr, leading: sympy.Expr) -> Natural:
    """The force over the coefficient that it begins with, with names for what is not polynomial over the rationals.

    Of the series of the result the first coefficient is 1 and those before it are 0, which its reader must know.

    >>> found = over_leading(sympy.sqrt(2) * U**3 + U**5, sympy.sqrt(2))
    >>> found.force, found.values
    (c1**u**5/2 + u**3, {'c1*': sqrt(2)})
    """
    names: dict[sympy.Expr, sympy.Symbol] = {}
    named = sympy.Add(*(_named(term, names) for term in _terms(force, leading)))
    return Natural(named, {str(symbol.name): value for value, symbol in names.items()})


def _terms(force: sympy.Expr, stiffness: sympy.Expr) -> tuple[sympy.Expr, ...]:
    """The terms of the force over its stiffness, each with the parameters before it cancelled."""
    opened = _opened(_unit_bases(without_sizes(force)))
    if stiffness == 1:
        return tuple(sympy.Add.make_args(opened))
    return tuple(_over(term, stiffness) for term in sympy.Add.make_args(_spread(opened)))


def _spread(e: sympy.Expr) -> sympy.Expr:
    """Products of sums multiplied out at the top only: below a bar the 1 + ... of ``_unit_bases`` stay apart."""
    rows = []
    for term in sympy.Add.make_args(e):
        factors = sympy.Mul.make_args(term)
        outer = sympy.Mul(*(f for f in factors if not f.is_Add))
        rows += [outer * sympy.Mul(*chosen) for chosen in product(*(f.args for f in factors if f.is_Add))]
    return sympy.Add(*rows)


def _over(term: sympy.Expr, stiffness: sympy.Expr) -> sympy.Expr:
    number, rest = (term / stiffness).as_independent(U, V, as_Add=False)
    return rest * (sympy.factor_terms(sympy.cancel(number)) if number.free_symbols else number)


def _is_natural(force: sympy.Expr, small: Collection[sympy.Symbol]) -> bool:
    resting = dict.fromkeys(small, 0)
    value, slope = (sympy.expand(e.subs(AT_REST).subs(resting)) for e in (force, force.diff(U)))
    return bool(value == 0 and slope == 1)


def _without_rest(force: sympy.Expr, small: Collection[sympy.Symbol]) -> sympy.Expr:
    """The force without its value at rest and without its slope there, but for those that small parameters bring."""
    resting = dict.fromkeys(small, 0)
    kept = _spread(force)
    value, slope = (sympy.expand(e.subs(AT_REST).subs(resting)) for e in (kept, kept.diff(U)))
    return _spread(kept - value - slope * U)


def _unit_bases(force: sympy.Expr) -> sympy.Expr:
    """Bases of roots and denominators as b (1 + ...), b their value at rest: the series of 1/(l + u) begin with 1/l."""
    return force.replace(lambda e: _divides(e) and _held(_at_rest(e.base)), _unit_base)


def _divides(e: sympy.Expr) -> bool:
    return bool(e.is_Pow and e.exp.is_Rational and (e.exp < 0 or not e.exp.is_Integer) and e.base.has(U, V))


def _held(value: sympy.Expr) -> bool:
    return bool(value.free_symbols) or (_irrational(value) and value != 0)


def _at_rest(e: sympy.Expr) -> sympy.Expr:
    return sympy.expand(e.subs(AT_REST))


def _unit_base(e: sympy.Expr) -> sympy.Expr:
    start = _at_rest(e.base)
    return without_sizes(sympy.Pow(start, e.exp)) * sympy.Pow(1 + _divided(sympy.expand(e.base - start), start), e.exp)


def _divided(e: sympy.Expr, by: sympy.Expr) -> sympy.Expr:
    return sympy.Add(*(term / by for term in sympy.Add.make_args(e)))


def _opened(force: sympy.Expr) -> sympy.Expr:
    """sin(u + c) as sin u cos c + cos u sin c and the like, multiplied out where irrational numbers occur."""
    if not any(_irrational(atom) for atom in force.atoms(sympy.Pow, sympy.NumberSymbol, sympy.Function)):
        return force
    apart = force.replace(lambda e: e.func in _ADDITION and e.args[0].is_Add, _apart)
    return sympy.Add(*_collected(_multiplied_out(apart)))


HIGH: Final = 8
"""Powers beyond this of what is no polynomial stay as they are: multiplied out they may have millions of terms."""


def _multiplied_out(e: sympy.Expr) -> sympy.Expr:
    kept: dict[sympy.Dummy, sympy.Expr] = {}

    def held(power: sympy.Expr) -> sympy.Dummy:
        mark = sympy.Dummy(real=True)
        kept[mark] = power
        return mark

    apart = e.replace(_is_high, held)
    return sympy.expand(apart, power_base=False, log=False).xreplace(kept)


def _is_high(e: sympy.Expr) -> bool:
    high = e.is_Pow and e.exp.is_Rational and abs(e.exp) > HIGH and e.base.has(U, V)
    return bool(high and not e.base.is_polynomial(U, V))


def _irrational(e: sympy.Expr) -> bool:
    return bool(e.is_number) and not e.is_Rational


_ADDITION: Final = {
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


def _named(e: sympy.Expr, names: dict[sympy.Expr, sympy.Symbol]) -> sympy.Expr:
    """Everything that is free of u and u' and not polynomial over the rationals, replaced by names."""
    if e.is_Rational or e.is_Symbol:
        return e
    if e.is_Add or e.is_Mul or e.has(U, V):
        return e.func(*(_named(part, names) for part in e.args))
    if e.is_Pow and e.exp.is_Rational and not e.base.is_number:
        return _named_power(e, names)
    return _name(e, names)


def _named_power(e: sympy.Expr, names: dict[sympy.Expr, sympy.Symbol]) -> sympy.Expr:
    """b^(p/q) of the parameters as a power of the name of b^(1/q) or 1/b^(1/q); of a product factor by factor."""
    if e.base.is_Mul:
        parts = [without_sizes(sympy.Pow(factor, e.exp)) for factor in e.base.args]
        return sympy.Mul(*(_named(part, names) for part in parts))
    if e.exp.is_Integer and e.exp > 0:
        return sympy.Pow(_named(e.base, names), e.exp)
    step = sympy.Rational(1 if e.exp > 0 else -1, e.exp.q)
    return _name(sympy.Pow(e.base, step), names) ** abs(e.exp.p)


def _name(value: sympy.Expr, names: dict[sympy.Expr, sympy.Symbol]) -> sympy.Symbol:
    return names.setdefault(value, sympy.Symbol(f"c{len(names) + 1}{MARK}", real=True))


@dataclass(frozen=True)
class Normalised:
    """An oscillator in natural units: time is tau = k*t, u is unchanged, and ' is d/dtau, so that u'' + u + ... = 0.

    ``force`` is f(u, k*u')/k**2 with every parameter inserted except two that engines expand in and that therefore
    stay as symbols: the linear damping ``mu`` (here standing for mu/k) and the limit cycle's ``eps`` (for eps/k).
    All coefficients are rational when the parameters are and odd powers of u' carry mu or eps.
    ``bound`` is the same force with those two inserted as well.  ``scale`` is k.
    """

    force: sympy.Expr
    bound: sympy.Expr
    scale: sympy.Expr
    damping: sympy.Expr
    """The value of mu/k; 0 when there is no such parameter."""
    small: sympy.Expr | None
    """The value of eps/k of a limit cycle, None elsewhere."""
    potential: sympy.Expr | None
    """Potential of the restoring force in natural units, V(u)/k**2."""
    rational: sympy.Expr
    """``bound`` with symbols for what is not polynomial over the rationals; see ``natural_units``."""
    constants: Mapping[str, sympy.Expr]
    """The values of those symbols by their names, which no parameter can have."""
