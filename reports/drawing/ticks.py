"""How errors and times are written along an axis."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable

from ridgeback.common.numbers import number, power_of_ten, threshold


def per_cent_tick(value: float) -> str:
    """A decade of a relative error.

    >>> per_cent_tick(1e-4), per_cent_tick(1.0), per_cent_tick(1e-9)
    ('0.01 %', '100 %', '10⁻⁹')
    """
    return f"{100 * value:.10g} %" if value > 0.9e-6 else threshold(value)


def error_ticks(values: Iterable[float]) -> Callable[[float], str]:
    """How the decades of one axis are written: in per cent, or all as powers of ten where one lies below 0.0001 %.

    >>> [error_ticks([1e-8, 1e-2])(v) for v in (1e-8, 1e-2)], error_ticks([1e-6, 1e-2])(1e-2)
    (['10⁻⁸', '10⁻²'], '1 %')
    """
    if min(values, default=1.0) > 0.9e-6:
        return per_cent_tick
    return lambda value: power_of_ten(round(math.log10(value)))


def round_duration(seconds: float) -> str:
    """A round time on an axis.

    >>> round_duration(1e-6), round_duration(0.1), round_duration(1e-10)
    ('1 µs', '0.1 s', '0.1 ns')
    """
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6), ("ns", 1e-9)):
        if seconds > 0.09 * size if unit in ("s", "ns") else seconds > 0.9 * size:
            return f"{number(seconds / size, 2)} {unit}"
    return f"{number(seconds / 1e-9, 2)} ns"
