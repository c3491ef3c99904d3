"""abs, sign and real powers of u and u': what is analytic on each side of 0 and not at 0.

abs and sign go factor by factor, so that only |u|, |u'| and their signs are left, whose one kink is at 0; a power with
an odd denominator is the real one: u^(1/3) = sign(u) |u|^(1/3).
"""

from __future__ import annotations

from typing import Final

import sympy

from ridgeback.common.errors import InputError

U: Final = sympy.Symbol("u", real=True)
V: Final = sympy.Symbol("u'", real=True)
W: Final = sympy.Symbol("u''", real=True)
KINKS: Final = (sympy.Abs(U), sympy.sign(U), sympy.Abs(V), sympy.sign(V))


def absolute(e: sympy.Expr) -> sympy.Expr:
    """|e| of a product of powers of u and u', factor by factor.

    Raises InputError for an argument that vanishes elsewhere than at u = 0 or u' = 0.

    >>> absolute(-3 * U**3)
    3*u**2*Abs(u)
    """
    return sympy.Mul(*(_power_of(sympy.Abs, factor) for factor in _factors(e, "abs")))


def sign(e: sympy.Expr) -> sympy.Expr:
    """The sign of a product of powers of u and u', factor by factor; raises InputError as ``absolute`` does.

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
    if not broken or not base.has(U, V) or not all(_simple(factor) for factor in sympy.Mul.make_args(base)):
        return sympy.Pow(base, exponent)
    turned = sign(base) if exponent.p % 2 else sympy.S.One
    return turned * sympy.Mul(*(sympy.Pow(*_raised(f, exponent)) for f in sympy.Mul.make_args(absolute(base))))


def _raised(factor: sympy.Expr, exponent: sympy.Expr) -> tuple[sympy.Expr, sympy.Expr]:
    base, power = factor.as_base_exp()
    return (base, power * exponent) if base in KINKS else (factor, exponent)


def _factors(e: sympy.Expr, name: str) -> tuple[sympy.Expr, ...]:
    factors = tuple(sympy.Mul.make_args(e))
    strange = [factor for factor in factors if not _simple(factor)]
    if strange:
        raise InputError(
            f"{name}({e}) may change sign elsewhere than at rest; {name} takes u, u' and products of their powers, as "
            "in abs(u') or abs(u)**(3/2), and other functions take these, as sin(abs(u))"
        )
    return factors


def _simple(factor: sympy.Expr) -> bool:
    base, exponent = factor.as_base_exp()
    return (base in (U, V, *KINKS) and bool(exponent.is_Rational)) or not factor.has(U, V, W)


def _power_of(function: type, factor: sympy.Expr) -> sympy.Expr:
    """|x^r| = |x|^r and sign(x^n) = sign(x)^n, each in its shortest form."""
    base, exponent = factor.as_base_exp()
    if base not in (U, V, *KINKS):
        return function(factor)
    size = base.args[0] if base in KINKS else base
    if function is sympy.Abs:
        return sympy.S.One if isinstance(base, sympy.sign) else sympy.Pow(sympy.Abs(size), exponent)
    odd = bool(exponent.is_Integer and exponent % 2) and not isinstance(base, sympy.Abs)
    return sympy.sign(size) if odd else sympy.S.One
