"""The exact coefficient ring of the derivations: trigonometric polynomials, as ``series`` wants to see them."""

from __future__ import annotations

from collections.abc import Sequence

import sympy
from flint import arb, fmpq

from ridgeback.common.errors import InputError
from ridgeback.common.recurrences import Node, Product, Sums, plain_sums
from ridgeback.symbolic.series.harmonic_basis import Balls
from ridgeback.symbolic.series.online_sums import OnlineProduct, last_order, sums_of_products
from ridgeback.symbolic.series.relaxed_product import RelaxedProduct
from ridgeback.symbolic.series.spaces import Space
from ridgeback.symbolic.series.trigonometric import NOTHING, Trig, constant, dot

# Values at the only arguments where an elementary function of a rational is rational.
_AT_ZERO = {
    **{"sin": 0, "cos": 1, "tan": 0, "sinh": 0, "cosh": 1, "tanh": 0, "exp": 1},
    **{"asin": 0, "atan": 0, "asinh": 0, "atanh": 0},
}


class TrigRing:
    """Trigonometric polynomials with rational coefficients, or polynomials in named parameters.

    >>> from ridgeback.symbolic.series.spaces import space_for
    >>> TrigRing(space_for(())).number(sympy.Rational(1, 3)).coefficients(0)
    [1/3]
    """

    def __init__(self, space: Space) -> None:
        self.space = space

    def number(self, value: sympy.Expr) -> Trig:
        """Return a rational number; InputError for an irrational one, since the derivation is exact."""
        if not value.is_Rational:
            raise InputError(f"{value} is not rational, and the derivation is exact; use a fraction or a decimal")
        return self.rational(int(value.p), int(value.q))

    def rational(self, numerator: int, denominator: int = 1) -> Trig:
        """Return a rational number as a constant of the ring."""
        return constant(self.space, fmpq(numerator, denominator))

    def parameter(self, name: str) -> Trig:
        """Return a named parameter as a constant of the ring."""
        return constant(self.space, self.space.gen(name))

    def scale(self, element: Trig, numerator: int, denominator: int) -> Trig:
        """Multiply by a rational number."""
        return element.scale(fmpq(numerator, denominator))

    def absent(self, element: Trig) -> bool:
        """Whether every part is missing."""
        return element.parts == NOTHING

    def dot(self, left: Sequence[Trig], right: Sequence[Trig]) -> Trig:
        """Return the sum of products, those with a missing factor left out."""
        present = [(x, y) for x, y in zip(left, right, strict=True) if NOTHING not in (x.parts, y.parts)]
        return dot(self.space, [x for x, _ in present], [y for _, y in present])

    def product(self, x: Node, y: Node) -> Node:
        """Return the node of a product: in blocks for balls and rationals, where products are long."""
        if isinstance(self.space, Balls):
            return RelaxedProduct(self, x, y, self.space)
        return OnlineProduct(self, x, y) if last_order(self.space) is not None else Product(self, x, y)

    def sums(self, x: list[Trig], y: list[Trig]) -> Sums:
        """Return the sums of products of two growing series."""
        last = last_order(self.space)
        return plain_sums(self, x, y) if last is None else sums_of_products(self.space, x, y, last)

    def invert(self, element: Trig) -> Trig:
        """Return the inverse of a rational constant; InputError for 0 and for what oscillates."""
        value = self._constant(element)
        if value is None:
            raise InputError(
                "a denominator, log or root starts with what has no reciprocal: a parameter, or u and u' of a limit "
                "cycle, which oscillate from order 0 on; give the parameter a number, or start it with 1, as 1 + c*u"
            )
        if value == 0:
            raise InputError(
                "a denominator, log or root does not start from a nonzero rational number at the equilibrium; "
                "no power series exists there"
            )
        return constant(self.space, 1 / value)

    def function(self, name: str, element: Trig) -> Trig:
        """Return an elementary function of a constant where its value is rational; InputError elsewhere."""
        value = self._constant(element)
        if value == 0 and name in _AT_ZERO:
            return constant(self.space, fmpq(_AT_ZERO[name]))
        if value == 1 and name == "log":
            return constant(self.space, fmpq(0))
        if value is None:
            raise InputError(
                f"{name} is taken of a parameter, or of what oscillates from order 0 on, as u and u' of a limit cycle "
                "do, and has no rational or finite series there; expand it in powers of u, to the degree that counts"
            )
        raise InputError(
            f"{name} is taken of something that is not {1 if name == 'log' else 0} at the equilibrium, so its series "
            "has irrational coefficients; shift the argument or use the numeric verbs"
        )

    def power(self, element: Trig, numerator: int, denominator: int) -> Trig:
        """Return a rational power of a rational constant; InputError where it is irrational."""
        exponent = sympy.Rational(numerator, denominator)
        value = self._constant(element)
        if value is None:
            raise InputError(
                f"the power {exponent} is taken of a parameter, or of what oscillates from order 0 on, as u and u' of "
                "a limit cycle do, and has no rational series there; give the parameter a number, or start it with 1"
            )
        if isinstance(value, arb) and value.is_exact():
            value = value.fmpq()
        root = None if isinstance(value, arb) else sympy.Rational(int(value.p), int(value.q)) ** exponent
        if root is None or not root.is_Rational:
            raise InputError(f"the power {exponent} of {value} is not rational; scale the argument to start from 1")
        return self.number(root)

    def _constant(self, element: Trig) -> fmpq | arb | None:
        """Return the value of a constant element without parameters, else None."""
        coefficients = element.coefficients(0)
        if any(p is not None and p != 0 for p in element.parts[1:]) or len(coefficients) > 1:
            return None
        value = coefficients[0] if coefficients else fmpq(0)
        if isinstance(value, fmpq | arb):
            return value
        terms = value.to_dict()
        if any(any(powers) for powers in terms):
            return None
        return next(iter(terms.values()), fmpq(0))
