"""What an integration is asked to do, checked before and while it runs: state, span, cost, and the potential well."""

from __future__ import annotations

import math

from ridgeback.common.errors import InputError
from ridgeback.numeric.motion.dynamics import Dynamics, well

MAX_SAMPLES = 2**24
MAX_EVALUATIONS = 20_000_000
_BYTES_PER_SAMPLE = 24  # time, u and u' in float64
EVALUATIONS_PER_CYCLE = 700  # of the period 2 pi / k: DOP853 at rtol 1e-12 on the paper's case takes 672


def check_request(
    dynamics: Dynamics, initial: tuple[float, float], *, duration: float, rate: float
) -> tuple[float, float]:
    """Return the initial state as floats, once state, duration, rate and their cost are seen to be usable.

    >>> from ridgeback.numeric.motion.dynamics import pendulum
    >>> check_request(pendulum(), (0.0, 0.0), duration=1.0, rate=10.0)
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: pendulum: (u, u') = (0, 0) is an equilibrium and stays there; start elsewhere
    """
    try:
        u, v = (float(x) for x in initial)
    except (TypeError, ValueError):
        raise InputError(f"initial state {initial!r} is not two numbers; give (u, u'), such as (1.0, 0.0)") from None
    if not (math.isfinite(u) and math.isfinite(v)):
        raise InputError(f"initial state ({u}, {v}) must be finite")
    for label, value in (("duration", duration), ("rate", rate)):
        if not (math.isfinite(value) and value > 0):
            raise InputError(f"{label} = {value} must be finite and positive")
    _check_budget(dynamics, duration, rate)
    check_inside(dynamics, u, 0.0, well(dynamics))
    pull = checked_force(dynamics, u, v)
    if v == 0 and (u == 0 or pull == 0):
        raise InputError(f"{dynamics.name}: (u, u') = ({u:g}, 0) is an equilibrium and stays there; start elsewhere")
    return u, v


def checked_force(dynamics: Dynamics, u: float, v: float) -> float:
    """The force at a state; raises InputError where it has none, as left of a pole, or none that is a double.

    >>> from ridgeback.numeric.motion.dynamics import duffing
    >>> checked_force(duffing(eps=1.0), 1e154, 0.0)
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: duffing: the force at (u, u') = (1e+154, 0) is no finite number; start elsewhere
    """
    try:
        pull = dynamics.force(u, v)
    except (ArithmeticError, ValueError):
        pull = math.nan
    if not math.isfinite(pull):
        raise InputError(f"{dynamics.name}: the force at (u, u') = ({u:g}, {v:g}) is no finite number; start elsewhere")
    return pull


def _check_budget(dynamics: Dynamics, duration: float, rate: float) -> None:
    samples = duration * rate
    if samples > MAX_SAMPLES:
        raise InputError(
            f"{samples:.3g} samples need {samples * _BYTES_PER_SAMPLE / 1e6:.0f} MB; at most {MAX_SAMPLES} "
            f"fit: use rate <= {MAX_SAMPLES / duration:.6g} or duration <= {MAX_SAMPLES / rate:.6g}"
        )
    most = MAX_EVALUATIONS / EVALUATIONS_PER_CYCLE * 2 * math.pi / dynamics.natural_frequency
    if duration > most:
        raise InputError(
            f"duration = {duration:g} is more cycles of k = {dynamics.natural_frequency:g} than fit in "
            f"{MAX_EVALUATIONS} evaluations; use duration <= {most:.6g}"
        )


def check_inside(dynamics: Dynamics, u: float, time: float, limits: tuple[float, float]) -> None:
    """Raise InputError once u has left the potential well ``limits = well(dynamics)``.

    >>> from ridgeback.numeric.motion.dynamics import pendulum
    >>> check_inside(pendulum(), 3.2, 0.5, well(pendulum()))
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: pendulum: u = 3.2 at t = 0.5 is outside the potential well ...
    """
    left, right = limits
    if not left < u < right:
        raise InputError(
            f"{dynamics.name}: u = {u:.6g} at t = {time:.6g} is outside the potential well "
            f"{left:.6g} < u < {right:.6g} (rotation or escape); start with less energy"
        )
