"""A SymPy expression in the unknown as a function on balls: real (arb) or complex (acb).

The tree becomes closures once; no text is made of it.  On complex balls every function answers not-a-number when its
ball touches a branch cut or a pole, so that a finite answer proves the expression analytic on the whole ball.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final, TypeAlias

import sympy
from flint import acb, arb, ctx

from ridgeback.symbolic.arithmetic.balls import MEROMORPHIC, REAL_FUNCTIONS, rational
from ridgeback.symbolic.arithmetic.closures import Evaluator, Library, evaluator
from ridgeback.symbolic.arithmetic.roots import Root, root_ball
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


_COMPLEX: Final[dict[str, Function]] = {
    **{name: getattr(acb, name) for name in MEROMORPHIC},
    "log": _complex_log,
    "asin": _complex_asin,
    "atan": _complex_atan,
    "asinh": _complex_asinh,
    "atanh": _complex_atanh,
}


def ball_function(expression: sympy.Expr, bits: int, *, complex_: bool = False) -> Function:
    """The expression as a function of ``U`` on balls, its constants known to ``bits`` bits.

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
    kind, values = (acb, evaluator(e, (U,), COMPLEX)) if complex_ else (arb, evaluator(e, (U,), REAL))
    return lambda x: values((kind(x),))  # FLINT's unbound methods do not check the type that they are called with


def _is_leaf(e: sympy.Expr) -> bool:
    return isinstance(e, sympy.Rational | Root) or e in (sympy.pi, sympy.E)


def _leaf(e: sympy.Expr) -> arb:
    if isinstance(e, sympy.Rational):
        return arb(rational(e))
    if isinstance(e, Root):
        return root_ball(e)
    return arb.pi() if e == sympy.pi else arb(1).exp()


def _real_constant(e: sympy.Expr) -> Evaluator:
    value = _leaf(e)
    return lambda _: value


def _complex_constant(e: sympy.Expr) -> Evaluator:
    value = acb(_leaf(e))
    return lambda _: value


def _real_power(inner: Evaluator, exponent: sympy.Rational) -> Evaluator:
    return _power(inner, exponent, arb.sqrt, arb.log)


def _complex_power(inner: Evaluator, exponent: sympy.Rational) -> Evaluator:
    return _power(inner, exponent, _complex_sqrt, _complex_log)


def _power(inner: Evaluator, exponent: sympy.Rational, root: Function, log: Function) -> Evaluator:
    """Half-integer powers by the root, others by exp(r log y); each is analytic off the negative axis."""
    if isinstance(exponent, sympy.Integer):
        return _whole_power(inner, int(exponent))
    if exponent.q == 2:
        return _whole_power(lambda x: root(inner(x)), int(exponent.p))
    ratio = arb(rational(exponent))
    return lambda x: (ratio * log(inner(x))).exp()


def _whole_power(inner: Evaluator, exponent: int) -> Evaluator:
    if exponent == 1:
        return inner
    if exponent == 2:
        return lambda x: _squared(inner(x))
    if exponent < 0:
        positive = _whole_power(inner, -exponent)
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


REAL: Final = Library("balls", REAL_FUNCTIONS, _is_leaf, _real_constant, _real_power)
COMPLEX: Final = Library("complex balls", _COMPLEX, _is_leaf, _complex_constant, _complex_power)
"""The constants of both have the working precision at which the closure is made."""
