"""One backbone out of several: of the runs of an experiment, the stretches of a recording, equal sensors.

At each amplitude of a common grid the curves that reach it are averaged with weights 1 / (s_i^2 + tau^2), s_i their own
standard deviations and tau that between them, estimated by the method of moments (DerSimonian and Laird, Controlled
Clinical Trials 7 (1986) 177): with w_i = 1 / s_i^2 and Q = sum w_i (y_i - y)^2 over k curves,

    tau^2 = max(0, (Q - (k - 1)) / (sum w_i - sum w_i^2 / sum w_i)).

Runs that agree within their own errors give tau = 0; runs that do not are averaged nearly equally, and tau says so.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, as_rows, freeze
from ridgeback.numeric.backbone.curve import MOST_BINS, Backbone
from ridgeback.numeric.backbone.damping import growth_columns
from ridgeback.numeric.backbone.shown import Curve, ShownBackbone
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.tracking.choices import Definition


@dataclass(frozen=True, repr=False)
class CombinedBackbone(ShownBackbone):
    """The common curve of several backbones.

    Parameters
    ----------
    amplitude : array of float, shape (B,)
        A grid of amplitudes.
    omega, omega_sd : array of float, shape (B,)
        Mean frequency, rad per time unit, and the standard deviation of the mean.
    omega_between : array of float, shape (B,)
        Standard deviation between the runs beyond their own errors; NaN where a single run reaches.
    growth_rate, growth_rate_sd, growth_rate_between : array of float, shape (B,)
        The same for a'/a, per time unit.
    runs : array of float, shape (B,)
        How many runs reach each amplitude.
    labels : tuple of str
        Their names.
    definition : Definition
        Which amplitude.
    """

    amplitude: Array
    omega: Array
    omega_sd: Array
    omega_between: Array
    growth_rate: Array
    growth_rate_sd: Array
    growth_rate_between: Array
    runs: Array
    labels: tuple[str, ...]
    definition: Definition
    units: str = ""

    def __post_init__(self) -> None:
        freeze(self)

    def along(self) -> Curve:
        """The curve that is drawn."""
        return Curve(self.amplitude, self.omega, self.omega_sd)

    def rows(self) -> list[dict[str, float]]:
        """One row per amplitude, named as those of a Backbone, with the scatter between runs."""
        columns = {
            "amplitude": self.amplitude,
            "omega_rad_s": self.omega,
            "frequency_hz": self.omega / TWO_PI,
            "omega_standard_deviation_rad_s": self.omega_sd,
            "omega_between_runs_rad_s": self.omega_between,
            **growth_columns(self.growth_rate, self.growth_rate_sd, self.omega, self.omega_sd),
            "growth_rate_between_runs_per_s": self.growth_rate_between,
            "runs": self.runs,
        }
        return as_rows(columns)


def combine(curves: Sequence[Backbone], labels: Sequence[str]) -> CombinedBackbone:
    """Average the curves of several backbones on a common grid of amplitudes.

    Parameters
    ----------
    curves : sequence of Backbone
        With amplitudes of one definition and unit.
    labels : sequence of str
        Their names.

    Returns
    -------
    CombinedBackbone
        At each amplitude the mean of the curves that reach it, weighted by precision and by the scatter between them.

    Raises
    ------
    InputError
        For none, or for amplitudes of different definitions.

    References
    ----------
    DerSimonian and Laird, Controlled Clinical Trials 7 (1986) 177.

    Examples
    --------
    >>> from ridgeback.numeric.backbone.half_cycles import half_cycles
    >>> t = np.arange(1280) / 32.0
    >>> runs = [a * np.exp(-0.05 * t) * np.cos(8.0 * t) for a in (1.0, 2.0)]
    >>> found = combine([half_cycles(x, 32.0).backbone() for x in runs], ["first", "second"])
    >>> bool(np.abs(found.omega - 8.0).max() < 1e-3), sorted(set(found.runs.tolist()))
    (True, [1.0, 2.0])
    """
    definitions = sorted({curve.definition for curve in curves})
    if len(definitions) != 1:
        named = " and ".join(definitions) or "nothing"
        raise InputError(f"backbones of {named} cannot be combined; use amplitudes of one definition")
    low = min(float(curve.curve_amplitude[0]) for curve in curves)
    high = max(float(curve.curve_amplitude[-1]) for curve in curves)
    points = min(MOST_BINS, max(curve.curve_amplitude.size for curve in curves))
    grid = np.linspace(low, high, points)
    omega, omega_sd = (along(curves, grid, name) for name in ("curve_omega", "curve_omega_sd"))
    growth_rate, growth_rate_sd = (along(curves, grid, name) for name in ("curve_growth_rate", "curve_growth_rate_sd"))
    covered = np.isfinite(omega).any(axis=0)
    frequency, decay = random_effects(omega, omega_sd), random_effects(growth_rate, growth_rate_sd)
    return CombinedBackbone(
        amplitude=grid[covered],
        omega=frequency[0][covered],
        omega_sd=frequency[1][covered],
        omega_between=frequency[2][covered],
        growth_rate=decay[0][covered],
        growth_rate_sd=decay[1][covered],
        growth_rate_between=decay[2][covered],
        runs=np.isfinite(omega).sum(axis=0)[covered].astype(float),
        labels=tuple(labels),
        definition=definitions[0],
    )


def along(curves: Sequence[Backbone], grid: Array, name: str) -> Array:
    """A quantity of every curve on the grid, linear between its points, NaN beyond them; ``[curve, amplitude]``."""
    rows = []
    for curve in curves:
        a = curve.curve_amplitude
        slack = 1e-9 * float(a[-1])
        inside = (grid >= a[0] - slack) & (grid <= a[-1] + slack)
        rows.append(np.where(inside, np.interp(grid, a, getattr(curve, name)), np.nan))
    return np.array(rows)


def random_effects(values: Array, deviations: Array) -> tuple[Array, Array, Array]:
    """Mean, its standard deviation and tau for each column of ``values[run, amplitude]``; NaN is a run that is absent.

    >>> mean, deviation, tau = random_effects(np.array([[1.0], [3.0]]), np.array([[0.1], [0.1]]))
    >>> mean.tolist(), bool(abs(tau[0] ** 2 - (2.0 - 0.01)) < 1e-12), bool(abs(deviation[0] - 1.0) < 1e-12)
    ([2.0], True, True)
    """
    there = np.isfinite(values)
    count = there.sum(axis=0)
    floor = 1e-12 * np.abs(np.where(there, values, 0.0)).max(initial=1e-300)
    y, s = np.where(there, values, 0.0), np.where(there, np.maximum(deviations, floor), 1.0)
    weight = there / s**2
    total = np.maximum(weight.sum(axis=0), np.finfo(float).tiny)
    mean = (weight * y).sum(axis=0) / total
    q = (weight * (y - mean) ** 2).sum(axis=0)
    spread = total - (weight**2).sum(axis=0) / total
    excess = np.maximum(0.0, q - (count - 1))
    between = np.where(count > 1, excess / np.where(count > 1, spread, 1.0), 0.0)
    weight = there / (s**2 + between)
    total = np.maximum(weight.sum(axis=0), np.finfo(float).tiny)
    mean = np.where(count > 0, (weight * y).sum(axis=0) / total, np.nan)
    return mean, np.sqrt(1.0 / total), np.where(count > 1, np.sqrt(between), np.nan)
