"""A figure as the page receives it: both drawings, caption, toggles, key, and the data of its readout."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import matplotlib.style
import numpy as np

from ridgeback.numeric.arrays import Array
from ridgeback.reports.drawing.canvas import Canvas, Trace
from ridgeback.reports.drawing.svg import to_svg
from ridgeback.reports.drawing.theme import DRAWING, NARROW, WIDE, Variant

READOUT_POINTS = 400


@dataclass(frozen=True)
class Readout:
    """What the crosshair shows: the quantity along x, and curves by panel; figures with one ``link`` move together."""

    x_name: str
    x_unit: str
    y_unit: str
    traces: tuple[Trace, ...]
    link: str = ""


@dataclass(frozen=True)
class Toggle:
    """A check box that shows or hides everything of one class."""

    style: str
    label: str
    token: str
    shown: bool = True


@dataclass(frozen=True)
class Key:
    """One swatch of a key, with its printed meaning."""

    token: str
    text: str


@dataclass(frozen=True)
class Block:
    """One finished figure."""

    key: str
    title: str
    caption: str
    wide: str
    narrow: str
    toggles: tuple[Toggle, ...] = ()
    keys: tuple[Key, ...] = ()
    data: dict[str, object] | None = None


def block(
    key: str,
    *,
    title: str,
    description: str,
    caption: str,
    draw: Callable[[Canvas], None],
    readout: Readout | None = None,
    toggles: Iterable[Toggle] = (),
    keys: Iterable[Key] = (),
    heights: tuple[float, float] = (WIDE.height, NARROW.height),
) -> Block:
    """Draw a figure twice, wide and narrow, and gather what the page needs of it."""
    canvases, drawings = [], []
    with matplotlib.style.context(["default", dict(DRAWING)]), warnings.catch_warnings():
        # A letter that the measuring font lacks is measured as a box; the browser has other fonts to draw it with.
        warnings.filterwarnings("ignore", message="Glyph .* missing from font", category=UserWarning)
        for variant, height in zip((WIDE, NARROW), heights, strict=True):
            canvas = _drawn(variant, height, draw)
            canvases.append(canvas)
            drawings.append(to_svg(canvas, prefix=f"{key}-{variant.name[0]}", title=title, description=description))
    data = _readout_data(readout, canvases) if readout and readout.traces else None
    return Block(key, title, caption, drawings[0], drawings[1], tuple(toggles), tuple(keys), data)


def _drawn(variant: Variant, height: float, draw: Callable[[Canvas], None]) -> Canvas:
    canvas = Canvas(variant, height)
    draw(canvas)
    return canvas


def _readout_data(readout: Readout, canvases: Sequence[Canvas]) -> dict[str, object]:
    shared: list[list[float | None]] = []
    series = []
    for trace in readout.traces:
        x, y = _thinned(trace.x, trace.y)
        if x not in shared:
            shared.append(x)
        series.append(
            {
                "n": trace.label,
                "c": trace.style,
                "t": trace.token,
                "p": trace.panel,
                "x": shared.index(x),
                "y": y,
            }
        )
    return {
        "xn": readout.x_name,
        "xu": readout.x_unit,
        "yu": readout.y_unit,
        "link": readout.link,
        "xs": shared,
        "series": series,
        "axes": {c.variant.name: [_axes_data(c, i) for i in range(len(c.panels))] for c in canvases},
    }


def _axes_data(canvas: Canvas, index: int) -> dict[str, object]:
    axes = canvas.panels[index]
    return {
        "box": [round(v, 2) for v in canvas.box(axes)],
        "x": [float(v) for v in axes.get_xlim()],
        "y": [float(v) for v in axes.get_ylim()],
        "lx": int(axes.get_xscale() == "log"),
        "ly": int(axes.get_yscale() == "log"),
    }


def _thinned(x: Array, y: Array) -> tuple[list[float | None], list[float | None]]:
    step = max(1, -(-x.size // READOUT_POINTS))
    return _short(x[::step]), _short(y[::step])


def _short(values: Array) -> list[float | None]:
    return [float(f"{v:.5g}") if np.isfinite(v) else None for v in values]
