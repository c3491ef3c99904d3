"""The value of an expression at the origin, in ball arithmetic: whether it is analytic there, and its sign.

Every node is visited with u = u' = u'' = 0 and the parameters at their values.  Balls decide signs rigorously and
never hang on towers such as exp(exp(exp(100))), which SymPy would try to evaluate.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import sympy
from flint import arb, ctx

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import REAL_FUNCTIONS, rational

PRECISION: Final = 160
MAX_MAGNITUDE: Final = 10_000
"""Largest magnitude of an argument of exp and similar functions; beyond it the numbers leave every useful range."""

Values = Mapping[str, "sympy.Rational | None"]

_UNKNOWNS: Final = ("u", "u'", "u''")


def value_at_origin(expression: sympy.Expr, values: Values) -> arb | None:
    """Return the value of an expression at u = u' = u'' = 0.

    Parameters
    ----------
    expression : sympy.Expr
        In ``U``, ``V``, ``W`` and parameters.
    values : mapping of str to sympy.Rational or None
        The parameters' values by name.

    Returns
    -------
    arb or None
        A ball around it; None when it depends on a parameter without a value.

    Raises
    ------
    InputError
        When the expression is not analytic and real on each side of it (1/u, log(u), u**(1/2), sqrt(-1)), when that
        cannot be decided, or when it overflows.

    Examples
    --------
    >>> u, k = sympy.Symbol("u", real=True), sympy.Symbol("k", real=True)
    >>> value_at_origin(k**2 * sympy.cos(u), {"k": sympy.Rational(3)}) == 9
    True
    """
    with ctx.workprec(PRECISION):
        return _ball(expression, values)


def sign_at_origin(expression: sympy.Expr, values: Values) -> int | None:
    """Return the sign of an expression at u = u' = u'' = 0.

    Parameters
    ----------
    expression : sympy.Expr
        In ``U``, ``V``, ``W`` and parameters.
    values : mapping of str to sympy.Rational or None
        The parameters' values by name.

    Returns
    -------
    int or None
        -1, 0 or 1; None when a parameter is symbolic or the ball cannot tell (zero is only told when exact).

    Raises
    ------
    InputError
        As ``value_at_origin`` does.

    Examples
    --------
    >>> sign_at_origin(sympy.pi - 4, {})
    -1
    """
    value = value_at_origin(expression, values)
    if value is None:
        return None
    if value.is_zero():
        return 0
    return None if value.contains(0) else (1 if value > 0 else -1)


def _ball(expression: sympy.Expr, values: Values) -> arb | None:
    if isinstance(expression, sympy.Rational):
        return arb(rational(expression))
    if isinstance(expression, sympy.Symbol):
        return _symbol(expression, values)
    if expression in (sympy.pi, sympy.E):
        return arb.pi() if expression == sympy.pi else arb(1).exp()
    below = [_ball(argument, values) for argument in expression.args]
    known = [ball for ball in below if ball is not None]
    if isinstance(expression, sympy.Mul) and any(ball.is_zero() for ball in known):
        return arb(0)
    if len(known) < len(below):
        return None
    return _checked(_combined(expression, known), expression)


def _symbol(symbol: sympy.Symbol, values: Values) -> arb | None:
    if symbol.name in _UNKNOWNS:
        return arb(0)
    value = values.get(symbol.name)
    return None if value is None else arb(rational(value))


def _combined(expression: sympy.Expr, known: list[arb]) -> arb:
    if isinstance(expression, sympy.Add):
        return sum(known, arb(0))
    if isinstance(expression, sympy.Mul):
        product = arb(1)
        for ball in known:
            product *= ball
        return product
    if isinstance(expression, sympy.Pow):
        return _power(known[0], expression)
    if isinstance(expression, sympy.Abs):
        return abs(known[0])
    if isinstance(expression, sympy.sign):
        return _sign(known[0], expression)
    if isinstance(expression, sympy.DiracDelta) and not known[0].contains(0):
        return arb(0)  # the slope of a sign, away from where it changes
    function = REAL_FUNCTIONS.get(type(expression).__name__)
    if function is None:
        raise InputError(f"{brief(expression)} is not a real function analytic at the origin; rewrite that term")
    if not known[0].abs_upper() <= MAX_MAGNITUDE:
        raise InputError(f"the argument of {brief(expression)} is beyond {MAX_MAGNITUDE} in magnitude; rescale it")
    return function(known[0])


def _power(base: arb, expression: sympy.Pow) -> arb:
    """Integer powers of nonzero bases, other rational powers of positive ones: elsewhere there is a singularity."""
    exponent = expression.exp
    if not isinstance(exponent, sympy.Rational):
        raise InputError(f"{brief(expression)} has an exponent that is not rational; write it with exp and log")
    whole = isinstance(exponent, sympy.Integer)
    if whole and exponent >= 0:
        return base ** int(exponent)
    if base.is_zero() and exponent > 0 and isinstance(expression.base, sympy.Abs):
        return arb(0)
    if base.contains(0):
        if not any(symbol.name in _UNKNOWNS for symbol in expression.base.free_symbols):
            other = " with the values given; give the parameters other ones" if expression.free_symbols else ""
            raise InputError(f"{brief(expression)} divides by 0{other}")
        raise InputError(
            f"{brief(expression)} is not analytic on both sides of the origin (its base vanishes there); rewrite that "
            "term (powers of abs(u), and odd roots such as u**(1/3), are taken)"
        )
    if not whole and not base > 0:
        raise InputError(f"{brief(expression)} is not real at the origin (its base is negative); rewrite that term")
    return base ** (int(exponent) if whole else arb(rational(exponent)))


def _sign(ball: arb, expression: sympy.Expr) -> arb:
    """0 at 0, the mean of both sides."""
    if ball.contains(0) and not ball.is_zero():
        raise InputError(f"the sign in {brief(expression)} cannot be told; rewrite that term")
    return arb(0) if ball.is_zero() else arb(1 if ball > 0 else -1)


def _checked(ball: arb, expression: sympy.Expr) -> arb:
    if not ball.is_finite():
        raise InputError(f"{brief(expression)} is not finite and real at the origin; rewrite that term")
    return ball


def brief(expression: sympy.Expr, limit: int = 60) -> str:
    """The expression as text for a message, cut when long.

    >>> brief(sympy.Symbol("u") ** 3)
    'u**3'
    """
    text = str(expression).replace("Abs(", "abs(")
    return text if len(text) <= limit else text[: limit - 3] + "..."
