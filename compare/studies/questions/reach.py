"""``range``: the amplitude up to which each order holds a tolerance."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.compare.studies.answer import Answer
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.questions.grids import SHOWN_STROKES, WHO, backbone_text
from ridgeback.compare.studies.tasks import Column, Finished

COLUMNS = (
    *WHO,
    Column("tolerance", "1", "relative error that must hold"),
    Column("order", "1", "highest power kept"),
    Column("up_to", "unit of the unknown", "amplitude, or value of eps, up to which it holds"),
    Column("throughout", "", "whether it holds at every amplitude looked at, so that up_to is the last of them"),
)


def answer(plan: Plan, blocks: Iterable[Finished]) -> Answer:
    """How far each order may be used.

    Parameters
    ----------
    plan : Plan
        The study, with its tolerances; its amplitudes are where violations are looked for.
    blocks : iterable of Finished
        Cells of the range of use.

    Returns
    -------
    Answer
        A row for each oscillator, method, tolerance and order; the figure has the amplitude over the order.
    """
    rows: list[dict[str, Any]] = []
    failed = 0
    for block in blocks:
        failed += block.failures
        who = {"oscillator": block.task.system.name, "parameters": backbone_text(block.task.system)}
        for (method, order, tolerance), outcome in block.rows():
            if isinstance(outcome, tuple):
                value = {"up_to": outcome[0], "throughout": bool(outcome[1])}
                rows.append({**who, "method": method, "tolerance": tolerance, "order": order, **value})
    rows.sort(key=lambda row: (row["oscillator"], row["parameters"], row["method"], -row["tolerance"]))
    lines = lines_of(rows)
    said = tuple(sentence(name, line) for name, line in lines.items())
    strokes = tuple(
        Stroke([row["order"] for row in line], [row["up_to"] for row in line], name)
        for name, line in list(lines.items())[:SHOWN_STROKES]
    )
    picture = Picture(plan.title or "range of use", "order", "amplitude up to which it holds", strokes)
    return Answer("range", "amplitude up to which an order holds", COLUMNS, tuple(rows), said, picture, failed)


def lines_of(rows: list[dict[str, Any]]) -> dict[str, list[dict[str, Any]]]:
    """Rows by oscillator, method and tolerance."""
    found: dict[str, list[dict[str, Any]]] = {}
    for row in rows:
        name = f"{row['oscillator']} ({row['parameters']}), {row['method']}, {row['tolerance']:.0e}"
        found.setdefault(name, []).append(row)
    return found


def sentence(name: str, rows: list[dict[str, Any]]) -> str:
    """The order that reaches farthest."""
    best = max(rows, key=lambda row: (row["up_to"], -row["order"]))
    end = " and beyond" if best["throughout"] else ""
    return f"{name}: order {best['order']} reaches farthest, to {best['up_to']:.6g}{end}"
