"""How long work says how far it is: a function of the share that is done and the name of the step."""

from __future__ import annotations

from collections.abc import Callable

Progress = Callable[[float, str], None]
"""Told the share of the work that is done, 0 to 1, and the name of the step."""


def silent(_: float, __: str) -> None:
    """Report no progress."""
