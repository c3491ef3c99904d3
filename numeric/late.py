"""Libraries that take long to import and are not always needed: imported when something of them is first asked for."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any, Final


class _Late:
    """A library, known by the function that imports it."""

    def __init__(self, load: Callable[[], object]) -> None:
        self._load = load

    def __getattr__(self, name: str) -> Any:
        """What it has under this name."""
        return getattr(self._load(), name)


def _scipy_signal() -> object:
    return import_module("scipy.signal")


def _scipy_wavfile() -> object:
    return import_module("scipy.io.wavfile")


signal: Final = _Late(_scipy_signal)
"""``scipy.signal``, which brings ``scipy.stats`` along."""
wavfile: Final = _Late(_scipy_wavfile)
"""``scipy.io.wavfile``, which brings all of ``scipy.io``."""
