r"""Walks along a force from the bottom of its well, each step proved by balls: where it ends and where a level is met.

The force is positive on a step [x, y] when its ball over the step is, when it is monotone there and positive at both
ends, or, for the step that begins at 0, when its slope is positive.  A zero is found with a proof that it is the
first one: the force is positive before it, and falls all through the step that holds it.  Refinement is the interval
Newton method (R. E. Moore, Interval Analysis, Prentice-Hall, 1966, chapter 7).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, Literal, TypeAlias, TypeVar

from flint import arb, ctx

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, silent
from ridgeback.symbolic.enclosure.ball_functions import Function

MAX_STEPS: Final = 4000
SMALLEST_STEP: Final = 60
"""A walk gives up when its step falls below 2**-60 of where it stands."""

MAX_REFINEMENTS: Final = 400

ATTEMPTS: Final = 4
"""How often the working precision is doubled before balls are declared unable to decide."""

End: TypeAlias = Literal["stopped", "zero", "singular", "exhausted", "undecided"]


class UndecidedError(ArithmeticError):
    """Balls of this precision are too wide to decide; more bits may do."""


T = TypeVar("T")

AT_AN_AMPLITUDE: Final = (
    "the force touches 0 without crossing it, or the orbit all but meets a separatrix or singularity); use a smaller "
    "amplitude"
)


def decided(
    attempt: Callable[[int], T], name: str, working: int, progress: Progress = silent, *, why: str = AT_AN_AMPLITUDE
) -> T:
    """The answer of ``attempt(bits)`` at the first precision, doubled a few times, at which balls can decide.

    ``progress`` is told each precision that is tried, whose cost about doubles from one to the next.

    Raises InputError when none of them can, with what may be ``why`` (it closes a bracket) and what would work.
    """
    for doubling in range(ATTEMPTS):
        precision = working << doubling
        progress(((1 << doubling) - 1) / ((1 << ATTEMPTS) - 1), f"balls of {precision} bits")
        try:
            with ctx.workprec(precision):
                return attempt(precision)
        except UndecidedError:
            continue
    raise InputError(f"{name}: balls of {working << (ATTEMPTS - 1)} bits cannot decide here ({why}")


@dataclass(frozen=True)
class Walk:
    """How a walk ended, and a ball around the place: the last step taken, or the zero of the force."""

    end: End
    place: arb


def walk(force: Function, slope: Function, *, step: arb, stop: Callable[[arb, arb], bool], last: arb | None) -> Walk:
    """Walk to the right from u = 0 while the force is provably positive, until ``stop(start, end)`` of a step.

    No step passes ``last``; the walk is ``stopped`` on reaching it.

    >>> walk(arb.sin, arb.cos, step=arb(1), stop=lambda x, y: False, last=arb(3)).end
    'stopped'
    >>> found = walk(arb.sin, arb.cos, step=arb(1), stop=lambda x, y: False, last=arb(100))
    >>> found.end, found.place.overlaps(arb.pi())
    ('zero', True)
    """
    x, tiny = arb(0), arb(2) ** -SMALLEST_STEP
    for _ in range(MAX_STEPS):
        y = (x + step).mid()
        y = last if last is not None and not y < last else y
        box = x.union(y)
        if _positive(force, slope, x, y, box):
            if y is last or stop(x, y):
                return Walk("stopped", box)
            x, step = y, 2 * step
        elif not x.is_zero() and slope(box) < 0 and force(y) < 0:
            return Walk("zero", root(force, slope, x, y))
        elif step < tiny * (x if not x.is_zero() else arb(1)):
            return Walk("undecided" if force(box).is_finite() else "singular", box)
        else:
            step = step / 2
    return Walk("exhausted", x)


def _positive(force: Function, slope: Function, x: arb, y: arb, box: arb) -> bool:
    if not x.is_zero() and force(box) > 0:
        return True
    rate = slope(box)
    if x.is_zero():
        return bool(rate > 0)
    monotone = rate > 0 or rate < 0
    return bool(monotone and force(x) > 0 and force(y) > 0)


def level(value: Function, force: Function, slope: Function, energy: arb, *, step: arb, last: arb) -> arb | None:
    """The first place to the right of 0 where the potential meets ``energy``; None when the force ends before.

    None as well when the potential stays below it as far as it is followed.  Raises UndecidedError when balls cannot
    tell.

    >>> place = level(lambda u: u**2 / 2, lambda u: u, lambda u: arb(1), arb(2), step=arb(1), last=arb(9))
    >>> place.contains(2)
    True
    """
    low, high = arb(0), last

    def above(_: arb, y: arb) -> bool:
        nonlocal low, high
        here = value(y) - energy
        if here < 0:
            low = y
        elif here > 0:
            high = y
        return high is y

    found = walk(force, slope, step=step, stop=above, last=last)
    if found.end == "stopped":
        return _within(value, force, energy, low, high)
    if found.end == "zero":
        return _within(value, force, energy, low, found.place.lower())
    if found.end == "undecided":
        raise UndecidedError
    return None


def _within(value: Function, force: Function, energy: arb, low: arb, high: arb) -> arb | None:
    top = value(high) - energy
    if top < 0:
        return None
    if not top > 0:
        raise UndecidedError
    return root(lambda u: value(u) - energy, force, low, high)


def root(f: Function, slope: Function, low: arb, high: arb) -> arb:
    """A tight ball around the one zero of f between the exact places low and high, at the present precision.

    f must be monotone there and change its sign.  Raises UndecidedError when the ball does not shrink.

    >>> root(lambda x: x**2 - 2, lambda x: 2 * x, arb(1), arb(2)).overlaps(arb(2).sqrt())
    True
    """
    for _ in range(MAX_REFINEMENTS):
        box = low.union(high)
        rate, middle = slope(box), ((low + high) / 2).mid()
        if not rate.is_finite() or rate.contains(0):
            low, high = _halved(f, low, high)
            continue
        new = middle - f(middle) / rate
        width, low, high = high - low, _larger(low, new.lower()), -_larger(-high, -new.upper())
        if high < low:
            raise UndecidedError
        if not 2 * (high - low) < width:
            return low.union(high)
    raise UndecidedError


def _larger(a: arb, b: arb) -> arb:
    return a if a > b else b


def _halved(f: Function, low: arb, high: arb) -> tuple[arb, arb]:
    """About half of the interval, with the sign change; the cut moves when it hits the zero itself."""
    left = f(low)
    for eighths in (4, 3):
        cut = (low + (high - low) * eighths / 8).mid()
        here = f(cut)
        if (left < 0 and here > 0) or (left > 0 and here < 0):
            return low, cut
        if (left < 0 and here < 0) or (left > 0 and here > 0):
            return cut, high
    raise UndecidedError
