"""Errors of numbers that a program printed, and the power with which a series' error grows: both enclosed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from flint import arb, ctx

from ridgeback.symbolic.certificates.accuracy import certified_error
from ridgeback.symbolic.enclosure.enclosure import enclose
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.systems.oscillator import Oscillator

BITS, GUARD = 128, 40
FINE_BITS = 512
"""Of the errors at small amplitudes, which shrink like A^(n + 2)."""


@dataclass(frozen=True)
class Errors:
    """Relative errors of values against the exact omega0, ``[row][amplitude]``."""

    exact: tuple[float, ...]
    """Exact omega0 at each amplitude, to the nearest double."""
    signed: tuple[tuple[float, ...], ...]
    bounds: tuple[tuple[float, ...], ...]
    """The size of each error is certainly at most this."""


def errors_of_values(oscillator: Oscillator, amplitudes: Sequence[float], values: Sequence[Sequence[float]]) -> Errors:
    """Enclose the relative error of doubles, taken as exactly what they are.

    Parameters
    ----------
    oscillator
        With an enclosure: numbers for its parameters, a family of periodic orbits.
    amplitudes
        Peak amplitudes, exactly these doubles.
    values
        What some formula gave at each amplitude, a row for each formula, in rad per time unit.

    Raises
    ------
    InputError
        Where omega0 has no enclosure.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> found = errors_of_values(find("pendulum"), [1.0], [[0.9381]])
    >>> round(found.exact[0], 6), f"{found.signed[0][0]:.1e}", found.bounds[0][0] >= abs(found.signed[0][0])
    (0.937792, '3.3e-04', True)
    """
    balls = [enclose(oscillator, Fraction(a), bits=BITS).omega for a in amplitudes]
    with ctx.workprec(BITS + GUARD):
        rows = [[arb(value) / ball - 1 for value, ball in zip(row, balls, strict=True)] for row in values]
        bounds = tuple(tuple(math.nextafter(float(abs(e).upper()), math.inf) for e in row) for row in rows)
        signed = tuple(tuple(float(e.mid()) for e in row) for row in rows)
        return Errors(tuple(float(ball.mid()) for ball in balls), signed, bounds)


def growth_power(oscillator: Oscillator, expansion: Expansion, small: Fraction, large: Fraction) -> float:
    """The power of A with which the error of a series grows between two amplitudes; NaN where an error may vanish.

    Parameters
    ----------
    oscillator
        With an enclosure.
    expansion
        A series of it, truncated.
    small, large
        Peak amplitudes.

    Examples
    --------
    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> round(growth_power(find("pendulum"), lindstedt(find("pendulum"), 4), Fraction(1, 20), Fraction(1, 10)), 2)
    6.0
    """
    low, high = (certified_error(oscillator, expansion, a, bits=FINE_BITS) for a in (small, large))
    if low.contains(0) or high.contains(0):
        return math.nan
    with ctx.workprec(FINE_BITS):
        return float((abs(high / low).log() / arb(float(large / small)).log()).mid())
