"""Labels on the curves: each beside its own curve, clear of the other curves and of the other labels.

Candidates along the curve, at growing distance, are priced by what they would cover; a label that has to
stand away from its curve gets a thin leader.  Every text is measured before it is placed.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg, RendererAgg
from matplotlib.text import Text

from ridgeback.numeric.arrays import Array
from ridgeback.reports.drawing.canvas import Line
from ridgeback.reports.drawing.theme import colour_of

Box = tuple[float, float, float, float]

HEIGHT = 13.0
MARGIN = 3.0
FRACTIONS = (0.5, 0.62, 0.38, 0.74, 0.26, 0.86, 0.14, 0.95, 0.05)
STEPS = (0.9, -0.9, 1.8, -1.8, 2.8, -2.8, 4.0, -4.0, 5.4, -5.4, 7.0, -7.0, 9.0, -9.0)


def measured(axes: Axes, text: str, size: float = 10.0) -> tuple[float, float]:
    """Return width and height of a text in points, in the measuring font."""
    renderer = _renderer(axes)
    extent = Text(text=text, fontsize=size, fontfamily="DejaVu Sans", figure=axes.figure).get_window_extent(renderer)
    return float(extent.width), float(extent.height)


def _renderer(axes: Axes) -> RendererAgg:
    figure = axes.get_figure(root=True)
    assert figure is not None  # noqa: S101 - a panel is of a canvas
    renderer: RendererAgg = FigureCanvasAgg(figure).get_renderer()  # type: ignore[no-untyped-call]
    return renderer


def outline_points(axes: Axes, line: Line, spacing: float = 3.0) -> Array:
    """Return points along a curve in display units, closely spaced, inside the panel only."""
    with np.errstate(all="ignore"):
        points = axes.transData.transform(np.column_stack([line.x, line.y]))
    points = points[np.isfinite(points).all(axis=1)]
    if len(points) < 2:
        return _inside(axes, points)
    box = axes.get_window_extent()
    points = np.clip(points, [box.x0 - 1e4, box.y0 - 1e4], [box.x1 + 1e4, box.y1 + 1e4])
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    at = np.linspace(0.0, along[-1], min(4000, max(2, int(along[-1] / spacing))))
    return _inside(axes, np.column_stack([np.interp(at, along, points[:, i]) for i in (0, 1)]))


def _inside(axes: Axes, points: Array) -> Array:
    box = axes.get_window_extent()
    keep = (points[:, 0] >= box.x0) & (points[:, 0] <= box.x1) & (points[:, 1] >= box.y0) & (points[:, 1] <= box.y1)
    return np.asarray(points[keep], dtype=np.float64)


def place(axes: Axes, lines: Sequence[Line], *, taken: Sequence[Box] = (), size: float = 10.0) -> list[Box]:
    """Label all curves that have a label; returns the boxes (display units) that are now taken."""
    outlines = [outline_points(axes, line) for line in lines]
    boxes = list(taken)
    for i, line in enumerate(lines):
        if line.label and len(outlines[i]):
            others = [points for j, points in enumerate(outlines) if j != i and len(points)]
            boxes.append(_place_one(axes, line, outlines[i], np.concatenate([np.empty((0, 2)), *others]), boxes, size))
    return boxes


def _place_one(axes: Axes, line: Line, own: Array, others: Array, boxes: list[Box], size: float) -> Box:
    width, _ = measured(axes, line.label, size)
    anchors = [own[min(len(own) - 1, int(fraction * len(own)))] for fraction in FRACTIONS]
    places = [
        (_price(axes, box, step, shift, own, others, boxes), i, box)
        for i, (anchor, step, shift) in enumerate(product(anchors, STEPS, (0.0, 0.5, -0.5)))
        for box in (_box_at(anchor, width, step, shift),)
    ]
    _, i, box = min(places)
    x, y = anchors[i // (3 * len(STEPS))]
    _write(axes, line, box, (float(x), float(y)), size)
    return box


def _box_at(anchor: Array, width: float, step: float, shift: float) -> Box:
    x = float(anchor[0]) + shift * (width + 4) - width / 2
    y = float(anchor[1]) + step * HEIGHT - HEIGHT / 2
    return x, y, x + width, y + HEIGHT


def _price(axes: Axes, box: Box, step: float, shift: float, own: Array, others: Array, boxes: list[Box]) -> float:
    frame = axes.get_window_extent()
    wide = (box[0] - MARGIN, box[1] - 1, box[2] + MARGIN, box[3] + 1)
    outside = box[0] < frame.x0 + 2 or box[2] > frame.x1 or box[1] < frame.y0 + 2 or box[3] > frame.y1 + 2
    overlap = any(_overlaps(wide, other) for other in boxes)
    price = (
        1e6 * outside
        + 1e5 * overlap
        + 60.0 * _count(wide, others)
        + 45.0 * _count(wide, own)
        + 12.0 * abs(step)
        + 6.0 * abs(shift)
    )
    return float(price)


def _overlaps(a: Box, b: Box) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def _count(box: Box, points: Array) -> int:
    x, y = points[:, 0], points[:, 1]
    return int(np.count_nonzero((x > box[0]) & (x < box[2]) & (y > box[1]) & (y < box[3])))


def _write(axes: Axes, line: Line, box: Box, anchor: tuple[float, float], size: float) -> None:
    height = axes.get_window_extent().height
    frame = axes.get_window_extent()
    middle = (box[1] + box[3]) / 2
    style = f"{line.style} halo".strip()
    if abs(middle - anchor[1]) > 1.3 * HEIGHT:
        edge = box[1] - 1 if anchor[1] < middle else box[3] + 1
        x = min(max(anchor[0], box[0] + 2), box[2] - 2)
        ends = np.array([[x, edge], list(anchor)])
        inverse = axes.transAxes.inverted().transform(ends)
        axes.plot(*inverse.T, transform=axes.transAxes, color=colour_of(line.token), linewidth=0.7, zorder=4.0)[
            0
        ].set_gid(f"class:{line.style or 'leader'}")
    text = axes.text(
        ((box[0] + box[2]) / 2 - frame.x0) / frame.width,
        (box[1] + 3.2 - frame.y0) / height,
        line.label,
        transform=axes.transAxes,
        ha="center",
        va="baseline",
        fontsize=size,
        color=colour_of(line.token),
        zorder=6.0,
    )
    text.set_gid(f"class:{style}")
