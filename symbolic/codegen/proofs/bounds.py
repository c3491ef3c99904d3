"""A proved bound of what rounding does to generated code, over its whole domain, box by box (``analysis``)."""

from __future__ import annotations

import heapq
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Final, TypeAlias

from flint import arb, arb_poly, ctx

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import ball, whole_power
from ridgeback.symbolic.codegen.number import Real, fraction
from ridgeback.symbolic.codegen.program import Form, Function, Horner, Statement
from ridgeback.symbolic.codegen.proofs.analysis import KEPT, Analysis, Computed, half_spacing

BITS: Final = 128
WORK: Final = 12000
"""Operations that a bound may cost; short functions are looked at in more and smaller boxes."""
FEWEST: Final = 8
SHARP: Final = arb(1.02)
"""A box whose bound is so near to that at its middle is not halved."""
EXPANDED: Final = 64
"""The highest degree of a polynomial whose exact values are found by expanding it."""
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


Run: TypeAlias = Callable[[arb], Computed]


def bound(form: Form, function: Function) -> Bound | None:
    """What rounding can do to a function of one variable, its other arguments at their defaults.

    None when an argument has no default, or the domain has no known end.  Raises InputError where a denominator or a
    root may vanish.
    """
    run = _runner(form, function)
    if run is None:
        return None
    with ctx.workprec(BITS):
        return _over(function, run, form.real)


def surely_above(form: Form, function: Function, ulps: Fraction) -> bool:
    """Whether the bound, where there is one, is above so many units in the last place, as seen at a few points."""
    run = _runner(form, function)
    if run is None:
        return False
    with ctx.workprec(BITS):
        low, high = start(function), Fraction(function.domain.high)
        places = (ball(low + (high - low) * (2 * i + 1) / (2 * PROBES - 1)) for i in reversed(range(PROBES)))
        found = map(run, places)
        return any(one.exact != 0 and in_last_places(one, form.real) > ball(ulps) for one in found)


def _runner(form: Form, function: Function) -> Run | None:
    """The analysis on a part of the domain."""
    variable = function.domain.argument
    others = {a.name: a.default for a in function.arguments if a.name != variable}
    if not function.domain.known or None in others.values():
        return None
    fixed = {name: Computed(arb(value), arb(0)) for name, value in others.items() if value is not None}
    constants: dict[int, Computed] = {}  # by identity: they live as long as the form

    def run(box: arb) -> Computed:
        analysis = Analysis({**fixed, variable: Computed(box, arb(0))}, form, constants)
        if function.compensated and function.polynomial is not None:
            return analysis.run_to_sum(function, exact_value(function, box))
        return analysis.run(function.body, function.result)

    return run


def exact_value(function: Function, box: arb) -> arb:
    """A polynomial in one variable on a ball, by its exact coefficients and without its factor.

    Where it is not too long it is expanded about the middle, |p(m + r z) - p(m)| <= sum |p_i| r^i for |z| <= 1.
    """
    polynomial = function.polynomial
    assert polynomial is not None  # noqa: S101 - asked only where there is one
    powers = {p[0]: c for p, c in polynomial.terms.items()}
    low, high = min(powers, default=0), max(powers, default=0)
    if high <= EXPANDED:
        dense = arb_poly([powers[p].ball if p in powers else 0 for p in range(high + 1)])
        middle, *others = dense(arb_poly([box.mid(), box.rad()])).coeffs() or [arb(0)]
        return middle + arb(0, sum(map(abs, others), arb(0)).upper())
    total = arb(0)
    stride = 2 if all((p - low) % 2 == 0 for p in powers) else 1
    for p in range(high, low - 1, -stride):
        total = total * whole_power(box, stride) + (powers[p].ball if p in powers else 0)
    return total * whole_power(box, low)


def _over(function: Function, run: Run, real: Real) -> Bound:
    low, high = start(function), Fraction(function.domain.high)
    length = sum(_cost(statement) for statement in function.body) + 1
    budget = max(FEWEST, WORK // length)
    boxes: list[tuple[float, Fraction, Fraction, Computed]] = []

    def push(left: Fraction, right: Fraction) -> None:
        found = run(ball(left).union(ball(right)))
        measure = _size(found)
        heapq.heappush(boxes, (-measure, left, right, found))

    count = min(16, max(6, budget // 2))
    for i in range(count):
        push(low + (high - low) * i / count, low + (high - low) * (i + 1) / count)
    done: list[Computed] = []
    while boxes and budget > 0:
        _, left, right, found = heapq.heappop(boxes)
        middle = (left + right) / 2
        budget -= 3
        if found.error.is_finite() and _near(found, run(ball(middle))):
            done.append(found)
            continue
        push(left, middle)
        push(middle, right)
    return _worst(function, [*done, *(box[3] for box in boxes)], real, high)


def _cost(statement: Statement) -> int:
    if not isinstance(statement, Horner):
        return 1
    return 2 * KEPT + len(statement.coefficients) // 2 if statement.loops else len(statement.coefficients)


def _size(found: Computed) -> float:
    relative = found.error / found.exact.abs_lower()
    return float(relative.upper()) if relative.is_finite() else float("inf")


def _near(found: Computed, middle: Computed) -> bool:
    return bool(found.error / found.exact.abs_lower() <= SHARP * middle.error / abs(middle.exact))


def _worst(function: Function, found: list[Computed], real: Real, high: Fraction) -> Bound:
    if not all(one.error.is_finite() for one in found):
        variable = function.domain.argument
        raise InputError(
            f"the code of {function.name} may divide by zero, overflow or take the root of a negative number for "
            f"{variable} up to {float(high):.6g}; give a shorter range"
        )
    absolute, before, size = (
        max(map(upper, values))
        for values in ([x.error for x in found], [x.before for x in found], [abs(x.exact) for x in found])
    )
    if any(one.exact.contains(0) for one in found):
        return Bound(None, absolute, None, before, size)
    relative = max(upper((one.error / one.exact.abs_lower()).upper()) for one in found)
    return Bound(relative, absolute, max(upper(in_last_places(one, real)) for one in found), before, size)


def in_last_places(one: Computed, real: Real) -> arb:
    """The error in units of the last place of the exact value; on both sides of a power of two in the box apart.

    The unit doubles there, and so does what the last rounding can do.
    """
    low, high = abs(one.exact).lower(), abs(one.exact).upper()
    mantissa, exponent = high.man_exp()
    edge = arb(2) ** (int(mantissa).bit_length() + int(exponent) - 1)
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
    return arb(2) ** max(int(mantissa).bit_length() + int(exponent) - real.digits, real.low)


def upper(x: arb) -> Fraction:
    """The upper end of a ball, exactly."""
    return fraction(x.upper().fmpq())


def start(function: Function) -> Fraction:
    """Where a domain need be looked at from: 0 where the function is even or odd, else its lower end."""
    powers = {p[0] % 2 for p in function.polynomial.terms} if function.polynomial else set()
    even = function.polynomial is not None and len(powers) <= 1
    return Fraction(0) if even or function.domain.low == 0 else Fraction(function.domain.low)
