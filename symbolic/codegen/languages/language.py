"""What a target language is: one object that writes a form, and packages it with a check that can be run.

A language is one file.  Another distribution adds its own by an entry point of the group ``ridgeback.languages`` that
names such an object.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from textwrap import wrap
from typing import ClassVar

from flint import fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen.comments import comment_text
from ridgeback.symbolic.codegen.lowering import lowered_step
from ridgeback.symbolic.codegen.number import FLOAT32, Number
from ridgeback.symbolic.codegen.program import (
    MODES,
    Domain,
    Form,
    Function,
    Horner,
    Operand,
    Operation,
    Statement,
    Step,
)

WIDTH = 100
EXACT = {
    "strict": "No product is fused with a sum",
    "fma": "Every a*b + c of a polynomial is one rounding (a fused multiply-add)",
    "accurate": "The last steps carry their rounding errors along",
}


class Language(ABC):
    """A target language."""

    name: ClassVar[str]
    """As on the command line."""
    suffix: ClassVar[str]
    """Of the source file."""
    comment: ClassVar[str] = "//"
    """Starts a comment that ends with the line."""
    end: ClassVar[str] = ";"
    reals: ClassVar[tuple[str, ...]] = ("float64",)
    modes: ClassVar[tuple[str, ...]] = MODES
    tool: ClassVar[tuple[str, ...]] = ()
    """Programs any of which runs the check; none where there is nothing to run."""

    def accept(self, form: Form) -> None:
        """Raise InputError for a format of numbers or a mode that the language does not have."""
        if form.real.name not in self.reals:
            raise InputError(f"{self.name} code is written in {' or '.join(self.reals)}, not in {form.real.name}")
        if form.mode not in self.modes:
            raise InputError(f"{self.name} has no {form.mode} mode; use {' or '.join(self.modes)}")

    @abstractmethod
    def write(self, form: Form) -> str:
        """The source, in one file."""

    @abstractmethod
    def package(self, form: Form) -> dict[str, str]:
        """The files of a small package by their paths: the source, how it is built, and its check."""

    def commands(self, form: Form, tool: str) -> tuple[tuple[str, ...], ...]:  # noqa: ARG002
        """What checks the package, run in its folder with one of the tools; the last prints the failures."""
        return ()

    # --- operations ---

    @abstractmethod
    def literal(self, value: float, form: Form) -> str:
        """A number that reads back as the same number; it may begin with a minus."""

    def operand(self, operand: Operand, form: Form) -> str:
        """A name or a literal."""
        return self.literal(operand.nearest, form) if isinstance(operand, Number) else operand

    def second(self, operand: Operand, form: Form) -> str:
        """The same behind an operator, where a minus needs brackets."""
        text = self.operand(operand, form)
        return f"({text})" if text.startswith("-") else text

    def expression(self, step: Step, form: Form) -> str:
        """The right-hand side of one operation."""
        a = self.operand(step.operands[0], form)
        match step.operation:
            case Operation.ADD:
                return self.plus(a, step.operands[1], form)
            case Operation.SUBTRACT:
                return f"{a} - {self.second(step.operands[1], form)}"
            case Operation.MULTIPLY:
                return f"{a}{self.times}{self.second(step.operands[1], form)}"
            case Operation.DIVIDE:
                return f"{a}{self.over}{self.second(step.operands[1], form)}"
            case Operation.MULTIPLY_ADD if form.fused:
                b, c = (self.operand(o, form) for o in step.operands[1:])
                return self.fused(a, b, c, form)
            case Operation.MULTIPLY_ADD:
                return self.plus(f"{a}{self.times}{self.second(step.operands[1], form)}", step.operands[2], form)
            case Operation.SQUARE_ROOT:
                return self.root(a, form)
            case Operation.ABSOLUTE:
                return self.absolute(a, form)
        return self.floor(a, form)

    times: ClassVar[str] = "*"
    over: ClassVar[str] = "/"

    def plus(self, left: str, right: Operand, form: Form) -> str:
        """A sum; a negative number is subtracted, which is the same."""
        text = self.operand(right, form)
        return f"{left} - {text[1:]}" if text.startswith("-") else f"{left} + {text}"

    def fused(self, a: str, b: str, c: str, form: Form) -> str:  # noqa: ARG002
        """a*b + c in one rounding."""
        return f"fma({a}, {b}, {c})"

    def root(self, a: str, form: Form) -> str:  # noqa: ARG002
        """The square root."""
        return f"sqrt({a})"

    def absolute(self, a: str, form: Form) -> str:  # noqa: ARG002
        """The size without the sign."""
        return f"abs({a})"

    def floor(self, a: str, form: Form) -> str:  # noqa: ARG002
        """The next lower whole number."""
        return f"floor({a})"

    # --- statements ---

    @abstractmethod
    def assign(self, name: str, value: str, *, first: bool, form: Form) -> str:
        """An assignment; ``first`` where the name has had no value before."""

    @abstractmethod
    def loop(self, horner: Horner, table: str, *, first: bool, form: Form) -> list[str]:
        """Horner's rule as a loop over a table of falling coefficients."""

    def body(self, function: Function, form: Form) -> Iterator[str]:
        """The statements of a function, each exact number in a comment behind it or above it."""
        known: set[str] = set()
        for statement in function.body:
            if isinstance(statement, Horner) and statement.loops:
                yield from self.loop(
                    statement, table_name(function, statement), first=statement.name not in known, form=form
                )
                known.add(statement.name)
            else:
                yield from self._flat(statement, known, form)

    def _flat(self, statement: Statement, known: set[str], form: Form) -> Iterator[str]:
        for whole in statement.steps() if isinstance(statement, Horner) else (statement,):
            for step in lowered_step(whole, form.real, fused=form.fused):
                line = self.assign(step.name, self.expression(step, form), first=step.name not in known, form=form)
                known.add(step.name)
                yield from self.noted(line, [o for o in step.operands if isinstance(o, Number)])

    def noted(self, line: str, numbers: list[Number]) -> Iterator[str]:
        """A line with its exact numbers in a comment: behind it, or above it where they are long."""
        texts = [exact_text(n) for n in numbers if needs_note(n)]
        if not texts:
            yield line
        elif len(line) + len(joined := ", ".join(texts)) <= WIDTH:
            yield f"{line}  {self.remark(joined)}"
        else:
            yield from (self.remark(part) for text in texts for part in pieces(text))
            yield line

    def remark(self, text: str) -> str:
        """A comment on a line of its own, or at the end of one."""
        return f"{self.comment} {text}"

    def tables(self, function: Function) -> Iterator[tuple[str, Horner]]:
        """The polynomials that are loops, by the names of their tables."""
        for statement in function.body:
            if isinstance(statement, Horner) and statement.loops:
                yield table_name(function, statement), statement

    def rows(self, horner: Horner, form: Form, *, separator: str = ",") -> Iterator[str]:
        """The falling coefficients, one a line, with the exact numbers."""
        above = [*reversed(horner.coefficients)]
        for i, coefficient in enumerate(above):
            text = self.literal(coefficient.nearest if coefficient else 0.0, form)
            line = f"{text}{separator}" if i < len(above) - 1 else text
            yield from self.noted(line, [coefficient] if coefficient else [])

    def unread(self, function: Function) -> list[str]:
        """Arguments that a function of low order does not read; some compilers would warn of them."""
        read = function.read()
        return [a.name for a in function.arguments if a.name not in read]

    # --- comments ---

    def heading(self, form: Form) -> list[str]:
        """What the numbers mean, how they were rounded, and where they come from."""
        kind = "double" if form.real is not FLOAT32 else "single-precision number"
        lines = [
            f"{form.title}.",
            "",
            *form.facts,
            *domain_facts(form),
            "",
            f"Each constant is the {kind} nearest to the exact number beside it.  {EXACT[form.mode]}.",
            f"Generated by Ridgeback {form.version} from input {form.digest}.",
        ]
        return [part for line in lines for part in (wrap(comment_text(line), WIDTH) or [""])]

    def about(self, function: Function) -> list[str]:
        """The summary, the arguments, and what is proved, in lines."""
        lines = [function.summary, *(f"{a.name}: {a.meaning}" for a in function.arguments), *function.notes]
        return [part for line in lines for part in wrap(comment_text(line), WIDTH)]


def table_name(function: Function, horner: Horner) -> str:
    """The name of the table of a polynomial that is a loop."""
    return f"table_{function.name}_{horner.name}"


def pieces(text: str) -> list[str]:
    """A long number in lines.

    >>> pieces("1" * 101)[1]
    '1'
    """
    return [text[i : i + WIDTH] for i in range(0, len(text), WIDTH)]


def needs_note(number: Number) -> bool:
    """Whether the exact number stands in a comment: not when it is a small whole number."""
    return len(number.text) > 4 or not number.text.lstrip("-").isdigit()


def exact_text(number: Number) -> str:
    """An exact number for a comment; the digits and the stroke of a rational are harmless in every language.

    >>> from flint import fmpq
    >>> from sympy import sqrt
    >>> exact_text(Number(fmpq(-1, 16))), exact_text(Number(2 * sqrt(2)))
    ('-1/16', '2 sqrt(2)')
    """
    return number.text if isinstance(number.exact, fmpq) else comment_text(number.text)


def domain_facts(form: Form) -> list[str]:
    """Where the functions are defined, each domain once."""
    found = []
    for domain in dict.fromkeys(f.domain for f in form.functions):
        if not domain.known:
            found.append(f"Domain: every finite {domain.argument}{lowest(domain)}; elsewhere not a number.")
        elif domain.low == -domain.high:
            found.append(f"Domain: |{domain.argument}| <= {domain.high!r}; elsewhere the result is not a number.")
        else:
            found.append(f"Domain: {domain.low!r} <= {domain.argument} <= {domain.high!r}; elsewhere not a number.")
    return found


def lowest(domain: Domain) -> str:
    """Where a domain begins that does not hold all finite numbers.

    >>> lowest(Domain("A", 0.0, 3.0))
    ' from 0.0 on'
    """
    return "" if domain.low < 0 else f" from {domain.low!r} on"
