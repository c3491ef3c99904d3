"""One motion of a study: integrated once in a process, with its reference frequency and growth rate."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from ridgeback.compare.motion.motion import Motion, integrate_motion, setting
from ridgeback.compare.studies.systems import System
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.orbits.waveform import orbit_harmonics

KEPT = 4
"""Motions that a process keeps: blocks of one case come after one another."""
LEAST_GROWTH = 1e-12
"""Growth rate, relative to the frequency, below which nothing decays and a relative error means nothing."""


@dataclass(frozen=True)
class Curve:
    """omega0 on the samples, NaN where there is none; ``amplitude`` is the fundamental one, where it is known."""

    omega: Array
    amplitude: Array | None = None
    exact: Array | None = None
    """The exact frequency at the amplitude that a prediction was made at, with mu^2 where the prediction has it."""


@dataclass(frozen=True)
class Case:
    """A motion with what errors are taken against; made by :meth:`of`."""

    system: System
    motion: Motion

    @staticmethod
    def of(system: System, amplitude: float, duration: float, rate: float) -> Case:
        """The motion from rest at an amplitude.  Raises InputError as ``integrate_motion`` does."""
        return _integrated(system, amplitude, duration, rate)

    @property
    def samples(self) -> Array:
        """u on the samples."""
        return self.motion.trajectory.u

    @property
    def time(self) -> Array:
        """Times of the samples."""
        return self.motion.time

    @cached_property
    def reference(self) -> Array:
        """Cycle frequency on the samples, NaN at the ends."""
        return self.motion.reference(self.time)

    @cached_property
    def inside(self) -> Mask:
        """Samples at which errors are taken."""
        return self.motion.zone.interior(self.time) & np.isfinite(self.reference)

    # a'/a over a cycle = ln(a_{j+1} / a_j) / (t_{j+1} - t_j), a_j the first harmonic of the orbit with the energy there
    @cached_property
    def growth(self) -> tuple[Array, Array] | None:
        """Times of the rising zero crossings and the growth rate between them; None without a potential."""
        motion = self.motion
        if not motion.has_backbone or motion.rising.size < 3:
            return None
        peaks = np.interp(motion.rising, motion.time, motion.energy_peak)
        fundamental = orbit_harmonics(motion.dynamics, peaks, count=1).cosine[1]
        return motion.rising, np.diff(np.log(fundamental)) / np.diff(motion.rising)


@lru_cache(maxsize=KEPT)
def _integrated(system: System, amplitude: float, duration: float, rate: float) -> Case:
    chosen = setting(system.oscillator(), initial=(amplitude, 0.0), duration=duration, rate=rate)
    return Case(system, integrate_motion(chosen, digits=None))


def reference_floor(case: Case) -> float:
    """How far two readings of the motion differ, relative rms over the interior: below it omega0(t) is not defined."""
    time = case.time[case.inside]
    spread = np.hypot(case.motion.cycle.spread_at(time), case.motion.cycle.interpolation_error_at(time))
    return float(np.sqrt(np.nanmean((spread / case.reference[case.inside]) ** 2)))


def budget(case: Case, curve: Curve) -> tuple[float | None, float | None, float | None]:
    """Rms over the interior of truncation, averaging, and of what the two leave of the whole error.

    With e the prediction's error, t that against the exact frequency at its own amplitude, and v that frequency's own
    error, 1 + e = (1 + t) (1 + v): what is left is t v.
    """
    if curve.exact is None:
        return None, None, None
    truncation = curve.omega[case.inside] / curve.exact[case.inside] - 1.0
    averaging = curve.exact[case.inside] / case.reference[case.inside] - 1.0
    rest = curve.omega[case.inside] / case.reference[case.inside] - 1.0 - truncation - averaging
    first, second, third = (float(np.sqrt(np.nanmean(part**2))) for part in (truncation, averaging, rest))
    return first, second, third


def growth_error(case: Case, curve: Curve) -> float | None:
    """Relative rms error of the growth rate over the cycles of the interior; None where either is not known."""
    found = case.growth
    if curve.amplitude is None or found is None:
        return None
    edges, growth = found
    middle = 0.5 * (edges[1:] + edges[:-1])
    omega = np.interp(middle, case.time[case.inside], case.reference[case.inside])
    keep = case.motion.zone.interior(middle) & (np.abs(growth) > LEAST_GROWTH * omega)
    if not keep.any():
        return None
    logarithm = np.interp(edges, case.time[: curve.amplitude.size], np.log(curve.amplitude))
    error = (np.diff(logarithm) / np.diff(edges))[keep] / growth[keep] - 1.0
    return float(np.sqrt(np.mean(error**2)))
