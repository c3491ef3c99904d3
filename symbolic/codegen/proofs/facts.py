"""What is certain about a formula before its code is written: its error against the exact frequency."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import Final, TypeAlias

from flint import ctx, fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import ball
from ridgeback.symbolic.certificates.at_amplitudes import certified_frequencies
from ridgeback.symbolic.codegen.fit.fit import Fit
from ridgeback.symbolic.codegen.fit.truncation import errors_up_to
from ridgeback.symbolic.codegen.formulas.closed_forms import MeanForm, SineSeries
from ridgeback.symbolic.codegen.formulas.symbolic_mean import SymbolicMean
from ridgeback.symbolic.codegen.number import Number
from ridgeback.symbolic.codegen.proofs.notes import upwards
from ridgeback.symbolic.codegen.proofs.runs import exact_value
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
from ridgeback.symbolic.resummation.elliptic_nome import NomeForm
from ridgeback.symbolic.resummation.mapping import CutPlane
from ridgeback.symbolic.resummation.pade import RationalForm
from ridgeback.symbolic.resummation.resummation import Resummation
from ridgeback.symbolic.singularities.settled import settled_limits
from ridgeback.symbolic.systems.oscillator import Oscillator

Series: TypeAlias = "Expansion | PowerExpansion"
Formula: TypeAlias = "Expansion | PowerExpansion | Resummation | MeanForm | SymbolicMean | SineSeries | Fit"
SHARES: Final = (Fraction(1, 4), Fraction(1, 2), Fraction(3, 4))
"""Where in the range the error is certified."""
INSIDE: Final = Fraction(999, 1000)
"""A range ends this far before a pole."""
NEAR: Final = Fraction(1001, 1000)
"""A radius of convergence that is found to so many times less than the end of the oscillation is that end."""
BITS: Final = 256
ZERO: Final = Fraction(1, 2**24)
"""How near a zero is come to, as a share of the range."""


def reach_of(oscillator: Oscillator, series: Series, formula: Series | Resummation) -> Fraction | None:
    """The end of the range that a formula is described for: the radius of convergence, less before a pole.

    None when the series does not show it.

    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> series = lindstedt(find("duffing"), 8)
    >>> float(reach_of(find("duffing"), series, series))
    1.0
    """
    radius = settled_limits(oscillator, series).radius
    return None if radius is None else before_pole(Fraction(f"{radius:.6g}"), formula)


def before_pole(reach: Fraction, formula: Series | Resummation) -> Fraction:
    """The same range, or less when the formula has a pole in it or ends where the oscillation does."""
    if isinstance(formula, NomeForm) or (isinstance(formula, RationalForm) and isinstance(formula.mapping, CutPlane)):
        return INSIDE * reach
    pole = formula.pole if isinstance(formula, RationalForm) else None
    return reach if pole is None else min(reach, INSIDE * Fraction(float(pole)))


def end_of(oscillator: Oscillator, series: Series, formula: Formula, limit: float | None) -> Fraction | None:
    """The end of the domain where none is given: the end of the oscillation, or of the series' convergence.

    A series converges no further than its radius, wherever the oscillation ends, and is of no use from where it is 0.

    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> series = lindstedt(find("rotating-hoop"), 8)
    >>> float(end_of(find("rotating-hoop"), series, series, 3.14159))  # the series converges up to here
    1.31682
    """
    if isinstance(formula, Fit):
        return formula.end
    if isinstance(formula, SymbolicMean):
        return None
    if isinstance(formula, MeanForm | SineSeries):
        return None if limit is None else INSIDE * Fraction(limit)
    if limit is None:
        found = reach_of(oscillator, series, formula)
    else:
        found = before_pole(Fraction(limit), formula)
        reach = reach_of(oscillator, series, formula) if isinstance(formula, Expansion | PowerExpansion) else None
        found = found if reach is None or found < NEAR * reach else reach
    return found if found is None or not isinstance(formula, Expansion) else before_zero(formula, found)


def before_zero(series: Expansion, end: Fraction) -> Fraction:
    """The same range, or less where the polynomial is 0 in it, as no frequency is before the oscillation ends.

    >>> from ridgeback.symbolic.expansion.energy_integral import energy_integral
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> float(before_zero(energy_integral(find("kepler"), 8), Fraction(1, 2)))  # 0 at -0.47253...
    0.472021
    """
    if series.names or series.constants or not all(isinstance(c, fmpq) for c in series.coefficients):
        return end
    powers = {p: Number(c) for p, c in enumerate(series.coefficients) if c != 0}
    zero = min((z for side in (1, -1) if (z := _first_zero(powers, side * end)) is not None), default=None)
    return end if zero is None else Fraction(f"{float(INSIDE * zero):.6g}")


def range_fact(formula: Formula, end: Fraction, limit: float | None) -> tuple[str, ...]:
    """Why the domain ends where it does, in a line; nothing where the oscillation itself ends there.

    >>> from ridgeback.symbolic.expansion.energy_integral import energy_integral
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> range_fact(energy_integral(find("kepler"), 8), Fraction("0.472021"), None)
    ('Range: up to A = 0.472021, short of a zero of the polynomial, which the frequency has not.',)
    """
    if not isinstance(formula, Expansion | PowerExpansion) or (limit is not None and end * NEAR >= Fraction(limit)):
        return ()
    beyond = end * NEAR / INSIDE
    zero = isinstance(formula, Expansion) and before_zero(formula, beyond) < beyond
    reason = (
        "short of a zero of the polynomial, which the frequency has not" if zero else "about the radius of convergence"
    )
    return (f"Range: up to {formula.variable} = {float(end):.6g}, {reason}.",)


def _first_zero(powers: dict[int, Number], end: Fraction) -> Fraction | None:
    """The size of an amplitude just before which a polynomial with c_0 > 0 is positive from 0 on; None up to the end.

    Steps that double as long as the polynomial is proved positive over the next, and are halved where it is not.
    """
    at, step = Fraction(0), end / 16
    with ctx.workprec(BITS):
        while at != end:
            step = step if abs(at + step) <= abs(end) else end - at
            if exact_value(powers, ball(at).union(ball(at + step))) > 0:
                at, step = at + step, 2 * step
            elif abs(step) < abs(end) * ZERO:
                return abs(at)
            else:
                step /= 2
    return None


def certified_facts(
    oscillator: Oscillator, formula: Formula, reach: Fraction, *, whole: bool = False
) -> tuple[str, ...]:
    """The error of a formula over parts of the range and, when ``whole``, over all of it, in a line.

    Where the exact frequency is not enclosed over a range, at a few amplitudes; nothing where it is not at all.

    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> certified_facts(find("pendulum"), lindstedt(find("pendulum"), 8), Fraction(3))[0]
    'Truncation: the relative error against the exact frequency is at most 9.1e-09 for |A| <= 0.75, 1.3e-05 up to ...
    """
    if isinstance(formula, MeanForm | SymbolicMean | SineSeries | Fit):
        return ()  # exact, or with a bound of their own
    places = [Fraction(f"{float(share * reach):.3g}") for share in SHARES] + [reach] * whole
    try:
        errors, symmetric = errors_up_to(oscillator, formula, places)
    except InputError:
        return _at_amplitudes(oscillator, formula, places)
    first, *rest = (f"{upwards(e)} {{}} {float(a):.10g}" for e, a in zip(errors, places, strict=True))
    listed = ", ".join(
        [first.format("for |A| <=" if symmetric else "for 0 <= A <="), *(r.format("up to") for r in rest)]
    )
    return (
        f"Truncation: the relative error against the exact frequency is at most {listed}, proved over the whole range "
        "in ball arithmetic.",
    )


def _at_amplitudes(
    oscillator: Oscillator, formula: Series | Resummation, places: Sequence[Fraction]
) -> tuple[str, ...]:
    """The certified error at amplitudes; nothing for limit cycles, damping and definitions without an enclosure."""
    try:
        bounds = [reading.to_dict(6)["error_bound"] for reading in certified_frequencies(oscillator, formula, places)]
    except InputError:
        return ()
    known = [(b, a) for b, a in zip(bounds, places, strict=True) if math.isfinite(float(str(b)))]
    if not known:
        return ()
    first, *rest = [(upwards(Fraction(str(b))), f"{float(a):.10g}") for b, a in known]
    listed = ", ".join([f"{first[0]} at {formula.variable} = {first[1]}", *(f"{b} at {a}" for b, a in rest)])
    return (f"Certified relative error against the exact frequency: below {listed}.",)
