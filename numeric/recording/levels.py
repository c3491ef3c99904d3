"""Levels in decibels: an envelope over time, in which no oscillation is left to follow."""

from __future__ import annotations

import re

from ridgeback.common.errors import InputError

LEVEL = re.compile(r"dB *[ _(/]? *(m|u|i|r|W|m?V|[uµμ][VA]|FS|c|A|Z|SPL|Pa|g)?\)?( *rms)?( *re .*)?", re.IGNORECASE)
"""Units of levels: dB, dBm, dBu, dBV, dBµV, dB(A), dB re 20 µPa, ..."""
TAIL = re.compile(rf"(?:^|.*[ _([]){LEVEL.pattern}[])]?", re.IGNORECASE)


def is_level(name: str, unit: str) -> bool:
    """Whether a column is of a level by its unit, or by the end of its name where no unit is stated.

    >>> [is_level(name, "") for name in ("envelope_dB", "S21 dB", "L [dB(A)]")], is_level("P", "dBm")
    ([True, True, True], True)
    >>> is_level("p", "dB re 20 µPa"), is_level("gain [dB re 1]", ""), is_level("level", "dBu")
    (True, True, True)
    >>> is_level("u", "mm"), is_level("dBase", ""), is_level("mdb", ""), is_level("envelope_dB", "V")
    (False, False, False, False)
    """
    return bool(LEVEL.fullmatch(unit.strip()) if unit.strip() else TAIL.fullmatch(name.strip()))


# 20 log10 a falls by 20 / ln 10 = 8.686 dB where ln a falls by 1; a level of power, dBm, is of a^2 and falls as fast
def refuse_level(name: str, unit: str, where: str) -> None:
    """Refuse a level in decibels, which is no signal with an oscillation in it.

    Parameters
    ----------
    name, unit : str
        Of the column.
    where : str
        File and column, for the message.

    Raises
    ------
    InputError
        For a level.

    Examples
    --------
    >>> refuse_level("u", "mm", "run.csv, column u")
    >>> refuse_level("P", "dBm", "run.csv, column P")
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: run.csv, column P: a level in dB is an envelope, with no oscillation in it to \
follow; its slope in dB per time over 8.686 is the growth rate a'/a (negative in a decay); give the samples of the \
oscillation itself, or --unit with their unit if they are no level
    """
    if is_level(name, unit):
        raise InputError(
            f"{where}: a level in dB is an envelope, with no oscillation in it to follow; its slope in dB per time "
            "over 8.686 is the growth rate a'/a (negative in a decay); give the samples of the oscillation itself, or "
            "--unit with their unit if they are no level"
        )
