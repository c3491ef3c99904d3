"""The periodic orbit of a limit cycle by Newton's method on its return map (shooting on a Poincaré section).

The section is u' = 0 at a peak: the map P takes a peak u = A to the next one.  The orbit is the fixed point of P, found
as the zero of G(a) = ln P(e^a) - a in a = ln A, which keeps Newton away from the trivial fixed point A = 0.  The slope
of P there is the Floquet multiplier: below 1 in size the limit cycle attracts (Guckenheimer and Holmes, Nonlinear
Oscillations, 1983, section 1.5).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import mpmath as mp
import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, silent
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.numeric.motion.precise_ring import Precise
from ridgeback.numeric.motion.taylor import taylor_solution
from ridgeback.numeric.motion.trajectory import Trajectory, integrate

_SLOPE_STEP = 1e-4  # in ln A: balances the truncation of a central difference against rounding
_VANISHED = 1e-6  # of the start: peaks below this are the noise of the transient's tolerance
_NEUTRAL = 1e-6  # multipliers this near to 1 cannot be told from a family of orbits


@dataclass(frozen=True)
class PeriodicOrbit:
    """A limit cycle: period, frequency, both turning points and the Floquet multiplier of the return map.

    The errors are the changes when the tolerance of the integration is tightened from 1e-11 to 1e-13.
    """

    name: str
    period: float
    omega: float
    peak: float
    trough: float
    multiplier: float
    period_error: float
    peak_error: float


@dataclass(frozen=True)
class PreciseOrbit:
    """The same fixed point at high precision (mpmath numbers) by Taylor integration."""

    period: Precise
    peak: Precise
    digits: int


@dataclass(frozen=True)
class _Return:
    period: float
    peak: float
    trough: float


def periodic_orbit(dynamics: Dynamics, *, start: float = 1.0, progress: Progress = silent) -> PeriodicOrbit:
    """Find the limit cycle that a motion from rest approaches.

    Parameters
    ----------
    dynamics : Dynamics
        The oscillator with numbers.
    start : float
        Where it starts from rest, in the unit of u.
    progress : callable
        Told the share of the work that is done and the step.

    Returns
    -------
    PeriodicOrbit
        Period, turning points and multiplier.

    Raises
    ------
    InputError
        When the motion dies out, does not return to a peak, or is periodic at every amplitude (a conservative
        oscillator: use ``exact_frequency``).

    Examples
    --------
    >>> from ridgeback.numeric.motion.dynamics import van_der_pol
    >>> orbit = periodic_orbit(van_der_pol(1.0))
    >>> round(orbit.period, 9), round(orbit.peak, 9)
    (6.663286859, 2.008619861)
    """
    if not (math.isfinite(start) and start > 0):
        raise InputError(f"start = {start} must be finite and positive")
    progress(0.0, "the first cycles")
    guess = _settle(dynamics, start)
    progress(0.1, "the return map")
    rough, _ = _fixed_point(dynamics, guess, 1e-11)
    progress(0.6, "the return map, more tightly")
    fine, multiplier = _fixed_point(dynamics, rough.peak, 1e-13)
    floor = 1e-13
    return PeriodicOrbit(
        name=dynamics.name,
        period=fine.period,
        omega=2 * math.pi / fine.period,
        peak=fine.peak,
        trough=fine.trough,
        multiplier=multiplier,
        period_error=abs(fine.period - rough.period) + floor * fine.period,
        peak_error=abs(fine.peak - rough.peak) + floor * fine.peak,
    )


def _settle(dynamics: Dynamics, start: float) -> float:
    """The last peak of a transient of about 20 cycles."""
    duration = 20 * 2 * math.pi / dynamics.natural_frequency
    run = integrate(dynamics, (start, 0.0), duration=duration, rate=1 / duration, rtol=1e-8)
    peaks = run.turnings.value[run.turnings.value > 0]
    if peaks.size < 2:
        raise InputError(f"{dynamics.name}: fewer than two peaks within 20 natural periods; it does not oscillate")
    if peaks[-1] < _VANISHED * start:
        raise InputError(
            f"{dynamics.name}: from u = {start:g} the motion dies out to {peaks[-1]:.1e} in 20 natural periods: "
            "no limit cycle; if there is a smaller one, start nearer to it"
        )
    return float(peaks[-1])


def _fixed_point(dynamics: Dynamics, guess: float, rtol: float) -> tuple[_Return, float]:
    """Return the orbit at the fixed point and the multiplier P'(A)."""

    def growth(a: float) -> float:
        return math.log(_return(dynamics, math.exp(a), rtol).peak) - a

    a, slope = math.log(guess), math.nan
    for _ in range(40):
        value = growth(a)
        slope = (growth(a + _SLOPE_STEP) - growth(a - _SLOPE_STEP)) / (2 * _SLOPE_STEP)
        if abs(slope) < _NEUTRAL < abs(value):
            break
        if abs(slope) < _NEUTRAL:
            raise InputError(
                f"{dynamics.name}: the return map is neutral at peak {math.exp(a):.6g}: no isolated limit cycle; "
                "use the exact frequency by amplitude for a conservative oscillator"
            )
        step = max(-0.5, min(0.5, -value / slope))
        a += step
        if not -20 < a < 20:
            break
        if abs(step) < 100 * rtol:
            return _return(dynamics, math.exp(a), rtol), 1 + slope
    raise InputError(
        f"{dynamics.name}: no limit cycle found from peak {guess:.6g}; the motion dies out or grows without bound"
    )


def _return(dynamics: Dynamics, peak: float, rtol: float) -> _Return:
    """Integrate from one peak to the next; the last peak found within a growing duration."""
    natural = 2 * math.pi / dynamics.natural_frequency
    for factor in (1.5, 4.0, 16.0, 64.0):
        duration = factor * natural
        run = integrate(dynamics, (peak, 0.0), duration=duration, rate=1 / duration, rtol=rtol)
        found = _next_peak(run)
        if found is not None:
            return found
    raise InputError(f"{dynamics.name}: no return to a peak within 64 natural periods from u = {peak:.6g}")


def _next_peak(run: Trajectory) -> _Return | None:
    """The first turning point above zero after one below it; None when the run ends before."""
    time, value = run.turnings.time, run.turnings.value
    low = np.flatnonzero(value < 0)
    high = np.flatnonzero((value > 0) & (np.arange(value.size) > low[0])) if low.size else low
    if high.size == 0:
        return None
    return _Return(float(time[high[0]]), float(value[high[0]]), float(value[low[0]]))


def precise_orbit(
    dynamics: Dynamics, orbit: PeriodicOrbit, *, digits: int = 30, progress: Progress = silent
) -> PreciseOrbit:
    """Refine a limit cycle to many digits: the secant method on the return map, by Taylor series.

    Parameters
    ----------
    dynamics : Dynamics
        The oscillator with numbers; it must give its Taylor coefficients (``jet``).
    orbit : PeriodicOrbit
        The cycle to start from.
    digits : int
        Digits wanted.
    progress : callable
        Told the share of the work that is done and the step.

    Returns
    -------
    PreciseOrbit
        Period and peak in multiple precision.

    Raises
    ------
    InputError
        Where the iteration does not settle to so many digits.

    Examples
    --------
    >>> from ridgeback.numeric.motion.dynamics import van_der_pol
    >>> oscillator = van_der_pol(1.0)
    >>> with mp.workdps(20):
    ...     print(precise_orbit(oscillator, periodic_orbit(oscillator), digits=20).period)
    6.6632868593231301897
    """
    span = 1.1 * orbit.period

    def growth(a: Precise) -> tuple[Precise, Precise]:
        solution = taylor_solution(dynamics, (mp.exp(a), mp.mpf(0)), duration=span, digits=digits)
        turnings = solution.turnings()
        period, peak = next((e.time, e.u) for e in turnings if e.time > 0.9 * orbit.period and e.u > 0)
        return mp.log(peak) - a, period

    with mp.workdps(digits + 5):
        a = mp.log(mp.mpf(orbit.peak))
        value, period = growth(a)
        slope = mp.mpf(orbit.multiplier) - 1
        for _ in range(12):
            step = -value / slope
            known = -math.log10(max(abs(float(step)), 1e-300))
            progress(min(0.95, max(0.0, known / digits)), f"about {max(0, int(known))} of {digits} digits")
            following, period = growth(a + step)
            converged = abs(step) < mp.mpf(10) ** -digits
            if step != 0 and not converged:
                slope = (following - value) / step
            a, value = a + step, following
            if converged:
                return PreciseOrbit(+period, mp.exp(a), digits)
    raise InputError(f"{dynamics.name}: the orbit does not settle to {digits} digits; ask for fewer")
