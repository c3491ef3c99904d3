"""Which columns of a file are the time, the signals and the run: by name, by number, or as the only ones left."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.files.columns import Columns

TIME_NAMES = (
    "time",
    "t",
    "time_s",
    "t_s",
    "times",
    "seconds",
    "sec",
    "timestamp",
    "time_sec",
    "time_seconds",
    "datetime",
    "zeit",
    "temps",
    "tiempo",
    "tempo",
    "elapsed",
    "elapsed time",
    "relative time",
    "rel. time",
    "time stamp",
    "x_value",
)
SECONDS: Mapping[str, float] = MappingProxyType(
    {
        **dict.fromkeys(("s", "sec", "second", "seconds"), 1.0),
        **dict.fromkeys(("ms", "msec", "millisecond", "milliseconds"), 1e-3),
        **dict.fromkeys(("us", "µs", "μs", "usec", "microsecond", "microseconds"), 1e-6),
        **dict.fromkeys(("ns", "nanosecond", "nanoseconds"), 1e-9),
        **dict.fromkeys(("min", "minute", "minutes"), 60.0),
        **dict.fromkeys(("h", "hr", "hour", "hours"), 3600.0),
        **dict.fromkeys(("d", "day", "days"), 86400.0),
    }
)
"""Units of time and their lengths in seconds."""
TAILS = tuple(unit for unit in SECONDS if unit.isascii())
"""Units that may end a time column's name after an underscore."""
HEADS = ("t", "time", "times", "zeit", "elapsed")
BRACKETED = re.compile(r"(.*\S)\s*[\[(]([^\[\]()]*)[\])]\s*")
AFTER_A_SLASH = re.compile(r"(.*\S)\s+/\s*(\S+)\s*")
DEGREES = ("deg", "degs", "degree", "degrees", "°", "grad")
"""Units of angles of which 360 are a turn."""
ALL = "all"
EVEN = 0.02
"""Share of the usual step by which one may differ in a column without a name that is taken for the time."""
SHOWN = 12
"""Column names that a message lists."""


def name_and_units(header: str) -> tuple[str, str]:
    """Split a header into its name and the unit at its end, in brackets or after a blank and a slash.

    A number there is a place, not a unit.

    >>> name_and_units("u [mm]"), name_and_units("time (s)"), name_and_units("velocity"), name_and_units("x[2]")
    (('u', 'mm'), ('time', 's'), ('velocity', ''), ('x[2]', ''))
    >>> name_and_units("Time /us"), name_and_units("run1/u")
    (('Time', 'us'), ('run1/u', ''))
    """
    match = BRACKETED.fullmatch(header) or AFTER_A_SLASH.fullmatch(header)
    return (match[1], match[2]) if match and not match[2].isdecimal() else (header, "")


def short(name: str) -> str:
    """What a column is called without its folder or structure and its unit, in small letters.

    >>> short("run1/Time [s]"), short("data.t")
    ('time', 't')
    """
    bare = name_and_units(name)[0].rpartition("/")[2]
    return bare.rpartition(".")[2].strip().lower()


def is_time(name: str) -> bool:
    """Whether a column's name is that of a time.

    >>> is_time("Time [ms]"), is_time("t_ms"), is_time("time_days"), is_time("temperature")
    (True, True, True, False)
    """
    head, _, tail = short(name).rpartition("_")
    return short(name) in TIME_NAMES or (head in HEADS and tail in TAILS)


def time_unit(header: str) -> tuple[str, float]:
    """The unit of a time column and its length in seconds; 1 for none stated and for one that is not known.

    >>> time_unit("t [ms]"), time_unit("time_min"), time_unit("t"), time_unit("t [samples]")
    (('ms', 0.001), ('min', 60.0), ('', 1.0), ('samples', 1.0))
    """
    unit = name_and_units(header)[1].strip()
    tail = short(header).rpartition("_")[2]
    if not unit and tail in TAILS:
        unit = tail
    return unit, SECONDS.get(unit.lower(), 1.0)


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


def rises_evenly(columns: Columns) -> bool:
    """Whether the first of several columns without names rises in even steps, other than those of a count.

    Not where lines above the numbers were left out, which may have said something else of them.

    >>> def two(step):
    ...     return Columns(("1", "2"), (9, 9), lambda i: step * np.arange(9.0), str, "run.csv")
    >>> rises_evenly(two(0.1)), rises_evenly(two(1.0)), rises_evenly(two(-0.1))
    (True, False, False)
    """
    if columns.note or len(columns.names) < 2 or columns.names != tuple(str(i + 1) for i in range(len(columns.names))):
        return False
    steps = np.diff(columns.values(0))
    usual = float(np.median(steps)) if steps.size and np.isfinite(steps).all() else 0.0
    return usual > 0.0 and usual != 1.0 and bool((np.abs(steps - usual) <= EVEN * usual).all())


def signal_indices(
    columns: Columns, wanted: str | int | Sequence[str | int] | None, taken: Sequence[int | None]
) -> tuple[int, ...]:
    """Indices of the signals: those asked for (a name, a number, several, or "all"), or the only one left.

    ``taken`` are the columns of the time and the run.  Raises InputError for one that is not there or taken.
    """
    clock = next((i for i in taken if i is not None), None)
    rows = None if clock is None else columns.sizes[clock]
    others = [i for i in range(len(columns.names)) if i not in taken and rows in (None, columns.sizes[i])]
    if wanted is None:
        if len(others) == 1:
            return tuple(others)
        found = listed(columns, others) or "only the time column"
        raise InputError(f'{columns.source}: say which column holds the signal; it has {found} (or "{ALL}")')
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
