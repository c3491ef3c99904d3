"""A light reader of delimited number tables: delimiter found, header optional, every fault named by its line.

Lines are kept as text and a column is parsed when it is asked for, so that a large table costs little more memory
than its text.
"""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from datetime import datetime

import numpy as np
from numpy.typing import NDArray

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array

DELIMITERS = (",", ";", "\t")
BLANKS = " "
COMMENTS = ("#", "%")
MISSING = frozenset(["", "na", "n/a", "nan", "null", "none", "-"])
"""Cells that say that there is no value; they are read as NaN."""
TEXT_BUDGET = 300_000_000
"""Bytes of text: at about 20 bytes a sample, some ten million of them."""


@dataclass(frozen=True)
class TextTable:
    """Column names (numbers from 1 when there is no header), the text of each row, and each row's line in the file."""

    names: tuple[str, ...]
    rows: tuple[str, ...]
    lines: NDArray[np.intp]
    delimiter: str
    source: str

    @property
    def decimal_comma(self) -> bool:
        """Whether a comma is a decimal point: it is when it separates no cells."""
        return self.delimiter != ","

    def cells(self, index: int) -> Iterator[str]:
        """The cells of one column, one by one; empty where a row is too short."""
        return (row[index] if index < len(row) else "" for row in cells_of(self.rows, self.delimiter))

    def column(self, index: int) -> Array:
        """The numbers of one column, NaN where a cell is MISSING; InputError at the first that is not a number.

        Dates with times of day (ISO 8601) become seconds since the first of them.
        """
        first = next((cell for cell in self.cells(index) if cell.lower() not in MISSING), "")
        read = since(first) if is_stamp(first) else (decimal_comma if self.decimal_comma else plain_number)
        values = np.empty(len(self.rows))
        for i, cell in enumerate(self.cells(index)):
            try:
                values[i] = read(cell)
            except (ValueError, TypeError):  # a stamp with a time zone among those without raises the latter
                if cell.lower() not in MISSING:
                    raise InputError(
                        f"{self.source}, line {self.lines[i]}, column {self.names[index]}: {cell!r} is not a number"
                    ) from None
                values[i] = np.nan
        return values


def plain_number(cell: str) -> float:
    """A number as instruments write it; Python's own ``1_05`` is none of them.

    >>> plain_number("1.05e-3")
    0.00105
    """
    if "_" in cell:
        raise ValueError(cell)
    return float(cell)


def decimal_comma(cell: str) -> float:
    """A number whose decimal point may be a comma.

    >>> decimal_comma("1,5")
    1.5
    """
    return plain_number(cell.replace(",", "."))


def is_stamp(cell: str) -> bool:
    """Whether a cell is a date with a time of day.

    >>> is_stamp("2026-11-22T10:00:00.125"), is_stamp("20261122"), is_stamp("1.5")
    (True, False, False)
    """
    try:
        datetime.fromisoformat(cell)
    except ValueError:
        return False
    return ":" in cell


def since(first: str) -> Callable[[str], float]:
    """A reader of stamps as seconds since the first.

    >>> since("2026-11-22 10:00:00")("2026-11-22 10:00:01.5")
    1.5
    """
    start = datetime.fromisoformat(first)
    return lambda cell: (datetime.fromisoformat(cell) - start).total_seconds()


def cells_of(rows: Iterable[str], delimiter: str) -> Iterator[list[str]]:
    """The cells of each row, without blanks round them.

    >>> list(cells_of(["1  2 3 "], " "))
    [['1', '2', '3']]
    """
    if delimiter == BLANKS:
        return (row.split() for row in rows)
    return ([cell.strip() for cell in row] for row in csv.reader(rows, delimiter=delimiter, strict=True))


def is_number(cell: str) -> bool:
    """Whether a cell reads as a number, with a decimal point or comma, or as a missing one.

    >>> is_number("1e-3"), is_number("1,5"), is_number("time"), is_number("NaN")
    (True, True, False, True)
    """
    try:
        decimal_comma(cell)
    except ValueError:
        return cell.lower() in MISSING
    return True


def find_delimiter(line: str, last: str = "") -> str:
    """The delimiter of a line: a tab or semicolon when there is one (commas are then decimal), else a comma.

    Blanks separate the cells when the table's ``last`` line holds several numbers and no other delimiter.

    >>> find_delimiter("1,5;2,5"), find_delimiter("t,u"), find_delimiter("t u", "0.5 2.5")
    (';', ',', ' ')
    """
    words = last.split()
    if len(words) > 1 and not any(d in line + last for d in DELIMITERS) and all(map(is_number, words)):
        return BLANKS
    return max(DELIMITERS, key=lambda d: (line.count(d) > 0, DELIMITERS.index(d)))


def parse_table(text: str, *, source: str) -> TextTable:
    r"""Split delimited text into a table; empty lines and lines that begin with # or % are skipped.

    The first row is the header when any of its cells is not a number.
    Raises InputError when there is no row of numbers.

    >>> table = parse_table("t_s,u\n0,1.5\n0.5,2.5\n", source="run.csv")
    >>> table.names, table.column(1).tolist()
    (('t_s', 'u'), [1.5, 2.5])
    """
    numbered = [
        (number, line)
        for number, line in enumerate(text.splitlines(), start=1)
        if line.strip() and not line.lstrip().startswith(COMMENTS)
    ]
    if not numbered:
        raise InputError(f"{source} holds no data; a table needs rows of numbers")
    lines = tuple(line for _, line in numbered)
    delimiter = find_delimiter(lines[0], lines[-1])
    check_quotes(lines, delimiter, source)
    top = next(cells_of(lines[:1], delimiter))
    check_widths(numbered, len(top), delimiter, source)
    headed = not all(is_number(cell) or is_stamp(cell) for cell in top)
    first = 1 if headed else 0
    if len(lines) == first:
        raise InputError(f"{source} holds no row of numbers below its header")
    return TextTable(
        names=tuple(top) if headed else tuple(str(i + 1) for i in range(len(top))),
        rows=lines[first:],
        lines=np.array([number for number, _ in numbered[first:]], dtype=np.intp),
        delimiter=delimiter,
        source=source,
    )


def check_widths(numbered: list[tuple[int, str]], width: int, delimiter: str, source: str) -> None:
    """Refuse a row with more cells than the first; empty ones at its end are no cells."""
    lines = (line for _, line in numbered)
    for (number, _), cells in zip(numbered, cells_of(lines, delimiter), strict=True):
        if len(cells) > width and any(cells[width:]):
            hint = "; is a comma a decimal point there? then separate the cells by ;" if delimiter == "," else ""
            raise InputError(f"{source}, line {number} has {len(cells)} cells, the first row {width}{hint}")


def check_quotes(lines: tuple[str, ...], delimiter: str, source: str) -> None:
    """Refuse what the csv reader cannot read row by row: broken quotes, cells over several lines."""
    try:
        count = sum(1 for _ in cells_of(lines, delimiter))
    except csv.Error as error:
        raise InputError(f"{source} is not a readable table: {error}") from None
    if count != len(lines):
        raise InputError(f"{source} has a quoted cell that runs over several lines; write one row per line")
