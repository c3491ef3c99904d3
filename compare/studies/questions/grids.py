"""Finished backbone cells, one grid of orders and amplitudes for each oscillator and method."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import groupby

import numpy as np

from ridgeback.compare.studies.measures.backbone import BackboneTask
from ridgeback.compare.studies.systems import System
from ridgeback.compare.studies.tasks import Column, Finished
from ridgeback.numeric.arrays import Array

ERROR = 3
UNCERTAINTY = 2
"""Places of the relative error and of the reference's uncertainty among the values of a cell."""
SHOWN_STROKES = 12
POINTS = 400
"""Points of a curve in a figure, about."""
WHO = (
    Column("oscillator", "", "name of the oscillator"),
    Column("parameters", "", "its parameters"),
    Column("method", "", "how the frequency is computed"),
)


@dataclass(frozen=True)
class Grid:
    """Errors of one method on one oscillator; NaN where a cell has a reason and no value."""

    system: System
    method: str
    orders: tuple[int, ...]
    amplitudes: Array
    error: Array
    """Signed relative error, ``[order, amplitude]``."""
    uncertainty: Array
    """Of the reference, relative, ``[amplitude]``."""
    failed: int

    def who(self) -> dict[str, str]:
        """The first columns of a row about it."""
        return {"oscillator": self.system.name, "parameters": backbone_text(self.system), "method": self.method}


def grids(blocks: Iterable[Finished]) -> Iterator[Grid]:
    """Put the blocks of each oscillator and method together; amplitudes rise."""
    for _, group in groupby(blocks, key=lambda block: (task_of(block).system, task_of(block).method)):
        yield joined([_grid(block) for block in group])


def titles(found: Sequence[Grid]) -> list[str]:
    """What each is called among these: its oscillator, with parameters where two share it, methods where they differ.

    >>> one, two = (System("duffing", "duffing", parameters=(("eps", text),)) for text in ("1", "2"))
    >>> none = np.zeros((0, 0))
    >>> titles([Grid(system, "lindstedt", (), none, none, none, 0) for system in (one, two)])
    ['Duffing oscillator, hardening (mu = 0, k = 1, eps = 1)', 'Duffing oscillator, hardening (mu = 0, k = 1, eps = 2)']
    """
    several = len({grid.method for grid in found}) > 1
    names = called([grid.system for grid in found])
    return [names[grid.system] + (f", {grid.method}" if several else "") for grid in found]


def called(systems: Iterable[System]) -> dict[System, str]:
    """What each oscillator is called among these, with its parameters where two share a title."""
    each = list(dict.fromkeys(systems))
    shared = [system.title for system in each]
    return {
        system: f"{system.title} ({backbone_text(system)})" if shared.count(system.title) > 1 else system.title
        for system in each
    }


def axis_of(systems: Iterable[System]) -> str:
    """What the errors of some oscillators are drawn over: the amplitude, or eps for limit cycles.

    >>> axis_of([System("pendulum", "pendulum"), System("van-der-pol", "van-der-pol")])
    'amplitude or ε'
    """
    names = ("ε" if system.oscillator().kind == "limit-cycle" else "amplitude" for system in systems)
    return " or ".join(dict.fromkeys(names)) or "amplitude"


def joined(parts: Sequence[Grid]) -> Grid:
    """Grids of one oscillator and method side by side."""
    return replace(
        parts[0],
        amplitudes=np.concatenate([part.amplitudes for part in parts]),
        error=np.concatenate([part.error for part in parts], axis=1),
        uncertainty=np.concatenate([part.uncertainty for part in parts]),
        failed=sum(part.failed for part in parts),
    )


def task_of(block: Finished) -> BackboneTask:
    """The task of a block, which is of the backbone."""
    task = block.task
    if not isinstance(task, BackboneTask):
        raise TypeError(f"{type(task).__name__} is no task of the backbone")
    return task


def _grid(block: Finished) -> Grid:
    task = task_of(block)
    nothing = (np.nan,) * (ERROR + 1)
    values = [outcome if isinstance(outcome, tuple) else nothing for outcome in block.outcomes]
    table = np.array([(v[ERROR], v[UNCERTAINTY]) for v in values], dtype=float).reshape(-1, len(task.orders), 2)
    known = np.where(np.isfinite(table[..., 1]), table[..., 1], -1.0).max(axis=1)
    return Grid(
        system=task.system,
        method=task.method,
        orders=task.orders,
        amplitudes=np.array(task.amplitudes),
        error=table[..., 0].T,
        uncertainty=np.where(known < 0, np.nan, known),
        failed=block.failures,
    )


def parameters_text(system: System) -> str:
    """The parameters of an oscillator in a cell.

    >>> parameters_text(System("pendulum", "pendulum", parameters=(("mu", "1/100"),)))
    'mu = 0.01, k = 1'
    """
    return ", ".join(f"{name} = {value:.6g}" for name, value in system.numbers().items())


def backbone_text(system: System) -> str:
    """The same beside amplitudes: the small parameter of a limit cycle is left out, which these are values of.

    >>> backbone_text(System("van-der-pol", "van-der-pol"))
    'k = 1'
    """
    small = system.oscillator().small
    return ", ".join(f"{name} = {value:.6g}" for name, value in system.numbers().items() if name != small)


def thinned(count: int) -> Array:
    """Indices of at most about POINTS of so many points, the last among them.

    >>> thinned(3).tolist()
    [0, 1, 2]
    """
    return np.unique(np.linspace(0, count - 1, min(count, POINTS)).round().astype(int))
