"""``error``: how far each order errs over the amplitudes, largest and root mean square."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np

from ridgeback.common.numbers import number, relative
from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.compare.studies.answer import Answer
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.questions.grids import (
    SHOWN_STROKES,
    WHO,
    Grid,
    axis_of,
    backbone_text,
    grids,
    thinned,
    titles,
)
from ridgeback.compare.studies.tasks import Column, Finished

COLUMNS = (
    *WHO,
    Column("order", "1", "highest power kept"),
    Column("largest", "1", "largest magnitude of the relative error over the amplitudes"),
    Column("at_amplitude", "unit of the unknown", "where it is largest"),
    Column("rms", "1", "root mean square of the relative error over the amplitudes"),
    Column("cells", "1", "amplitudes that have a value"),
)


def answer(plan: Plan, blocks: Iterable[Finished]) -> Answer:
    """Largest and rms error of each order.

    Parameters
    ----------
    plan : Plan
        The study.
    blocks : iterable of Finished
        Backbone cells.

    Returns
    -------
    Answer
        A row for each oscillator, method and order; the figure has the first oscillator and method.
    """
    rows: list[dict[str, Any]] = []
    called: dict[tuple[str, str], str] = {}
    found = list(grids(blocks))
    picture = Picture(plan.title, "amplitude", "relative error of ω₀")
    for grid, name in zip(found, titles(found), strict=True):
        picture = drawing(grid, f"{plan.title}: {name}" if plan.title else name) if not rows else picture
        rows += rows_of(grid)
        called.setdefault((grid.system.name, backbone_text(grid.system)), name.removesuffix(f", {grid.method}"))
    title = "relative error of ω₀ over the amplitudes, by order"
    failed = sum(grid.failed for grid in found)
    return Answer("error", title, COLUMNS, tuple(rows), tuple(sentences(rows, called)), picture, failed)


def rows_of(grid: Grid) -> Iterator[dict[str, Any]]:
    """One row for each order that has a value at all."""
    for order, errors in zip(grid.orders, np.abs(grid.error), strict=True):
        known = np.isfinite(errors)
        if known.any():
            worst = int(np.nanargmax(errors))
            yield {
                **grid.who(),
                "order": order,
                "largest": float(errors[worst]),
                "at_amplitude": float(grid.amplitudes[worst]),
                "rms": float(np.sqrt(np.mean(errors[known] ** 2))),
                "cells": int(known.sum()),
            }


def drawing(grid: Grid, title: str) -> Picture:
    """Error over amplitude, a curve for each order."""
    at = thinned(grid.amplitudes.size)
    errors = np.where(grid.error == 0.0, np.nan, np.abs(grid.error))[:, at]
    pairs = list(zip(grid.orders, errors, strict=True))
    strokes = tuple(Stroke(grid.amplitudes[at], line, f"order {order}") for order, line in pairs[:SHOWN_STROKES])
    return Picture(title, axis_of([grid.system]), "relative error of ω₀", strokes, None, True)


def sentences(rows: list[dict[str, Any]], called: Mapping[tuple[str, str], str]) -> Iterator[str]:
    """The least of the largest errors of each oscillator, among orders with a value at as many amplitudes as any."""
    several = len({row["method"] for row in rows}) > 1
    for who in dict.fromkeys((row["oscillator"], row["parameters"]) for row in rows):
        mine = [row for row in rows if (row["oscillator"], row["parameters"]) == who]
        most = max(row["cells"] for row in mine)
        best = min((row for row in mine if row["cells"] == most), key=lambda row: row["largest"])
        how = f"{best['method']} of order" if several else "order"
        yield (
            f"{called[who]}: {how} {best['order']} has the least largest error, "
            f"{relative(best['largest'])} at {number(best['at_amplitude'])}"
        )
