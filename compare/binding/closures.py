"""A SymPy expression as a tree of closures: scalar float, NumPy array or mpmath arithmetic.

The tree is walked node by node; no source text is made and nothing is evaluated as text, so that a user's
equation can never become code.  Exact rationals are rounded once, into the arithmetic of the chosen library.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from typing import Any

import mpmath
import numpy as np
import sympy

from ridgeback.common.errors import InputError

Evaluator = Callable[[Sequence[Any]], Any]
"""Takes the values of the symbols in their order, returns the value of the expression."""


@dataclass(frozen=True)
class Library:
    """One arithmetic: its functions by SymPy's class name, and how a SymPy number enters it."""

    name: str
    functions: Mapping[str, Callable[[Any], Any]]
    constant: Callable[[sympy.Expr], Any]
    exact_precision: bool
    """Whether constants depend on a working precision that may change between calls (mpmath)."""


_DIRECT = ("sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "log")
_NAMES = (*_DIRECT, "asin", "acos", "atan", "asinh", "acosh", "atanh")


def _float_constant(number: sympy.Expr) -> float:
    """Round a SymPy number once to float64."""
    if isinstance(number, sympy.Rational):
        return int(number.p) / int(number.q)
    return float(number.evalf(30))


def mp_constant(number: sympy.Expr) -> mpmath.mpf:
    """Return a SymPy number at mpmath's current precision."""
    if isinstance(number, sympy.Rational):
        return mpmath.mpf(int(number.p)) / int(number.q)
    return mpmath.mpf(number.evalf(mpmath.mp.dps + 5))


SCALAR = Library("float", {name: getattr(math, name) for name in _NAMES}, _float_constant, False)
ARRAY = Library("numpy", {name: getattr(np, name) for name in _NAMES}, _float_constant, False)
PRECISE = Library("mpmath", {name: getattr(mpmath, name) for name in _NAMES}, mp_constant, True)


def evaluator(expression: sympy.Expr, symbols: Sequence[sympy.Symbol], library: Library = SCALAR) -> Evaluator:
    """Closure over ``expression`` whose argument is the sequence of values of ``symbols``.

    Raises InputError for a symbol that is not listed and for a function that the library lacks.

    >>> u, v = sympy.symbols("u v")
    >>> evaluator(4 * sympy.sin(u) + v / 2, (u, v))((0.0, 3.0))
    1.5
    """
    if expression.is_number and not expression.free_symbols:
        return _constant(expression, library)
    if isinstance(expression, sympy.Symbol):
        return _argument(expression, symbols)
    if isinstance(expression, sympy.Pow):
        return _power(expression, symbols, library)
    parts = [evaluator(argument, symbols, library) for argument in expression.args]
    if isinstance(expression, sympy.Add):
        return reduce(_sum, parts)
    return reduce(_product, parts) if isinstance(expression, sympy.Mul) else _function(expression, parts, library)


def _sum(left: Evaluator, right: Evaluator) -> Evaluator:
    return lambda x: left(x) + right(x)


def _product(left: Evaluator, right: Evaluator) -> Evaluator:
    return lambda x: left(x) * right(x)


def _constant(number: sympy.Expr, library: Library) -> Evaluator:
    if library.exact_precision:
        return lambda _: library.constant(number)
    value = library.constant(number)
    return lambda _: value


def _argument(symbol: sympy.Symbol, symbols: Sequence[sympy.Symbol]) -> Evaluator:
    if symbol not in symbols:
        known = ", ".join(str(each) for each in symbols)
        raise InputError(f"{symbol} has no value here (known: {known}); give the parameter a number")
    position = list(symbols).index(symbol)
    return lambda x: x[position]


def _power(expression: sympy.Pow, symbols: Sequence[sympy.Symbol], library: Library) -> Evaluator:
    """Raise to a power: integers stay integers, rationals are rounded once, the rest is exp(b log a)."""
    base, exponent = expression.args
    if not exponent.is_Rational:
        return evaluator(sympy.exp(exponent * sympy.log(base), evaluate=False), symbols, library)
    inner = evaluator(base, symbols, library)
    if exponent.is_Integer:
        return _whole_power(inner, int(exponent))
    if library.exact_precision:
        return lambda x: mpmath.power(inner(x), library.constant(exponent))
    fraction = library.constant(exponent)
    return lambda x: inner(x) ** fraction


def _whole_power(inner: Evaluator, whole: int) -> Evaluator:
    if whole < 0:
        return lambda x: 1 / inner(x) ** (-whole)
    return lambda x: inner(x) ** whole


def _function(expression: sympy.Expr, parts: Sequence[Evaluator], library: Library) -> Evaluator:
    name = type(expression).__name__
    if name not in library.functions or len(parts) != 1:
        known = ", ".join(sorted(library.functions))
        raise InputError(f"{name} in {expression} cannot be evaluated with {library.name}; known functions: {known}")
    function, inner = library.functions[name], parts[0]
    return lambda x: function(inner(x))
