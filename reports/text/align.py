"""Numbers of one column padded so that they stand under one another at the decimal point."""

from __future__ import annotations

import re
from collections.abc import Sequence

POINT, DIGIT = "\u2008", "\u2007"
"""Spaces as wide as a full stop and as a digit where numerals are tabular."""
_SPREAD = re.compile(r"^([+−]?\d+)\.(\d+) ± (\d+)\.(\d+)$")
_NUMBER = re.compile(r"^((?:≤ )?[+−]?\d+)(?:\.(\d+))?((?: %| [^\d×]{1,6})?)((?: \([^)]*\))?)$")


def aligned(cells: Sequence[str]) -> tuple[str, ...]:
    """Pad decimals of right-aligned cells; what is no plain number, or has a power of ten, stays as it is.

    >>> [cell.replace(POINT, "_").replace(DIGIT, "_") for cell in aligned(["0.25 %", "23 %", "–"])]
    ['0.25 %', '23___ %', '–']
    >>> [cell.replace(DIGIT, "_") for cell in aligned(["0.1 %", "≤ 0.018 %"])]
    ['0.1__ %', '≤ 0.018 %']
    >>> [cell.replace(DIGIT, "_") for cell in aligned(["0.12 ± 0.01", "0.1234 ± 0.0002"])]
    ['0.12__ ± 0.01__', '0.1234 ± 0.0002']
    """
    spreads = [_SPREAD.match(cell) for cell in cells]
    widest = max((len(found[2]) for found in spreads if found), default=0)
    cells = [cell if found is None else _spread(found, widest) for cell, found in zip(cells, spreads, strict=True)]
    parts = [_NUMBER.match(cell) for cell in cells]
    most = max((len(part[2]) for part in parts if part and part[2]), default=0)
    return tuple(cell if part is None else _padded(part, most) for cell, part in zip(cells, parts, strict=True))


def _spread(found: re.Match[str], most: int) -> str:
    """A value and its uncertainty, both to as many decimals as they have, with room for the most of the column."""
    room, less = DIGIT * (most - len(found[2])), DIGIT * (most - len(found[4]))
    return f"{found[1]}.{found[2]}{room} ± {found[3]}.{found[4]}{less}"


def _padded(part: re.Match[str], most: int) -> str:
    decimals = part[2] or ""
    room = DIGIT * (most - len(decimals)) + (POINT if most and not decimals else "")
    return f"{part[1]}{'.' + decimals if decimals else ''}{room}{part[3]}{part[4]}"
