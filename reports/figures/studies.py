"""The answers of a study as one figure, a panel for each question."""

from __future__ import annotations

import io
import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING

import matplotlib.style
from matplotlib import pyplot
from matplotlib.axes import Axes
from matplotlib.figure import SubFigure
from matplotlib.ticker import FuncFormatter

from ridgeback.reports.drawing.picture import NO_DATES, RESOLUTION
from ridgeback.reports.drawing.theme import DRAWING
from ridgeback.reports.pictures import draw

if TYPE_CHECKING:
    from ridgeback.common.show.picture import Picture
    from ridgeback.compare.studies.answer import Answer

WIDTH, HEIGHT, LOW = 9.0, 5.0, 2.8
"""Inches of a panel, and the height of one of several beside each other."""
COLUMNS = 3


def plot_file(answers: Sequence[Answer], kind: str) -> bytes:
    """Return the figure as SVG, PNG or PDF.

    Parameters
    ----------
    answers : sequence of Answer
        One panel for each, or one for each thing that it compares.
    kind : {"svg", "png", "pdf"}
        The form of the file.
    """
    with matplotlib.style.context(["default", {**DRAWING, "svg.hashsalt": "ridgeback"}]), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph .* missing from font", category=UserWarning)
        heights = [LOW * -(-len(answer.panels) // COLUMNS) if answer.panels else HEIGHT for answer in answers]
        figure = pyplot.figure(figsize=(WIDTH, sum(heights)), layout="constrained")
        parts = figure.subfigures(len(answers), 1, squeeze=False, height_ratios=heights)
        for answer, part in zip(answers, parts[:, 0], strict=True):
            _drawn(part, answer.panels or (answer.picture(),))
        stream = io.BytesIO()
        figure.savefig(stream, format=kind, metadata=NO_DATES[kind], dpi=RESOLUTION if kind == "png" else 72.0)
        pyplot.close(figure)
    return stream.getvalue()


def _drawn(part: SubFigure, pictures: Sequence[Picture]) -> None:
    """Pictures beside each other on common axes, in rows; one alone takes all the room."""
    columns = min(COLUMNS, len(pictures))
    grid = part.subplots(-(-len(pictures) // columns), columns, squeeze=False, sharex=True, sharey=True)
    for axes, picture in zip(grid.flat, pictures, strict=False):
        draw(picture, axes)
        axes.label_outer()
        if picture.logarithmic:
            axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    for axes in grid.flat[len(pictures) :]:
        axes.set_visible(False)
    _one_legend(part, list(grid.flat[: len(pictures)]))


def _one_legend(part: SubFigure, panels: Sequence[Axes]) -> None:
    """One key below the panels where all have the same."""
    keys = [axes.get_legend() for axes in panels]
    words = {tuple(text.get_text() for text in key.get_texts()) for key in keys if key is not None}
    if len(words) != 1:
        return
    for key in keys:
        if key is not None:
            key.remove()
    part.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=COLUMNS, frameon=False)
