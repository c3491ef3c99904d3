"""A light reader of delimited number tables: delimiter found, header optional, every fault named by its line.

A column is parsed when it is asked for, some thousands of lines at a time by numpy's own parser, and cell by cell where
that finds a fault, which is then named, or a number that only people read: with marks between thousands, a date.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.files.tables.cells import (
    BLANKS,
    cells_in,
    check_quotes,
    check_widths,
    column_cells,
    find_delimiter,
    is_word,
    last_row,
    stated_delimiter,
)
from ridgeback.numeric.files.tables.heading import (
    MOST_HEADS,
    commented,
    empty_columns,
    heading,
    left_out,
    may_say_times,
)
from ridgeback.numeric.files.tables.layout import (
    beside_remarks,
    check_halves,
    filled,
    first_numbers,
    otherwise,
    spaced,
    with_decimal_commas,
)
from ridgeback.numeric.files.tables.lines import Lines, lines_of, with_line_feeds
from ridgeback.numeric.files.tables.numbers import AUTO, COMMA, POINT, fits, is_missing, mark_in, number
from ridgeback.numeric.files.tables.stamps import BadCellError, is_stamp, stamp_seconds

HOURS = re.compile(r"\d+:\d\d")
WITH_A_UNIT = re.compile(r"[-+]?\d[\d.,]*(?:[eE][-+]?\d+)?\s*[^\W\d_]+")
BOM = "\ufeff"
WORDS = {POINT: "point", COMMA: "comma"}


@dataclass(frozen=True)
class TextTable:
    """Columns of a text.

    Parameters
    ----------
    names : tuple of str
        Of the columns; numbers from 1 when there is no header.
    places : tuple of int
        Which cell of a row each of them is, from 0.
    rows : Lines
        The lines that are rows.
    delimiter : str
        What separates the cells.
    decimal : str
        The mark of the decimals: ``"."``, ``","``, or ``"auto"`` for what each column's cells prove.
    source : str
        The file's name.
    note : str
        What of the text was left out.
    hinted : bool
        Whether lines above numbers without names may say what they are.
    words : tuple of int
        The columns that hold no numbers.
    stamps : tuple of int
        The columns of dates and times of day.
    """

    names: tuple[str, ...]
    places: tuple[int, ...]
    rows: Lines
    delimiter: str
    decimal: str
    source: str
    note: str = ""
    hinted: bool = False
    words: tuple[int, ...] = ()
    stamps: tuple[int, ...] = ()

    def holds(self, sign: str) -> bool:
        """Whether a sign stands in the rows."""
        return self.rows.text.find(sign, int(self.rows.begin[0])) >= 0

    def cells(self, index: int) -> Iterator[str]:
        """The cells of one column, one by one; empty where a row is too short."""
        return column_cells(self.rows, self.delimiter, self.places[index])

    def mark(self, index: int) -> str:
        """The mark of a column's decimals: stated, or proved by its cells, or by the other columns'.

        Raises InputError where a comma may stand before decimals or between thousands.
        """
        if self.decimal != AUTO:
            return self.decimal
        if not self.holds('"' if self.delimiter == "," else ","):
            return POINT
        proved, doubtful = mark_in(self.cells(index))
        if proved or not doubtful:
            return proved or POINT
        others = {mark_in(self.cells(i))[0] for i in range(len(self.names)) if i != index} - {""}
        if len(others) == 1 and (COMMA in doubtful or others == {POINT}):
            return others.pop()
        if not others and COMMA not in doubtful:
            return POINT
        small, large = doubtful.replace(COMMA, POINT), doubtful.replace(COMMA, "").replace(POINT, "")
        raise InputError(
            f"{self.source}, column {self.names[index]}: {doubtful} may be {small} or {large}; "
            "say by --decimal comma or --decimal point which mark is that of the decimals"
        )

    def column(self, index: int) -> Array:
        """The numbers of one column, NaN where a cell is missing; InputError at the first that is not a number.

        Dates with times of day, and times of day alone, become seconds since the first of them.
        """
        first = next((cell for cell in self.cells(index) if not is_missing(cell)), "")
        if is_stamp(first):
            return self.seconds(index)
        mark, quoted, place = self.mark(index), self.holds('"'), self.places[index]
        values = np.empty(len(self.rows))
        for begin, block in self.rows.blocks():
            found = numbers_of(block, self.delimiter, place, mark, quoted=quoted)
            part = values[begin : begin + len(block)]
            part[:] = list(self.one_by_one(block, index, begin, mark)) if found is None else found
        return values

    def seconds(self, index: int) -> Array:
        """A column of dates or times of day, in seconds since the first."""
        cells = list(self.cells(index))
        try:
            return stamp_seconds(cells, f"{self.source}, column {self.names[index]}")
        except BadCellError as wrong:
            raise self.no_number(cells[wrong.at], wrong.at, index, "") from None

    def one_by_one(self, block: list[str], index: int, begin: int, mark: str) -> Iterator[float]:
        """The numbers of one column of some rows, the first of which is row ``begin``."""
        for at, cell in enumerate(column_cells(block, self.delimiter, self.places[index]), start=begin):
            try:
                yield number(cell, mark)
            except ValueError:
                if not is_missing(cell):
                    raise self.no_number(cell, at, index, mark) from None
                yield np.nan

    def no_number(self, cell: str, at: int, index: int, mark: str) -> InputError:
        """The error for a cell, with the mark under which it would be a number."""
        other = next((m for m in WORDS if m != mark and fits(cell, m)), "") if mark else ""
        hint = f" with a decimal {WORDS[mark]} (--decimal {WORDS[other]})" if other else ""
        hint = hint or ("; write times as hh:mm:ss" if HOURS.fullmatch(cell) else "")
        hint = hint or ("; the header stands there again: cut the file into parts" if cell == self.names[index] else "")
        hint = hint or ("; write its unit into the header" if WITH_A_UNIT.fullmatch(cell) else "")
        where = f"line {self.rows.number[at]}, column {self.names[index]}"
        return InputError(f"{self.source}, {where}: {cell!r} is not a number{hint or '; a cell holds one, or nothing'}")


def numbers_of(block: list[str], delimiter: str, place: int, mark: str, *, quoted: bool = False) -> Array | None:
    """The numbers of one column of some rows; None where one of them is not there, or none that numpy reads.

    >>> numbers_of(["0;1,5", "1;2,5"], ";", 1, ",").tolist()
    [1.5, 2.5]
    >>> numbers_of(["0,1", "1,x"], ",", 1, "."), numbers_of(["0"], ",", 1, "."), numbers_of(["1.500"], ";", 0, ",")
    (None, None, None)
    """
    if mark == COMMA:
        if delimiter == "," or any(POINT in row for row in block):
            return None
        block = [row.replace(COMMA, POINT) for row in block]
    between = None if delimiter == BLANKS else delimiter
    try:
        found = np.loadtxt(
            block, delimiter=between, usecols=place, comments=None, ndmin=1, quotechar='"' if quoted else None
        )
    except ValueError:
        return None
    return found if found.size == len(block) else None


def parse_table(text: str, *, source: str, decimal: str = AUTO) -> TextTable:
    r"""Split delimited text into a table.

    Rows of numbers begin where a line and the last one have as many numbers.  The line above them names the columns,
    and one more between them may hold their units; what stands before, as the preamble of an instrument, is left out,
    and so are empty lines, columns without a cell, and comments, which begin with # or % (the last one above the table
    may name the columns).  A first line "sep=;" says what separates the cells.

    Parameters
    ----------
    text : str
        The table; a byte order mark before it is none of it.
    source : str
        What it is called in messages.
    decimal : {"auto", ".", ","}
        The mark of the decimals; each column's cells prove it by default.

    Returns
    -------
    TextTable
        Its columns, parsed when they are asked for.

    Raises
    ------
    InputError
        When there is no row of numbers.

    Examples
    --------
    >>> table = parse_table("t_s,u\n0,1.5\n0.5,2.5\n", source="run.csv")
    >>> table.names, table.column(1).tolist()
    (('t_s', 'u'), [1.5, 2.5])
    >>> table = parse_table("sep=;\nmade by X\nZeit;u\n[ms];[mm]\n0;1,5\n1;2,5\n", source="run.csv")
    >>> table.names, table.column(1).tolist()
    (('Zeit [ms]', 'u [mm]'), [1.5, 2.5])
    """
    text = with_line_feeds(text.removeprefix(BOM))
    given = stated_delimiter(text)
    lines, comments = lines_of(text, skip=1 if given else 0)
    if not len(lines):
        raise InputError(f"{source} holds no data; a table needs rows of numbers")
    row = last_row(lines)
    delimiter = given or find_delimiter(row, lines[0])
    if decimal == COMMA and delimiter == ",":
        delimiter = with_decimal_commas(lines, row, source)
    typical = cells_in(row, delimiter)
    beside = beside_remarks(lines, delimiter, typical)
    first = 0 if beside else first_numbers(lines, delimiter, typical)
    if first == len(lines):
        raise InputError(f"{source} holds no row of numbers below its header")
    check_quotes(lines.after(max(0, first - MOST_HEADS)), delimiter, source)
    heads = [cells_in(lines[at], delimiter) for at in range(max(0, first - MOST_HEADS), first)]
    rows = lines.after(first)
    if decimal == AUTO and delimiter == ",":
        check_halves(heads, typical, source)
    width = max(len(cells_in(rows[0], delimiter)), len(heads[-1]) if heads else 0)
    places = beside or filled(rows, delimiter, width)
    if delimiter == BLANKS and not beside:
        heads, places = spaced(heads, lines[first - 1], len(cells_in(rows[0], delimiter)))
    elif heads and len(heads[-1]) == 1:
        heads = [otherwise(lines[first - 1], len(places)) or heads[-1]]
    names, used = heading(heads, places)
    names = names or (commented(comments, delimiter, len(places)) if first == 0 else ())
    check_widths(rows, max(max(places) + 1, len(heads[-1]) if names and heads else 0), delimiter, source)
    gone = [name for i, name in enumerate(heads[-used]) if i not in places] if used else []
    return TextTable(
        names=numbered(names) or tuple(str(i + 1) for i in range(len(places))),
        places=places,
        rows=rows,
        delimiter=delimiter,
        decimal=decimal,
        source=source,
        note=" ".join(part for part in (left_out(first - used), empty_columns(gone)) if part),
        hinted=not names and (first > used or may_say_times(comments)),
        words=tuple(i for i, place in enumerate(places) if place < len(typical) and is_word(typical[place])),
        stamps=tuple(i for i, place in enumerate(places) if place < len(typical) and is_stamp(typical[place])),
    )


def numbered(names: Sequence[str]) -> tuple[str, ...]:
    """The names, each column without one by its number.

    >>> numbered(("", "t", "u"))
    ('1', 't', 'u')
    """
    return tuple(name or str(i) for i, name in enumerate(names, start=1))
