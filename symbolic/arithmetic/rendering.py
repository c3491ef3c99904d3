"""Exact values of FLINT as SymPy expressions, and LaTeX as MathML."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from fractions import Fraction
from typing import Any

import sympy
from flint import fmpq

from ridgeback.common.errors import InputError


@contextmanager
def long_integers() -> Iterator[None]:
    """Let integers of any length be written: Python stops at 4300 digits, for the sake of those who read them.

    >>> with long_integers():
    ...     len(str(10**5000))
    5001
    """
    before = sys.get_int_max_str_digits()
    sys.set_int_max_str_digits(0)
    try:
        yield
    finally:
        sys.set_int_max_str_digits(before)


def as_sympy(value: Any, names: tuple[str, ...] = ()) -> sympy.Expr:
    """Return a FLINT rational or polynomial as a SymPy expression.

    Parameters
    ----------
    value : fmpq or fmpq_mpoly
        A polynomial is one in (x, *names) free of x.
    names : tuple of str, optional
        Names of the parameters.

    Returns
    -------
    sympy.Expr
        The same value, exactly.

    Examples
    --------
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

    Parameters
    ----------
    latex : str
        Without dollar signs.

    Returns
    -------
    str
        A ``math`` element.

    Examples
    --------
    >>> mathml("x").startswith("<math")
    True
    """
    from latex2mathml.converter import convert  # noqa: PLC0415 - brings an XML reader and all that it needs

    return str(convert(latex))


def series_latex(terms: tuple[sympy.Expr, ...]) -> str:
    r"""Join terms with their signs, in the order given.

    >>> series_latex((sympy.S.One, -sympy.Symbol("A") ** 2 / 16))
    '1 - \\frac{A^{2}}{16}'
    """
    names = {sympy.Symbol("eps", real=True): r"\varepsilon"}
    text = ""
    for term in terms:
        latex = sympy.latex(term, symbol_names=names)
        text += f" {latex[0]} {latex[1:].lstrip()}" if latex.startswith("-") else f" + {latex}" if text else latex
    return text.strip() or "0"


def coefficient_row(value: sympy.Expr) -> dict[str, object]:
    """A coefficient in the public JSON form: exactly, and of an irrational number the nearest float, too.

    >>> coefficient_row(sympy.Rational(1, 3)), coefficient_row(sympy.sqrt(2))["decimal"]
    ({'coefficient': '1/3'}, 1.4142135623730951)
    """
    row: dict[str, object] = {"coefficient": str(value)}
    return row | {"decimal": nearest(value)} if value.is_number and not value.is_Rational else row


def nearest(value: sympy.Expr) -> float:
    """Round an exact coefficient once to the nearest float.

    Raises InputError when a parameter is still symbolic.

    >>> nearest(sympy.Rational(1, 3))
    0.3333333333333333
    """
    if value.is_Rational:
        return float(Fraction(int(value.p), int(value.q)))
    if not value.is_number:
        free = ", ".join(sorted(str(s) for s in value.free_symbols))
        raise InputError(f"the coefficient {value} has no number for {free}; set it before evaluating")
    return float(value.evalf(30))
