"""abs, sign and real powers of u and u': what is analytic on each side of a place and not at it.

abs and sign go factor by factor, so that only |u|, |u'|, |u - s| and their signs are left, with one kink each: at rest,
or at a stop u = s; a power with an odd denominator is the real one: u^(1/3) = sign(u) |u|^(1/3).
"""

from __future__ import annotations

from typing import Final

import sympy

from ridgeback.common.errors import InputError

U: Final = sympy.Symbol("u", real=True)
V: Final = sympy.Symbol("u'", real=True)
W: Final = sympy.Symbol("u''", real=True)
KINKS: Final = (sympy.Abs(U), sympy.sign(U), sympy.Abs(V), sympy.sign(V))
"""Those at rest; others are |u - s| and sign(u - s)."""


def absolute(e: sympy.Expr) -> sympy.Expr:
    """|e| of a product of powers of u, u' and a*u + b, factor by factor.

    Raises InputError for any other argument, which may change sign anywhere.

    >>> absolute(-3 * U**3), absolute(2 * U - 4)
    (3*u**2*Abs(u), 2*Abs(u - 2))
    """
    return sympy.Mul(*(_power_of(sympy.Abs, factor) for factor in _factors(e, "abs")))


def sign(e: sympy.Expr) -> sympy.Expr:
    """The sign of a product of powers of u, u' and a*u + b, factor by factor; raises InputError as ``absolute`` does.

    >>> sign(-3 * U**3), sign(U**2 * V)
    (-sign(u), sign(u'))
    """
    return sympy.Mul(*(_power_of(sympy.sign, factor) for factor in _factors(e, "sign")))


def real_power(base: sympy.Expr, exponent: sympy.Expr) -> sympy.Expr:
    """A power; of a product of powers of u and u' to a fraction with an odd denominator the real one.

    >>> real_power(U, sympy.Rational(1, 3)), real_power(-8 * V, sympy.Rational(2, 3))
    (Abs(u)**(1/3)*sign(u), 4*Abs(u')**(2/3))
    """
    broken = exponent.is_Rational and not exponent.is_Integer and exponent.q % 2
    factors = sympy.Mul.make_args(base)
    if not broken or not base.has(U, V) or not all(_simple(f) and not is_straight(_base(f)) for f in factors):
        return sympy.Pow(base, exponent)
    turned = sign(base) if exponent.p % 2 else sympy.S.One
    return turned * sympy.Mul(*(sympy.Pow(*_raised(f, exponent)) for f in sympy.Mul.make_args(absolute(base))))


def _base(factor: sympy.Expr) -> sympy.Expr:
    base, _ = factor.as_base_exp()
    return base.args[0] if is_kink(base) else base


def _raised(factor: sympy.Expr, exponent: sympy.Expr) -> tuple[sympy.Expr, sympy.Expr]:
    base, power = factor.as_base_exp()
    return (base, power * exponent) if is_kink(base) else (factor, exponent)


def _factors(e: sympy.Expr, name: str) -> tuple[sympy.Expr, ...]:
    factors = tuple(sympy.Mul.make_args(e))
    strange = [factor for factor in factors if not _simple(factor)]
    if strange:
        raise InputError(
            f"{name}({e}) may change sign where nobody can tell; {name} takes u, u', a*u + b and products of their "
            "powers, as in abs(u'), abs(u)**(3/2) or abs(u - 1), and other functions take these, as sin(abs(u))"
        )
    return factors


def _simple(factor: sympy.Expr) -> bool:
    base, exponent = factor.as_base_exp()
    known = base in (U, V) or is_kink(base) or is_straight(base)
    return (known and bool(exponent.is_Rational)) or not factor.has(U, V, W)


def is_straight(e: sympy.Expr) -> bool:
    """Whether an expression is a*u + b with neither 0 nor in u.

    >>> is_straight(2 * U - 1), is_straight(U**2 - 1), is_straight(U)
    (True, False, False)
    """
    if not e.has(U) or e.has(V, W) or not e.is_Add:
        return False
    slope = e.diff(U)
    return not slope.has(U) and slope != 0


def is_kink(e: sympy.Expr) -> bool:
    """Whether an expression is abs or sign of u, u' or a*u + b.

    >>> is_kink(abs(U)), is_kink(sympy.sign(U - 1)), is_kink(abs(sympy.Symbol("k", real=True)))
    (True, True, False)
    """
    return isinstance(e, (sympy.Abs, sympy.sign)) and (e in KINKS or is_straight(e.args[0]))


def _power_of(function: type, factor: sympy.Expr) -> sympy.Expr:
    """|x^r| = |x|^r and sign(x^n) = sign(x)^n, each in its shortest form."""
    base, exponent = factor.as_base_exp()
    if not (base in (U, V) or is_kink(base) or is_straight(base)):
        return function(factor)
    size = base.args[0] if is_kink(base) else base
    slope = size.diff(U) if is_straight(size) else sympy.S.One
    kink = function(sympy.expand(size / slope))
    if function is sympy.Abs:
        return sympy.S.One if isinstance(base, sympy.sign) else sympy.Pow(sympy.Abs(slope) * kink, exponent)
    odd = bool(exponent.is_Integer and exponent % 2) and not isinstance(base, sympy.Abs)
    return sympy.sign(slope) * kink if odd else sympy.S.One
