"""Taylor recurrences of the elementary functions, over any ring: powers, logarithms, waves and tangents.

Their source is that of :mod:`ridgeback.common.recurrences`, whose sums, products and quotients they are made of.
"""

from __future__ import annotations

from collections.abc import Callable

from ridgeback.common.recurrences import Element, Fixed, Node, Ring, Slopes, self_convolution


class Power(Node):
    """y^(p/q) for invertible y_0 (J. C. P. Miller's recurrence)."""

    def __init__(self, ring: Ring, y: Node, numerator: int, denominator: int = 1) -> None:
        super().__init__(ring)
        self.y, self.p, self.q = y, numerator, denominator
        self.inverse = ring.invert(y.get(0))
        self.known = [ring.power(y.get(0), numerator, denominator)]
        self.growth, self.decay = ring.sums(y.rates(0), self.known), ring.sums(y.known, self.rates(0))

    def step(self, n: int) -> Element:
        self.y.rates(n)
        self.rates(n - 1)
        grown = self.ring.scale(self.growth(n, 1, n), self.p, self.q)
        return self.ring.scale(grown - self.decay(n, 1, n - 1), 1, n) * self.inverse

    def _derive(self) -> Slopes:
        return self._chain(self.y, self.ring.scale(self.known[0] * self.inverse, self.p, self.q))


class Logarithm(Node):
    """log y with y_0 invertible."""

    def __init__(self, ring: Ring, y: Node) -> None:
        super().__init__(ring)
        self.y = y
        self.inverse = ring.invert(y.get(0))
        self.known = [ring.function("log", y.get(0))]
        self.sums = ring.sums(self.rates(0), y.known)

    def step(self, n: int) -> Element:
        y = self.y.get(n)
        self.rates(n - 1)
        return (y - self.ring.scale(self.sums(n, 1, n - 1), 1, n)) * self.inverse

    def _derive(self) -> Slopes:
        return self._chain(self.y, self.inverse)


class Function(Node):
    """F(y) from its derivative: F'(y) = sign * q for a node q, which may be F itself (exp) or its partner (sin, cos).

    Parameters
    ----------
    ring
        Where the coefficients live; it must know ``name``.
    name
        The function's name, as ``ring.function`` takes it.
    y
        The argument.
    derivative
        q; the node itself when left out.
    sign
        1 or -1.
    """

    def __init__(self, ring: Ring, name: str, y: Node, derivative: Node | None = None, sign: int = 1) -> None:
        super().__init__(ring)
        self.y, self.sign = y, sign
        self.derivative = self if derivative is None else derivative
        self.known = [ring.function(name, y.get(0))]
        self.integral: Callable[[int], Element] | None = None

    def step(self, n: int) -> Element:
        self.derivative.get(n - 1)
        if self.integral is None:  # not before the partner of a pair exists
            self.integral = integral(self.y, self.derivative.known, self.sign)
        return self.integral(n)

    def _derive(self) -> Slopes:
        return self._chain(self.y, self.ring.scale(self.derivative.get(0), self.sign, 1))


def integral(y: Node, derivative: list[Element], sign: int = 1) -> Callable[[int], Element]:
    """Coefficient n of the integral of y' times q: (sign/n) sum over 1 <= j <= n of j y_j q_(n-j)."""
    sums = y.ring.sums(y.rates(0), derivative)

    def coefficient(n: int) -> Element:
        y.rates(n)
        return y.ring.scale(sums(n, 1, n), sign, n)

    return coefficient


class Tangent(Node):
    """tan y (sign 1) or tanh y (sign -1): F' = 1 + sign F^2, of which only orders below n are asked for at order n."""

    def __init__(self, ring: Ring, name: str, y: Node) -> None:
        super().__init__(ring)
        self.y, self.sign = y, 1 if name == "tan" else -1
        self.known = [ring.function(name, y.get(0))]
        self._growth: list[Element] = []
        self.integral = integral(y, self._growth)

    def forget(self, n: int) -> None:
        super().forget(n)
        del self._growth[n:]

    def growth(self, n: int) -> list[Element]:
        """The coefficients of F'(y) up to order n."""
        for m in range(len(self._growth), n + 1):
            square = self.ring.scale(self_convolution(self, m), self.sign, 1)
            self._growth.append(square if m else square + self.ring.rational(1))
        return self._growth

    def step(self, n: int) -> Element:
        self.growth(n - 1)
        return self.integral(n)

    def _derive(self) -> Slopes:
        return self._chain(self.y, self.growth(0)[0])


def wave_pair(ring: Ring, y: Node, *, hyperbolic: bool = False) -> tuple[Node, Node]:
    """Return sin y and cos y, or sinh y and cosh y: each is the derivative of the other, up to a sign.

    Parameters
    ----------
    ring
        Where the coefficients live.
    y
        The argument.
    hyperbolic
        Whether sinh and cosh are meant.
    """
    first, second = ("sinh", "cosh") if hyperbolic else ("sin", "cos")
    sine = Function(ring, first, y)
    cosine = Function(ring, second, y, sine, 1 if hyperbolic else -1)
    sine.derivative = cosine
    return sine, cosine


def powers(ring: Ring, x: Node, highest: int) -> list[Node]:
    """Return 1, x, x^2, ..., each the product of two shorter ones.

    Parameters
    ----------
    ring
        Where the coefficients live.
    x
        The base.
    highest
        The last exponent.

    Examples
    --------
    >>> from ridgeback.common.number_ring import FLOATS
    >>> from ridgeback.common.recurrences import Input
    >>> [node.get(1) for node in powers(FLOATS, Input(FLOATS, [1.0, 1.0]), 3)]
    [0.0, 1.0, 2.0, 3.0]
    """
    found: list[Node] = [Fixed(ring, ring.rational(1)), x]
    for n in range(2, highest + 1):
        found.append(ring.product(found[n // 2], found[n - n // 2]))
    return found[: highest + 1]
