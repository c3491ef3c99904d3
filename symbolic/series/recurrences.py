r"""The recurrences of truncated power series, one node per operation, one coefficient at a time.

Knuth, The Art of Computer Programming 2, 4.7; Moore, Interval Analysis, ch. 11.  With y = sum y_n t^n:

    product   (xy)_n  = sum_j x_j y_(n-j)
    quotient  q_n     = (x_n - sum_(j>=1) y_j q_(n-j)) / y_0
    power     n y_0 p_n = sum_(j>=1) ((r+1) j - n) y_j p_(n-j)            for p = y^r
    exp       n e_n   = sum_(j>=1) j y_j e_(n-j)
    log       n y_0 l_n = n y_n - sum_(1<=j<n) j l_j y_(n-j)
    sin, cos  n s_n   = sum_(j>=1) j y_j c_(n-j),   n c_n = -+ sum_(j>=1) j y_j s_(n-j)
"""

from __future__ import annotations

from typing import Any, Protocol

import sympy

Element = Any
"""A member of the coefficient ring."""


class Ring(Protocol):
    """What a coefficient ring must provide; its members add, subtract, negate, multiply, and are false when zero."""

    def number(self, value: sympy.Expr) -> Element:
        """Return a constant (a rational, or pi in a numeric ring) as a member."""

    def scale(self, element: Element, numerator: int, denominator: int) -> Element:
        """Return element * numerator / denominator."""

    def absent(self, element: Element) -> bool:
        """Whether the element is zero at a glance; a zero that only shows on inspection may count as present."""

    def dot(self, left: list[Element], right: list[Element]) -> Element:
        """Return the sum of products of two lists of the same length."""

    def product(self, x: Node, y: Node) -> Node:
        """Return the node of x y: ``Product``, or one that multiplies faster."""

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

    def forget(self, n: int) -> None:
        """Drop the coefficients from order n on; they are computed again when asked for."""
        del self.known[n:]
        del self._rates[n:]

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

    def forget(self, n: int) -> None:
        """Nothing: these coefficients are given."""

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
    present = [j for j in indices if not ring.absent(x.get(j))]
    return ring.dot([x.known[j] for j in present], [y.get(n - j) for j in present])


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
    rates = [y.rate(j) for j in range(1, n)] + [ring.scale(y.get(n), n, 1)]
    return ring.scale(ring.dot(rates, partner.known[n - 1 :: -1] if n else []), 1, n)


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
