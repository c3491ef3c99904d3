"""What separates the cells of a table, and its lines cut into them."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable, Iterator, Sequence

from ridgeback.common.errors import InputError
from ridgeback.numeric.files.tables.lines import Lines
from ridgeback.numeric.files.tables.numbers import is_missing, is_number
from ridgeback.numeric.files.tables.stamps import is_stamp

DELIMITERS = (",", "|", ";", "\t")
"""The later ones first where a line holds several: a comma may be of a number."""
BLANKS = " "
NEVER = "\x1f"
"""Separates the cells of a table with one column."""
OPENING = frozenset("([/")
GAPS = re.compile(r"\s{2,}")
"""What separates the names above a table of blanks where they hold single ones."""
BEFORE_A_UNIT = re.compile(r"\s+(?![(\[/])")
BEGUN = re.compile(r"[,|;\t]|[+\-\u2212]?[.,]?\d")
"""How a row of numbers begins."""
LAST = 50
"""Lines at the end among which the last row of numbers is looked for."""


def cells_of(rows: Iterable[str], delimiter: str) -> Iterator[list[str]]:
    """The cells of each row, without blanks round them.

    >>> list(cells_of(["1  2 3 ", "time (s)  u [mm]"], " "))
    [['1', '2', '3'], ['time (s)', 'u [mm]']]
    """
    if delimiter == BLANKS:
        return (row.split() if OPENING.isdisjoint(row) else BEFORE_A_UNIT.split(row.strip()) for row in rows)
    return ([cell.strip() for cell in row] for row in csv.reader(rows, delimiter=delimiter, strict=True))


def cells_in(line: str, delimiter: str) -> list[str]:
    """The cells of one line; the whole line where its quotes are broken."""
    try:
        return next(cells_of([line], delimiter), [])
    except csv.Error:
        return [line]


def column_cells(rows: list[str] | Lines, delimiter: str, place: int) -> Iterator[str]:
    """One cell of each row; empty where a row is too short."""
    return (row[place] if place < len(row) else "" for row in cells_of(rows, delimiter))


def is_value(cell: str) -> bool:
    """Whether a cell is a number, a missing one or a stamp."""
    return is_number(cell) or is_stamp(cell)


def is_word(cell: str) -> bool:
    """Whether a cell holds something that is no number.

    >>> is_word("run1"), is_word("1"), is_word("")
    (True, False, False)
    """
    return bool(cell) and not is_value(cell)


def is_there(cell: str) -> bool:
    """Whether a cell holds a value.

    >>> is_there("1,5"), is_there("n/a"), is_there("u")
    (True, False, False)
    """
    return is_value(cell) and not is_missing(cell)


def stated_delimiter(text: str) -> str:
    r"""What a first line "sep=;" says, else nothing.

    >>> stated_delimiter("sep=;\n1;2"), stated_delimiter("1;2")
    (';', '')
    """
    line = text[: len("sep=;\n")].partition("\n")[0]
    return line[-1] if line.lower().startswith("sep=") and len(line) == len("sep=;") else ""


def last_row(lines: Sequence[str] | Lines) -> str:
    """The last whole line that begins with a number, or with cells that are empty: what follows it is no row.

    >>> last_row(("t,u", "0,1", "1,2", "end of file")), last_row(("t,u", "0,1", "1,2", "2"))
    ('1,2', '1,2')
    """
    size = len(lines)
    rows = [lines[at] for at in range(size - 1, max(-1, size - 1 - LAST), -1)]
    begun = [row for row in rows if BEGUN.match(row.strip().lstrip("\"'"))]
    return max(begun, key=signs, default=rows[0])


def signs(row: str) -> int:
    """How many signs that separate cells stand in a row, or blanks where there are none."""
    return max(row.count(delimiter) for delimiter in DELIMITERS) or len(row.split()) - 1


def find_delimiter(row: str, head: str = "") -> str:
    """The delimiter of a row of numbers: a tab, a semicolon or a bar where there is one, else blanks, else a comma.

    Where the row has none of them, that of the line above the numbers counts.

    >>> find_delimiter("1,5;2,5"), find_delimiter("0,1"), find_delimiter("0.5 2.5"), find_delimiter("0,5  1,5")
    (';', ',', ' ', ' ')
    >>> find_delimiter("1", "t;u"), find_delimiter("0, 1")
    (';', ',')
    """
    found = next((d for d in reversed(DELIMITERS[1:]) if d in row), "")
    if found:
        return found
    words = row.split()
    if len(words) > 1 and all(is_number(word) and word.strip(",") == word for word in words):
        return BLANKS
    if "," in row:
        return ","
    return next((d for d in reversed(DELIMITERS) if d in head), ",")


def check_quotes(lines: Lines, delimiter: str, source: str) -> None:
    """Refuse what the csv reader cannot read row by row: broken quotes, cells over several lines, or without end."""
    begin = int(lines.begin[0]) if len(lines) else 0
    if lines.text.find('"', begin) < 0 and lines.longest < csv.field_size_limit():
        return
    try:
        count = sum(1 for _ in csv.reader(lines, delimiter=delimiter, strict=True))
    except csv.Error as error:
        raise InputError(f"{source} is not a readable table: {error}") from None
    if count != len(lines):
        raise InputError(f"{source} has a quoted cell that runs over several lines; write one row per line")


def check_widths(rows: Lines, width: int, delimiter: str, source: str) -> None:
    """Refuse a row with more cells than the first; empty ones at its end are no cells."""
    for begin, block in rows.blocks():
        for at, line in enumerate(block, start=begin):
            if (len(line.split()) <= width) if delimiter == BLANKS else line.count(delimiter) < width:
                continue  # quoted or not, it has no more cells
            cells = cells_in(line, delimiter)
            if len(cells) > width and any(cells[width:]):
                raise InputError(
                    f"{source}, line {rows.number[at]} has {len(cells)} cells, the first row {width}"
                    f"{is_a_mark(delimiter)}"
                )


def is_a_mark(delimiter: str) -> str:
    """What is to be asked where commas separate the cells."""
    if delimiter != ",":
        return ""
    return "; is the comma a decimal mark there (--decimal comma)? then separate the cells by ;"
