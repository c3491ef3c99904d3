"""Generated code as data: functions as lists of single operations on named values and exact numbers.

Nothing here is text of any language, and nothing is nested: every language prints the same operations in the same
order, one a line, so that all of them give the same result for the same arguments, bit for bit.  Only +, -, *, /, the
square root and the next lower whole number occur, which IEEE 754 defines to the last bit; with ``fma`` also a*b + c in
one rounding.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from enum import Enum
from fractions import Fraction
from functools import cached_property
from typing import Final, Literal, TypeAlias

from flint import fmpq
from sympy import Expr

from ridgeback.symbolic.codegen.number import FLOAT64, Exact, Number, Real

Operand: TypeAlias = "str | Number"
Mode: TypeAlias = Literal["strict", "fma", "accurate"]
MODES: Final[tuple[Mode, ...]] = ("strict", "fma", "accurate")
LOOP: Final = 128
"""A polynomial of more coefficients is a loop over a table: longer chains of statements are vectorised badly."""


class Operation(Enum):
    """What a step does with its operands."""

    ADD = "+"
    SUBTRACT = "-"
    MULTIPLY = "*"
    DIVIDE = "/"
    SQUARE_ROOT = "sqrt"
    ROOT = "root of a degree that is no power of two"
    """Of a positive number; made of the others, see ``_root``."""
    FLOOR = "floor"
    ABSOLUTE = "abs"
    MULTIPLY_ADD = "a*b + c"
    """One rounding in mode ``fma``, two elsewhere."""
    TWO_SUM = "sum and its rounding error"
    """Both exactly (Knuth; Handbook of Floating-Point Arithmetic, 2nd edition, 2018, algorithm 4.4)."""
    TWO_PRODUCT = "product and its rounding error"
    """Both exactly (Dekker; the same, algorithm 4.10), barring over- and underflow."""
    SPLIT = "nearest multiple of a unit and the rest"
    """Both exactly; the second operand is 1.5 2^(digits - 1) units, four times the first or more."""
    SPLIT_SQUARE = "multiple of a unit near the square, and the rest"
    """The multiple exactly; operands are a, the rounded a*a, and the constant as for ``SPLIT``: of the square in mode
    ``fma``, where the rest is rounded once, else of a, where it is rounded twice."""


@dataclass(frozen=True)
class Step:
    """``name = operation(operands)``; ``rest`` is the rounding error of those that give one."""

    name: str
    operation: Operation
    operands: tuple[Operand, ...]
    rest: str = ""


@dataclass(frozen=True)
class Horner:
    """``name`` = the sum of coefficients[i] at^i, rising, by Horner's rule from the highest; None where there is none.

    There are two coefficients or more, and the last is not None.
    """

    name: str
    at: str
    coefficients: tuple[Number | None, ...]

    @cached_property
    def falling(self) -> tuple[float, ...]:
        """The numbers of the format from the highest power down."""
        return tuple(0.0 if c is None else c.nearest for c in reversed(self.coefficients))

    @property
    def loops(self) -> bool:
        """Whether it is written as a loop over a table."""
        return len(self.coefficients) > LOOP

    def steps(self) -> Iterator[Step]:
        """The same one operation at a time; a missing coefficient costs no addition."""
        above = [*reversed(self.coefficients)]
        value: Operand = above[0] or Number(fmpq(0))
        for coefficient in above[1:]:
            if coefficient is None:
                yield Step(self.name, Operation.MULTIPLY, (value, self.at))
            else:
                yield Step(self.name, Operation.MULTIPLY_ADD, (value, self.at, coefficient))
            value = self.name


Statement: TypeAlias = "Step | Horner"


@dataclass(frozen=True)
class Argument:
    """What a function takes: its name, its meaning, and its default where there is one."""

    name: str
    meaning: str
    default: float | None = None


@dataclass(frozen=True)
class Domain:
    """low <= argument <= high, both numbers of the format; elsewhere the function is not a number."""

    argument: str
    low: float
    high: float
    known: bool = True
    """False when no limit is known, so that only what is not finite is refused."""


Terms: TypeAlias = "dict[tuple[int, ...], Number]"
"""Coefficients by the powers of the variables."""


@dataclass(frozen=True)
class Polynomial:
    """What a function is, when it is a polynomial: for formulas and proofs, not for evaluation."""

    variables: tuple[str, ...]
    terms: Terms
    factor: str = ""
    where: tuple[tuple[str, Expr], ...] = ()
    """Values of the variables and of the factor that are no arguments."""


@dataclass(frozen=True)
class Function:
    """A function of numbers as statements; ``result`` is what it returns."""

    name: str
    summary: str
    arguments: tuple[Argument, ...]
    body: tuple[Statement, ...]
    result: Operand
    domain: Domain
    notes: tuple[str, ...] = ()
    """What is proved about the result."""
    polynomial: Polynomial | None = field(default=None, repr=False)  # the statements hold the same numbers

    bounded: bool = True
    """Whether a domain over which rounding has no bound is refused."""

    def read(self) -> set[str]:
        """Names of all values that are read."""
        found = [o for statement in self.body for o in operands_of(statement)]
        return {o for o in (*found, self.result) if isinstance(o, str)}

    @property
    def compensated(self) -> bool:
        """Whether what rounding loses is carried along: the value is then the sum of two, made by the last addition."""
        return any(isinstance(statement, Step) and statement.rest for statement in self.body)

    def operations(self, form: Form) -> Iterator[Step]:
        """All single operations, as the form has them."""
        return lowered(self.body, form.real, fused=form.fused)


@dataclass(frozen=True)
class Form:
    """All that a writer needs: the functions, and the facts that must travel with them."""

    name: str
    """Identifier in front of, or around, everything that is generated."""
    title: str
    facts: tuple[str, ...]
    functions: tuple[Function, ...]
    mode: Mode = "strict"
    real: Real = FLOAT64
    version: str = field(default="")
    digest: str = field(default="")
    """Of all exact numbers, operations and options that the code was made from."""

    @property
    def fused(self) -> bool:
        """Whether a*b + c is rounded once."""
        return self.mode == "fma"


def lowered(body: Iterable[Statement], real: Real = FLOAT64, *, fused: bool = False) -> Iterator[Step]:
    """Statements as single operations of the languages."""
    for statement in body:
        for step in statement.steps() if isinstance(statement, Horner) else (statement,):
            yield from lowered_step(step, real, fused=fused)


def needed(body: Iterable[Statement], result: Operand) -> tuple[Statement, ...]:
    """The statements that the result depends on, in their order."""
    wanted = {result} if isinstance(result, str) else set()
    kept: list[Statement] = []
    for statement in reversed(tuple(body)):
        rest = statement.rest if isinstance(statement, Step) else ""
        if statement.name not in wanted and rest not in wanted:
            continue
        kept.append(statement)
        wanted -= {statement.name, rest}
        wanted |= {o for o in operands_of(statement) if isinstance(o, str)}
    return tuple(reversed(kept))


def operands_of(statement: Statement) -> tuple[Operand, ...]:
    """What a statement reads."""
    return (statement.at,) if isinstance(statement, Horner) else statement.operands


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


class Steps:
    """Statements as they are collected; a name may be given a value more than once."""

    def __init__(self, real: Real = FLOAT64) -> None:
        self.taken: list[Statement] = []
        self.real = real
        self.known: set[str] = set()
        self.count = 0

    def fresh(self) -> str:
        """A name for a further intermediate result: y1, y2, ..."""
        self.count += 1
        return f"y{self.count}"

    def number(self, value: int | Exact) -> Number:
        """An exact number in the format of the code."""
        return Number(fmpq(value) if isinstance(value, int) else value, self.real)

    def assign(self, name: str, operation: Operation, *operands: Operand, rest: str = "") -> str:
        """Append ``name = operation(operands)`` and return the name."""
        self.taken.append(Step(name, operation, operands, rest))
        self.known |= {name, rest}
        return name

    def add(self, name: str, a: Operand, b: Operand) -> str:
        """``name = a + b``."""
        return self.assign(name, Operation.ADD, a, b)

    def subtract(self, name: str, a: Operand, b: Operand) -> str:
        """``name = a - b``."""
        return self.assign(name, Operation.SUBTRACT, a, b)

    def multiply(self, name: str, a: Operand, b: Operand) -> str:
        """``name = a*b``."""
        return self.assign(name, Operation.MULTIPLY, a, b)

    def divide(self, name: str, a: Operand, b: Operand) -> str:
        """``name = a/b``."""
        return self.assign(name, Operation.DIVIDE, a, b)

    def root(self, name: str, a: Operand) -> str:
        """``name = sqrt(a)``."""
        return self.assign(name, Operation.SQUARE_ROOT, a)

    def once(self, name: str, operation: Operation, *operands: Operand) -> str:
        """The same unless the name has been computed."""
        return name if name in self.known else self.assign(name, operation, *operands)

    def square(self, name: str) -> str:
        """The square of a value, computed on first use."""
        return self.once(f"{name}_squared", Operation.MULTIPLY, name, name)

    def power(self, name: str, n: int) -> str:
        """name^n for n >= 1, by squares and products computed on first use."""
        if n == 1:
            return name
        if n == 2:
            return self.square(name)
        below = self.power(name, n - 1 if n % 2 else n // 2)
        return self.once(f"{name}_{n}", Operation.MULTIPLY, below, name if n % 2 else below)

    def horner(self, name: str, at: str, coefficients: Mapping[int, Operand]) -> Operand:
        """The sum of coefficients[p] at^p by Horner's rule, in at^2 where all powers are even, or all odd."""
        if not coefficients:
            return self.number(0)
        low, high = min(coefficients), max(coefficients)
        stride = 2 if high > 1 and all((p - low) % 2 == 0 for p in coefficients) else 1
        step = self.square(at) if stride == 2 and high > low else at
        value = self._chain(name, step, {(p - low) // stride: c for p, c in coefficients.items()})
        if low == 0:
            return value
        return (
            self.multiply(name, self.power(at, low), value)
            if value != Number(fmpq(1), self.real)
            else self.power(at, low)
        )

    def _chain(self, name: str, at: str, coefficients: Mapping[int, Operand]) -> Operand:
        high = max(coefficients)
        if high == 0:
            return coefficients[0]
        if all(isinstance(c, Number) for c in coefficients.values()):
            table = tuple(coefficients.get(p) for p in range(high + 1))
            self.taken.append(Horner(name, at, table))  # type: ignore[arg-type]
            return name
        value = coefficients[high]
        for p in range(high - 1, -1, -1):
            if (c := coefficients.get(p)) is None:
                value = self.multiply(name, value, at)
            else:
                value = self.assign(name, Operation.MULTIPLY_ADD, value, at, c)
        return value
