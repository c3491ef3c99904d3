"""Where limit cycles are: a scan of the return map in floats.  It finds where to look, and proves nothing."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Final

import sympy

from ridgeback.common.errors import InputError
from ridgeback.common.number_ring import FLOATS
from ridgeback.common.recurrences import Input, solution
from ridgeback.symbolic.arithmetic.expression_series import Program
from ridgeback.symbolic.systems.oscillator import U, V

DEGREE: Final = 12
PART: Final = 0.2
"""The length of a step, as a part of the radius of convergence read off the last coefficients."""
MOST_STEPS: Final = 1500
"""Of a motion; van der Pol's with eps = 40 takes as many."""
OCTAVES: Final = 3
"""How far from the amplitude that is expected the scan goes, up and down."""
PER_OCTAVE: Final = 5
LARGEST: Final = 1e7
"""How far a motion may swell or shrink before it is given up."""
BISECTIONS: Final = 60
ENOUGH: Final = 1e-9
"""Relative accuracy of a place: the interval Newton step squares it."""


def return_map(force: sympy.Expr, *, turns: int) -> Callable[[float], float | None]:
    """Return the size of the turning point that follows on a peak, as a function of the peak; None where none does.

    Parameters
    ----------
    force : sympy.Expr
        f(U, V) of u'' + f = 0, without further symbols.
    turns : int
        1: the size of the trough; 2: the next peak.

    Returns
    -------
    callable
        Takes a positive float.

    Examples
    --------
    >>> abs(return_map(U, turns=1)(0.5) - 0.5) < 1e-6
    True
    """

    def returned(peak: float) -> float | None:
        try:
            return _followed(force, peak, turns)
        except (InputError, OverflowError, ZeroDivisionError):
            return None  # the motion meets a singularity

    return returned


def _followed(force: sympy.Expr, peak: float, turns: int) -> float | None:
    u, v, left = peak, 0.0, turns
    pull = -2 * _coefficients(force, u, v)[2]
    if not pull > 0:
        return None
    longest = math.sqrt(peak / pull)  # of the first step: about one radian
    for number in range(MOST_STEPS):
        c = _coefficients(force, u, v)
        step = min(_length(c), longest)
        longest = math.inf
        u_end, v_end = _at(c, step)
        if not peak / LARGEST < math.hypot(u_end, v_end) < peak * LARGEST:
            return None  # the motion dies out, or runs away
        if number and v * v_end < 0:
            left -= 1
            if left == 0:
                turned = _at(c, _zero(c, step))[0] * (1 if turns == 2 else -1)
                return turned if turned > 0 else None  # else the motion is about another place
        u, v = u_end, v_end
    raise _StepsError(f"more than {MOST_STEPS} steps from the peak {peak:.6g}")


class _StepsError(InputError):
    """The motion is too stiff for the steps that are made."""


def runs_out(force: sympy.Expr, peak: float, *, turns: int) -> bool:
    """Return whether the motion from a peak is too stiff to be followed to its turning point.

    Parameters
    ----------
    force : sympy.Expr
        f(U, V) of u'' + f = 0, without further symbols.
    peak : float
        Where it starts at rest.
    turns : int
        As for ``return_map``.

    Returns
    -------
    bool
        Whether the steps run out.

    Examples
    --------
    >>> runs_out(U - 1000 * (1 - U**2) * V, 2.0, turns=1), runs_out(U - (1 - U**2) * V, 2.0, turns=1)
    (True, False)
    """
    try:
        _followed(force, peak, turns)
    except _StepsError:
        return True
    except (InputError, OverflowError, ZeroDivisionError):
        pass
    return False


def _coefficients(force: sympy.Expr, u: float, v: float) -> list[float]:
    inputs = Input(FLOATS, [u]), Input(FLOATS, [v])
    return solution(Program(force, FLOATS, dict(zip((U, V), inputs, strict=True)), U, V).root, *inputs, DEGREE)


def _length(c: list[float]) -> float:
    size = math.hypot(c[0], c[1])
    radii = [(size / abs(c[n])) ** (1 / n) for n in (DEGREE - 1, DEGREE) if c[n]]
    return PART * min(radii, default=1.0)


def _at(c: list[float], t: float) -> tuple[float, float]:
    """The polynomial and its derivative."""
    u = v = 0.0
    for x in reversed(c):
        v = v * t + u
        u = u * t + x
    return u, v


def _zero(c: list[float], end: float) -> float:
    """Where the derivative changes its sign in (0, end)."""
    low, high, rising = 0.0, end, _at(c, end)[1] > 0
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        low, high = (low, middle) if (_at(c, middle)[1] > 0) == rising else (middle, high)
    return low


def peaks(force: sympy.Expr, *, turns: int, near: Sequence[float]) -> tuple[float, ...]:
    """Return the peaks of the attracting limit cycles found, in rising order.

    Parameters
    ----------
    force : sympy.Expr
        f(U, V) of u'' + f = 0, without further symbols.
    turns : int
        1 where the cycle is its own mirror image (half the return map is enough), else 2.
    near : sequence of float
        Amplitudes about which they are expected, rising.

    Returns
    -------
    tuple of float
        Where ln(P(A)/A) falls through 0, from an eighth of the first to eight times the last; a double zero is
        passed over.

    Examples
    --------
    >>> [round(a, 6) for a in peaks(U - (1 - U**2) * V, turns=1, near=[2.0])]
    [2.00862]
    """
    mapped = return_map(force, turns=turns)

    def growth(peak: float) -> float | None:
        found = mapped(peak)
        return None if found is None else math.log(found / peak)

    return tuple(sorted(_refined(growth, *bracket) for bracket in _brackets(growth, near)))


Growth = Callable[[float], "float | None"]
Bracket = tuple[float, float, float, float]


def _brackets(growth: Growth, near: Sequence[float]) -> Iterator[Bracket]:
    """Neighbouring amplitudes between which ln(P(A)/A) falls through 0, with its values there."""
    count = math.ceil(math.log2(near[-1] / near[0]) * PER_OCTAVE) + 2 * OCTAVES * PER_OCTAVE
    last, before = 0.0, None
    for n in range(count + 1):
        here = near[0] * 2 ** (n / PER_OCTAVE - OCTAVES)
        value = growth(here)
        if before is not None and value is not None and before > 0 >= value:
            yield last, here, before, value
        if value is None and here > near[-1]:
            return  # beyond a separatrix or a singularity
        last, before = here, value


def _refined(growth: Growth, a: float, b: float, at_a: float, at_b: float) -> float:
    """The zero by false position, Illinois variant (M. Dowell and P. Jarratt, BIT 11 (1971) 168-174)."""
    for _ in range(BISECTIONS):
        c = b - at_b * (b - a) / (at_b - at_a)
        value = growth(c)
        if value is None or value == 0 or abs(b - a) < ENOUGH * abs(c):
            return c
        if (value > 0) != (at_b > 0):
            a, at_a = b, at_b
        else:
            at_a /= 2
        b, at_b = c, value
        if abs(value) < ENOUGH:
            return c
    return b
