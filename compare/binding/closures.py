"""The kinds of number in which a SymPy expression is evaluated: float, NumPy array, mpmath.

Exact constants are rounded once, on entering the arithmetic.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, Final

import mpmath
import numpy as np
import sympy

from ridgeback.common.number_ring import FUNCTIONS
from ridgeback.symbolic.arithmetic.closures import Evaluator, Library


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


def _is_number(expression: sympy.Expr) -> bool:
    return bool(expression.is_number) and not expression.free_symbols


def _rounded(number: sympy.Expr) -> Evaluator:
    value = _float_constant(number)
    return lambda _: value


def _at_working_precision(number: sympy.Expr) -> Evaluator:
    return lambda _: mp_constant(number)


def _float_power(inner: Evaluator, exponent: sympy.Rational) -> Evaluator:
    if exponent.is_Integer:
        return _whole_power(inner, int(exponent))
    fraction = _float_constant(exponent)
    return lambda x: inner(x) ** fraction


def _precise_power(inner: Evaluator, exponent: sympy.Rational) -> Evaluator:
    if exponent.is_Integer:
        return _whole_power(inner, int(exponent))
    return lambda x: mpmath.power(inner(x), mp_constant(exponent))


def _whole_power(inner: Evaluator, whole: int) -> Evaluator:
    if whole < 0:
        return lambda x: 1 / inner(x) ** (-whole)
    return lambda x: inner(x) ** whole


def _of(module: Any) -> dict[str, Callable[[Any], Any]]:
    return {name: getattr(module, name) for name in FUNCTIONS} | {"Abs": abs, "sign": getattr(module, "sign", _sign)}


def _sign(x: float) -> float:
    """-1, 0 or 1."""
    return math.copysign(1.0, x) if x else 0.0


SCALAR: Final = Library("float", _of(math), _is_number, _rounded, _float_power)
ARRAY: Final = Library("numpy", _of(np), _is_number, _rounded, _float_power)
PRECISE: Final = Library("mpmath", _of(mpmath), _is_number, _at_working_precision, _precise_power)
"""Constants are made again at each evaluation, at mpmath's precision of the moment."""
