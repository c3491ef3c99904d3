"""Results as CSV text for the download links: one header line, empty cells for nothing."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from ridgeback.common.csv_text import csv_text
from ridgeback.compare.benchmark.results import Benchmark
from ridgeback.compare.motion.results import BudgetRow, Curve, MotionComparison
from ridgeback.compare.study.results import Study
from ridgeback.numeric.arrays import Array

if TYPE_CHECKING:
    from ridgeback.compare.recording.results import RecordingComparison


def study_table(study: Study) -> str:
    """One row per order and amplitude."""
    rows = study.rows()
    header = list(rows[0]) if rows else []
    return csv_text(header, [list(row.values()) for row in rows])


def decay_table(decay: MotionComparison) -> str:
    """The trajectory, its amplitude and every curve, one row per sample (rad per time unit)."""
    columns: dict[str, Sequence[object]] = {
        "time": decay.time.tolist(),
        "u": [_short(x, digits=12) for x in decay.u.tolist()],
        "velocity": [_short(x, digits=12) for x in decay.velocity.tolist()],
        "amplitude_energy": _on(decay.time, decay.amplitudes.time, decay.amplitudes.energy),
    }
    if decay.amplitudes.averaged is not None:
        columns["amplitude_averaged"] = _on(decay.time, decay.amplitudes.time, decay.amplitudes.averaged)
    return _columns_table(columns | _curve_columns(decay.time, (decay.reference, *decay.curves)))


def harmonics_table(decay: MotionComparison) -> str:
    """The tracks of the higher harmonics with their predictions, one row per sample."""
    return _columns_table({"time": decay.time.tolist(), **_curve_columns(decay.time, decay.harmonics)})


def _on(time: Array, own: Array, values: Array) -> list[object]:
    """Return values at the sample times, NaN outside their own span."""
    return [_short(x) for x in np.interp(time, own, values, left=np.nan, right=np.nan).tolist()]


def _curve_columns(time: Array, curves: Sequence[Curve]) -> dict[str, Sequence[object]]:
    """Return each curve at its own samples only: nothing is interpolated into a file."""
    columns: dict[str, Sequence[object]] = {}
    for curve in curves:
        at = dict(zip(curve.time.tolist(), np.where(curve.valid, curve.omega, np.nan).tolist(), strict=True))
        columns[f"omega_{curve.name}"] = [_short(at.get(t, math.nan)) for t in time.tolist()]
    return columns


def _short(value: float, *, digits: int = 7) -> str:
    """Significant digits: a hundred times finer than the best estimate here, and half the size of the file.

    >>> _short(1.0 / 3.0), _short(math.nan)
    ('0.3333333', '')
    """
    return "" if math.isnan(value) else f"{value:.{digits}g}"


def _columns_table(columns: Mapping[str, Sequence[object]]) -> str:
    return csv_text(list(columns), zip(*columns.values(), strict=True))


def contenders_table(found: Benchmark) -> str:
    """One row per contender, refused ones included."""
    rows = [row.to_dict() for row in found.contenders]
    return csv_text(list(rows[0]), [list(row.values()) for row in rows])


def budget_table(rows: Sequence[BudgetRow]) -> str:
    """One row per method."""
    header = ["method", "truncation", "averaging", "estimator", "reference", "total", "closure"]
    return csv_text(header, [[getattr(row, name) for name in header] for row in rows])


def curves_table(curves: Sequence[Curve]) -> str:
    """All curves in long form: curve, time, omega, valid."""
    header = ["curve", "time", "omega", "standard_deviation", "valid"]
    return csv_text(header, (row for curve in curves for row in _long_rows(curve)))


def _long_rows(curve: Curve) -> Iterable[list[object]]:
    deviation = curve.standard_deviation
    for i in range(curve.time.size):
        sigma = None if deviation is None else float(deviation[i])
        yield [curve.name, float(curve.time[i]), float(curve.omega[i]), sigma, bool(curve.valid[i])]


def backbone_table(recording: RecordingComparison) -> str:
    """The backbone of a recording: amplitude, frequency and its standard deviation."""
    header = ["amplitude", "omega", "omega_standard_deviation"]
    columns = (recording.backbone_amplitude, recording.backbone_omega, recording.backbone_omega_sd)
    return csv_text(header, zip(*(column.tolist() for column in columns), strict=True))
