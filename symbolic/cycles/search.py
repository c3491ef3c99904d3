"""Where limit cycles are: a scan of the return map in floats.  It finds where to look, and proves nothing."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import sympy

from ridgeback.common.errors import InputError
from ridgeback.common.number_ring import FLOATS
from ridgeback.common.recurrences import Input, solution
from ridgeback.symbolic.arithmetic.expression_series import Program
from ridgeback.symbolic.systems.oscillator import U, V

DEGREE: Final = 12
PART: Final = 0.2
"""The length of a step, as a part of the time in which the last terms of the place would grow to the peak."""
MOST_STEPS: Final = 1500
"""Of a motion; from the peak 2, van der Pol's with eps = 60 takes fewer, with eps = 80 more."""
OCTAVES: Final = 3
"""How far from the amplitude that is expected the scan goes, up and down."""
PER_OCTAVE: Final = 5
LARGEST: Final = 1e7
"""How far a motion may swell or shrink before it is given up."""
BISECTIONS: Final = 60
RETREATS: Final = 5
"""Halvings of the way back from a peak whose motion is not followed."""
TOUCH: Final = 1e-6
"""A growth that is less than so much of the one before is 0 to within the errors of the steps."""
FAR: Final = 2
"""A motion that is farther out than so many times its peak has left the oscillation about the origin."""
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


def _followed(force: sympy.Expr, peak: float, turns: int, *, finer: int = 1) -> float | None:
    u, v, left = peak, 0.0, turns
    pull = -2 * _coefficients(force, u, v)[2]
    if not pull > 0:
        return None
    longest = math.sqrt(peak / pull)  # of the first step: about one radian
    for number in range(finer * MOST_STEPS):
        c = _coefficients(force, u, v)
        step = min(_length(c, peak) / finer, longest)
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
    raise _StepsError(u)


class _StepsError(InputError):
    """All the steps are made before the turning point: the motion is stiff, or escapes to where it is."""

    def __init__(self, u: float) -> None:
        super().__init__(f"more than {MOST_STEPS} steps")
        self.u = u


def runs_out(force: sympy.Expr, peak: float, *, turns: int) -> bool:
    """Return whether the motion from a peak stays about there and is not followed to its turning point.

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
        Whether the steps run out with |u| below twice the peak; farther out the motion has escaped.

    Examples
    --------
    >>> runs_out(U - 1000 * (1 - U**2) * V, 2.0, turns=1), runs_out(U - (1 - U**2) * V, 2.0, turns=1)
    (True, False)
    """
    try:
        _followed(force, peak, turns)
    except _StepsError as end:
        return abs(end.u) < FAR * peak
    except (InputError, OverflowError, ZeroDivisionError):
        pass
    return False


def _coefficients(force: sympy.Expr, u: float, v: float) -> list[float]:
    inputs = Input(FLOATS, [u]), Input(FLOATS, [v])
    return solution(Program(force, FLOATS, dict(zip((U, V), inputs, strict=True)), U, V).root, *inputs, DEGREE)


def _length(c: list[float], size: float) -> float:
    """How far a series goes with errors far below a size; the velocity, of another unit, has no say in it.

    >>> round(_length([0.0] * DEGREE + [2.0], 2.0), 12)
    0.2
    """
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


@dataclass(frozen=True)
class Scan:
    """What a scan of the return map found.

    Parameters
    ----------
    peaks : tuple of float
        Of attracting limit cycles, in rising order.
    lost : int
        How many motions were not followed to their turning point within ``MOST_STEPS`` steps.
    """

    peaks: tuple[float, ...]
    lost: int


def scan(force: sympy.Expr, *, turns: int, near: Sequence[float]) -> Scan:
    """Look for attracting limit cycles.

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
    Scan
        The peaks are where ln(P(A)/A) falls through 0, from an eighth of the first to eight times the last, between
        values that are more than the errors of the steps; a double zero is passed over.

    Examples
    --------
    >>> [round(a, 6) for a in scan(U - (1 - U**2) * V, turns=1, near=[2.0]).peaks]
    [2.00862]
    """
    lost = 0

    def growth(peak: float) -> float | None:
        nonlocal lost
        try:
            found = _followed(force, peak, turns)
        except _StepsError:
            lost += 1
            return None
        except (InputError, OverflowError, ZeroDivisionError):
            return None  # the motion meets a singularity
        return None if found is None else math.log(found / peak)

    def sure(peak: float, value: float) -> bool:
        try:
            finer = _followed(force, peak, turns, finer=2)
        except (InputError, OverflowError, ZeroDivisionError):
            return False
        return finer is not None and abs(math.log(finer / peak) - value) < abs(value)

    found = sorted(_refined(growth, *bracket) for bracket in _brackets(growth, sure, near))
    return Scan(tuple(found), lost)


Growth = Callable[[float], "float | None"]
Sure = Callable[[float, float], bool]
Bracket = tuple[float, float, float, float]


def _brackets(growth: Growth, sure: Sure, near: Sequence[float]) -> Iterator[Bracket]:
    """Neighbouring amplitudes between which ln(P(A)/A) falls through 0, with its values there.

    Both are told from 0: steps of half the length change them by less than they are.
    """
    count = math.ceil(math.log2(near[-1] / near[0]) * PER_OCTAVE) + 2 * OCTAVES * PER_OCTAVE
    last, before, previous = 0.0, None, 0.0
    for n in range(count + 1):
        here = near[0] * 2 ** (n / PER_OCTAVE - OCTAVES)
        value = growth(here)
        ends = value is None and here > near[-1]  # beyond a separatrix or a singularity
        if value is None and before is not None and before > 0:
            here, value = _retreat(growth, previous, here)
        previous = here
        falls = before is not None and value is not None and before > 0 >= value
        touches = value is not None and before is not None and abs(value) <= TOUCH * before
        touches = touches or (falls and value is not None and not sure(here, value))
        if falls and not touches and before is not None and value is not None and sure(last, before):
            yield last, here, before, value
        if ends:
            return
        if touches:
            continue
        last, before = here, value


def _retreat(growth: Growth, last: float, here: float) -> tuple[float, float | None]:
    """The first place on the way back at which there is a growth, halving the way; the last one tried where none is."""
    value = None
    for _ in range(RETREATS):
        here = math.sqrt(last * here)
        value = growth(here)
        if value is not None:
            break
    return here, value


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
