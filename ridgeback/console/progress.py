"""What is being done, on standard error, and only when somebody is looking at it."""

from __future__ import annotations

import shutil
import sys
import time
from contextlib import suppress
from types import TracebackType
from typing import TextIO

from ridgeback.common.progress import is_terminal


class Progress:
    """One line on a terminal that says which step runs; silent when standard error is a file or a pipe.

    Calling it with a fraction from 0 to 1 and the name of the step is all that a caller does.

    >>> with Progress(stream=None) as progress:
    ...     progress(0.5, "Wigner distribution")
    """

    def __init__(self, stream: TextIO | None = sys.stderr) -> None:
        self.stream = stream if stream is not None and is_terminal(stream) else None
        self.started = time.monotonic()

    def __call__(self, fraction: float, step: str) -> None:
        """Show the step, and how far the whole work is."""
        share = min(max(fraction, 0.0), 1.0)
        self.show(f"{time.monotonic() - self.started:5.1f} s {share:4.0%}  {step}")

    def show(self, text: str) -> None:
        """Put the text in the place of the line before, cut to the width of the terminal."""
        if self.stream is not None:
            width = shutil.get_terminal_size().columns - 1
            with suppress(OSError, ValueError):
                self.stream.write(f"\r\x1b[2K{text[:width]}")
                self.stream.flush()

    def __enter__(self) -> Progress:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, where: TracebackType | None
    ) -> None:
        self.show("")
