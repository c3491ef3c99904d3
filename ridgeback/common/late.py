"""Modules that take long to import and are not always needed: imported when something of them is first asked for."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import Any


@dataclass(frozen=True)
class Late:
    """A module by its name.

    Examples
    --------
    >>> Late("fractions").Fraction(1, 2)
    Fraction(1, 2)
    """

    name: str

    def __getattr__(self, attribute: str) -> Any:
        """What the module has under this name."""
        return getattr(import_module(self.name), attribute)
