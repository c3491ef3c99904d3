"""An oscillator from a SymPy equation or expression, taken as an object: its tree becomes ours, node by node.

What is not in our grammar is refused as it is in text, so that both ways in lead to the same oscillator.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import partial, reduce
from typing import Final, Literal, cast

import sympy
from sympy.core.function import AppliedUndef

from ridgeback.common.errors import InputError
from ridgeback.symbolic.grammar.nodes import (
    Call,
    Name,
    Negate,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Unknown,
    extreme,
    to_text,
)
from ridgeback.symbolic.grammar.to_sympy import FUNCTIONS

NAME: Final = re.compile(r"[A-Za-z_][A-Za-z_0-9]*")
CALLS: Final[Mapping[type, str]] = {
    **{kind: name for name, kind in FUNCTIONS.items() if isinstance(kind, type)},
    sympy.Abs: "abs",
    sympy.sign: "sign",
}


@dataclass(frozen=True)
class Roles:
    """Which SymPy object is the unknown, and which are its derivatives, by how often they are differentiated."""

    unknown: str
    place: sympy.Expr

    def derivative_of(self, item: sympy.Expr) -> int | None:
        """How often the unknown is differentiated in ``item``; None where it is something else."""
        if item == self.place:
            return 0
        if isinstance(item, sympy.Derivative) and item.expr == self.place:
            return int(item.derivative_count)
        return None


def equation_text(given: sympy.Expr | sympy.Eq, *, unknown: str | None = None) -> str:
    """The equation of motion as text in Ridgeback's own grammar.

    Parameters
    ----------
    given : sympy.Eq or sympy.Expr
        An equation, or what is to vanish, in a function of time and its derivatives.  Without a second derivative an
        expression is the force f(u, u') of ``u'' + f = 0``; it may then be in a plain symbol.
    unknown : str, optional
        The symbol that is the unknown, where an expression holds several.

    Returns
    -------
    str
        Such as ``"u'' + k**2*sin(u) = 0"``.

    Raises
    ------
    InputError
        When it is not clear which name is the unknown, and for what the grammar does not have.

    Examples
    --------
    >>> t, k = sympy.symbols("t k")
    >>> u = sympy.Function("u")
    >>> equation_text(sympy.Eq(u(t).diff(t, 2), -(k**2) * sympy.sin(u(t))))
    "k**2*sin(u) + u'' = 0"
    >>> x = sympy.Symbol("x")
    >>> equation_text(x + x**3 / 3)
    "x'' + x**3/3 + x = 0"
    """
    left = given.lhs - given.rhs if isinstance(given, sympy.Eq) else given
    if not isinstance(left, sympy.Expr):
        raise InputError(f"{type(given).__name__} {shown(given)} is no equation; give an Eq or what is to vanish")
    roles = roles_in(left, unknown)
    node = converted(left, roles)
    if not holds_acceleration(left, roles):
        if isinstance(given, sympy.Eq):
            raise InputError(f"{shown(given)} has no second derivative of {roles.unknown}; add u(t).diff(t, 2)")
        node = Sum((Unknown(2), *(node.terms if isinstance(node, Sum) else (node,))))
    return to_text(node, unknown=roles.unknown) + " = 0"


def shown(given: object) -> str:
    """An object in a one-line message."""
    text = " ".join(str(given).split())
    return text if len(text) <= 60 else f"{text[:57]}..."


def roles_in(left: sympy.Expr, unknown: str | None) -> Roles:
    """Find the unknown: the one function of time, else the one symbol, the one that is named, or ``u``.

    >>> u, k = sympy.symbols("u k")
    >>> roles_in(k * u, None).unknown
    'u'
    """
    functions = sorted(left.atoms(AppliedUndef), key=str)
    if len(functions) > 1:
        raise InputError(f"{' and '.join(map(str, functions))} occur; an oscillator has one unknown function")
    if functions:
        function = functions[0]
        if len(function.args) != 1 or not isinstance(function.args[0], sympy.Symbol):
            raise InputError(f"the unknown {function} is no function of time alone; write for example u(t)")
        return Roles(named(function.func.__name__), function)
    symbols = {symbol.name: symbol for symbol in left.free_symbols if isinstance(symbol, sympy.Symbol)}
    chosen = unknown or (next(iter(symbols)) if len(symbols) == 1 else "u")
    if chosen not in symbols:
        raise InputError(
            f"{shown(left)} holds {', '.join(sorted(symbols)) or 'no symbol'}; say which is the unknown "
            "(unknown='x'), or write the equation in a function of time"
        )
    return Roles(named(chosen), symbols[chosen])


def named(name: str) -> str:
    r"""A name that can be written in an equation; a LaTeX name loses its backslash.

    >>> named(r"\theta")
    'theta'
    """
    plain = name.lstrip("\\")
    if not NAME.fullmatch(plain):
        raise InputError(f"the name {name!r} cannot be written in an equation; use letters, digits and _")
    return plain


def holds_acceleration(left: sympy.Expr, roles: Roles) -> bool:
    """Whether a second derivative of the unknown occurs."""
    return any(roles.derivative_of(item) == 2 for item in left.atoms(sympy.Derivative))


def converted(item: sympy.Basic, roles: Roles) -> Node:
    """One SymPy expression as a tree of our grammar; InputError for what the grammar does not have."""
    expression = cast(sympy.Expr, item)
    times = roles.derivative_of(expression)
    if times is not None:
        if times > 2:
            raise InputError(
                f"{shown(item)} is a derivative of order {times}; an equation of motion ends at the second"
            )
        return Unknown(cast(Literal[0, 1, 2], times))
    if isinstance(expression, sympy.Float):
        return rational(Fraction(str(expression)))
    if isinstance(expression, sympy.Rational):
        return rational(Fraction(int(expression.p), int(expression.q)))
    if expression is sympy.pi:
        return Name("pi")
    if expression is sympy.E:
        return Call("exp", Number(Fraction(1)))
    if isinstance(expression, sympy.Symbol):
        return Name(named(expression.name))
    return compound(expression, roles)


def rational(value: Fraction) -> Node:
    """An exact number as our grammar writes it."""
    size = abs(value)
    whole = Number(Fraction(size.numerator))
    node = whole if size.denominator == 1 else Quotient(whole, Number(Fraction(size.denominator)))
    return Negate(node) if value < 0 else node


def compound(expression: sympy.Expr, roles: Roles) -> Node:
    """Sums, products, powers and the functions that the grammar knows."""
    match expression:
        case sympy.Add():
            return Sum(tuple(converted(term, roles) for term in expression.as_ordered_terms()))
        case sympy.Mul():
            return product(expression, roles)
        case sympy.Pow():
            return power(expression, roles)
        case sympy.Max() | sympy.Min():
            which = "max" if isinstance(expression, sympy.Max) else "min"
            return reduce(partial(extreme, which), (converted(argument, roles) for argument in expression.args))
    name = CALLS.get(type(expression))
    if name is None:
        raise InputError(f"{shown(expression)} is not in the grammar; it has {', '.join(FUNCTIONS)}, powers and pi")
    return Call(name, converted(expression.args[0], roles))


def product(expression: sympy.Mul, roles: Roles) -> Node:
    """A product with its sign in front and one quotient: numerator over denominator."""
    above, below = expression.as_numer_denom()
    if below != 1:
        return quotient(above, below, roles)
    sign, rest = expression.as_coeff_Mul()
    if sign < 0:
        return Negate(converted(sympy.Mul(-sign, rest), roles))
    return Product(tuple(converted(factor, roles) for factor in expression.as_ordered_factors()))


def quotient(above: sympy.Expr, below: sympy.Expr, roles: Roles) -> Node:
    """``above/below`` with the sign of its number in front."""
    if above.could_extract_minus_sign():
        return Negate(Quotient(converted(-above, roles), converted(below, roles)))
    return Quotient(converted(above, roles), converted(below, roles))


def power(expression: sympy.Pow, roles: Roles) -> Node:
    """A power; one with a negative exponent is a quotient, and e to a power is ``exp``."""
    base, exponent = expression.as_base_exp()
    if base is sympy.E:
        return Call("exp", converted(exponent, roles))
    if exponent.is_Rational and exponent < 0:
        return Quotient(Number(Fraction(1)), converted(sympy.Pow(base, -exponent), roles))
    return Power(converted(base, roles), converted(exponent, roles))
