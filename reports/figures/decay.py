"""The figures of a decay as a whole: all tracks over the reference, every method's residual, the error budget."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from ridgeback.common.numbers import listing, number, relative
from ridgeback.compare.motion.results import BudgetRow, Curve, DecayComparison
from ridgeback.numeric.arrays import Array
from ridgeback.reports.drawing.block import Block, Readout, Toggle, block
from ridgeback.reports.drawing.canvas import Canvas, Line, decades, draw, linear, padded, shade, titles
from ridgeback.reports.drawing.labels import measured, place
from ridgeback.reports.drawing.theme import SERIES, sentinel
from ridgeback.reports.figures.over_time import Clock, curve_line, relative_to, traces_of, usable

KINDS = ("model", "estimate", "expansion")
PREFERRED = ("closed-form", "lindstedt-2", "wigner", "smoothed-pseudo-wigner", "harmonic-least-squares")
"""The curves that tell the story: the paper's model, its low-order expansion, its estimators, and a better one."""


def leading(curves: Sequence[Curve], most: int = 5) -> list[Curve]:
    """Choose at most ``most`` curves: the preferred ones, then others by kind in turn; kept in their own order.

    >>> leading([])
    []
    """
    queues = [[curve.name for curve in usable(curves) if curve.kind == kind] for kind in KINDS]
    taken = [name for name in PREFERRED if any(name in queue for queue in queues)][:most]
    rest = [[name for name in queue if name not in taken] for queue in queues]
    while len(taken) < most and any(rest):
        for queue in rest:
            if queue and len(taken) < most:
                taken.append(queue.pop(0))
    return [curve for curve in curves if curve.name in taken]


def tracks_figure(decay: DecayComparison) -> Block:
    """omega0(t): models and estimates over the reference, with residual panel and hatched border zones."""
    clock = Clock(decay.case.time_unit)
    chosen = leading(decay.curves)
    reference = curve_line(decay.reference, clock, "fg", width=2.6)
    lines = [curve_line(curve, clock, SERIES[i], style=f"t{i}") for i, curve in enumerate(chosen)]
    rest = [
        Line(curve.time, 100 * relative_to(curve, decay.reference), line.label, line.token, style=line.style, width=1.4)
        for curve, line in zip(chosen, lines, strict=True)
    ]
    span = (float(decay.time[0]), float(decay.time[-1]))

    def drawing(canvas: Canvas) -> None:
        upper, lower = canvas.stack((1.55, 1.0), gap=36)
        for axes in (upper, lower):
            linear(axes, "x", *span, ticks=5 if canvas.narrow else 9)
            _borders(axes, span, decay.interior)
        linear(upper, "y", *padded([reference.y, *(line.y for line in lines)], share=0.1), ticks=5)
        linear(lower, "y", *_residual_limits(rest, decay.interior), ticks=4)
        titles(upper, y=clock.y_title("ω₀"))
        titles(lower, x=clock.x_title, y="relative error / %")
        draw(upper, reference)
        lower.axhline(0.0, color=sentinel("fg"), linewidth=0.8, zorder=2)
        for line in lines:
            draw(upper, line)
        for line in rest:
            draw(lower, line)
        place(upper, [*lines, Line(reference.x, reference.y, "reference", "fg")])

    return block(
        "tracks",
        title="Frequency along the decay",
        description=f"omega0(t) of {listing([line.label for line in lines])} over {decay.reference.label}, and their "
        "relative errors below.",
        caption=_tracks_caption(decay, clock, {curve.name for curve in chosen}),
        draw=drawing,
        readout=Readout("t", clock.time_unit, clock.unit, traces_of([reference, *lines]), "time"),
        toggles=[Toggle(line.style, line.label, line.token) for line in lines],
        heights=(5.0, 5.0),
    )


def _tracks_caption(decay: DecayComparison, clock: Clock, names: set[str]) -> str:
    values = decay.reference.omega[decay.reference.valid] * clock.factor
    ends = f"from {number(float(values[0]))} to {number(float(values[-1]))} {clock.unit}".strip() if values.size else ""
    a, b = (number(v, 3) for v in decay.interior)
    errors = [f"{score.label} {relative(score.rms_interior)}" for score in decay.scores if score.method in names]
    unit = f" {decay.case.time_unit}" if decay.case.time_unit else ""
    return (
        f"Thick: {decay.reference.label}, {ends}. Below: error relative to it. Hatched: within reach of the "
        f"borders; the interior is {a} to {b}{unit}. Relative rms over the interior: {'; '.join(errors)}."
    )


def _borders(axes: Axes, span: tuple[float, float], interior: tuple[float, float]) -> None:
    shade(axes, span[0], max(interior[0], span[0]), hatched=True)
    shade(axes, min(interior[1], span[1]), span[1], hatched=True)


def _residual_limits(lines: Sequence[Line], interior: tuple[float, float]) -> tuple[float, float]:
    inside = [line.y[(line.x >= interior[0]) & (line.x <= interior[1])] for line in lines]
    joined = np.concatenate([v[np.isfinite(v)] for v in inside] or [np.array([0.0])])
    if joined.size == 0:
        return -1.0, 1.0
    low, high = np.quantile(joined, [0.01, 0.99])
    size = max(float(high - low), 1e-3)
    return min(float(low), 0.0) - 0.25 * size, max(float(high), 0.0) + 0.25 * size


def residuals_figure(decay: DecayComparison) -> Block:
    """|relative error| of every method over time, one small panel each, on one common log axis."""
    curves = usable(decay.curves)
    errors = [np.abs(relative_to(curve, decay.reference)) for curve in curves]
    low, high = _error_decades(errors)
    span = (float(decay.time[0]), float(decay.time[-1]))
    found = {score.method: score for score in decay.scores}

    def drawing(canvas: Canvas) -> None:
        columns = 2 if canvas.narrow else 4
        rows = -(-len(curves) // columns)
        panels = canvas.grid([1.0] * rows, columns, left=34, right=6 if canvas.narrow else 9, gap=44)
        for axes in panels[len(curves) :]:
            axes.set_visible(False)
        for k, (axes, curve, error) in enumerate(zip(panels, curves, errors, strict=False)):
            decades(axes, "y", low, high, ticks=4)
            linear(axes, "x", *span, ticks=3)
            _borders(axes, span, decay.interior)
            token = SERIES[KINDS.index(curve.kind)] if curve.kind in KINDS else "fg"
            draw(axes, Line(curve.time, np.where(error > 0, error, np.nan), "", token, width=1.2))
            score = found.get(curve.name)
            _panel_title(axes, curve.label, relative(score.rms_interior) if score else "")
            if k + columns >= len(curves):
                titles(axes, x=clock.x_title)

    clock = Clock(decay.case.time_unit)
    rows_wide, rows_narrow = -(-len(curves) // 4), -(-len(curves) // 2)
    return block(
        "residuals",
        title="Error of every method over time",
        description=f"Small panels, one per method, of the absolute relative error of omega0(t): "
        f"{listing([curve.label for curve in curves])}.",
        caption=f"|ω₀ / reference − 1| of each model and estimate against {decay.reference.label}, all on the same "
        "logarithmic axis; the figure after each name is the relative rms over the interior. Blue: models; orange: "
        "estimates from the signal; green: truncated expansions.",
        draw=drawing,
        heights=(0.85 + 1.45 * rows_wide, 0.85 + 1.45 * rows_narrow),
    )


def _panel_title(axes: Axes, label: str, value: str) -> None:
    room = axes.get_window_extent().width + 26
    for size in (10.0, 9.0, 8.0):
        if measured(axes, label, size)[0] <= room:
            break
    while measured(axes, label, size)[0] > room and len(label) > 4:
        label = label[:-2].rstrip() + "…"
    for text, height in ((label, 15.0), (value, 4.0)):
        axes.annotate(
            text,
            (0.0, 1.0),
            (-26.0, height),
            xycoords="axes fraction",
            textcoords="offset points",
            fontsize=size if height > 10 else 9.0,
            color=sentinel("fg" if height > 10 else "muted"),
        )


def _error_decades(errors: Sequence[Array]) -> tuple[float, float]:
    joined = np.concatenate([e[np.isfinite(e) & (e > 0)] for e in errors] or [np.array([1.0])])
    if joined.size == 0:
        return 1e-6, 1.0
    low = int(np.floor(np.log10(np.quantile(joined, 0.02))))
    high = int(np.ceil(np.log10(joined.max())))
    return 10.0 ** max(low, high - 9), 10.0 ** max(high, low + 2)


PARTS = (("truncation", "s1", "o"), ("averaging", "s3", "s"), ("estimator", "s2", "^"))


def budget_figure(decay: DecayComparison) -> Block | None:
    """One row per method: the parts of its distance from the reference as dots, the total as a bar."""
    rows = [row for row in decay.budget if row.total > 0]
    if not rows:
        return None
    values = np.array([v for row in rows for v in _parts(row) if v and v > 0])
    low, high = 10.0 ** np.floor(np.log10(values.min())), 10.0 ** np.ceil(np.log10(values.max()))

    def drawing(canvas: Canvas) -> None:
        (axes,) = canvas.stack(left=20.0 if canvas.narrow else 210.0)
        axes.grid(visible=False)
        decades(axes, "x", float(low), float(max(high, 100 * low)), ticks=5 if canvas.narrow else 9)
        axes.grid(visible=True, axis="x", color=sentinel("grid"))
        axes.set_ylim(len(rows) - 0.3, -0.8)
        axes.set_yticks([])
        axes.spines["left"].set_visible(False)
        titles(axes, x="relative rms over the interior")
        for i, row in enumerate(rows):
            _budget_row(axes, row, i, inside=canvas.narrow)

    return block(
        "budget",
        title="Where the error comes from",
        description="The truncation, averaging and estimator parts of each method's relative error, and its total: "
        + "; ".join(f"{row.label} {relative(row.total)}" for row in rows),
        caption="Bar: total distance from the reference. Marks: its named parts, each as rms on its own (rms values "
        "of parts do not add up; what they leave unexplained together is the closure in the table).",
        draw=drawing,
        toggles=[Toggle(f"p{name}", name, token) for name, token, _ in PARTS],
        heights=(0.75 + 0.3 * len(rows), 0.75 + 0.46 * len(rows)),
    )


def _parts(row: BudgetRow) -> tuple[float | None, ...]:
    return row.truncation, row.averaging, row.estimator, row.total


def _budget_row(axes: Axes, row: BudgetRow, i: int, *, inside: bool) -> None:
    start = axes.get_xlim()[0]
    axes.plot([start, row.total], [i, i], color=sentinel("grid"), linewidth=7, solid_capstyle="butt", zorder=1)
    axes.plot([row.total], [i], marker="|", markersize=11, markeredgewidth=2.2, color=sentinel("fg"), zorder=2)
    for (name, token, marker), value in zip(PARTS, _parts(row), strict=False):
        if value and value > 0:
            (dot,) = axes.plot([value], [i], marker=marker, markersize=6, markeredgewidth=0, color=sentinel(token))
            dot.set_gid(f"class:p{name}")
    place_, align = ((0.0, -7.5), "left") if inside else ((-8.0, -3.5), "right")
    axes.annotate(
        row.label,
        (start, i),
        (place_[0], 8.0 if inside else place_[1]),
        textcoords="offset points",
        ha=align,
        color=sentinel("fg"),
    )
