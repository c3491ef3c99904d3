"""What a growth rate says about damping, in the words of vibration and optomechanics, each with its deviation.

With g = a'/a and the measured frequency omega,

    damping ratio zeta = -g / omega,      Q = 1 / (2 zeta),      logarithmic decrement = -2 pi g / omega = 2 pi zeta.

zeta is referred to the frequency at which the motion is seen; that referred to the undamped frequency is
zeta_0 = zeta / sqrt(1 + zeta^2), and the decrement then 2 pi zeta_0 / sqrt(1 - zeta_0^2): the same number.
(Inman, Engineering Vibration, 4th ed. 2014, section 1.6.)
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ridgeback.numeric.arrays import Array, freeze
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.tracking.track import NORMAL_95

SEEN = 2.0
"""Deviations of a damping ratio from 0, from which on it has a Q."""


@dataclass(frozen=True)
class Damping:
    """The damping ratio with its standard deviation, and what follows from it; negative where the motion grows.

    Parameters
    ----------
    ratio, ratio_sd : array of float, shape (M,)
        zeta and its standard deviation.

    Examples
    --------
    >>> found = damping(np.array([-0.5]), np.array([0.05]), np.array([10.0]), np.array([0.0]))
    >>> float(found.ratio[0]), float(found.ratio_sd[0]), float(found.quality[0]), round(float(found.decrement[0]), 4)
    (0.05, 0.005, 10.0, 0.3142)
    """

    ratio: Array
    ratio_sd: Array

    def __post_init__(self) -> None:
        freeze(self)

    @property
    def quality(self) -> Array:
        """Q = 1 / (2 zeta)."""
        return np.asarray(0.5 / np.where(self.ratio == 0.0, np.nan, self.ratio))

    @property
    def quality_sd(self) -> Array:
        """Its standard deviation, to first order."""
        return np.asarray(np.abs(self.quality * self.ratio_sd / np.where(self.ratio == 0.0, np.nan, self.ratio)))

    @property
    def decrement(self) -> Array:
        """Logarithm of the ratio of two amplitudes a cycle apart."""
        return TWO_PI * self.ratio

    @property
    def decrement_sd(self) -> Array:
        """Its standard deviation."""
        return TWO_PI * self.ratio_sd


def damping(growth_rate: Array, growth_rate_sd: Array, omega: Array, omega_sd: Array) -> Damping:
    """The damping of growth rates with their frequencies, whose errors count as independent."""
    ratio = -growth_rate / omega
    return Damping(ratio, np.hypot(growth_rate_sd, ratio * omega_sd) / omega)


def growth_columns(growth_rate: Array, growth_rate_sd: Array, omega: Array, omega_sd: Array) -> dict[str, Array]:
    """Columns of a growth rate: its deviation and 95 % interval, and the damping ratio with its own.

    >>> one = np.ones(1)
    >>> [round(float(column[0]), 3) for column in growth_columns(-one, 0.1 * one, 10 * one, 0 * one).values()]
    [-1.0, 0.1, -1.196, -0.804, 0.1, 0.01]
    """
    found = damping(growth_rate, growth_rate_sd, omega, omega_sd)
    return {
        "growth_rate_per_s": growth_rate,
        "growth_rate_standard_deviation_per_s": growth_rate_sd,
        "growth_rate_low_95_per_s": growth_rate - NORMAL_95 * growth_rate_sd,
        "growth_rate_high_95_per_s": growth_rate + NORMAL_95 * growth_rate_sd,
        "damping_ratio": found.ratio,
        "damping_ratio_standard_deviation": found.ratio_sd,
    }


def damping_sentence(amplitude: Array, growth_rate: Array, growth_rate_sd: Array, omega: Array, omega_sd: Array) -> str:
    """Damping ratio, Q and logarithmic decrement at the largest and the smallest amplitude, with one sigma.

    >>> a, one = np.array([1.0, 2.0]), np.ones(2)
    >>> print(damping_sentence(a, -one, 0.1 * one, 10 * one, 0 * one))
    Damping (one sigma): at amplitude 2 ratio 0.100 +- 0.010, Q 5.00 +- 0.50, logarithmic decrement 0.628 +- 0.063; \
at amplitude 1 ratio 0.100 +- 0.010, Q 5.00 +- 0.50, logarithmic decrement 0.628 +- 0.063.
    """
    found = damping(growth_rate, growth_rate_sd, omega, omega_sd)
    ends = (int(np.argmax(amplitude)), int(np.argmin(amplitude)))

    def at(i: int) -> str:
        quality = f"Q {with_deviation(found.quality[i], found.quality_sd[i])}"
        if abs(found.ratio[i]) < SEEN * found.ratio_sd[i]:
            quality = "not told from none (no Q)"
        return (
            f"at amplitude {amplitude[i]:.4g} ratio {with_deviation(found.ratio[i], found.ratio_sd[i])}, {quality}, "
            f"logarithmic decrement {with_deviation(found.decrement[i], found.decrement_sd[i])}"
        )

    return f"Damping (one sigma): {'; '.join(at(i) for i in dict.fromkeys(ends))}."


def with_deviation(value: float, deviation: float) -> str:
    """A value to the second digit of its deviation.

    >>> with_deviation(3.14159, 0.0123), with_deviation(1234.5, 67.0), with_deviation(1.0, 0.0)
    ('3.142 +- 0.012', '1234 +- 67', '1 +- 0')
    """
    if not (np.isfinite(deviation) and deviation > 0.0):
        return f"{value:.6g} +- {deviation:.2g}"
    digits = max(0, 1 - int(np.floor(np.log10(deviation))))
    return f"{round(value, digits):.{digits}f} +- {round(deviation, digits):.{digits}f}"
