"""A light reader of delimited number tables: delimiter found, header optional, every fault named by its line."""

from __future__ import annotations

import csv
from dataclasses import dataclass

import numpy as np

from numeric.errors import InputError
from numeric.samples import Array

DELIMITERS = (",", ";", "\t")


@dataclass(frozen=True)
class TextTable:
    """Column names (numbers from 1 when there is no header), the cells of each row, and each row's line in the file."""

    names: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    lines: tuple[int, ...]
    decimal_comma: bool
    source: str

    def column(self, index: int) -> Array:
        """The numbers of one column; raises InputError at the first cell that is missing or not a number."""
        values = np.empty(len(self.rows))
        for i, row in enumerate(self.rows):
            cell = row[index] if index < len(row) else ""
            try:
                values[i] = float(cell.replace(",", ".") if self.decimal_comma else cell)
            except ValueError:
                what = repr(cell) if cell else "empty"
                raise InputError(
                    f"{self.source}, line {self.lines[i]}, column {self.names[index]}: {what} is not a number"
                ) from None
        return values


def is_number(cell: str) -> bool:
    """Whether a cell reads as a number, with a decimal point or comma.

    >>> is_number("1e-3"), is_number("1,5"), is_number("time")
    (True, True, False)
    """
    try:
        float(cell.replace(",", "."))
    except ValueError:
        return False
    return True


def find_delimiter(line: str) -> str:
    """The delimiter of a line: a tab or semicolon when there is one (commas are then decimal), else a comma.

    >>> find_delimiter("1,5;2,5"), find_delimiter("t,u")
    (';', ',')
    """
    return max(DELIMITERS, key=lambda d: (line.count(d) > 0, DELIMITERS.index(d)))


def parse_table(text: str, *, source: str) -> TextTable:
    r"""Split delimited text into a table; empty lines and lines that begin with # are skipped.

    The first row is the header when any of its cells is not a number.
    Raises InputError when there is no row of numbers.

    >>> table = parse_table("t_s,u\n0,1.5\n0.5,2.5\n", source="run.csv")
    >>> table.names, table.column(1).tolist()
    (('t_s', 'u'), [1.5, 2.5])
    """
    numbered = [
        (number, line)
        for number, line in enumerate(text.splitlines(), start=1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if not numbered:
        raise InputError(f"{source} holds no data; a table needs rows of numbers")
    delimiter = find_delimiter(numbered[0][1])
    try:
        cells = [
            tuple(cell.strip() for cell in row)
            for row in csv.reader((line for _, line in numbered), delimiter=delimiter, strict=True)
        ]
    except csv.Error as error:
        raise InputError(f"{source} is not a readable table: {error}") from None
    if len(cells) != len(numbered):
        raise InputError(f"{source} has a quoted cell that runs over several lines; write one row per line")
    headed = not all(is_number(cell) for cell in cells[0])
    names = cells[0] if headed else tuple(str(i + 1) for i in range(len(cells[0])))
    first = 1 if headed else 0
    if len(cells) == first:
        raise InputError(f"{source} holds no row of numbers below its header")
    return TextTable(
        names, tuple(cells[first:]), tuple(number for number, _ in numbered[first:]), delimiter != ",", source
    )
