r"""Coefficients in parameters, rational functions times powers of the natural frequency, in their shortest form.

    R k^n,  k = sqrt(q):    R = N / (D q^j)  ->  N / D * q^(n/2 - j)

so that sqrt(1 - w^2) (w^2/(4 - 4 w^2) - 1/(16 (1 - w^2))) is (4 w^2 - 1) / (16 sqrt(1 - w^2)).
"""

from __future__ import annotations

from typing import Final

import sympy

from ridgeback.symbolic.arithmetic.roots import reduced, root_in

LARGEST: Final = 4000
"""Operations beyond which a coefficient is left as it comes: cancelling would take longer than deriving it did."""


def tidy(rational: sympy.Expr, k: sympy.Expr, power: int) -> sympy.Expr:
    """Return ``rational * k**power`` over one denominator, with the powers of k brought together.

    Parameters
    ----------
    rational : sympy.Expr
        A rational function of the parameters; others are multiplied as they are.
    k : sympy.Expr
        The natural frequency: a rational function of the parameters or the square root of one.
    power : int
        The power of k.

    Returns
    -------
    sympy.Expr
        The same value.

    Examples
    --------
    >>> w = sympy.Symbol("w", real=True)
    >>> tidy((4 * w**2 - 1) / (16 - 16 * w**2), sympy.sqrt(1 - w**2), 1)
    (4*w**2 - 1)/(16*sqrt(1 - w**2))
    """
    root = root_in(rational) or root_in(k)
    if root is not None and not rational.free_symbols:
        whole, odd = divmod(power, 2)
        return reduced(rational * reduced(k**2, root) ** whole, root) * k**odd
    symbols = rational.free_symbols | k.free_symbols
    square = sympy.expand(k**2)
    plain = rational.is_rational_function(*symbols) and square.is_rational_function(*symbols)
    if not symbols or not plain or rational.count_ops() > LARGEST:
        return rational * k**power
    if k.is_rational_function(*symbols):
        return sympy.cancel(rational * k**power)
    whole, odd = divmod(power, 2)
    value = sympy.cancel(rational * square**whole)
    return _times_root(value, square) if odd else value


def _times_root(value: sympy.Expr, square: sympy.Expr) -> sympy.Expr:
    """value * sqrt(square), with the root in the denominator where its square was there."""
    above, below = sympy.fraction(value)
    top, bottom = sympy.fraction(sympy.cancel(square))
    times = 0
    while top.free_symbols and (rest := _exact_quotient(below, top)) is not None:
        below, times = rest, times + 1
    outer = sympy.cancel(above / (below * bottom**times))
    upper, lower = sympy.fraction(sympy.together(outer))
    return sympy.Mul(upper, 1 / lower, sympy.Pow(top / bottom, sympy.Rational(1, 2) - times))


def _exact_quotient(value: sympy.Expr, by: sympy.Expr) -> sympy.Expr | None:
    """The quotient of two polynomials where there is no rest, else None."""
    quotient, rest = sympy.div(value, by, *sorted(by.free_symbols | value.free_symbols, key=str))
    return quotient if rest == 0 else None
