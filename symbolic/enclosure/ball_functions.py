"""A SymPy expression in the unknown as a function on balls: real (arb) or complex (acb).

The tree becomes closures once; no text is made of it.  On complex balls every function answers not-a-number when its
ball touches a branch cut or a pole, so that a finite answer proves the expression analytic on the whole ball.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import reduce
from typing import Any, Final, TypeAlias

import sympy
from flint import acb, arb, ctx

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import rational
from ridgeback.symbolic.grammar.at_origin import brief
from ridgeback.symbolic.grammar.parse import U

Ball: TypeAlias = Any
"""An ``arb`` or an ``acb``; python-flint has no types of its own."""

Function: TypeAlias = Callable[[Ball], Ball]


def _complex_log(z: acb) -> acb:
    return z.log(analytic=True)


def _complex_sqrt(z: acb) -> acb:
    return z.sqrt(analytic=True)


# DLMF 4.37.16, 4.37.24: the principal branches through log and sqrt, which know their cuts; asin and atan by rotation.
def _complex_atanh(z: acb) -> acb:
    return (_complex_log(1 + z) - _complex_log(1 - z)) / 2


def _complex_asinh(z: acb) -> acb:
    return _complex_log(z + _complex_sqrt(1 + z * z))


def _complex_atan(z: acb) -> acb:
    return _complex_atanh(z * acb(0, 1)) * acb(0, -1)


def _complex_asin(z: acb) -> acb:
    return _complex_asinh(z * acb(0, 1)) * acb(0, -1)


_MEROMORPHIC: Final = ("sin", "cos", "tan", "cot", "sinh", "cosh", "tanh", "coth", "exp")
_REAL: Final[dict[str, Function]] = {
    name: getattr(arb, name) for name in (*_MEROMORPHIC, "log", "asin", "atan", "asinh", "atanh")
}
_COMPLEX: Final[dict[str, Function]] = {
    **{name: getattr(acb, name) for name in _MEROMORPHIC},
    "log": _complex_log,
    "asin": _complex_asin,
    "atan": _complex_atan,
    "asinh": _complex_asinh,
    "atanh": _complex_atanh,
}


def ball_function(expression: sympy.Expr, bits: int, *, complex_: bool = False) -> Function:
    """The expression as a function of ``U`` on balls, its constants held to ``bits`` bits.

    The answer to a ball contains the value at each of its points.  Raises InputError for a symbol without a value and
    for a function that balls do not know.

    >>> f = ball_function(sympy.sin(U) / 2, 64)
    >>> f(arb(0)).is_zero(), f(arb(1)).contains(arb(1).sin() / 2)
    (True, True)
    """
    with ctx.workprec(bits):
        return _compiled(expression, complex_)


def number(expression: sympy.Expr) -> arb:
    """A ball around a real number such as sqrt(2)/3, at the present precision; InputError when it is none.

    >>> number(sympy.sqrt(2)).contains(arb(2).sqrt().mid())
    True
    """
    return arb(_compiled(expression, False)(arb(0)))


def _compiled(e: sympy.Expr, complex_: bool) -> Function:
    if e == U:
        return acb if complex_ else arb  # FLINT's unbound methods do not check the type that they are called with
    if isinstance(e, sympy.Symbol):
        raise InputError(f"the parameter {e} has no value, and a ball needs numbers; give it one, e.g. --set {e}=1")
    if isinstance(e, sympy.Rational):
        return _constant(arb(rational(e)), complex_)
    if e in (sympy.pi, sympy.E):
        return _constant(arb.pi() if e == sympy.pi else arb(1).exp(), complex_)
    if isinstance(e, sympy.Pow):
        return _power(e, complex_)
    parts = [_compiled(argument, complex_) for argument in e.args]
    if isinstance(e, sympy.Add):
        return reduce(_sum, parts)
    if isinstance(e, sympy.Mul):
        return reduce(_product, parts)
    return _function(e, parts, complex_)


def _constant(value: arb, complex_: bool) -> Function:
    typed = acb(value) if complex_ else value
    return lambda _: typed


def _sum(f: Function, g: Function) -> Function:
    return lambda x: f(x) + g(x)


def _product(f: Function, g: Function) -> Function:
    return lambda x: f(x) * g(x)


def _function(e: sympy.Expr, parts: list[Function], complex_: bool) -> Function:
    known = (_COMPLEX if complex_ else _REAL).get(type(e).__name__)
    if known is None or len(parts) != 1:
        raise InputError(f"{brief(e)} has no rule in ball arithmetic; known functions: {', '.join(sorted(_REAL))}")
    function, inner = known, parts[0]
    return lambda x: function(inner(x))


def _power(e: sympy.Pow, complex_: bool) -> Function:
    base, exponent = e.args
    if not isinstance(exponent, sympy.Rational):
        raise InputError(f"the power {brief(e)} has no rational exponent; write it with exp and log")
    inner = _compiled(base, complex_)
    if isinstance(exponent, sympy.Integer):
        return _whole_power(inner, int(exponent))
    return _root_power(inner, exponent, complex_)


def _whole_power(inner: Function, exponent: int) -> Function:
    if exponent == 2:
        return lambda x: _squared(inner(x))
    if exponent < 0:
        positive = inner if exponent == -1 else _whole_power(inner, -exponent)
        return lambda x: 1 / positive(x)
    return lambda x: _raised(inner(x), exponent)


def _raised(y: Ball, exponent: int) -> Ball:
    """y**exponent by squaring; arb's own power is not-a-number on a tiny ball around 0."""
    if exponent == 1:
        return y
    square = _squared(_raised(y, exponent // 2))
    return square * y if exponent % 2 else square


def _squared(y: Ball) -> Ball:
    """y**2, never negative for a real ball (y*y would forget that both factors are one number)."""
    return (y * y).nonnegative_part() if isinstance(y, arb) and y.contains(0) else y * y


def _root_power(inner: Function, exponent: sympy.Rational, complex_: bool) -> Function:
    """Half-integer powers by the root, others by exp(r log y); each is analytic off the negative axis."""
    if exponent.q == 2:
        root: Function = _complex_sqrt if complex_ else arb.sqrt
        rooted: Function = lambda x: root(inner(x))  # noqa: E731 - a closure, like its neighbours
        return rooted if exponent.p == 1 else _whole_power(rooted, int(exponent.p))
    log, ratio = (_complex_log if complex_ else arb.log), arb(rational(exponent))
    return lambda x: (ratio * log(inner(x))).exp()
