"""Cells along a motion: the error of omega0(t) by every way to it, without noise and in seeded noise.

A case is an oscillator released at rest from an amplitude and sampled for a while; errors are relative to the cycle
frequency of the integrated solution, over the middle eight tenths.  Noise depends on seed, ratio and trial alone: every
method sees the same records, whoever computes them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.compare.studies.measures.along import Case, Curve, budget, growth_error, reference_floor
from ridgeback.compare.studies.measures.estimated import ESTIMATES, estimated, noisy
from ridgeback.compare.studies.measures.predicted import PREDICTIONS, predicted, takes_orders
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.systems import System
from ridgeback.compare.studies.tasks import Column, Coordinates, Measure, Outcome, Task

TRIALS = 5
"""Noisy records in a block: some seconds of work."""
DEFAULTS = ("lindstedt/action", "multiple-scales", "pseudo-wigner", "harmonic-least-squares")


@dataclass(frozen=True)
class DecayTask:
    """Some methods on one case at one ratio of signal to noise."""

    MEASURE: ClassVar[str] = "decay"

    system: System
    amplitude: float
    duration: float
    rate: float
    methods: tuple[str, ...]
    orders: tuple[int, ...]
    snr_db: float
    seed: int
    first: int
    last: int
    """Trials ``first .. last - 1``."""

    def cells(self) -> Sequence[Coordinates]:
        """By method, order and trial."""
        return [
            (method, self.amplitude, self.duration, self.snr_db, order, trial)
            for method in self.methods
            for order in (self.orders if takes_orders(method) else (None,))
            for trial in range(self.first, self.last)
        ]

    def compute(self) -> Sequence[Outcome]:
        """The errors of each method; a method that refuses says why."""
        case = Case.of(self.system, self.amplitude, self.duration, self.rate)
        floor = reference_floor(case)
        return [self._outcome(case, floor, cell) for cell in self.cells()]

    def _outcome(self, case: Case, floor: float, cell: Coordinates) -> Outcome:
        method, _, _, _, order, trial = cell
        try:
            if str(method) in PREDICTIONS:
                curve = predicted(case, str(method), None if order is None else int(order), max(self.orders, default=0))
            else:
                x = noisy(case.samples, self.snr_db, self.seed, int(trial or 0))
                curve = Curve(estimated(case, str(method), x))
        except (InputError, ZeroDivisionError) as error:
            return str(error)
        return errors_of(case, curve, floor)


def errors_of(case: Case, curve: Curve, floor: float) -> Outcome:
    """Norms of the relative error over the interior, and the share of it that the curve covers."""
    with np.errstate(invalid="ignore", over="ignore"):
        error = curve.omega / case.reference - 1.0
    known = case.inside & np.isfinite(error)
    if not known.any():
        return "it gives no value on the interior of this motion"
    values = error[known]
    return (
        float(np.sqrt(np.mean(values**2))),
        float(values.mean()),
        float(np.abs(values).max()),
        float(known.sum() / case.inside.sum()),
        growth_error(case, curve),
        floor,
        *budget(case, curve),
    )


def tasks(plan: Plan) -> Iterator[Task]:
    """Blocks by case, then theory at once and estimates by ratio and trials."""
    theory = tuple(method for method in plan.methods if method in PREDICTIONS)
    seen = tuple(method for method in plan.methods if method not in PREDICTIONS)
    for subject in plan.subjects:
        system, signal = subject.system, subject.signal
        rate = signal.sampling(system)
        for amplitude in subject.amplitudes:
            for duration in signal.durations(system):
                if theory:
                    yield DecayTask(system, amplitude, duration, rate, theory, plan.orders, math.inf, 0, 0, 1)
                for snr in signal.snr_db if seen else ():
                    trials = 1 if snr == math.inf else signal.trials
                    for first in range(0, trials, TRIALS):
                        last = min(first + TRIALS, trials)
                        yield DecayTask(system, amplitude, duration, rate, seen, (), snr, signal.seed, first, last)


MEASURE = Measure(
    name="decay",
    coordinates=(
        Column("method", "", "way to omega0(t)"),
        Column("amplitude", "unit of the unknown", "initial displacement, at rest"),
        Column("duration", "time unit", "length of the record"),
        Column("snr_db", "dB", "variance of the signal over that of the noise; inf, or nothing, is no noise"),
        Column("order", "1", "highest power kept, or number of terms of the paper's series"),
        Column("trial", "1", "number of the noisy record"),
    ),
    values=(
        Column("rms", "1", "root mean square of the relative error of omega0(t) over the interior"),
        Column("mean", "1", "its mean; negative means low"),
        Column("largest", "1", "its largest magnitude"),
        Column("coverage", "1", "share of the interior that has a value"),
        Column("growth_rms", "1", "root mean square of the relative error of the growth rate, by cycle"),
        Column("floor", "1", "how far two readings of the motion itself differ, relative"),
        Column("truncation", "1", "rms error against the exact frequency at the prediction's own amplitude"),
        Column("averaging", "1", "rms error of that exact frequency"),
        Column("closure", "1", "rms of what truncation and averaging leave of the whole error"),
    ),
    methods=(*PREDICTIONS, *ESTIMATES),
    defaults=DEFAULTS,
    tasks=tasks,
)
