"""Libraries that take long to import and are not always needed: imported when something of them is first asked for."""

from __future__ import annotations

from importlib import import_module
from typing import Any, Final

SIGNAL = "scipy.signal"


class _Signal:
    """``scipy.signal``, which brings ``scipy.stats`` along."""

    def __getattr__(self, name: str) -> Any:
        """What it has under this name."""
        return getattr(import_module(SIGNAL), name)


signal: Final = _Signal()
