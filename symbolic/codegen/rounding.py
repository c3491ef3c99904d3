r"""What rounding can do to a generated function, proved from its steps.

Every operation rounds to the nearest double, fl(x op y) = (x op y)(1 + d) with |d| <= u = 2^-53 unless it over- or
underflows.  So each computed quantity is the sum of its exact terms, each times a product of m factors (1 + d)^(+-1),
and such a product is 1 + theta with |theta| <= gamma_m = m u/(1 - m u) (N. J. Higham, Accuracy and Stability of
Numerical Algorithms, 2nd edition, SIAM, 2002, Lemma 3.1).  Hence, with exact coefficients and at the very arguments,

    |computed - exact| <= gamma_m * (sum of the absolute values of the terms).

The number m of a product is the sum of its factors' plus one, of a sum the largest of its terms' plus one.  Dividing
by a quantity of m factors counts 2 m (Higham, Lemma 3.3).
"""

from __future__ import annotations

from collections.abc import Iterable
from decimal import ROUND_CEILING, Context, Decimal
from fractions import Fraction
from typing import Any, Final

from sympy import Add, Expr, Mul, Pow, Symbol

UNIT: Final = Fraction(1, 2**53)
"""u, the unit roundoff of double precision."""


def gamma(count: int) -> Fraction:
    """gamma_m, exactly.

    >>> gamma(1) == UNIT / (1 - UNIT)
    True
    """
    return count * UNIT / (1 - count * UNIT)


def roundings(constants: Iterable[Any], steps: Iterable[Any], result: Expr) -> int:
    """m for the result of some steps; an exact constant counts 0, a rounded one 1, an argument 0."""
    return depths(constants, steps)(result)


class depths:  # noqa: N801  (it reads as what it computes)
    """The number of roundings behind each name, and of any expression in them.

    >>> depths((), ())(Symbol("x") * Symbol("y"))
    1
    """

    def __init__(self, constants: Iterable[Any], steps: Iterable[Any]) -> None:
        self.known: dict[str, int] = {}
        for c in constants:
            exact = c.exact.is_Rational and Fraction(int(c.exact.p), int(c.exact.q)) == Fraction(c.nearest)
            self.known[c.name] = 0 if exact else 1
        for step in steps:
            self.known[step.lhs.name] = self(step.rhs)

    def __call__(self, expression: Expr) -> int:
        """m of an expression as it is printed: n - 1 operations for n operands, the deepest path."""
        if isinstance(expression, Symbol):
            return self.known.get(expression.name, 0)
        if isinstance(expression, Pow):
            return self._factor(expression) + 1
        if isinstance(expression, Mul):
            return sum(map(self._factor, expression.args)) + len(expression.args) - 1
        if isinstance(expression, Add):
            return max(map(self, expression.args)) + len(expression.args) - 1
        return 0

    def _factor(self, expression: Expr) -> int:
        """m that a factor brings, without its operation; every power here has the exponent -1, a division."""
        return 2 * self(expression.base) if isinstance(expression, Pow) else self(expression)


def rounding_note(count: int) -> str:
    """The bound in words.

    >>> rounding_note(0)
    'Rounding: none, the result is exact.'
    >>> rounding_note(3)
    'Rounding: the error is at most 3.4e-16 times the sum of the absolute values of the terms (3 roundings in a row, ...
    """
    if count == 0:
        return "Rounding: none, the result is exact."
    return (
        f"Rounding: the error is at most {upwards(gamma(count))} times the sum of the absolute values of the terms "
        f"({count} roundings in a row, proved; without over- or underflow)."
    )


def upwards(value: Fraction, digits: int = 2) -> str:
    """A positive number in a few digits, rounded up.

    >>> upwards(Fraction(1, 3))
    '0.34'
    """
    context = Context(prec=digits, rounding=ROUND_CEILING)
    return f"{float(context.divide(Decimal(value.numerator), Decimal(value.denominator))):.{digits}g}"
