"""The exact frequency that an expansion is held against: closed form and quadrature, or the periodic orbit.

Where u' enters the conserved energy otherwise than as u'^2/2 it is the certified enclosure; where no energy of a known
form is conserved, one cycle is integrated at high precision.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ridgeback.compare.binding.bind import bind
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.motion.closed_orbit import closed_orbit
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.numeric.motion.limit_cycle import periodic_orbit
from ridgeback.numeric.orbits.period import exact_frequency
from ridgeback.symbolic.enclosure.enclosure import enclose
from ridgeback.symbolic.systems.oscillator import Oscillator

_BITS = 64


@dataclass(frozen=True)
class Reference:
    """Frequency of the periodic motion at each value of the variable, with its relative uncertainty."""

    omega: Array
    relative_error: Array
    name: str


def conservative_reference(dynamics: Dynamics, peaks: Array) -> Reference:
    """Exact omega0 at peak amplitudes: the closed form where there is one, else quadrature.

    With both, the uncertainty is their difference plus the quadrature's own error.
    """
    table = exact_frequency(dynamics, peaks)
    spread = table.error / table.omega
    if dynamics.closed_form is None:
        return Reference(table.omega, spread, "quadrature of the period")
    closed = dynamics.closed_form(peaks)
    return Reference(closed, np.abs(table.omega / closed - 1) + spread, "closed form, checked by quadrature")


def enclosed_reference(oscillator: Oscillator, peaks: Array) -> Reference:
    """Exact omega0 at peak amplitudes from certified enclosures, for forces a(u) + b(u) u'^2.

    Raises InputError as ``ridgeback.symbolic.enclosure.enclosure.enclose`` does.
    """
    found = [enclose(oscillator, float(peak), bits=_BITS).omega for peak in peaks]
    omega = np.array([float(ball.mid()) for ball in found])
    error = np.array([float(ball.rad() / ball) for ball in found]) + np.finfo(float).eps
    return Reference(omega, error, "certified enclosure")


def integrated_reference(dynamics: Dynamics, peaks: Array) -> Reference:
    """Frequency at peak amplitudes from one integrated cycle each, for families of orbits that nothing else gives.

    Raises InputError where an orbit does not close; see ``ridgeback.numeric.motion.closed_orbit``.
    """
    found = [closed_orbit(dynamics, float(peak)) for peak in peaks]
    omega, error = (np.array(values) for values in zip(*((o.omega, o.relative_error) for o in found), strict=True))
    return Reference(omega, error, "one cycle integrated by Taylor series to 20 digits")


def limit_cycle_reference(oscillator: Oscillator, strengths: Array) -> Reference:
    """Frequency of the limit cycle at each eps, from the periodic orbit found by shooting."""
    name = oscillator.small or "eps"
    orbits = [periodic_orbit(bind(oscillator, values={name: float(eps)})) for eps in strengths]
    omega = np.array([orbit.omega for orbit in orbits])
    error = np.array([orbit.period_error / orbit.period for orbit in orbits])
    return Reference(omega, error, "periodic orbit found by shooting")
