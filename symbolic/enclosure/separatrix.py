"""Where oscillation about the origin ends: the lower of the two barriers, and the amplitude whose energy it has."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from flint import arb

from ridgeback.symbolic.enclosure.turning_points import REACH, equilibria, reflected
from ridgeback.symbolic.enclosure.walk import UndecidedError, decided, level, walk
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


def limits(well: Well, bits: int) -> Separatrix:
    """The separatrix of a well; see ``separatrix``."""
    return decided(lambda working: _limits(well, working), well.name, bits)


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
