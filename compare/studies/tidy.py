"""The finished cells of a study as one tidy table: a row for each cell, a column for each thing, with its unit."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ridgeback.compare.studies.measures.by_name import measure_of
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.tasks import Column, Finished, Scalar

OSCILLATOR = Column("oscillator", "", "name of the oscillator")
REASON = Column("reason", "", "why the cell has no values; empty where it has")


def columns_of(plan: Plan) -> tuple[Column, ...]:
    """The columns of a study: the oscillator and its parameters, where the cell stands, what it holds."""
    return (*coordinates_of(plan), *measure_of(plan.ask).values, REASON)


def coordinates_of(plan: Plan) -> tuple[Column, ...]:
    """The columns that say where a cell stands."""
    parameters = (Column(name, "of the equation", f"parameter {name}") for name in plan.parameters)
    return (OSCILLATOR, *parameters, *measure_of(plan.ask).coordinates)


def rows_of(plan: Plan, blocks: Iterable[Finished]) -> Iterator[tuple[Scalar, ...]]:
    """One row for each cell, in the order of the plan.

    Parameters
    ----------
    plan : Plan
        The study.
    blocks : iterable of Finished
        Its blocks, in order.

    Yields
    ------
    tuple
        One value for each of :func:`columns_of`.
    """
    names = plan.parameters
    empty = (None,) * len(measure_of(plan.ask).values)
    for block in blocks:
        numbers = block.task.system.numbers()
        head = (block.task.system.name, *(numbers.get(name) for name in names))
        for coordinates, outcome in block.rows():
            if isinstance(outcome, str):
                yield (*head, *coordinates, *empty, outcome)
            else:
                yield (*head, *coordinates, *outcome, "")
