"""What the numbers of a time column are: how many seconds each, and from which of them time is counted."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime, timedelta
from types import MappingProxyType

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.files.column_names import SECONDS, is_date, time_unit

HOUR, DAY = 3600.0, 86_400.0
SINCE_1970: Mapping[int, tuple[str, float]] = MappingProxyType(
    {9: ("seconds", 1.0), 12: ("milliseconds", 1e-3), 15: ("microseconds", 1e-6), 18: ("nanoseconds", 1e-9)}
)
"""Units of the time since 1970 by the power of ten of its numbers from the year 2001 to 2286."""
SPREADSHEET = (25_569.0, 60_000.0)
"""Days since 30 December 1899, as spreadsheets count them, from 1970 to 2064."""
LONG_AGO = 1e9
"""Seconds from which on times are counted from the first of them."""
CLOSE, SHORT, WHOLE = 1e-4, 1e5, 0.05
"""Share by which a step may be off a whole number of seconds; a step is short that is WHOLE, or less, off one with five
decimals, of the last of these."""


@dataclass(frozen=True)
class Clock:
    """Seconds of a unit of the numbers, the number that is time 0, and what is to be said of both."""

    seconds: float = 1.0
    zero: float = 0.0
    note: str = ""

    def times(self, values: Array) -> Array:
        """The numbers as times.

        >>> Clock(60.0, 2.0).times(np.array([2.0, 3.5])).tolist()
        [0.0, 90.0]
        """
        return np.asarray(self.seconds * (values - self.zero), dtype=np.float64)


def clocks(header: str, values: Array, *, stamps: bool = False) -> tuple[Clock, ...]:
    """What the numbers under a header can be: one clock, or two where they may be seconds or a spreadsheet's days.

    A unit in the header is believed.  Without one, numbers as large as those since 1970 are those, those under the
    name of a day are days, and those that rise by a step of clocks as days, but by an odd one as seconds, are days.

    >>> [one] = clocks("timestamp", 1772359200000.0 + 4.0 * np.arange(3))
    >>> one.seconds, one.zero, one.note[:35]
    (0.001, 1772359200000.0, 'times are milliseconds since 1970, ')
    >>> [clock.seconds for step in (1 / 24, 0.01, 0.25) for clock in clocks("Time", 46082.0 + step * np.arange(9))]
    [86400.0, 1.0, 1.0, 86400.0]
    >>> clocks("t [ms]", np.arange(3.0))[0].note, clocks("time", np.arange(3.0))[0].note
    ('times in ms were converted to seconds', '')
    """
    known = values[np.isfinite(values)]
    unit, seconds = time_unit(header)
    if stamps or not known.size:
        return (Clock(),)
    first = float(known[0])
    if unit and unit.lower() not in SECONDS:
        return (Clock(note=f"the unit of time, {unit}, is not known: what is printed per second is per {unit}"),)
    if unit or is_date(header):
        return (converted(unit or "days", seconds if unit else DAY, first),)
    if first >= LONG_AGO:
        name, seconds = SINCE_1970.get(int(np.log10(first)), ("", 1.0))
        return (
            Clock(seconds, first, f"times are {name} since 1970, {from_first(first, seconds)}") if name else Clock(),
        )
    days = Clock(DAY, first, f"times without a unit were taken for a spreadsheet's days, {from_first(first, DAY)}")
    if not SPREADSHEET[0] <= first <= SPREADSHEET[1] or not is_of_clocks(DAY * even_step(known)):
        return (Clock(),)
    return (Clock(), days) if is_short(even_step(known)) else (days,)


def converted(unit: str, seconds: float, first: float) -> Clock:
    """The clock of a unit, counted from the first where that is long ago."""
    note = f"times in {unit} were converted to seconds"
    if seconds * first < LONG_AGO:
        return Clock(seconds, 0.0, "" if seconds == 1.0 else note)
    said = from_first(first, seconds)
    return Clock(seconds, first, f"times in {unit} are {said}" if seconds == 1.0 else f"{note}, {said}")


def from_first(first: float, seconds: float) -> str:
    """That times are counted from the first, and when it was.

    >>> from_first(1772359200.0, 1.0)
    'counted from the first, 1772359200 (2026-03-01 10:00:00)'
    """
    date = date_of(first, seconds)
    return f"counted from the first, {first:.16g}" + (f" ({date})" if date else "")


def date_of(number: float, seconds: float) -> str:
    """The date that a number is as a spreadsheet's day or as a time since 1970; empty where there is none.

    >>> date_of(46082.5, DAY), date_of(1772359200.0, 1.0), date_of(739000.0, DAY), date_of(1749.0, 31557600.0)
    ('2026-03-01 12:00:00', '2026-03-01 10:00:00', '', '')
    """
    as_days = seconds == DAY and SPREADSHEET[0] <= number <= SPREADSHEET[1]
    if not as_days and seconds > 1.0:
        return ""
    begin = datetime(1899, 12, 30) if as_days else datetime(1970, 1, 1)
    try:
        return f"{begin + timedelta(seconds=round(seconds * number)):%Y-%m-%d %H:%M:%S}"
    except OverflowError:
        return ""


def even_step(values: Array) -> float:
    """The step of even numbers, of which some may be missing, by the first and the last of them.

    >>> even_step(np.array([0.0, 0.3, 0.7, 1.0, 2.0]))
    0.3333333333333333
    """
    steps = np.diff(values)
    usual = float(np.median(steps)) if steps.size else 0.0
    return float(values[-1] - values[0]) / max(1, round((values[-1] - values[0]) / usual)) if usual > 0.0 else 0.0


def is_of_clocks(step: float) -> bool:
    """Whether a step in seconds is one that people set: seconds that divide an hour, hours that divide a day, days.

    >>> [is_of_clocks(step) for step in (600.0, 10800.0, 864.0, 172800.0, 8640.0)]
    [True, True, False, True, False]
    """
    whole = round(step)
    if whole < 1 or abs(step - whole) > CLOSE * step:
        return False
    return HOUR % whole == 0.0 or (whole % HOUR == 0.0 and (DAY % whole == 0.0 or whole % DAY == 0.0))


def is_short(step: float) -> bool:
    """Whether a step has few decimals.

    >>> is_short(0.125), is_short(1 / 24)
    (True, False)
    """
    return abs(SHORT * step - round(SHORT * step)) < WHOLE


def only(found: tuple[Clock, ...], header: str, values: Array, source: str) -> Clock:
    """The one clock that there is; InputError where they may be seconds or days, with what tells these apart."""
    if len(found) == 1:
        return found[0]
    known = values[np.isfinite(values)]
    first, step = float(known[0]), even_step(known)
    raise InputError(
        f"{source}: the times in column {header}, from {first:.9g} in steps of {step:.6g}, may be seconds, or days as "
        f"spreadsheets count them, from {date_of(first, DAY)}; give --rate {1.0 / step:.6g} for seconds or "
        f'--rate {1.0 / (DAY * step):.6g} for days, or name the column "{header} [s]" or "{header} [d]"'
    )
