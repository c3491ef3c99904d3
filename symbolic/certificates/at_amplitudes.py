"""The exact frequency at given amplitudes, enclosed, and a formula compared with it there with its certified error."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeAlias

from flint import arb, ctx

from ridgeback.common.errors import InputError
from ridgeback.common.numbers import exact_text
from ridgeback.common.progress import Wanted, showing
from ridgeback.symbolic.arithmetic.balls import rational
from ridgeback.symbolic.certificates.accuracy import check_belongs
from ridgeback.symbolic.cycles.orbit import exact_frequency
from ridgeback.symbolic.enclosure.enclosure import Enclosure, brief_number, rounded_up
from ridgeback.symbolic.expansion.ball_expansion import BallExpansion, ball_row
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
from ridgeback.symbolic.resummation.resummation import Resummation
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.oscillator import Oscillator

Formula: TypeAlias = Expansion | PowerExpansion | BallExpansion | Resummation

GUARD = 40
ERROR_DIGITS = 6
"""Digits in which an error is printed."""


@dataclass(frozen=True)
class CertifiedFrequency:
    """omega0 at one amplitude; ``value`` is a formula's omega0 there, ``error`` is value/omega0 - 1, both in balls."""

    exact: Enclosure
    value: arb | None = None
    error: arb | None = None

    def to_dict(self, digits: int) -> dict[str, object]:
        """The public JSON form: decimals with the radius that the truth is within.

        ``formula_omega0`` is what the formula gives; ``relative_error`` is signed, and its size is certainly at most
        ``error_bound``.
        """
        with ctx.workprec(self.exact.bits + GUARD):
            ball = ball_row(self.exact.omega, digits)
            row: dict[str, object] = {
                "amplitude": float(self.exact.amplitude),
                "amplitude_exact": exact_text(self.exact.amplitude),
                "omega0": ball["coefficient"],
                "radius": ball["radius"],
                "certain_digits": ball["certain_digits"],
                "by": self.exact.method,
            }
            if self.value is None or self.error is None:
                return row
            row["formula_omega0"] = self.value.str(digits, radius=False)
            row["relative_error"] = None if self.error.contains(0) else self.error.str(ERROR_DIGITS, radius=False)
            row["error_bound"] = rounded_up(abs(self.error))
            return row


@dataclass(frozen=True)
class Refused:
    """An amplitude, or value of a small parameter, at which omega0 could not be enclosed, and why."""

    amplitude: Fraction
    why: str
    variable: str = "A"

    def to_dict(self, digits: int) -> dict[str, object]:  # noqa: ARG002 - the signature of CertifiedFrequency
        """The public JSON form: the keys of a certified frequency with nothing in them, and the reason."""
        name = "amplitude" if self.variable == "A" else self.variable
        return {
            name: float(self.amplitude),
            f"{name}_exact": exact_text(self.amplitude),
            "omega0": None,
            "radius": None,
            "refused": self.why,
        }


def at_each(
    read: Callable[[Fraction], CertifiedFrequency], amplitudes: Sequence[Fraction]
) -> tuple[CertifiedFrequency | Refused, ...]:
    """Read each amplitude; those that are refused keep their place, with the reason.

    Parameters
    ----------
    read : callable
        Makes the certified frequency at an amplitude, or raises InputError.
    amplitudes : sequence of Fraction
        Where to read.

    Returns
    -------
    tuple of CertifiedFrequency or Refused
        One for each amplitude.

    Examples
    --------
    >>> from ridgeback.symbolic.enclosure.enclosure import enclose
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> [type(row).__name__ for row in at_each(lambda a: CertifiedFrequency(enclose(find("pendulum"), a)), [1, 4])]
    ['CertifiedFrequency', 'Refused']
    """
    found: list[CertifiedFrequency | Refused] = []
    for amplitude in amplitudes:
        try:
            found.append(read(amplitude))
        except InputError as refusal:
            found.append(Refused(amplitude, str(refusal)))
    return tuple(found)


def certified_frequency(
    oscillator: Oscillator, formula: Formula, amplitude: Fraction, *, bits: int = 128
) -> CertifiedFrequency:
    """Enclose omega0 at one amplitude, and the formula with its error; raises as ``certified_frequencies``."""
    exact = exact_frequency(oscillator, amplitude, definition=formula.amplitude, bits=bits)
    if isinstance(formula, Expansion | PowerExpansion):
        check_belongs(oscillator, formula)
    if formula.variable != "A" or formula.system != oscillator.name:
        raise InputError(f"{formula.method} of {formula.system} is no series of {oscillator.name} in its amplitude")
    with ctx.workprec(bits + GUARD):
        value = formula.in_balls(arb(rational(exact.amplitude)))
        return CertifiedFrequency(exact, value, value / exact.omega - 1)


def certified_frequencies(
    oscillator: OscillatorLike,
    formula: Formula,
    amplitudes: Sequence[Fraction],
    *,
    bits: int = 128,
    progress: Wanted = None,
) -> tuple[CertifiedFrequency, ...]:
    """Enclose omega0 at each amplitude, in the formula's own definition, and the formula with its error.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        Any form of a conservative oscillator with numbers for its parameters.
    formula : Expansion or Resummation
        A formula of this oscillator's omega0 in its amplitude.
    amplitudes : sequence of Fraction
        In the formula's definition and the unit of u.
    bits : int, optional
        The relative radius of each enclosure is about 2**-bits.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share done and the amplitude.

    Returns
    -------
    tuple of CertifiedFrequency
        omega0 in balls (rad per time unit), the formula's value, and value/omega0 - 1.

    Raises
    ------
    InputError
        As ``enclose`` does (limit cycles, damping, the separatrix), for definitions without an enclosure, for another
        oscillator's formula, and where the formula does not hold.

    Examples
    --------
    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> row = certified_frequencies(find("pendulum"), lindstedt(find("pendulum"), 8), [Fraction(1)])[0].to_dict(12)
    >>> row["omega0"], row["relative_error"]
    ('0.937792258051', '1.71087e-7')
    """
    oscillator = as_oscillator(oscillator)
    found = []
    with showing(progress) as told:
        for done, amplitude in enumerate(amplitudes):
            told(done / len(amplitudes), f"amplitude {brief_number(Fraction(amplitude))}")
            found.append(certified_frequency(oscillator, formula, amplitude, bits=bits))
    return tuple(found)
