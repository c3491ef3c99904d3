"""Dates, with times of day or without, and times of day alone, as seconds after the first of a column.

Years of four digits may come first (ISO 8601) or last.  Behind points the day is first; behind slashes and dashes it is
the day or the month, whichever every cell of the column allows.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date
from functools import lru_cache

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.files.tables.numbers import is_missing

CLOCK = r"(?P<h>\d+):(?P<m>[0-5]\d)(?::(?P<s>[0-6]\d(?:[.,]\d+)?))?"
ZONE = r"(?P<zone>Z|[+-]\d\d:?\d\d)?"
DATED = re.compile(rf"(?P<date>\d+[./-]\d+[./-]\d+)(?:(?:[ T]+|, ){CLOCK}(?: ?(?P<half>[AaPp])\.?[Mm]\.?)? ?{ZONE})?")
DAY_ALONE = re.compile(r"\d{4}[./-]\d{1,2}[./-]\d{1,2}|\d{1,2}[./-]\d{1,2}[./-](?:\d{4}|\d\d)")
"""A date without a time of day, which has two or four digits of the year."""
OF_DAY = re.compile(rf"{CLOCK}(?: ?(?P<half>[AaPp])\.?[Mm]\.?)?")
MINUTES = re.compile(r"(?P<m>\d+):(?P<s>[0-5]\d[.,]\d+)")
PARTS = re.compile(r"[./-]")
DAY, HALF_DAY = 86400.0, 12


@dataclass(frozen=True)
class Moment:
    """A day, seconds in it, and whether they are of a stated time zone."""

    day: int
    seconds: float
    zoned: bool


def is_stamp(cell: str) -> bool:
    """Whether a cell is a date, or a time of day with seconds.

    >>> is_stamp("2026-11-22T10:00:00.125"), is_stamp("22.11.2026 10:00:00"), is_stamp("20261122"), is_stamp("1.5")
    (True, True, False, False)
    >>> is_stamp("10:00:00.5"), is_stamp("00:01.5"), is_stamp("10:00")
    (True, True, False)
    >>> is_stamp("2026-11-22"), is_stamp("22.11.26"), is_stamp("1.2.3"), is_stamp("1.234.567")
    (True, True, False, False)
    """
    if ":" not in cell and not DAY_ALONE.fullmatch(cell):
        return False
    try:
        moment(cell, day_first=True)
    except ValueError:
        return is_month_first(cell)
    return True


def is_month_first(cell: str) -> bool:
    """Whether a cell is a date only where its month comes first."""
    try:
        moment(cell, day_first=False)
    except ValueError:
        return False
    return True


def moment(cell: str, *, day_first: bool) -> Moment:
    """What a stamp says; ValueError for what is none.

    >>> moment("01:00:00.5", day_first=True).seconds, moment("11/22/2026 01:00:00 PM", day_first=False).seconds
    (3600.5, 46800.0)
    >>> moment("01:00:00.5 PM", day_first=True).seconds
    46800.5
    """
    found = MINUTES.fullmatch(cell)
    if found:
        return Moment(0, 60.0 * int(found["m"]) + seconds(found["s"]), zoned=False)
    found = OF_DAY.fullmatch(cell)
    if found and found["s"]:
        return Moment(0, of_clock(found, found["half"] or ""), zoned=False)
    found = DATED.fullmatch(cell)
    if found is None or (found["h"] is None and not DAY_ALONE.fullmatch(cell)):
        raise ValueError(cell)
    zone = found["zone"] or ""
    return Moment(
        day_number(found["date"], day_first=day_first), of_clock(found, found["half"] or "") - shift(zone), bool(zone)
    )


def seconds(text: str) -> float:
    """Seconds with a decimal point or comma."""
    return float(text.replace(",", "."))


def of_clock(found: re.Match[str], half: str) -> float:
    """Seconds after midnight, 0 without a clock; ``half`` is the a or p of a clock with twelve hours."""
    if found["h"] is None:
        return 0.0
    hour = int(found["h"])
    if half:
        hour = hour % HALF_DAY + (HALF_DAY if half in "pP" else 0)
    return 3600.0 * hour + 60.0 * int(found["m"]) + seconds(found["s"] or "0")


def shift(zone: str) -> float:
    """How many seconds a zone is ahead of UTC.

    >>> shift("+01:30"), shift("Z"), shift("")
    (5400.0, 0.0, 0.0)
    """
    if zone in ("", "Z"):
        return 0.0
    hours, minutes = int(zone[1:3]), int(zone[-2:])
    return (3600.0 * hours + 60.0 * minutes) * (-1.0 if zone[0] == "-" else 1.0)


@lru_cache(maxsize=64)
def day_number(text: str, *, day_first: bool) -> int:
    """The number of a day; ValueError for a date that is none.

    >>> day_number("22.11.2026", day_first=False) == day_number("2026-11-22", day_first=True)
    True
    """
    first, second, third = PARTS.split(text)
    if len(first) == len("2026"):
        return date(int(first), int(second), int(third)).toordinal()
    if len(third) != len("2026") and "." not in text:
        raise ValueError(text)
    year = int(third) + (2000 if len(third) == len("26") else 0)
    day, month = (first, second) if day_first or "." in text else (second, first)
    return date(year, int(month), int(day)).toordinal()


def since_first(cells: Sequence[str], *, day_first: bool) -> Array:
    """Seconds after the first stamp, NaN where one is missing.

    A time of day without a date that falls by more than half a day is that of the next one.

    Raises BadCellError at the first that is none.
    """
    found = np.full(len(cells), np.nan)
    start, before, days = None, 0.0, 0
    for at, cell in enumerate(cells):
        if is_missing(cell):
            continue
        try:
            here = moment(cell, day_first=day_first)
        except ValueError:
            raise BadCellError(at) from None
        start = here if start is None else start
        if here.zoned != start.zoned:
            raise BadCellError(at)
        days += here.day == 0 and here.seconds < before - 0.5 * DAY
        before = here.seconds
        found[at] = DAY * (days + here.day - start.day) + (here.seconds - start.seconds)
    return found


class BadCellError(Exception):
    """The cell at an index is no stamp, or has a time zone where the first has none."""

    def __init__(self, at: int) -> None:
        super().__init__(at)
        self.at = at


def stamp_seconds(cells: Sequence[str], where: str) -> Array:
    """A column of stamps in seconds after the first.

    Raises BadCellError for a cell that is none, InputError where days and months cannot be told apart.

    >>> stamp_seconds(["2026-11-22 10:00:00", "", "2026-11-22 10:00:01.5"], "run.csv").tolist()
    [0.0, nan, 1.5]
    """
    readings = []
    furthest = BadCellError(-1)
    first = next((cell for cell in cells if not is_missing(cell)), "")
    for day_first in orders(first):
        try:
            readings.append(since_first(cells, day_first=day_first))
        except BadCellError as wrong:
            furthest = max(furthest, wrong, key=lambda bad: bad.at)
    if not readings:
        raise furthest
    if not np.array_equal(readings[0], readings[-1], equal_nan=True):
        raise InputError(f"{where}: {first!r} may begin with its day or its month; write dates as 2026-04-03")
    return readings[0]


def orders(cell: str) -> tuple[bool, ...]:
    """Which of day and month may come first: True for the day, which it is where the cell leaves no choice.

    >>> orders("22.11.2026 10:00:00"), orders("2026-11-22 10:00:00"), orders("11/22/2026 10:00:00")
    ((True,), (True,), (True, False))
    """
    found = DATED.fullmatch(cell)
    parts = PARTS.split(found["date"]) if found else ["2026"]
    return (True,) if len(parts[0]) == len("2026") or (found and "." in found["date"]) else (True, False)
