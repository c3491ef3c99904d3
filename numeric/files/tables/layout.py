"""Where a table begins in a text, what separates its cells, and which of them hold its columns."""

from __future__ import annotations

from collections.abc import Sequence

from ridgeback.common.errors import InputError
from ridgeback.numeric.files.tables.cells import (
    DELIMITERS,
    GAPS,
    NEVER,
    cells_in,
    column_cells,
    is_there,
    is_value,
)
from ridgeback.numeric.files.tables.lines import Lines
from ridgeback.numeric.files.tables.numbers import COMMA, fits


def otherwise(above: str, width: int) -> list[str]:
    """The names above a table where another sign is between them than between the numbers; none where none fits.

    >>> otherwise("t,u", 2), otherwise("made by X", 2)
    (['t', 'u'], [])
    """
    found = (cells_in(above, delimiter) for delimiter in DELIMITERS)
    return next((cells for cells in found if len(cells) == width > 1), [])


def spaced(heads: list[list[str]], above: str, width: int) -> tuple[list[list[str]], tuple[int, ...]]:
    """The lines above a table of blanks, whose names may hold single ones, and its columns; no names that do not fit.

    >>> spaced([["time", "since", "start", "u"]], "time since start   u", 2)
    ([['time since start', 'u']], (0, 1))
    """
    wide = GAPS.split(above.strip())
    fitting = heads if heads and len(heads[-1]) == width else [wide] if heads and len(wide) == width else []
    return fitting, tuple(range(width))


def with_decimal_commas(lines: Lines, row: str, source: str) -> str:
    """The delimiter of a table without another than the comma, the mark of its decimals: of quoted cells, or of none.

    Raises InputError where commas separate the cells, too.
    """
    if '"' in row:
        return ","
    if len(cells_in(lines[0], ",")) > 1 and not fits(lines[0].strip(), COMMA):
        raise InputError(
            f"{source}: commas separate its cells, and are its decimal marks; separate the cells by ;, or quote them"
        )
    return NEVER


def check_halves(heads: Sequence[Sequence[str]], row: Sequence[str], source: str) -> None:
    """Refuse rows with two whole numbers for each name above them: the comma is more likely the decimal mark."""
    if not heads or any(map(is_value, heads[-1])) or len(row) != 2 * len(heads[-1]):
        return
    if all(cell.lstrip("+-").isdecimal() for cell in row):
        one = len(row) == 2
        names, cells = "1 column" if one else f"{len(heads[-1])} columns", f"the rows have {len(row)} cells"
        remedy = (
            "say by --decimal comma that it is, or by --decimal point that it separates two columns"
            if one
            else "then nothing tells it from what separates the cells: export the table with ; between them, or with "
            "decimal points; where it is not, name every column"
        )
        raise InputError(f"{source}: the header names {names}, {cells}; is the comma the decimal mark? {remedy}")


def beside_remarks(lines: Lines, delimiter: str, last: list[str]) -> tuple[int, ...]:
    """The cells that hold the samples where they begin in the first line, beside an instrument's remarks; else none.

    As oscilloscopes write them: "Record Length,2500,,0.000,1.25", and further down ",,,0.040,1.31".
    """
    head = cells_in(lines[0], delimiter)
    there = tuple(i for i, cell in enumerate(last) if cell)
    if not there or len(head) != len(last) or not all(is_there(head[i]) for i in there):
        return ()
    others = [head[i] for i in range(len(head)) if i not in there]
    return there if any(cell and not is_value(cell) for cell in others) else ()


def filled(rows: Lines, delimiter: str, width: int) -> tuple[int, ...]:
    """The columns in which something stands; all of them where it does in one at most."""
    some = [cells_in(rows[at], delimiter) for at in (0, len(rows) // 2, -1)]
    found = tuple(
        i
        for i in range(width)
        if any(i < len(cells) and cells[i] for cells in some) or any(column_cells(rows, delimiter, i))
    )
    return found if len(found) > 1 else tuple(range(width))


def first_numbers(lines: Sequence[str] | Lines, delimiter: str, last: list[str]) -> int:
    """The first line of numbers, several where the last row has several; the second line where there is none.

    Where the last row has words a line may have them, too.  A line beside the first that holds a number, and as many
    cells, is a row of the table, however wrong.

    >>> first_numbers(("made by X", "t,u", "0,1", "1,2"), ",", ["1", "2"]), first_numbers(("u", "x", "1"), ",", ["1"])
    (2, 2)
    >>> first_numbers(("t,u", "0,x", "1,2"), ",", ["1", "2"]), first_numbers(("X", "t,u", "0,a"), ",", ["1", "b"])
    (1, 2)
    """
    several, words = len(last) > 1, {i for i, cell in enumerate(last) if not is_value(cell)}
    for at, line in enumerate(lines):
        cells = cells_in(line, delimiter)
        told = [cell for i, cell in enumerate(cells) if i not in words]
        if (len(cells) > 1) == several and told and all(map(is_value, told)) and any(map(is_there, told)):
            return after_wrong_rows(lines, at, delimiter, cells)
    return 1


def after_wrong_rows(lines: Sequence[str] | Lines, at: int, delimiter: str, below: list[str]) -> int:
    """The first of the rows up to ``at`` that hold a number where the row below has one, the first line left out."""
    while at > 1:
        cells = cells_in(lines[at - 1], delimiter)
        if len(cells) != len(below) or not any(is_there(a) and is_there(b) for a, b in zip(cells, below, strict=True)):
            return at
        at, below = at - 1, cells
    return at
