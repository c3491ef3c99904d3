"""A proved bound of what rounding does to generated code, over its whole domain, box by box (``analysis``)."""

from __future__ import annotations

import heapq
import math
from dataclasses import dataclass
from fractions import Fraction
from typing import Final, TypeAlias

from flint import arb, ctx

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import ball
from ridgeback.symbolic.codegen.number import Real, fraction
from ridgeback.symbolic.codegen.program import Form, Function, Horner, Statement
from ridgeback.symbolic.codegen.proofs.analysis import KEPT, Computed, half_spacing, two_to
from ridgeback.symbolic.codegen.proofs.runs import Run, Seen, least, runner

BITS: Final = 128
WORK: Final = 12000
"""Operations that a bound may cost; short functions are looked at in more and smaller boxes."""
FEWEST: Final = 8
SHARP: Final = arb(1.02)
"""A box whose bound is so near to that at its middle is not halved."""
PROBES: Final = 12
"""Points at which a bound is tried before it is proved."""


@dataclass(frozen=True)
class Bound:
    """What rounding can do over a domain; ``relative`` is None where the exact value may be zero."""

    relative: Fraction | None
    absolute: Fraction
    ulps: Fraction | None
    """In units of the last place of the exact value."""
    before: Fraction
    """The absolute one without the last rounding."""
    size: Fraction
    """What the exact value is at most, without its sign."""
    least: Fraction = Fraction(0)
    """``relative`` and ``ulps`` are for values of the variable of at least this size, without their sign."""
    zero: float = math.nan
    """About where the exact value may be zero, where ``relative`` is None."""


def bound(form: Form, function: Function) -> Bound | None:
    """What rounding can do to a function of one variable, its other arguments at their defaults.

    None when an argument has no default, or the domain has no known end.  Raises InputError where a denominator or a
    root may vanish.
    """
    run = runner(form, function)
    if run is None:
        return None
    with ctx.workprec(BITS):
        return _over(function, run, form.real)


def surely_above(form: Form, function: Function, ulps: Fraction) -> bool:
    """Whether the bound, where there is one, is above so many units in the last place, as seen at a few points."""
    run = runner(form, function)
    if run is None:
        return False
    with ctx.workprec(BITS):
        low, high = start(function), Fraction(function.domain.high)
        places = (ball(low + (high - low) * (2 * i + 1) / (2 * PROBES - 1)) for i in reversed(range(PROBES)))
        found = map(run, places)
        return any(one.whole.exact != 0 and in_last_places(one.whole, form.real) > ball(ulps) for one in found)


Box: TypeAlias = tuple[Fraction, Fraction, Seen]
"""A part of the domain and what was seen on it."""


def _over(function: Function, run: Run, real: Real) -> Bound:
    low, high = start(function), Fraction(function.domain.high)
    if function.domain.argument not in function.read():
        return _worst(function, [(low, high, run(arb(0)))], real)
    length = sum(_cost(statement) for statement in function.body) + 1
    budget = max(FEWEST, WORK // length)
    boxes: list[tuple[float, Fraction, Fraction, Fraction, Seen]] = []

    def push(left: Fraction, right: Fraction) -> None:
        found = run(ball(left).union(ball(right)))
        heapq.heappush(boxes, (-_size(found), left - right, left, right, found))

    count = min(16, max(6, budget // 2 * 2))
    for i in range(count):
        push(low + (high - low) * i / count, low + (high - low) * (i + 1) / count)
    done: list[Box] = []
    while boxes and budget > 0:
        _, _, left, right, found = heapq.heappop(boxes)
        middle = (left + right) / 2
        budget -= 3
        if found.whole.error.is_finite() and _near(found, run(ball(middle)), rest=left <= 0 <= right):
            done.append((left, right, found))
            continue
        push(left, middle)
        push(middle, right)
    return _worst(function, [*done, *(box[2:] for box in boxes)], real)


def _cost(statement: Statement) -> int:
    if not isinstance(statement, Horner):
        return 1
    return 2 * KEPT + len(statement.coefficients) // 2 if statement.loops else len(statement.coefficients)


def _relative(found: Computed) -> arb:
    return found.error / found.exact.abs_lower()


def _size(found: Seen) -> float:
    sizes = [_relative(one) for one in found.parts]
    return max(float(x.upper()) if x.is_finite() else float("inf") for x in sizes)


def _near(found: Seen, middle: Seen, *, rest: bool) -> bool:
    """Whether a part's bound is near that at its middle; where it is of a binade, near what it is over its pieces."""
    if len(found.parts) > 1:
        return all(one.exact != 0 and one.exact.rad() * 8 < abs(one.exact.mid()) for one in found.parts)
    one, inner = found.whole, middle.whole
    return not (rest and one.exact.contains(0)) and bool(_relative(one) <= SHARP * inner.error / abs(inner.exact))


def _worst(function: Function, boxes: list[Box], real: Real) -> Bound:
    """The largest of each kind of error."""
    whole = [box[2].whole for box in boxes]
    if not all(one.error.is_finite() for one in whole):
        variable, high = function.domain.argument, function.domain.high
        raise InputError(
            f"the code of {function.name} may divide by zero, overflow or take the root of a negative number for "
            f"{variable} up to {high:.6g}; give a shorter range"
        )
    absolute, before, size = (
        max(map(upper, values))
        for values in ([x.error for x in whole], [x.before for x in whole], [abs(x.exact) for x in whole])
    )
    if absolute == 0:
        return Bound(absolute, absolute, absolute, before, size)
    zeros = [(left + right) / 2 for left, right, seen in boxes if any(one.exact.contains(0) for one in seen.parts)]
    if zeros:
        return Bound(None, absolute, None, before, size, zero=float(min(zeros, key=abs)))
    parts = [one for box in boxes for one in box[2].parts]
    relative, ulps = (max(map(upper, x)) for x in (map(_relative, parts), (in_last_places(p, real) for p in parts)))
    smallest = fraction(least(function, real)) if any(len(box[2].parts) > 1 for box in boxes) else Fraction(0)
    if smallest >= max(box[1] for box in boxes):
        return Bound(None, absolute, None, before, size, zero=0.0)
    return Bound(relative, absolute, ulps, before, size, least=smallest)


def in_last_places(one: Computed, real: Real) -> arb:
    """The error in units of the last place of the exact value; on both sides of a power of two in the box apart.

    The unit doubles there, and so does what the last rounding can do.
    """
    low, high = abs(one.exact).lower(), abs(one.exact).upper()
    mantissa, exponent = high.man_exp()
    edge = two_to(int(mantissa).bit_length() + int(exponent) - 1)
    if not low < edge < high:
        return (one.error / last_place(low, real)).upper()
    below = one.before + half_spacing(edge + one.before, real)
    return arb(arb.max(below / last_place(low, real), one.error / last_place(edge, real)).upper())


def last_place(size: arb, real: Real) -> arb:
    """The distance of a number of this size to the next larger one.

    >>> from ridgeback.symbolic.codegen.number import FLOAT64
    >>> last_place(arb(1), FLOAT64) == arb(2) ** -52
    True
    """
    mantissa, exponent = size.lower().man_exp()
    return two_to(max(int(mantissa).bit_length() + int(exponent) - real.digits, real.low))


def upper(x: arb) -> Fraction:
    """The upper end of a ball, exactly."""
    return fraction(x.upper().fmpq())


def start(function: Function) -> Fraction:
    """Where a domain need be looked at from: 0 where the function is even or odd, else its lower end."""
    powers = {p[0] % 2 for p in function.polynomial.terms} if function.polynomial else set()
    even = function.polynomial is not None and len(powers) <= 1
    return Fraction(0) if even or function.domain.low == 0 else Fraction(function.domain.low)
