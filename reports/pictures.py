"""A result's own picture on matplotlib axes: the one place where ``result.plot()`` draws."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib import pyplot
from matplotlib.axes import Axes

from ridgeback.common.show.picture import Picture, Plane, Stroke
from ridgeback.numeric.arrays import floats
from ridgeback.reports.drawing.theme import SERIES, TOKENS

FLOOR_DB = -60.0
"""Level below the highest value at which the colours of a plane end."""


def draw(picture: Picture, ax: Axes | None = None) -> Axes:
    """Draw a picture and return its axes.

    >>> from matplotlib import use
    >>> use("agg")
    >>> axes = draw(Picture("squares", "x", "y", (Stroke([0.0, 1.0, 2.0], [0.0, 1.0, 4.0], "x**2"),)))
    >>> axes.get_xlabel(), len(axes.lines)
    ('x', 1)
    >>> pyplot.close(axes.figure)
    """
    axes = pyplot.subplots(layout="constrained")[1] if ax is None else ax
    if picture.plane is not None:
        plane(axes, picture.plane)
    for i, stroke in enumerate(picture.strokes):
        curve(axes, stroke, TOKENS[SERIES[i % len(SERIES)]][0])
    if picture.logarithmic:
        axes.set_yscale("log")
    axes.set(title=picture.title, xlabel=picture.x_label, ylabel=picture.y_label)
    taken = sorted({v for stroke in picture.strokes if stroke.steps for v in floats(stroke.y) if np.isfinite(v)})
    if taken:
        axes.set_yticks(taken)
    if picture.labelled:
        axes.set_xticks(list(picture.labelled))
    axes.title.set_fontsize("medium")
    if sum(bool(stroke.label) for stroke in picture.strokes) > 1:
        axes.legend()
    return axes


def curve(axes: Axes, stroke: Stroke, colour: str) -> None:
    """One curve with its band."""
    marker = "o" if stroke.dots else ""
    dash = "" if stroke.dots else "--" if stroke.dashed else "-"
    x, y = floats(stroke.x), floats(stroke.y)
    held = "steps-post" if stroke.steps else "default"
    axes.plot(x, y, color=colour, label=stroke.label, linestyle=dash, marker=marker, markersize=4, drawstyle=held)
    if stroke.low is None or stroke.high is None:
        return
    low, high = floats(stroke.low), floats(stroke.high)
    if stroke.dots:  # nothing lies between them
        axes.vlines(x, low, high, color=colour, linewidth=1.0, alpha=0.6)
    else:
        axes.fill_between(x, low, high, color=colour, alpha=0.2, linewidth=0.0)


def plane(axes: Axes, shown: Plane) -> None:
    """Levels of a plane in decibels below its highest value; what is not positive lies at the floor."""
    values: Any = np.asarray(shown.values, dtype=float)
    top = max(float(values.max()), np.finfo(float).tiny)
    floor = top * 10.0 ** (FLOOR_DB / 10.0)
    level = 10.0 * np.log10(np.maximum(values, floor) / top)
    mesh = axes.pcolormesh(
        floats(shown.x), floats(shown.y), level, shading="nearest", cmap="Blues", vmin=FLOOR_DB, vmax=0.0
    )
    axes.figure.colorbar(mesh, ax=axes, label=f"{shown.label}, dB below its maximum")
