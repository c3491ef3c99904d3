"""Operations that are made of several, in those that every language has."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction
from typing import Final

from flint import fmpq

from ridgeback.symbolic.codegen.number import FLOAT64, Number, Real
from ridgeback.symbolic.codegen.program import Form, Function, Horner, Operation, Statement, Step


def operations(function: Function, form: Form) -> Iterator[Step]:
    """All single operations of a function, as the form has them."""
    return lowered(function.body, form.real, fused=form.fused)


def lowered(body: Iterable[Statement], real: Real = FLOAT64, *, fused: bool = False) -> Iterator[Step]:
    """Statements as single operations of the languages."""
    for statement in body:
        for step in statement.steps() if isinstance(statement, Horner) else (statement,):
            yield from lowered_step(step, real, fused=fused)


SPLITTERS: Final = {53: 2**27 + 1, 24: 2**12 + 1}
"""Veltkamp's constant by the digits of the format."""


def lowered_step(step: Step, real: Real, *, fused: bool = False) -> Iterator[Step]:
    """What is made of several operations in those, under names of its own; other steps as they are."""
    match step.operation:
        case Operation.TWO_SUM:
            yield from _two_sum(step)
        case Operation.TWO_PRODUCT if fused:
            yield from _fused_product(step, real)
        case Operation.TWO_PRODUCT:
            yield from _two_product(step, real)
        case Operation.SPLIT:
            yield from _split(step)
        case Operation.SPLIT_SQUARE if fused:
            yield from _fused_square(step)
        case Operation.SPLIT_SQUARE:
            yield from _split_square(step)
        case Operation.ROOT:
            yield from _root(step, real)
        case _:
            yield step


FIRST_BITS: Final = 20
"""Binary digits of 1/d that a root begins with."""


def _root(step: Step, real: Real) -> Iterator[Step]:
    """y = x^(1/d): repeated square roots by the binary digits of 1/d, then Newton's y - (y^d - x)/(d y^(d-1)).

    The start errs by the share 2^-20 |ln x|, and a step takes a share e to (d - 1) e^2/2.
    """
    x, degree = step.operands
    assert isinstance(degree, Number)  # noqa: S101 - a root is made with a number
    d, y, s, p, t = int(degree.nearest), step.name, *(f"{step.name}_{letter}" for letter in "srt")
    part, begun = x, False
    for i in range(1, FIRST_BITS + 1):
        yield Step(s, Operation.SQUARE_ROOT, (part,))
        part = s
        if (2**i // d) % 2:
            yield Step(y, Operation.MULTIPLY, (y if begun else s, s if begun else Number(fmpq(1), real)))
            begun = True
    for _ in range(newton_steps(d, real)):
        yield Step(p, Operation.MULTIPLY, (y, y))
        for _ in range(d - 3):
            yield Step(p, Operation.MULTIPLY, (p, y))
        yield Step(t, Operation.MULTIPLY, (p, y))
        yield Step(t, Operation.SUBTRACT, (t, x))
        yield Step(t, Operation.DIVIDE, (t, p))
        yield Step(t, Operation.DIVIDE, (t, degree))
        yield Step(y, Operation.SUBTRACT, (y, t))


def newton_steps(d: int, real: Real) -> int:
    """How many steps leave less than a sixteenth of the unit roundoff.

    >>> newton_steps(3, FLOAT64), newton_steps(7, FLOAT64)
    (3, 3)
    """
    share, count = Fraction(-real.low * 7, 10 * 2**FIRST_BITS), 0
    while share > real.unit / 16:
        share, count = Fraction(d, 2) * share * share, count + 1
    return count


def _two_sum(step: Step) -> Iterator[Step]:
    (a, b), s, rest = step.operands, step.name, step.rest
    part, share = f"{rest}_b", f"{rest}_a"
    yield Step(s, Operation.ADD, (a, b))
    yield Step(part, Operation.SUBTRACT, (s, a))
    yield Step(share, Operation.SUBTRACT, (s, part))
    yield Step(part, Operation.SUBTRACT, (b, part))
    yield Step(share, Operation.SUBTRACT, (a, share))
    yield Step(rest, Operation.ADD, (share, part))


def _two_product(step: Step, real: Real) -> Iterator[Step]:
    (a, b), p, rest = step.operands, step.name, step.rest
    heads = {}
    for operand, letter in ((a, "a"), (b, "b")) if a != b else ((a, "a"),):
        large, head, tail = (f"{rest}_{letter}{part}" for part in ("s", "h", "t"))
        yield Step(large, Operation.MULTIPLY, (Number(fmpq(SPLITTERS[real.digits]), real), operand))
        yield Step(head, Operation.SUBTRACT, (large, operand))
        yield Step(head, Operation.SUBTRACT, (large, head))
        yield Step(tail, Operation.SUBTRACT, (operand, head))
        heads[letter] = (head, tail)
    (high_a, low_a), (high_b, low_b) = heads["a"], heads.get("b", heads["a"])
    yield Step(p, Operation.MULTIPLY, (a, b))
    yield Step(rest, Operation.MULTIPLY, (high_a, high_b))
    yield Step(rest, Operation.SUBTRACT, (rest, p))
    for one, other in ((high_a, low_b), (low_a, high_b), (low_a, low_b)):
        yield Step(f"{rest}_p", Operation.MULTIPLY, (one, other))
        yield Step(rest, Operation.ADD, (rest, f"{rest}_p"))


def _fused_product(step: Step, real: Real) -> Iterator[Step]:
    """The product comes last, since it may take the name of a factor."""
    (a, b), minus = step.operands, f"{step.rest}_minus"
    yield Step(minus, Operation.MULTIPLY, (a, b))
    yield Step(minus, Operation.MULTIPLY, (Number(fmpq(-1), real), minus))
    yield Step(step.rest, Operation.MULTIPLY_ADD, (a, b, minus))
    yield Step(step.name, Operation.MULTIPLY, (a, b))


def _split(step: Step) -> Iterator[Step]:
    """(a + m) - m: the sum is a multiple of its unit, the one wanted; the differences are exact."""
    a, m = step.operands
    yield Step(step.name, Operation.ADD, (a, m))
    yield Step(step.name, Operation.SUBTRACT, (step.name, m))
    yield Step(step.rest, Operation.SUBTRACT, (a, step.name))


def _split_square(step: Step) -> Iterator[Step]:
    """With h the multiple next to a: h^2 and (a - h)(a + h)."""
    (a, _, m), part, both = step.operands, f"{step.rest}_part", f"{step.rest}_sum"
    yield from _split(Step(part, Operation.SPLIT, (a, m), step.rest))
    yield Step(both, Operation.ADD, (a, part))
    yield Step(step.name, Operation.MULTIPLY, (part, part))
    yield Step(step.rest, Operation.MULTIPLY, (step.rest, both))


def _fused_square(step: Step) -> Iterator[Step]:
    """With h the multiple next to the rounded square: h and a*a - h in one rounding."""
    (a, square, m), minus = step.operands, f"{step.rest}_minus"
    yield Step(step.name, Operation.ADD, (square, m))
    yield Step(minus, Operation.SUBTRACT, (m, step.name))
    yield Step(step.name, Operation.SUBTRACT, (step.name, m))
    yield Step(step.rest, Operation.MULTIPLY_ADD, (a, a, minus))
