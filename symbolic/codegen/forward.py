"""A proved bound of what rounding does to straight-line code, over a whole range: forward error analysis in balls.

Beside each computed quantity stand a ball of its exact value over a part of the range and a bound of how far the
computed value may be from it.  Every operation rounds to the nearest double, and adds at most u times the size of its
result (N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2nd edition, SIAM, 2002, section 3.3: running
error analysis), square roots included, as IEEE 754 asks.  A cosine is taken to be right to one unit in the last place,
which the standard does not ask for: what is proved with it says so.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from typing import Any, Final

from flint import arb, fmpq
from sympy import Add, Expr, Mul, Pow, Rational, Symbol, cos

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import ball

U: Final = fmpq(1, 2**53)
COSINE: Final = 2
"""One unit in the last place is at most 2 u of the value."""
BOXES: Final = 16
SHARP: Final = 12
"""A box is halved so often at most for the sake of a sharper bound: until it is twice that at its middle."""
FINEST: Final = 30
"""A box is halved so often at most before it is given up."""


@dataclass(frozen=True)
class Computed:
    """A quantity over a box: ``exact`` holds its exact values, the computed ones are within ``error`` of them."""

    exact: arb
    error: arb

    def rounded(self, units: int = 1) -> Computed:
        """The same after rounding, ``units`` times u."""
        return Computed(self.exact, (self.error + units * U * (abs(self.exact) + self.error)).upper())


Known = dict[str, Computed]
ONE: Final = Computed(arb(1), arb(0))


def computed(expression: Expr, known: Mapping[str, Computed]) -> Computed:
    """What is known about an expression as it is printed, from what is known about its names.

    >>> found = computed(Symbol("x") + Symbol("y"), {n: Computed(arb(1), arb(0)) for n in "xy"})
    >>> found.exact == 2, bool(found.error <= 2.3e-16)
    (True, True)
    """
    if isinstance(expression, Symbol):
        return known[expression.name]
    if isinstance(expression, Rational):
        return Computed(ball(expression), arb(0))
    if isinstance(expression, Mul):
        return _product(expression, known)
    below = [computed(argument, known) for argument in expression.args]
    if isinstance(expression, Add):
        return reduce(_plus, below)
    if isinstance(expression, cos):
        return Computed(below[0].exact.cos(), below[0].error).rounded(COSINE)
    if isinstance(expression, Pow) and expression.exp == Rational(1, 2):
        return _square_root(below[0])
    if isinstance(expression, Pow) and expression.exp == -1:
        return _over(ONE, below[0])
    raise InputError(f"no rounding is known of {expression}; write it in sums, products, quotients and roots")


def _product(expression: Expr, known: Mapping[str, Computed]) -> Computed:
    """Numerators first, then divisions, as both languages print it; a factor -1 is exact."""
    above = [a for a in expression.args if not (isinstance(a, Pow) and a.exp == -1)]
    below = [computed(a.base, known) for a in expression.args if isinstance(a, Pow) and a.exp == -1]
    factors = [computed(a, known) for a in above if a != -1]
    found = reduce(_over, below, reduce(_times, factors) if factors else ONE)
    return Computed(-found.exact if -1 in above else found.exact, found.error)


def _plus(x: Computed, y: Computed) -> Computed:
    return Computed(x.exact + y.exact, x.error + y.error).rounded()


def _times(x: Computed, y: Computed) -> Computed:
    error = abs(x.exact) * y.error + abs(y.exact) * x.error + x.error * y.error
    return Computed(x.exact * y.exact, error).rounded()


def _over(x: Computed, y: Computed) -> Computed:
    """|x'/y' - x/y| = |(x' - x) - (x/y)(y' - y)| / |y'|."""
    value = x.exact / y.exact
    least = y.exact.abs_lower() - y.error
    error = (x.error + abs(value) * y.error) / least if least > 0 else arb("inf")
    return Computed(value, error).rounded()


def _square_root(x: Computed) -> Computed:
    """|sqrt(x') - sqrt(x)| = |x' - x| / (sqrt(x') + sqrt(x))."""
    least = x.exact.lower() - x.error
    error = x.error / x.exact.lower().sqrt() if least >= 0 and x.exact > 0 else arb("inf")
    return Computed(x.exact.sqrt(), error).rounded()


def relative_bound(
    constants: Iterable[Any],
    steps: Iterable[Any],
    result: Expr,
    variable: str,
    end: Fraction,
    given: Mapping[str, float],
) -> Fraction:
    """An upper bound of |computed/exact - 1| for 0 <= variable <= end, at FLINT's working precision.

    ``given`` are arguments of one value.  Raises InputError where a denominator or a root may vanish.
    """
    fixed = {c.name: Computed(ball(c.exact), abs(ball(c.exact) - arb(c.nearest)).upper()) for c in constants}
    fixed |= {name: Computed(arb(value), arb(0)) for name, value in given.items()}
    lines, worst = list(steps), arb(0)

    def error(box: arb) -> arb:
        found = _run(lines, result, {**fixed, variable: Computed(box, arb(0))})
        return arb((found.error / found.exact.abs_lower()).upper())

    waiting = [(end * i / BOXES, end * (i + 1) / BOXES, 0) for i in reversed(range(BOXES))]
    while waiting:
        low, high, depth = waiting.pop()
        middle, here = (low + high) / 2, error(ball(low).union(ball(high)))
        if here <= worst or (here.is_finite() and (depth >= SHARP or here <= 2 * error(ball(middle)))):
            worst = arb.max(worst, here)
        elif depth < FINEST:
            waiting += [(middle, high, depth + 1), (low, middle, depth + 1)]
        else:
            raise InputError(f"the code may divide by zero near {variable} = {float(high):.6g}; give a shorter range")
    exact = worst.upper().fmpq()
    return Fraction(int(exact.p), int(exact.q))


def _run(steps: list[Any], result: Expr, known: Known) -> Computed:
    for step in steps:
        known[step.lhs.name] = computed(step.rhs, known)
    return computed(result, known)
