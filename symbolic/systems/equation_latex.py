"""The equation of motion as it is read: acceleration, damping, restoring force, in LaTeX."""

from __future__ import annotations

import sympy

from ridgeback.symbolic.grammar.parse import U, V


def equation_latex(force: sympy.Expr, symbol: str = "u") -> str:
    r"""u'' + force = 0 in LaTeX with dots for time derivatives; ``symbol`` is the LaTeX of the unknown.

    >>> equation_latex(sympy.sin(U), r"\theta")
    '\\ddot{\\theta} + \\sin{\\left(\\theta \\right)} = 0'
    """
    terms = sorted(sympy.Add.make_args(force), key=_reading_order)
    return f"\\ddot{{{symbol}}}" + "".join(_signed(term, symbol) for term in terms) + " = 0"


def _reading_order(term: sympy.Expr) -> tuple[bool, sympy.Rational, object]:
    """Velocity terms first, then the restoring force by the power of u, functions of u with the linear terms."""
    base, exponent = term.as_independent(U, as_Add=False)[1].as_base_exp()
    power = exponent if base == U and exponent.is_Rational else sympy.S.One
    return (not term.has(V), power, term.sort_key())


def _signed(term: sympy.Expr, symbol: str) -> str:
    text = _product(_factors(term), _symbol_names(term, symbol))
    return f" - {text[2:]}" if text.startswith("- ") else f" + {text}"


def _factors(term: sympy.Expr) -> list[sympy.Expr]:
    """Parameters, then functions of the unknown, then a plain u': 2 mu u', eps (1 - u^2) u', k^2 sin(u)."""
    constant, moving = term.as_independent(U, V, as_Add=False)
    damping = V in sympy.Mul.make_args(moving)
    factors = [constant, moving / V if damping else moving, V if damping else sympy.S.One]
    kept = [factor for factor in factors if factor != 1]
    return [term] if constant.is_number and len(kept) <= 2 else kept


def _product(factors: list[sympy.Expr], names: dict[sympy.Symbol, str]) -> str:
    text = " ".join(_bracketed(factor, names) for factor in factors)
    return "- " + text.removeprefix("-1 ") if text.startswith("-1 ") else text


def _bracketed(factor: sympy.Expr, names: dict[sympy.Symbol, str]) -> str:
    text = str(sympy.latex(factor, symbol_names=names))
    return f"\\left({text}\\right)" if factor.is_Add else text


def _symbol_names(term: sympy.Expr, symbol: str) -> dict[sympy.Symbol, str]:
    named = {U: symbol, V: f"\\dot{{{symbol}}}"}
    return named | {s: r"\varepsilon" for s in term.free_symbols if s.name in ("eps", "epsilon")}
