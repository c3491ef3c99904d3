"""What a noise study hands over: one cell per method and signal-to-noise ratio, each figure with its uncertainty.

All errors are relative, omega(t) / truth - 1, over the interior of the record (10 % .. 90 %), pooled over trials.
Uncertainties are one standard deviation of the Monte-Carlo mean, with a trial as the unit.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ridgeback.common.show.brief import Brief

OUTLIER = 0.1
"""A trial whose relative rms error exceeds this has lost the ridge: a gross error, not a spread."""


def estimator_of(method: str) -> str:
    """The estimator of a method of a study, without the scope that may stand behind it.

    >>> estimator_of("harmonic-least-squares/local"), estimator_of("wigner")
    ('harmonic-least-squares', 'wigner')
    """
    return method.partition("/")[0]


@dataclass(frozen=True)
class NoiseCell:
    """One method at one signal-to-noise ratio; None where no trial gave a value, or a method claims no interval."""

    method: str
    snr_db: float
    trials: int
    """Trials run; those that gave a track are ``trials - failures``."""
    rms: float | None
    rms_sd: float | None
    bias: float | None
    """Mean error, signed: negative means low."""
    bias_sd: float | None
    bound: float | None
    """Cramer-Rao bound of the model named in ``NoiseStudy.bound``, rms over the same samples."""
    ratio: float | None
    """``rms / bound``."""
    ratio_sd: float | None
    coverage: float | None
    """Share of samples at which the 95 % interval holds the truth."""
    coverage_sd: float | None
    outliers: int
    """Trials with an rms error above OUTLIER; they count in every figure of the cell."""
    failures: int
    """Trials that the method refused; they count in none."""
    typical: float | None = None
    """Median over trials of the rms error: what is left when a few trials lose the ridge."""
    reason: str = ""
    """Why the first failing trial failed."""


@dataclass(frozen=True, repr=False)
class NoiseStudy(Brief):
    """Frequency estimators in white Gaussian noise, seeded; ``cells`` go through the methods, then the ratios."""

    title: str
    truth: str
    """What the true omega(t) is."""
    bound: str
    """The model whose Cramer-Rao bound is given."""
    methods: tuple[str, ...]
    snr_db: tuple[float, ...]
    """Ratio of the noise-free signal's variance to the noise's, in decibels."""
    trials: int
    seed: int
    rate: float
    samples: int
    interior: tuple[float, float]
    cells: tuple[NoiseCell, ...]
    complete: bool = True
    """False when it was interrupted: every cell then holds the trials that were done."""
    notes: tuple[str, ...] = ()

    def cell(self, method: str, snr_db: float) -> NoiseCell:
        """Return the cell of a method at a ratio; KeyError when it is not in the study."""
        for cell in self.cells:
            if cell.method == method and cell.snr_db == snr_db:
                return cell
        raise KeyError((method, snr_db))

    def of(self, method: str) -> tuple[NoiseCell, ...]:
        """Return the cells of one method, in the order of ``snr_db``."""
        return tuple(self.cell(method, snr) for snr in self.snr_db)

    def rows(self) -> list[dict[str, Any]]:
        """One row per cell, every field in its own column."""
        return [dataclasses.asdict(cell) for cell in self.cells]

    def as_dict(self) -> dict[str, Any]:
        """The study as JSON knows it; :func:`read_study` gives it back."""
        return dataclasses.asdict(self)


def read_study(record: Mapping[str, Any]) -> NoiseStudy:
    """Make a study from what ``as_dict`` gave, also after a passage through JSON.

    >>> cell = NoiseCell("wigner", 10.0, 2, 1e-2, 1e-3, 0.0, 1e-3, 5e-3, 2.0, 0.2, None, None, 0, 0)
    >>> study = NoiseStudy("t", "", "", ("wigner",), (10.0,), 2, 1, 32.0, 64, (0.2, 1.8), (cell,))
    >>> read_study(study.as_dict()) == study
    True
    """
    values = dict(record)
    values["cells"] = tuple(NoiseCell(**cell) for cell in values["cells"])
    for name in ("methods", "snr_db", "interior", "notes"):
        values[name] = tuple(values[name])
    return NoiseStudy(**values)


@dataclass(frozen=True, repr=False)
class Trial(Brief):
    """One noisy record through one method: sums over the interior of the errors that a cell is made of."""

    mean_square: float = math.nan
    mean: float = math.nan
    covered: float | None = None
    half: int = 0
    """Half the estimator's window, in samples, and its phase's degree: its bound is that of this window."""
    degree: int = 3
    own: float | None = None
    """Relative bound for unit noise of a model of the whole record, from the Fisher matrix of the fit itself."""
    reason: str = ""
    """Why the method refused; empty when it did not."""


def mean_and_deviation(values: Sequence[float]) -> tuple[float, float]:
    """Mean of the values, and the standard deviation of that mean; infinite for a single value.

    >>> mean_and_deviation([1.0, 3.0])
    (2.0, 1.0)
    """
    n = len(values)
    mean = math.fsum(values) / n
    spread = math.fsum((value - mean) ** 2 for value in values)
    return mean, math.sqrt(spread / (n * (n - 1))) if n > 1 else math.inf


Window = tuple[int, int]
"""Half a window, in samples, and the degree of the phase in it."""


def cell_of(
    method: str, snr_db: float, trials: Sequence[Trial], bounds: Mapping[Window, float], noise: float = 1.0
) -> NoiseCell:
    """Make a cell from its trials; ``bounds`` gives the relative bound for unit noise of each window that occurs.

    >>> done = [Trial(1e-6, 1e-4, 1.0, 48), Trial(3e-6, -1e-4, 0.9, 48), Trial(reason="too short")]
    >>> cell = cell_of("wigner", 20.0, done, {(48, 3): 1e-2}, noise=0.1)
    >>> round(cell.ratio, 6), cell.coverage, cell.failures, cell.bias
    (1.414214, 0.95, 1, 0.0)
    """
    given = [trial for trial in trials if not trial.reason]
    reason = next((trial.reason for trial in trials if trial.reason), "")
    if not given:
        empty = (None,) * 9
        return NoiseCell(method, snr_db, len(trials), *empty, outliers=0, failures=len(trials), reason=reason)
    square, square_sd = mean_and_deviation([trial.mean_square for trial in given])
    rms = math.sqrt(square)
    rms_sd = 0.5 * square_sd / rms if rms > 0.0 else 0.0
    bias, bias_sd = mean_and_deviation([trial.mean for trial in given])
    units = [bounds[trial.half, trial.degree] if trial.own is None else trial.own for trial in given]
    bound = noise * math.sqrt(math.fsum(unit**2 for unit in units) / len(units))
    coverage, coverage_sd = coverage_of([trial.covered for trial in given if trial.covered is not None])
    roots = sorted(math.sqrt(trial.mean_square) for trial in given)
    return NoiseCell(
        method=method,
        snr_db=snr_db,
        trials=len(trials),
        rms=rms,
        rms_sd=finite(rms_sd),
        bias=bias,
        bias_sd=finite(bias_sd),
        bound=finite(bound),
        ratio=finite(rms / bound),
        ratio_sd=finite(rms_sd / bound),
        coverage=coverage,
        coverage_sd=coverage_sd,
        outliers=sum(root > OUTLIER for root in roots),
        failures=len(trials) - len(given),
        typical=0.5 * (roots[(len(roots) - 1) // 2] + roots[len(roots) // 2]),
        reason=reason,
    )


def coverage_of(shares: Sequence[float]) -> tuple[float | None, float | None]:
    """Mean share and its deviation, which is at least the resolution of that many trials; None without any.

    >>> coverage_of([1.0] * 10), coverage_of([])
    ((1.0, 0.05), (None, None))
    """
    if not shares:
        return None, None
    mean, deviation = mean_and_deviation(shares)
    return mean, finite(max(deviation, 0.5 / len(shares)))


def finite(value: float) -> float | None:
    """The value, or None where it is not a finite number: JSON has no others."""
    return value if math.isfinite(value) else None
