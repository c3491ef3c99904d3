"""What a noise study measures errors against: a noise-free record whose omega(t) is known.

Either the paper's case, integrated, with the cycle frequency of the solution; or the smooth harmonic model of a
recording, which is then the truth by definition: its noise is replaced by noise of known size.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol, runtime_checkable

import numpy as np
from scipy.interpolate import make_interp_spline, make_lsq_spline

from ridgeback.common.errors import InputError
from ridgeback.compare.binding.bind import bind
from ridgeback.compare.motion.error_norms import Zones, zones
from ridgeback.compare.motion.motion import Motion
from ridgeback.compare.motion.paper_case import DURATION, paper_case
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.harmonics.cramer_rao import Order, local_bound
from ridgeback.numeric.harmonics.harmonic_signal import HarmonicSignal, decompose, uniform_knots
from ridgeback.numeric.harmonics.local_fit import choose_multiples
from ridgeback.numeric.motion.cycle_frequency import CycleFrequency, cycle_frequency
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.numeric.motion.trajectory import Trajectory, integrate
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.signal.windows import half_width
from ridgeback.numeric.tracking.request import LAG_CYCLES
from ridgeback.symbolic.systems.oscillator import Oscillator

SMOOTH = "harmonic-least-squares"
"""The estimator whose track makes the smooth model of a recording."""
PAPER_RATE = 32.0
"""Samples per second of the paper's case in noise: enough for the harmonics that the bound counts."""
KNOT_WINDOWS = 1.0
"""Knots of a recording's smooth model, in windows of four cycles: what is rougher counts as its noise."""
STRAIGHT = 2
"""Degree of the phase whose bound a method without a phase polynomial is held against: the peak over a window is the
estimate of a frequency that is straight in it."""
EVERY = 4
"""The bound changes slowly from sample to sample: it is computed at every fourth."""


@dataclass(frozen=True)
class Truth:
    """Noise-free samples ``x``, the true ``omega`` at them, and their harmonics for the bound."""

    title: str
    what: str
    x: Array
    omega: Array
    signal: HarmonicSignal
    lag_seconds: float
    """A window of four cycles; the bound is taken in it where a method has none of its own."""
    oscillator: Oscillator | None = None
    """What the method model-fit fits, its parameters ``free`` to be found."""
    free: tuple[str, ...] = ()

    @property
    def rate(self) -> float:
        """Samples per time unit."""
        return self.signal.rate

    @property
    def start(self) -> float:
        """Time of the first sample."""
        return self.signal.start

    @cached_property
    def zone(self) -> Zones:
        """The interior, 10 % .. 90 % of the record."""
        return zones(self.start, self.start + (self.x.size - 1) / self.rate)

    def omega_at(self, time: Array) -> Array:
        """The true frequency at any times within the record."""
        return np.asarray(make_interp_spline(self.signal.time, self.omega, k=3)(time))

    def noise(self, snr_db: float) -> float:
        """Standard deviation of the noise: SNR = variance of the noise-free samples over that of the noise."""
        return float(np.std(self.x) * 10 ** (-snr_db / 20))

    def half(self, lag_seconds: float | None = None) -> int:
        """Half a window in samples."""
        return half_width(lag_seconds or self.lag_seconds, self.rate, longest=self.x.size)

    def relative_bound(self, half: int, degree: int = STRAIGHT, *, noise: float) -> float:
        """Bound on the relative rms error over the interior, local harmonic model in windows of 2 half + 1 samples."""
        inside = np.flatnonzero(self.zone.interior(self.signal.time))[::EVERY]
        order = Order(self.signal.multiples[1:], phase_degree=degree)
        bound = local_bound(self.signal, noise, half=half, order=order, centres=inside)
        return float(np.sqrt(np.mean((bound / self.omega[inside]) ** 2)))

    @property
    def bound(self) -> str:
        """What the bound is of."""
        order = Order(self.signal.multiples[1:], phase_degree=STRAIGHT)
        others = ", ".join(map(str, order.multiples)) or "none"
        return (
            "local harmonic model: phase of the method's own degree, "
            f"{order.phase_degree} where it has none, amplitudes of degree {order.amplitude_degree}, harmonics beside "
            f"the fundamental: {others}, in the window of the method ({self.lag_seconds:.4g} time units where it has "
            "none); a model of the whole record has its own: the Fisher matrix of the fit"
        )


@runtime_checkable
class Sampled(Protocol):
    """A recording: samples at times, at a rate, of a file and with a name."""

    @property
    def time(self) -> Array:
        """Times of the samples."""
        ...

    @property
    def values(self) -> Array:
        """The samples."""
        ...

    @property
    def rate(self) -> float:
        """Samples per time unit."""
        ...

    @property
    def source(self) -> str:
        """The file."""
        ...

    @property
    def name(self) -> str:
        """The signal in it."""
        ...


def paper_truth(*, rate: float = PAPER_RATE, duration: float = DURATION) -> Truth:
    """The paper's damped pendulum from 0.95 pi at rest.

    >>> truth = paper_truth(duration=6.0)
    >>> truth.x.size, truth.signal.multiples[:2]
    (193, (1, 3))
    """
    case = paper_case(duration=duration, rate=rate)
    title = "the paper's damped pendulum"
    return oscillator_truth(case.oscillator, case.initial, duration=duration, rate=rate, title=title)


def oscillator_truth(
    oscillator: Oscillator, initial: tuple[float, float], *, duration: float, rate: float, title: str = ""
) -> Truth:
    """An oscillator integrated; its true frequency is the cycle frequency of the solution."""
    truth = dynamics_truth(bind(oscillator), initial, duration=duration, rate=rate, title=title or oscillator.title)
    return replace(truth, oscillator=oscillator, free=tuple(oscillator.parameters))


def motion_truth(motion: Motion) -> Truth:
    """The same for a motion that is integrated already."""
    oscillator = motion.setting.oscillator
    truth = _integrated_truth(motion.trajectory, motion.cycle, oscillator.title, oscillator.name)
    return replace(truth, oscillator=oscillator, free=tuple(oscillator.parameters))


def dynamics_truth(
    dynamics: Dynamics, initial: tuple[float, float], *, duration: float, rate: float, title: str = ""
) -> Truth:
    """The same for an oscillator already bound to numbers.

    Raises InputError where the record does not hold enough cycles, or too few samples per cycle for an estimate.
    """
    run = integrate(dynamics, initial, duration=duration, rate=rate)
    return _integrated_truth(run, cycle_frequency(run, dynamics=dynamics), title or dynamics.name, dynamics.name)


def _integrated_truth(run: Trajectory, cycle: CycleFrequency, title: str, name: str) -> Truth:
    omega = cycle.at(run.time)
    known = np.isfinite(omega)
    if not known.any():
        raise InputError(f"{name}: the record holds no whole cycle; use a longer duration")
    omega = np.interp(run.time, run.time[known], omega[known])
    return _with_harmonics(
        title,
        "cycle frequency of the integrated solution, from its located zero crossings",
        run.u,
        omega,
        run.rate,
        0.0,
        own=False,
    )


def recording_truth(x: Array, rate: float, *, start: float = 0.0, title: str = "the recording") -> Truth:
    """The smooth harmonic model of a recording: harmonic least squares, its residual left out.

    It is of the stretch in which the motion stands above the noise, less the tones that are found beside it.

    Parameters
    ----------
    x
        Samples, shape (n,).
    rate
        Samples per time unit.
    start
        Time of the first sample.
    title
        What the recording is called in a table.

    Raises
    ------
    InputError
        For what harmonic least squares refuses, and where noise alone explains the samples.
    """
    track = estimate(x, rate, method=SMOOTH, start=start, bias=False).of_oscillation()
    start, first = float(track.time[0]), round((float(track.time[0]) - start) * rate)
    x, omega = np.asarray(x, dtype=np.float64)[first : first + track.time.size], track.omega
    x = x - sum(tone.samples(track.time - start) for tone in track.used.tones)
    what = "frequency of the recording's own smooth harmonic model, whose residual is replaced by white noise"
    smooth = smoothed(omega, rate, KNOT_WINDOWS * LAG_CYCLES * TWO_PI / float(np.median(omega)))
    return _with_harmonics(title, what, x, smooth, rate, start, own=True)


def smoothed(omega: Array, rate: float, spacing: float) -> Array:
    """Least-squares cubic spline through a track, with knots ``spacing`` apart.

    >>> smoothed(np.array([1.0, 2.0, 3.0, 4.0, 5.0]), 1.0, 10.0).round(9).tolist()
    [1.0, 2.0, 3.0, 4.0, 5.0]
    """
    time = np.arange(omega.size) / rate
    return np.asarray(make_lsq_spline(time, omega, uniform_knots(float(time[-1]), spacing), k=3)(time))


def _with_harmonics(title: str, what: str, x: Array, omega: Array, rate: float, start: float, *, own: bool) -> Truth:
    """Find the harmonics; ``own`` says that the model itself, not ``x``, is the truth."""
    lag = min(LAG_CYCLES * TWO_PI / float(np.median(omega)), 0.999 * (x.size - 1) / rate)
    half = half_width(lag, rate, longest=x.size)
    multiples = (1, *choose_multiples(x - x.mean(), rate, omega, half=half))
    if own:
        signal = decompose(x, omega, rate, multiples=multiples, start=start, spacing=KNOT_WINDOWS * lag)
        return Truth(title, what, signal.values(), signal.omega, signal, lag)
    signal = decompose(x, omega, rate, multiples=multiples, start=start)
    return Truth(title, what, x, omega, signal, lag)
