r"""Horner's rule whose first two terms are computed without rounding.

    c_0 + c_1 x + c_2 x^2 + ... = H + L,     H = C_0 + C_1 X,
    L = C_1 (x - X) + (c_0 - C_0) + x ((c_1 - C_1) + c_2 x + ...)

X, C_0 and C_1 are x, c_0 and c_1 rounded to multiples of powers of two that are chosen so that C_1 X and H are whole
multiples of one unit, and few enough of it to be numbers of the format: H is then exact, and what is left are the
roundings of L, which is small where the polynomial is dominated by its first terms, and of the last sum (fixed-point
splitting, as in argument reduction: W. J. Cody and W. Waite, Software Manual for the Elementary Functions, 1980).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction

from flint import fmpq

from ridgeback.symbolic.codegen.modes.splitting import SHORTEST, split_tail
from ridgeback.symbolic.codegen.number import Number, Real, fraction, magnitude
from ridgeback.symbolic.codegen.program import (
    Form,
    Function,
    Horner,
    Operation,
    Statement,
    Step,
    Steps,
    needed,
)


def leading(form: Form, function: Function) -> Iterator[Function]:
    """The function with its first terms exact: x rounded as before and, where x is a square, x exact as well.

    Nothing where the function is not Horner's rule in one variable with rational coefficients and a domain, times k.

    >>> from ridgeback.symbolic.codegen import form_of
    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> form = form_of(lindstedt(find("duffing"), 4))          # no domain
    >>> list(leading(form, form.functions[0]))
    []
    """
    place = next((i for i, statement in enumerate(function.body) if isinstance(statement, Horner)), None)
    if place is None or not function.domain.known or function.polynomial is None:
        return
    horner, before, after = function.body[place], function.body[:place], function.body[place + 1 :]
    assert isinstance(horner, Horner)  # noqa: S101 - it was found as one
    first = horner.coefficients[:2]
    exact = [c.exact for c in first if c is not None and isinstance(c.exact, fmpq)]
    at, end = function.domain.argument, Fraction(max(-function.domain.low, function.domain.high))
    if len(exact) != 2 or not all(exact) or not end or not _plain(after, horner.name, at):
        return
    if not before and horner.at == at:
        yield _made(form, function, horner, (), after, _Grids.of(exact, end, form.real), square=False)
    elif before == (Step(horner.at, Operation.MULTIPLY, (at, at)),):
        grids = _Grids.of(exact, end * end, form.real)
        if not form.fused:
            yield _made(form, function, horner, before, after, grids, square=False)
        yield _made(form, function, horner, before, after, grids, square=True)


def _plain(after: tuple[Statement, ...], name: str, at: str) -> bool:
    """Whether what follows are products with factors other than the variable, which leave a power of two exact."""
    return all(
        isinstance(s, Step) and s.operation is Operation.MULTIPLY and s.operands[1] == name and at not in s.operands
        for s in after
    )


class _Grids:
    """Units of X, C_1 and C_0: with these, |C_0|, |C_1 X| and |H| are at most 2^digits units of their products."""

    def __init__(self, x: int, slope: int, constant: int) -> None:
        self.x, self.slope, self.constant = x, slope, constant

    @classmethod
    def of(cls, exact: list[fmpq], end: Fraction, real: Real) -> _Grids:
        """Exponents of two, x up to ``end`` in size; what is cut off c_1 and x has about the same effect."""
        c0, c1 = (abs(fraction(c)) for c in exact)
        unit = magnitude(c0 + c1 * end) + 1 - real.digits
        x = max((unit + magnitude(end) - magnitude(c1)) // 2, magnitude(end) + 4 - real.digits)
        x += x % 2
        return cls(x, unit - x, unit)


def _made(
    form: Form,
    function: Function,
    horner: Horner,
    before: tuple[Statement, ...],
    after: tuple[Statement, ...],
    grids: _Grids,
    *,
    square: bool,
) -> Function:
    steps, name, x = Steps(form.real), horner.name, horner.at
    steps.taken += before
    high, low = f"{x}_high", f"{x}_low"
    if square:
        argument = function.domain.argument
        grid = grids.x if form.fused else grids.x // 2
        operands = (argument, x, splitter(grid, form.real))
        steps.assign(high, Operation.SPLIT_SQUARE, *operands, rest=low)
    else:
        steps.assign(high, Operation.SPLIT, x, splitter(grids.x, form.real), rest=low)
    c0, c1 = (c or steps.number(0) for c in horner.coefficients[:2])
    constant, slope = cut(c0, grids.constant), cut(c1, grids.slope)
    main = steps.assign(f"{name}_main", Operation.MULTIPLY_ADD, high, slope, constant)
    rest = steps.multiply(f"{name}_rest", slope, low)
    if left := difference(c0, constant):
        rest = steps.add(rest, rest, left)
    rest = _tail(steps, horner, difference(c1, slope), rest)
    steps.add(name, main, rest)
    return replace(function, body=needed([*steps.taken, *after], function.result))


def _tail(steps: Steps, horner: Horner, slope: Number | None, rest: str) -> str:
    """rest + slope x + c_2 x^2 + ..."""
    name, x, others = f"{horner.name}_tail", horner.at, horner.coefficients[2:]
    if not any(others):
        return rest if slope is None else steps.assign(rest, Operation.MULTIPLY_ADD, x, slope, rest)
    if len(others) >= SHORTEST and not Horner(name, x, others).loops:
        if slope is not None:
            steps.assign(rest, Operation.MULTIPLY_ADD, x, slope, rest)
        square, tail = split_tail(steps, name, x, others)
        return steps.assign(rest, Operation.MULTIPLY_ADD, square, tail, rest)
    steps.taken.append(Horner(name, x, (slope, *others)))
    return steps.assign(rest, Operation.MULTIPLY_ADD, x, name, rest)


def splitter(grid: int, real: Real) -> Number:
    """1.5 2^(digits - 1) units: added to a smaller number and taken off again it leaves a multiple of the unit 2^grid.

    >>> from ridgeback.symbolic.codegen.number import FLOAT64
    >>> magic = splitter(-10, FLOAT64).nearest
    >>> (0.7003 + magic) - magic, 717 / 1024
    (0.7001953125, 0.7001953125)
    """
    return Number(fmpq(3) * fmpq(2) ** (grid + real.digits - 2), real)


def cut(c: Number, grid: int) -> Number:
    """The multiple of 2^grid next to an exact rational.

    >>> str(cut(Number(fmpq(1, 3)), -4))
    '5/16'
    """
    assert isinstance(c.exact, fmpq)  # noqa: S101 - asked for rationals only
    unit = Fraction(2) ** grid
    value = round(fraction(c.exact) / unit) * unit
    return Number(fmpq(value.numerator, value.denominator), c.real)


def difference(c: Number, part: Number) -> Number | None:
    """What is cut off, None where that is nothing."""
    left = c.exact - part.exact
    return Number(left, c.real) if left != 0 else None
