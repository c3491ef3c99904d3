"""Sampling and noise of a study: lengths and rates in time units or in natural periods."""

from __future__ import annotations

import math
from collections.abc import Mapping
from decimal import Decimal
from typing import Any, TypeVar

from ridgeback.common.errors import InputError
from ridgeback.compare.studies.file.axes import floats, shown
from ridgeback.compare.studies.file.keys import KEYS, given
from ridgeback.compare.studies.file.places import LocatedError, Source
from ridgeback.compare.studies.plan import Signal

T = TypeVar("T")


PAIRS = (("duration", "rate"), ("periods", "samples_per_period"))
"""Lengths and rates in time units, and in natural periods: one pair or the other."""


def own_signal(source: Source, shared: Mapping[str, Any], own: Any, path: str) -> Signal:
    """Sampling and noise of one oscillator: what it says itself, else what all share."""
    if not isinstance(own, Mapping) or (unknown := [key for key in own if key not in KEYS["signal"]]):
        what = f"has {unknown[0]!r}" if isinstance(own, Mapping) else f"{shown(own)} is not a table"
        raise LocatedError(f"{source.place(path)}: {what}; write signal = {{ snr_db = [10, 20], trials = 4 }}")
    other = {key for i, pair in enumerate(PAIRS) if set(pair) & set(own) for key in PAIRS[1 - i]}
    kept = {key: value for key, value in shared.items() if key not in other}
    return signal_of(source, {**kept, **own}, path if own else "signal")


def signal_of(source: Source, table: Mapping[str, Any], path: str = "signal") -> Signal:
    """Sampling and noise."""
    plain = Signal()
    in_time, in_periods = ([key for key in pair if key in table] for pair in PAIRS)
    if in_time and in_periods:
        raise LocatedError(
            f"{source.place(f'{path}.{in_periods[0]}')}: stands beside {in_time[0]}; give duration and rate, in time "
            "units, or periods and samples_per_period"
        )
    if len(in_time) == 1:
        other = "rate" if in_time[0] == "duration" else "duration"
        raise LocatedError(f"{source.place(f'{path}.{in_time[0]}')}: needs {other} beside it, also in time units")
    lengths, rate = ("duration", "rate") if in_time else ("periods", "samples_per_period")
    return Signal(
        lengths=given(source, table, f"{path}.{lengths}", lambda v: floats(v, low=0.0), plain.lengths),
        rate=given(source, table, f"{path}.{rate}", lambda v: single(floats(v, low=0.0)), plain.rate),
        periods=not in_time,
        snr_db=given(source, table, f"{path}.snr_db", decibels, plain.snr_db),
        trials=given(source, table, f"{path}.trials", lambda v: whole(v, 2, 100_000), plain.trials),
        seed=given(source, table, f"{path}.seed", lambda v: whole(v, 0, 2**53), plain.seed),
    )


def single(values: tuple[T, ...]) -> T:
    """The only value."""
    if len(values) != 1:
        raise InputError(f"has {len(values)} values; give one")
    return values[0]


def whole(value: Any, low: int, high: int) -> int:
    """A whole number."""
    if type(value) is not int or not low <= value <= high:
        raise InputError(f"{shown(value)} is not a whole number from {low} to {high}")
    return value


def decibels(value: Any) -> tuple[float, ...]:
    """Ratios of signal to noise; ``inf`` is no noise.

    >>> decibels([Decimal("inf"), 20])
    (inf, 20.0)
    """
    items = value if isinstance(value, list) else [value]
    clean = [isinstance(item, Decimal) and item.is_infinite() and item > 0 for item in items]
    rest = [item for item, none in zip(items, clean, strict=True) if not none]
    found = floats(rest, low=-100.0, high=300.0, closed=True) if rest or not items else ()
    return (*([math.inf] if any(clean) else []), *found)
