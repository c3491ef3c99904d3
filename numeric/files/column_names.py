"""What a column's name says: what it is called, its unit, and whether it is a time."""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType

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
    "uhrzeit",
    "zeitstempel",
    "heure",
    "hora",
    "date time",
    "date_time",
)
DATES = ("date", "datum", "fecha", "day", "tag")
"""Names of columns that hold days beside a time of day."""
SECONDS: Mapping[str, float] = MappingProxyType(
    {
        **dict.fromkeys(("s", "sec", "second", "seconds"), 1.0),
        **dict.fromkeys(("ms", "msec", "millisecond", "milliseconds"), 1e-3),
        **dict.fromkeys(("us", "µs", "μs", "usec", "microsecond", "microseconds"), 1e-6),
        **dict.fromkeys(("ns", "nanosecond", "nanoseconds"), 1e-9),
        **dict.fromkeys(("min", "minute", "minutes"), 60.0),
        **dict.fromkeys(("h", "hr", "hour", "hours"), 3600.0),
        **dict.fromkeys(("d", "day", "days"), 86400.0),
        **dict.fromkeys(("week", "weeks"), 604800.0),
        **dict.fromkeys(("yr", "year", "years"), 31557600.0),
    }
)
"""Units of time and their lengths in seconds; the year is the Julian one."""
TAILS = tuple(unit for unit in SECONDS if unit.isascii())
"""Units that may end a time column's name after an underscore."""
SPELLED = tuple(unit for unit in TAILS if len(unit) >= len("msec"))
"""Units that are the whole name of a time column."""
HEADS = ("t", "time", "times", "timestamp", "zeit", "elapsed")
BRACKETED = re.compile(r"(.*\S)\s*[\[(]([^\[\]()]*)[\])]\s*")
AFTER_A_SLASH = re.compile(r"(.*\S)\s+/\s*(\S+)\s*")
UNDER_A_SLASH = re.compile(r"([^\W\d_]+)/([^\W\d]+|°)")
AFTER_A_COMMA = re.compile(r"(.*\S)\s*,\s+(\S+)\s*")
AFTER_IN = re.compile(r"(.*\S)\s+in\s+(\S+)\s*")
DEGREES = ("deg", "degs", "degree", "degrees", "°", "grad")
"""Units of angles of which 360 are a turn."""
AFTER_A_WORD = frozenset(
    (*SECONDS, *DEGREES, "rad", "m", "mm", "cm", "µm", "um", "nm", "v", "mv", "a", "ma", "g", "n", "pa", "kpa")
)
"""Units that may stand behind "in" or a comma."""


def name_and_units(header: str) -> tuple[str, str]:
    """Split a header into its name and the unit at its end: in brackets, after a slash, a comma, or "in".

    A number there is a place, not a unit.  Without a blank before it a slash is that of a folder, unless it divides a
    time or an angle by its unit.  An angle's name may end in "_deg".

    >>> name_and_units("u [mm]"), name_and_units("time (s)"), name_and_units("velocity"), name_and_units("x[2]")
    (('u', 'mm'), ('time', 's'), ('velocity', ''), ('x[2]', ''))
    >>> name_and_units("Time /us"), name_and_units("run1/u")
    (('Time', 'us'), ('run1/u', ''))
    >>> name_and_units("t/ms"), name_and_units("phi/°"), name_and_units("Time, s"), name_and_units("beam, left")
    (('t', 'ms'), ('phi', '°'), ('Time', 's'), ('beam, left', ''))
    >>> name_and_units("Zeit in ms"), name_and_units("drop in air"), name_and_units("angle_deg")
    (('Zeit', 'ms'), ('drop in air', ''), ('angle_deg', 'deg'))
    """
    match = BRACKETED.fullmatch(header) or AFTER_A_SLASH.fullmatch(header)
    if match is None:
        worded = AFTER_IN.fullmatch(header) or AFTER_A_COMMA.fullmatch(header)
        match = worded if worded and worded[2].lower() in AFTER_A_WORD else divided(header)
    if match and not match[2].isdecimal():
        return match[1], match[2]
    tail = header.rpartition("_")[2]
    return header, tail if "_" in header and tail.lower() in DEGREES else ""


def divided(header: str) -> re.Match[str] | None:
    """Name and unit of a time or an angle that is written over its unit; None for what may be a folder's."""
    match = UNDER_A_SLASH.fullmatch(header)
    if match is None:
        return None
    of_time = match[1].lower() in HEADS and match[2].lower() in SECONDS
    return match if of_time or match[2].lower() in DEGREES else None


def short(name: str) -> str:
    """What a column is called without its folder or structure and its unit, in small letters.

    >>> short("run1/Time [s]"), short("data.t")
    ('time', 't')
    """
    bare = name_and_units(name)[0].rpartition("/")[2]
    return bare.rpartition(".")[2].strip().lower()


def is_time(name: str) -> bool:
    """Whether a column's name is that of a time.

    >>> is_time("Time [ms]"), is_time("t_ms"), is_time("time_days"), is_time("temperature"), is_time("Seconds")
    (True, True, True, False, True)
    >>> is_time("Time 1 - default sample rate [s]"), is_time("time constant")
    (True, False)
    """
    bare = short(name)
    head, _, tail = bare.rpartition("_")
    if bare in TIME_NAMES or bare in SPELLED or (head in HEADS and tail in TAILS):
        return True
    first, _, more = bare.partition(" ")
    return first in HEADS and bool(more) and name_and_units(name)[1].lower() in SECONDS


def is_date(name: str) -> bool:
    """Whether a column's name is that of a day.

    >>> is_date("Datum"), is_date("Date/Time")
    (True, False)
    """
    return short(name) in DATES


def time_unit(header: str) -> tuple[str, float]:
    """The unit of a time column and its length in seconds; 1 for none stated and for one that is not known.

    >>> time_unit("t [ms]"), time_unit("time_min"), time_unit("t"), time_unit("t [samples]")
    (('ms', 0.001), ('min', 60.0), ('', 1.0), ('samples', 1.0))
    """
    unit = name_and_units(header)[1].strip()
    tail = short(header).rpartition("_")[2]
    if not unit and tail in TAILS:  # which is the whole name where it has no underscore
        unit = tail
    return unit, SECONDS.get(unit.lower(), 1.0)
