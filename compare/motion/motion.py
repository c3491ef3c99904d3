"""One integrated motion with all that its comparison needs: reference frequency, amplitudes, known phase.

Everything here is computed once and shared by models, estimates, budget and findings.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from time import process_time

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.common.quantities import symbol
from ridgeback.compare.binding.bind import bind
from ridgeback.compare.motion.error_norms import Zones, zones
from ridgeback.compare.motion.results import Case, Curve
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.motion.cycle_frequency import CycleFrequency, cycle_frequency
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.numeric.motion.taylor import integrate_taylor
from ridgeback.numeric.motion.trajectory import Trajectory, integrate
from ridgeback.numeric.orbits.averaging import AveragedDecay, averaged_decay
from ridgeback.numeric.orbits.energy import amplitude_from_energy, energy_of
from ridgeback.numeric.orbits.period import exact_frequency
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.elliptic import sine_force
from ridgeback.symbolic.systems.oscillator import Oscillator, V

CYCLES = 40.0
SAMPLES_PER_CYCLE = 32.0
"""Defaults of the paper's case: 20 s of 2 Hz (small amplitude), at 64 Hz."""
DIGITS = 18
"""Of the Taylor solution: its own error is then far below that of the integration that it checks."""
SECOND = "RK45"
"""The second integrator of forces with kinks."""
CHECKED = 8
"""The second integration is compared at every eighth sample: its accuracy does not depend on where it is read."""
MIN_CYCLES = 4


@dataclass(frozen=True)
class Setting:
    """What to run: an oscillator with its numbers, the initial state, how long and how finely."""

    oscillator: Oscillator
    initial: tuple[float, float]
    duration: float
    rate: float
    time_unit: str = ""

    @cached_property
    def is_pendulum(self) -> bool:
        """Whether the paper's own formulas (10)-(14) and (21) apply: restoring force k^2 sin(u)."""
        sine = sine_force(self.oscillator.substituted_force.subs(V, 0))
        return sine is not None and bool(sine.rate == 1)

    def case(self) -> Case:
        """Return the description that travels with the results."""
        o = self.oscillator
        return Case(
            system=o.name,
            title=o.title,
            equation=o.equation,
            equation_latex=o.equation_latex,
            symbol=symbol(o.symbol),
            unit=o.unit,
            time_unit=self.time_unit,
            reference=o.reference,
            parameters={name: float(value) for name, value in o.parameters.items() if value is not None},
            initial=self.initial,
            duration=self.duration,
            rate=self.rate,
        )


def setting(
    oscillator: OscillatorLike,
    *,
    initial: tuple[float, float] | None = None,
    duration: float | None = None,
    rate: float | None = None,
    time_unit: str = "",
) -> Setting:
    """What to run, with everything that is not said filled in.

    Parameters
    ----------
    oscillator
        An oscillator, or anything that names one; its parameters have values.
    initial
        State (u, u') at time 0; by default the oscillator's own.
    duration
        Time to integrate over; by default forty natural periods.
    rate
        Samples per time unit; by default 32 in a natural period, or a little more so that the last falls on the end.
    time_unit
        Name of the time unit; ``s`` has frequencies shown in hertz.

    Raises
    ------
    InputError
        For a duration or rate that is not a positive number.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> setting(find("linear")).rate.__round__(3)
    5.093
    """
    oscillator = as_oscillator(oscillator)
    k = float(oscillator.natural_frequency.evalf(30))
    span = CYCLES * 2 * np.pi / k if duration is None else float(duration)
    chosen = Setting(
        oscillator=oscillator,
        initial=oscillator.initial if initial is None else (float(initial[0]), float(initial[1])),
        duration=span,
        rate=_whole_rate(SAMPLES_PER_CYCLE * k / (2 * np.pi), span) if rate is None else float(rate),
        time_unit=time_unit,
    )
    for name, value in (("duration", chosen.duration), ("rate", chosen.rate)):
        if not (np.isfinite(value) and value > 0):
            raise InputError(f"{name} {value:g} is not a positive number; use e.g. {name}=20")
    return chosen


def _whole_rate(rate: float, duration: float) -> float:
    """The next higher rate at which the last sample, and the last that is integrated twice, falls on the end.

    >>> _whole_rate(5.09, 20.0)
    5.2
    """
    if not (np.isfinite(duration) and duration > 0):
        return rate
    return float(CHECKED * np.ceil(rate * duration / CHECKED - 1e-9) / duration)


@dataclass(frozen=True)
class Motion:
    """An integrated motion; arrays are on the samples of ``trajectory`` unless they carry their own times."""

    setting: Setting
    dynamics: Dynamics
    trajectory: Trajectory
    precise: Trajectory
    disagreement: float
    """Largest difference of u between the two integrations over the samples they share."""
    cycle: CycleFrequency
    averaged: AveragedDecay | None
    averaged_seconds: float
    """Processor time that the averaged motion took; not a number where there is none."""
    energy_peak: Array
    """A(t) by eq. (20)-(21), or the envelope of the turning points for a limit cycle."""

    @property
    def time(self) -> Array:
        """Sample times."""
        return self.trajectory.time

    @cached_property
    def zone(self) -> Zones:
        """Start, interior and end."""
        return zones(float(self.time[0]), float(self.time[-1]))

    @property
    def has_backbone(self) -> bool:
        """Whether there is a potential, and with it a frequency for each amplitude."""
        return self.dynamics.restoring is not None

    @cached_property
    def _reference_on_samples(self) -> Array:
        return self.cycle.at(self.time)

    def reference(self, time: Array) -> Array:
        """Return the cycle frequency at any time, NaN outside the span of the located events."""
        if np.array_equal(time, self.time):
            return self._reference_on_samples
        return self.cycle.at(time)

    @cached_property
    def exact_at_energy(self) -> Array:
        """Exact omega0 at A(t) of the energy: closed form, or quadrature where there is none."""
        return exact_omega(self.dynamics, self.energy_peak)

    @cached_property
    def known_omega(self) -> Array:
        """A smooth omega(t) over all samples: the averaged action, or the reference with its ends held."""
        if self.averaged is not None:
            return self.averaged.omega
        omega = self._reference_on_samples
        inside = np.isfinite(omega)
        return np.interp(self.time, self.time[inside], omega[inside])

    @cached_property
    def rising(self) -> Array:
        """Times of the rising zero crossings: one per cycle."""
        crossings = self.trajectory.crossings
        return np.asarray(crossings.time[crossings.rising])

    @cached_property
    def spread(self) -> Array:
        """How far two readings of the motion differ, on the samples."""
        return self.cycle.spread_at(self.time)

    @cached_property
    def interpolation_error(self) -> Array:
        """How well the reading that is taken is interpolated, on the samples."""
        return self.cycle.interpolation_error_at(self.time)

    @cached_property
    def reference_curve(self) -> Curve:
        """The reference on the samples."""
        omega = self._reference_on_samples
        return Curve(
            name="reference",
            label="cycle frequency",
            kind="reference",
            time=self.time,
            omega=omega,
            valid=np.isfinite(omega),
            standard_deviation=self.interpolation_error + self.spread,
            note="From the event-located zero crossings of the integrated solution, curvature within a cycle removed.",
        )


def exact_omega(dynamics: Dynamics, peaks: Array) -> Array:
    """Exact omega0 at peak amplitudes, by closed form or quadrature.

    >>> from ridgeback.numeric.motion.dynamics import linear
    >>> exact_omega(linear(k=2.0), np.array([1.0]))
    array([2.])
    """
    if dynamics.closed_form is not None:
        return np.asarray(dynamics.closed_form(peaks))
    return np.asarray(exact_frequency(dynamics, peaks).omega)


def integrate_motion(chosen: Setting, *, digits: int | None = DIGITS) -> Motion:
    """Integrate by DOP853 and by Taylor series, and compute what a comparison along the motion shares.

    A force with kinks has no Taylor series there; its second integration is by RK45, from switch to switch likewise.

    Parameters
    ----------
    chosen
        What to integrate.
    digits
        Decimal digits of the Taylor solution, which the other is checked against; None leaves it out, and what the two
        differ by is then not a number.

    Raises
    ------
    InputError
        Where the motion leaves the well, is overdamped, has too few cycles to compare anything, or is sampled too
        coarsely.
    """
    dynamics = bind(chosen.oscillator)
    _check_underdamped(dynamics)
    duration, rate = chosen.duration, chosen.rate
    trajectory = integrate(dynamics, chosen.initial, duration=duration, rate=rate)
    _check_cycles(chosen, trajectory)
    precise = trajectory
    if digits is not None and dynamics.switches is not None:
        precise = integrate(dynamics, chosen.initial, duration=duration, rate=rate / CHECKED, method=SECOND)
    elif digits is not None:
        precise = integrate_taylor(
            dynamics, chosen.initial, duration=duration, rate=rate / CHECKED, digits=digits, events=False
        )
    averaged, began = None, process_time()
    if dynamics.restoring is not None:
        averaged = averaged_decay(dynamics, chosen.initial, trajectory.time)
    averaged_seconds = math.nan if averaged is None else process_time() - began
    return Motion(
        setting=chosen,
        dynamics=dynamics,
        trajectory=trajectory,
        precise=precise,
        disagreement=math.nan if digits is None else _disagreement(trajectory, precise),
        cycle=cycle_frequency(trajectory, dynamics=dynamics),
        averaged=averaged,
        averaged_seconds=averaged_seconds,
        energy_peak=_energy_peak(dynamics, trajectory),
    )


def _disagreement(trajectory: Trajectory, precise: Trajectory) -> float:
    shared = trajectory.u[::CHECKED][: precise.u.size]
    return float(np.max(np.abs(shared - precise.u[: shared.size])))


def _check_underdamped(dynamics: Dynamics) -> None:
    if dynamics.damping >= dynamics.natural_frequency:
        raise InputError(
            f"{dynamics.name}: mu = {dynamics.damping:.6g} is not below k = {dynamics.natural_frequency:.6g}, so the "
            "motion is overdamped and does not oscillate; use less damping"
        )


def _check_cycles(chosen: Setting, trajectory: Trajectory) -> None:
    rising = int(np.count_nonzero(trajectory.crossings.rising))
    if rising <= MIN_CYCLES:
        raise InputError(
            f"{chosen.oscillator.name}: {rising} zero crossings in a duration of {chosen.duration:g} leave fewer than "
            f"{MIN_CYCLES} whole cycles; use a longer duration"
        )
    fastest = 1 / float(np.diff(trajectory.crossings.time[trajectory.crossings.rising]).min())
    if chosen.rate <= 2 * fastest:
        raise InputError(
            f"rate {chosen.rate:g} aliases the fundamental, which reaches {fastest:.4g} cycles per time unit; "
            f"use a rate above {2 * fastest:.4g}, or {SAMPLES_PER_CYCLE * fastest:.3g} to see its harmonics"
        )


def _energy_peak(dynamics: Dynamics, trajectory: Trajectory) -> Array:
    if dynamics.restoring is not None:
        return amplitude_from_energy(dynamics, energy_of(dynamics, trajectory.u, trajectory.velocity)).peak
    turnings = trajectory.turnings
    return np.interp(trajectory.time, turnings.time, np.abs(turnings.value))
