r"""omega0(A) of a conservative oscillator as a ball: a midpoint and a radius between which the truth provably lies.

Turning points and barriers are certified first (``turning_points``), then omega0 comes from a closed form
(``elliptic``) or from a quadrature with a proved error bound (``period_quadrature``).  Working precision is raised when
balls come out too wide to decide or to answer.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Final, Literal, TypeAlias

import sympy
from flint import arb, ctx

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, Wanted, showing, silent
from ridgeback.symbolic.arithmetic.balls import rational
from ridgeback.symbolic.enclosure.analytic_strip import strip_of
from ridgeback.symbolic.enclosure.ball_functions import number
from ridgeback.symbolic.enclosure.closed_form import closed_form
from ridgeback.symbolic.enclosure.half_wells import quarter_times, two_sided
from ridgeback.symbolic.enclosure.integrand import integrand_of
from ridgeback.symbolic.enclosure.no_linear_part import strong_well
from ridgeback.symbolic.enclosure.quadrature import frequency
from ridgeback.symbolic.enclosure.separatrix import Separatrix, limits, separatrix
from ridgeback.symbolic.enclosure.turning_points import Orbit, orbit
from ridgeback.symbolic.enclosure.walk import UndecidedError, decided
from ridgeback.symbolic.enclosure.well import Well, well_of
from ridgeback.symbolic.grammar.tokens import parse_number
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.oscillator import Oscillator
from ridgeback.symbolic.systems.sides import require_one_law

__all__ = ["Amplitude", "Enclosure", "Separatrix", "enclose", "separatrix"]

Amplitude: TypeAlias = "Fraction | int | str | float | sympy.Rational"
Method: TypeAlias = Literal["closed form", "quadrature", "integration"]

DEFINITIONS: Final = ("peak", "trough")
BITS: Final = (16, 4096)
"""Smallest and largest precision of the answer."""

MAX_MAGNITUDE: Final = 1000
"""Amplitudes are between 2**-1000 and 2**1000."""

GUARD_BITS: Final = 40
CHECK_BITS: Final = 64
"""Precision of a limit that is only printed."""


@dataclass(frozen=True)
class Enclosure:
    """omega0 at one amplitude: ``omega`` is a ball that contains it, in rad per time unit.

    A ball of more bits lies inside one of fewer bits, since the radius is at least 2**-bits of the value while the
    centre is accurate to many more.  ``peak`` and ``trough`` are balls around the turning points, trough < 0 < peak;
    ``amplitude`` is exact and positive, and ``definition`` says which of the two it is the size of.
    """

    omega: arb
    amplitude: sympy.Rational
    definition: str
    peak: arb
    trough: arb
    method: Method
    bits: int
    scale: sympy.Expr
    """k, the limit of omega0 at small amplitude."""

    @property
    def lower(self) -> float:
        """The largest float that is certainly not above omega0."""
        return rounded_down(self.omega)

    @property
    def upper(self) -> float:
        """The smallest float that is certainly not below omega0."""
        return rounded_up(self.omega)

    @property
    def middle(self) -> arb:
        """The centre of the ball, exact."""
        return self.omega.mid()

    @property
    def radius(self) -> arb:
        """The radius of the ball, exact."""
        return self.omega.rad()

    def __str__(self) -> str:
        return str(self.omega)


def enclose(
    oscillator: OscillatorLike,
    amplitude: Amplitude,
    *,
    definition: str = "peak",
    bits: int = 128,
    method: Method | None = None,
    progress: Wanted = None,
) -> Enclosure:
    """Enclose omega0 at an amplitude, rigorously, to a relative radius of about 2**-bits.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        Any form of a conservative oscillator with numbers for its parameters.
    amplitude : float, int, str, Fraction or sympy.Rational
        In the unit of u, 0 or more; text is the decimal or fraction it shows, a float its exact binary value.
    definition : str, optional
        ``peak`` (default) or ``trough``, the size of the negative turning point.
    bits : int, optional
        128 (the default) gives 38 digits.
    method : str, optional
        ``closed form`` or ``quadrature``, to insist on one of the two routes.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share done and the precision that is tried.

    Returns
    -------
    Enclosure
        A ball around omega0 in rad per time unit, and balls around the turning points.

    Raises
    ------
    InputError
        For oscillators without orbits of one energy, for amplitudes at or beyond the separatrix (which it names), and
        when the balls cannot decide.

    References
    ----------
    Johansson, Arb: efficient arbitrary-precision midpoint-radius interval arithmetic, IEEE Transactions on Computers 66
    (2017) 1281-1292.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> enclose(find("pendulum"), "0.5", bits=64).omega.str(15)
    '[0.984394850023902 +/- 3.27e-17]'
    >>> enclose(find("duffing-softening"), 1)
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: duffing-softening: peak amplitude 1 is at or beyond the separatrix ...
    """
    oscillator = as_oscillator(oscillator)
    require_one_law(oscillator.name, oscillator.substituted_force)
    if oscillator.by_sides:
        return _by_sides(oscillator, amplitude, definition=definition, bits=bits, method=method)
    with showing(progress) as told:
        return enclose_in(
            well_of(oscillator), amplitude, definition=definition, bits=bits, method=method, progress=told
        )


def enclose_in(
    well: Well,
    amplitude: Amplitude,
    *,
    definition: str = "peak",
    bits: int = 128,
    method: Method | None = None,
    progress: Progress = silent,
) -> Enclosure:
    """Enclose omega0 at an amplitude of the motion in a well; see ``enclose``."""
    size, bits = exact_size(amplitude), checked_bits(bits)
    check_definition(definition)
    well = well.mirrored() if definition == "trough" else well
    value, place, how = _at_rest(well, bits) if size == 0 else _swinging(well, size, bits, method, definition, progress)
    peak, trough = (place.peak, place.trough) if definition == "peak" else (-place.trough, -place.peak)
    exact = sympy.Rational(size.numerator, size.denominator)
    return Enclosure(value, exact, definition, peak, trough, how, bits, well.scale)


def _by_sides(
    oscillator: Oscillator, amplitude: Amplitude, *, definition: str, bits: int, method: Method | None
) -> Enclosure:
    """Of a force that is analytic on each side of rest only, or has no linear part."""
    well = None if oscillator.is_kinked else strong_well(oscillator)
    if well is not None:
        found = enclose_in(well, amplitude, definition=definition, bits=bits, method=method)
        return replace(found, scale=sympy.S.Zero)
    size, bits = exact_size(amplitude), checked_bits(bits)
    check_definition(definition)
    if method == "closed form":
        raise InputError(f"{oscillator.name} has no closed form here; use the quadrature, which holds for every force")
    sides = two_sided(oscillator)
    if size == 0:
        return limit_at_rest(oscillator, definition, bits)
    sides = sides.mirrored() if definition == "trough" else sides
    exact = sympy.Rational(size.numerator, size.denominator)

    def attempt(working: int) -> Enclosure:  # noqa: ARG001 - the precision is that of the context
        found = quarter_times(sides, exact, bits + GUARD_BITS // 2)
        if found is None:
            raise InputError(_no_orbit(f"{sides.name}: {definition} amplitude {brief_number(size)}"))
        near, far, turn = found
        omega = arb.pi() / (near + far)
        if omega.rel_accuracy_bits() < bits + GUARD_BITS // 4:
            raise UndecidedError
        places = (arb(rational(exact)), -turn)
        peak, trough = places if definition == "peak" else (-places[1], -places[0])
        scale = oscillator.natural_frequency if oscillator.is_linear_at_rest else sympy.S.Zero
        return Enclosure(widened(omega, bits), exact, definition, peak, trough, "quadrature", bits, scale)

    return decided(attempt, sides.name, bits + GUARD_BITS + GUARD_BITS + 2 * max(0, -_magnitude(size)))


def limit_at_rest(oscillator: Oscillator, definition: str, bits: int) -> Enclosure:
    """omega0 at amplitude 0: the natural frequency, where there is one."""
    k = oscillator.natural_frequency
    with ctx.workprec(bits + GUARD_BITS):
        value = widened(number(k), bits)
    return Enclosure(value, sympy.S.Zero, definition, arb(0), arb(0), "closed form", bits, k)


def check_definition(definition: str) -> None:
    if definition not in DEFINITIONS:
        raise InputError(
            f"amplitude {definition!r} has no enclosure, for which the turning point must be known exactly; "
            f"use {' or '.join(DEFINITIONS)}"
        )


def _at_rest(well: Well, bits: int) -> tuple[arb, Orbit, Method]:
    with ctx.workprec(bits + GUARD_BITS):
        return widened(number(well.scale), bits), Orbit(arb(0), arb(0)), "closed form"


def _swinging(
    well: Well, size: Fraction, bits: int, method: Method | None, definition: str, progress: Progress
) -> tuple[arb, Orbit, Method]:
    peak = rational(size)

    def attempt(working: int) -> tuple[arb, Orbit, Method]:
        path = orbit(well, peak, working)
        if path is None:
            raise InputError(_beyond(well, size, definition))
        value, how = _natural(well, path, bits, method)
        omega = number(well.scale) * value
        if omega.rel_accuracy_bits() < bits + GUARD_BITS // 4:
            raise UndecidedError
        return widened(omega, bits), path, how

    return decided(attempt, well.name, bits + GUARD_BITS + _cancelled(well, size), progress)


def _natural(well: Well, path: Orbit, bits: int, method: Method | None) -> tuple[arb, Method]:
    """omega0/k by a closed form if there is one, else by quadrature."""
    value = None if method == "quadrature" else closed_form(well, path)
    if value is not None:
        return value, "closed form"
    if method == "closed form":
        raise InputError(f"{well.name} has no closed form here; use the quadrature, which holds for every potential")
    return frequency(integrand_of(well, path), strip_of(well, path), bits + GUARD_BITS // 2), "quadrature"


def widened(omega: arb, bits: int) -> arb:
    """The ball with 2**-bits of its value added to its radius, so that balls of more bits lie inside.

    >>> widened(arb(1), 10).contains(arb(1.0009))
    True
    """
    return arb(omega.mid(), (omega.rad() + abs(omega) * arb(2) ** -bits).upper())


def rounded_down(ball: arb) -> float:
    """Return the largest float that is not above any point of the ball.

    Examples
    --------
    >>> rounded_down(arb(1) / 3) < Fraction(1, 3)
    True
    """
    low = ball.lower()
    value = float(low)
    return value if arb(value) <= low else math.nextafter(value, -math.inf)


def rounded_up(ball: arb) -> float:
    """Return the smallest float that is not below any point of the ball.

    Examples
    --------
    >>> rounded_up(arb(1) / 3) > Fraction(1, 3)
    True
    """
    return -rounded_down(-ball)


def exact_size(amplitude: Amplitude) -> Fraction:
    """The amplitude as an exact fraction, not negative; InputError for what is none.

    >>> exact_size("0.5")
    Fraction(1, 2)
    """
    if isinstance(amplitude, str):
        value = parse_number(amplitude)
    elif isinstance(amplitude, sympy.Rational):
        value = Fraction(int(amplitude.p), int(amplitude.q))
    elif isinstance(amplitude, bool) or not isinstance(amplitude, int | float | Fraction):
        raise InputError(f"amplitude {amplitude!r} is a {type(amplitude).__name__}, not a number; give e.g. '0.5'")
    elif isinstance(amplitude, float) and not math.isfinite(amplitude):
        raise InputError(f"amplitude {amplitude!r} is not finite; give e.g. '0.5'")
    else:
        value = Fraction(amplitude)
    if value < 0:
        raise InputError(f"amplitude {brief_number(value)} is negative; give its size, with definition trough if meant")
    if value and abs(_magnitude(value)) > MAX_MAGNITUDE:
        raise InputError(f"the amplitude is not within 2**-{MAX_MAGNITUDE} .. 2**{MAX_MAGNITUDE}; scale the unknown")
    return value


def _magnitude(value: Fraction) -> int:
    """The exponent of two next to a positive fraction."""
    return value.numerator.bit_length() - value.denominator.bit_length()


def checked_bits(bits: int) -> int:
    low, high = BITS
    if isinstance(bits, bool) or not isinstance(bits, int) or not low <= bits <= high:
        raise InputError(f"bits {bits!r} must be a whole number from {low} to {high}; 128 gives 38 digits")
    return bits


def _cancelled(well: Well, size: Fraction) -> int:
    """Bits that V(A) - V(u) may lose when it is formed as a difference: near the ends, and at a small amplitude."""
    return 0 if well.polynomial is not None else GUARD_BITS + 2 * max(0, -_magnitude(size))


def _beyond(well: Well, size: Fraction, definition: str) -> str:
    """Why there is no orbit at this amplitude, with the largest that has one."""
    what = f"{well.name}: {definition} amplitude {brief_number(size)}"
    try:
        limit = limits(well, CHECK_BITS).peak
    except InputError:
        limit = None
    if limit is not None:
        return f"{what} is at or beyond the separatrix at {float(limit):.10g}; use less"
    return _no_orbit(what)


def _no_orbit(what: str) -> str:
    return (
        f"{what} has no closed orbit: the force vanishes or is not analytic on the way, or the potential does not rise "
        "as high on the other side as far as it was followed; use less"
    )


def brief_number(value: Fraction) -> str:
    """A fraction in at most ten digits.

    >>> brief_number(Fraction(1, 3))
    '0.3333333333'
    """
    return f"{float(value):.10g}"
