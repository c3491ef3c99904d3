"""What a series or a quotient lacks of the exact frequency, from rest to given amplitudes."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Final, TypeAlias

from flint import arb, ctx

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import scalar_ball
from ridgeback.symbolic.certificates.at_amplitudes import certified_frequency
from ridgeback.symbolic.codegen.fit.over_range import largest_error
from ridgeback.symbolic.codegen.fit.surrogate import GOAL, region, surrogate
from ridgeback.symbolic.enclosure.well import well_of
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
from ridgeback.symbolic.resummation.mapping import Identity
from ridgeback.symbolic.resummation.pade import RationalForm
from ridgeback.symbolic.resummation.resummation import Resummation
from ridgeback.symbolic.systems.oscillator import Oscillator

Formula: TypeAlias = "Expansion | PowerExpansion | Resummation"
BEYOND: Final = 7
"""Bits by which the exact frequency is known better than the smallest error."""
MOST_NODES: Final = 130
"""Exact frequencies that a bound may cost."""


def errors_up_to(
    oscillator: Oscillator, formula: Formula, ends: Sequence[Fraction]
) -> tuple[tuple[Fraction, ...], bool]:
    """The largest relative error up to each of rising amplitudes, proved; and whether it holds for -A as well.

    Raises InputError for a formula that is no quotient of polynomials in the peak amplitude, and where the exact
    frequency is not enclosed over the whole range.

    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> errors, _ = errors_up_to(find("pendulum"), lindstedt(find("pendulum"), 2), [Fraction(1), Fraction(2)])
    >>> [round(float(e), 4) for e in errors]
    [0.0003, 0.0033]
    """
    well, last = well_of(oscillator), ends[-1]
    around = region(well, last)
    first, final = (certified_frequency(oscillator, formula, end).error for end in (ends[0], last))
    goal = min(GOAL, bits_of(first) + BEYOND)
    count = around.nodes(goal)
    goal = goal if count <= MOST_NODES else goal * MOST_NODES // count
    if goal < min(GOAL, bits_of(final) + BEYOND):
        raise InputError(f"{well.name}: the exact frequency up to {float(last):.6g} is too costly to enclose")
    exact = surrogate(well, last, goal=goal, found=around)
    with ctx.workprec(exact.bits):
        above, below = _quotient(formula, exact.step)
        errors = largest_error(exact, above, below, shares=[end / last for end in ends])
    return errors, exact.step == 2


def bits_of(error: arb | None) -> int:
    """How many binary digits below 1 an error is; many where it may vanish.

    >>> bits_of(arb(2) ** -10)
    10
    """
    if error is None or error.contains(0):
        return GOAL
    return max(0, -int(float(abs(error).lower().log() / arb(2).log()) // 1))


def _quotient(formula: Formula, step: int) -> tuple[list[arb], list[arb]]:
    """Numerator and denominator by the powers of A^step."""
    if isinstance(formula, Expansion) and formula.amplitude == "peak" and formula.variable == "A" and not formula.sided:
        above = [scalar_ball(c, formula.names, formula.constants) for c in formula.coefficients]
        return _in_step(above, 1, step), [arb(1)]
    plain = isinstance(formula, RationalForm) and isinstance(formula.mapping, Identity) and formula.growth == 0
    if isinstance(formula, RationalForm) and plain and formula.amplitude == "peak" and not formula.scaled_variable:
        above, below = ([arb(c) for c in part] for part in (formula.numerator, formula.denominator))
        return _in_step(above, formula.step, step), _in_step(below, formula.step, step)
    raise InputError(f"the {formula.method} of {formula.system} is no quotient of polynomials in the peak amplitude")


def _in_step(values: list[arb], own: int, step: int) -> list[arb]:
    """Coefficients of powers of A^own by those of A^step; raises InputError for odd powers where all are even."""
    spread = [arb(0)] * (own * (len(values) - 1) + 1)
    for n, value in enumerate(values):
        spread[own * n] = value
    if any(not value.is_zero() for n, value in enumerate(spread) if n % step):
        raise InputError("a formula with odd powers of the amplitude meets an even potential")
    return spread[::step]
