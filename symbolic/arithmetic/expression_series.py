r"""Truncated power series of an expression, one coefficient at a time.

An expansion is found order by order: the coefficient of order n of ``f(u, u')`` is needed from the orders below n
before order n of ``u`` exists.  So every sub-expression is a node that keeps the coefficients found so far and computes
the next one when asked (``recurrences``).

The coefficients live in any ring that can add, multiply and scale by a rational: trigonometric polynomials for a
derivation, multiple-precision floats for a Taylor integrator.  Nothing here knows which.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any, Final, Protocol

import sympy

from ridgeback.common.elementary import Function, Logarithm, Power, Tangent, wave_pair
from ridgeback.common.errors import InputError
from ridgeback.common.recurrences import Element, Fixed, Input, Node, Quotient, Ring, Scaled, Sum

# The derivatives of the functions that are integrals of algebraic ones (DLMF 4.24.7 to 4.24.9, 4.40.7 to 4.40.11).
_DERIVATIVES: Final[dict[str, Callable[[sympy.Expr], sympy.Expr]]] = {
    "asin": lambda x: (1 - x**2) ** sympy.Rational(-1, 2),
    "acos": lambda x: -((1 - x**2) ** sympy.Rational(-1, 2)),
    "atan": lambda x: 1 / (1 + x**2),
    "asinh": lambda x: (1 + x**2) ** sympy.Rational(-1, 2),
    "acosh": lambda x: (x**2 - 1) ** sympy.Rational(-1, 2),
    "atanh": lambda x: 1 / (1 - x**2),
}
_PAIRS: Final = {"sin": ("sin", "cos"), "cos": ("sin", "cos"), "sinh": ("sinh", "cosh"), "cosh": ("sinh", "cosh")}
KNOWN: Final = (*_PAIRS, "tan", "tanh", "exp", "log", *_DERIVATIVES)
"""The functions that have a recurrence."""


class ExpressionRing(Ring, Protocol):
    """A ring into which the numbers of a SymPy expression can be brought."""

    def number(self, value: sympy.Expr) -> Element:
        """Return a number (a rational; in a numeric ring any real number) as a member."""


class Program:
    """An expression compiled to nodes over a ring; equal sub-expressions share one node.

    ``root.get(n)`` yields the expression's coefficient n.  A coefficient of u or u' may be supplied provisionally and
    corrected with ``correct``: order n of u enters order n of all linearly.

    Parameters
    ----------
    expression : sympy.Expr
        In the inputs and the fixed symbols.
    ring : ExpressionRing
        Where the coefficients live.
    inputs : mapping of sympy.Symbol to coefficients or Input
        u and u' with their first coefficients; continued with ``supply``.
    u, v : sympy.Symbol
        Which of them are u and u'.
    fixed : mapping of sympy.Symbol to coefficients, optional
        The other symbols: given coefficients, then zeros.

    Raises
    ------
    InputError
        For a symbol without coefficients, a function without a recurrence, and a leading coefficient that the ring
        cannot invert or take a function of.

    Examples
    --------
    >>> from ridgeback.symbolic.series.spaces import space_for
    >>> from ridgeback.symbolic.series.ring import TrigRing
    >>> u, v = sympy.symbols("u v")
    >>> ring = TrigRing(space_for(()))
    >>> program = Program(sympy.sin(u), ring, {u: [ring.number(sympy.S.Zero)], v: [ring.number(sympy.S.Zero)]}, u, v)
    >>> program.supply(u, ring.number(sympy.S.One))
    >>> [program.supply(u, ring.number(sympy.S.Zero)) for _ in range(2)] and program.root.get(3).coefficients(0)
    [-1/6]
    """

    def __init__(
        self,
        expression: sympy.Expr,
        ring: ExpressionRing,
        inputs: Mapping[sympy.Symbol, Sequence[Element] | Input],
        u: sympy.Symbol,
        v: sympy.Symbol,
        fixed: Mapping[sympy.Symbol, list[Element]] | None = None,
    ) -> None:
        self.ring = ring
        self.nodes: dict[Any, Node] = {}
        self._fixed = dict(fixed or {})
        self._moving = (u, v)
        zero, one = ring.rational(0), ring.rational(1)
        slopes = {u: (one, zero), v: (zero, one)}
        self.inputs = {
            symbol: start if isinstance(start, Input) else Input(ring, start, slopes.get(symbol))
            for symbol, start in inputs.items()
        }
        self.root = self._compile(expression)
        self.uses_velocity = bool(expression.has(v))

    def supply(self, symbol: sympy.Symbol, coefficient: Element) -> None:
        """Append the next coefficient of an input."""
        self.inputs[symbol].known.append(coefficient)

    def correct(self, n: int, change_u: Element, change_v: Element) -> None:
        """Correct coefficient n everywhere after u_n and v_n changed by the given amounts."""
        for node in {*self.nodes.values(), *self.inputs.values()}:  # a node may stand under two names
            along_u, along_v = node.slopes() if len(node.known) > n else (None, None)
            if along_u or along_v:
                node.correct(n, along_u * change_u + along_v * change_v)

    def forget(self, n: int) -> None:
        """Drop what has been computed from order n on; it is computed again when asked for."""
        for node in set(self.nodes.values()):
            node.forget(n)

    def _compile(self, e: sympy.Expr) -> Node:
        if e in self.inputs:
            return self.inputs[e]
        if e not in self.nodes:
            self.nodes[e] = self._build(e)
        return self.nodes[e]

    def _build(self, e: sympy.Expr) -> Node:
        if e in self._fixed:
            return Fixed(self.ring, *self._fixed[e])
        if e.is_Number or e.is_NumberSymbol:
            return Fixed(self.ring, self.ring.number(e))
        if e.is_Add:
            return Sum(self.ring, [self._compile(term) for term in e.args])
        if e.is_Mul:
            return self._build_product(e)
        if e.is_Pow:
            return self._build_power(e.base, e.exp)
        return self._build_function(e)

    def _build_product(self, e: sympy.Expr) -> Node:
        factor, rest = e.as_coeff_Mul(rational=True)
        if factor != 1:
            return Scaled(self.ring, self._compile(rest), int(factor.p), int(factor.q))
        numerator, denominator = _split_quotient(e)
        if denominator is not sympy.S.One:
            return Quotient(self.ring, self._compile(numerator), self._compile(denominator))
        head, *tail = sorted(e.args, key=lambda f: f.has(*self._moving))  # small parameters first: see convolution
        return self.ring.product(self._compile(head), self._compile(sympy.Mul(*tail, evaluate=False)))

    def _build_power(self, base: sympy.Expr, exponent: sympy.Expr) -> Node:
        if not exponent.is_Rational:
            return self._compile(sympy.exp(exponent * sympy.log(base), evaluate=False))
        if exponent.is_Integer and exponent < 0:
            one = Fixed(self.ring, self.ring.rational(1))
            return Quotient(self.ring, one, self._compile(sympy.Pow(base, -exponent)))
        if exponent.is_Integer and exponent <= 64:
            half = int(exponent) // 2
            low, high = self._compile(base**half), self._compile(base ** (int(exponent) - half))
            return self.ring.product(low, high)
        return Power(self.ring, self._compile(base), int(exponent.p), int(exponent.q))

    def _build_function(self, e: sympy.Expr) -> Node:
        name = getattr(e.func, "__name__", str(e))
        if not e.args:  # the imaginary unit, or an infinity of the complex plane
            raise InputError(
                f"{e} is no real number; keep what roots, logarithms and inverse functions are taken of in range"
            )
        check_expandable(e, {*self.inputs, *self._fixed})
        argument = self._compile(e.args[0])
        if name in _PAIRS:
            return self._build_wave(e.args[0], argument, name)
        if name == "log":
            return Logarithm(self.ring, argument)
        if name in ("tan", "tanh"):
            return Tangent(self.ring, name, argument)
        derivative = self._compile(_DERIVATIVES[name](e.args[0])) if name in _DERIVATIVES else None
        return Function(self.ring, name, argument, derivative)

    def _build_wave(self, argument: sympy.Expr, y: Node, name: str) -> Node:
        pair = _PAIRS[name]
        if (name, argument) not in self.nodes:
            both = wave_pair(self.ring, y, hyperbolic=name not in ("sin", "cos"))
            self.nodes.update({(which, argument): node for which, node in zip(pair, both, strict=True)})
        return self.nodes[(name, argument)]


def check_expandable(expression: sympy.Expr, symbols: Collection[sympy.Symbol]) -> None:
    """Refuse an expression that no power series can be taken of, whatever its arguments.

    Parameters
    ----------
    expression
        To be compiled by ``Program``.
    symbols
        Those that will have coefficients.

    Raises
    ------
    InputError
        For a further symbol and for a function without a recurrence.

    Examples
    --------
    >>> check_expandable(abs(sympy.Symbol("u")), [sympy.Symbol("u")])
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: Abs has no series rule; use sin, cos, ..., sqrt or powers
    """
    for symbol in sorted(expression.free_symbols - set(symbols), key=str):
        raise InputError(f"the parameter {symbol} has no value here; give it one, e.g. --set {symbol}=1")
    for function in sorted(expression.atoms(sympy.Function), key=str):
        name = type(function).__name__
        if name not in KNOWN or len(function.args) != 1:
            raise InputError(f"{name} has no series rule; use {', '.join(KNOWN)}, sqrt or powers")


def _split_quotient(e: sympy.Expr) -> tuple[sympy.Expr, sympy.Expr]:
    """Split a product into numerator and denominator without expanding anything."""
    below = [f for f in e.args if f.is_Pow and f.exp.is_Rational and f.exp < 0]
    above = [f for f in e.args if f not in below]
    return sympy.Mul(*above), sympy.Mul(*[sympy.Pow(f.base, -f.exp) for f in below])
