"""From our expression tree to SymPy, node by node, with every number and constant bounded beforehand."""

from __future__ import annotations

from typing import Final

import sympy

from ridgeback.common.errors import InputError
from ridgeback.symbolic.grammar.at_origin import value_at_origin
from ridgeback.symbolic.grammar.kinks import U, V, W, absolute, real_power, sign
from ridgeback.symbolic.grammar.nodes import (
    Name,
    Negate,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Unknown,
    children,
    to_text,
)
from ridgeback.symbolic.grammar.size import measure
from ridgeback.symbolic.grammar.tokens import quoted

FUNCTIONS: Final = {
    "sin": sympy.sin,
    "cos": sympy.cos,
    "tan": sympy.tan,
    "sinh": sympy.sinh,
    "cosh": sympy.cosh,
    "tanh": sympy.tanh,
    "exp": sympy.exp,
    "log": sympy.log,
    "sqrt": sympy.sqrt,
    "asin": sympy.asin,
    "atan": sympy.atan,
    "asinh": sympy.asinh,
    "atanh": sympy.atanh,
    "abs": absolute,
    "sign": sign,
}


def to_sympy(node: Node) -> sympy.Expr:
    """The tree as a SymPy expression in ``U``, ``V``, ``W`` and one real symbol per parameter.

    Only trees accepted by ``measure`` are built, so no number or power explodes.  Raises InputError for a parameter
    called ``u`` beside another unknown (it is the name of ``U``) or ``t`` (time does not occur in an autonomous
    equation), and for what is not finite, real and analytic on each side of the origin.

    >>> from ridgeback.symbolic.grammar.nodes import Call
    >>> to_sympy(Call("sin", Negate(Unknown(0))))
    -sin(u)
    """
    measure(node)
    return _convert(node)


def _convert(node: Node) -> sympy.Expr:
    below = [_convert(child) for child in children(node)]
    match node:
        case Number(value=value):
            return sympy.Rational(value.numerator, value.denominator)
        case Name():
            return _symbol(node)
        case Unknown(derivative=derivative):
            return (U, V, W)[derivative]
        case Negate():
            return -below[0]
        case Sum():
            return sympy.Add(*below)
        case Product():
            return sympy.Mul(*below)
        case Quotient():
            return _finite(below[0] / _bounded(below[1], node), node)
        case Power():
            return _finite(real_power(_bounded(below[0], node), below[1]), node)
    return _finite(_called(node.function, _bounded(below[0], node), node), node)


def _called(function: str, argument: sympy.Expr, node: Node) -> sympy.Expr:
    try:
        return FUNCTIONS[function](argument)
    except InputError as error:
        raise InputError(f"{error} (column {node.column})") from None


def _symbol(node: Name) -> sympy.Expr:
    if node.name == "pi":
        return sympy.pi
    if node.name == U.name:
        raise InputError(f"the parameter 'u' at column {node.column} is taken by the unknown; give it another name")
    if node.name == "t":
        raise InputError(
            f"'t' at column {node.column} would be time, which may not occur; rename it if it is a parameter"
        )
    return sympy.Symbol(node.name, real=True)


def _bounded(expression: sympy.Expr, node: Node) -> sympy.Expr:
    """Refuse constants like exp(exp(exp(100))) before SymPy tries to evaluate a function of them."""
    if not expression.free_symbols:
        _check_at_origin(expression, node)
    return expression


def _finite(expression: sympy.Expr, node: Node) -> sympy.Expr:
    """Refuse what is infinite or complex at the origin, also roots of u, over whose sign SymPy would take long."""
    if expression.has(sympy.zoo, sympy.nan, sympy.oo, -sympy.oo, sympy.I):
        raise InputError(f"{quoted(to_text(node))} at column {node.column} is not a finite real number; change it")
    _check_at_origin(expression, node)
    return expression


def _check_at_origin(expression: sympy.Expr, node: Node) -> None:
    try:
        value_at_origin(expression, {})
    except InputError as error:
        raise InputError(f"{error} (column {node.column})") from None
