"""The exact frequency at an amplitude by validated integration, where no energy is known that a quadrature could use.

Orbits that close by a symmetry need no Newton step.  When f is even in u', a motion runs back after a turning point as
it came: the period is twice the way from the peak to the trough.  When f is odd in u, (u, t) -> (-u, -t) maps motions
to motions, and one that crosses u = 0 twice is its own image: the period is the time to the next peak.
"""

from __future__ import annotations

import math
from fractions import Fraction

import sympy
from flint import arb

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, Wanted, showing, silent
from ridgeback.symbolic.arithmetic.balls import natural_frequency, rational
from ridgeback.symbolic.cycles.enclose import BITS_PER_DEGREE
from ridgeback.symbolic.cycles.field import field_of
from ridgeback.symbolic.cycles.passage import passage
from ridgeback.symbolic.cycles.search import return_map
from ridgeback.symbolic.enclosure.enclosure import (
    GUARD_BITS,
    Amplitude,
    Enclosure,
    brief_number,
    check_definition,
    checked_bits,
    enclose,
    exact_size,
    limit_at_rest,
    widened,
)
from ridgeback.symbolic.enclosure.walk import UndecidedError, decided
from ridgeback.symbolic.enclosure.well import NoEnergyError
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.oscillator import Oscillator, U, V


def exact_frequency(
    oscillator: OscillatorLike,
    amplitude: Amplitude,
    *,
    definition: str = "peak",
    bits: int = 128,
    progress: Wanted = None,
) -> Enclosure:
    """Enclose omega0 at an amplitude, by the energy where there is one, else by validated integration.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        Any form of an oscillator whose orbits close, with numbers for its parameters.
    amplitude : float, int, str, Fraction or sympy.Rational
        In the unit of u, 0 or more.
    definition : str, optional
        ``peak`` (default) or ``trough``, the size of the negative turning point.
    bits : int, optional
        The relative radius is about 2**-bits.
    progress : bool or callable, optional
        Called with the share that is done and the name of the step; True shows a bar.

    Returns
    -------
    Enclosure
        A ball around omega0 in rad per time unit, and balls around the turning points.

    Raises
    ------
    InputError
        As ``enclose`` does; where the motion from this amplitude does not come back.

    Examples
    --------
    >>> exact_frequency("u'' + u*(1 - u'**2)**(3/2) = 0", 1, bits=64).omega.str(15, radius=False)
    '0.851301158461694'
    """
    own = as_oscillator(oscillator)
    with showing(progress) as told:
        try:
            return enclose(own, amplitude, definition=definition, bits=bits, progress=told)
        except NoEnergyError:
            return by_integration(own, amplitude, definition=definition, bits=bits, progress=told)


def by_integration(
    oscillator: Oscillator,
    amplitude: Amplitude,
    *,
    definition: str = "peak",
    bits: int = 128,
    progress: Progress = silent,
) -> Enclosure:
    """Enclose omega0 at an amplitude by validated integration, whatever energy there is; see ``exact_frequency``.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> by_integration(find("pendulum"), 1, bits=64).omega.overlaps(enclose(find("pendulum"), 1).omega)
    True
    """
    size, bits = exact_size(amplitude), checked_bits(bits)
    check_definition(definition)
    if size == 0:
        return limit_at_rest(oscillator, definition, bits)
    if not oscillator.closes:
        raise InputError(f"{oscillator.name} has no orbit for each amplitude, and so no frequency at one")
    force = oscillator.substituted_force
    force = force if definition == "peak" else -force.subs({U: -U, V: -V}, simultaneous=True)
    turns = 1 if oscillator.is_conservative else 2
    unit = float(natural_frequency(oscillator.natural_frequency))
    if return_map(force, turns=turns)(float(size)) is None:
        raise InputError(f"{oscillator.name}: the motion from {definition} {brief_number(size)} does not come back")

    def attempt(working: int) -> Enclosure:
        return _followed(
            oscillator, force, size, unit=unit, turns=turns, bits=bits, definition=definition, working=working
        )

    return decided(attempt, oscillator.name, bits + 2 * GUARD_BITS, progress)


def _followed(
    oscillator: Oscillator,
    force: sympy.Expr,
    size: Fraction,
    *,
    unit: float,
    turns: int,
    bits: int,
    definition: str,
    working: int,
) -> Enclosure:
    """The enclosure at one precision; raises UndecidedError where that does not do."""
    start = arb(rational(size))
    centre, width = start.mid(), (start.rad() + abs(start) * arb(2) ** -working).upper()
    degree = math.ceil(working / BITS_PER_DEGREE) + 4
    found = passage(field_of(force, arb(unit)), centre, width=width, degree=degree, turns=turns)
    times, places = zip(*(turn.at(width) for turn in found.turns), strict=True)
    omega = 2 * arb.pi() / (times[-1] * (2 if turns == 1 else 1))
    if not places[0] < 0 or omega.rel_accuracy_bits() < bits + GUARD_BITS // 4:
        raise UndecidedError
    peak, trough = (start, places[0]) if definition == "peak" else (-places[0], -start)
    exact = sympy.Rational(size.numerator, size.denominator)
    scale = oscillator.natural_frequency
    return Enclosure(widened(omega, bits), exact, definition, peak, trough, "integration", bits, scale)
