"""A motion from a peak to its next turning points, with all its neighbours, and what is lost on the way.

The motion starts at rest, (u, u') = (A, 0) with u'' < 0, and is followed by validated Taylor steps to the first zero of
u' (the trough, half a cycle) or to the second (the next peak).  That these are the first ones is proved: between them
u' has one sign, at them u'' has one sign.  A tube about the polynomials holds every motion that starts within
``width`` of A; its radius is an affine function of the width, so that one passage serves all smaller widths.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

from flint import arb, arb_poly

from ridgeback.common.recurrences import Input
from ridgeback.symbolic.cycles.field import BALLS, Field
from ridgeback.symbolic.cycles.taylor_step import Step, changed, disc, over, step_from, within
from ridgeback.symbolic.enclosure.walk import UndecidedError

MOST_STEPS: Final = 4000
HALVINGS: Final = 12
"""How often an interval of time is halved to see the sign of u' there."""
LOSS_DEGREE: Final = 20
"""Degree to which df/du' is expanded: a few digits of its integral are enough."""
NEWTON_STEPS: Final = 40


@dataclass(frozen=True)
class Tube:
    """Every motion that starts within e of the middle one stays within grown * e + added, u' weighed in ``unit``."""

    grown: arb
    added: arb
    unit: arb

    def radius(self, width: arb) -> arb:
        """The distance for a width of the start, from above."""
        return (self.grown * width + self.added).upper()

    def after(self, step: Step) -> Tube:
        """The tube throughout a step."""
        factor = step.factor * changed(self.unit, step.unit)
        return Tube((self.grown * factor).upper(), (self.added * factor + step.added).upper(), step.unit)

    def rounded(self, u: arb, v: arb) -> Tube:
        """The tube about the middle of a state known in balls."""
        return Tube(self.grown, (self.added + u.rad() + v.rad() / self.unit).upper(), self.unit)


@dataclass(frozen=True)
class Turn:
    """A zero of u' within a step: ``at`` gives its time and place for all motions of a width.

    Parameters
    ----------
    before : arb
        Time at which the step starts, exact.
    step : Step
        Within which it lies.
    tube : Tube
        Throughout the step.
    place : arb
        About where, in the step's own time, exact.
    field : Field
        The equation.
    """

    before: arb
    step: Step
    tube: Tube
    place: arb
    field: Field

    def between(self, width: arb) -> tuple[arb, arb]:
        """Times in the step between which u' changes its sign, once, for all motions of a width."""
        error = self.tube.radius(width)
        pull = abs(self.field.value(*box(self.step, self.place, self.place, error, self.step.unit)))
        if not pull > 0:
            raise UndecidedError
        reach = (2 * (error * self.step.unit + abs(self.step.v(self.place))) / pull).upper()
        low, high = (self.place - reach).lower(), (self.place + reach).upper()
        ends = [sign(self.step.v(t) + arb(0, error * self.step.unit)) for t in (low, high)]
        turning = sign(-self.field.value(*box(self.step, low, high, error, self.step.unit)))
        if low < 0 or high > self.step.length or 0 in ends or ends != [-turning, turning]:
            raise UndecidedError
        return low, high

    def at(self, width: arb) -> tuple[arb, arb]:
        """Balls of the time and of u for all motions that start within ``width`` of the middle one."""
        low, high = self.between(width)
        u, _ = box(self.step, low, high, self.tube.radius(width), self.step.unit)
        return self.before + low.union(high), u


@dataclass(frozen=True)
class Passage:
    """The turning points of a motion and its neighbours.

    Parameters
    ----------
    turns : tuple of Turn
        The zeros of u' in the order of time: trough, and peak where it was asked for.
    loss : arb
        A ball around the integral of df/du' to the last of them, for all motions within the width of the passage.
    """

    turns: tuple[Turn, ...]
    loss: arb


def sign(x: arb) -> int:
    """The sign of every point of a ball; 0 where it has none."""
    return 1 if x > 0 else -1 if x < 0 else 0


def box(step: Step, start: arb, end: arb, error: arb, unit: arb) -> tuple[arb, arb]:
    """Balls of u and u' between two times of a step for all motions within an error of it."""
    return over(step.u, start, end) + arb(0, error), over(step.v, start, end) + arb(0, (error * unit).upper())


def passage(field: Field, peak: arb, *, width: arb, degree: int, turns: int) -> Passage:
    """Follow the motion from rest at a peak, and its neighbours, through their next turning points.

    Parameters
    ----------
    field : Field
        The equation.
    peak : arb
        u at the start, exact and positive, u' = 0.
    width : arb
        Neighbours start within this of it.
    degree : int
        Of the Taylor polynomials.
    turns : int
        1 (to the trough) or 2 (to the next peak).

    Returns
    -------
    Passage
        The turning points.

    Raises
    ------
    UndecidedError
        Where balls of this precision and width cannot tell.

    Examples
    --------
    >>> from flint import ctx
    >>> from ridgeback.symbolic.cycles.field import field_of
    >>> from ridgeback.symbolic.systems.oscillator import U
    >>> with ctx.workprec(100):
    ...     found = passage(field_of(U, arb(1)), arb(1), width=arb("1e-20"), degree=60, turns=1)
    ...     time, trough = found.turns[0].at(arb(0))
    ...     bool(abs(time - arb.pi()) < 1e-25), bool(abs(trough + 1) < 1e-25), found.loss.contains(0)
    (True, True, True)
    """
    u, v, time, loss, tube = peak, arb(0), arb(0), arb(0), Tube(arb(1), arb(0), field.unit)
    longest = float((peak / abs(field.value(peak, v))).sqrt())  # of the first step: about one radian
    found: list[Turn] = []
    course = -1  # the sign of u'
    for number in range(MOST_STEPS):
        step = step_from(field, u, v, unit=tube.unit, degree=degree, error=tube.radius(width), longest=longest)
        tube = tube.after(step)
        error, end = tube.radius(width), step.length
        u, v = step.end()
        now = sign(v + arb(0, (error * step.unit).upper()))
        if now == course:
            _check_course(field, step, arb(0), end, error, course, from_rest=number == 0)
        elif now == -course and number > 0:
            turn = Turn(time, step, tube, _zero(step.v, end), field)
            low, high = turn.between(width)
            _check_course(field, step, arb(0), low, error, course)
            _check_course(field, step, high, end, error, -course)
            found.append(turn)
            course = -course
            if len(found) == turns:
                return Passage(tuple(found), loss + _loss(field, step, low.union(high), error))
        else:
            raise UndecidedError
        loss = loss + _loss(field, step, end, error)
        time = time + end
        tube = tube.rounded(u, v)
        u, v, longest = u.mid(), v.mid(), math.inf
    raise UndecidedError


def _check_course(
    field: Field, step: Step, start: arb, end: arb, error: arb, course: int, *, from_rest: bool = False, depth: int = 0
) -> None:
    """Raise UndecidedError unless u' is proved to have one sign from start to end (but at rest at 0)."""
    u, v = box(step, start, end, error, step.unit)
    if sign(v) == course:
        return
    pull = sign(-field.value(u, v))
    slack = arb(0, (error * step.unit).upper())
    first = pull if from_rest else sign(step.v(start) + slack)
    if pull and first == course == sign(step.v(end) + slack):
        return
    if depth == HALVINGS:
        raise UndecidedError
    middle = ((start + end) / 2).mid()
    _check_course(field, step, start, middle, error, course, from_rest=from_rest, depth=depth + 1)
    _check_course(field, step, middle, end, error, course, depth=depth + 1)


def _zero(v: arb_poly, end: arb) -> arb:
    """About where a polynomial vanishes between 0 and ``end``, at whose sides its signs differ; nothing is proved."""
    low, high, t, slope = arb(0), end, (end / 2).mid(), v.derivative()
    rising = v(end) > 0
    for _ in range(NEWTON_STEPS):
        value = v(t)
        if value.contains(0):
            return t
        low, high = (low, t) if (value > 0) == rising else (t, high)
        t = (t - value / slope(t)).mid()
        t = t if low < t < high else ((low + high) / 2).mid()
    return t


def _loss(field: Field, step: Step, end: arb, error: arb) -> arb:
    """A ball around the integral of df/du' from 0 to ``end`` for all motions within an error of the step."""
    count = LOSS_DEGREE + 1
    u, v = (Input(BALLS, [*p.coeffs(), *[arb(0)] * count][:count]) for p in (step.u, step.v))
    node = field.node(field.along_v, u, v)
    polynomial = arb_poly([node.get(n) for n in range(count)]).integral()
    ratio = end.upper() / step.circle
    size = abs(field.complex_slope(disc(step.u, step.circle), disc(step.v, step.circle)))
    tail = size * ratio**count / (1 - ratio)
    near = within(step.u, step.length, error), within(step.v, step.length, error * step.unit)
    spread = error * (abs(field.curve_uv(*near)) + step.unit * abs(field.curve_vv(*near)))
    return polynomial(end) + arb(0, ((tail + spread) * end).upper())
