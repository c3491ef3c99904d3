"""Errors and costs of the contenders as ranked dots: names that are legible on a phone."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise

import numpy as np

from ridgeback.compare.benchmark.contenders import WAYS, Row
from ridgeback.compare.report.naming import told
from ridgeback.reports.drawing.apart import text_width
from ridgeback.reports.drawing.figure import WIDE
from ridgeback.reports.drawing.marks import dot, drawing, group, line, rect, text
from ridgeback.reports.drawing.scale import Scale
from ridgeback.reports.drawing.ticks import error_ticks, round_duration
from ridgeback.reports.figures.contending import LETTERS, NUMBERED, STYLE, Shown, brief, error, least_drawn

RANKED = 26
"""Rows, at most."""


def ranked_drawing(which: Shown, target: float, label: str, width: float, *, timed: bool) -> str:
    """The errors, and the costs where they were measured, as dots in rows, the smallest error first."""
    rows = _chosen(which)
    step = 18.0 if width < WIDE else 20.0
    height = 44 + step * len(rows) + 8
    names = max((text_width(_row_name(row), 11.5 if width < WIDE else 13.5) for row in rows), default=60.0)
    names = min(names, 0.5 * width)
    errors = [error(row) for row in rows]
    split = names + 14 + (width - names) * (0.52 if timed else 0.94)
    least = max(0.5 * min(*errors, target), least_drawn(which.found.reference.floor))
    x = Scale(least, 2.0 * min(max(errors), 30.0), names + 14, split, log=True)
    marks = []
    floor = which.found.reference.floor
    if floor > x.low:
        marks.append(rect(x.start, 32, x(min(floor, x.high)) - x.start, height - 32))
    marks.append(text((x.start + x.end) / 2, 11, "rms error", "m sm", "middle"))
    ticks = x.ticks(8)
    marks += _ticks(x, ticks, error_ticks(ticks), (width, height))
    marks.append(line(x(target), 32, x(target), height, "tg"))
    cost = None
    if timed:
        known = [which.cost(row) for row in rows if math.isfinite(which.cost(row))]
        cost = Scale(0.7 * min(known), 1.6 * max(known), split + 16, width - 6, log=True)
        middle = min((cost.start + cost.end) / 2, width - 0.5 * text_width("cost of a track", 11.0) - 2.0)
        marks.append(text(middle, 11, "cost of a track", "m sm", "middle"))
        marks += _ticks(cost, cost.ticks(8), round_duration, (width, height))
    for i, row in enumerate(rows):
        marks.append(_ranked_row(which, row, 42 + step * (i + 0.5), names, x, cost))
    return drawing(width, height, "narrow" if width < WIDE else "wide", label, marks)


def _ticks(
    scale: Scale, values: Iterable[float], worded: Callable[[float], str], size: tuple[float, float]
) -> Iterable[str]:
    """Lines with words, every first, second, third... of them, as many as leave room for all their words."""
    width, height = size
    most = min(scale.end + 8, width - 3)
    inside = [v for v in values if scale.start - 8 < scale(v) - _half(worded(v)) and scale(v) + _half(worded(v)) < most]
    strides = (inside[k::n] for n in range(1, len(inside) + 1) for k in range(n))
    kept = next((some for some in strides if _apart(scale, some, worded)), [])
    for value in kept:
        yield line(scale(value), 32, scale(value), height, "g")
        yield text(scale(value), 26, worded(value), "m sm", "middle")


def _half(words: str) -> float:
    """Half a width, a tenth beyond what is guessed: a reader's font may be wider."""
    return 0.55 * text_width(words, 11.0)


def _apart(scale: Scale, values: Sequence[float], worded: Callable[[float], str]) -> bool:
    """Whether the words of neighbours leave a gap between them."""
    return all(scale(a) + _half(worded(a)) + 4.0 < scale(b) - _half(worded(b)) for a, b in pairwise(values))


def _ranked_row(which: Shown, row: Row, y: float, names: float, x: Scale, cost: Scale | None) -> str:
    letter = LETTERS[WAYS[row.kind]]
    style = STYLE[letter]
    marks = [
        text(names, y + 4, _row_name(row), style, "end"),
        dot(float(x.clipped(np.array([error(row)]))[0]), y, 3.4, style),
    ]
    if cost is not None and math.isfinite(which.cost(row)):
        marks.append(dot(cost(which.cost(row)), y, 3.4, style))
    return group(marks, f"f{letter}", told(row, which.found.reference, which.cost(row)))


def _row_name(row: Row) -> str:
    return brief(row).replace("own bias removed", "corr.")


def _chosen(which: Shown) -> list[Row]:
    """One row for each contender: some orders, all terms, all estimates and the best corrected one."""
    orders = [row for row in which.expansions if row.order in NUMBERED] or list(which.expansions[:8])
    resummed = [] if which.best_resummed is None else [which.best_resummed]
    rows = [*orders, *resummed, *which.flows[-1:], *which.terms, *which.exact[:1], *which.estimates]
    rows += sorted(which.corrected, key=error)[:2]
    return sorted(rows, key=error)[:RANKED]
