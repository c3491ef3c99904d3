"""Which columns of a file are the time, the signals and the run: by name, by number, or as the only ones left."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.files.column_names import is_date, is_time, name_and_units
from ridgeback.numeric.files.columns import Columns

ALL = "all"
EVEN = 0.02
"""Share of the usual step by which one may differ in a column without a name that is taken for the time."""
MOST_DAYS = 1e6
"""Since whatever day they are counted from."""
SHOWN = 12
"""Column names that a message lists."""


def listed(columns: Columns, indices: Sequence[int] | None = None) -> str:
    """Column names for a message, the first few of many."""
    chosen = range(len(columns.names)) if indices is None else indices
    names = [columns.names[i] for i in chosen]
    more = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
    return ", ".join(names[:SHOWN]) + more


def find_column(columns: Columns, wanted: str | int) -> int:
    """Index of a column by its name (with or without its unit) or its number from 1; InputError lists the columns."""
    for candidates in (columns.names, [name_and_units(name)[0] for name in columns.names]):
        hits = [i for i, name in enumerate(candidates) if name == wanted]
        if len(hits) == 1:
            return hits[0]
        if hits:
            raise InputError(f"{columns.source} has {len(hits)} columns {wanted}; name one by its number from 1")
    if str(wanted).strip().isdecimal() and 1 <= int(wanted) <= len(columns.names):
        return int(wanted) - 1
    raise InputError(f"{columns.source} has no column {wanted}; it has {listed(columns)} (or a number from 1)")


def time_index(columns: Columns, wanted: str | int | None, rate: float | None) -> int | None:
    """Index of the time column, or None where the rate is stated by the file or given."""
    if wanted is not None:
        if columns.rate is not None and wanted not in columns.names:
            raise InputError(f"{columns.source} states its sampling rate and has no time column; leave {wanted} out")
        return find_column(columns, wanted)
    hits = [i for i, name in enumerate(columns.names) if is_time(name)]
    hits = hits or [i for i, name in enumerate(columns.names) if is_date(name) and tells_time(columns, i)]
    if hits:
        return hits[0]
    if rate is None and columns.rate is None:
        if rises_evenly(columns):
            return 0
        raise InputError(
            f"{columns.source} has no time column among {listed(columns)}; "
            f"name it (--time-column), or give the sampling rate in its place (--rate)"
        )
    return None


def tells_time(columns: Columns, index: int) -> bool:
    """Whether a column of days is dates, or rising numbers of them: no months, nor years before months and days.

    >>> def days(*values, **more):
    ...     return Columns(("Day", "u"), (3, 3), lambda i: np.array(values), str, "run.csv", **more)
    >>> tells_time(days(1.0, 2.0, 4.0), 0), tells_time(days(1.0, 1.0, 2.0), 0), tells_time(days(2e7, 2.1e7, 2.2e7), 0)
    (True, False, False)
    """
    if index in columns.stamps:
        return True
    if index in columns.words or columns.rate is not None:
        return False
    values = columns.values(index)
    return bool(values.size > 1 and values[0] < MOST_DAYS and (np.diff(values[np.isfinite(values)]) > 0.0).all())


def unnamed(name: str, index: int) -> bool:
    """Whether a column has its number for a name."""
    return name == str(index + 1)


def numbered(name: str, index: int) -> bool:
    """Whether a column has its number for a name, or that of its matrix with its number.

    >>> numbered("2", 1), numbered("x[2]", 1), numbered("u", 1)
    (True, True, False)
    """
    return unnamed(name, index) or name.endswith(f"[{index + 1}]")


def rises_evenly(columns: Columns) -> bool:
    """Whether the first of several columns without names rises in even steps, other than those of a count.

    Not where lines above the numbers say something that was not understood: it may have been of them.

    >>> def two(step, **more):
    ...     return Columns(("1", "2"), (9, 9), lambda i: step * np.arange(9.0), str, "run.csv", **more)
    >>> rises_evenly(two(0.1)), rises_evenly(two(1.0)), rises_evenly(two(-0.1)), rises_evenly(two(0.1, hinted=True))
    (True, False, False, False)
    """
    if columns.hinted or len(columns.names) < 2 or not all(map(numbered, columns.names, range(len(columns.names)))):
        return False
    steps = np.diff(columns.values(0))
    usual = float(np.median(steps)) if steps.size and np.isfinite(steps).all() else 0.0
    return usual > 0.0 and usual != 1.0 and bool((np.abs(steps - usual) <= EVEN * usual).all())


def is_signal(name: str, index: int, *, beside: bool) -> bool:
    """Whether a column's name is no mere number, nor that of a day where it stands ``beside`` a time.

    >>> is_signal("u", 1, beside=True), is_signal("2", 1, beside=True), is_signal("Date", 1, beside=True)
    (True, False, False)
    """
    return not unnamed(name, index) and not (beside and is_date(name))


def counts(columns: Columns, index: int) -> bool:
    """Whether a column numbers the rows.

    >>> counts(Columns(("frame", "u"), (4, 4), lambda i: (i + 1) * np.arange(4.0), str, "run.csv"), 0)
    True
    """
    if index in columns.words:
        return False
    try:
        steps = np.diff(columns.values(index))
    except InputError:
        return False
    return steps.size > 0 and bool((steps == 1.0).all())


def signal_indices(
    columns: Columns, wanted: str | int | Sequence[str | int] | None, taken: Sequence[int | None]
) -> tuple[int, ...]:
    """Indices of the signals: those asked for (a name, a number, several, or "all"), or the only one left.

    ``taken`` are the columns of the time and the run.  No signal are a day beside a time, words, dates, a column
    without a name among some that have one, and one that numbers the rows.

    Raises InputError for one that is not there or taken.
    """
    clock = next((i for i in taken if i is not None), None)
    rows = None if clock is None else columns.sizes[clock]
    others = [i for i in range(len(columns.names)) if i not in taken and rows in (None, columns.sizes[i])]
    if wanted is None or (wanted == ALL and ALL not in columns.names):
        others = [i for i in others if i not in (*columns.words, *columns.stamps)] or others
        others = [i for i in others if is_signal(columns.names[i], i, beside=clock is not None)] or others
        if len(others) > 1:
            others = others[counts(columns, others[0]) :]  # a number of the row comes first
    if wanted is None:
        if len(others) == 1:
            return tuple(others)
        found = listed(columns, others) or "only the time column"
        raise InputError(f"{columns.source}: say which column holds the signal by --column; it has {found} (or {ALL})")
    if wanted == ALL and ALL not in columns.names and others:
        return tuple(others)
    chosen = tuple(find_column(columns, word) for word in words(columns, wanted))
    for index in chosen:
        if index in taken:
            what = "the time" if index == clock else "the run"
            raise InputError(f"{columns.source}: column {columns.names[index]} is {what}, not a signal; name another")
    return tuple(dict.fromkeys(chosen))


def words(columns: Columns, wanted: str | int | Sequence[str | int]) -> list[str | int]:
    """The columns asked for one by one; a text with commas is one name when there is a column of that name."""
    if isinstance(wanted, int) or wanted in columns.names:
        return [wanted]
    if isinstance(wanted, str):
        return [word.strip() for word in wanted.split(",")]
    return list(wanted)
