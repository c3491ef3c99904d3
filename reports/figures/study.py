"""The figures of an accuracy-order study: backbone, error curves, map, and the order that an amplitude needs."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from matplotlib.axes import Axes

from ridgeback.common.numbers import listing, number, relative, rounded_down, threshold
from ridgeback.compare.study.results import Range, Study, Trend
from ridgeback.compare.study.study import order_needed as smallest_orders
from ridgeback.numeric.arrays import Array
from ridgeback.reports.drawing import cells
from ridgeback.reports.drawing.block import Block, Key, Readout, Toggle, block
from ridgeback.reports.drawing.canvas import (
    Canvas,
    Line,
    Trace,
    decades,
    draw,
    limit_line,
    linear,
    padded,
    shade,
    titles,
    whole,
)
from ridgeback.reports.drawing.labels import note, place
from ridgeback.reports.drawing.theme import SERIES, sentinel

FLOOR = 1e-17


def variable_name(study: Study) -> str:
    """Return what the horizontal axis shows, with its unit.

    >>> from types import SimpleNamespace as S
    >>> variable_name(S(variable="A", amplitude_unit="rad", amplitude_definition="peak"))
    'peak amplitude A / rad'
    """
    if study.variable != "A":
        return "ε"
    unit = f" / {study.amplitude_unit}" if study.amplitude_unit else ""
    return f"{study.amplitude_definition} amplitude A{unit}"


_OVER_EPS = {Trend.RISING: "rising", Trend.FALLING: "falling", Trend.BOTH: "rising and falling"}


def _trend(study: Study) -> str:
    """How the frequency changes: hardening and softening are words for a dependence on the amplitude."""
    return study.trend.value if study.variable == "A" else _OVER_EPS.get(study.trend, study.trend.value)


def _letter(study: Study) -> str:
    return "A" if study.variable == "A" else "ε"


def _chosen(study: Study, finding: Range | None) -> int:
    wanted = finding.order if finding else study.orders[-1]
    return study.orders.index(wanted) if wanted in study.orders else len(study.orders) - 1


def spread(count: int, keep: int, most: int = 5) -> list[int]:
    """Choose at most ``most`` of ``count`` indices: first, last, ``keep`` and evenly between.

    >>> spread(10, 3, 5), spread(3, 1)
    ([0, 3, 4, 7, 9], [0, 1, 2])
    """
    if count <= most:
        return list(range(count))
    even = [int(i) for i in np.linspace(0, count - 1, most).round()]
    inner = range(1, most - 1)
    if keep not in even:
        even[min(inner, key=lambda i: abs(even[i] - keep))] = keep
    return sorted(even)


def backbone_block(study: Study, found: Range | None) -> Block:
    """omega0(A): reference thick, the chosen order coloured, the region beyond its range shaded."""
    chosen = _chosen(study, found)
    picked = sorted({0, chosen, len(study.orders) - 1})
    reference = Line(study.amplitudes, study.reference / study.scale, study.reference_name, "fg", width=2.6)
    tokens = dict(zip([chosen, *(i for i in picked if i != chosen)], ("s2", "s1", "s3"), strict=False))
    lines = [
        Line(study.amplitudes, study.omega[i] / study.scale, f"order {study.orders[i]}", tokens[i], style=f"t{i}")
        for i in picked
    ]

    def drawing(canvas: Canvas) -> None:
        (axes,) = canvas.stack()
        low, high = padded([reference.y], share=0.12)
        linear(axes, "y", low, high)
        linear(axes, "x", 0.0, _end(study), ticks=5 if canvas.narrow else 8)
        titles(axes, x=variable_name(study), y="ω₀ / k")
        taken = _mark_range(axes, study, found)
        for line in (reference, *lines):
            draw(axes, line)
        place(axes, [*lines, replace(reference, label="exact")], taken=taken)

    traces = tuple(Trace(line.label, line.x, line.y, line.style, line.token) for line in (reference, *lines))
    what = f"ω₀ against {_letter(study)} of {study.title}: {_trend(study)}, from {number(float(reference.y[0]))} k at "
    what += f"{_letter(study)} = {number(float(study.amplitudes[0]))} to {number(float(reference.y[-1]))} k at "
    what += f"{_letter(study)} = {number(float(study.amplitudes[-1]))}."
    return block(
        "backbone",
        title=f"Backbone curve of {study.title}",
        description=what,
        caption=f"{what} The thick curve is the reference ({study.reference_name}, relative uncertainty at most "
        f"{relative(float(np.nanmax(study.reference_error)))}). {_range_sentence(study, found)}".strip(),
        draw=drawing,
        readout=Readout(_letter(study), study.amplitude_unit, "k", traces, "amplitude"),
        toggles=[Toggle(line.style, line.label, line.token) for line in lines],
    )


def _end(study: Study) -> float:
    last = float(study.amplitudes[-1])
    return min(study.limit, 1.06 * last) if study.limit else last


def _mark_range(axes: Axes, study: Study, found: Range | None) -> list[tuple[float, float, float, float]]:
    taken = []
    end = axes.get_xlim()[1]
    if found and found.up_to is not None and found.up_to < study.amplitudes[-1]:
        shade(axes, found.up_to, end)
        limit_line(axes, found.up_to)
        at = (found.up_to - axes.get_xlim()[0]) / (end - axes.get_xlim()[0])
        text = f"{threshold(found.target)} up to {number(rounded_down(found.up_to, 3), 3)}"
        right = at < 0.62
        taken.append(note(axes, text, at + (0.015 if right else -0.015), 0.05, align="left" if right else "right"))
    return taken


def _range_sentence(study: Study, found: Range | None) -> str:
    if found is None:
        return ""
    if found.up_to is None:
        return f"Order {found.order} meets {threshold(found.target)} at none of the amplitudes studied."
    where = f"{_letter(study)} = {number(rounded_down(found.up_to, 4))}"
    if found.up_to >= study.amplitudes[-1]:
        return f"Order {found.order} stays within {threshold(found.target)} over the whole range studied, to {where}."
    return f"Order {found.order} stays within {threshold(found.target)} up to {where}; beyond, shaded."


def error_block(study: Study, finding: Range | None) -> Block:
    """|relative error| against amplitude, the target dashed, up to five orders."""
    target = finding.target if finding else 1e-3
    picked = spread(len(study.orders), _chosen(study, finding))
    lines = [
        Line(
            study.amplitudes,
            _positive(study.relative_error[i]),
            f"order {study.orders[i]}",
            SERIES[k],
            style=f"t{i}",
        )
        for k, i in enumerate(picked)
    ]
    low, high = _decade_limits([line.y for line in lines], target)

    def drawing(canvas: Canvas) -> None:
        (axes,) = canvas.stack()
        decades(axes, "y", low, high, ticks=8)
        linear(axes, "x", 0.0, _end(study), ticks=5 if canvas.narrow else 8)
        titles(axes, x=variable_name(study), y="|relative error of ω₀|")
        axes.axhline(target, color=sentinel("fg"), linewidth=0.9, linestyle=(0, (5, 3)), zorder=2.2)
        level = (np.log10(target) - np.log10(low)) / (np.log10(high) - np.log10(low))
        taken = [note(axes, f"target {threshold(target)}", 0.012, level + 0.035)]
        axes.fill_between(
            study.amplitudes, low, np.maximum(study.reference_error, low), color=sentinel("grid"), linewidth=0.0
        )
        for line in lines:
            draw(axes, line)
        place(axes, lines, taken=taken)

    worst = [f"order {study.orders[i]}: {relative(_worst(study, i))}" for i in picked]
    return block(
        "error",
        title=f"Error of the truncated expansions of {study.title}",
        description=f"Relative error of omega0 against {_letter(study)} for {listing([line.label for line in lines])}.",
        caption=f"Relative error ω₀ / ω₀,ref − 1, absolute value, against {study.reference_name}. "
        f"Largest over {_letter(study)} ≤ {number(float(study.amplitudes[-1]))}: {'; '.join(worst)}. "
        "A dip to zero where the error changes sign is no accuracy: a range of use ends at the first violation of "
        "the target.",
        draw=drawing,
        readout=Readout(
            _letter(study),
            study.amplitude_unit,
            "",
            tuple(Trace(line.label, line.x, line.y, line.style, line.token) for line in lines),
            "amplitude",
        ),
        toggles=[Toggle(line.style, line.label, line.token) for line in lines],
    )


def _worst(study: Study, i: int) -> float | None:
    size = np.abs(study.relative_error[i])
    return float(np.nanmax(size)) if np.isfinite(size).any() else None


def _positive(values: Array) -> Array:
    size = np.abs(values)
    return np.where(size > FLOOR, size, np.nan)


def _decade_limits(values: Sequence[Array], target: float) -> tuple[float, float]:
    joined = np.concatenate([v[np.isfinite(v)] for v in values] + [np.array([target])])
    low = max(-17, int(np.floor(np.log10(joined.min()))))
    high = min(2, int(np.ceil(np.log10(joined.max()))))
    return 10.0**low, 10.0 ** max(high, low + 2)


def map_block(study: Study) -> Block:
    """Order against amplitude in six bands, outlined at 1 %, 0.1 % and 10^-6 by staircases."""
    grid = cells.bands(study.relative_error)
    outlines = {level: cells.staircase(np.abs(study.relative_error) <= level) for level in cells.CONTOURS}

    def drawing(canvas: Canvas) -> None:
        (axes,) = canvas.stack()
        axes.grid(visible=False)
        x_edges = np.maximum(cells.edges(study.amplitudes), 0.0)
        linear(axes, "x", float(x_edges[0]), float(x_edges[-1]), ticks=5 if canvas.narrow else 8)
        axes.set_ylim(0, len(study.orders))
        middles = [i + 0.5 for i in range(len(study.orders))]
        whole(axes, "y", middles, [str(order) for order in study.orders], most=12)
        titles(axes, x=variable_name(study), y="order")
        x = axes.transData.transform(np.column_stack([x_edges, 0 * x_edges]))[:, 0]
        rows = np.arange(len(study.orders) + 1.0)
        height = canvas.figure.get_size_inches()[1] * 72
        y = height - axes.transData.transform(np.column_stack([0 * rows, rows]))[:, 1]
        canvas.insert(axes, "map", _map_markup(grid, outlines, x, y))

    return block(
        "map",
        title=f"Relative error over order and amplitude for {study.title}",
        description="Map of the relative error in six bands, one row per order, one column per amplitude; "
        + " ".join(_map_sentences(study)),
        caption=f"|relative error of ω₀| at every order and {_letter(study)} studied "
        f"({len(study.orders)} × {study.amplitudes.size} cells, none interpolated). "
        "Outlined: 1 % (solid), 0.1 % (dashed), 10⁻⁶ (dotted). " + " ".join(_map_sentences(study)),
        draw=drawing,
        keys=[*_band_keys(), *((Key("grid", "not available"),) if (grid == cells.MISSING).any() else ())],
    )


def _map_sentences(study: Study) -> list[str]:
    best = np.nanmin(np.where(np.isfinite(study.relative_error), np.abs(study.relative_error), np.inf), axis=0)
    good = [level for level in cells.CONTOURS if bool((best <= level).all())]
    said = f"Some order studied is within {threshold(min(good))} at every amplitude." if good else ""
    bad = study.amplitudes[best > 1e-2]
    lost = f"From {_letter(study)} = {number(float(bad[0]))} no order studied reaches 1 %." if bad.size else ""
    about = f" ± {number(study.convergence_uncertainty, 1)}" if study.convergence_uncertainty else ""
    radius = (
        f"The series converges up to {_letter(study)} = {number(study.convergence_radius)}{about}."
        if study.convergence_radius
        else ""
    )
    return [sentence for sentence in (said, lost, radius) if sentence]


_DASHES = {1e-2: "", 1e-3: "5 3", 1e-6: "1 3"}


def _map_markup(grid: cells.Bands, outlines: dict[float, list[tuple[int, int, int, int]]], x: Array, y: Array) -> str:
    fills = {cells.MISSING: "grid", **{band: f"b{band}" for band in range(6)}}
    # The hairline of the same colour closes the seams that rounding to pixels leaves between rows.
    ink = "fill:var(--{0});stroke:var(--{0});stroke-width:.6"
    parts = [
        f'<path d="{path}" style="{ink.format(fills[band])}" shape-rendering="crispEdges"/>'
        for band, path in cells.rectangles(grid, x, y).items()
    ]
    for level, segments in outlines.items():
        path = cells.outline(segments, x, y)
        if path:
            parts.append(f'<path d="{path}" class="casing"/>')
            parts.append(f'<path d="{path}" class="contour" stroke-dasharray="{_DASHES[level] or "none"}"/>')
    return "".join(parts)


def _band_keys() -> list[Key]:
    limits = [threshold(level) for level in cells.THRESHOLDS]
    between = [f"{a} to {b}" for a, b in itertools.pairwise(limits)]
    return [Key(f"b{i}", text) for i, text in enumerate([f"at most {limits[0]}", *between, f"more than {limits[-1]}"])]


def order_needed(study: Study, ranges: Sequence[Range]) -> Block | None:
    """Draw the smallest order whose range of use covers each amplitude, one stair per target."""
    stairs = _stairs(study, ranges)
    if not stairs:
        return None
    lines = [
        Line(x, y, f"within {threshold(target)}", SERIES[k], style=f"t{k}", width=2.0)
        for k, (target, x, y) in enumerate(stairs)
    ]

    def drawing(canvas: Canvas) -> None:
        (axes,) = canvas.stack()
        linear(axes, "x", 0.0, _end(study), ticks=5 if canvas.narrow else 8)
        top = max(float(line.y.max()) for line in lines)
        linear(axes, "y", 0.0, 1.12 * top)
        titles(axes, x=variable_name(study), y="order needed")
        for line in lines:
            draw(axes, line)
        place(axes, lines)

    said = [_stair_sentence(study, target, x, y) for target, x, y in stairs]
    return block(
        "needed",
        title=f"Order needed at each amplitude for {study.title}",
        description=" ".join(said),
        caption="Smallest order studied that holds its target from the smallest amplitude up to this one. "
        + " ".join(said),
        draw=drawing,
        heights=(3.2, 3.2),
        toggles=[Toggle(line.style, line.label, line.token) for line in lines],
    )


def _stairs(study: Study, ranges: Sequence[Range]) -> list[tuple[float, Array, Array]]:
    """Corners of the stair of each target: amplitudes, and the smallest order that serves them."""
    found = []
    for target in sorted({r.target for r in ranges}, reverse=True)[:5]:
        needs = [need for need in smallest_orders(study, target) if need.order is not None]
        treads = [list(group) for _, group in itertools.groupby(needs, key=lambda need: need.order)]
        if len(treads) > 1 or (treads and len(study.orders) > 1):
            ends = [tread[-1].amplitude for tread in treads]
            x = np.array([v for pair in zip([needs[0].amplitude, *ends[:-1]], ends, strict=True) for v in pair])
            y = np.array([float(tread[0].order or 0) for tread in treads for _ in (0, 1)])
            found.append((target, x, y))
    return found


def _stair_sentence(study: Study, target: float, x: Array, y: Array) -> str:
    return (
        f"Within {threshold(target)}: order {y[0]:.0f} reaches {_letter(study)} = {number(float(x[1]), 3)}, "
        f"order {y[-1]:.0f} reaches {number(float(x[-1]), 3)}."
    )
