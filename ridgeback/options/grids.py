"""Exact amplitudes on the command line: lists and equidistant ranges of fractions."""

from __future__ import annotations

import re
from fractions import Fraction

from ridgeback.options.arguments import MAX_GRID, rational, shown


def amplitudes(text: str) -> tuple[Fraction, ...]:
    """Exact amplitudes, as a list with commas or as START:STOP:COUNT with both ends.

    >>> amplitudes("1,2.5"), amplitudes("0.1:0.3:3")
    ((Fraction(1, 1), Fraction(5, 2)), (Fraction(1, 10), Fraction(1, 5), Fraction(3, 10)))
    """
    values = spaced(text) if ":" in text else tuple(rational(word) for word in text.split(","))
    if len(values) > MAX_GRID:
        raise ValueError(f"{len(values)} amplitudes are more than {MAX_GRID}; give fewer")
    if any(value <= 0 for value in values):
        raise ValueError(f"{shown(text)} holds {float(min(values)):g}; every amplitude must be above 0")
    return values


def spaced(text: str) -> tuple[Fraction, ...]:
    """COUNT equidistant fractions from START to STOP."""
    parts = text.split(":")
    if len(parts) != 3 or not re.fullmatch(r"\d{1,6}", parts[2].strip(), re.ASCII):
        raise ValueError(f"{shown(text)} is not START:STOP:COUNT; write for example 0.1:3.0:30")
    start, stop, count = rational(parts[0]), rational(parts[1]), int(parts[2])
    if not start < stop or not 2 <= count <= MAX_GRID:
        raise ValueError(f"{shown(text)} is no range; give START < STOP and a COUNT from 2 to {MAX_GRID}")
    return tuple(start + (stop - start) * Fraction(i, count - 1) for i in range(count))
