"""The answers of a study as one figure, a panel for each question."""

from __future__ import annotations

import io
import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING

import matplotlib.style
from matplotlib import pyplot
from matplotlib.ticker import FuncFormatter

from ridgeback.reports.drawing.picture import NO_DATES, RESOLUTION
from ridgeback.reports.drawing.theme import DRAWING
from ridgeback.reports.pictures import draw

if TYPE_CHECKING:
    from ridgeback.compare.studies.answer import Answer

WIDTH, HEIGHT = 9.0, 5.0
"""Inches of a panel."""


def plot_file(answers: Sequence[Answer], kind: str) -> bytes:
    """Return the figure as SVG, PNG or PDF.

    Parameters
    ----------
    answers : sequence of Answer
        One panel for each.
    kind : {"svg", "png", "pdf"}
        The form of the file.
    """
    with matplotlib.style.context(["default", {**DRAWING, "svg.hashsalt": "ridgeback"}]), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph .* missing from font", category=UserWarning)
        figure, panels = pyplot.subplots(
            len(answers), 1, figsize=(WIDTH, HEIGHT * len(answers)), layout="constrained", squeeze=False
        )
        for answer, axes in zip(answers, panels[:, 0], strict=True):
            draw(answer.picture(), axes)
            if answer.picture().logarithmic:
                axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        stream = io.BytesIO()
        figure.savefig(stream, format=kind, metadata=NO_DATES[kind], dpi=RESOLUTION if kind == "png" else 72.0)
        pyplot.close(figure)
    return stream.getvalue()
