"""A light reader of delimited number tables: delimiter found, header optional, every fault named by its line.

A column is parsed when it is asked for, some thousands of lines at a time by numpy's own parser, and line by line where
that finds a fault, which is then named.
"""

from __future__ import annotations

import codecs
import csv
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from datetime import datetime

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.files.tables.lines import COMMENTS, Lines, lines_of, with_line_feeds

DELIMITERS = (",", ";", "\t")
BLANKS = " "
MISSING = frozenset(["", "na", "n/a", "nan", "null", "none", "-"])
"""Cells that say that there is no value; they are read as NaN."""
TEXT_BUDGET = 300_000_000
"""Bytes of text: at about 20 bytes a sample, some ten million of them."""


@dataclass(frozen=True)
class TextTable:
    """Column names (numbers from 1 when there is no header), and the lines that are its rows."""

    names: tuple[str, ...]
    rows: Lines
    delimiter: str
    source: str
    note: str = ""

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
        plain = not is_stamp(first) and '"' not in self.rows.text
        for begin, block in self.rows.blocks():
            found = numbers_of(block, self.delimiter, index) if plain else None
            part = values[begin : begin + len(block)]
            part[:] = list(self.one_by_one(block, index, begin, read)) if found is None else found
        return values

    def one_by_one(self, block: list[str], index: int, begin: int, read: Callable[[str], float]) -> Iterator[float]:
        """The numbers of one column of some rows, the first of which is row ``begin``."""
        for at, row in enumerate(cells_of(block, self.delimiter), start=begin):
            cell = row[index] if index < len(row) else ""
            try:
                yield read(cell)
            except (ValueError, TypeError):  # a stamp with a time zone among those without raises the latter
                if cell.lower() not in MISSING:
                    where = f"line {self.rows.number[at]}, column {self.names[index]}"
                    raise InputError(f"{self.source}, {where}: {cell!r} is not a number") from None
                yield np.nan


def numbers_of(block: list[str], delimiter: str, index: int) -> Array | None:
    """The numbers of one column of some rows without quotes; None where one of them is not there, or none.

    >>> numbers_of(["0;1,5", "1;2,5"], ";", 1).tolist(), numbers_of(["0,1", "1,x"], ",", 1), numbers_of(["0"], ",", 1)
    ([1.5, 2.5], None, None)
    """
    rows = block if delimiter == "," else [row.replace(",", ".") for row in block]
    between = None if delimiter == BLANKS else delimiter
    try:
        found = np.loadtxt(rows, delimiter=between, usecols=index, comments=None, ndmin=1)
    except ValueError:
        return None
    return found if found.size == len(block) else None


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


def decoded(data: bytes, source: str) -> tuple[str, str]:
    r"""Text in UTF-8 or UTF-16, else in Windows' or ISO's Latin alphabet, and a note where that was supposed.

    >>> decoded("t;u".encode("utf-16"), "run.csv"), decoded(b"\xb5m", "run.csv")[0]
    (('t;u', ''), 'µm')
    """
    if data[:2] in (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE):
        return readable(data, "utf-16", source), ""
    if data[1:2] == b"\0" or data[:1] == b"\0":
        return readable(data, "utf-16-le" if data[1:2] == b"\0" else "utf-16-be", source), ""
    try:
        return data.decode("utf-8-sig"), ""
    except UnicodeDecodeError as error:
        if b"\0" in data[:10_000]:
            raise InputError(f"{source}: byte {error.start} is not UTF-8 text; save the table as UTF-8") from None
    return data.decode("cp1252", "replace"), "The text is not UTF-8; it was read in the Latin alphabet of Windows-1252."


def readable(data: bytes, encoding: str, source: str) -> str:
    """Text in a known encoding; InputError for what is none."""
    try:
        return data.decode(encoding)
    except UnicodeDecodeError as error:
        raise InputError(f"{source}: byte {error.start} is not {encoding} text; save the table as UTF-8") from None


def parse_table(text: str, *, source: str) -> TextTable:
    r"""Split delimited text into a table.

    Rows of numbers begin where a line and the last one have as many numbers.  The line above them names the columns,
    and one more between them may hold their units; what stands before, as the preamble of an instrument, is left out,
    and so are empty lines and comments, which begin with # or % (the last one above the table may name the columns).
    A first line "sep=;" says what separates the cells.
    Raises InputError when there is no row of numbers.

    >>> table = parse_table("t_s,u\n0,1.5\n0.5,2.5\n", source="run.csv")
    >>> table.names, table.column(1).tolist()
    (('t_s', 'u'), [1.5, 2.5])
    >>> table = parse_table("sep=;\nmade by X\nZeit;u\n[ms];[mm]\n0;1,5\n1;2,5\n", source="run.csv")
    >>> table.names, table.column(1).tolist()
    (('Zeit [ms]', 'u [mm]'), [1.5, 2.5])
    """
    text = with_line_feeds(text)
    given = stated_delimiter(text)
    lines, comment = lines_of(text, skip=1 if given else 0)
    if not len(lines):
        raise InputError(f"{source} holds no data; a table needs rows of numbers")
    first = first_numbers(lines, given)
    if first == len(lines):
        raise InputError(f"{source} holds no row of numbers below its header")
    above = lines[first - 1] if first else lines[first]
    delimiter = given or find_delimiter(above if first else lines[0], lines[-1])
    check_quotes(lines.after(max(0, first - 2)), delimiter, source)
    heads = [cells_in(lines[at], delimiter) for at in range(max(0, first - 2), first)]
    width = width_of(cells_in(lines[first], delimiter), heads)
    names, used = heading(heads, width)
    if not names and first == 0:
        names = commented(comment, delimiter, width)
    rows = lines.after(first)
    check_widths(rows, max(len(names), width) if names else width, delimiter, source)
    skipped = first - used
    return TextTable(
        names=names or tuple(str(i + 1) for i in range(width)),
        rows=rows,
        delimiter=delimiter,
        source=source,
        note=left_out(skipped),
    )


def width_of(cells: list[str], heads: list[list[str]]) -> int:
    """How many columns the first row has: empty cells at its end that the header has not are none.

    >>> width_of(["0", "1", ""], [["t", "u"]]), width_of(["0", "1", ""], [["t", "u", "v"]])
    (2, 3)
    """
    filled = max((i for i, cell in enumerate(cells, start=1) if cell.strip()), default=0)
    return max(filled, min(len(cells), len(heads[-1]))) if heads else len(cells)


def left_out(lines: int) -> str:
    """How many lines before the table, in words; empty for none.

    >>> left_out(1), left_out(2)
    ('1 line before the table was left out.', '2 lines before the table were left out.')
    """
    what = "line before the table was" if lines == 1 else "lines before the table were"
    return f"{lines} {what} left out." if lines else ""


def stated_delimiter(text: str) -> str:
    r"""What a first line "sep=;" says, else nothing.

    >>> stated_delimiter("sep=;\n1;2"), stated_delimiter("1;2")
    (';', '')
    """
    line = text[: len("sep=;\n")].partition("\n")[0]
    return line[-1] if line.lower().startswith("sep=") and len(line) == len("sep=;") else ""


def first_numbers(lines: Sequence[str] | Lines, given: str) -> int:
    """The first line of numbers, several where the last one has several; the second line where there is none.

    A line beside the first that holds a number, and as many cells, is a row of the table, however wrong.

    >>> first_numbers(("made by X", "t,u", "0,1", "1,2"), ""), first_numbers(("t,u", "0,x", "1,2"), "")
    (2, 1)
    """
    delimiter = given or find_delimiter(lines[-1], lines[-1])
    several = len(cells_in(lines[-1], delimiter)) > 1
    for at, line in enumerate(lines):
        cells = cells_in(line, delimiter)
        if (len(cells) > 1) == several and all(map(is_value, cells)) and any(map(is_there, cells)):
            return after_wrong_rows(lines, at, delimiter, len(cells))
    return 1


def after_wrong_rows(lines: Sequence[str] | Lines, at: int, delimiter: str, width: int) -> int:
    """The first of the rows up to ``at`` that hold a number beside something else, the first line left out."""
    while at > 1:
        cells = cells_in(lines[at - 1], delimiter)
        if len(cells) != width or not any(is_value(cell) and is_there(cell) for cell in cells):
            return at
        at -= 1
    return at


def is_there(cell: str) -> bool:
    """Whether a cell does not say that there is no value."""
    return cell.lower() not in MISSING


def cells_in(line: str, delimiter: str) -> list[str]:
    """The cells of one line; the whole line where its quotes are broken."""
    try:
        return next(cells_of([line], delimiter), [])
    except csv.Error:
        return [line]


def is_value(cell: str) -> bool:
    """Whether a cell is a number, a missing one or a stamp."""
    return is_number(cell) or is_stamp(cell)


def heading(heads: list[list[str]], width: int) -> tuple[tuple[str, ...], int]:
    """The names of the columns from the lines above the numbers, with their units, and how many of the lines they are.

    >>> heading([["made by X"], ["t", "u"]], 2), heading([["t", "u"], ["s", "mm"]], 2), heading([["X"]], 2)
    ((('t', 'u'), 1), (('t [s]', 'u [mm]'), 2), ((), 0))
    """
    if not heads or len(heads[-1]) < width:
        return (), 0
    last = heads[-1]
    two = len(heads) == 2 and len(heads[0]) == len(last) and not any(is_value(c) and c for c in (*heads[0], *last))
    if not two:
        return tuple(last), 1
    units = [cell.strip().strip("[]()") for cell in last]
    return tuple(f"{name} [{unit}]" if unit else name for name, unit in zip(heads[0], units, strict=True)), 2


def commented(comment: str, delimiter: str, width: int) -> tuple[str, ...]:
    """The names of the columns from the last comment above the numbers, where it has as many words.

    >>> commented("% t, u", ",", 2)
    ('t', 'u')
    """
    cells = cells_in(comment.lstrip("".join(COMMENTS)).strip(), delimiter)
    return tuple(cells) if len(cells) == width and not any(map(is_value, cells)) else ()


def check_widths(rows: Lines, width: int, delimiter: str, source: str) -> None:
    """Refuse a row with more cells than the first; empty ones at its end are no cells."""
    between = None if delimiter == BLANKS else delimiter
    quoted = '"' in rows.text
    for begin, block in rows.blocks():
        for at, line in enumerate(block, start=begin):
            if not quoted and between is not None and line.count(between) < width:
                continue
            cells = cells_in(line, delimiter)
            if len(cells) > width and any(cells[width:]):
                hint = "; is a comma a decimal point there? then separate the cells by ;" if delimiter == "," else ""
                number = rows.number[at]
                raise InputError(f"{source}, line {number} has {len(cells)} cells, the first row {width}{hint}")


def check_quotes(lines: Lines, delimiter: str, source: str) -> None:
    """Refuse what the csv reader cannot read row by row: broken quotes, cells over several lines, or without end."""
    if '"' not in lines.text and lines.longest < csv.field_size_limit():
        return
    try:
        count = sum(1 for _ in cells_of(lines, delimiter))
    except csv.Error as error:
        raise InputError(f"{source} is not a readable table: {error}") from None
    if count != len(lines):
        raise InputError(f"{source} has a quoted cell that runs over several lines; write one row per line")
