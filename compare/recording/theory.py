"""A named oscillator's backbone over a measured one: how far apart they are, and whether the measurement can tell."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

import numpy as np

from ridgeback.common.numbers import number, offset, per_cent
from ridgeback.compare.binding.bind import bind
from ridgeback.compare.motion.results import Curve
from ridgeback.numeric.arrays import Array, Mask, freeze
from ridgeback.numeric.backbone.backbone import Backbone
from ridgeback.numeric.orbits.period import exact_frequency
from ridgeback.numeric.orbits.potential import peak_limit
from ridgeback.numeric.orbits.waveform import orbit_harmonics
from ridgeback.symbolic.systems.oscillator import Oscillator

POINTS = 200
"""Orbits between which omega0 is interpolated."""
MANY = 100.0
"""Standard deviations beyond which their number says no more."""
APART = 2.0
"""Standard deviations from which on two backbones are said to differ."""
NEARER = 5.0
"""How many times nearer a pendulum comes for which amplitudes are taken for degrees, where that is said."""


class Agreement(Enum):
    """Whether a measured backbone and a theory's can be told apart."""

    AGREES = "agrees"
    DIFFERS = "differs"
    UNTOLD = "untold"
    """No deviation of the measured one is known."""
    UNCOVERED = "uncovered"
    """The theory oscillates at none of the measured amplitudes."""


@dataclass(frozen=True)
class TheoryBackbone:
    """The exact backbone of a named oscillator at the amplitudes of a measured one.

    The points of a measured backbone share noise, so their number does not make a distance more significant: it is
    counted in deviations point by point, root mean square, about 1 for the oscillator that made the recording.
    """

    title: str
    equation: str
    amplitude: Array
    """Fundamental amplitudes, those of the measured backbone, shape (n,)."""
    omega: Array
    """rad per time unit; NaN where the theory does not oscillate."""
    mean: float
    """Mean of measured / theory - 1."""
    rms: float
    deviations: float
    """Rms of measured less theory in standard deviations of each point; NaN where none are known."""
    covered: float
    """Share of the points at which the theory oscillates."""
    degrees: bool = False
    """Whether the theory is of an angle, and the amplitudes seem to be in degrees."""

    def __post_init__(self) -> None:
        freeze(self)

    @property
    def agreement(self) -> Agreement:
        """The judgement."""
        if not self.covered:
            return Agreement.UNCOVERED
        if np.isnan(self.deviations):
            return Agreement.UNTOLD
        return Agreement.DIFFERS if self.deviations > APART else Agreement.AGREES

    def sentence(self) -> str:
        """The judgement in words."""
        degrees = "; an angle in degrees needs --unit deg" if self.degrees else ""
        if self.agreement is Agreement.UNCOVERED:
            low, high = (f"{end(self.amplitude):.3g}" for end in (np.min, np.max))
            return f"{self.title} oscillates at none of the measured amplitudes, {low} to {high}{degrees}."
        part = "" if self.covered == 1 else f", over the {100 * self.covered:.0f} % of it where that oscillates"
        size = f"{offset(self.mean)} on average ({per_cent(self.rms)} rms){part}"
        if self.agreement is Agreement.DIFFERS:
            many = number(self.deviations, 2) if self.deviations < MANY else f"over {MANY:g}"
            return (
                f"Against {self.title} the measured backbone lies {size}; that is {many} of its standard deviations: "
                f"they differ{degrees}."
            )
        if self.agreement is Agreement.UNTOLD:
            return f"Against {self.title} the measured backbone, whose uncertainty is not known, lies {size}{degrees}."
        return (
            f"Against {self.title} the measured backbone lies {size}, within {APART:g} of its standard deviations: "
            "they agree."
        )


def over_measured(oscillator: Oscillator, measured: Backbone, *, known: bool = True) -> TheoryBackbone:
    """Hold the exact backbone of an oscillator against a measured one.

    The exact frequency belongs to the peak amplitude; the first harmonic of the same orbit gives the fundamental one.

    Parameters
    ----------
    oscillator
        Its parameters in the recording's units.
    measured
        The backbone of the recording.
    known
        Whether its deviations can be trusted.
    """
    deviation = measured.curve_omega_sd if known else np.full_like(measured.curve_omega_sd, np.nan)
    found = over_curve(oscillator, measured.curve_amplitude, measured.curve_omega, deviation)
    return replace(found, degrees=found.agreement is not Agreement.AGREES and in_degrees(oscillator, measured, found))


def in_degrees(oscillator: Oscillator, measured: Backbone, found: TheoryBackbone) -> bool:
    """Whether a pendulum's theory would come NEARER times nearer, or oscillate at all, for amplitudes in degrees."""
    if "sin(" not in oscillator.equation or measured.units in ("rad", "radians"):
        return False
    turned = over_curve(oscillator, np.radians(found.amplitude), measured.curve_omega, measured.curve_omega_sd)
    return turned.covered > 0.0 and (not found.covered or NEARER * turned.rms < found.rms)


def over_curve(oscillator: Oscillator, amplitude: Array, omega: Array, omega_sd: Array) -> TheoryBackbone:
    """The same over a curve of fundamental amplitudes, frequencies and their deviations, each of shape (n,)."""
    expected, inside = exact_at(oscillator, amplitude)
    expected = np.where(inside, expected, np.nan)
    if not inside.any():
        return TheoryBackbone(oscillator.title, oscillator.equation, amplitude, expected, *(float("nan"),) * 3, 0.0)
    error = omega[inside] / expected[inside] - 1
    with np.errstate(divide="ignore", invalid="ignore"):
        apart = np.abs(omega[inside] - expected[inside]) / omega_sd[inside]
    return TheoryBackbone(
        title=oscillator.title,
        equation=oscillator.equation,
        amplitude=amplitude,
        omega=expected,
        mean=float(np.mean(error)),
        rms=float(np.sqrt(np.mean(error**2))),
        deviations=float(np.sqrt(np.mean(apart**2))),
        covered=float(np.mean(inside)),
    )


def exact_at(oscillator: Oscillator, amplitude: Array) -> tuple[Array, Mask]:
    """Exact omega0 at fundamental amplitudes, and where the oscillator has such an orbit."""
    dynamics = bind(oscillator)
    limit = peak_limit(dynamics)
    most = 0.999 * limit if np.isfinite(limit) else 2.0 * float(amplitude.max())
    peaks = np.linspace(most / POINTS, most, POINTS)
    fundamental = np.abs(orbit_harmonics(dynamics, peaks, count=1).cosine[1])
    omega = np.interp(amplitude, fundamental, exact_frequency(dynamics, peaks).omega)
    return omega, np.asarray(amplitude <= fundamental[-1])


def theory_curve(oscillator: Oscillator, measured: Backbone) -> Curve:
    """Exact omega0 at the measured fundamental amplitude, along the recording's time.

    Parameters
    ----------
    oscillator
        Its parameters in the recording's units.
    measured
        The backbone of the recording: amplitudes in its unit at times in s.
    """
    omega, inside = exact_at(oscillator, measured.amplitude)
    return Curve(
        name=oscillator.name,
        label=f"{oscillator.title}, exact backbone",
        kind="model",
        time=measured.time,
        omega=omega,
        valid=inside,
        note="At the measured fundamental amplitude, parameters as given.",
    )
