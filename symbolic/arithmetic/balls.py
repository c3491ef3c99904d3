"""Numbers as balls: exact input in, rigorous ``arb`` enclosures out, one rounding at the very end."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import reduce
from operator import mul
from typing import Any, Final

import sympy
from flint import arb, arb_poly, ctx, fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.roots import Root, root_ball

_GUARD_BITS: Final = 64

MEROMORPHIC: Final = ("sin", "cos", "tan", "cot", "sinh", "cosh", "tanh", "coth", "exp")
REAL_FUNCTIONS: Final[dict[str, Callable[[arb], arb]]] = {
    name: getattr(arb, name) for name in (*MEROMORPHIC, "log", "asin", "acos", "atan", "asinh", "atanh")
}
"""The functions that SymPy may form of those that can be written, by name, on real balls."""
NUMBER_FUNCTIONS: Final[dict[str, Callable[[arb], arb]]] = {**REAL_FUNCTIONS, "gamma": arb.gamma}
"""Those, and what stands in exact coefficients besides."""


def rational(value: Fraction | sympy.Rational) -> fmpq:
    """Return an exact rational in FLINT's form.

    Parameters
    ----------
    value : Fraction or sympy.Rational
        The number.

    Returns
    -------
    fmpq
        The same number.

    Examples
    --------
    >>> rational(Fraction(2, 6))
    1/3
    """
    return fmpq(int(value.numerator), int(value.denominator))


def ball(value: Any) -> arb:
    """Return a number as a ball.

    Parameters
    ----------
    value : int, float, Fraction, sympy.Rational, mpmath.mpf, arb, fmpq or NumPy float
        The number.

    Returns
    -------
    arb
        Exact for floats and whole numbers, rounded outwards at the working precision else.

    Raises
    ------
    InputError
        For anything else.

    Examples
    --------
    >>> ball(Fraction(1, 4)), ball(0.5)
    (0.250000000000000, 0.500000000000000)
    """
    if isinstance(value, arb | fmpq):
        return arb(value)
    if isinstance(value, Fraction | sympy.Rational):
        return arb(rational(value))
    if hasattr(value, "_mpf_"):
        sign, mantissa, exponent, _ = value._mpf_
        return arb((-int(mantissa) if sign else int(mantissa), int(exponent)))
    if isinstance(value, int | float):
        return arb(value)
    raise InputError(f"{value!r} is a {type(value).__name__}, not a real number; give a float, a fraction or an arb")


def whole_power(x: arb, n: int) -> arb:
    """Return x^n by multiplication: FLINT's own power goes by the logarithm and has no answer on balls around 0.

    Parameters
    ----------
    x : arb
        The base.
    n : int
        The exponent, 0 or more.

    Returns
    -------
    arb
        A ball that contains the power of each point of ``x``.

    Examples
    --------
    >>> whole_power(arb(0, 1), 2).is_finite()
    True
    """
    result = arb(1)
    for _ in range(n):
        result = result * x
    return result


def polynomial_at(coefficients: Sequence[fmpq | arb], x: arb) -> arb:
    """Return the value of a polynomial, its coefficients exact or balls, on a ball.

    Parameters
    ----------
    coefficients
        c_0, c_1, ...
    x
        The argument.

    Returns
    -------
    arb
        A ball that contains the value at each point of ``x``.

    Examples
    --------
    >>> polynomial_at((fmpq(1), fmpq(1, 2)), arb(2))
    2.00000000000000
    """
    return arb_poly(list(coefficients))(x)


def natural_frequency(scale: sympy.Expr) -> arb:
    """Return k, a real number known exactly, as a ball.

    Parameters
    ----------
    scale : sympy.Expr
        k, in rad per time unit.

    Returns
    -------
    arb
        k at the working precision.

    Raises
    ------
    InputError
        When a parameter in it is still symbolic.

    Examples
    --------
    >>> natural_frequency(2 * sympy.sqrt(2)).str(10, radius=False)
    '2.828427125'
    """
    square = sympy.expand(scale**2)
    if square.is_Rational:
        return arb(rational(square)).sqrt()
    if scale.free_symbols:
        raise InputError(f"the natural frequency {scale} has no number for its parameters; set them before evaluating")
    return number_ball(scale)


def number_ball(value: sympy.Expr) -> arb:
    """Return a real number such as sqrt(2)/3 + pi as a ball at the working precision.

    Parameters
    ----------
    value : sympy.Expr
        Sums, products and rational powers of rationals, pi, e and the functions of ``NUMBER_FUNCTIONS``.

    Returns
    -------
    arb
        A ball around it.

    Raises
    ------
    InputError
        For anything else.

    Examples
    --------
    >>> number_ball(sympy.sqrt(2) / 3).str(10, radius=False)
    '0.4714045208'
    """
    if value.is_Rational:
        return arb(rational(value))
    if isinstance(value, Root):
        return root_ball(value)
    if value in (sympy.pi, sympy.E):
        return arb.pi() if value == sympy.pi else arb(1).exp()
    parts = [number_ball(part) for part in value.args]
    if value.is_Add:
        return sum(parts, arb(0))
    if value.is_Mul:
        return reduce(mul, parts)
    if value.is_Pow and value.exp.is_Rational:
        return arb(parts[0] ** (int(value.exp) if value.exp.is_Integer else parts[1]))
    function = NUMBER_FUNCTIONS.get(type(value).__name__)
    if function is None or len(parts) != 1:
        raise InputError(f"{value} is no real number that balls know; write it with roots, pi and elementary functions")
    return function(parts[0])


def scalar_ball(value: Any, names: Sequence[str], constants: Mapping[str, sympy.Expr]) -> arb:
    """Return a coefficient, a rational or a polynomial in named constants, as a ball at the working precision.

    Parameters
    ----------
    value : fmpq or fmpq_mpoly
        A polynomial is one in (y, *names), free of y.
    names : sequence of str
        Its variables.
    constants : mapping of str to sympy.Expr
        Their values.

    Returns
    -------
    arb
        A ball around its value.

    Examples
    --------
    >>> scalar_ball(fmpq(1, 4), (), {})
    0.250000000000000
    """
    if isinstance(value, int | fmpq):
        return arb(value)
    known = [number_ball(constants[name]) for name in names]
    total = arb(0)
    for powers, coefficient in value.to_dict().items():
        factors = (whole_power(x, int(n)) for x, n in zip(known, powers[1:], strict=True) if n)
        total += reduce(mul, factors, arb(coefficient))
    return total


def evaluated(function: Callable[[arb], arb], value: Any) -> Any:
    """Evaluate a function of balls at a float, at each element of an array, or at an mpf in its own precision.

    Parameters
    ----------
    function : callable
        Takes and returns an ``arb``.
    value : float, int, Fraction, mpmath.mpf or array
        Where to evaluate it.

    Returns
    -------
    float, mpmath.mpf or array
        Of the type of ``value`` (a float for whole numbers and fractions), with one rounding.

    Examples
    --------
    >>> import mpmath
    >>> evaluated(lambda x: x.sqrt(), 2.0) == 2.0**0.5
    True
    >>> evaluated(lambda x: x.sqrt(), mpmath.mpf(2)) == mpmath.sqrt(2)
    True
    """
    if hasattr(value, "flat") and value.ndim > 0:
        result = value * 1.0
        result.flat[:] = [evaluated(function, x) for x in value.flat]
        return result
    if not hasattr(value, "_mpf_"):
        with ctx.workprec(53 + _GUARD_BITS):
            return float(function(ball(value)))
    with ctx.workprec(value.context.prec + _GUARD_BITS):
        mantissa, exponent = function(ball(value)).mid().man_exp()
    return type(value)(int(mantissa)) * type(value)(2) ** int(exponent)
