"""Stages of a long computation: how far it is, and how long each took."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from ridgeback.common.progress import Progress


@dataclass(frozen=True)
class Stages:
    """Times the stages of a report and passes their progress on."""

    progress: Progress
    seconds: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def stage(self, name: str, low: float, high: float) -> Iterator[Progress]:
        """Yield a progress callback that runs from ``low`` to ``high`` of the whole."""
        self.progress(low, name)
        began = time.perf_counter()
        yield lambda fraction, label: self.progress(low + fraction * (high - low), label)
        self.seconds[name] = round(time.perf_counter() - began, 3)
