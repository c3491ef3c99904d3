"""Rows as CSV (every digit) and as an aligned table (for reading)."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

Row = Mapping[str, Any]


def cell(value: Any) -> str:
    """A value for CSV: floats with every digit they need to be read back the same, nothing for a missing one.

    >>> cell(0.1), cell(None), cell(float("nan")), cell(True)
    ('0.1', '', '', 'true')
    """
    if value is None:
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return repr(float(value)) if math.isfinite(value) else ""
    return str(value)


def csv_text(columns: Sequence[str], rows: Iterable[Row]) -> str:
    r"""A header line and one line per row.

    >>> csv_text(["time_s", "u"], [{"time_s": 0.0, "u": 1e-17}])
    'time_s,u\n0.0,1e-17\n'
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows([cell(row.get(name)) for name in columns] for row in rows)
    return text.getvalue()


def readable(value: Any) -> str:
    """A value for reading: six significant digits, a dash for a missing one.

    >>> readable(1.23456789), readable(None), readable(12), readable(2.5e-13)
    ('1.23457', '-', '12', '2.5e-13')
    """
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return "-"
    if isinstance(value, float):
        return f"{value:.6g}"
    return cell(value)


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
