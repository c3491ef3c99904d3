"""The truncated series and its resummations with errors that are proved, at a few amplitudes."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Wanted, showing
from ridgeback.compare.study.results import Certified, CertifiedRow
from ridgeback.numeric.arrays import Array
from ridgeback.symbolic.certificates.accuracy import Accuracy, Ball, accuracy
from ridgeback.symbolic.certificates.at_amplitudes import Refused
from ridgeback.symbolic.certificates.at_cycles import described_cycles
from ridgeback.symbolic.cycles.orbit import exact_frequency
from ridgeback.symbolic.enclosure.enclosure import separatrix
from ridgeback.symbolic.enclosure.well import NoEnergyError, well_of
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.oscillator import Oscillator

CYCLE_BITS = 64
SHARES = (0.25, 0.5, 0.7, 0.9, 0.95)
"""Amplitudes as shares of the separatrix, or of the largest amplitude studied where there is none."""


def certified(oscillator: Oscillator, order: int, largest: float) -> Certified | None:
    """Return proved errors of every formula of this order, or None where omega0 has no enclosure.

    That is so for damped oscillators and for parameters without a value.  Of a limit cycle the amplitudes are values of
    its small parameter.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> table = certified(find("pendulum"), 8, 3.0)
    >>> [f"{error:.0e}" for error in table.rows[0].errors]
    ['1e-08', '2e-05', '9e-04', '3e-02', '9e-02']
    """
    try:
        amplitudes = _amplitudes(oscillator, largest)
        exact = [Fraction(a) for a in amplitudes]
        reference = [found.omega for found in references(oscillator, exact)]
        found = accuracy(oscillator, order, exact, reference=reference)
    except InputError:
        return None  # said on the page by the section's absence; the study has its own reference
    if not any(row.errors and row.errors[0] is not None for row in found):
        return None
    variable = found[0].formula.variable
    return Certified(order=order, amplitudes=amplitudes, rows=tuple(_row(item) for item in found), variable=variable)


@dataclass(frozen=True)
class Known:
    """The exact frequency at a place in a ball, in rad per time unit; None with the reason where there is none."""

    omega: Ball | None
    why: str = ""


def references(oscillator: Oscillator, places: Sequence[Fraction]) -> tuple[Known, ...]:
    """Enclose the exact frequency at amplitudes, or of the limit cycle at values of the small parameter.

    Parameters
    ----------
    oscillator
        Its parameters have values.
    places
        Peak amplitudes in the unit of u, or values of the small parameter.

    Raises
    ------
    InputError
        For an oscillator that has neither orbits of one energy nor a limit cycle.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> round(float(references(find("van-der-pol"), [Fraction(1)])[0].omega), 9)
    0.942955847
    """
    if oscillator.kind == "limit-cycle":
        rows = described_cycles(oscillator, places, bits=CYCLE_BITS)
        return tuple(Known(None, row.why) if isinstance(row, Refused) else Known(row.cycle.omega) for row in rows)
    if not oscillator.by_sides:
        with suppress(NoEnergyError):
            well_of(oscillator)  # refuses what has no frequency at any amplitude
    return tuple(_known(oscillator, place) for place in places)


def _known(oscillator: Oscillator, place: Fraction) -> Known:
    try:
        return Known(exact_frequency(oscillator, place).omega)
    except InputError as refusal:
        return Known(None, str(refusal))


def certified_rows(
    oscillator: OscillatorLike, orders: Sequence[int], amplitudes: Sequence[float], *, progress: Wanted = None
) -> list[dict[str, float | int | str | None]]:
    """Errors of every formula, proved, as rows with the keys of a study's rows and the radius of the proof.

    Parameters
    ----------
    oscillator
        A conservative oscillator, or a limit cycle with a small parameter, whose parameters have values.
    orders
        Orders of the series and of the formulas made from it.
    amplitudes
        Peak amplitudes, shape (n,), in the unit of u; values of the small parameter of a limit cycle.
    progress
        ``True`` shows a bar; a function is told the share done and the step.

    Returns
    -------
    list of dict
        One row per order, formula and amplitude; ``omega`` and ``relative_error`` are None where the formula does not
        hold.  Of a limit cycle ``eps`` stands in the place of ``amplitude``; where it could not be enclosed, the row
        has ``omega_reference`` None and ``refused``, the reason.

    Raises
    ------
    InputError
        Where omega0 has no enclosure: damping, symbolic parameters, amplitudes at or beyond the separatrix.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> rows = certified_rows(find("pendulum"), [4], [1.0])
    >>> rows[0]["method"], f"{rows[0]['relative_error']:.4e}"
    ('truncated series', '3.5469e-05')
    """
    oscillator = as_oscillator(oscillator)
    exact = [Fraction(a) for a in amplitudes]
    rows = []
    with showing(progress) as told:
        told(0.0, "exact frequencies")
        reference = references(oscillator, exact)
        if oscillator.kind != "limit-cycle" and (refused := [known.why for known in reference if known.omega is None]):
            raise InputError(refused[0])
        for done, order in enumerate(orders, 1):
            told(done / (len(orders) + 1), f"order {order}")
            for item in accuracy(oscillator, order, exact, reference=[known.omega for known in reference]):
                cells = zip(item.errors, exact, reference, strict=True)
                rows += [_cell(order, item, ball, float(amplitude), known) for ball, amplitude, known in cells]
    return rows


def _cell(
    order: int, item: Accuracy, ball: Ball | None, amplitude: float, known: Known
) -> dict[str, float | int | str | None]:
    return {
        "order": order,
        "amplitude" if item.formula.variable == "A" else item.formula.variable: amplitude,
        "method": _name(item),
        "omega": _value(item, amplitude),
        "omega_reference": None if known.omega is None else float(known.omega.mid()),
        "relative_error": None if ball is None else float(ball.mid()),
        "error_radius": None if ball is None else float(ball.rad()),
        **({"refused": known.why} if known.why else {}),
    }


def _value(item: Accuracy, amplitude: float) -> float | None:
    """What the formula gives, whether or not it can be held against anything; None where it does not hold."""
    try:
        return float(item.formula(amplitude))
    except InputError:
        return None


def _name(item: Accuracy) -> str:
    return "truncated series" if isinstance(item.formula, Expansion | PowerExpansion) else item.formula.method


def _amplitudes(oscillator: Oscillator, largest: float) -> Array:
    limit = _limit(oscillator)
    top = largest if limit is None else limit
    found = np.array([float(f"{share * top:.3g}") for share in SHARES])
    found.flags.writeable = False
    return found


def _limit(oscillator: Oscillator) -> float | None:
    """Where the oscillation ends by its energy; None where it does not, or has none."""
    if oscillator.kind == "limit-cycle":
        return None
    try:
        found = separatrix(oscillator).peak
    except NoEnergyError:
        return None
    return None if found is None else float(found)


def _row(item: Accuracy) -> CertifiedRow:
    """Floats for print: the middle of each ball, and the largest distance of any ball from its middle."""
    errors = tuple(None if ball is None else float(ball.mid()) for ball in item.errors)
    radii = [float(ball.rad()) for ball in item.errors if ball is not None]
    return CertifiedRow(_name(item), errors, max(radii, default=0.0))
