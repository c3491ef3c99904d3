"""``work-precision``: what a value costs against how far it errs, and which formulas nothing cheaper is better than."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from ridgeback.common.numbers import relative
from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.compare.studies.answer import Answer
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.questions.grids import SHOWN_STROKES, WHO, backbone_text
from ridgeback.compare.studies.tasks import Column, Finished

COLUMNS = (
    *WHO,
    Column("order", "1", "highest power kept, or number of terms of the paper's series"),
    Column("time_ns_per_value", "ns", "processor time of one value in an array"),
    Column("largest", "1", "largest magnitude of the relative error over the amplitudes"),
    Column("coefficients", "1", "coefficients that are not zero"),
    Column("efficient", "", "whether nothing that costs less errs less"),
)


def answer(plan: Plan, blocks: Iterable[Finished]) -> Answer:
    """Cost against error.

    Parameters
    ----------
    plan : Plan
        The study.
    blocks : iterable of Finished
        Cells of cost.

    Returns
    -------
    Answer
        A row for each oscillator, formula and order; the figure has the error over the time of the first oscillator.
    """
    rows: list[dict[str, Any]] = []
    failed = 0
    for block in blocks:
        failed += block.failures
        who = {"oscillator": block.task.system.name, "parameters": backbone_text(block.task.system)}
        for (method, order), outcome in block.rows():
            if isinstance(outcome, tuple):
                time, largest, _, count = outcome
                value = {"time_ns_per_value": time, "largest": largest, "coefficients": count}
                rows.append({**who, "method": method, "order": order, **value})
    for who_is in dict.fromkeys(named(row) for row in rows):
        mark([row for row in rows if named(row) == who_is])
    title = "cost of a value against its error"
    said = tuple(sentence(row) for row in rows if row["efficient"])
    return Answer("work-precision", title, COLUMNS, tuple(rows), said, drawing(rows, plan.title), failed)


def named(row: dict[str, Any]) -> tuple[str, str]:
    """The oscillator of a row."""
    return row["oscillator"], row["parameters"]


def mark(rows: Sequence[dict[str, Any]]) -> None:
    """Say of each row whether every cheaper one errs more."""
    least = np.inf
    for row in sorted(rows, key=lambda row: (row["time_ns_per_value"], row["largest"])):
        row["efficient"] = bool(row["largest"] < least)
        least = min(least, row["largest"])


def sentence(row: dict[str, Any]) -> str:
    """One efficient formula."""
    order = "" if row["order"] is None else f" of order {row['order']}"
    return (
        f"{row['oscillator']}: {row['method']}{order} errs {relative(row['largest'])} at most for "
        f"{row['time_ns_per_value']:.3g} ns a value; nothing cheaper errs less"
    )


def drawing(rows: Sequence[dict[str, Any]], title: str) -> Picture:
    """Error over the logarithm of the time, a curve for each formula of the first oscillator."""
    first = [row for row in rows if named(row) == named(rows[0])] if rows else []
    strokes = []
    for method in dict.fromkeys(row["method"] for row in first):
        mine = [row for row in first if row["method"] == method and row["largest"] > 0]
        x = [float(np.log10(row["time_ns_per_value"])) for row in mine]
        strokes.append(Stroke(x, [row["largest"] for row in mine], method, dots=len(mine) == 1))
    name = title or "work against precision"
    return Picture(name, "log10 of ns a value", "largest relative error", tuple(strokes[:SHOWN_STROKES]), None, True)
