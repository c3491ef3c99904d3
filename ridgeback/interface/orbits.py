"""``ridgeback.periodic_orbit`` and ``precise_orbit``: limit cycles by shooting, of an oscillator in any form."""

from __future__ import annotations

from collections.abc import Mapping

from ridgeback.common.progress import Wanted, showing
from ridgeback.compare.binding.bind import bind
from ridgeback.numeric.motion import limit_cycle
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.numeric.motion.limit_cycle import PeriodicOrbit, PreciseOrbit
from ridgeback.symbolic.systems.any_form import OscillatorLike
from ridgeback.symbolic.systems.parameters import Value


def periodic_orbit(
    oscillator: OscillatorLike | Dynamics,
    *,
    start: float = 1.0,
    parameters: Mapping[str, Value] | None = None,
    progress: Wanted = None,
) -> PeriodicOrbit:
    """Find the limit cycle that a motion from rest approaches, in double precision.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq, sympy.Expr or Dynamics
        The oscillator, in any of the forms that :func:`ridgeback.oscillator` takes, or one that is bound to numbers.
    start : float
        Where it starts from rest, in the unit of u.
    parameters : mapping of str to number or str, optional
        Values of parameters.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share done and the step.

    Returns
    -------
    PeriodicOrbit
        ``period``, ``omega`` in rad per time unit, ``peak`` and ``trough`` in the unit of u, the Floquet
        ``multiplier``, and the errors of period and peak.

    Raises
    ------
    InputError
        When the motion dies out, does not return to a peak, or is periodic at every amplitude.

    References
    ----------
    Guckenheimer and Holmes, Nonlinear Oscillations, Dynamical Systems, and Bifurcations of Vector Fields (1983),
    section 1.5.

    Examples
    --------
    >>> orbit = periodic_orbit("van-der-pol", parameters={"eps": 1})
    >>> round(orbit.period, 9), round(orbit.peak, 9)
    (6.663286859, 2.008619861)
    """
    dynamics = bound(oscillator, parameters)
    with showing(progress) as told:
        return limit_cycle.periodic_orbit(dynamics, start=start, progress=told)


def precise_orbit(
    oscillator: OscillatorLike | Dynamics,
    orbit: PeriodicOrbit | None = None,
    *,
    digits: int = 30,
    parameters: Mapping[str, Value] | None = None,
    progress: Wanted = None,
) -> PreciseOrbit:
    """Find a limit cycle to many digits, by Taylor series at multiple precision.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq, sympy.Expr or Dynamics
        As for :func:`periodic_orbit`.
    orbit : PeriodicOrbit, optional
        The cycle to start from; by default the one that :func:`periodic_orbit` finds.
    digits : int
        Digits wanted.
    parameters : mapping of str to number or str, optional
        Values of parameters.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share done and the digits that are known.

    Returns
    -------
    PreciseOrbit
        ``period`` and ``peak`` as mpmath numbers.

    Raises
    ------
    InputError
        Where there is no limit cycle, or the iteration does not settle to so many digits.

    Examples
    --------
    >>> import mpmath
    >>> with mpmath.workdps(20):
    ...     print(precise_orbit("van-der-pol", digits=20, parameters={"eps": 1}).period)
    6.6632868593231301897
    """
    dynamics = bound(oscillator, parameters)
    with showing(progress) as told:
        found = limit_cycle.periodic_orbit(dynamics) if orbit is None else orbit
        return limit_cycle.precise_orbit(dynamics, found, digits=digits, progress=told)


def bound(oscillator: OscillatorLike | Dynamics, parameters: Mapping[str, Value] | None) -> Dynamics:
    """The oscillator with its numbers.

    >>> bound("duffing", {"k": 2}).natural_frequency
    2.0
    """
    return oscillator if isinstance(oscillator, Dynamics) else bind(oscillator, values=parameters)
