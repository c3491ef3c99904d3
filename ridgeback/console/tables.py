"""Rows as CSV (every digit) and as an aligned table (for reading)."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from ridgeback.common import csv_text as csv_of
from ridgeback.common.csv_text import cell

Row = Mapping[str, Any]


def csv_text(columns: Sequence[str], rows: Iterable[Row]) -> str:
    r"""A header line and one line per row.

    >>> csv_text(["time_s", "u"], [{"time_s": 0.0, "u": 1e-17}])
    'time_s,u\n0.0,1e-17\n'
    """
    return csv_of.csv_text(columns, ([row.get(name) for name in columns] for row in rows))


def readable(value: Any) -> str:
    """A value for reading: six significant digits, a dash for a missing one.

    >>> readable(1.23456789), readable(None), readable(12), readable(2.5e-13), readable("-3*sqrt(2)/8")
    ('1.23457', '-', '12', '2.5e-13', '-3*sqrt(2)/8')
    """
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return "-"
    if isinstance(value, float):
        return f"{value:.6g}"
    return value if isinstance(value, str) else cell(value)  # the guard of cells is for spreadsheets, not for reading


def aligned(columns: Sequence[str], rows: Iterable[Row]) -> str:
    """Columns in line: numbers to the right, words to the left.

    >>> print(aligned(["order", "method"], [{"order": 2, "method": "peak"}, {"order": 16, "method": "x"}]))
    order  method
        2  peak
       16  x
    """
    kept = list(rows)
    cells = [[readable(row.get(name)) for name in columns] for row in kept]
    widths = [max(len(line[j]) for line in [list(columns), *cells]) for j in range(len(columns))]
    numeric = [any(is_number(row.get(name)) for row in kept) for name in columns]

    def line(words: Sequence[str]) -> str:
        """One line, without blanks at its end."""
        placed = (
            word.rjust(width) if right else word.ljust(width)
            for word, width, right in zip(words, widths, numeric, strict=True)
        )
        return "  ".join(placed).rstrip()

    return "\n".join([line(columns), *map(line, cells)])


def is_number(value: Any) -> bool:
    """Whether the value is a number and not a truth value."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)
