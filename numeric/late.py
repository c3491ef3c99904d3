"""Libraries that take long to import and are not always needed: imported when something of them is first asked for."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any, Final

SIGNAL = "scipy.signal"
WAV = "scipy.io.wavfile"


class _Late:
    """A library under its name."""

    def __init__(self, load: Callable[[], object]) -> None:
        self._load = load

    def __getattr__(self, name: str) -> Any:
        """What it has under this name."""
        return getattr(self._load(), name)


signal: Final = _Late(lambda: import_module(SIGNAL))
"""``scipy.signal``, which brings ``scipy.stats`` along."""
wavfile: Final = _Late(lambda: import_module(WAV))
"""``scipy.io.wavfile``, which brings all of ``scipy.io``."""
