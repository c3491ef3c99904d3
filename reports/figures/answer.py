"""A result's own picture in the style of the page: curves with their names at the side, or small ones side by side."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ridgeback.common.numbers import number, power_of_ten
from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.numeric.arrays import Array, floats
from ridgeback.reports.drawing.apart import apart, text_width
from ridgeback.reports.drawing.figure import NARROW, WIDE, Figure, Series, readout, switched, switches
from ridgeback.reports.drawing.marks import area, dot, drawing, line, text
from ridgeback.reports.drawing.panel import Panel
from ridgeback.reports.drawing.scale import Scale, padded, tick_labels

STYLES = tuple(f"{way}l {dash} nf".replace("  ", " ") for dash in ("", "d1", "d2", "d3") for way in "est")
"""Curves in the order in which they are told apart: three colours, then dashes."""
WIDE_SPAN = 30.0
"""Ratio of largest to smallest from which on an axis of positive values goes by decades."""
LEAST = 1e-17
MOST_READ = 60
"""Points of a curve that are read one by one, at most."""
SMALL = 300.0
"""Width of a small drawing's key."""
MOST_NAMES = 430.0
"""Pixels that names at the side take at most."""
FEW_DECADES = 3


@dataclass(frozen=True)
class Axes:
    """Ranges that panels share."""

    x: tuple[float, float]
    y: tuple[float, float]
    log_x: bool
    log_y: bool
    steps: tuple[int, ...] = ()
    """The whole numbers that curves of steps take."""
    labelled: tuple[float, ...] = ()
    """Where the horizontal axis is labelled, if that is given."""


def axes_of(pictures: Sequence[Picture]) -> Axes:
    """Ranges around all curves of some pictures.

    >>> axes_of([Picture("", "", "", (Stroke([1.0, 100.0], [1e-3, 1e-1]),), None, True)]).log_x
    True
    """
    strokes = [stroke for picture in pictures for stroke in picture.strokes]
    x, y = ([floats(getattr(stroke, name)) for stroke in strokes] for name in ("x", "y"))
    y += [floats(end) for stroke in strokes if stroke.dots for end in (stroke.low, stroke.high) if end is not None]
    log_y = any(picture.logarithmic for picture in pictures)
    low, high = padded(x, share=0.0)
    log_x = low > 0 and high / low > WIDE_SPAN
    taken = {int(v) for stroke in strokes if stroke.steps for v in floats(stroke.y) if np.isfinite(v)}
    across = (low, high) if high > low else (low - 0.5, high + 0.5)
    if any(stroke.dots for stroke in strokes) and not log_x:
        across = padded(x, share=0.05)
    labelled = tuple(sorted({value for picture in pictures for value in picture.labelled}))
    return Axes(across, _range(y, log_y), log_x, log_y, tuple(sorted(taken)), labelled)


def _range(values: Sequence[Array], log: bool) -> tuple[float, float]:
    if not log:
        return padded(values, share=0.06)
    kept = np.concatenate([v[np.isfinite(v) & (v > LEAST)] for v in values] or [np.array([1.0])])
    if not kept.size:
        return 0.1, 1.0
    low, high = float(kept.min()), float(kept.max())
    room = max((high / low) ** 0.06, 1.5)
    return low / room, high * room


def _panel(axes: Axes, left: float, right: float, top: float, bottom: float) -> Panel:
    return Panel(Scale(*axes.x, left, right, log=axes.log_x), Scale(*axes.y, bottom, top, log=axes.log_y))


def _ticks(scale: Scale, most: int) -> list[tuple[float, str]]:
    """Where an axis is labelled, and how: powers of ten over many decades, 1, 2 and 5 over few."""
    if not scale.log:
        values = scale.ticks(most)
        return list(zip(values, tick_labels(values), strict=True))
    first, last = int(np.floor(np.log10(scale.low))), int(np.ceil(np.log10(scale.high)))
    if last - first > FEW_DECADES:
        return [(value, power_of_ten(round(np.log10(value)))) for value in scale.ticks(most)]
    values = tuple(m * 10.0**n for n in range(first, last + 1) for m in (1, 2, 5))
    return [(value, number(value, 1)) for value in values if scale.low <= value <= scale.high]


def _frame(panel: Panel, axes: Axes, *, most: int, rows: int) -> list[str]:
    marks = []
    whole = [(float(n), str(n)) for n in axes.steps]
    for value, name in whole or _ticks(panel.y, rows):
        y = panel.y(value)
        marks.append(line(panel.left, y, panel.right, y) + text(panel.left - 6, y + 4, name, "m sm", "end"))
    marks.append(line(panel.left, panel.bottom, panel.right, panel.bottom, "ax"))
    for value, name in [(v, number(v)) for v in axes.labelled if panel.x.low <= v <= panel.x.high] or _ticks(
        panel.x, most
    ):
        x = panel.x(value)
        marks.append(line(x, panel.bottom, x, panel.bottom + 4, "ax"))
        marks.append(text(x, panel.bottom + 18, name, "m sm", "middle"))
    return marks


def _strokes(panel: Panel, picture: Picture) -> list[str]:
    strokes = enumerate(zip(picture.strokes, STYLES * 4, strict=False))
    return [switched(i, *_stroke(panel, stroke, style)) for i, (stroke, style) in strokes]


def _stroke(panel: Panel, stroke: Stroke, style: str) -> Iterator[str]:
    """A curve with its band, or dots with their bars."""
    x, y = floats(stroke.x), floats(stroke.y)
    x, y = (np.repeat(x, 2)[1:], np.repeat(y, 2)[:-1]) if stroke.steps else (x, y)
    if stroke.low is not None and stroke.high is not None:
        low, high = (panel.y.clipped(floats(end)) for end in (stroke.low, stroke.high))
        across = panel.x.of(x)
        if stroke.dots:
            yield from (line(a, b, a, c, f"{style[0]}k") for a, b, c in zip(across, low, high, strict=True))
        else:
            yield area(across, low, high, f"{style[0]}f")
    shown = np.where((y >= panel.y.low) & (y <= panel.y.high), y, np.nan)
    if not stroke.dots:
        yield panel.curve(x, shown, style)
    if stroke.dots or np.isfinite(shown).sum() < 12:
        at = zip(panel.x.of(x).tolist(), panel.y.of(shown).tolist(), strict=True)
        yield from (dot(a, b, 3.0, _filled(style)) for a, b in at if np.isfinite(a) and np.isfinite(b))


def answer_figure(key: str, picture: Picture, caption: str = "", table: str = "") -> Figure | None:
    """One picture, wide and narrow; None where it holds no curve.

    Parameters
    ----------
    key
        Id of the figure.
    picture
        Curves over named axes.
    caption
        Below it; by default the picture's title.
    table
        Id of the table that holds the numbers.
    """
    if not any(np.isfinite(floats(stroke.y)).any() for stroke in picture.strokes):
        return None
    axes = axes_of([picture])
    names = max((text_width(stroke.label) for stroke in picture.strokes), default=0.0) + 34
    wide = _panel(axes, 70.0, WIDE - min(names, MOST_NAMES) - 10, 30.0, 300.0)
    narrow = _panel(axes, 52.0, 356.0, 30.0, 250.0)
    label = f"{picture.y_label} against {picture.x_label}"
    series = [Series(s.label, floats(s.x), floats(s.y), steps=s.steps) for s in picture.strokes]
    return Figure(
        key=key,
        wide=drawing(WIDE, 344, "wide", label, [*_whole(wide, axes, picture, 8), *_beside(wide, picture)]),
        narrow=drawing(
            NARROW,
            300 + 17 * len(picture.strokes),
            "narrow",
            label,
            [*_whole(narrow, axes, picture, 4), *_below(narrow, picture)],
        ),
        caption=caption or picture.title,
        toggles=switches([stroke.label for stroke in picture.strokes]),
        data=readout(((wide,), (narrow,)), series, name=picture.x_label, unit="", link=""),
        label=label,
        table=table,
    )


def _whole(panel: Panel, axes: Axes, picture: Picture, most: int) -> list[str]:
    marks = [*_frame(panel, axes, most=most, rows=7), *_strokes(panel, picture)]
    marks.append(text(0, 12, picture.y_label, "m"))
    marks.append(text(panel.right, panel.bottom + 36, picture.x_label, "m", "end"))
    return marks


def _last(panel: Panel, stroke: Stroke) -> float:
    y = floats(stroke.y)
    kept = y[np.isfinite(y)]
    return float(panel.y.clipped(kept[-1:])[0]) if kept.size else panel.bottom


def _beside(panel: Panel, picture: Picture) -> list[str]:
    heights = apart([_last(panel, stroke) for stroke in picture.strokes], 17.0, panel.top, panel.bottom)
    marks = []
    for stroke, style, height in zip(picture.strokes, STYLES * 4, heights, strict=False):
        marks.append(_sample(stroke, style, panel.right + 8, height))
        marks.append(text(panel.right + 34, height + 4, stroke.label, "sm"))
    return marks


def _below(panel: Panel, picture: Picture) -> list[str]:
    marks = []
    for i, (stroke, style) in enumerate(zip(picture.strokes, STYLES * 4, strict=False)):
        y = panel.bottom + 56 + 17 * i
        marks.append(_sample(stroke, style, 4.0, y) + text(32, y + 4, stroke.label, "sm"))
    return marks


def _filled(style: str) -> str:
    """The class of a curve's dots: open where the curve would be dashed.

    >>> _filled("el nf"), _filled("el d1 nf")
    ('e', 'eo')
    """
    return f"{style[0]}o" if " d" in style else style[0]


def _sample(stroke: Stroke, style: str, x: float, y: float) -> str:
    """What stands before a name: a piece of the curve, or one of its dots."""
    return dot(x + 10, y, 3.0, _filled(style)) if stroke.dots else line(x, y, x + 20, y, style)


def side_by_side(key: str, pictures: Sequence[Picture], caption: str, table: str = "") -> Figure:
    """Small drawings that share their axes, so that they compare.

    Parameters
    ----------
    key
        Id of the figure.
    pictures
        One for each thing that is compared.
    caption
        Below them.
    table
        Id of the table that holds the numbers.
    """
    axes = axes_of(pictures)
    lines = 1 + max((row for picture in pictures for _, row in _key(picture)), default=0)
    return Figure(
        key=key,
        wide="".join(_small(picture, axes, lines) for picture in pictures),
        narrow="",
        caption=caption,
        toggles=switches([stroke.label for stroke in pictures[0].strokes]) if _alike(pictures) else (),
        many="three",
        label=caption,
        table=table,
    )


def _alike(pictures: Sequence[Picture]) -> bool:
    """Whether all have the same curves by name, so that one check box serves all."""
    return len({tuple(stroke.label for stroke in picture.strokes) for picture in pictures}) == 1


def _points(panel: Panel, picture: Picture) -> list[str]:
    """Unseen marks at the points of the curves, which a pointer reads: what was computed, nothing between."""
    return [switched(i, *_unseen(panel, picture, stroke)) for i, stroke in enumerate(picture.strokes)]


def _unseen(panel: Panel, picture: Picture, stroke: Stroke) -> Iterator[str]:
    x, y = floats(stroke.x), floats(stroke.y)
    kept = np.flatnonzero(np.isfinite(x) & np.isfinite(y) & (y >= panel.y.low) & (y <= panel.y.high))
    for i in kept[np.unique(np.linspace(0, kept.size - 1, min(kept.size, MOST_READ)).round().astype(int))]:
        said = f"{picture.y_label} {number(float(y[i]), 3)} at {picture.x_label} {number(float(x[i]), 3)}"
        where = f"{picture.title}, {stroke.label}" if stroke.label else picture.title
        yield dot(panel.x(float(x[i])), panel.y(float(y[i])), 3.0, "unseen", f"{where}: {said}")


def _key(picture: Picture) -> list[tuple[float, int]]:
    """Where each name of a small drawing begins: its x and its line."""
    found, x, row = [], 0.0, 0
    for stroke in picture.strokes[:6]:
        width = text_width(stroke.label, 13.0) + 36
        if x + width > SMALL and x > 0.0:
            x, row = 0.0, row + 1
        found.append((x, row))
        x += width
    return found


def _small(picture: Picture, axes: Axes, lines: int) -> str:
    """One of several, its key in ``lines`` lines between its title and its curves, the name of its values below."""
    top = 46.0 + 15.0 * lines
    panel = _panel(axes, 46.0, 300.0, top, top + 174.0)
    marks = [text(0, 14, picture.title, "fgt b"), text(0, top - 10, picture.y_label, "m sm")]
    marks += _frame(panel, axes, most=4, rows=5)
    marks += [*_strokes(panel, picture), *_points(panel, picture)]
    marks.append(text(panel.right, panel.bottom + 32, picture.x_label, "m sm", "end"))
    for stroke, style, (x, row) in zip(picture.strokes, STYLES, _key(picture), strict=False):
        y = 30.0 + 15.0 * row
        marks.append(line(x, y, x + 18, y, style) + text(x + 23, y + 4, stroke.label, "sm"))
    return drawing(
        308, panel.bottom + 38, "one", f"{picture.title}: {picture.y_label} against {picture.x_label}", marks
    )
