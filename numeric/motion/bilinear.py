"""Bilinear oscillators: a stiffness that changes at u = s, on one side or on both; exact frequency and waveform.

    u'' + 2 mu u' + r(u) = 0,    r = k1^2 u  up to the switch,    r = k1^2 s + p + k2^2 (u - s)  beyond it, s >= 0.

``symmetric`` switches at -s as well.  With s = 0 the two half-planes have stiffnesses of their own and
omega0 = 2 k1 k2 / (k1 + k2) at every amplitude.  With s > 0 a stop is met: omega0 = k1 up to A = s and, with
x = A/s - 1 and q = p/(k1^2 s), just beyond it

    omega0/k1 - 1 = n sqrt(2 x) q / (pi sqrt(1 + q))  for p > 0,      n (2 x)^(3/2) (k2^2/k1^2 - 1) / (3 pi)  for p = 0,

n = 1, or 2 when symmetric: a preloaded stop makes omega0(A) not differentiable at A = s, one without preload (a force
that is continuous) makes it not twice differentiable (for such oscillators see S. W. Shaw and P. J. Holmes, A
periodically forced piecewise linear oscillator, J. Sound Vib. 90 (1983) 129-155).

Between switches the motion is linear, so that a period is a sum of arc cosines.  Amplitudes are ``peak``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.motion.dynamics import Dynamics


@dataclass(frozen=True)
class Bilinear:
    """A bilinear oscillator: ``inner`` is k1, ``outer`` k2 (rad per time unit), ``switch`` s, ``preload`` p.

    Raises InputError unless k1, k2 > 0, s >= 0 (s > 0 when symmetric or preloaded), p >= 0 and 0 <= mu below both
    frequencies.

    >>> Bilinear(1.0, 2.0).force(-1.0, 0.0), Bilinear(1.0, 2.0).force(1.0, 0.0)
    (-1.0, 4.0)
    """

    inner: float
    outer: float
    switch: float = 0.0
    mu: float = 0.0
    symmetric: bool = False
    preload: float = 0.0

    def __post_init__(self) -> None:
        values = {"k1": self.inner, "k2": self.outer, "switch": self.switch, "mu": self.mu, "preload": self.preload}
        for name, value in values.items():
            if not math.isfinite(value):
                raise InputError(f"bilinear: {name} = {value} must be finite")
        if not (self.inner > 0 and self.outer > 0):
            raise InputError(f"bilinear: k1 = {self.inner:g} and k2 = {self.outer:g} must both be above 0")
        special = self.symmetric or self.preload > 0
        if self.switch < 0 or (special and self.switch == 0):
            least = "above 0 when symmetric or preloaded" if special else "0 or more (mirror u otherwise)"
            raise InputError(f"bilinear: switch = {self.switch:g} must be {least}")
        if self.preload < 0:
            raise InputError(f"bilinear: preload = {self.preload:g} must be 0 or more, a force that restores")
        if not 0 <= self.mu < min(self.inner, self.outer):
            raise InputError(
                f"bilinear: mu = {self.mu:g} must be 0 or more and below {min(self.inner, self.outer):g}, the lower "
                "natural frequency; the motion does not oscillate otherwise"
            )

    def force(self, u: float, velocity: float) -> float:
        """f(u, u') = 2 mu u' + r(u) on plain floats."""
        return 2.0 * self.mu * velocity + float(restoring(self, u))


def restoring(oscillator: Bilinear, u: ArrayLike) -> Array:
    """Return r(u), vectorised.

    >>> restoring(Bilinear(1.0, 2.0, 0.5, symmetric=True), [-1.0, 0.25, 1.0]).tolist()
    [-2.5, 0.25, 2.5]
    """
    x = np.asarray(u, dtype=float)
    change = oscillator.outer**2 - oscillator.inner**2
    beyond = np.maximum(x - oscillator.switch, 0.0)
    if oscillator.symmetric:
        beyond = beyond + np.minimum(x + oscillator.switch, 0.0)
    return np.asarray(oscillator.inner**2 * x + change * beyond + oscillator.preload * np.sign(beyond))


def potential(oscillator: Bilinear, u: ArrayLike) -> Array:
    """Return V(u), V(0) = 0, vectorised.

    >>> potential(Bilinear(1.0, 2.0), [-1.0, 1.0]).tolist()
    [0.5, 2.0]
    """
    x = np.asarray(u, dtype=float)
    change = oscillator.outer**2 - oscillator.inner**2
    beyond = np.maximum((np.abs(x) if oscillator.symmetric else x) - oscillator.switch, 0.0)
    return np.asarray(0.5 * oscillator.inner**2 * x**2 + 0.5 * change * beyond**2 + oscillator.preload * beyond)


def as_dynamics(oscillator: Bilinear) -> Dynamics:
    """Return it in the form that the general integrators and quadratures take; they see the corner as any other force.

    >>> float(as_dynamics(Bilinear(1.0, 3.0)).closed_form(0.2))
    1.5
    """
    return Dynamics(
        name="bilinear",
        force=oscillator.force,
        natural_frequency=float(bilinear_frequency(oscillator, 0.0)),
        damping=oscillator.mu,
        potential=lambda u: potential(oscillator, u),
        restoring=lambda u: restoring(oscillator, u),
        closed_form=lambda A: bilinear_frequency(oscillator, A),
    )


@dataclass(frozen=True)
class _Arcs:
    """The undamped orbit as two arcs per half (or quarter) cycle, for each peak; above the switch first.

    u = centre + radius cos(k2 t) from the peak for a time ``above``, then a sine of k1 with amplitude ``swing``, which
    is the trough's distance (one-sided) or u' at 0 over k1 (symmetric), for a time ``below``.
    """

    centre: Array
    radius: Array
    swing: Array
    above: Array
    below: Array


# Above the switch, with w = u - s and F = k1^2 s + p:  w'' + k2^2 w = -F, turning at w = A - s, hence
# w = -F/k2^2 + R cos(k2 t).  Below it the energy is that of the swing S:  k1^2 S^2 = k1^2 s^2 + 2 F (A - s)
# + k2^2 (A - s)^2.
def _arcs(oscillator: Bilinear, peak: Array) -> _Arcs:
    k1, k2, s = oscillator.inner, oscillator.outer, oscillator.switch
    over = np.maximum(peak - s, 0.0)
    force = s + oscillator.preload / k1**2
    sag = (k1 / k2) ** 2 * force
    radius = over + sag
    swing = np.where(peak > s, np.sqrt(s * s + 2 * force * over + (k2 / k1 * over) ** 2), peak)
    # arccos(sag / radius) by its tangent: the difference of nearly equal numbers near the switch is avoided
    above = np.arctan2(np.sqrt(over * (over + 2 * sag)), sag) / k2
    above = np.where(peak > s, above, 0.0)
    height = np.sqrt(over * (2 * force + (k2 / k1) ** 2 * over))
    if oscillator.symmetric:
        below = np.where(peak > s, np.arctan2(s, height), 0.5 * math.pi) / k1
    else:
        below = np.where(peak > s, math.pi - np.arctan2(height, s), math.pi) / k1
    return _Arcs(np.asarray(s - sag), radius, swing, above, below)


def bilinear_frequency(oscillator: Bilinear, peak: ArrayLike) -> Array:
    """Return the exact omega0 (rad per time unit) of the undamped oscillator at peak amplitudes A >= 0.

    Raises InputError for an amplitude that is negative or not finite.

    >>> bilinear_frequency(Bilinear(1.0, 3.0), [0.1, 5.0]).tolist()
    [1.5, 1.5]
    """
    A = _checked(peak)
    if oscillator.switch == 0:
        return np.full(A.shape, 2 / (1 / oscillator.inner + 1 / oscillator.outer))
    arcs = _arcs(oscillator, A)
    share = 0.5 if oscillator.symmetric else 1.0
    return np.asarray(share * math.pi / (arcs.above + arcs.below))


def bilinear_waveform(oscillator: Bilinear, peak: ArrayLike, phase: ArrayLike) -> Array:
    """Return u of the undamped motion, ``[peak, phase]``, at phases 0..pi counted from the peak (even beyond).

    >>> bilinear_waveform(Bilinear(1.0, 2.0), [1.0], [0.0, np.pi]).round(12).tolist()
    [[1.0, -2.0]]
    """
    A = np.atleast_1d(_checked(peak))[:, None]
    angle = np.abs(np.mod(np.asarray(phase, dtype=float) + math.pi, 2 * math.pi) - math.pi)[None, :]
    arcs = _arcs(oscillator, A)
    sign = np.ones_like(angle)
    whole = math.pi
    if oscillator.symmetric:
        sign, angle = np.where(angle > 0.5 * math.pi, -1.0, 1.0), np.minimum(angle, math.pi - angle)
        whole = 0.5 * math.pi
    duration = arcs.above + arcs.below
    t = angle / whole * duration
    high = arcs.centre + arcs.radius * np.cos(oscillator.outer * t)
    rest = oscillator.inner * (duration - t)
    low = arcs.swing * np.sin(rest) if oscillator.symmetric else -arcs.swing * np.cos(rest)
    return np.asarray(sign * np.where(t < arcs.above, high, low))


def _checked(peak: ArrayLike) -> Array:
    A = np.asarray(peak, dtype=float)
    bad = A[~(np.isfinite(A) & (A >= 0))]
    if bad.size:
        raise InputError(f"bilinear: peak amplitude {bad.flat[0]} must be finite and not negative")
    return A
