"""A figure as the page takes it: a wide and a narrow drawing, what can be switched, and what a pointer reads."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from ridgeback.numeric.arrays import Array
from ridgeback.reports.drawing.marks import group
from ridgeback.reports.drawing.panel import Panel

WIDE, NARROW = 1000.0, 368.0
"""Widths of the two drawings, in pixels of the page at its widest and on a phone."""
READ, FINE = 161, 641
"""Places at which a slow curve is read, and one that oscillates."""
SWITCHED = 12
"""Series of a figure that have a check box, at most."""
WAYS: Mapping[str, str] = {"E": "expansions", "S": "series model", "T": "estimates"}


@dataclass(frozen=True)
class Series:
    """One curve as the readout knows it: ``per_cent`` writes values as relative errors, ``steps`` holds each one."""

    name: str
    x: Array
    y: Array
    unit: str = ""
    per_cent: bool = False
    steps: bool = False


@dataclass(frozen=True)
class Figure:
    """Drawings, caption and data of one figure."""

    key: str
    wide: str
    narrow: str
    caption: str
    toggles: tuple[tuple[str, str], ...] = ()
    """Letter of a family and its label."""
    keys: tuple[tuple[str, str], ...] = ()
    """Colour token and its meaning, below the drawing."""
    data: Mapping[str, object] = field(default_factory=dict)
    """For the readout; empty without one."""
    label: str = ""
    many: str = ""
    """Class of a row of small drawings: ``two``, ``five``; they stand in ``wide``."""
    table: str = ""
    """Id of the table that holds the figure's numbers, where its data do not."""
    leads: tuple[str, str] = ("", "")
    """What stands before the caption, where the two drawings are read differently: of the wide one, of the narrow."""

    @property
    def boxes(self) -> tuple[tuple[str, str], ...]:
        """The check boxes of what is drawn."""
        return tuple(box for box in self.toggles if f'class="f{box[0]}"' in self.wide)

    @property
    def told(self) -> bool:
        """Whether its marks are read one by one, by their titles, as no curves are read at a common place."""
        return not self.data and "<title>" in self.wide


def readout(
    panels: tuple[Sequence[Panel], Sequence[Panel]],
    series: Sequence[Series],
    *,
    name: str,
    unit: str,
    link: str,
    places: int = READ,
) -> dict[str, object]:
    """What the page's script needs to read curves at a common x: places of the panels, and the curves' values.

    Parameters
    ----------
    panels
        Those of the wide drawing and those of the narrow one, which share the x axis.
    series
        Curves; each is read by interpolation at common places, and not where it is not finite.
    name, unit
        Of the x axis.
    link
        Figures with the same word move together.
    places
        How many places are read.
    """
    x = panels[0][0].x
    low, high = (math.log10(end) if x.log else end for end in (x.low, x.high))
    grid = np.linspace(low, high, places)
    at = 10.0**grid if x.log else grid
    boxes = [[panel.box() for panel in group] for group in panels]
    if x.log:
        boxes = [[[*box[:4], low, high, *box[6:]] for box in group] for group in boxes]
    return {
        "name": name,
        "unit": unit,
        "link": link,
        "at": [float(f"{v:.5g}") for v in grid],
        "boxes": boxes,
        **({"log": True} if x.log else {}),
        "series": [[s.name, "%" if s.per_cent else s.unit, _read(s, at)] for s in series],
    }


def _read(series: Series, places: Array) -> list[float | None]:
    good = np.isfinite(series.x) & np.isfinite(series.y)
    if good.sum() < 2:
        return [None] * places.size
    x, y = series.x[good], series.y[good]
    reach = 2.0 * float(np.median(np.diff(x))) + (places[1] - places[0])
    held = y[np.clip(np.searchsorted(x, places, side="right") - 1, 0, x.size - 1)]
    near = np.abs(x[np.clip(np.searchsorted(x, places), 0, x.size - 1)] - places)
    before = np.abs(x[np.clip(np.searchsorted(x, places) - 1, 0, x.size - 1)] - places)
    inside = (np.minimum(near, before) <= reach) & (places >= x[0] - reach) & (places <= x[-1] + reach)
    values = held if series.steps else np.interp(places, x, y)
    digits = 3 if series.per_cent else 6
    return [float(f"{v:.{digits}g}") if keep else None for v, keep in zip(values, inside, strict=True)]


def switches(names: Sequence[str]) -> tuple[tuple[str, str], ...]:
    """Check boxes for the series of a figure, in their order; none where there is but one.

    >>> switches(["samples", "fit"]), switches(["samples"])
    ((('1', 'samples'), ('2', 'fit')), ())
    """
    return tuple((str(i), name) for i, name in enumerate(names[:SWITCHED], 1)) if len(names) > 1 else ()


def switched(i: int, *marks: str) -> str:
    """The marks of the i-th series, from 0, which its check box hides."""
    return group(marks, f"f{i + 1}")


def toggles(*letters: str, series: bool = True) -> tuple[tuple[str, str], ...]:
    """Check boxes for some of the three ways; without the paper's series the second holds models of other kinds.

    >>> toggles("E", "S", series=False)
    (('E', 'expansions'), ('S', 'models'))
    """
    names = {**WAYS, "S": WAYS["S"] if series else "models"}
    return tuple((letter, names[letter]) for letter in letters)
