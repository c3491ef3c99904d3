"""What a result would have drawn of itself: plain numbers, named, without a word on how they are drawn.

The rooms that compute know no plotting library; ``ridgeback.reports`` draws a :class:`Picture` when it is asked to.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from importlib import import_module
from typing import Any

DRAWER = "ridgeback.reports.pictures"
"""The module that draws pictures.  It is named here and imported only when a picture is drawn."""


@dataclass(frozen=True)
class Stroke:
    """One curve: points ``x, y`` of equal length, its label, and the ends of a band about it where there is one.

    ``steps`` holds each value as far as the next point: whole numbers, between which there is nothing.
    """

    x: Collection[float]
    y: Collection[float]
    label: str = ""
    low: Collection[float] | None = None
    high: Collection[float] | None = None
    dashed: bool = False
    dots: bool = False
    steps: bool = False


@dataclass(frozen=True)
class Plane:
    """Values ``values[i][j]`` over ``y[i]`` and ``x[j]``."""

    x: Collection[float]
    y: Collection[float]
    values: Any
    label: str = ""


@dataclass(frozen=True)
class Picture:
    """Curves, or a plane, over named axes with their units."""

    title: str
    x_label: str
    y_label: str
    strokes: tuple[Stroke, ...] = ()
    plane: Plane | None = None
    logarithmic: bool = False
    """Whether the vertical axis is."""
    labelled: Collection[float] = ()
    """Where the horizontal axis is labelled; of itself where none is given."""


def drawn(picture: Picture, ax: Any = None) -> Any:
    """Draw a picture on matplotlib axes, new ones where none are given, and return them."""
    return import_module(DRAWER).draw(picture, ax)
