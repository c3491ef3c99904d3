"""The averaged motion of a damped oscillator in any potential: omega0(t) without integrating the equation.

Linear damping has a closed form, given here; under any other damping force that is odd in u' the action is lost at the
rate that ``ridgeback.numeric.orbits.action_loss`` tabulates.

Linear damping.  With E' = -2 mu u'^2 and the mean of u'^2 over an undamped cycle, omega0 J, averaging gives
J' = -2 mu J: the action falls exactly exponentially, J(t) = J0 exp(-2 mu t), and omega0(t) = omega0(J(t)) (Bogoliubov
and Mitropolsky, Asymptotic Methods in the Theory of Non-linear Oscillations, 1961).

The start.  Energy leaves in steps, so the action J* of the instantaneous energy ripples about the averaged J:
J* = J + mu g(phi) + O(mu^2) with omega0 dg/dphi = -(2/omega0)(u'^2 - omega0 J) and zero mean over a cycle.
Integrated from a turning point, the excess X = integral of (u'^2 - omega0 J) dt is odd in the phase, because
the orbit is symmetric in time about its turning points; its mean vanishes, hence g = -(2/omega0) X and

    J0 = J*(0) + (2 mu / omega0) X(0).

A start at rest (the paper's) needs no correction to first order: X = 0 there, midway through a flat step.  So does a
start in the middle of a symmetric well.  Elsewhere the correction is of order mu/k, and is made here.

What is left: under t -> -t, mu -> -mu the decay rate is odd and the frequency even in mu, so that the relative error
of omega0(t) at fixed mu t is of order (mu/k)^2.  For the linear oscillator it is exactly 1 - sqrt(1 - mu^2/k^2).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, frozen
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.numeric.orbits.action_loss import averaged_action, cycles_of, require_odd_damping
from ridgeback.numeric.orbits.energy import is_linearly_damped
from ridgeback.numeric.orbits.period import exact_frequency, peak_of_action
from ridgeback.numeric.orbits.waveform import OrbitPosition, orbit_position


@dataclass(frozen=True)
class AveragedDecay:
    """The averaged motion at the given times; 1-D read-only arrays of one length."""

    time: Array
    action: Array
    """J(t): J0 exp(-2 mu t) for linear damping."""
    action_amplitude: Array
    """sqrt(2 J / k), which equals ``peak`` as the amplitude vanishes."""
    peak: Array
    """A(t), the positive turning point at this action."""
    trough: Array
    omega: Array
    """omega0(t), rad per time unit."""
    start: OrbitPosition
    """Where the initial state lies on its undamped orbit."""
    correction: float
    """What was added to the initial action to make it the averaged one, relative to it; of order mu/k."""


def averaged_decay(
    dynamics: Dynamics, initial: tuple[float, float], time: ArrayLike, *, correct_start: bool = True
) -> AveragedDecay:
    """Return action, amplitude and frequency along a decay by averaging, without integration of the motion.

    Parameters
    ----------
    dynamics : Dynamics
        The oscillator with numbers, which has a potential.
    initial : (float, float)
        u and u' at t = 0.
    time : array of float, shape (N,)
        Where they are wanted.
    correct_start : bool
        Whether the action at the start is corrected for the phase; False takes that of the initial energy as it is.

    Returns
    -------
    AveragedDecay
        J, A and omega0 at ``time``.

    Raises
    ------
    InputError
        Without a potential, for velocity terms that are not odd in u', outside the well, and for times that are not
        finite.

    Examples
    --------
    >>> from ridgeback.numeric.motion.dynamics import linear
    >>> decay = averaged_decay(linear(k=2.0, mu=0.1), (1.0, 0.0), [0.0, 10.0])
    >>> decay.peak.round(12).tolist(), decay.omega.round(12).tolist()
    ([1.0, 0.367879441171], [2.0, 2.0])
    """
    t = np.atleast_1d(np.asarray(time, dtype=float))
    if not np.all(np.isfinite(t)):
        raise InputError("times must be finite")
    u, velocity = (float(x) for x in initial)
    if not (math.isfinite(u) and math.isfinite(velocity)):
        raise InputError(f"initial state ({u}, {velocity}) must be finite")
    start = orbit_position(dynamics, u, velocity)
    require_odd_damping(dynamics, start.peak)
    if is_linearly_damped(dynamics, start.peak):
        shift = 2 * dynamics.damping / start.omega * start.excess if correct_start else 0.0
        J = (start.action + shift) * np.exp(-2 * dynamics.damping * t)
    else:
        shift = -cycles_of(dynamics, np.array([start.peak]))[0].ripple(start.phase) if correct_start else 0.0
        J = averaged_action(dynamics, start.action + shift, t)
    table = exact_frequency(dynamics, peak_of_action(dynamics, J))
    return AveragedDecay(
        time=frozen(t),
        action=frozen(J),
        action_amplitude=frozen(np.sqrt(2 * J / dynamics.natural_frequency)),
        peak=table.peak,
        trough=table.trough,
        omega=table.omega,
        start=start,
        correction=shift / start.action,
    )
