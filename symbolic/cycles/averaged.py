"""About where limit cycles are: the amplitudes at which a cosine of the natural frequency loses nothing in a cycle."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Final

import sympy

from ridgeback.common.errors import InputError
from ridgeback.common.number_ring import FLOATS
from ridgeback.common.recurrences import Input
from ridgeback.symbolic.arithmetic.expression_series import Program
from ridgeback.symbolic.systems.oscillator import U, V

POINTS: Final = 16
"""Phases of a cycle at which the force is taken."""
OCTAVES: Final = 20
PER_OCTAVE: Final = 2
ROUNDED: Final = 1e-12
"""Share of its terms to which a sum of them is right where they grow as fast as an exponential of some hundreds."""
BISECTIONS: Final = 20
"""From half an octave to 3e-7."""


def balanced_amplitudes(force: sympy.Expr, k: float) -> tuple[float, ...]:
    """Return the amplitudes at which the averaged loss changes its sign, in rising order, to 3e-7.

    Parameters
    ----------
    force : sympy.Expr
        f(U, V) of u'' + f = 0, without further symbols.
    k : float
        Natural frequency, in rad per time unit.

    Returns
    -------
    tuple of float
        Between 2**-20 and 2**20; empty where there is none.

    References
    ----------
    N. M. Krylov and N. N. Bogoliubov, Introduction to Non-Linear Mechanics, Princeton University Press, 1943.

    Examples
    --------
    >>> [round(a, 5) for a in balanced_amplitudes(U - (1 - U**2) * V / 10, 1.0)]
    [2.0]
    """
    grid = [2.0 ** (n / PER_OCTAVE) for n in range(-OCTAVES * PER_OCTAVE, OCTAVES * PER_OCTAVE + 1)]
    losses = [(a, loss) for a in grid if (loss := averaged_loss(force, k, a)) is not None]
    return tuple(
        _zero(force, k, a, b, falls=before > 0)
        for (a, before), (b, after) in pairwise(losses)
        if (before > 0) != (after > 0)
    )


def _zero(force: sympy.Expr, k: float, low: float, high: float, *, falls: bool) -> float:
    """Where the averaged loss changes its sign between two amplitudes, by bisection while it is real there."""
    for _ in range(BISECTIONS):
        middle = math.sqrt(low * high)
        loss = averaged_loss(force, k, middle)
        if loss is None:
            break
        low, high = (middle, high) if (loss > 0) == falls else (low, middle)
    return math.sqrt(low * high)


def averaged_loss(force: sympy.Expr, k: float, a: float) -> float | None:
    """The mean of -f sin(theta) over u = a cos(theta), u' = -a k sin(theta); None where f is not real there.

    None, too, where what is left of the terms may be their rounding.

    >>> round(averaged_loss(V, 1.0, 2.0), 12)
    1.0
    >>> averaged_loss(V + sympy.sinh(U), 1.0, 2.0) is None, averaged_loss(V + sympy.sinh(U), 1.0, 50.0) is None
    (False, True)
    """
    phases = [2 * math.pi * (n + 0.5) / POINTS for n in range(POINTS)]
    try:
        values = [_value(force, a * math.cos(p), -a * k * math.sin(p)) * -math.sin(p) for p in phases]
    except (InputError, OverflowError, ZeroDivisionError):
        return None
    if not all(map(math.isfinite, values)):
        return None
    total = math.fsum(values)
    return total / POINTS if abs(total) > ROUNDED * math.fsum(map(abs, values)) else None


def _value(force: sympy.Expr, u: float, v: float) -> float:
    return float(Program(force, FLOATS, {U: Input(FLOATS, [u]), V: Input(FLOATS, [v])}, U, V).root.get(0))
