"""omega0(t) of an oscillator whose parameters drift slowly, by the invariance of its action.

At frozen parameters p the motion has an action J and a frequency omega0(J; p).  While p changes slowly J is conserved,
but for what damping takes on average,

    (ln J)' = -R(J; p(t)),   omega0(t) = omega0(J(t); p(t)),

R being the averaged loss of ``action_loss`` at the parameters of the moment, 2 mu(t) for linear damping (V. I. Arnold,
Mathematical Methods of Classical Mechanics, 1989, section 52; Bogoliubov and Mitropolsky, 1961, section 24).

The start.  The action J* of the instantaneous energy ripples about J: E' = dV/dt - u' d at fixed u gives
J* = J + g(phi), omega0^2 dg/dphi = -(u' d - dV/dt - their mean), and J at time 0 is J* - g.

What is left is of second order in the rates of drift and damping.  For u'' + 2 mu(t) u' + omega(t)^2 u = 0 the
phase of the WKB solution obeys W^2 = omega^2 - mu^2 - mu' - W''/(2 W) + 3 W'^2/(4 W^2) exactly, so that

    omega/W - 1 = omega''/(4 omega^3) - 3 omega'^2/(8 omega^4) + (mu^2 + mu')/(2 omega^2) + higher orders,

which is what is given as ``expected_error``, with mu = -(ln J)'/2: the leading error of a linear oscillator, and the
order of it for others away from a separatrix.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import Chebyshev
from numpy.typing import ArrayLike
from scipy import fft
from scipy.integrate import solve_ivp

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, frozen
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.numeric.motion.integration import Drift
from ridgeback.numeric.orbits.action_loss import HARMONICS, POINTS, Cycle, cycles_of, require_odd_damping
from ridgeback.numeric.orbits.period import exact_frequency, peak_of_action
from ridgeback.numeric.orbits.waveform import orbit_harmonics, orbit_position

INTERVALS = (16, 32, 64, 128, 256, 512)
"""Of Chebyshev points over the time; their number is doubled until omega0 is interpolated to ``ACCURACY``."""
ACCURACY = 1e-9
SLOW = 0.1
"""Change of omega0 in a radian, relative to it, up to which a drift counts as slow."""


@dataclass(frozen=True)
class AdiabaticMotion:
    """Action, amplitude and frequency along a slow drift; 1-D read-only arrays of one length.

    Parameters
    ----------
    time : array
        The times.
    action : array
        J(t).
    peak : array
        The positive turning point of the orbit with that action at the parameters of the moment.
    omega : array
        omega0(t), rad per time unit.
    rate : array
        omega0'/omega0^2, the relative change in a radian.
    expected_error : array
        Relative error of omega0 to leading order, of a linear oscillator; for others its order.
    correction : float
        What was taken from the action at the start to make it the conserved one, relative to it.
    """

    time: Array
    action: Array
    peak: Array
    omega: Array
    rate: Array
    expected_error: Array
    correction: float

    @property
    def is_slow(self) -> bool:
        """Whether omega0 changes by a small share in a radian throughout."""
        return float(np.abs(self.rate).max()) <= SLOW


def adiabatic_motion(
    dynamics: Dynamics, drift: Drift, initial: tuple[float, float], time: ArrayLike
) -> AdiabaticMotion:
    """Return action, amplitude and frequency along a slow drift, without integration of the motion.

    Parameters
    ----------
    dynamics : Dynamics
        The oscillator of time 0, which has a potential.
    drift : Drift
        How it changes.
    initial : (float, float)
        u and u' at time 0.
    time : array of float, shape (N,)
        Where they are wanted, from 0 on.

    Returns
    -------
    AdiabaticMotion
        J, A and omega0 at ``time``, with the leading error.

    Raises
    ------
    InputError
        Without a potential, for velocity terms that are not odd in u', outside the well, where the orbit with this
        action leaves the well, and for a drift too fast to be tabulated.

    Examples
    --------
    Of the linear oscillator J = omega A^2/2 is conserved, so that A goes like omega^(-1/2):

    >>> from ridgeback.numeric.motion.dynamics import linear
    >>> k = lambda t: 1 + 0.01 * t
    >>> grows = Drift(lambda t, u, v: k(t)**2 * u, lambda t, u: 0.01 * k(t) * u**2, lambda t: linear(k=k(t)), True, "")
    >>> found = adiabatic_motion(linear(), grows, (1.0, 0.0), [0.0, 44.0])
    >>> found.omega.round(9).tolist(), found.peak.round(9).tolist()
    ([1.0, 1.44], [1.0, 0.833333333])
    """
    t = np.atleast_1d(np.asarray(time, dtype=float))
    if not (np.all(np.isfinite(t)) and t.min() >= 0):
        raise InputError("times must be finite and not before 0")
    first, correction = _conserved(dynamics, drift, initial)
    end = float(t.max())
    level = _levels(drift, math.log(first), end)
    omega, peak = _tabulated(drift, level, end)
    return AdiabaticMotion(
        time=frozen(t),
        action=frozen(np.exp(level(t))),
        peak=frozen(peak(t)),
        omega=frozen(omega(t)),
        rate=frozen(omega.deriv()(t) / omega(t) ** 2),
        expected_error=frozen(_leading_error(omega, _damping(level, end), t)),
        correction=correction,
    )


def _damping(level: Callable[[Array], Array], end: float) -> Chebyshev:
    """mu(t) = -(ln J)'/2 as a polynomial of few terms, as befits an estimate."""
    places = 0.5 * end * (1.0 + np.cos(np.pi * np.arange(INTERVALS[0] + 1) / INTERVALS[0]))
    return -0.5 * _through(level(places), end).deriv()


def _leading_error(omega: Chebyshev, mu: Chebyshev, t: Array) -> Array:
    """omega/W - 1 to second order."""
    w, slope, bend = omega(t), omega.deriv()(t), omega.deriv(2)(t)
    return np.asarray(bend / (4 * w**3) - 3 * slope**2 / (8 * w**4) + (mu(t) ** 2 + mu.deriv()(t)) / (2 * w**2))


def _conserved(dynamics: Dynamics, drift: Drift, initial: tuple[float, float]) -> tuple[float, float]:
    """The action that is conserved, and what was added to that of the energy at the start, relative to it."""
    place = orbit_position(dynamics, *initial)
    require_odd_damping(dynamics, place.peak)
    cycle = cycles_of(dynamics, np.array([place.peak]))[0]
    phase = np.arange(POINTS) * (2 * np.pi / POINTS)
    cosine = orbit_harmonics(dynamics, [place.peak], count=HARMONICS).cosine[:, 0]
    gain = drift.changing(0.0, np.cos(np.outer(phase, np.arange(HARMONICS + 1))) @ cosine)
    both = Cycle(cycle.omega, cycle.action, cycle.power - gain, cycle.mean - float(gain.mean()))
    shift = -both.ripple(place.phase)
    return place.action + shift, shift / place.action


def _levels(drift: Drift, first: float, end: float) -> Callable[[Array], Array]:
    """ln J over the time."""

    def loss(time: float, level: Array) -> Array:
        own = drift.frozen(time)
        if drift.linear:
            return np.array([-2.0 * own.damping])
        peak = _peak(own, math.exp(float(level[0])), time, drift.text)
        return np.array([-cycles_of(own, np.array([peak]))[0].rate])

    found = solve_ivp(loss, (0.0, end), [first], method="LSODA", rtol=1e-7, atol=1e-8, dense_output=True)
    sol = found.sol
    if sol is None or not found.success:
        raise InputError(f"the averaged loss of action cannot be followed to t = {end:.6g}: {found.message}")
    return lambda t: np.asarray(sol(t)[0])


def _peak(own: Dynamics, J: float, time: float, text: str) -> float:
    """The peak of the orbit with an action; InputError where it has left the well of the moment."""
    try:
        return float(peak_of_action(own, [J])[0])
    except InputError as error:
        why = str(error).removeprefix(f"{own.name}: ")
        raise InputError(
            f"{own.name}: with {text} the orbit leaves its well by t = {time:.4g} ({why}); use a shorter duration or "
            "start lower"
        ) from None


def _tabulated(drift: Drift, level: Callable[[Array], Array], end: float) -> tuple[Chebyshev, Chebyshev]:
    """omega0 and the peak over the time as polynomials through Chebyshev points, the known ones kept at each doubling.

    Refined until the last coefficients are small.
    """
    known: dict[float, tuple[float, float]] = {}
    for count in _resolving(drift, end):
        points = np.cos(np.pi * np.arange(count + 1) / count)
        for x in points.tolist():
            if x not in known:
                time = 0.5 * end * (1.0 + x)
                own = drift.frozen(time)
                peak = _peak(own, math.exp(float(level(np.array([time]))[0])), time, drift.text)
                known[x] = float(exact_frequency(own, [peak]).omega[0]), peak
        omega, peaks = (_through(np.array([known[x][part] for x in points.tolist()]), end) for part in (0, 1))
        if _is_settled(omega):
            return omega, peaks
    raise too_often(drift, end)


def _resolving(drift: Drift, end: float) -> tuple[int, ...]:
    """The numbers of points that resolve k(t), which is cheap to ask; omega0 needs about as many."""
    for place, count in enumerate(INTERVALS):
        times = 0.5 * end * (1.0 + np.cos(np.pi * np.arange(count + 1) / count))
        if _is_settled(_through(np.array([drift.frozen(time).natural_frequency for time in times.tolist()]), end)):
            return INTERVALS[place:]
    raise too_often(drift, end)


def _is_settled(curve: Chebyshev) -> bool:
    """Whether the last coefficients are small."""
    return bool(np.abs(curve.coef[-3:]).max() <= ACCURACY * np.abs(curve.coef[0]))


def too_often(drift: Drift, end: float) -> InputError:
    """The refusal of a law that changes up and down too often."""
    return InputError(f"with {drift.text} omega0 changes too often over {end:g} to be tabulated; shorten the duration")


def _through(values: Array, end: float) -> Chebyshev:
    """The polynomial with these values at cos(pi j/n), j = 0 .. n, of the interval from 0 to ``end``.

    Its coefficients are the cosine sums of the values, those at both ends and the first and last of them halved.
    """
    n = values.size - 1
    coefficients = fft.dct(values, type=1) / n
    coefficients[[0, -1]] *= 0.5
    return Chebyshev(coefficients, domain=[0.0, end])
