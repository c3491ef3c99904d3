"""What rounding does to generated code on a part of its domain: forward error analysis in balls.

Beside each computed value stand a ball of its exact value over a part of the domain and a bound of how far the
computed value may be from it.  Every operation rounds to the nearest number of the format and adds at most half the
distance of neighbouring numbers, at the largest size that its result may have (N. J. Higham, Accuracy and Stability of
Numerical Algorithms, 2nd edition, SIAM, 2002, sections 2.2 and 3.3); under- and overflow are part of that.  The sum
and the product that also give their rounding error give it exactly: what is lost is then in ``rest`` and not an error.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import Final

from flint import arb, fmpq

from ridgeback.symbolic.codegen.number import Number, Real
from ridgeback.symbolic.codegen.program import Form, Function, Horner, Operand, Operation, Statement, Step, operands_of

KEPT: Final = 24
"""Coefficients of a long polynomial that are looked at one by one; those of higher powers by their sizes."""
SLACK: Final = 2.0**-50
ZERO: Final = arb(0)


@dataclass(frozen=True)
class Computed:
    """A value over a box: ``exact`` holds its exact values, the computed ones are within ``error`` of them."""

    exact: arb
    error: arb
    before: arb = field(default_factory=lambda: ZERO)
    """The part of the error that was there before the last rounding."""
    grid: int | None = None
    """The computed values are whole multiples of 2^grid; None where no such unit is known."""


@cache
def two_to(power: int) -> arb:
    """2^power, exactly.

    >>> two_to(-1) == arb(0.5)
    True
    """
    return arb(2) ** power


def half_spacing(size: arb, real: Real) -> arb:
    """How far rounding may move a value of at most this size; infinite beyond the largest number.

    That is half the distance between neighbouring numbers; just above a power of two, where the distance doubles, no
    more than what the size exceeds the power by, since the power itself is a number.

    >>> from ridgeback.symbolic.codegen.number import FLOAT64
    >>> half_spacing(arb(1.5), FLOAT64) == arb(2) ** -53, half_spacing(arb(1), FLOAT64) == arb(2) ** -54
    (True, True)
    """
    top = size.upper()
    if not top.is_finite():
        return arb("inf")
    mantissa, exponent = top.man_exp()
    e = int(mantissa).bit_length() + int(exponent) if mantissa != 0 else real.low
    if e > real.high:
        return arb("inf")
    whole, below = two_to(max(e - real.digits, real.low) - 1), two_to(max(e - 1 - real.digits, real.low) - 1)
    excess = top - two_to(e - 1)
    return excess if below <= excess <= whole else below if excess < below else whole


class Analysis:
    """One run over a box."""

    def __init__(self, known: Mapping[str, Computed], form: Form, constants: dict[int, Computed]) -> None:
        self.known, self.real, self.fused, self.constants = dict(known), form.real, form.fused, constants

    def run(self, body: Iterable[Statement], result: Operand) -> Computed:
        for statement in body:
            if isinstance(statement, Horner):
                self._horner(statement)
            else:
                self._step(statement)
        return self.of(result)

    def run_to_sum(self, body: Sequence[Statement], function: Function, exact: arb) -> Computed:
        """The same for code whose last addition is of a value and its low part, whose exact sum is known better.

        What follows are products with the factor of the polynomial, ``exact`` being without it.
        """
        polynomial = function.polynomial
        place = max(i for i, s in enumerate(body) if isinstance(s, Step) and s.operation is Operation.ADD)
        if place == len(body) - 1 and polynomial is not None and polynomial.factor:
            exact = exact * self.known[polynomial.factor].exact
        last = body[place]
        self.run(body[:place], Number(fmpq(0)))
        self.known[last.name] = self.rounded(exact, sum((self.of(o).error for o in operands_of(last)), arb(0)))
        return self.run(body[place + 1 :], function.result)

    def of(self, operand: Operand) -> Computed:
        if isinstance(operand, str):
            return self.known[operand]
        if id(operand) not in self.constants:
            self.constants[id(operand)] = constant(operand)
        return self.constants[id(operand)]

    def rounded(self, exact: arb, error: arb, grid: int | None = None) -> Computed:
        """After a rounding, which leaves multiples of a unit as they are where the format holds all of that size."""
        size, whole = (abs(exact) + error).upper(), error.upper()
        if self.holds(size, grid):
            return Computed(exact, whole, whole, grid)
        return Computed(exact, (error + half_spacing(size, self.real)).upper(), whole)

    def holds(self, size: arb, grid: int | None) -> bool:
        """Whether all multiples of 2^grid up to a size are numbers of the format."""
        if grid is None or grid < self.real.low:
            return False
        return bool(size <= two_to(min(grid + self.real.digits, self.real.high - 1)))

    def _may_underflow(self, exact: arb, error: arb) -> bool:
        """Whether a value may be so small, and is not 0, that fewer digits are left of it."""
        return not (exact == 0 and error == 0) and not abs(exact) - error >= two_to(self.real.low + self.real.digits)

    def _horner(self, horner: Horner) -> None:
        tail = self._tail(horner, self.known[horner.at]) if horner.loops else None
        if tail is not None and tail.error.is_finite():
            self.known[horner.name] = tail
            value: Operand = horner.name
            for c in reversed(horner.coefficients[:KEPT]):
                self._step(Step(horner.name, Operation.MULTIPLY_ADD, (value, horner.at, c or Number(fmpq(0)))))
            return
        for step in horner.steps():
            self._step(step)

    def _tail(self, horner: Horner, x: Computed) -> Computed:
        """What the high powers of a long polynomial amount to, by sizes alone.

        With T the sum of |c_i| X^i, its computed value is within gamma_(2n + 2) T of the value at the computed x, and
        that within |x' - x| T' of the value at x; T and T' are summed in floats, whose own errors are a share of
        gamma_(4n).  ``lost`` counts underflows.
        """
        top = float(arb(abs(x.exact) + x.error).upper()) * (1 + SLACK)
        size = slope = lost = 0.0
        for c in horner.falling[: len(horner.falling) - KEPT]:
            slope = slope * top + size
            size = size * top + abs(c)
            lost = lost * top + 1.0
        n = len(horner.falling)
        grown = arb(1 + 8 * n * SLACK)
        count = (2 * n + 2) * arb(fmpq(self.real.unit.numerator, self.real.unit.denominator))
        error = count / (1 - count) * size + x.error * arb(slope) + 2 * n * arb(lost) * two_to(self.real.low)
        return Computed(arb(0, (arb(size) * grown).upper()), (error * grown).upper())

    def _step(self, step: Step) -> None:
        operands = [self.of(o) for o in step.operands]
        if step.rest:
            pair = self._split if step.operation in SPLITS else self._pair
            self.known[step.name], self.known[step.rest] = pair(step.operation, operands)
        else:
            self.known[step.name] = self._value(step.operation, operands)

    def _value(self, operation: Operation, x: list[Computed]) -> Computed:
        match operation:
            case Operation.ADD:
                return self.rounded(x[0].exact + x[1].exact, x[0].error + x[1].error, of_sum(x[0], x[1]))
            case Operation.SUBTRACT:
                return self.rounded(x[0].exact - x[1].exact, x[0].error + x[1].error, of_sum(x[0], x[1]))
            case Operation.MULTIPLY:
                exact, error = product(x[0], x[1])
                grid = of_product(x[0], x[1])
                if any(is_power_of_two(one) for one in x) and not self.holds((abs(exact) + error).upper(), grid):
                    lost = half_spacing(abs(exact) + error, self.real)  # of an overflow; the rest is for an underflow
                    under = two_to(self.real.low - 1) if self._may_underflow(exact, error) else ZERO
                    whole = (error + under).upper() if lost.is_finite() else lost
                    one, other = x if is_power_of_two(x[0]) else (x[1], x[0])
                    return Computed(exact, whole, (abs(one.exact) * other.before).upper())
                return self.rounded(exact, error, grid)
            case Operation.MULTIPLY_ADD:
                exact, error = product(x[0], x[1])
                grid = of_product(x[0], x[1])
                inner = Computed(exact, error, grid=grid) if self.fused else self.rounded(exact, error, grid)
                return self.rounded(exact + x[2].exact, inner.error + x[2].error, of_sum(inner, x[2]))
            case Operation.DIVIDE if is_power_of_two(x[1]):
                return self._value(Operation.MULTIPLY, [x[0], Computed(1 / x[1].exact, arb(0))])
            case Operation.DIVIDE:
                return self.rounded(*quotient(x[0], x[1]))
            case Operation.SQUARE_ROOT:
                return self.rounded(*square_root(x[0]))
            case Operation.ROOT:
                return any_root(x[0], int(float(x[1].exact)), self.real)
            case Operation.ABSOLUTE:
                return Computed(abs(x[0].exact), x[0].error)
            case Operation.FLOOR if x[0].exact.rad() == 0 and x[0].error == 0:
                return Computed(x[0].exact.floor(), arb(0))
        return Computed(arb.nan(), arb("inf"))

    def _pair(self, operation: Operation, operands: list[Computed]) -> tuple[Computed, Computed]:
        x, y = operands
        if operation is Operation.TWO_SUM:
            exact, error = x.exact + y.exact, x.error + y.error
        else:
            exact, error = product(x, y)
            error = error + two_to(self.real.low + self.real.digits + 6)  # should a partial product underflow
            if not self.fused and not all(self._splits(one) for one in (x, y, Computed(exact, error))):
                error = arb("inf")
        lost = half_spacing(abs(exact) + error, self.real)
        rest = arb(0, lost.upper())
        return Computed(exact - rest, error.upper()), Computed(rest, arb(0))

    def _splits(self, x: Computed) -> bool:
        """Whether Veltkamp's splitting of a value by 2^s + 1, s half of the digits, surely does not overflow.

        S. Boldo, Pitfalls of a full floating-point proof, IJCAR 2006, LNCS 4130, 52-66.
        """
        half = (self.real.digits + 1) // 2
        return bool((abs(x.exact) + x.error) * two_to(half + 1) < two_to(self.real.high))

    def _split(self, operation: Operation, operands: list[Computed]) -> tuple[Computed, Computed]:
        """A value as a multiple of a unit and the rest: what was not exact in it is now not exact in the rest.

        With h next to a, |a - h| <= unit/2; (a - h)(a + h) is rounded twice.  Of a square that is rounded, the rest by
        one fused operation is rounded once.
        """
        a, x, constant = operands[0], operands[-2], operands[-1]
        cut = a if operation is Operation.SPLIT_SQUARE and not self.fused else x
        unit = unit_of(constant, self.real)
        if unit is None or not (abs(cut.exact) + cut.error) * 8 <= two_to(unit + self.real.digits):
            return (Computed(x.exact, arb("inf")),) * 2
        half = two_to(unit - 1)
        if operation is Operation.SPLIT_SQUARE and not self.fused:
            part = Computed(a.exact + arb(0, half.upper()), arb(0), grid=unit)
            both = self._value(Operation.ADD, [a, part])
            rest = arb(0, (half * abs(both.exact)).upper())
            return self._value(Operation.MULTIPLY, [part, part]), self.rounded(rest, half * both.error)
        rest = arb(0, (half + x.error).upper())
        head = Computed(x.exact - rest, arb(0), grid=unit)
        return head, Computed(rest, x.error) if operation is Operation.SPLIT else self.rounded(rest, arb(0))


SPLITS: Final = (Operation.SPLIT, Operation.SPLIT_SQUARE)


def unit_of(constant: Computed, real: Real) -> int | None:
    """The exponent of the unit that a constant splits by: 3 2^(digits - 2) units."""
    mantissa, exponent = constant.exact.man_exp()
    return int(exponent) - real.digits + 2 if mantissa == 3 and constant.error == 0 else None


def of_sum(x: Computed, y: Computed) -> int | None:
    """The unit of a sum."""
    return None if x.grid is None or y.grid is None else min(x.grid, y.grid)


def of_product(x: Computed, y: Computed) -> int | None:
    """The unit of a product."""
    return None if x.grid is None or y.grid is None else x.grid + y.grid


def is_power_of_two(x: Computed) -> bool:
    """Whether a value is a power of two: a product with it is exact, unless it over- or underflows.

    >>> is_power_of_two(Computed(arb(0.25), arb(0))), is_power_of_two(Computed(arb(3), arb(0)))
    (True, False)
    """
    return bool(x.error == 0 and x.exact.rad() == 0) and abs(int(x.exact.man_exp()[0])) == 1


def constant(number: Number) -> Computed:
    """An exact constant and the distance of its nearest number."""
    exact, nearest = number.ball, arb(number.nearest)
    grid = int(nearest.man_exp()[1]) if number.nearest else None
    return Computed(exact, abs(exact - nearest).upper(), grid=grid)


def product(x: Computed, y: Computed) -> tuple[arb, arb]:
    """|x'y' - xy| <= |x||y' - y| + |y||x' - x| + |x' - x||y' - y|."""
    return x.exact * y.exact, abs(x.exact) * y.error + abs(y.exact) * x.error + x.error * y.error


def quotient(x: Computed, y: Computed) -> tuple[arb, arb]:
    """|x'/y' - x/y| = |(x' - x) - (x/y)(y' - y)| / |y'|."""
    value = x.exact / y.exact
    least = y.exact.abs_lower() - y.error
    return value, (x.error + abs(value) * y.error) / least if least > 0 else arb("inf")


def square_root(x: Computed) -> tuple[arb, arb]:
    """|sqrt(x') - sqrt(x)| = |x' - x| / (sqrt(x') + sqrt(x))."""
    least = x.exact.lower() - x.error
    below = x.exact.lower().sqrt()
    return x.exact.sqrt(), x.error / below if least >= 0 and x.exact > 0 else arb("inf")


def any_root(x: Computed, degree: int, real: Real) -> Computed:
    """The root that ``lowering._root`` computes: besides what x' - x does, its last step errs by 2 units of roundoff.

    With d - 1 products y^d errs by the share (d - 1) u, its correction so by u y, and the last difference by u y more;
    what is left of Newton's error and the roundings of a correction of that size are in the last quarter.
    """
    least, most = x.exact.lower() - x.error, x.exact.upper() + x.error
    if not (least > two_to(real.low + 2 * real.digits) / 2 and most < two_to(real.high - 1)):
        return Computed(arb.nan(), arb("inf"))  # where y^d may over- or underflow
    value = x.exact.root(degree)
    unit = arb(fmpq(9 * real.unit.numerator, 4 * real.unit.denominator))
    error = x.error * least.root(degree) / (degree * least)
    return Computed(value, (error + unit * (value + error)).upper(), error.upper())
