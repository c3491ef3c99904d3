"""A block of cells as a piece of work: what it is about, its cells, their outcomes, and the text it is stored under."""

from __future__ import annotations

import dataclasses
import hashlib
import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Protocol, TypeAlias

from ridgeback.common.errors import InputError
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.systems import System

Scalar: TypeAlias = "str | int | float | None"
Coordinates: TypeAlias = tuple[Scalar, ...]
"""Where a cell stands: one value for each coordinate of its measure."""
Outcome: TypeAlias = "tuple[Scalar, ...] | str"
"""The values of a cell, or the reason why it has none."""


@dataclass(frozen=True)
class Column:
    """One column of a tidy table: its unit ("1" for a pure number, "" for a word) and what it holds."""

    name: str
    unit: str
    meaning: str

    @property
    def kind(self) -> str:
        """``text`` or ``number``; what counts is a number, too."""
        return "number" if self.unit else "text"


class Task(Protocol):
    """One block of cells: a frozen dataclass of text and numbers, cheap to send anywhere."""

    MEASURE: ClassVar[str]

    @property
    def system(self) -> System:
        """The oscillator of all cells."""
        ...

    def cells(self) -> Sequence[Coordinates]:
        """The cells, without computing them."""
        ...

    def compute(self) -> Sequence[Outcome]:
        """The outcome of each cell; raises InputError where all have the same reason for none."""
        ...


@dataclass(frozen=True)
class Measure:
    """A kind of cell.

    Parameters
    ----------
    name : str
        What it is called.
    coordinates, values : tuple of Column
        Where a cell stands, and what it holds; the oscillator and its parameters come before, the reason behind.
    methods : tuple of str
        The methods that it knows, those of ``defaults`` when none is named.
    defaults : tuple of str
        The methods that are taken when none is named.
    tasks : callable
        A plan to its blocks, always in the same order.
    """

    name: str
    coordinates: tuple[Column, ...]
    values: tuple[Column, ...]
    methods: tuple[str, ...]
    defaults: tuple[str, ...]
    tasks: Callable[[Plan], Iterator[Task]]


@dataclass(frozen=True)
class Finished:
    """A block with its outcomes."""

    task: Task
    outcomes: tuple[Outcome, ...]

    def rows(self) -> Iterator[tuple[Coordinates, Outcome]]:
        """Each cell with its outcome."""
        return zip(self.task.cells(), self.outcomes, strict=True)

    @property
    def failures(self) -> int:
        """Cells that have a reason and no values."""
        return sum(isinstance(outcome, str) for outcome in self.outcomes)


def inputs_of(task: Task) -> str:
    """All that the cells of a task depend on, as one line of JSON."""
    return json.dumps({"measure": task.MEASURE, **dataclasses.asdict(task)}, sort_keys=True)  # type: ignore[call-overload]


def key_of(task: Task) -> str:
    """The name of a block: a digest of its inputs."""
    return hashlib.sha256(inputs_of(task).encode()).hexdigest()


def run(task: Task) -> tuple[Outcome, ...]:
    """The outcomes of a block; what goes wrong in it is the reason of its cells and stops no other block.

    Errors of the environment (files, memory) pass through: with them the block is not done.
    """
    try:
        return tuple(task.compute())
    except InputError as error:
        reason = str(error)
    except (OSError, MemoryError):
        raise
    except Exception as error:  # a fault in one block of thousands is reported with its cells, and the others go on
        reason = f"unexpected {type(error).__name__}: {error}"
    return (reason,) * len(task.cells())


def outcomes_text(outcomes: Sequence[Outcome]) -> str:
    """Outcomes as one line of JSON: a list of values, or the reason; NaN and infinities have their names."""
    return json.dumps([list(o) if isinstance(o, tuple) else o for o in outcomes], separators=(",", ":"))


def outcomes_from(text: str) -> tuple[Outcome, ...]:
    """Outcomes from their text.

    >>> outcomes_from(outcomes_text([(0.1, None), "too few cycles"]))
    ((0.1, None), 'too few cycles')
    """
    found: list[Any] = json.loads(text)
    return tuple(tuple(o) if isinstance(o, list) else str(o) for o in found)
