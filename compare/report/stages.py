"""Stages of a long computation: how far it is, and how long each took."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager

from ridgeback.common.progress import Progress, within


class Stopwatch:
    """Times the stages of a report and passes their progress on.

    >>> watch = Stopwatch(lambda share, step: print(f"{share:.2f} {step}"))
    >>> with watch.stage("deriving", 0.0, 0.5) as inner:
    ...     inner(0.5, "order 4")
    0.00 deriving
    0.25 order 4
    >>> list(watch.seconds())
    ['deriving']
    """

    def __init__(self, progress: Progress) -> None:
        self._progress = progress
        self._seconds: dict[str, float] = {}

    @contextmanager
    def stage(self, name: str, low: float, high: float) -> Iterator[Progress]:
        """Yield a progress callback that runs from ``low`` to ``high`` of the whole."""
        self._progress(low, name)
        began = time.perf_counter()
        yield within(self._progress, low, high)
        self._seconds[name] = round(time.perf_counter() - began, 3)

    def seconds(self) -> dict[str, float]:
        """How long each finished stage took, in the order in which they ended."""
        return dict(self._seconds)
