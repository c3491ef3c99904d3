"""``order-needed``: the smallest order whose error stays within a tolerance up to an amplitude.

A tolerance that holds at one amplitude by a change of sign of the error counts only if it holds at every smaller
studied amplitude, too.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import groupby
from typing import Any

import numpy as np

from ridgeback.common.numbers import number, threshold
from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.compare.studies.answer import Answer
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.questions.grids import SHOWN_STROKES, WHO, Grid, axis_of, grids, thinned, titles
from ridgeback.compare.studies.systems import System
from ridgeback.compare.studies.tasks import Column, Finished
from ridgeback.numeric.arrays import Array

COLUMNS = (
    *WHO,
    Column("tolerance", "1", "relative error that must hold"),
    Column("order", "1", "smallest studied order; empty where none serves"),
    Column("amplitude_from", "unit of the unknown", "first studied amplitude that needs it"),
    Column("amplitude_to", "unit of the unknown", "last studied amplitude up to which it holds"),
)


def answer(plan: Plan, blocks: Iterable[Finished]) -> Answer:
    """The smallest order for each amplitude and tolerance.

    Parameters
    ----------
    plan : Plan
        The study, with its tolerances.
    blocks : iterable of Finished
        Backbone cells.

    Returns
    -------
    Answer
        A row for each oscillator, method, tolerance and stretch of amplitudes that needs one order.
    """
    rows: list[dict[str, Any]] = []
    strokes: list[Stroke] = []
    panels: list[Picture] = []
    said: list[str] = []
    systems: list[System] = []
    failed = 0
    found = list(grids(blocks))
    for grid, name in zip(found, titles(found), strict=True):
        failed += grid.failed
        systems.append(grid.system)
        own: list[Stroke] = []
        for tolerance in plan.tolerances:
            needed = orders_needed(grid, tolerance)
            rows += rows_of(grid, tolerance, needed)
            said.append(sentence(name, grid, tolerance, needed))
            at = thinned(grid.amplitudes.size)
            orders = [np.nan if needed[i] is None else needed[i] for i in at]
            own.append(Stroke(grid.amplitudes[at], orders, f"within {threshold(tolerance)}", steps=True))
        panels.append(Picture(name, axis_of([grid.system]), "order", tuple(own)))
        strokes += [replace(stroke, label=f"{name}, {stroke.label}") for stroke in own]
    picture = Picture(plan.title or "order needed", axis_of(systems), "order", tuple(strokes[:SHOWN_STROKES]))
    beside = tuple(panels[:SHOWN_STROKES]) if len(panels) > 1 else ()
    title = "smallest order within a tolerance"
    return Answer("order-needed", title, COLUMNS, tuple(rows), tuple(said), picture, failed, panels=beside)


def orders_needed(grid: Grid, tolerance: float) -> list[int | None]:
    """By amplitude, the smallest order that holds there and at every smaller one; the reference's error counts."""
    holds = np.logical_and.accumulate(np.abs(grid.error) + grid.uncertainty <= tolerance, axis=1)
    return [_first(grid.orders, column) for column in holds.T]


def _first(orders: Sequence[int], holds: Array) -> int | None:
    return next((order for order, good in zip(orders, holds, strict=True) if good), None)


def rows_of(grid: Grid, tolerance: float, needed: list[int | None]) -> Iterator[dict[str, Any]]:
    """One row for each stretch of amplitudes that needs one order."""
    for order, pairs in groupby(zip(needed, grid.amplitudes, strict=True), key=lambda pair: pair[0]):
        stretch = [float(amplitude) for _, amplitude in pairs]
        ends = {"amplitude_from": stretch[0], "amplitude_to": stretch[-1]}
        yield {**grid.who(), "tolerance": tolerance, "order": order, **ends}


def sentence(name: str, grid: Grid, tolerance: float, needed: list[int | None]) -> str:
    """How far the studied orders serve."""
    head = f"{name}, within {threshold(tolerance)}"
    served = [i for i, order in enumerate(needed) if order is not None]
    if not served:
        return f"{head}: no studied order serves at {number(float(grid.amplitudes[0]))}"
    last = served[-1]
    return f"{head}: order {needed[last]} is needed at {number(float(grid.amplitudes[last]))}" + (
        "" if last == len(needed) - 1 else "; no studied order serves beyond"
    )
