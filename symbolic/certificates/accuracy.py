"""How good each formula for omega0 is at an amplitude: its error against the enclosure of the exact frequency."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import TypeAlias

import sympy
from flint import arb, ctx

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import rational
from ridgeback.symbolic.cycles.orbit import exact_frequency
from ridgeback.symbolic.enclosure.enclosure import DEFINITIONS, Amplitude
from ridgeback.symbolic.expansion.each_side import energy_on_each_side
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
from ridgeback.symbolic.resummation.elliptic_nome import nome
from ridgeback.symbolic.resummation.pade import mapped, mapping_for, pade
from ridgeback.symbolic.resummation.resummation import Resummation
from ridgeback.symbolic.singularities.limits import limits
from ridgeback.symbolic.systems.oscillator import Oscillator, V

Ball: TypeAlias = arb
"""A real number enclosed: a middle and a radius."""
BITS = 168
"""Working precision of an error: that of an enclosure, and guard bits."""
FIRST_TERMS = 4
"""Order through which an expansion must agree with the oscillator's own series."""

Formula: TypeAlias = Expansion | PowerExpansion | Resummation

_LONGER = 40
"""Order of the expansion that settles the singularity when the one asked for is shorter."""


@dataclass(frozen=True)
class Accuracy:
    """The relative errors of one formula, one ball per amplitude; None where it does not hold."""

    formula: Formula
    errors: tuple[arb | None, ...]


def certified_error(oscillator: Oscillator, formula: Formula, amplitude: Amplitude, *, bits: int = 128) -> arb:
    """Return a ball around formula/omega0 - 1 at an amplitude, in the formula's own definition of it.

    The sign of the answer is proved when the ball excludes 0.  Raises InputError where the formula does not hold, for
    another oscillator's formula, for definitions that have no enclosure, and as ``enclose`` does.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> error = certified_error(find("pendulum"), nome(find("pendulum"), 16), 1)
    >>> bool(abs(error) < 1e-18)
    True
    """
    if isinstance(formula, Expansion | PowerExpansion):
        check_belongs(oscillator, formula)
    elif formula.system != oscillator.name or formula.scale != oscillator.natural_frequency or formula.variable != "A":
        raise InputError(
            f"the {formula.method} formula of {formula.system} in {formula.variable} has no certified error against "
            f"{oscillator.name}; derive it in the amplitude from the same parameters"
        )
    exact = exact_frequency(oscillator, amplitude, definition=formula.amplitude, bits=bits)
    with ctx.workprec(bits + 40):
        return formula.in_balls(arb(rational(exact.amplitude))) / exact.omega - 1


def check_belongs(oscillator: Oscillator, expansion: Expansion | PowerExpansion) -> None:
    """Raise InputError unless the series is an amplitude series of this oscillator, judged by its first terms.

    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> check_belongs(find("duffing"), lindstedt(find("pendulum"), 4))
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: the expansion of pendulum is not one of duffing-hardening; derive it from ...
    """
    if expansion.variable != "A" or expansion.amplitude not in DEFINITIONS:
        raise InputError(
            f"a certified error needs an expansion in the amplitude defined by {' or '.join(DEFINITIONS)}, not "
            f"{expansion.amplitude} in {expansion.variable}; derive it so"
        )
    own = _first_terms(oscillator, expansion.amplitude)
    differ = any(a != b for a, b in zip(own.coefficients, expansion.coefficients, strict=False))
    if differ or _unit(own) != _unit(expansion):
        raise InputError(
            f"the expansion of {expansion.system} is not one of {oscillator.name}; derive it from the same parameters"
        )


@lru_cache(maxsize=64)
def _first_terms(oscillator: Oscillator, definition: str) -> Expansion | PowerExpansion:
    if oscillator.by_sides:
        return energy_on_each_side(oscillator, FIRST_TERMS, amplitude=definition)
    return _series(oscillator, FIRST_TERMS, definition)


def _unit(expansion: Expansion | PowerExpansion) -> tuple[sympy.Expr, ...]:
    """What the coefficients are measured in: the natural frequency, or the leading coefficient and its power."""
    return (expansion.scale,) if isinstance(expansion, Expansion) else (expansion.lead, expansion.growth)


def _series(oscillator: Oscillator, order: int, definition: str = "peak") -> Expansion:
    """The series by the energy integral, or by Lindstedt-Poincaré where the force holds u'."""
    derive = lindstedt if oscillator.substituted_force.has(V) else energy_integral
    return derive(oscillator, order, amplitude=definition)


def _truncated(oscillator: Oscillator, order: int) -> Expansion | PowerExpansion:
    """The series of any force: of one with a kink or without a linear part by the energy on each side."""
    return energy_on_each_side(oscillator, order) if oscillator.by_sides else _series(oscillator, order)


def resummations(oscillator: Oscillator, order: int) -> tuple[Formula, ...]:
    """Return the truncated series of an oscillator and every resummation of it that exists at this order.

    Left out are those that do not apply: a Padé approximant with a pole in its range, a map without a known
    singularity, the nome of a force that has none.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> [formula.method for formula in resummations(find("duffing"), 8)]
    ['energy-integral', 'Pade [2/2]', 'Euler transformation', 'elliptic nome after 2 Landen steps']
    """
    if oscillator.by_sides:
        sided = energy_on_each_side(oscillator, order)
        if isinstance(sided, PowerExpansion):
            return (sided,)
        series, found = sided, limits(sided)
    else:
        series, found = _series(oscillator, order), limits(_series(oscillator, max(order, _LONGER)))
    builders = (
        lambda: pade(series),
        lambda: mapped(series, mapping_for(found)),
        lambda: nome(oscillator, order),
    )
    result: list[Formula] = [series]
    for build in builders:
        try:
            result.append(build())
        except InputError:
            continue  # a refusal is an answer here: this formula does not exist for this oscillator
    return tuple(result)


def accuracy(
    oscillator: Oscillator,
    order: int,
    amplitudes: Sequence[Fraction],
    *,
    reference: Sequence[arb | None] | None = None,
    resummed: bool = True,
) -> tuple[Accuracy, ...]:
    """Return the certified relative errors of the series and its resummations at given amplitudes.

    Parameters
    ----------
    oscillator : Oscillator
        Numbers for its parameters; of a limit cycle all but the small one.
    order : int
        Of the series.
    amplitudes : sequence of Fraction
        Peak amplitudes, in the unit of u; of a limit cycle values of its small parameter.
    reference : sequence of arb or None, optional
        omega0 there in balls, None where there is no enclosure; by default those of ``exact_frequency``.
    resummed : bool, optional
        Whether the resummations are wanted beside the series.

    Returns
    -------
    tuple of Accuracy
        A row for each formula, with a ball of formula/omega0 - 1 at each amplitude.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> rows = accuracy(find("duffing"), 16, [Fraction(3)])
    >>> [f"{float(abs(row.errors[0]).mid()):.0e}" for row in rows]
    ['1e+05', '5e-03', '2e-01', '2e-15']
    """
    exact = [_enclosed(oscillator, a) for a in amplitudes] if reference is None else reference
    pairs = list(zip(amplitudes, exact, strict=True))
    formulas = resummations(oscillator, order) if resummed else (_truncated(oscillator, order),)
    return tuple(
        Accuracy(formula, tuple(_error(formula, amplitude, omega) for amplitude, omega in pairs))
        for formula in formulas
    )


def _enclosed(oscillator: Oscillator, amplitude: Fraction) -> arb | None:
    try:
        return exact_frequency(oscillator, amplitude).omega
    except InputError:
        return None


def _error(formula: Formula, amplitude: Fraction, omega: arb | None) -> arb | None:
    if omega is None:
        return None
    try:
        with ctx.workprec(BITS):
            return formula.in_balls(arb(rational(amplitude))) / omega - 1
    except InputError:
        return None
