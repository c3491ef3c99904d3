"""What changed between two stores: settings, cells that only one has, and cells whose values differ."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from ridgeback.common.errors import InputError
from ridgeback.compare.studies.measures.by_name import measure_of
from ridgeback.compare.studies.plan import differences
from ridgeback.compare.studies.running import finished, tasks_of
from ridgeback.compare.studies.store import Store
from ridgeback.compare.studies.tasks import Outcome, Scalar, Task, key_of

SHOWN = 40
"""Changed cells that are kept, those with the largest changes."""


@dataclass(frozen=True)
class Change:
    """A cell whose value is another in the second store."""

    cell: str
    column: str
    before: Scalar
    after: Scalar
    relative: float
    """|after - before| / max(|after|, |before|); infinite where one of them is no finite number."""


@dataclass(frozen=True)
class Comparison:
    """Two stores held against each other.

    Parameters
    ----------
    settings : tuple of str
        Settings that differ, a line each.
    equal, changed : int
        Cells of both with the same values to the last digit, and with others.
    only_first, only_second : int
        Cells that one of them has.
    changes : tuple of Change
        The largest changes.
    """

    settings: tuple[str, ...]
    equal: int
    changed: int
    only_first: int
    only_second: int
    changes: tuple[Change, ...]

    def to_dict(self) -> dict[str, Any]:
        """The comparison as JSON knows it."""
        return {**vars(self), "changes": [vars(change) for change in self.changes]}


def compared(first: Store, second: Store, *, warned: Callable[[str], None]) -> Comparison:
    """Hold two stores against each other, cell by cell.

    Parameters
    ----------
    first, second : Store
        Finished stores whose studies ask for the same kind of cell.
    warned : callable
        Told of blocks that are missing or damaged; they are computed.

    Returns
    -------
    Comparison
        What differs.

    Raises
    ------
    InputError
        Where the two hold different kinds of cells.
    """
    measures = [measure_of(store.plan().ask) for store in (first, second)]
    if measures[0].name != measures[1].name:
        raise InputError(
            f"the stores hold {measures[0].name} and {measures[1].name} cells, which have no cell in common"
        )
    settings = differences(*(json.loads(store.about()["plan"]) for store in (first, second)))
    programs = [store.about()["program"] for store in (first, second)]
    if programs[0] != programs[1]:
        settings.append(f"program was {programs[0]}, is {programs[1]}")
    shared = _keys(first) & _keys(second)
    others = dict(_cells(second, lambda key: key not in shared, warned))
    names = [column.name for column in measures[0].values]
    changes: list[Change] = []
    equal = changed = only_first = 0
    for (cell, before), after in _pairs(first, second, shared, others, warned):
        if after is None:
            only_first += 1
        elif before == after:
            equal += 1
        else:
            changed += 1
            changes = sorted([*changes, *_changes(cell, before, after, names)], key=lambda c: -c.relative)[:SHOWN]
    return Comparison(tuple(settings), equal, changed, only_first, len(others), tuple(changes))


Cell = tuple[str, Outcome]


def _keys(store: Store) -> set[str]:
    return {key_of(task) for task in tasks_of(store.plan())}


def _cells(store: Store, wanted: Callable[[str], bool], warned: Callable[[str], None]) -> Iterator[Cell]:
    for block in finished(store.plan(), store, warned=warned):
        if wanted(key_of(block.task)):
            yield from ((named(block.task, at), outcome) for at, outcome in block.rows())


def _pairs(
    first: Store, second: Store, shared: set[str], others: dict[str, Outcome], warned: Callable[[str], None]
) -> Iterator[tuple[Cell, Outcome | None]]:
    """Each cell of the first with its twin; what is left in ``others`` has none."""
    for block in finished(first.plan(), first, warned=warned):
        twin = second.read(block.task) if key_of(block.task) in shared else None
        for i, (at, outcome) in enumerate(block.rows()):
            cell = named(block.task, at)
            yield (cell, outcome), (others.pop(cell, None) if twin is None else twin[i])


def named(task: Task, at: tuple[Scalar, ...]) -> str:
    """A cell in words: its oscillator, its parameters, where it stands."""
    numbers: Mapping[str, float] = task.system.numbers()
    parameters = ", ".join(f"{name} = {value!r}" for name, value in numbers.items())
    return f"{task.system.name} ({parameters}), {', '.join(str(value) for value in at)}"


def _changes(cell: str, before: Outcome, after: Outcome, names: list[str]) -> Iterator[Change]:
    if isinstance(before, str) or isinstance(after, str):
        texts = [value if isinstance(value, str) else "values" for value in (before, after)]
        yield Change(cell, "reason", texts[0], texts[1], math.inf)
        return
    for name, old, new in zip(names, before, after, strict=True):
        if old != new:
            yield Change(cell, name, old, new, _relative(old, new))


def _relative(old: Scalar, new: Scalar) -> float:
    if not (
        isinstance(old, int | float) and isinstance(new, int | float) and math.isfinite(old) and math.isfinite(new)
    ):
        return math.inf
    size = max(abs(old), abs(new))
    return abs(new - old) / size if size else 0.0
