"""What a comparison under a drift hands over: omega0(t) by the action beside the cycle frequency, and their error."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ridgeback.common.show.displayed import Displayed
from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.compare.motion.error_norms import Zones, rms, worst
from ridgeback.compare.motion.results import Case, Curve, Image
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.motion.trajectory import Trajectory
from ridgeback.numeric.orbits.adiabatic import AdiabaticMotion


@dataclass(frozen=True, repr=False)
class DriftComparison(Displayed):
    """omega0(J; p(t)) of an oscillator with drifting parameters, held against its integrated motion.

    Parameters
    ----------
    case : Case
        The oscillator at time 0, its start and its sampling.
    laws : str
        Which parameters drift how.
    trajectory : Trajectory
        The motion, integrated with p(t) in the equation.
    adiabatic : AdiabaticMotion
        Action, amplitude and omega0 at the samples, with the leading error.
    reference : Curve
        The frequency between the located crossings of the integrated motion.
    frozen : ndarray, shape (n,)
        omega0(t) of the oscillator with the parameters of time 0 throughout, rad per time unit.
    interior : Zones
        Start, interior and end of the time.
    disagreement : float
        Largest difference of u between two integrators.
    spectrogram : Image
        The plane of u, with omega0 by the action over it.

    Examples
    --------
    >>> from ridgeback.compare.drift.comparison import compare_drift
    >>> compare_drift("linear", {"k": "1+t/50"}, duration=60.0, rate=4.0)
    <DriftComparison: linear with k = t/50 + 1, omega0 by the action within 9.5e-05, expected 9.5e-05>
    """

    INDEX: ClassVar[tuple[str, ...]] = ("time_s",)

    case: Case
    laws: str
    trajectory: Trajectory
    adiabatic: AdiabaticMotion
    reference: Curve
    frozen: Array
    interior: Zones
    disagreement: float
    spectrogram: Image

    @property
    def error(self) -> Array:
        """omega0 by the action over the cycle frequency, less 1; NaN where no cycles are."""
        return np.asarray(self.adiabatic.omega / self.reference.omega - 1)

    @property
    def rms_error(self) -> float | None:
        """Root mean square of the relative error over the interior."""
        return rms(self._inside(self.error))

    @property
    def max_error(self) -> float | None:
        """Largest relative error over the interior."""
        return worst(self._inside(self.error))

    @property
    def expected_error(self) -> float | None:
        """Largest relative error over the interior that is expected to leading order, of second order in the rates."""
        return worst(self._inside(self.adiabatic.expected_error))

    @property
    def frozen_error(self) -> float | None:
        """Largest relative error over the interior of leaving the drift out."""
        return worst(self._inside(self.frozen / self.reference.omega - 1))

    @property
    def rate(self) -> float:
        """Largest relative change of omega0 in a radian of the motion."""
        return float(np.abs(self.adiabatic.rate).max())

    def _inside(self, values: Array) -> Array:
        return np.where(self.interior.interior(self.trajectory.time), values, np.nan)

    def rows(self) -> list[dict[str, float | None]]:
        """One row per sample: time_s, u, velocity; omega0, amplitude by the action; cycle_omega0 where cycles are."""
        columns = {
            "time_s": self.trajectory.time,
            "u": self.trajectory.u,
            "velocity": self.trajectory.velocity,
            "omega0": self.adiabatic.omega,
            "amplitude": self.adiabatic.peak,
            "cycle_omega0": self.reference.omega,
        }
        lists = {name: [None if np.isnan(x) else x for x in values.tolist()] for name, values in columns.items()}
        return [dict(zip(lists, row, strict=True)) for row in zip(*lists.values(), strict=True)]

    def headline(self) -> str:
        """What drifts, and how far omega0 by the action is from the cycle frequency."""
        error = "" if self.max_error is None else f", omega0 by the action within {self.max_error:.2g}"
        expected = "" if self.expected_error is None else f", expected {self.expected_error:.2g}"
        return f"{self.case.system} with {self.laws}{error}{expected}"

    def picture(self) -> Picture:
        """omega0 over the time, by the action and by cycles."""
        time, omega = self.trajectory.time, self.adiabatic.omega
        seen = np.isfinite(self.reference.omega)
        strokes = (
            Stroke(time, omega, "by the action"),
            Stroke(time[seen], self.reference.omega[seen], "cycle frequency", dashed=True),
        )
        return Picture(f"{self.case.system}, {self.laws}", "time, s", "omega0, rad/s", strokes)
