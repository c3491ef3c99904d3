"""Accuracy against cost: every contender of a benchmark as a point, expansions joined by order."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from ridgeback.compare.benchmark.contenders import WAYS, Row
from ridgeback.compare.benchmark.results import Benchmark
from ridgeback.reports.drawing.canvas import Canvas, Line, decades, draw, titles
from ridgeback.reports.drawing.picture import picture
from ridgeback.reports.drawing.theme import Variant, colour_of

PAGE = Variant("wide", 9.0, 5.4)
TOKENS = {"expansions": "s2", "series model": "s1", "estimates": "s3", None: "fg"}
"""One colour for each way, as on the page; yardsticks in the foreground."""
NUMBERED = (2, 4, 8, 12, 20, 40)
"""Orders whose number stands at their point."""
LEFT = 56.0
LINE = 13.0
"""Height of a line of labels, in points."""


def plot_file(found: Benchmark, kind: str) -> bytes:
    """Return the figure as SVG, PNG or PDF."""
    return picture(lambda: drawn(found), kind)


def drawn(found: Benchmark) -> Canvas:
    """Draw error against cost on logarithmic axes."""
    canvas = Canvas(PAGE)
    (axes,) = canvas.grid((1.0,), 1, left=LEFT, right=215.0)
    count = found.time.size
    rows = [
        row for row in found.contenders if row.ranked and seconds(row, count) is not None and row.relative_rms_error
    ]
    costs = [float(seconds(row, count) or 0.0) for row in rows]
    errors = [float(row.relative_rms_error or 0.0) for row in rows]
    decades(axes, "x", 0.4 * min(costs), 2.5 * max(costs), ticks=9)
    decades(axes, "y", 0.5 * min([*errors, found.reference.floor]), 4.0 * min(max(errors), 2.0), ticks=9)
    both = {row.amplitude_from for row in rows} >= {"energy", "action"}
    key = "; dashed: A(t) from the energy, else from the averaged action" if both else ""
    titles(axes, x=f"time for a track of {count} values, s", y=f"relative error of omega0(t), rms{key}")
    floor(axes, found)
    joined(axes, found, count)
    points(axes, rows, count)
    return canvas


def seconds(row: Row, count: int) -> float | None:
    """What a whole track costs."""
    if row.time_s_per_track is not None:
        return row.time_s_per_track
    return None if row.time_ns_per_value is None else row.time_ns_per_value * count * 1e-9


def floor(axes: Axes, found: Benchmark) -> None:
    """Shade the errors that the reference itself leaves open."""
    low = axes.get_ylim()[0]
    axes.axhspan(low, found.reference.floor, color=colour_of("grid"), alpha=0.45, linewidth=0.0, zorder=0.3)
    note = axes.annotate(
        "two readings of omega0(t) differ by this much",
        (0.22, found.reference.floor),
        (0.0, -12.0),
        xycoords=("axes fraction", "data"),
        textcoords="offset points",
    )
    note.set_color(colour_of("muted"))


FAMILIES = (
    ("expansion", "s2", "expansions"),
    ("series-model", "s1", "paper’s series"),
    ("slow-flow", "s2", "multiple scales"),
)


def joined(axes: Axes, found: Benchmark, count: int) -> None:
    """Join expansions by order and the series model by terms: dashed at A(t) from the energy."""
    compiled = any(row.language == "c" for row in found.contenders)
    for kind, token, name in FAMILIES:
        group = [row for row in found.contenders if row.kind == kind and row.ranked]
        group = [row for row in group if not (compiled and row.language == "python")]
        sources = list(dict.fromkeys(row.amplitude_from for row in group))
        for source in sources:
            rows = sorted((row for row in group if row.amplitude_from == source), key=lambda row: row.order or 0)
            chain(
                axes, rows, token, count, dashed=source == "energy" and len(sources) > 1, numbered=source == sources[-1]
            )
        if group:
            title(axes, group, f"{name}{', in C' if compiled and kind == 'expansion' else ''}", token, count)


def title(axes: Axes, group: Sequence[Row], name: str, token: str, count: int) -> None:
    """The name of a family above its highest point."""
    top = max(group, key=lambda row: row.relative_rms_error or 0.0)
    at = (float(seconds(top, count) or 0.0), float(top.relative_rms_error or 0.0))
    text = axes.annotate(name, at, (10.0, 13.0), textcoords="offset points", ha="right", fontsize=10.0)
    text.set_color(colour_of(token))


def chain(axes: Axes, rows: Sequence[Row], token: str, count: int, *, dashed: bool, numbered: bool) -> None:
    """One line through the points of a family, its orders written where there is room."""
    x = np.array([seconds(row, count) for row in rows], dtype=float)
    y = np.array([row.relative_rms_error for row in rows], dtype=float)
    draw(axes, Line(x, y, "", token, width=1.2, dash="--" if dashed else "-", order=2.0))
    for row, at in zip(rows, zip(x, y, strict=True), strict=True):
        if numbered and (row.order in NUMBERED or len(rows) < 6):
            text = axes.annotate(str(row.order), at, (5.0, -3.0), textcoords="offset points", fontsize=9.0)
            text.set_color(colour_of(token))


def points(axes: Axes, rows: Sequence[Row], count: int) -> None:
    """A point for each contender; names of those that are not numbered stand in a column at the right."""
    named = []
    for row in rows:
        token = TOKENS[WAYS[row.kind]]
        x, y = float(seconds(row, count) or 0.0), float(row.relative_rms_error or 0.0)
        shown = row.kind in ("expansion", "series-model", "slow-flow")
        if shown and row.language == "python" and any(r.language == "c" for r in rows):
            continue
        marker = "D" if row.corrected_by else "o"
        draw(axes, Line(np.array([x]), np.array([y]), "", token, marker=marker, order=3.0))
        if not shown:
            named.append((row, x, y, token))
    column(axes, named)


def column(axes: Axes, named: Sequence[tuple[Row, float, float, str]]) -> None:
    """Names at the right edge, each as near to the height of its point as the others allow, with a leader."""
    if not named:
        return
    box = axes.get_window_extent()
    low, high = (math.log10(y) for y in axes.get_ylim())
    ordered = sorted(named, key=lambda item: item[2])
    heights = [box.height * (math.log10(item[2]) - low) / (high - low) for item in ordered]
    places = apart(heights, LINE, box.height)
    for (row, x, y, token), height in zip(ordered, places, strict=True):
        axes.annotate(
            short(row),
            (x, y),
            (box.width + 8.0, height),
            textcoords="axes points",
            fontsize=9.0,
            color=colour_of(token),
            va="center",
            annotation_clip=False,
            arrowprops={
                "arrowstyle": "-",
                "color": colour_of("grid"),
                "linewidth": 0.7,
                "shrinkA": 1.0,
                "shrinkB": 2.0,
                "relpos": (0.0, 0.5),
            },
        )


def apart(heights: Sequence[float], step: float, top: float) -> list[float]:
    """Heights at least ``step`` from each other within 0 to ``top``, in the given order, moved as little as needed.

    >>> apart([0.0, 1.0, 50.0], 10.0, 60.0)
    [0.0, 10.0, 50.0]
    """
    placed: list[float] = []
    for height in heights:
        placed.append(max(height, placed[-1] + step) if placed else max(height, 0.0))
    over = (placed[-1] - top) if placed else 0.0
    for index in range(len(placed) - 1, -1, -1):
        ceiling = top if index == len(placed) - 1 else placed[index + 1] - step
        placed[index] = min(placed[index], ceiling) if over > 0 else placed[index]
    return placed


def short(row: Row) -> str:
    """A contender's name in the column."""
    if row.corrected_by:
        return row.method.replace("-corrected", ", own bias off")
    if row.amplitude_from and row.kind != "averaged":
        return f"{row.method.removesuffix('-' + row.amplitude_from)} ({row.amplitude_from})"
    return row.method
