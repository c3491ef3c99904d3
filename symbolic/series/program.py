r"""Truncated power series of an expression, one coefficient at a time.

An expansion is found order by order: the coefficient of order n of ``f(u, u')`` is needed from the orders below n
before order n of ``u`` exists.  So every sub-expression is a node that keeps the coefficients found so far and computes
the next one when asked (``recurrences``).

The coefficients live in any ring that can add, multiply and scale by a rational: trigonometric polynomials for a
derivation, multiple-precision floats for a Taylor integrator.  Nothing here knows which.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import sympy

from ridgeback.common.errors import InputError
from ridgeback.symbolic.series.recurrences import (
    Element,
    Exponential,
    Fixed,
    Input,
    Logarithm,
    Node,
    Power,
    Quotient,
    Ring,
    Scaled,
    Sum,
    Wave,
)


class Program:
    """An expression compiled to nodes over a ring; equal sub-expressions share one node.

    ``inputs`` (u and u') start with the given coefficients and are continued with ``supply``; ``fixed`` gives the
    coefficients of the other symbols.  ``root.get(n)`` then yields the expression's coefficient n.  A coefficient of
    u or u' may be supplied provisionally and mended with ``correct``: order n of u enters order n of all linearly.

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
        ring: Ring,
        inputs: Mapping[sympy.Symbol, list[Element]],
        u: sympy.Symbol,
        v: sympy.Symbol,
        fixed: Mapping[sympy.Symbol, list[Element]] | None = None,
    ) -> None:
        self.ring = ring
        self.nodes: dict[Any, Node] = {}
        self._fixed = dict(fixed or {})
        self._moving = (u, v)
        self.inputs: dict[sympy.Symbol, Input] = {}
        for symbol, start in inputs.items():
            node = Input(ring)
            node.known = list(start)
            self.inputs[symbol] = node
        one = ring.number(sympy.S.One)
        if u in self.inputs:
            self.inputs[u].slope_u = one
        if v in self.inputs:
            self.inputs[v].slope_v = one
        self.root = self._compile(expression)
        self.uses_velocity = bool(expression.has(v))

    def supply(self, symbol: sympy.Symbol, coefficient: Element) -> None:
        """Append the next coefficient of an input."""
        self.inputs[symbol].known.append(coefficient)

    def correct(self, n: int, change_u: Element, change_v: Element) -> None:
        """Mend coefficient n everywhere after u_n and v_n changed by the given amounts."""
        for node in {*self.nodes.values(), *self.inputs.values()}:  # a node may stand under two names
            if len(node.known) > n and (node.slope_u or node.slope_v):
                node.known[n] = node.known[n] + node.slope_u * change_u + node.slope_v * change_v

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
        if e.is_Number or e is sympy.pi:
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
            return Scaled(self.ring, self._compile(rest), factor)
        numerator, denominator = _split_quotient(e)
        if denominator is not sympy.S.One:
            return Quotient(self.ring, self._compile(numerator), self._compile(denominator))
        head, *tail = sorted(e.args, key=lambda f: f.has(*self._moving))  # small parameters first: see convolve
        return self.ring.product(self._compile(head), self._compile(sympy.Mul(*tail, evaluate=False)))

    def _build_power(self, base: sympy.Expr, exponent: sympy.Expr) -> Node:
        if base is sympy.E:
            return Exponential(self.ring, self._compile(exponent))
        if not exponent.is_Rational:
            raise InputError(f"the power {base}**({exponent}) has no rational exponent; write it with exp and log")
        if exponent.is_Integer and exponent < 0:
            one = Fixed(self.ring, self.ring.number(sympy.S.One))
            return Quotient(self.ring, one, self._compile(sympy.Pow(base, -exponent)))
        if exponent.is_Integer and exponent <= 64:
            half = int(exponent) // 2
            low, high = self._compile(base**half), self._compile(base ** (int(exponent) - half))
            return self.ring.product(low, high)
        return Power(self.ring, self._compile(base), exponent)

    def _build_function(self, e: sympy.Expr) -> Node:
        name = getattr(e.func, "__name__", str(e))
        if name == "exp":
            return Exponential(self.ring, self._compile(e.args[0]))
        if name == "log":
            return Logarithm(self.ring, self._compile(e.args[0]))
        if name in ("sin", "cos", "sinh", "cosh"):
            return self._build_wave(e.args[0], name)
        if name in ("tan", "tanh"):
            pair = ("sin", "cos") if name == "tan" else ("sinh", "cosh")
            top, bottom = (self._wave(e.args[0], which) for which in pair)
            return Quotient(self.ring, top, bottom)
        if isinstance(e, sympy.Symbol):
            raise InputError(f"the parameter {e} has no value here; give it one, e.g. --set {e}=1")
        raise InputError(f"{name} has no series rule; use sin, cos, tan, sinh, cosh, tanh, exp, log, sqrt or powers")

    def _wave(self, argument: sympy.Expr, name: str) -> Node:
        key = (name, argument)
        if key not in self.nodes:
            self._build_wave(argument, name)
        return self.nodes[key]

    def _build_wave(self, argument: sympy.Expr, name: str) -> Node:
        pair = ("sin", "cos") if name in ("sin", "cos") else ("sinh", "cosh")
        if (name, argument) not in self.nodes:
            y = self._compile(argument)
            first, second = Wave(self.ring, y, pair[0]), Wave(self.ring, y, pair[1])
            first.join(second)
            second.join(first)
            self.nodes[(pair[0], argument)], self.nodes[(pair[1], argument)] = first, second
        return self.nodes[(name, argument)]


def _split_quotient(e: sympy.Expr) -> tuple[sympy.Expr, sympy.Expr]:
    """Split a product into numerator and denominator without expanding anything."""
    below = [f for f in e.args if f.is_Pow and f.exp.is_Rational and f.exp < 0]
    above = [f for f in e.args if f not in below]
    return sympy.Mul(*above), sympy.Mul(*[sympy.Pow(f.base, -f.exp) for f in below])
