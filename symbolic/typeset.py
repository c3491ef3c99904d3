"""The equation of motion as it is read: acceleration, damping, restoring force, in LaTeX."""

from __future__ import annotations

import sympy

from symbolic.parse import U, V


def equation_latex(force: sympy.Expr, symbol: str = "u") -> str:
    r"""u'' + force = 0 in LaTeX with dots for time derivatives; ``symbol`` is the LaTeX of the unknown.

    >>> equation_latex(sympy.sin(U), r"\theta")
    '\\ddot{\\theta} + \\sin{\\left(\\theta \\right)} = 0'
    """
    terms = sorted(sympy.Add.make_args(force), key=_reading_order)
    return f"\\ddot{{{symbol}}}" + "".join(_signed(term, symbol) for term in terms) + " = 0"


def _reading_order(term: sympy.Expr) -> tuple[bool, int, object]:
    """Velocity terms first, then the restoring force by rising degree."""
    degree = sympy.degree(term, U) if term.is_polynomial(U) else 0
    return (not term.has(V), int(degree) if degree != -sympy.oo else 0, term.sort_key())


def _signed(term: sympy.Expr, symbol: str) -> str:
    text = sympy.latex(term, symbol_names=_symbol_names(term, symbol))
    return f" - {text[2:]}" if text.startswith("- ") else f" + {text}"


def _symbol_names(term: sympy.Expr, symbol: str) -> dict[sympy.Symbol, str]:
    named = {U: symbol, V: f"\\dot{{{symbol}}}"}
    return named | {s: r"\varepsilon" for s in term.free_symbols if s.name in ("eps", "epsilon")}
