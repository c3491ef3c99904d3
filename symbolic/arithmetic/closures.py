"""A SymPy expression as a tree of closures over any kind of number: floats, arrays, multiple precision, balls.

The tree is walked node by node; no source text is made and nothing is evaluated as text, so that a user's equation can
never become code.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from typing import Any, TypeAlias

import sympy

from ridgeback.common.errors import InputError

Evaluator: TypeAlias = Callable[[Sequence[Any]], Any]
"""Takes the values of the symbols in their order, returns the value of the expression."""


@dataclass(frozen=True)
class Library:
    """One kind of number.

    Parameters
    ----------
    name
        For messages.
    functions
        Its elementary functions by SymPy's class name.
    takes
        Whether a sub-expression is a constant that ``constant`` brings into this kind as a whole.
    constant
        Makes the closure of such a constant.
    power
        Makes the closure of a rational power of a closure.
    """

    name: str
    functions: Mapping[str, Callable[[Any], Any]]
    takes: Callable[[sympy.Expr], bool]
    constant: Callable[[sympy.Expr], Evaluator]
    power: Callable[[Evaluator, sympy.Rational], Evaluator]


def evaluator(expression: sympy.Expr, symbols: Sequence[sympy.Symbol], library: Library) -> Evaluator:
    """Turn an expression into a function of the values of its symbols.

    Parameters
    ----------
    expression
        Of sums, products, powers and the functions of ``library``; a power that is not rational is exp(b log a).
    symbols
        Those that get values, in the order in which they will be given.
    library
        The kind of number.

    Returns
    -------
    Evaluator
        Takes one sequence, the values.

    Raises
    ------
    InputError
        For a symbol that is not listed and for a function that the library lacks.

    Examples
    --------
    >>> from fractions import Fraction
    >>> rationals = Library(
    ...     "rationals", {}, lambda e: e.is_Rational, lambda e: lambda _: Fraction(int(e.p), int(e.q)),
    ...     lambda base, n: lambda x: base(x) ** int(n),
    ... )
    >>> u, v = sympy.symbols("u v")
    >>> str(evaluator(u**2 / 3 + v, (u, v), rationals)((Fraction(1, 2), 1)))
    '13/12'
    """
    if library.takes(expression):
        return library.constant(expression)
    if isinstance(expression, sympy.Symbol):
        return _argument(expression, symbols)
    if isinstance(expression, sympy.Pow):
        base, exponent = expression.args
        if not exponent.is_Rational:
            return evaluator(sympy.exp(exponent * sympy.log(base), evaluate=False), symbols, library)
        return library.power(evaluator(base, symbols, library), exponent)
    parts = [evaluator(argument, symbols, library) for argument in expression.args]
    if isinstance(expression, sympy.Add):
        return reduce(_sum, parts)
    return reduce(_product, parts) if isinstance(expression, sympy.Mul) else _function(expression, parts, library)


def _sum(left: Evaluator, right: Evaluator) -> Evaluator:
    return lambda x: left(x) + right(x)


def _product(left: Evaluator, right: Evaluator) -> Evaluator:
    return lambda x: left(x) * right(x)


def _argument(symbol: sympy.Symbol, symbols: Sequence[sympy.Symbol]) -> Evaluator:
    if symbol not in symbols:
        known = ", ".join(str(each) for each in symbols)
        raise InputError(
            f"{symbol} has no value here (known: {known}); give the parameter a number, e.g. --set {symbol}=1"
        )
    position = list(symbols).index(symbol)
    return lambda x: x[position]


def _function(expression: sympy.Expr, parts: Sequence[Evaluator], library: Library) -> Evaluator:
    name = type(expression).__name__
    if name not in library.functions or len(parts) != 1:
        known = ", ".join(sorted(library.functions))
        raise InputError(f"{name} in {expression} cannot be evaluated with {library.name}; known functions: {known}")
    function, inner = library.functions[name], parts[0]
    return lambda x: function(inner(x))
