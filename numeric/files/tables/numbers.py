"""Numbers as people write them in tables: the mark of the decimals, marks between thousands, cells without a value."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from types import MappingProxyType

from ridgeback.common.errors import InputError

AUTO, POINT, COMMA = "auto", ".", ","
"""The mark of the decimals: found from a column's cells, or stated."""
MARKS: Mapping[str, str] = MappingProxyType(
    {AUTO: AUTO, "point": POINT, "dot": POINT, POINT: POINT, "comma": COMMA, COMMA: COMMA}
)
"""The words for them."""
MISSING = frozenset(
    (
        "",
        "na",
        "n/a",
        "nan",
        "-nan",
        "null",
        "none",
        "-",
        "--",
        "#n/a",
        "#num!",
        "#value!",
        "#div/0!",
        "#ref!",
        "#null!",
    )
)
"""Cells that say that there is no value, spreadsheets' errors among them; they are read as NaN."""
MINUS = "\u2212"
BLANK = " '\u2019\u00a0\u2009\u202f"
"""What may stand between thousands, beside the mark that is not the decimals'."""
INFINITE = frozenset(["inf", "infinity"])


def between(mark: str) -> str:
    """What may stand between thousands where ``mark`` is the decimals'.

    >>> "," in between("."), "." in between(".")
    (True, False)
    """
    return BLANK + (POINT if mark == COMMA else COMMA)


def shape(mark: str) -> re.Pattern[str]:
    """Numbers whose decimals stand behind ``mark``; three digits each behind a mark between thousands."""
    whole = rf"[1-9][0-9]{{0,2}}(?:([{re.escape(between(mark))}])[0-9]{{3}})(?:\1[0-9]{{3}})*|[0-9]+"
    return re.compile(rf"[+-]?(?=[0-9{mark}])(?:{whole})?(?:{re.escape(mark)}[0-9]*)?(?:[eEdD][+-]?[0-9]+)?")


SHAPES: Mapping[str, re.Pattern[str]] = MappingProxyType({mark: shape(mark) for mark in (POINT, COMMA)})


def fits(cell: str, mark: str) -> bool:
    """Whether a cell is a number under a mark.

    >>> fits("1,234.5", "."), fits("1,234.5", ","), fits("1,5", "."), fits("1_05", ".")
    (True, False, False, False)
    """
    return SHAPES[mark].fullmatch(cell.replace(MINUS, "-")) is not None


def number(cell: str, mark: str) -> float:
    """The number in a cell; ValueError where it is none under this mark.

    >>> number("1.05e-3", "."), number("1,5", ","), number("-1.234,5", ","), number("12 345.5", "."), number("1D3", ".")
    (0.00105, 1.5, -1234.5, 12345.5, 1000.0)
    """
    text = cell.replace(MINUS, "-")
    if SHAPES[mark].fullmatch(text) is None:
        if text.lstrip("+-").lower() not in INFINITE:
            raise ValueError(cell)
        return float(text)
    whole, point, decimals = text.replace("D", "E").replace("d", "e").partition(mark)
    bare = "".join(sign for sign in whole if sign not in between(mark))
    return float(f"{bare}.{decimals}" if point else bare)


def is_number(cell: str) -> bool:
    """Whether a cell reads as a number under either mark, or as a missing one.

    >>> is_number("1e-3"), is_number("1,5"), is_number("time"), is_number("NaN")
    (True, True, False, True)
    """
    return is_missing(cell) or fits(cell, POINT) or fits(cell, COMMA) or cell.lstrip("+-").lower() in INFINITE


def is_missing(cell: str) -> bool:
    """Whether a cell says that there is no value.

    >>> is_missing("n/a"), is_missing("0")
    (True, False)
    """
    return cell.lower() in MISSING


def mark_in(cells: Iterable[str]) -> tuple[str, str]:
    """The mark that cells prove, empty for none; then the first cell that may be read under both.

    >>> mark_in(["12", "1,234", "0,5"]), mark_in(["1,234", "2,000"]), mark_in(["1.234,5"]), mark_in(["7"])
    ((',', '1,234'), ('', '1,234'), (',', ''), ('', ''))
    """
    doubtful = ""
    for cell in cells:
        if POINT in cell or COMMA in cell:
            point, comma = fits(cell, POINT), fits(cell, COMMA)
            if point != comma:
                return (POINT if point else COMMA), doubtful
            if point and not doubtful:
                doubtful = cell
    return "", doubtful


def stated_mark(word: str) -> str:
    """The mark that a word names.

    Raises InputError for another word.

    >>> stated_mark("comma"), stated_mark("."), stated_mark("auto")
    (',', '.', 'auto')
    """
    mark = MARKS.get(word.strip().lower())
    if mark is None:
        raise InputError(f"decimal mark {word!r} is unknown; use one of auto, point or comma")
    return mark
