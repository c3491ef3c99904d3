r"""Horner's rule whose last steps carry their rounding errors along.

A value is the unevaluated sum H + L.  With p + e = H x and s + t = p + c exactly (``TWO_PRODUCT``, ``TWO_SUM``),

    H' = s,      L' = (t + (e + (H x_low + L x))) + c_low,

x + x_low being the exact square of the argument, and c + c_low the exact coefficient to twice the digits: compensated
Horner (S. Graillat, P. Langlois and N. Louvet, Algorithms for accurate, validated and fast polynomial evaluation, Japan
J. Indust. Appl. Math. 26, 2009).  Only so many steps are carried as the proved bound asks for.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from flint import fmpq
from sympy import Rational

from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen.number import Number, Real
from ridgeback.symbolic.codegen.program import (
    Form,
    Function,
    Horner,
    Operand,
    Operation,
    Statement,
    Step,
    Steps,
    needed,
)


def compensated(form: Form, function: Function) -> Iterator[Function]:
    """The function with one compensated step, two, three, four, six, and so on up to all of them.

    Nothing for a function that is not Horner's rule in one variable, times powers and k; in mode accurate, which has no
    other evaluation, InputError.
    """
    function = _with_horner(function)
    place = _place(function)
    if place is None:
        if form.mode == "accurate":
            raise InputError(
                f"mode accurate is written for polynomials in one variable, and {function.name} is none; use strict"
            )
        return
    length = len(function.body[place].coefficients)  # type: ignore[union-attr]
    counts = sorted({1, *(share * 2**i for i in range(length.bit_length()) for share in (2, 3))})
    for count in dict.fromkeys(min(count, length - 1) for count in counts):
        yield _compensated(function, place, count, form.real)


def _with_horner(function: Function) -> Function:
    """A single term c x as Horner's rule for the polynomial c, times x."""
    if function.polynomial is None or len(function.polynomial.variables) != 1 or len(function.polynomial.terms) > 1:
        return function
    body: list[Statement] = []
    for statement in function.body:
        operands = () if isinstance(statement, Horner) else statement.operands
        number = next((o for o in operands if isinstance(o, Number)), None)
        at = next((o for o in operands if isinstance(o, str)), None)
        if number is None or at is None or statement.operation is not Operation.MULTIPLY:  # type: ignore[union-attr]
            body.append(statement)
        else:
            name = statement.name
            body += [Horner(name, at, (number,)), Step(name, Operation.MULTIPLY, (at, name))]
    return replace(function, body=tuple(body))


def _place(function: Function) -> int | None:
    """Where Horner's rule is; None where there is another one, or more than products behind it."""
    places = [i for i, statement in enumerate(function.body) if isinstance(statement, Horner)]
    rest = function.body[places[0] + 1 :] if len(places) == 1 else ()
    plain = all(isinstance(s, Step) and s.operation is Operation.MULTIPLY for s in rest)
    own = function.polynomial is not None and function.polynomial.variables == (function.domain.argument,)
    return places[0] if len(places) == 1 and plain and own else None


class _Pair:
    """H + L as statements are added."""

    def __init__(self, steps: Steps, high: str) -> None:
        self.steps, self.high = steps, high
        self.low: Operand | None = None

    def times(self, x: Operand, x_low: str | None) -> None:
        """(H + L)(x + x_low), without L x_low."""
        steps, shares = self.steps, []
        if x_low is not None:
            shares.append(steps.multiply("high_share", self.high, x_low))
        if self.low is not None:
            shares.append(steps.multiply("low_share", self.low, x))
        self.high = steps.assign("product", Operation.TWO_PRODUCT, self.high, x, rest="lost")
        for share in shares:
            steps.add("lost", "lost", share)
        self.low = "lost"

    def plus(self, c: Number) -> None:
        """(H + L) + c, after a product."""
        steps = self.steps
        self.high = steps.assign("sum", Operation.TWO_SUM, self.high, _held(c), rest="sum_low")
        self.low = steps.add("sum_low", "sum_low", self.low or steps.number(0))
        if rest := _cut_off(c):
            steps.add("sum_low", self.low, rest)


def _held(c: Number) -> Number:
    """The number of the format next to a coefficient, as an exact one."""
    return Number(fmpq(*c.nearest.as_integer_ratio()), c.real)


def _cut_off(c: Number) -> Number | None:
    """What rounding takes from a coefficient; None where that is nothing."""
    if c.representable:
        return None
    if isinstance(c.exact, fmpq):
        return Number(c.exact - _held(c).exact, c.real)
    return Number(c.exact - Rational(*c.nearest.as_integer_ratio()), c.real)


def _compensated(function: Function, place: int, count: int, real: Real) -> Function:
    horner = function.body[place]
    assert isinstance(horner, Horner)  # noqa: S101 - ``_place`` has seen to it
    steps = Steps(real)
    x_low = _before(steps, function.body[:place], horner.at)
    kept, last = horner.coefficients[count:], horner.coefficients[:count]
    if len(kept) > 1:
        steps.taken.append(replace(horner, coefficients=kept))
    else:
        steps.multiply(horner.name, _held(kept[0]) if kept[0] else steps.number(0), steps.number(1))
    pair = _Pair(steps, horner.name)
    pair.low = _cut_off(kept[0]) if len(kept) == 1 and kept[0] is not None else None
    for coefficient in reversed(last):
        pair.times(horner.at, x_low)
        if coefficient is not None:
            pair.plus(coefficient)
    held = {horner.at} if x_low is not None else set()
    for factor in _factors(function, place, held):
        pair.times(factor, x_low if factor in held else None)
    result = steps.add("rounded", pair.high, pair.low or steps.number(0))
    return replace(function, body=needed(steps.taken, result), result=result)


def _before(steps: Steps, body: tuple[Statement, ...], at: str) -> str | None:
    """What stands before Horner's rule; the square of the argument keeps its rounding error, whose name is returned."""
    rest = None
    for statement in body:
        if isinstance(statement, Step) and statement.name == at and _is_square(statement):
            rest = f"{at}_low"
            steps.assign(at, Operation.TWO_PRODUCT, *statement.operands, rest=rest)
        else:
            steps.taken.append(statement)
    return rest


def _is_square(step: Step) -> bool:
    return step.operation is Operation.MULTIPLY and len(set(step.operands)) == 1


def _factors(function: Function, place: int, held: set[str]) -> Iterator[Operand]:
    """What Horner's value is multiplied by, powers factor by factor, so that none of their roundings is lost."""
    chain, powers = function.body[place].name, dict[Operand, tuple[Operand, ...]]()
    for i, statement in enumerate(function.body):
        if i == place or not isinstance(statement, Step) or statement.name in held:
            continue
        factors = tuple(f for o in statement.operands if o != chain for f in powers.get(o, (o,)))
        if i > place and chain in statement.operands:
            chain = statement.name
            yield from factors
        else:
            powers[statement.name] = factors
