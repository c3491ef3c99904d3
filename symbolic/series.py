r"""Truncated power series of an expression, one coefficient at a time.

An expansion is found order by order: the coefficient of order n of ``f(u, u')`` is needed from the orders below n
before order n of ``u`` exists.  So every sub-expression is a node that keeps the coefficients found so far and
computes the next one when asked, by the classical recurrences (Knuth, TAOCP 2, 4.7; Moore, Interval Analysis,
ch. 11).  With y = sum y_n t^n:

    product   (xy)_n  = sum_j x_j y_(n-j)
    quotient  q_n     = (x_n - sum_(j>=1) y_j q_(n-j)) / y_0
    power     n y_0 p_n = sum_(j>=1) ((r+1) j - n) y_j p_(n-j)            for p = y^r
    exp       n e_n   = sum_(j>=1) j y_j e_(n-j)
    log       n y_0 l_n = n y_n - sum_(1<=j<n) j l_j y_(n-j)
    sin, cos  n s_n   = sum_(j>=1) j y_j c_(n-j),   n c_n = -+ sum_(j>=1) j y_j s_(n-j)

The coefficients live in any ring that can add, multiply and scale by a rational: trigonometric polynomials for a
derivation, multiple-precision floats for a Taylor integrator.  Nothing here knows which.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

import sympy

from symbolic.errors import InputError

Element = Any
"""A member of the coefficient ring."""


class Ring(Protocol):
    """What a coefficient ring must provide; its members add, subtract, negate, multiply, and are false when zero."""

    def number(self, value: sympy.Expr) -> Element:
        """Return a constant (a rational, or pi in a numeric ring) as a member."""

    def scale(self, element: Element, numerator: int, denominator: int) -> Element:
        """Return element * numerator / denominator."""

    def invert(self, element: Element) -> Element:
        """Return 1 / element for a leading coefficient; InputError when the ring cannot."""

    def function(self, name: str, element: Element) -> Element:
        """Return an elementary function of a leading coefficient; InputError when the ring cannot."""

    def power(self, element: Element, exponent: sympy.Rational) -> Element:
        """Return a rational power of a leading coefficient; InputError when the ring cannot."""


class Node:
    """A sub-expression: its coefficients so far, and its slopes in u and u' at order zero."""

    def __init__(self, ring: Ring) -> None:
        self.ring = ring
        self.known: list[Element] = []
        self._rates: list[Element] = []
        self.slope_u: Element = ring.number(sympy.S.Zero)
        self.slope_v: Element = ring.number(sympy.S.Zero)

    def get(self, n: int) -> Element:
        """Return coefficient n, computing what is missing."""
        while len(self.known) <= n:
            self.known.append(self.step(len(self.known)))
        return self.known[n]

    def rate(self, j: int) -> Element:
        """Return j times coefficient j, remembered; only for coefficients that will not be corrected any more."""
        while len(self._rates) <= j:
            self._rates.append(self.ring.scale(self.get(len(self._rates)), len(self._rates), 1))
        return self._rates[j]

    def step(self, n: int) -> Element:
        """Compute coefficient n from the children's coefficients up to n and the own ones below n."""
        raise AssertionError(f"{type(self).__name__} was asked for order {n} before it was supplied")

    def _slopes_from(self, child: Node, factor: Element) -> None:
        self.slope_u = factor * child.slope_u
        self.slope_v = factor * child.slope_v


class Input(Node):
    """A leaf whose coefficients are supplied from outside (u, u', a small parameter)."""


class Fixed(Node):
    """A number, a parameter, or a small parameter: given coefficients, then zeros."""

    def __init__(self, ring: Ring, *coefficients: Element) -> None:
        super().__init__(ring)
        self.known = list(coefficients)
        self._zero = ring.number(sympy.S.Zero)

    def step(self, n: int) -> Element:  # noqa: ARG002 - same signature as every node
        return self._zero


class Sum(Node):
    """x_1 + x_2 + ..."""

    def __init__(self, ring: Ring, terms: list[Node]) -> None:
        super().__init__(ring)
        self.terms = terms
        for term in terms:
            self.slope_u = self.slope_u + term.slope_u
            self.slope_v = self.slope_v + term.slope_v

    def step(self, n: int) -> Element:
        total = self.terms[0].get(n)
        for term in self.terms[1:]:
            total = total + term.get(n)
        return total


class Scaled(Node):
    """A rational multiple."""

    def __init__(self, ring: Ring, child: Node, factor: sympy.Rational) -> None:
        super().__init__(ring)
        self.child, self.p, self.q = child, int(factor.p), int(factor.q)
        self.slope_u = ring.scale(child.slope_u, self.p, self.q)
        self.slope_v = ring.scale(child.slope_v, self.p, self.q)

    def step(self, n: int) -> Element:
        return self.ring.scale(self.child.get(n), self.p, self.q)


class Product(Node):
    """x y; a factor without a constant term lets the other lag behind by its order."""

    def __init__(self, ring: Ring, x: Node, y: Node) -> None:
        super().__init__(ring)
        self.x, self.y = x, y
        self.slope_u = x.get(0) * y.slope_u + x.slope_u * y.get(0)
        self.slope_v = x.get(0) * y.slope_v + x.slope_v * y.get(0)

    def step(self, n: int) -> Element:
        return self._square(n) if self.x is self.y else convolve(self.ring, self.x, self.y, n, range(n + 1))

    def _square(self, n: int) -> Element:
        half = convolve(self.ring, self.x, self.x, n, range((n + 1) // 2))
        total = self.ring.scale(half, 2, 1)
        return total + self.x.get(n // 2) * self.x.get(n // 2) if n % 2 == 0 else total


def convolve(ring: Ring, x: Node, y: Node, n: int, indices: range) -> Element:
    """Sum of x_j y_(n-j) over the indices j; the partner of a zero is never asked for.

    That last point matters: with x = eps it lets y stop one order behind, where eps y is already complete.
    """
    total = ring.number(sympy.S.Zero)
    for j in indices:
        left = x.get(j)
        if left:
            right = y.get(n - j)
            if right:
                total = total + left * right
    return total


class Quotient(Node):
    """x / y with y_0 invertible."""

    def __init__(self, ring: Ring, x: Node, y: Node) -> None:
        super().__init__(ring)
        self.x, self.y = x, y
        self.inverse = ring.invert(y.get(0))
        ratio = x.get(0) * self.inverse
        self.slope_u = (x.slope_u - ratio * y.slope_u) * self.inverse
        self.slope_v = (x.slope_v - ratio * y.slope_v) * self.inverse

    def step(self, n: int) -> Element:
        total = self.x.get(n)
        for j in range(1, n + 1):
            if self.y.get(j) and self.known[n - j]:
                total = total - self.y.get(j) * self.known[n - j]
        return total * self.inverse


class Power(Node):
    """y^r for rational r and invertible y_0 (J. C. P. Miller's recurrence)."""

    def __init__(self, ring: Ring, y: Node, exponent: sympy.Rational) -> None:
        super().__init__(ring)
        self.y, self.p, self.q = y, int(exponent.p), int(exponent.q)
        start = y.get(0)
        self.inverse = ring.invert(start)
        self.known = [ring.power(start, exponent)]
        self._slopes_from(y, ring.scale(self.known[0] * self.inverse, self.p, self.q))

    def step(self, n: int) -> Element:
        total = self.ring.number(sympy.S.Zero)
        for j in range(1, n + 1):
            if self.y.get(j) and self.known[n - j]:
                weight = (self.p + self.q) * j - self.q * n
                total = total + self.ring.scale(self.y.get(j) * self.known[n - j], weight, self.q * n)
        return total * self.inverse


def weighted(ring: Ring, y: Node, partner: Node, n: int) -> Element:
    """(1/n) sum over 1 <= j <= n of j y_j partner_(n-j): the integral of y' times the partner."""
    total = ring.scale(y.get(n) * partner.known[0], n, 1) if partner.known[0] else ring.number(sympy.S.Zero)
    for j in range(1, n):
        rate = y.rate(j)
        if rate and partner.known[n - j]:
            total = total + rate * partner.known[n - j]
    return ring.scale(total, 1, n)


class Exponential(Node):
    """exp y."""

    def __init__(self, ring: Ring, y: Node) -> None:
        super().__init__(ring)
        self.y = y
        self.known = [ring.function("exp", y.get(0))]
        self._slopes_from(y, self.known[0])

    def step(self, n: int) -> Element:
        return weighted(self.ring, self.y, self, n)


class Logarithm(Node):
    """log y with y_0 invertible."""

    def __init__(self, ring: Ring, y: Node) -> None:
        super().__init__(ring)
        self.y = y
        self.inverse = ring.invert(y.get(0))
        self.known = [ring.function("log", y.get(0))]
        self._slopes_from(y, self.inverse)

    def step(self, n: int) -> Element:
        total = self.y.get(n)
        for j in range(1, n):
            if self.known[j] and self.y.get(n - j):
                total = total - self.ring.scale(self.known[j] * self.y.get(n - j), j, n)
        return total * self.inverse


class Wave(Node):
    """One of the pair (sin, cos) or (sinh, cosh) of y; ``partner`` is the other one."""

    def __init__(self, ring: Ring, y: Node, name: str) -> None:
        super().__init__(ring)
        self.y = y
        self.sign = -1 if name == "cos" else 1
        self.known = [ring.function(name, y.get(0))]
        self.partner: Wave = self

    def join(self, partner: Wave) -> None:
        """Tie the two together once both exist."""
        self.partner = partner
        self._slopes_from(self.y, self.ring.scale(partner.known[0], self.sign, 1))

    def step(self, n: int) -> Element:
        self.partner.get(n - 1)
        return self.ring.scale(weighted(self.ring, self.y, self.partner, n), self.sign, 1)


class Program:
    """An expression compiled to nodes over a ring; equal sub-expressions share one node.

    ``inputs`` (u and u') start with the given coefficients and are continued with ``supply``; ``fixed`` gives the
    coefficients of the other symbols.  ``root.get(n)`` then yields the expression's coefficient n.  A coefficient of
    u or u' may be supplied provisionally and mended with ``correct``: order n of u enters order n of all linearly.

    >>> from symbolic.spaces import space_for
    >>> from symbolic.rings import TrigRing
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
            if not isinstance(node, Fixed):
                del node.known[n:]
                del node._rates[n:]

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
        return Product(self.ring, self._compile(head), self._compile(sympy.Mul(*tail, evaluate=False)))

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
            return Product(self.ring, low, high)
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
