"""Marks of a drawing as SVG text: lines, curves, dots and labels in classes that the page's style sheet colours."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

import numpy as np
from markupsafe import escape

from ridgeback.common.visible import visible
from ridgeback.numeric.arrays import Array

TOLERANCE = 0.25
"""Points of a curve nearer to the line through their neighbours than this, in pixels, are left out."""
MOST = 1400
"""Points of one curve, at most."""


def places(value: float) -> str:
    """A coordinate to a tenth of a pixel.

    >>> places(12.0), places(-0.04), places(3.1415)
    ('12', '0', '3.1')
    """
    text = f"{value:.1f}".removesuffix(".0")
    return "0" if text == "-0" else text


def _class(kind: str) -> str:
    return f' class="{kind}"' if kind else ""


def line(x0: float, y0: float, x1: float, y1: float, kind: str = "g") -> str:
    """A straight line."""
    ends = zip(("x1", "y1", "x2", "y2"), (x0, y0, x1, y1), strict=True)
    return "<line " + " ".join(f'{name}="{places(v)}"' for name, v in ends) + f"{_class(kind)}/>"


def trace(kind: str, *steps: str | float) -> str:
    """A path from its letters and numbers.

    >>> trace("ax", "M", 1, 2.25, "V", 3)
    '<path d="M1 2.2V3" class="ax"/>'
    """
    d = "".join(step if isinstance(step, str) else f" {places(step)}" for step in steps)
    return f'<path d="{re.sub("(?<=[A-Za-z]) ", "", d)}"{_class(kind)}/>'


def rect(x: float, y: float, width: float, height: float, kind: str = "band", more: str = "") -> str:
    """A rectangle; ``more`` holds attributes of our own making."""
    box = f'x="{places(x)}" y="{places(y)}" width="{places(max(width, 0.0))}" height="{places(max(height, 0.0))}"'
    return f"<rect {box}{_class(kind)}{' ' + more if more else ''}/>"


def text(x: float, y: float, words: str, kind: str = "", anchor: str = "start") -> str:
    """A label, escaped.

    >>> text(1, 2, "<b>", "m", "end")
    '<text x="1" y="2" class="m" text-anchor="end">&lt;b&gt;</text>'
    """
    where = "" if anchor == "start" else f' text-anchor="{anchor}"'
    return f'<text x="{places(x)}" y="{places(y)}"{_class(kind)}{where}>{escape(visible(words))}</text>'


def dot(x: float, y: float, radius: float, kind: str, title: str = "") -> str:
    """A filled or open circle, with a title that a pointer at rest shows."""
    head = f'<circle cx="{places(x)}" cy="{places(y)}" r="{places(radius)}"{_class(kind)}'
    return f"{head}><title>{escape(visible(title))}</title></circle>" if title else f"{head}/>"


def group(marks: Iterable[str], kind: str, title: str = "") -> str:
    """Marks that are shown, hidden and coloured together, and read together where they have a title."""
    inside = "".join(marks)
    head = f"<title>{escape(visible(title))}</title>" if title else ""
    return f"<g{_class(kind)}>{head}{inside}</g>" if inside else ""


def curve(x: Array, y: Array, kind: str) -> str:
    """A curve through places in pixels, interrupted where one is not finite; points that add nothing left out.

    >>> curve(np.array([0.0, 1.0, 2.0]), np.array([0.0, 1.0, 2.0]), "el")
    '<path d="M0 0L2 2" class="el"/>'
    """
    d = "".join(_run(x[a:b], y[a:b]) for a, b in _runs(np.isfinite(x) & np.isfinite(y)))
    return f'<path d="{d}"{_class(kind)}/>' if d else ""


def area(x: Array, low: Array, high: Array, kind: str) -> str:
    """The region between two curves, in pieces where one is not finite."""
    parts = []
    for a, b in _runs(np.isfinite(x) & np.isfinite(low) & np.isfinite(high)):
        if b - a > 1:
            there, back = _run(x[a:b], high[a:b]), _run(x[a:b][::-1], low[a:b][::-1])
            parts.append(there + "L" + back[1:] + "z")
    return f'<path d="{"".join(parts)}"{_class(kind)}/>' if parts else ""


def _runs(keep: np.ndarray) -> list[tuple[int, int]]:
    edges = np.flatnonzero(np.diff(np.concatenate(([False], keep, [False])).astype(int)))
    return list(zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True))


def _run(x: Array, y: Array) -> str:
    kept = needed(x, y)
    points = [f"{places(a)} {places(b)}" for a, b in zip(x[kept].tolist(), y[kept].tolist(), strict=True)]
    return "M" + "L".join(points) if points else ""


def needed(x: Array, y: Array) -> Sequence[int]:
    """Indices of the points that a polyline needs to stay within ``TOLERANCE`` (Douglas and Peucker, 1973).

    >>> list(needed(np.arange(5.0), np.array([0.0, 0.0, 3.0, 0.0, 0.0])))
    [0, 1, 2, 3, 4]
    """
    if x.size > MOST:
        picks = np.unique(np.linspace(0, x.size - 1, MOST).round().astype(int))
        return [int(picks[i]) for i in needed(x[picks], y[picks])]
    kept, stack = {0, x.size - 1}, [(0, x.size - 1)]
    while stack:
        a, b = stack.pop()
        if b - a > 1:
            run, rise = x[b] - x[a], y[b] - y[a]
            length = float(np.hypot(run, rise)) or 1.0
            away = np.abs(run * (y[a + 1 : b] - y[a]) - rise * (x[a + 1 : b] - x[a])) / length
            if length == 1.0 and run == rise == 0.0:
                away = np.hypot(x[a + 1 : b] - x[a], y[a + 1 : b] - y[a])
            worst = int(np.argmax(away))
            if away[worst] > TOLERANCE:
                middle = a + 1 + worst
                kept.add(middle)
                stack += [(a, middle), (middle, b)]
    return sorted(kept)


def drawing(width: float, height: float, name: str, label: str, marks: Iterable[str]) -> str:
    """One ``<svg>``: ``name`` is its variant on the page, ``label`` what it shows, for those who do not see it."""
    box = f'viewBox="0 0 {places(width)} {places(height)}"'
    return f'<svg class="{name}" {box} role="img" aria-label="{escape(label)}">{"".join(marks)}</svg>'
