"""Exact values of FLINT as SymPy expressions, and LaTeX as MathML."""

from __future__ import annotations

from typing import Any

import sympy
from flint import fmpq
from latex2mathml.converter import convert


def as_sympy(value: Any, names: tuple[str, ...] = ()) -> sympy.Expr:
    """Return a FLINT rational, or a FLINT polynomial in (x, *names) free of x, as a SymPy expression.

    >>> as_sympy(fmpq(-1, 16))
    -1/16
    """
    if isinstance(value, int):
        return sympy.Integer(value)
    if isinstance(value, fmpq):
        return sympy.Rational(int(value.p), int(value.q))
    symbols = [sympy.Symbol(name, real=True) for name in names]
    terms = []
    for powers, coefficient in value.to_dict().items():
        monomial = [s ** int(n) for s, n in zip(symbols, powers[1:], strict=True) if n]
        terms.append(sympy.Mul(sympy.Rational(int(coefficient.p), int(coefficient.q)), *monomial))
    return sympy.Add(*terms)


def mathml(latex: str) -> str:
    """Return presentation MathML of a LaTeX formula (SymPy's own printer sets omega_0 as text).

    >>> mathml("x").startswith("<math")
    True
    """
    return str(convert(latex))
