"""``error-budget``: what the error of each prediction along a motion is made of."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from typing import Any

from ridgeback.common.numbers import relative
from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.compare.studies.answer import Answer
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.questions.motions import FLOOR, METHOD, WHERE, Pooled, of_motions
from ridgeback.compare.studies.tasks import Column, Finished

COLUMNS = (
    *WHERE[:4],
    *METHOD,
    Column("rms", "1", "root mean square of the whole relative error over the interior"),
    Column("truncation", "1", "that against the exact frequency at the method's own amplitude"),
    Column("averaging", "1", "that of this exact frequency itself"),
    Column("closure", "1", "what the two leave of the whole: their product"),
    FLOOR,
)


def answer(plan: Plan, blocks: Iterable[Finished]) -> Answer:
    """Truncation, averaging and what the motion leaves open, of each prediction.

    Parameters
    ----------
    plan : Plan
        The study.
    blocks : iterable of Finished
        Cells along motions.

    Returns
    -------
    Answer
        A row for each case, prediction and order; the figure has the parts over the order of the first method.
    """
    title = "what the error of each prediction is made of"
    figure = partial(drawing, title=plan.title)
    return of_motions("error-budget", title, COLUMNS, blocks, sentences, figure, lambda row: row.truncation is not None)


def sentences(rows: Sequence[Pooled]) -> Iterator[str]:
    """Of each method its best order, and which part rules there."""
    groups: dict[Any, list[Pooled]] = {}
    for row in rows:
        if row.truncation is not None:
            groups.setdefault(alike(row), []).append(row)
    for mine in groups.values():
        best = min(mine, key=lambda row: row.rms or 0.0)
        order = "" if best.order is None else f" of order {best.order}"
        truncated, averaged = best.truncation or 0.0, best.averaging or 0.0
        ruling = "truncation" if truncated > averaged else "averaging"
        yield (
            f"{best.system.name} from {best.amplitude:.6g}: {best.method}{order} errs {relative(best.rms)}, "
            f"truncation {relative(truncated)}, averaging {relative(averaged)}; {ruling} rules"
        )


def alike(row: Pooled) -> tuple[Any, ...]:
    """Case and method."""
    return row.system, row.amplitude, row.duration, row.method


def drawing(rows: Sequence[Pooled], title: str) -> Picture:
    """The parts over the order, of the first method that has orders."""
    parts = [row for row in rows if row.truncation is not None]
    first = next((row for row in parts if row.order is not None), None)
    mine = [] if first is None else [row for row in parts if alike(row) == alike(first)]
    orders = [row.order or 0 for row in mine]
    strokes = tuple(
        Stroke(orders, [getattr(row, part) or float("nan") for row in mine], part)
        for part in ("rms", "truncation", "averaging", "floor")
    )
    name = title if first is None else f"{first.system.name}, {first.method}"
    return Picture(name, "order", "relative error", strokes if mine else (), None, True)
