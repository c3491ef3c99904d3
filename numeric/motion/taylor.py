"""Taylor-series integration at any precision, with dense polynomials and events at full precision.

The method of À. Jorba and M. Zou, A software package for the numerical integration of ODEs by means of
high-order Taylor methods, Experimental Mathematics 14 (2005) 99-117: order from the precision, step from the
last two coefficients.  The oscillator hands over its own Taylor coefficients (``Dynamics.jet``).
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from time import perf_counter

import mpmath as mp
import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, silent
from ridgeback.numeric.arrays import Array, frozen, frozen_mask
from ridgeback.numeric.motion.dynamics import Dynamics, well
from ridgeback.numeric.motion.events import CrossingEvents, TurningEvents
from ridgeback.numeric.motion.integration import MEMORY_BUDGET
from ridgeback.numeric.motion.precise_ring import Precise
from ridgeback.numeric.motion.request import check_inside, check_request
from ridgeback.numeric.motion.trajectory import Trajectory, sample_times

_GUARD = 8  # digits carried beyond those asked for, against rounding over many steps
PILOT = 40
"""Steps that are timed to see how long the rest takes."""
SECONDS = 150.0
"""What an integration may take."""
_BYTES = 220  # of one coefficient of 30 digits with its object
_MAX_WORK = 3e8  # steps times degree squared; one unit costs about 0.5 microseconds
_SUBDIVISIONS = 2  # of each step, when looking for sign changes


@dataclass(frozen=True)
class PreciseEvent:
    """A zero of u or u' at full precision: time, u and u' (mpmath numbers)."""

    time: Precise
    u: Precise
    velocity: Precise


@dataclass(frozen=True)
class TaylorSolution:
    """Local polynomials ``u(t) = sum c_j (t - knot)^j`` from each knot to the next, in mpmath numbers."""

    knots: tuple[Precise, ...]
    """Step boundaries, one more than there are polynomials."""
    polynomials: tuple[tuple[Precise, ...], ...]
    digits: int

    @property
    def degree(self) -> int:
        """The order of the method."""
        return len(self.polynomials[0]) - 1

    def state(self, time: Precise) -> tuple[Precise, Precise]:
        """Return u and u' at one time within the span."""
        with mp.workdps(self.digits + _GUARD):
            t = mp.mpf(time)
            if not 0 <= t <= self.knots[-1]:
                raise InputError(f"time {mp.nstr(t, 8)} must lie within 0 and {mp.nstr(self.knots[-1], 8)}")
            index = min(bisect_right(self.knots, t), len(self.polynomials)) - 1
            u, v = _evaluate(self.polynomials[index], t - self.knots[index])
            return u, v

    def crossings(self) -> tuple[PreciseEvent, ...]:
        """Return the zeros of u in order of time."""
        return tuple(self._events(0))

    def turnings(self) -> tuple[PreciseEvent, ...]:
        """Return the zeros of u' in order of time."""
        return tuple(self._events(1))

    def _events(self, derivative: int) -> Iterator[PreciseEvent]:
        """Sign changes on a few points of each step, then Newton on the local polynomial."""
        with mp.workdps(self.digits + _GUARD):
            first = self.polynomials[0]
            if first[derivative] == 0:
                yield PreciseEvent(mp.mpf(0), first[0], first[1])
            for knot, end, c in zip(self.knots[:-1], self.knots[1:], self.polynomials, strict=True):
                shifts = [(end - knot) * i / _SUBDIVISIONS for i in range(_SUBDIVISIONS + 1)]
                values = [_evaluate(c, s)[derivative] for s in shifts]
                for i in range(_SUBDIVISIONS):
                    if values[i] * values[i + 1] < 0 or values[i + 1] == 0:
                        shift = _newton(c, derivative, shifts[i], shifts[i + 1])
                        yield PreciseEvent(knot + shift, *_evaluate(c, shift))

    @cached_property
    def _scaled(self) -> tuple[Array, Array, Array]:
        """Starts and widths of the steps, and the coefficients in shares of a step, ``[step, power]``, in float64."""
        starts = np.array([float(t) for t in self.knots[:-1]])
        widths = np.array([float(b - a) for a, b in zip(self.knots[:-1], self.knots[1:], strict=True)])
        scaled = np.array(
            [
                [float(x * mp.mpf(h) ** j) for j, x in enumerate(c)]
                for c, h in zip(self.polynomials, widths, strict=True)
            ]
        )
        return starts, widths, scaled

    def dense(self, t: Array) -> tuple[Array, Array]:
        """Return u and u' in float64 at any times of the span: the scaled polynomials, summed by Horner's rule."""
        starts, widths, scaled = self._scaled
        index = np.clip(np.searchsorted(starts, t, side="right") - 1, 0, starts.size - 1)
        s = (t - starts[index]) / widths[index]
        u, v = np.zeros_like(s), np.zeros_like(s)
        for j in range(self.degree, -1, -1):
            v = v * s + u
            u = u * s + scaled[index, j]
        return u, v / widths[index]


def _evaluate(c: tuple[Precise, ...], s: Precise) -> tuple[Precise, Precise]:
    """Return the polynomial and its derivative at s."""
    u, v = mp.polyval(c[::-1], s, derivative=True)
    return u, v


def _newton(c: tuple[Precise, ...], derivative: int, low: Precise, high: Precise) -> Precise:
    """Return the zero of the polynomial's 0th or 1st derivative within a short bracket with a sign change."""
    target = c if derivative == 0 else tuple(j * x for j, x in enumerate(c))[1:]
    rising = _evaluate(target, high)[0] > _evaluate(target, low)[0]
    x = (low + high) / 2
    for _ in range(10 * mp.mp.dps):
        value, slope = _evaluate(target, x)
        if (value > 0) == rising:
            high = x
        else:
            low = x
        step = x - value / slope if slope else low
        if not low <= step <= high:
            step = (low + high) / 2
        if abs(step - x) <= mp.eps * abs(high):
            return step
        x = step
    return x


def degree_for(digits: int) -> int:
    """Return the order for a tolerance of 10^-digits: half its natural logarithm, plus one (Jorba and Zou, 3.1).

    >>> degree_for(30)
    36
    """
    return math.ceil(0.5 * digits * math.log(10)) + 1


def taylor_solution(
    dynamics: Dynamics,
    initial: tuple[Precise, Precise],
    *,
    duration: float,
    digits: int = 30,
    degree: int | None = None,
    progress: Progress = silent,
) -> TaylorSolution:
    """Integrate to about ``digits`` significant digits per step; ``initial`` may hold mpmath numbers.

    ``degree`` fixes the order, and with it keeps the step rule; by default it follows the digits.  Raises
    InputError without ``dynamics.jet``, for digits outside 5 to 1000 and for work beyond the budget.

    >>> from ridgeback.numeric.motion.dynamics import linear
    >>> solution = taylor_solution(linear(), (1, 0), duration=4.0, digits=30)
    >>> with mp.workdps(30):
    ...     print(2 * solution.crossings()[0].time)
    3.14159265358979323846264338328
    """
    jet = dynamics.jet
    if jet is None and dynamics.switches is not None:
        raise InputError(f"{dynamics.name}: a force with kinks has no Taylor series there; use method DOP853 instead")
    if jet is None:
        raise InputError(f"{dynamics.name}: no Taylor coefficients are given (jet); use method DOP853 instead")
    if not 5 <= digits <= 1000:
        raise InputError(f"digits = {digits} is outside 5 to 1000")
    order = degree_for(digits + 2) if degree is None else degree
    if order < 2:
        raise InputError(f"degree = {order} is too low for a second-order equation; use 2 or more")
    with mp.workdps(digits + _GUARD):
        u, v = mp.mpf(initial[0]), mp.mpf(initial[1])
        time, end = mp.mpf(0), mp.mpf(duration)
        limits = well(dynamics)
        knots: list[Precise] = [time]
        polynomials: list[tuple[Precise, ...]] = []
        began = perf_counter()
        while time < end:
            c = tuple(jet(u, v, order))
            step = min(_step(c, dynamics.natural_frequency), end - time)
            if not polynomials:
                _check_work(float(end / step) * order**2, duration)
                _check_memory(float(end / step) * order, duration)
            if len(polynomials) == PILOT:
                check_time((perf_counter() - began) / float(time) * float(end - time), duration)
            polynomials.append(c)
            progress(float(time / end), f"integrating to {digits} digits")
            time = end if step == end - time else time + step
            knots.append(time)
            u, v = _evaluate(c, step)
            check_inside(dynamics, float(u), float(time), limits)
        return TaylorSolution(tuple(knots), tuple(polynomials), digits)


def _step(c: tuple[Precise, ...], k: float) -> Precise:
    """Return the step: e^-2 of the radius of convergence read off the last two coefficients (Jorba and Zou, 3.2)."""
    size = _log2(mp.hypot(c[0], c[1] / k))
    radii = [(size - _log2(c[j])) / j for j in (len(c) - 2, len(c) - 1) if c[j]]
    if not radii:
        return mp.inf
    least = min(radii) - 2.0 * math.log2(math.e)
    return mp.ldexp(mp.mpf(2.0 ** (least % 1.0)), math.floor(least))


def _log2(x: Precise) -> float:
    """The binary logarithm of a number's size, whatever that is: a step is read off a few digits."""
    mantissa, exponent = x.man_exp
    return math.log2(abs(mantissa)) + int(exponent)


def _check_work(work: float, duration: float) -> None:
    if work > _MAX_WORK:
        raise InputError(
            f"Taylor integration over {duration:g} would take about {work * 5e-7:.0f} s; "
            f"use fewer digits or duration <= {duration * _MAX_WORK / work:.3g}"
        )


def _check_memory(coefficients: float, duration: float) -> None:
    """Refuse what would keep more coefficients than the budget of memory holds."""
    if coefficients * _BYTES > MEMORY_BUDGET:
        raise InputError(
            f"Taylor integration over {duration:g} would keep about {coefficients * _BYTES / 1e9:.2g} GB of "
            f"coefficients; use fewer digits or duration <= {duration * MEMORY_BUDGET / (coefficients * _BYTES):.3g}"
        )


def check_time(seconds: float, duration: float) -> None:
    """Refuse what the first steps show to take longer than the budget.

    >>> check_time(1000.0, 5.0)
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: Taylor integration over 5 would take about 1000 s; use ... duration <= 0.75
    """
    if seconds > SECONDS:
        raise InputError(
            f"Taylor integration over {duration:g} would take about {seconds:.0f} s; "
            f"use fewer digits or duration <= {duration * SECONDS / seconds:.3g}"
        )


def integrate_taylor(
    dynamics: Dynamics,
    initial: tuple[float, float],
    *,
    duration: float,
    rate: float,
    digits: int = 30,
    events: bool = True,
    progress: Progress = silent,
) -> Trajectory:
    """Solve as ``trajectory.integrate`` does, by Taylor series; samples and events are rounded once to float64.

    Without ``events`` there are none in it, which takes a quarter less time: for a check of samples.

    >>> from ridgeback.numeric.motion.dynamics import linear
    >>> run = integrate_taylor(linear(), (1.0, 0.0), duration=7.0, rate=10.0, digits=20)
    >>> bool(abs(run.u - np.cos(run.time)).max() < 1e-15)
    True
    """
    check_request(dynamics, initial, duration=duration, rate=rate)
    solution = taylor_solution(dynamics, initial, duration=duration, digits=digits, progress=progress)
    time = np.minimum(sample_times(duration, rate), duration)
    states = [solution.state(t) for t in time.tolist()]
    crossings, turnings = (solution.crossings(), solution.turnings()) if events else ((), ())
    return Trajectory(
        name=dynamics.name,
        time=frozen(time),
        u=frozen([float(u) for u, _ in states]),
        velocity=frozen([float(v) for _, v in states]),
        rate=float(rate),
        duration=float(duration),
        crossings=CrossingEvents(
            frozen([float(e.time) for e in crossings]),
            frozen_mask([e.velocity > 0 for e in crossings]),
            frozen([float(e.velocity) for e in crossings]),
        ),
        turnings=TurningEvents(frozen([float(e.time) for e in turnings]), frozen([float(e.u) for e in turnings])),
        method=f"Taylor, order {solution.degree}, {digits} digits",
        rtol=10.0**-digits,
        evaluations=len(solution.polynomials),
        steps=frozen([float(t) for t in solution.knots]),
        interpolant=solution.dense,
    )
