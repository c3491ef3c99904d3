"""Axes as plain functions: a value to a place in a drawing, and the round values at which an axis is labelled."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from ridgeback.common.numbers import minus
from ridgeback.numeric.arrays import Array

ROUNDING = 1e-9
"""A relative spread below this is shown as none: it is that of the arithmetic."""
SMALL, LARGE = 1e-3, 1e6
"""Ticks below and from which they are written by powers of ten."""
STEPS = (1.0, 2.0, 2.5, 5.0, 10.0)


@dataclass(frozen=True)
class Scale:
    """From ``low .. high`` of the data to ``start .. end`` of the drawing, linearly or by decades.

    >>> Scale(0.0, 10.0, 100.0, 200.0)(2.5), Scale(1.0, 100.0, 0.0, 1.0, log=True)(10.0)
    (125.0, 0.5)
    """

    low: float
    high: float
    start: float
    end: float
    log: bool = False

    def __call__(self, value: float) -> float:
        """The place of one value."""
        return float(self.of(np.array([value]))[0])

    def of(self, values: Array) -> Array:
        """The places of values; NaN for what has none."""
        with np.errstate(invalid="ignore", divide="ignore"):
            shown = np.log10(np.where(values > 0, values, np.nan)) if self.log else np.asarray(values, dtype=float)
        low, high = (math.log10(x) if self.log else x for x in (self.low, self.high))
        return np.asarray(self.start + (shown - low) / (high - low) * (self.end - self.start))

    def clipped(self, values: Array) -> Array:
        """The same with what lies outside held at the edge; NaN stays."""
        return np.clip(self.of(values), min(self.start, self.end), max(self.start, self.end))

    def ticks(self, most: int = 6) -> tuple[float, ...]:
        """Round values within the range."""
        return decades(self.low, self.high, most) if self.log else round_values(self.low, self.high, most)


def round_values(low: float, high: float, most: int) -> tuple[float, ...]:
    """At most ``most`` multiples of 1, 2, 2.5 or 5 times a power of ten.

    >>> round_values(0.0, 20.0, 5), round_values(0.75, 1.64, 5)
    ((0.0, 5.0, 10.0, 15.0, 20.0), (0.8, 1.0, 1.2, 1.4, 1.6))
    """
    span = high - low
    if not span > 0:
        return (low,)
    power = 10.0 ** math.floor(math.log10(span / max(most, 1)))
    ways = ((s * p, range(*_within(low, high, s * p))) for p in (power, 10 * power) for s in STEPS)
    step, kept = next((step, kept) for step, kept in ways if len(kept) <= most)
    return tuple(float(f"{n * step:.12g}") for n in kept)


def _within(low: float, high: float, step: float) -> tuple[int, int]:
    """The first multiple of a step in a range and the one after the last, to rounding."""
    return math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1


def decades(low: float, high: float, most: int) -> tuple[float, ...]:
    """Powers of ten within the range, every second or third where there are many.

    >>> decades(5e-4, 2.0, 9)
    (0.001, 0.01, 0.1, 1.0)
    """
    first, last = math.ceil(math.log10(low) - 1e-9), math.floor(math.log10(high) + 1e-9)
    stride = max(1, math.ceil((last - first + 1) / most))
    return tuple(10.0**n for n in range(first, last + 1, stride))


def padded(values: Iterable[Array], *, share: float = 0.06) -> tuple[float, float]:
    """A range around all finite values, never of no width.

    >>> padded([np.array([0.0, 1.0])], share=0.1)
    (-0.1, 1.1)
    """
    kept = [v[np.isfinite(v)] for v in (np.asarray(v, dtype=float).ravel() for v in values)]
    joined = np.concatenate(kept) if kept else np.array([])
    if not joined.size:
        return 0.0, 1.0
    low, high = float(joined.min()), float(joined.max())
    size = max(abs(low), abs(high), 1e-12)
    room = share * (high - low if high - low > ROUNDING * size else size)
    return low - room, high + room


def shared_power(values: Iterable[float]) -> int:
    """The power of ten that labels of small or large ticks have in common, 0 of others.

    >>> shared_power([1.73e-5, 1.74e-5]), shared_power([0.0, 2.5e6]), shared_power([0.0, 2.5])
    (-5, 6, 0)
    """
    size = max((abs(v) for v in values), default=0.0)
    return math.floor(math.log10(size)) if size >= LARGE or 0.0 < size < SMALL else 0


def tick_labels(values: Iterable[float]) -> list[str]:
    """Labels of linear ticks, all with the same decimals.

    >>> tick_labels([0.0, 2.5, 5.0]), tick_labels([-1.0, 1000.0])
    (['0.0', '2.5', '5.0'], ['−1', '1000'])
    """
    ticks = list(values)
    size = max((abs(v) for v in ticks), default=0.0)
    if size >= LARGE or 0.0 < size < SMALL:
        digits = next((d for d in range(3, 17) if len({f"{v:.{d}g}" for v in ticks}) == len(set(ticks))), 17)
        return [minus(f"{v:.{digits}g}") for v in ticks]
    places = next((d for d in range(7) if all(abs(v - round(v, d)) <= 1e-9 * max(size, 1e-9) for v in ticks)), 7)
    return [minus(f"{v + 0.0:.{places}f}") for v in ticks]
