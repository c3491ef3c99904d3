"""Numbers of one column padded so that they stand under one another at the decimal point."""

from __future__ import annotations

import re
from collections.abc import Sequence

POINT, DIGIT = "\u2008", "\u2007"
"""Spaces as wide as a full stop and as a digit where numerals are tabular."""
_NUMBER = re.compile(r"^([+−]?\d+)(?:\.(\d+))?((?: %| [^\d×]{1,6})?)((?: \([^)]*\))?)$")


def aligned(cells: Sequence[str]) -> tuple[str, ...]:
    """Pad decimals of right-aligned cells; what is no plain number, or has a power of ten, stays as it is.

    >>> [cell.replace(POINT, "_").replace(DIGIT, "_") for cell in aligned(["0.25 %", "23 %", "–"])]
    ['0.25 %', '23___ %', '–']
    """
    parts = [_NUMBER.match(cell) for cell in cells]
    most = max((len(part[2]) for part in parts if part and part[2]), default=0)
    return tuple(cell if part is None else _padded(part, most) for cell, part in zip(cells, parts, strict=True))


def _padded(part: re.Match[str], most: int) -> str:
    decimals = part[2] or ""
    room = DIGIT * (most - len(decimals)) + (POINT if most and not decimals else "")
    return f"{part[1]}{'.' + decimals if decimals else ''}{room}{part[3]}{part[4]}"
