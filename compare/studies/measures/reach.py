"""Cells of the range of use: the amplitude at which an order's error first passes a tolerance, found as a root.

The amplitudes of the plan are walked upwards until the error passes the tolerance for the first time; between that one
and the one before, the root of ln(|e| / tolerance) is found by Brent's method (R. P. Brent, Algorithms for Minimization
without Derivatives, 1973, chapter 4).  Where the error changes its sign in between, it is small there by accident, and
the last amplitude before it counts.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar

from scipy.optimize import brentq

from ridgeback.common.errors import InputError
from ridgeback.compare.studies.measures.backbone import METHODS, BackboneTask
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.systems import System
from ridgeback.compare.studies.tasks import Column, Coordinates, Measure, Outcome, Task

ERROR = 3
"""Place of the relative error among the values of a backbone cell."""
PRECISION = 1e-10
"""Relative precision of the root."""


@dataclass(frozen=True)
class ReachTask:
    """One order of one method on one oscillator, at all tolerances."""

    MEASURE: ClassVar[str] = "reach"

    system: System
    method: str
    order: int
    tolerances: tuple[float, ...]
    amplitudes: tuple[float, ...]
    """Rising: where violations are looked for."""

    def cells(self) -> Sequence[Coordinates]:
        """By tolerance."""
        return [(self.method, self.order, tolerance) for tolerance in self.tolerances]

    def compute(self) -> Sequence[Outcome]:
        """The range at each tolerance."""
        task = BackboneTask(self.system, self.method, (self.order,), self.amplitudes, self.amplitudes[-1])
        errors = [outcome[ERROR] if isinstance(outcome, tuple) else outcome for outcome in task.compute()]
        return [self._range(errors, tolerance) for tolerance in self.tolerances]

    def _range(self, errors: Sequence[object], tolerance: float) -> Outcome:
        broken = next((i for i, e in enumerate(errors) if not (isinstance(e, float) and abs(e) <= tolerance)), None)
        if broken is None:
            return self.amplitudes[-1], 1
        at = errors[broken]
        if not isinstance(at, float):
            return str(at) if broken == 0 else (self.amplitudes[broken - 1], 0)
        if broken == 0:
            return f"the error is {abs(at):.3g} at the smallest amplitude, {self.amplitudes[0]:.6g}"
        low, high = self.amplitudes[broken - 1], self.amplitudes[broken]
        before = errors[broken - 1]
        if not isinstance(before, float) or before * at <= 0.0:
            return low, 0
        return float(brentq(lambda a: self._excess(a, tolerance), low, high, xtol=PRECISION * low)), 0

    def _excess(self, amplitude: float, tolerance: float) -> float:
        """ln(|e| / tolerance) at an amplitude."""
        task = BackboneTask(self.system, self.method, (self.order,), (amplitude,), self.amplitudes[-1])
        (outcome,) = task.compute()
        if isinstance(outcome, str):
            raise InputError(outcome)
        return math.log(max(abs(float(outcome[ERROR] or 0.0)), 1e-300) / tolerance)


def tasks(plan: Plan) -> Iterator[Task]:
    """Blocks by oscillator, method and order."""
    for subject in plan.subjects:
        grid = tuple(sorted(subject.amplitudes))
        for method in plan.methods:
            for order in plan.orders:
                yield ReachTask(subject.system, method, order, plan.tolerances, grid)


MEASURE = Measure(
    name="reach",
    coordinates=(
        Column("method", "", "how the frequency is computed"),
        Column("order", "1", "highest power kept"),
        Column("tolerance", "1", "relative error that must hold"),
    ),
    values=(
        Column("up_to", "unit of the unknown", "amplitude, or value of eps, up to which it holds"),
        Column("throughout", "1", "1 where it holds at every amplitude looked at, so that up_to is the last of them"),
    ),
    methods=METHODS,
    defaults=("lindstedt",),
    tasks=tasks,
)
