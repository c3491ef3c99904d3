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
    """Of a positive number; made of the others, see ``lowering``."""
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

    @property
    def carries(self) -> bool:
        """Whether some steps are compensated: more than exact first terms, which keep a rest too."""
        pairs = (Operation.TWO_SUM, Operation.TWO_PRODUCT)
        return any(isinstance(statement, Step) and statement.operation in pairs for statement in self.body)


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
