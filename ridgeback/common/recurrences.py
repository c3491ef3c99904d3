r"""The recurrences of truncated power series over a ring: one node per operation, one coefficient at a time.

Knuth, The Art of Computer Programming 2, 4.7; Moore, Interval Analysis (1966), chapter 11; Griewank and Walther,
Evaluating Derivatives (2008), chapter 13.  With y = sum y_n t^n:

    product   (xy)_n  = sum_j x_j y_(n-j)
    quotient  q_n     = (x_n - sum_(j>=1) y_j q_(n-j)) / y_0
    power     n y_0 p_n = sum_(j>=1) ((r+1) j - n) y_j p_(n-j)            for p = y^r
    log       n y_0 l_n = n y_n - sum_(1<=j<n) j l_j y_(n-j)
    F(y)      n F_n   = sum_(j>=1) j y_j q_(n-j)                          where F'(y) = q, a series found alongside

The last serves exp (q = exp y), the pairs sin, cos and sinh, cosh (each the q of the other), tan and tanh
(q = 1 +- F^2), and the inverse functions, whose q is algebraic.

The coefficients live in any ring that can add, multiply and scale by a rational: trigonometric polynomials for a
derivation, balls, floats and multiple precision for the Taylor series of a motion.  Nothing here knows which.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Protocol, TypeAlias

Element = Any
"""A member of the coefficient ring."""

Sums: TypeAlias = Callable[[int, int, int], Element]
"""Called with n, first, last: the sum of x_j y_(n-j) over first <= j <= last, for two series that grow."""

Slopes = tuple[Element, Element]
"""Partial derivatives with respect to the first and the second moving input, at order zero."""


class Ring(Protocol):
    """What a coefficient ring must provide; its members add, subtract, negate, multiply, and are false when zero."""

    def rational(self, numerator: int, denominator: int = 1) -> Element:
        """Return a rational number as a member."""

    def scale(self, element: Element, numerator: int, denominator: int) -> Element:
        """Return element * numerator / denominator."""

    def absent(self, element: Element) -> bool:
        """Whether the element is zero at a glance; a zero that only shows on inspection may count as present."""

    def dot(self, left: Sequence[Element], right: Sequence[Element]) -> Element:
        """Return the sum of products of two sequences of the same length."""

    def product(self, x: Node, y: Node) -> Node:
        """Return the node of x y: ``Product``, or one that multiplies faster."""

    def sums(self, x: list[Element], y: list[Element]) -> Sums:
        """Return the sums of products of two lists that will grow: ``PlainSums``, or one that multiplies faster.

        It may rely on what it has been asked for: orders never fall, and those below n are final when n is asked for.
        """

    def invert(self, element: Element) -> Element:
        """Return 1 / element for a leading coefficient; InputError when the ring cannot."""

    def function(self, name: str, element: Element) -> Element:
        """Return an elementary function of a leading coefficient; InputError when the ring cannot."""

    def power(self, element: Element, numerator: int, denominator: int) -> Element:
        """Return a rational power of a leading coefficient; InputError when the ring cannot."""


def plain_sums(ring: Ring, x: list[Element], y: list[Element]) -> Sums:
    """Return the sums of products of two growing lists, taken term by term.

    Parameters
    ----------
    ring
        Where the coefficients live.
    x, y
        The coefficients so far.

    Examples
    --------
    >>> from ridgeback.common.number_ring import FLOATS
    >>> plain_sums(FLOATS, [1.0, 2.0], [3.0, 4.0])(1, 0, 1)
    10.0
    """
    return lambda n, first, last: ring.dot(x[first : last + 1], y[n - last : n - first + 1][::-1])


class Node:
    """A sub-expression: its coefficients so far, and its slopes in the two moving inputs at order zero.

    A node grows: the one kind of object here that does.

    Parameters
    ----------
    ring
        Where the coefficients live.
    """

    def __init__(self, ring: Ring) -> None:
        self.ring = ring
        self.known: list[Element] = []
        self._rates: list[Element] = []
        self._slopes: Slopes | None = None

    def get(self, n: int) -> Element:
        """Return coefficient n, computing what is missing."""
        while len(self.known) <= n:
            self.known.append(self.step(len(self.known)))
        return self.known[n]

    def rates(self, n: int) -> list[Element]:
        """Return j times coefficient j for 0 <= j <= n (at least), kept in one list."""
        for j in range(len(self._rates), n + 1):
            self._rates.append(self.ring.scale(self.get(j), j, 1))
        return self._rates

    def correct(self, n: int, change: Element) -> None:
        """Add to the last coefficient, n."""
        self.known[n] = self.known[n] + change
        del self._rates[n:]

    def forget(self, n: int) -> None:
        """Drop the coefficients from order n on; they are computed again when asked for."""
        del self.known[n:]
        del self._rates[n:]

    def step(self, n: int) -> Element:
        """Compute coefficient n from the children's coefficients up to n and the own ones below n."""
        raise AssertionError(f"{type(self).__name__} was asked for order {n} before it was supplied")

    def slopes(self) -> Slopes:
        """Return the derivatives with respect to the two moving inputs, at order zero."""
        if self._slopes is None:
            self._slopes = self._derive()
        return self._slopes

    def _derive(self) -> Slopes:
        zero = self.ring.rational(0)
        return zero, zero

    def _chain(self, child: Node, factor: Element) -> Slopes:
        """The chain rule: a child's slopes times the outer derivative."""
        along_u, along_v = child.slopes()
        return factor * along_u, factor * along_v


class Input(Node):
    """A leaf whose coefficients are supplied from outside (u, u'); ``slopes`` says which moving input it is."""

    def __init__(self, ring: Ring, start: Sequence[Element], slopes: Slopes | None = None) -> None:
        super().__init__(ring)
        self.known = list(start)
        self._slopes = slopes


class Fixed(Node):
    """A number, a parameter, or a small parameter: given coefficients, then zeros."""

    def __init__(self, ring: Ring, *coefficients: Element) -> None:
        super().__init__(ring)
        self.known = list(coefficients)
        self.length = len(coefficients)
        self._zero = ring.rational(0)

    def forget(self, n: int) -> None:
        """Nothing: these coefficients are given."""

    def step(self, n: int) -> Element:  # noqa: ARG002 - same signature as every node
        return self._zero


class Sum(Node):
    """x_1 + x_2 + ..."""

    def __init__(self, ring: Ring, terms: Sequence[Node]) -> None:
        super().__init__(ring)
        self.terms = terms

    def step(self, n: int) -> Element:
        total = self.terms[0].get(n)
        for term in self.terms[1:]:
            total = total + term.get(n)
        return total

    def _derive(self) -> Slopes:
        along_u, along_v = super()._derive()
        for term in self.terms:
            also_u, also_v = term.slopes()
            along_u, along_v = along_u + also_u, along_v + also_v
        return along_u, along_v


class Combination(Node):
    """w_1 x_1 + w_2 x_2 + ... with members w of the ring."""

    def __init__(self, ring: Ring, weights: Sequence[Element], terms: Sequence[Node]) -> None:
        super().__init__(ring)
        self.weights, self.terms = weights, terms

    def step(self, n: int) -> Element:
        return self.ring.dot(self.weights, [term.get(n) for term in self.terms])

    def _derive(self) -> Slopes:
        slopes = [term.slopes() for term in self.terms]
        along_u, along_v = ([pair[which] for pair in slopes] for which in (0, 1))
        return self.ring.dot(self.weights, along_u), self.ring.dot(self.weights, along_v)


class Scaled(Node):
    """A rational multiple."""

    def __init__(self, ring: Ring, child: Node, numerator: int, denominator: int = 1) -> None:
        super().__init__(ring)
        self.child, self.p, self.q = child, numerator, denominator

    def step(self, n: int) -> Element:
        return self.ring.scale(self.child.get(n), self.p, self.q)

    def _derive(self) -> Slopes:
        along_u, along_v = self.child.slopes()
        return self.ring.scale(along_u, self.p, self.q), self.ring.scale(along_v, self.p, self.q)


class Product(Node):
    """x y; a factor without a constant term lets the other lag behind by its order."""

    def __init__(self, ring: Ring, x: Node, y: Node) -> None:
        super().__init__(ring)
        self.x, self.y = x, y

    def step(self, n: int) -> Element:
        return self_convolution(self.x, n) if self.x is self.y else convolution(self.x, self.y, n, n)

    def _derive(self) -> Slopes:
        x, y = self.x.get(0), self.y.get(0)
        (x_u, x_v), (y_u, y_v) = self.x.slopes(), self.y.slopes()
        return x * y_u + x_u * y, x * y_v + x_v * y


def convolution(x: Node, y: Node, n: int, last: int) -> Element:
    """Sum of x_j y_(n-j) over 0 <= j <= last; the partner of a leading zero is never asked for.

    That last point matters: with x = eps it lets y stop one order behind, where eps y is already complete.
    """
    last = min(last, x.length - 1) if isinstance(x, Fixed) else last
    first = 0
    while first <= last and x.ring.absent(x.get(first)):
        first += 1
    if first > last:
        return x.ring.dot([], [])
    x.get(last)
    y.get(n - first)
    return x.ring.dot(x.known[first : last + 1], y.known[n - last : n - first + 1][::-1])


def self_convolution(x: Node, n: int) -> Element:
    """Coefficient n of x^2, each pair of coefficients multiplied once."""
    twice = x.ring.scale(convolution(x, x, n, (n - 1) // 2), 2, 1)
    return twice + x.get(n // 2) * x.get(n // 2) if n % 2 == 0 else twice


class Quotient(Node):
    """x / y with y_0 invertible."""

    def __init__(self, ring: Ring, x: Node, y: Node) -> None:
        super().__init__(ring)
        self.x, self.y = x, y
        self.inverse = ring.invert(y.get(0))
        self.sums = ring.sums(y.known, self.known)

    def step(self, n: int) -> Element:
        x = self.x.get(n)
        self.y.get(n)
        return (x - self.sums(n, 1, n) if n else x) * self.inverse

    def _derive(self) -> Slopes:
        ratio = self.get(0)
        (x_u, x_v), (y_u, y_v) = self.x.slopes(), self.y.slopes()
        return (x_u - ratio * y_u) * self.inverse, (x_v - ratio * y_v) * self.inverse


def solution(force: Node, u: Input, v: Input, degree: int) -> list[Element]:
    """Return the Taylor coefficients of the solution of u'' + f(u, u') = 0 through a given state.

    Parameters
    ----------
    force
        f as a node over ``u`` and ``v``.
    u, v
        Inputs that hold u and u' at the start and nothing more; they are continued.
    degree
        Of the last coefficient.

    Returns
    -------
    list
        degree + 1 coefficients of u: [u, u', u''/2!, ...].

    References
    ----------
    Jorba and Zou, A software package for the numerical integration of ODEs by means of high-order Taylor methods,
    Experimental Mathematics 14 (2005) 99-117, section 2.

    Examples
    --------
    The cosine, in rationals::

        >>> from fractions import Fraction
        >>> from ridgeback.common.number_ring import NumberRing
        >>> ring = NumberRing(Fraction, {})
        >>> u, v = Input(ring, [Fraction(1)]), Input(ring, [Fraction(0)])
        >>> [str(c) for c in solution(u, u, v, 4)]
        ['1', '0', '-1/2', '0', '1/24']
    """
    ring = force.ring
    for n in range(degree):
        u.known.append(ring.scale(v.known[n], 1, n + 1))
        if n < degree - 1:
            v.known.append(ring.scale(force.get(n), -1, n + 1))
    return u.known[: degree + 1]
