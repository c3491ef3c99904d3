"""A ring of plain numbers for power series: floats, multiple precision, rationals."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from operator import mul
from typing import Any, Final

from ridgeback.common.errors import InputError
from ridgeback.common.recurrences import Element, Node, Product, Sums, plain_sums

Number = Any
FUNCTIONS: Final = (
    *("exp", "log", "sin", "cos", "tan", "sinh", "cosh", "tanh"),
    *("asin", "acos", "atan", "asinh", "acosh", "atanh"),
)
"""The functions that a power series can be taken of, by the names that they have in every library."""


def plain_dot(left: Sequence[Number], right: Sequence[Number]) -> Number:
    """Sum of products, from the left."""
    return sum(map(mul, left, right))


@dataclass(frozen=True)
class NumberRing:
    """Numbers of one type as the coefficients of power series.

    Parameters
    ----------
    whole
        Makes a number of an int.
    functions
        The elementary functions by name; one that fails raises ValueError, or answers a number that is not real.
    dot
        Sum of products of two sequences of one length.
    root
        Base and exponent (a number) to the power.
    number
        Makes a number of a constant of the expressions that are compiled over this ring.

    Examples
    --------
    >>> FLOATS.function("cos", 0.0)
    1.0
    """

    whole: Callable[[int], Number]
    functions: Mapping[str, Callable[[Number], Number]]
    dot: Callable[[Sequence[Number], Sequence[Number]], Number] = plain_dot
    root: Callable[[Number, Number], Number] = pow
    number: Callable[[Any], Number] = float

    def rational(self, numerator: int, denominator: int = 1) -> Number:
        value = self.whole(numerator)
        return value if denominator == 1 else value / denominator

    def scale(self, element: Number, numerator: int, denominator: int) -> Number:
        if denominator == 1:
            return element * numerator
        if numerator == -1:
            return -element / denominator
        return (element if numerator == 1 else element * numerator) / denominator

    def absent(self, element: Number) -> bool:
        return not element

    def product(self, x: Node, y: Node) -> Node:
        return Product(self, x, y)

    def sums(self, x: list[Element], y: list[Element]) -> Sums:
        return plain_sums(self, x, y)

    def invert(self, element: Number) -> Number:
        if not element:
            raise InputError("a denominator, log or root is 0 here, where its power series is not analytic")
        return 1 / element

    def function(self, name: str, element: Number) -> Number:
        try:
            value = self.functions[name](element)
        except KeyError:
            raise InputError(f"{name} has no power series here; known functions: {', '.join(self.functions)}") from None
        except (ValueError, OverflowError):
            value = None
        if value is None or isinstance(value, complex) or hasattr(value, "_mpc_"):
            raise InputError(f"{name} is not analytic at {float(element):.6g}")
        return value

    def power(self, element: Number, numerator: int, denominator: int) -> Number:
        if denominator == 1:
            return element**numerator
        if element < 0:
            raise InputError(f"the power {numerator}/{denominator} is not analytic at {float(element):.6g}")
        return self.root(element, self.rational(numerator, denominator))


FLOATS: Final = NumberRing(float, {name: getattr(math, name) for name in FUNCTIONS}, root=math.pow)
"""Python's floats."""
