r"""Long polynomials in four interleaved parts, so that a processor can work on several steps at a time.

    c_0 + x (c_1 + x (c_2 + x (c_3 + x T))),     T = (P_0 + x P_1) + x^2 (P_2 + x P_3),    P_r in powers of x^4

Horner's rule alone waits for every step before it; of T four chains of a quarter of the length go side by side.  The
first coefficients, on which the rounding of the result depends, stay with Horner's rule.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

from ridgeback.symbolic.codegen.number import Number
from ridgeback.symbolic.codegen.program import Function, Horner, Operand, Operation, Statement, Steps

SHORTEST: Final = 12
"""Coefficients from which on a polynomial is split."""
HEAD: Final = 4
PARTS: Final = 4


def split(function: Function) -> Function:
    """The function with its long polynomials split; those that are loops, and short ones, stay as they are."""
    body: list[Statement] = []
    for statement in function.body:
        splits = isinstance(statement, Horner) and not statement.loops and len(statement.coefficients) >= SHORTEST
        body += _split(statement) if splits and isinstance(statement, Horner) else [statement]
    return replace(function, body=tuple(body))


def _split(horner: Horner) -> list[Statement]:
    number = next(c for c in horner.coefficients if c is not None)
    steps, name, x = Steps(number.real), horner.name, horner.at
    _, value = split_tail(steps, name, x, horner.coefficients[HEAD:])
    for coefficient in reversed(horner.coefficients[:HEAD]):
        if coefficient is None:
            value = steps.multiply(name, value, x)
        else:
            value = steps.assign(name, Operation.MULTIPLY_ADD, value, x, coefficient)
    return steps.taken


def split_tail(steps: Steps, name: str, x: str, tail: tuple[Number | None, ...]) -> tuple[str, Operand]:
    """T of the coefficients given; the names of x^2 and of T."""
    square = steps.multiply(f"{name}_square", x, x)
    fourth = steps.multiply(f"{name}_fourth", square, square)
    parts = [_part(steps, f"{name}_part{r}", fourth, tail[r::PARTS]) for r in range(PARTS)]
    low = _joined(steps, f"{name}_low", parts[0], x, parts[1])
    high = _joined(steps, f"{name}_high", parts[2], x, parts[3])
    return square, _joined(steps, name, low, square, high)


def _part(steps: Steps, name: str, at: str, coefficients: tuple[Number | None, ...]) -> Operand:
    """A polynomial in x^4; 0 when it has no coefficient."""
    while coefficients and coefficients[-1] is None:
        coefficients = coefficients[:-1]
    if len(coefficients) < 2:
        return coefficients[0] if coefficients and coefficients[0] is not None else steps.number(0)
    steps.taken.append(Horner(name, at, coefficients))
    return name


def _joined(steps: Steps, name: str, first: Operand, at: str, second: Operand) -> Operand:
    """first + at*second."""
    return first if second == steps.number(0) else steps.assign(name, Operation.MULTIPLY_ADD, at, second, first)
