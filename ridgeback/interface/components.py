"""``ridgeback.components``: the harmonics a_m(t) along a motion, measured and of the undamped orbit."""

from __future__ import annotations

from collections.abc import Mapping

from ridgeback.compare.motion.harmonics import components as by_cycles
from ridgeback.compare.motion.harmonics.components import COUNT, Components
from ridgeback.compare.motion.motion import integrate_motion, setting
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.parameters import Value


def components(
    oscillator: OscillatorLike,
    *,
    parameters: Mapping[str, Value] | None = None,
    about: str | None = None,
    initial: tuple[float, float] | None = None,
    duration: float | None = None,
    rate: float | None = None,
    count: int = COUNT,
) -> Components:
    """Measure the components a_m(t) of eq. (7) along a motion, cycle by cycle.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        Whose motion it is, in any of the forms that :func:`ridgeback.oscillator` takes.
    parameters, about : optional
        As for :func:`ridgeback.oscillator`.
    initial : (float, float), optional
        State (u, u') at time 0.
    duration : float, optional
        Time to integrate over; 40 natural periods by default.
    rate : float, optional
        Samples per time unit; the components are taken from the dense solution and do not depend on it.
    count : int
        Multiples 1 .. ``count`` of the fundamental.

    Returns
    -------
    Components
        ``amplitude[m - 1]`` is a_m over ``time``, ``model`` the same of the undamped orbit at the averaged action.

    Raises
    ------
    InputError
        For a motion that cannot be integrated, leaves its well or has too few cycles, and a count outside 1 to 30.

    Examples
    --------
    >>> found = components("damped_pendulum", initial=(2.0, 0.0), duration=60.0)
    >>> bool(found.amplitude[0, 0] > found.amplitude[0, -1] > 0), bool(found.model_error < 0.05)
    (True, True)
    """
    chosen = setting(
        as_oscillator(oscillator, parameters=parameters, about=about), initial=initial, duration=duration, rate=rate
    )
    return by_cycles.components(integrate_motion(chosen, digits=None), count=count)
