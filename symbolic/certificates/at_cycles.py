"""The limit cycles at given values of the small parameter, enclosed, and a series held against the one it describes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from flint import arb, ctx

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import rational
from ridgeback.symbolic.certificates.at_amplitudes import ERROR_DIGITS, GUARD, Formula, Refused
from ridgeback.symbolic.cycles.enclose import Cycle
from ridgeback.symbolic.cycles.found import Unproved, limit_cycles
from ridgeback.symbolic.enclosure.enclosure import rounded_up
from ridgeback.symbolic.expansion.ball_expansion import ball_row
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.oscillator import Oscillator

MULTIPLIER_DIGITS = 6


@dataclass(frozen=True)
class CertifiedCycle:
    """One limit cycle at a value of the small parameter; ``error`` is a formula's value/omega0 - 1, both in balls.

    Parameters
    ----------
    variable : str
        Name of the small parameter.
    place : Fraction
        Its value.
    cycle : Cycle
        Frequency, turning points and multiplier in balls.
    bits : int
        Precision that was asked for.
    value, error : arb, optional
        Of the formula that describes this cycle; None for other cycles.
    """

    variable: str
    place: Fraction
    cycle: Cycle
    bits: int
    value: arb | None = None
    error: arb | None = None

    def to_dict(self, digits: int) -> dict[str, object]:
        """The public JSON form: decimals with the radius that the truth is within.

        ``amplitude`` is the peak; ``multiplier`` that of the return map over a whole cycle.
        """
        with ctx.workprec(self.bits + GUARD):
            omega, peak, trough = (ball_row(x, digits) for x in (self.cycle.omega, self.cycle.peak, self.cycle.trough))
            slope = ball_row(self.cycle.multiplier, MULTIPLIER_DIGITS)
            row: dict[str, object] = {
                self.variable: float(self.place),
                f"{self.variable}_exact": str(self.place),
                "omega0": omega["coefficient"],
                "radius": omega["radius"],
                "certain_digits": omega["certain_digits"],
                "amplitude": peak["coefficient"],
                "amplitude_radius": peak["radius"],
                "trough": trough["coefficient"],
                "trough_radius": trough["radius"],
                "multiplier": slope["coefficient"],
                "multiplier_radius": slope["radius"],
                "stable": self.cycle.stable,
                "by": "return map",
            }
            if self.value is None or self.error is None:
                return row
            row["formula_omega0"] = self.value.str(digits, radius=False)
            row["relative_error"] = None if self.error.contains(0) else self.error.str(ERROR_DIGITS, radius=False)
            row["error_bound"] = rounded_up(abs(self.error))
            return row


def certified_cycles(
    oscillator: OscillatorLike,
    values: Sequence[Fraction],
    *,
    small: str | None = None,
    formula: Formula | None = None,
    bits: int = 128,
) -> tuple[CertifiedCycle | Refused, ...]:
    """Enclose the limit cycles at each value of the small parameter, and a series with its error at the one it is of.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        Any form of an oscillator with a small parameter, the others with numbers.
    values : sequence of Fraction
        Of the small parameter.
    small : str, optional
        Its name; by default that of the oscillator.
    formula : Expansion, BallExpansion or Resummation, optional
        omega0 in the small parameter.
    bits : int, optional
        The relative radius of each frequency is at most about 2**-bits.

    Returns
    -------
    tuple of CertifiedCycle or Refused
        For each value its cycles by rising peak, or why there is none.  Of several, the formula is held against the
        one whose peak is nearest to the amplitude with which its cycle begins.

    Raises
    ------
    InputError
        For an oscillator without a small parameter.

    Examples
    --------
    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> vdp = find("van-der-pol")
    >>> row = certified_cycles(vdp, [Fraction(1, 2)], formula=lindstedt(vdp, 8), bits=64)[0].to_dict(12)
    >>> row["omega0"], row["amplitude"], row["stable"], row["relative_error"]
    ('0.984720976645', '2.00248793045', True, '-1.32299e-8')
    """
    own = as_oscillator(oscillator)
    name = own.small if small is None else small
    if name is None:
        raise InputError(f"{own.name} has no small parameter to give values to; name the one that is meant")
    start = None if formula is None else float(lindstedt(own, 1).amplitude_series[0])  # type: ignore[index]
    return tuple(row for value in values for row in _at(own, name, value, formula, start, bits))


def described_cycles(
    oscillator: Oscillator, values: Sequence[Fraction], *, bits: int = 128
) -> tuple[CertifiedCycle | Refused, ...]:
    """Enclose, at each value of the small parameter, the limit cycle that the series in it describes.

    Parameters
    ----------
    oscillator : Oscillator
        With a small parameter and a series in it, the other parameters with numbers.
    values : sequence of Fraction
        Of the small parameter.
    bits : int, optional
        The relative radius of each frequency is at most about 2**-bits.

    Returns
    -------
    tuple of CertifiedCycle or Refused
        One for each value.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> described_cycles(find("rayleigh"), [Fraction(1)], bits=64)[0].cycle.omega.str(12, radius=False)
    '0.942955847442'
    """
    series = lindstedt(oscillator, 1)
    rows = [certified_cycles(oscillator, [value], formula=series, bits=bits) for value in values]
    return tuple(
        next((row for row in found if isinstance(row, CertifiedCycle) and row.error is not None), found[0])
        for found in rows
    )


def _at(
    oscillator: Oscillator, small: str, value: Fraction, formula: Formula | None, start: float | None, bits: int
) -> tuple[CertifiedCycle | Refused, ...]:
    try:
        found = limit_cycles(oscillator.with_parameters({small: value}), bits=bits)
    except InputError as refusal:
        return (Refused(value, str(refusal), small),)
    rows = tuple(
        Refused(value, cycle.why, small) if isinstance(cycle, Unproved) else CertifiedCycle(small, value, cycle, bits)
        for cycle in found
    )
    proved = [row for row in rows if isinstance(row, CertifiedCycle)]
    if formula is None or start is None or not proved:
        return rows
    described = min(proved, key=lambda row: abs(math.log(float(row.cycle.peak) / start)))
    return tuple(_held(row, formula) if row is described else row for row in rows)


def _held(row: CertifiedCycle | Refused, formula: Formula) -> CertifiedCycle | Refused:
    """The cycle with the formula's value and error, where it has one."""
    if isinstance(row, Refused):
        return row
    with ctx.workprec(row.bits + GUARD):
        try:
            value = formula.in_balls(arb(rational(row.place)))
        except InputError:
            return row
        return replace(row, value=value, error=value / row.cycle.omega - 1)
