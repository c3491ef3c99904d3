"""A named oscillator's backbone over a measured one: how far apart they are, and whether the measurement can tell."""

from __future__ import annotations

from dataclasses import dataclass
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

    The points of a measured backbone share noise, so the deviation of their mean is taken as the median one of a
    point, not divided by the root of their number.
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
    """Size of the mean in standard deviations of a point; NaN where none are known."""
    covered: float
    """Share of the points at which the theory oscillates."""

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
        if self.agreement is Agreement.UNCOVERED:
            low, high = (f"{end(self.amplitude):.3g}" for end in (np.min, np.max))
            degrees = "; an angle in degrees needs --unit deg" if "sin(" in self.equation else ""
            return f"{self.title} oscillates at none of the measured amplitudes, {low} to {high}{degrees}."
        part = "" if self.covered == 1 else f" over the {100 * self.covered:.0f} % of it at which that oscillates"
        size = f"{offset(self.mean)} on average ({per_cent(self.rms)} rms){part}"
        if self.agreement is Agreement.DIFFERS:
            many = number(self.deviations, 2) if self.deviations < MANY else f"over {MANY:g}"
            return f"The measured backbone lies {size} against {self.title}, {many} of its deviations: they differ."
        if self.agreement is Agreement.UNTOLD:
            return f"The measured backbone, whose uncertainty is not known, lies {size} against {self.title}."
        return f"The measured backbone lies {size} against {self.title}, within {APART:g} of its standard deviations."


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
    return over_curve(oscillator, measured.curve_amplitude, measured.curve_omega, deviation)


def over_curve(oscillator: Oscillator, amplitude: Array, omega: Array, omega_sd: Array) -> TheoryBackbone:
    """The same over a curve of fundamental amplitudes, frequencies and their deviations, each of shape (n,)."""
    expected, inside = exact_at(oscillator, amplitude)
    expected = np.where(inside, expected, np.nan)
    if not inside.any():
        return TheoryBackbone(oscillator.title, oscillator.equation, amplitude, expected, *(float("nan"),) * 3, 0.0)
    error = omega[inside] / expected[inside] - 1
    spread = float(np.median(omega_sd[inside] / omega[inside]))
    mean = float(np.mean(error))
    return TheoryBackbone(
        title=oscillator.title,
        equation=oscillator.equation,
        amplitude=amplitude,
        omega=expected,
        mean=mean,
        rms=float(np.sqrt(np.mean(error**2))),
        deviations=abs(mean) / spread if spread != 0 else float("inf"),
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
