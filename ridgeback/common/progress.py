"""How long work says how far it is: a function of the share that is done and the name of the step, or a bar."""

from __future__ import annotations

import shutil
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import TextIO, TypeAlias

Progress = Callable[[float, str], None]
"""Told the share of the work that is done, 0 to 1, and the name of the step."""
Wanted: TypeAlias = "Progress | bool | None"
"""A function of one's own, True for a bar, False or None for silence."""
CELLS = 24
"""Length of the bar."""


def silent(_: float, __: str) -> None:
    """Report no progress."""


def within(progress: Progress, low: float, high: float) -> Progress:
    """What a part of the work tells, as the shares ``low`` to ``high`` of the whole.

    >>> within(lambda share, step: print(f"{share:.2f} {step}"), 0.5, 1.0)(0.5, "order 4")
    0.75 order 4
    """
    return lambda share, step: progress(low + share * (high - low), step)


class Bar:
    """A bar in one line of a terminal or a notebook; nothing where the stream is a file or a pipe.

    >>> from io import StringIO
    >>> nobody_looks = StringIO()
    >>> Bar(nobody_looks)(0.5, "Wigner distribution")
    >>> nobody_looks.getvalue()
    ''
    """

    def __init__(self, stream: TextIO | None = None) -> None:
        self.stream = sys.stderr if stream is None else stream
        self.seen = is_terminal(self.stream) or is_notebook(self.stream)
        self.started, self.width = time.monotonic(), 0

    def __call__(self, fraction: float, step: str) -> None:
        """Show the step, and how far the whole work is."""
        self.show(bar_text(fraction, step, time.monotonic() - self.started))

    def show(self, text: str) -> None:
        """Put the text in the place of the line before, which blanks cover: a notebook knows no other way."""
        if not self.seen:
            return
        text = text[: shutil.get_terminal_size().columns - 1]
        with suppress(OSError, ValueError):
            self.stream.write("\r" + text.ljust(self.width))
            self.stream.flush()
        self.width = len(text)

    def close(self) -> None:
        """Leave the line empty."""
        self.show("")
        if self.seen:
            with suppress(OSError, ValueError):
                self.stream.write("\r")
                self.stream.flush()


def bar_text(fraction: float, step: str, seconds: float) -> str:
    """One line: the bar, the share, the time so far, the step.

    >>> bar_text(0.5, "orders", 3.0)
    '[############------------]  50%    3.0 s  orders'
    """
    share = min(max(fraction, 0.0), 1.0)
    done = round(share * CELLS)
    return f"[{'#' * done}{'-' * (CELLS - done)}] {share:4.0%} {seconds:6.1f} s  {step}"


def is_terminal(stream: TextIO) -> bool:
    """Whether somebody is looking; a closed stream has no viewer."""
    try:
        return stream.isatty()
    except (OSError, ValueError, AttributeError):
        return False


def is_notebook(stream: object) -> bool:
    """Whether the stream is that of a notebook's kernel, which shows carriage returns as a terminal does."""
    return type(stream).__module__.partition(".")[0] == "ipykernel"


@contextmanager
def showing(wanted: Wanted) -> Iterator[Progress]:
    """The function to tell: one's own, a bar that is cleared in the end, or silence.

    >>> with showing(None) as progress:
    ...     progress(0.5, "halfway")
    """
    if callable(wanted):
        yield wanted
    elif wanted:
        bar = Bar()
        try:
            yield bar
        finally:
            bar.close()
    else:
        yield silent


@contextmanager
def step(name: str) -> Iterator[Progress]:
    """A bar that is told the name of the first step, or of all the work where that cannot say how far it is.

    >>> with step("figure") as progress:
    ...     progress(1.0, "figure")
    """
    with showing(True) as progress:
        progress(0.0, name)
        yield progress
