"""What every reader of a file hands over: named columns, read when they are asked for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ridgeback.numeric.arrays import Array

FILE_BUDGET = 1_000_000_000
"""Bytes that a file, unpacked, may hold."""


@dataclass(frozen=True)
class Columns:
    """Named columns of a file, ``sizes`` rows each; ``rate`` is what the file itself states, else None.

    ``values(i)`` gives the numbers of column i, missing ones as NaN; ``place(row)`` says where a row is.
    """

    names: tuple[str, ...]
    sizes: tuple[int, ...]
    values: Callable[[int], Array]
    place: Callable[[int], str]
    source: str
    rate: float | None = None
    units: str = ""
    note: str = ""
