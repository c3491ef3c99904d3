"""A proved bound of what rounding does to generated code, over its whole domain: forward error analysis in balls.

Beside each computed value stand a ball of its exact value over a part of the domain and a bound of how far the
computed value may be from it.  Every operation rounds to the nearest number of the format and adds at most half the
distance of neighbouring numbers, at the largest size that its result may have (N. J. Higham, Accuracy and Stability of
Numerical Algorithms, 2nd edition, SIAM, 2002, sections 2.2 and 3.3); under- and overflow are part of that.  The sum
and the product that also give their rounding error give it exactly: what is lost is then in ``rest`` and not an error.
"""

from __future__ import annotations

import heapq
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Final

from flint import arb, ctx, fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import ball, whole_power
from ridgeback.symbolic.codegen.number import Number, Real, fraction
from ridgeback.symbolic.codegen.program import Form, Function, Horner, Operand, Operation, Statement, Step, operands_of

BITS: Final = 128
WORK: Final = 12000
"""Operations that a bound may cost; short functions are looked at in more and smaller boxes."""
FEWEST: Final = 8
KEPT: Final = 24
"""Coefficients of a long polynomial that are looked at one by one; those of higher powers by their sizes."""
SLACK: Final = 2.0**-50
SHARP: Final = arb(1.02)
"""A box whose bound is so near to that at its middle is not halved."""


ZERO: Final = arb(0)


@dataclass(frozen=True)
class Computed:
    """A value over a box: ``exact`` holds its exact values, the computed ones are within ``error`` of them."""

    exact: arb
    error: arb
    before: arb = field(default_factory=lambda: ZERO)
    """The part of the error that was there before the last rounding."""


@dataclass(frozen=True)
class Bound:
    """What rounding can do over a domain; ``relative`` is None where the exact value may be zero."""

    relative: Fraction | None
    absolute: Fraction
    ulps: Fraction | None
    """In units of the last place of the exact value."""


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
    whole, below = (arb(2) ** (max(n - real.digits, real.low) - 1) for n in (e, e - 1))
    excess = top - arb(2) ** (e - 1)
    return excess if below <= excess <= whole else below if excess < below else whole


class _Analysis:
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

    def run_to_sum(self, body: Sequence[Statement], exact: arb) -> Computed:
        """The same for code that ends with the sum of a value and its low part, whose exact sum is known better."""
        last = body[-1]
        self.run(body[:-1], Number(fmpq(0)))
        return self.rounded(exact, sum((self.of(o).error for o in operands_of(last)), arb(0)))

    def of(self, operand: Operand) -> Computed:
        if isinstance(operand, str):
            return self.known[operand]
        if id(operand) not in self.constants:
            self.constants[id(operand)] = constant(operand)
        return self.constants[id(operand)]

    def rounded(self, exact: arb, error: arb) -> Computed:
        return Computed(exact, (error + half_spacing(abs(exact) + error, self.real)).upper(), error.upper())

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
        error = count / (1 - count) * size + x.error * arb(slope) + 2 * n * arb(lost) * arb(2) ** self.real.low
        return Computed(arb(0, (arb(size) * grown).upper()), (error * grown).upper())

    def _step(self, step: Step) -> None:
        operands = [self.of(o) for o in step.operands]
        if step.rest:
            self.known[step.name], self.known[step.rest] = self._pair(step.operation, *operands)
        else:
            self.known[step.name] = self._value(step.operation, operands)

    def _value(self, operation: Operation, x: list[Computed]) -> Computed:
        match operation:
            case Operation.ADD:
                return self.rounded(x[0].exact + x[1].exact, x[0].error + x[1].error)
            case Operation.SUBTRACT:
                return self.rounded(x[0].exact - x[1].exact, x[0].error + x[1].error)
            case Operation.MULTIPLY:
                exact, error = product(x[0], x[1])
                if any(is_power_of_two(one) for one in x):
                    lost = half_spacing(abs(exact) + error, self.real)  # of an overflow; the rest is for an underflow
                    whole = (error + arb(2) ** (self.real.low - 1)).upper() if lost.is_finite() else lost
                    one, other = x if is_power_of_two(x[0]) else (x[1], x[0])
                    return Computed(exact, whole, (abs(one.exact) * other.before).upper())
                return self.rounded(exact, error)
            case Operation.MULTIPLY_ADD:
                exact, error = product(x[0], x[1])
                inner = Computed(exact, error) if self.fused else self.rounded(exact, error)
                return self.rounded(exact + x[2].exact, inner.error + x[2].error)
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

    def _pair(self, operation: Operation, x: Computed, y: Computed) -> tuple[Computed, Computed]:
        if operation is Operation.TWO_SUM:
            exact, error = x.exact + y.exact, x.error + y.error
        else:
            exact, error = product(x, y)
            error = error + arb(2) ** (self.real.low + self.real.digits + 6)  # should a partial product underflow
        lost = half_spacing(abs(exact) + error, self.real)
        rest = arb(0, lost.upper())
        return Computed(exact - rest, error.upper()), Computed(rest, arb(0))


def is_power_of_two(x: Computed) -> bool:
    """Whether a value is a power of two: a product with it is exact, unless it over- or underflows.

    >>> is_power_of_two(Computed(arb(0.25), arb(0))), is_power_of_two(Computed(arb(3), arb(0)))
    (True, False)
    """
    return bool(x.error == 0 and x.exact.rad() == 0) and abs(int(x.exact.man_exp()[0])) == 1


def constant(number: Number) -> Computed:
    """An exact constant and the distance of its nearest number."""
    exact = number.ball
    return Computed(exact, abs(exact - arb(number.nearest)).upper())


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
    """The root that ``program._root`` computes: besides what x' - x does, its last step errs by 2 units of roundoff.

    With d - 1 products y^d errs by the share (d - 1) u, its correction so by u y, and the last difference by u y more;
    what is left of Newton's error and the roundings of a correction of that size are in the last quarter.
    """
    least, most = x.exact.lower() - x.error, x.exact.upper() + x.error
    if not (least > arb(2) ** (real.low + 2 * real.digits) / 2 and most < arb(2) ** (real.high - 1)):
        return Computed(arb.nan(), arb("inf"))  # where y^d may over- or underflow
    value = x.exact.root(degree)
    unit = arb(fmpq(9 * real.unit.numerator, 4 * real.unit.denominator))
    error = x.error * least.root(degree) / (degree * least)
    return Computed(value, (error + unit * (value + error)).upper(), error.upper())


def bound(form: Form, function: Function) -> Bound | None:
    """What rounding can do to a function of one variable, its other arguments at their defaults.

    None when an argument has no default, or the domain has no known end.  Raises InputError where a denominator or a
    root may vanish.
    """
    variable = function.domain.argument
    others = {a.name: a.default for a in function.arguments if a.name != variable}
    if not function.domain.known or None in others.values():
        return None
    with ctx.workprec(BITS):
        fixed = {name: Computed(arb(value), arb(0)) for name, value in others.items() if value is not None}
        constants: dict[int, Computed] = {}  # by identity: they live as long as the form

        def run(box: arb) -> Computed:
            analysis = _Analysis({**fixed, variable: Computed(box, arb(0))}, form, constants)
            if form.mode == "accurate" and function.polynomial is not None:
                return analysis.run_to_sum(function.body, exact_value(function, fixed, box))
            return analysis.run(function.body, function.result)

        return _over(function, run, form.real)


def exact_value(function: Function, fixed: Mapping[str, Computed], box: arb) -> arb:
    """A polynomial in one variable on a ball, by its exact coefficients."""
    polynomial = function.polynomial
    assert polynomial is not None  # noqa: S101 - asked only where there is one
    powers = {p[0]: c for p, c in polynomial.terms.items()}
    total = arb(0)
    low, high = min(powers, default=0), max(powers, default=0)
    stride = 2 if all((p - low) % 2 == 0 for p in powers) else 1
    for p in range(high, low - 1, -stride):
        total = total * whole_power(box, stride) + (powers[p].ball if p in powers else 0)
    total = total * whole_power(box, low)
    return total * fixed[polynomial.factor].exact if polynomial.factor else total


def _over(function: Function, run: Callable[[arb], Computed], real: Real) -> Bound:
    low, high = start(function), Fraction(function.domain.high)
    length = sum(_cost(statement) for statement in function.body) + 1
    budget = max(FEWEST, WORK // length)
    boxes: list[tuple[float, Fraction, Fraction, Computed]] = []

    def push(left: Fraction, right: Fraction) -> None:
        found = run(ball(left).union(ball(right)))
        measure = _size(found)
        heapq.heappush(boxes, (-measure, left, right, found))

    count = min(16, max(6, budget // 2))
    for i in range(count):
        push(low + (high - low) * i / count, low + (high - low) * (i + 1) / count)
    done: list[Computed] = []
    while boxes and budget > 0:
        _, left, right, found = heapq.heappop(boxes)
        middle = (left + right) / 2
        budget -= 3
        if found.error.is_finite() and _near(found, run(ball(middle))):
            done.append(found)
            continue
        push(left, middle)
        push(middle, right)
    return _worst(function, [*done, *(box[3] for box in boxes)], real, high)


def _cost(statement: Statement) -> int:
    if not isinstance(statement, Horner):
        return 1
    return 2 * KEPT + len(statement.coefficients) // 2 if statement.loops else len(statement.coefficients)


def _size(found: Computed) -> float:
    relative = found.error / found.exact.abs_lower()
    return float(relative.upper()) if relative.is_finite() else float("inf")


def _near(found: Computed, middle: Computed) -> bool:
    return bool(found.error / found.exact.abs_lower() <= SHARP * middle.error / abs(middle.exact))


def _worst(function: Function, found: list[Computed], real: Real, high: Fraction) -> Bound:
    if not all(one.error.is_finite() for one in found):
        variable = function.domain.argument
        raise InputError(
            f"the code of {function.name} may divide by zero, overflow or take the root of a negative number for "
            f"{variable} up to {float(high):.6g}; give a shorter range"
        )
    absolute = upper(max((one.error for one in found), key=lambda e: float(e.upper())))
    if any(one.exact.contains(0) for one in found):
        return Bound(None, absolute, None)
    relative = [(one.error / one.exact.abs_lower()).upper() for one in found]
    return Bound(max(map(upper, relative)), absolute, max(upper(in_last_places(one, real)) for one in found))


def in_last_places(one: Computed, real: Real) -> arb:
    """The error in units of the last place of the exact value; on both sides of a power of two in the box apart.

    The unit doubles there, and so does what the last rounding can do.
    """
    low, high = abs(one.exact).lower(), abs(one.exact).upper()
    mantissa, exponent = high.man_exp()
    edge = arb(2) ** (int(mantissa).bit_length() + int(exponent) - 1)
    if not low < edge < high:
        return (one.error / last_place(low, real)).upper()
    below = one.before + half_spacing(edge + one.before, real)
    return arb(arb.max(below / last_place(low, real), one.error / last_place(edge, real)).upper())


def last_place(size: arb, real: Real) -> arb:
    """The distance of a number of this size to the next larger one.

    >>> from ridgeback.symbolic.codegen.number import FLOAT64
    >>> last_place(arb(1), FLOAT64) == arb(2) ** -52
    True
    """
    mantissa, exponent = size.lower().man_exp()
    return arb(2) ** max(int(mantissa).bit_length() + int(exponent) - real.digits, real.low)


def upper(x: arb) -> Fraction:
    """The upper end of a ball, exactly."""
    return fraction(x.upper().fmpq())


def start(function: Function) -> Fraction:
    """Where a domain need be looked at from: 0 where the function is even or odd, else its lower end."""
    powers = {p[0] % 2 for p in function.polynomial.terms} if function.polynomial else set()
    even = function.polynomial is not None and len(powers) <= 1
    return Fraction(0) if even or function.domain.low == 0 else Fraction(function.domain.low)
