"""A named oscillator's backbone over a measured one: how far apart they are, and whether the measurement can tell."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

import numpy as np
from scipy.special import chdtrc

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
LEAST = 0.01
"""Per cent of records below which their share is not told."""
MANY = 100.0
"""Standard deviations beyond which their number says no more."""
APART = 0.05
"""Chance below which two backbones are said to differ."""
LOSSES = 0.5
"""Of (a'/a)^2 / omega0, by which linear damping lowers the frequency of a linear oscillator; other losses may not."""
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

    Losses change the frequency of a decay in second order, by -1.5 to +1 times (a'/a)^2 / omega0 as they go with the
    velocity: half of it is taken off, as for linear damping, and as much counts as a deviation.  The distance is
    counted in deviations point by point, root mean square, about 1 for the oscillator that made the recording; the
    points share noise, and so n times its square is as chi-square of as many degrees as n independent ones are.
    """

    title: str
    equation: str
    amplitude: Array
    """Fundamental amplitudes, those of the measured backbone, shape (n,)."""
    omega: Array
    """phi' with the measured a'/a, rad per time unit; NaN where the theory does not oscillate."""
    mean: float
    """Mean of measured / theory - 1."""
    rms: float
    deviations: float
    """Rms of measured less theory in standard deviations of each point; NaN where none are known."""
    chance: float
    """How often noise alone would take the theory's own recording so far from it, or farther."""
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
        return Agreement.DIFFERS if self.chance < APART else Agreement.AGREES

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
                f"Against {self.title} the measured backbone lies {size}; that is {many} of its standard deviations, "
                f"and noise alone takes it so far in {self._often()}: they differ{degrees}."
            )
        if self.agreement is Agreement.UNTOLD:
            return f"Against {self.title} the measured backbone, whose uncertainty is not known, lies {size}{degrees}."
        return (
            f"Against {self.title} the measured backbone lies {size}, {number(self.deviations, 2)} of its standard "
            f"deviations; noise alone takes it so far in {self._often()}: they agree."
        )

    def _often(self) -> str:
        """The chance in words."""
        share = 100.0 * self.chance
        return "next to no records" if share < LEAST else f"{number(share, 1 if share < 10.0 else 2)} % of records"


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
    found = over_curve(oscillator, curve_of(measured, deviation))
    return replace(found, degrees=found.agreement is not Agreement.AGREES and in_degrees(oscillator, measured, found))


def in_degrees(oscillator: Oscillator, measured: Backbone, found: TheoryBackbone) -> bool:
    """Whether a pendulum's theory would come NEARER times nearer, or oscillate at all, for amplitudes in degrees."""
    if "sin(" not in oscillator.equation or measured.units in ("rad", "radians"):
        return False
    turned = over_curve(oscillator, replace(curve_of(measured), amplitude=np.radians(found.amplitude)))
    return turned.covered > 0.0 and (not found.covered or NEARER * turned.rms < found.rms)


@dataclass(frozen=True)
class MeasuredCurve:
    """Fundamental amplitudes, frequencies with their deviations and a'/a, each of shape (n,)."""

    amplitude: Array
    omega: Array
    omega_sd: Array
    growth: Array
    independent: float = 1.0
    """How many independent values the errors of ``omega`` are as good as."""


def curve_of(measured: Backbone, omega_sd: Array | None = None) -> MeasuredCurve:
    """That of a backbone, with other deviations if they are given."""
    known = measured.curve_omega_sd if omega_sd is None else omega_sd
    independent = measured.independent if measured.independent >= 1.0 else 1.0
    growth = measured.curve_growth_rate
    return MeasuredCurve(measured.curve_amplitude, measured.curve_omega, known, growth, independent)


def over_curve(oscillator: Oscillator, curve: MeasuredCurve) -> TheoryBackbone:
    """The same over a curve."""
    amplitude, nothing = curve.amplitude, float("nan")
    exact, inside = exact_at(oscillator, amplitude)
    lost = LOSSES * curve.growth**2 / exact
    expected = np.where(inside, exact - lost, np.nan)
    if not inside.any():
        return TheoryBackbone(oscillator.title, oscillator.equation, amplitude, expected, *(nothing,) * 4, 0.0)
    error = curve.omega[inside] / expected[inside] - 1
    with np.errstate(divide="ignore", invalid="ignore"):
        apart = (curve.omega - expected)[inside] / np.hypot(curve.omega_sd, lost)[inside]
    square = float(np.mean(apart**2))
    return TheoryBackbone(
        title=oscillator.title,
        equation=oscillator.equation,
        amplitude=amplitude,
        omega=expected,
        mean=float(np.mean(error)),
        rms=float(np.sqrt(np.mean(error**2))),
        deviations=float(np.sqrt(square)),
        chance=float(chdtrc(curve.independent, curve.independent * square)),
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
