"""A figure as a file that stands by itself: SVG, PNG or PDF, in the light page's colours, without dates."""

from __future__ import annotations

import io
import re
import warnings
from collections.abc import Callable

import matplotlib.style
from matplotlib.text import Text

from ridgeback.common.visible import visible
from ridgeback.reports.drawing.canvas import Canvas
from ridgeback.reports.drawing.theme import DRAWING, colour_of

RESOLUTION = 160.0
NO_DATES = {
    "svg": dict.fromkeys(("Creator", "Date", "Format", "Type")),
    "pdf": {"Creator": None, "Producer": None, "CreationDate": None},
    "png": {"Software": None},
}


def picture(drawn: Callable[[], Canvas], kind: str) -> bytes:
    """Return what ``drawn`` draws as SVG, PNG or PDF, on a background of its own."""
    with matplotlib.style.context(["default", dict(DRAWING)]), warnings.catch_warnings():
        # A unit may hold a letter that the font lacks: it is drawn as a box, which is no reason to fail.
        warnings.filterwarnings("ignore", message="Glyph .* missing from font", category=UserWarning)
        canvas = drawn()
        show_plainly(canvas)
        canvas.figure.patch.set_visible(True)
        canvas.figure.patch.set_facecolor(colour_of("bg"))
        stream = io.BytesIO()
        dpi = RESOLUTION if kind == "png" else 72.0
        canvas.figure.savefig(stream, format=kind, metadata=NO_DATES[kind], dpi=dpi)
    data = stream.getvalue()
    return without_classes(data) if kind == "svg" else data


def show_plainly(canvas: Canvas) -> None:
    """Write characters of names that act, or that no file of the kind can hold, as their escapes."""
    for text in canvas.figure.findobj(Text):
        text.set_text(visible(text.get_text()))


def without_classes(data: bytes) -> bytes:
    """Ids that name classes for a page's style sheet have no meaning in a picture, and are not unique."""
    return re.sub(rb' id="class:[^"]*"', b"", data)
