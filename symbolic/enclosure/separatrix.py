"""Where oscillation about the origin ends: the lower of the two barriers, and the amplitude whose energy it has.

A barrier is an equilibrium (a saddle), the edge of where the force is defined, or the height at which V levels off far
away.  Saddles are proved up to |u| = 64 or so; beyond, where balls of intervals do not go on, ``ends_of`` looks at the
sign of the force in steps of 1 %, and two zeros within one step are not seen.  Where V ends at an edge or far
away its height is extrapolated, to doubles.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from flint import arb

from ridgeback.symbolic.enclosure.turning_points import REACH, equilibria, reflected
from ridgeback.symbolic.enclosure.walk import UndecidedError, Walk, decided, level, root, walk
from ridgeback.symbolic.enclosure.well import Curves, Well, curves, well_of
from ridgeback.symbolic.systems.oscillator import Oscillator


@dataclass(frozen=True)
class Separatrix:
    """The turning points that the largest orbits tend to, in balls: trough < 0 < peak.

    ``saddle`` is the equilibrium that ends the family, one of the two, or None when there is none: proved on the
    whole line for a polynomial potential, else for |u| <= ``reach``, up to a singularity of the force.  A side is
    None when the potential does not reach the saddle's height there.
    """

    peak: arb | None
    trough: arb | None
    saddle: arb | None
    reach: int | None


def separatrix(oscillator: Oscillator, *, bits: int = 64) -> Separatrix:
    """Enclose the limits of oscillation about u = 0.

    Raises InputError as ``well_of`` does, and when balls cannot decide (a force that touches zero, two barriers of
    one height in a potential that is not even).

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> separatrix(find("pendulum")).peak.overlaps(arb.pi())
    True
    >>> separatrix(find("duffing")).saddle is None
    True
    """
    return limits(well_of(oscillator), bits)


SEARCHED: Final = 1024
"""How far saddles of a force that is not a polynomial are looked for, in the unit of u."""


UNTOLD: Final = (
    "the force touches 0 without crossing it, or decays so fast where V levels off that it cannot be told from 0, or "
    "two barriers are of one height), so that where the oscillation ends is not found; enclose single amplitudes"
)
"""Why balls cannot decide where no amplitude is given."""


def limits(well: Well, bits: int) -> Separatrix:
    """The separatrix of a well; see ``separatrix``."""
    return decided(lambda working: _limits(well, working), well.name, bits, why=UNTOLD)


def _limits(well: Well, bits: int) -> Separatrix:
    forward = curves(well, bits)
    left, right = _barriers(well, forward, bits)
    reach = None if well.polynomial is not None else SEARCHED
    if right is not None and well.even:
        return Separatrix(right, -right, right, reach)
    if right is not None and (left is None or _lower(forward, right, left)):
        depth = _at_level(reflected(forward), forward.value(right))
        return Separatrix(right, None if depth is None else -depth, right, reach)
    if left is not None:
        return Separatrix(_at_level(forward, forward.value(left)), left, left, reach)
    return Separatrix(None, None, None, reach)


@dataclass(frozen=True)
class Ends:
    """Where oscillation about u = 0 ends, to doubles; infinite where nothing ends it as far as it is followed.

    ``left`` and ``right`` are the first other equilibria or the edges of the force, ``peak`` the largest turning point.
    """

    left: float
    right: float
    peak: float


def ends_of(oscillator: Oscillator) -> Ends:
    """Return where the oscillation about u = 0 ends, by saddles, edges of the force, and levels far away.

    Saddles are proved up to |u| = 64 or so; beyond, the sign of the force is looked at in steps of 1 %.

    Parameters
    ----------
    oscillator : Oscillator
        Conservative, with numbers for its parameters.

    Returns
    -------
    Ends
        In the unit of u; the force is followed to |u| = 2**20.

    Raises
    ------
    InputError
        As ``separatrix`` does; where the force far out cannot be told from 0.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> ends_of(find("pendulum")).peak, ends_of(find("duffing")).right
    (3.141592653589793, inf)
    >>> morse = Oscillator.from_equation("u'' + exp(2*u) - exp(u) = 0")  # V = 1/2 far on the left
    >>> ends_of(morse).left, round(ends_of(morse).peak - math.log(2), 12)
    (-inf, 0.0)
    """
    well = well_of(oscillator)
    return decided(lambda working: _ends(well, working), well.name, 64, why=UNTOLD)


def _ends(well: Well, bits: int) -> Ends:
    forward = curves(well, bits)
    if well.polynomial is not None:
        ends = equilibria(well, bits)
        return Ends(-_place(ends[0]), _place(ends[1]), _place(_limits(well, bits).peak))
    right, height = _end(forward, exact=well.potential is not None)
    left, depth = (right, height) if well.even else _end(reflected(forward), exact=well.potential is not None)
    if not depth < height:
        return Ends(-left, right, right)
    place = _at_level(forward, arb(depth))
    return Ends(-left, right, right if place is None else float(place))


def _place(end: arb | None) -> float:
    """Its distance from rest."""
    return math.inf if end is None else abs(float(end))


def _end(side: Curves, *, exact: bool) -> tuple[float, float]:
    """Where the force on one side ends, and the height of the potential there; either may be infinite."""
    found = _followed(side)
    match found.end:
        case "zero":
            return float(found.place), float(side.value(found.place))
        case "singular":
            edge = found.place.lower()
            return float(edge), _height([side.value(edge * (1 - arb(2) ** -n)) for n in (32, 40, 48)])
        case "stopped":
            far = arb(REACH if exact else SEARCHED)  # of a potential in closed form
            return math.inf, _height([side.value(far / n) for n in (4, 2, 1)])
    raise UndecidedError


ENOUGH: Final = 64
"""How far a walk has to have gone before it may go on from point to point, without proof between them."""
STRIDE: Final = arb(101) / 100


def _followed(side: Curves) -> Walk:
    """A walk as far as balls of intervals can go, then by points 1 % apart."""
    found = walk(side.force, side.slope, step=arb(1), stop=_never, last=arb(REACH))
    place = found.place.upper()
    if found.end != "exhausted" or place < ENOUGH:
        return found
    while place < REACH:
        here, place = place, (place * STRIDE).mid()
        pull = side.force(place)
        if not pull.is_finite():
            return Walk("singular", here)
        if pull < 0:
            return Walk("zero", root(side.force, side.slope, here, place))
        if not pull > 0:
            raise UndecidedError
    return Walk("stopped", place)


LEVELLING: Final = 0.9
"""Potentials whose rise falls by less from one place to the next are taken to rise for ever, as a logarithm does."""


def _height(values: Sequence[arb]) -> float:
    """The limit of a rising potential by the ratio of its last two rises, infinite where they do not fall.

    >>> _height([arb(1), arb(3) / 2, arb(7) / 4]), _height([arb(1), arb(2), arb(3)])
    (2.0, inf)
    """
    if not all(value.is_finite() for value in values):
        return math.inf
    first, second, last = (float(value) for value in values)
    rise, before = last - second, second - first
    if not rise < LEVELLING * before:
        return last if rise == before == 0 else math.inf
    return last + rise * rise / (before - rise)


def _barriers(well: Well, forward: Curves, bits: int) -> tuple[arb | None, arb | None]:
    """The equilibria next to the origin, left and right."""
    if well.polynomial is not None:
        return equilibria(well, bits)
    back = _first_zero(reflected(forward))
    return (None if back is None else -back), _first_zero(forward)


def _first_zero(side: Curves) -> arb | None:
    found = walk(side.force, side.slope, step=arb(1), stop=_never, last=arb(SEARCHED))
    if found.end in ("undecided", "exhausted"):
        raise UndecidedError
    return found.place if found.end == "zero" else None


def _lower(forward: Curves, first: arb, second: arb) -> bool:
    """Whether the potential is lower at the first place."""
    difference = forward.value(first) - forward.value(second)
    if difference.contains(0):
        raise UndecidedError
    return bool(difference < 0)


def _at_level(side: Curves, energy: arb) -> arb | None:
    return level(side.value, side.force, side.slope, energy, step=arb(1), last=arb(REACH))


def _never(_: arb, __: arb) -> bool:
    return False
