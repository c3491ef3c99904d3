r"""A limit cycle with proof: an interval Newton step on the return map.

A peak A at rest is taken by the motion to its next trough -P(A), or, where f has no symmetry under
(u, u') -> (-u, -u'), by way of the trough to the next peak P(A).  A cycle is a fixed point.  Liouville's formula gives
the slope of the map from the loss on the way,

    P'(A) = exp(- integral of f_u' dt) f(A, 0) / |f(+-P(A), 0)|,

and when, with P' enclosed over [A], N = A_0 - (P(A_0) - A_0) / (P'([A]) - 1) lies inside [A] about A_0, there is one
and only one cycle with its peak in [A], and the peak lies in N (R. E. Moore, Interval Analysis, 1966, chapter 7).  The
period is that of the motions that start in N.  The multiplier is the slope over a whole cycle.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Final

import sympy
from flint import arb, ctx

from ridgeback.common.errors import InputError
from ridgeback.symbolic.cycles.field import Field, field_of
from ridgeback.symbolic.cycles.passage import Passage, passage
from ridgeback.symbolic.enclosure.walk import UndecidedError
from ridgeback.symbolic.expansion.ball_expansion import log2
from ridgeback.symbolic.systems.oscillator import U, V

FIRST_BITS: Final = 128
FIRST_WIDTH: Final = 60
"""The first neighbourhood is 2**-60 of the peak."""
GUARD_BITS: Final = 32
NARROW: Final = 24
"""A tube of 2**-24 of the peak about a motion can be followed; narrower neighbourhoods cost Newton's steps."""
MOST_BITS: Final = 1500
"""Precision beyond which a proof is given up: the tube about the motion grows too much."""
PASSAGES: Final = 7
"""Passages at most before a proof is given up."""
BITS_PER_DEGREE: Final = 2.1
"""A Taylor polynomial gains so many bits with each degree: the logarithm of outer over inner circle."""


@dataclass(frozen=True)
class Cycle:
    """A limit cycle proved to exist, in balls.

    Parameters
    ----------
    omega : arb
        2 pi over the period, in rad per time unit.
    peak, trough : arb
        The turning points, trough < peak, in the unit of u.
    multiplier : arb
        The slope of the return map over a whole cycle: positive, below 1 where the cycle attracts.
    alone : arb
        There is no other cycle with its peak in this ball.
    """

    omega: arb
    peak: arb
    trough: arb
    multiplier: arb
    alone: arb

    @property
    def stable(self) -> bool:
        """Whether neighbours approach it; proved, since the multiplier's ball does not hold 1."""
        return bool(self.multiplier < 1)


@dataclass(frozen=True)
class _Attempt:
    """Where to look, with which precision."""

    centre: arb
    width: arb
    working: int


@dataclass(frozen=True)
class _Newton:
    """What one passage says: the new place of the peak, and whether it proves a cycle."""

    passage: Passage
    field: Field
    attempt: _Attempt
    slope: arb
    peak: arb

    @property
    def proved(self) -> bool:
        return bool(abs(self.peak - self.attempt.centre) < self.attempt.width)


def turns_of(force: sympy.Expr) -> int:
    """How many turning points the map goes by: 1 where the force is odd under (u, u') -> (-u, -u'), else 2.

    >>> turns_of(U - (1 - U**2) * V), turns_of(U + U**2 - V)
    (1, 2)
    """
    return 1 if sympy.expand(force + force.subs({U: -U, V: -V}, simultaneous=True)) == 0 else 2


def enclose_cycle(force: sympy.Expr, guess: float, *, unit: float, bits: int = 128) -> Cycle:
    """Prove that there is a limit cycle near a peak, and enclose it.

    Parameters
    ----------
    force : sympy.Expr
        f(U, V) of u'' + f = 0, without further symbols.
    guess : float
        About its peak, in the unit of u.
    unit : float
        About its frequency, in rad per time unit.
    bits : int, optional
        The relative radius of omega0 is at most about 2**-bits.

    Returns
    -------
    Cycle
        Frequency, turning points and multiplier in balls.

    Raises
    ------
    InputError
        Where no proof is found, with what stands in the way.

    References
    ----------
    W. Tucker, Validated Numerics, Princeton University Press, 2011, chapters 5 and 6.

    Examples
    --------
    >>> cycle = enclose_cycle(U - (1 - U**2) * V, 2.0086, unit=1.0, bits=64)
    >>> cycle.omega.str(18), cycle.peak.str(15, radius=False), cycle.stable
    ('[0.942955...]', '2.00861986087484', True)
    """
    attempt = _Attempt(arb(guess), arb(guess) * arb(2) ** -FIRST_WIDTH, FIRST_BITS)
    turns, why = turns_of(force), "the motion cannot be followed through a cycle"
    for _ in range(PASSAGES):
        if attempt.working > MOST_BITS:
            break
        with ctx.workprec(attempt.working):
            try:
                found = _newton(force, unit, attempt, turns)
            except UndecidedError:
                attempt = replace(attempt, working=2 * attempt.working, width=attempt.width**2)
                continue
            if found.proved:
                cycle = _cycle(found, turns)
                if cycle.omega.rel_accuracy_bits() >= bits:
                    return cycle
            why = "the slope of the return map is not told from 1" if found.slope.overlaps(arb(1)) else "no inclusion"
            attempt = _next(found, bits)
    raise InputError(
        f"no proof of a limit cycle with its peak near {guess:.9g} in {PASSAGES} passages of at most {MOST_BITS} bits: "
        f"{why}"
    )


def _newton(force: sympy.Expr, unit: float, attempt: _Attempt, turns: int) -> _Newton:
    """Follow the motions about the centre, and take a Newton step."""
    field, centre = field_of(force, arb(unit)), attempt.centre
    degree = math.ceil(attempt.working / BITS_PER_DEGREE) + 4
    found = passage(field, centre, width=attempt.width, degree=degree, turns=turns)
    _, end = found.turns[-1].at(arb(0))
    _, ends = found.turns[-1].at(attempt.width)
    wide = centre + arb(0, attempt.width)
    slope = (-found.loss).exp() * abs(field.value(wide, arb(0))) / abs(field.value(ends, arb(0)))
    peak = centre - (abs(end) - centre) / (slope - 1)
    return _Newton(found, field, attempt, slope, peak)


def _cycle(found: _Newton, turns: int) -> Cycle:
    """The cycle whose peak the Newton step encloses."""
    attempt = found.attempt
    width = abs(found.peak - attempt.centre).upper()
    places = [turn.at(width) for turn in found.passage.turns]
    period = places[-1][0] * (2 if turns == 1 else 1)
    return Cycle(
        omega=2 * arb.pi() / period,
        peak=found.peak,
        trough=-found.peak if turns == 1 else places[0][1],
        multiplier=found.slope ** (2 if turns == 1 else 1),
        alone=attempt.centre + arb(0, attempt.width),
    )


def _next(found: _Newton, bits: int) -> _Attempt:
    """About the new place, a neighbourhood of the size that Newton's next step will need."""
    attempt = found.attempt
    if not found.peak.is_finite():
        return replace(attempt, width=attempt.width * arb(2) ** -20, working=attempt.working + 64)
    shift = abs(found.peak.mid() - attempt.centre)
    lost = log2((found.passage.turns[-1].tube.grown / abs(found.slope - 1).lower()).upper())
    enough = bits + GUARD_BITS + 2 * lost  # the error of the peak, and that of the period that the peak's error makes
    floor = found.peak.mid() * arb(2) ** (lost + 8 - enough)
    followed = found.peak.mid() * arb(2) ** -NARROW / found.passage.turns[-1].tube.grown
    width = arb.max(arb.max(arb.min(shift * arb(2) ** -20, followed), 16 * found.peak.rad()), floor)
    more = attempt.working + GUARD_BITS if attempt.working >= enough else enough
    return _Attempt(found.peak.mid(), width.upper(), more)
