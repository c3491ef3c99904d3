"""Cells of the backbone: the error of omega0 by method and order at an amplitude, against the exact frequency.

The damping of an oscillator is left out; a limit cycle has values of eps in the place of amplitudes.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import ClassVar

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.compare.studies.plan import Plan, Subject
from ridgeback.compare.studies.systems import System
from ridgeback.compare.studies.tasks import Column, Coordinates, Measure, Outcome, Task
from ridgeback.compare.study.derived import Undamped, without_damping
from ridgeback.compare.study.reference import Reference
from ridgeback.compare.study.study import study_of
from ridgeback.compare.study.truncations import METHODS as SERIES
from ridgeback.compare.study.truncations import Truncations, of_expansion
from ridgeback.numeric.arrays import Array
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.resummation.by_name import KINDS, resum
from ridgeback.symbolic.resummation.resummation import Resummation
from ridgeback.symbolic.singularities.limits import Limits, limits

CELLS = 2000
"""Cells in a block, about: where they are cheap, a block takes tenths of a second."""
ORBITS = 8
"""Amplitudes in a block of a limit cycle, each of which costs an integration."""
METHODS = (*SERIES, *KINDS)


@dataclass(frozen=True)
class BackboneTask:
    """All orders of one method at some amplitudes of one oscillator."""

    MEASURE: ClassVar[str] = "backbone"

    system: System
    method: str
    orders: tuple[int, ...]
    amplitudes: tuple[float, ...]
    highest: float
    """The largest amplitude of the whole study: resummations with a pole below it are refused throughout."""

    def cells(self) -> Sequence[Coordinates]:
        """By amplitude, then by order."""
        return [(self.method, amplitude, order) for amplitude in self.amplitudes for order in self.orders]

    def compute(self) -> Sequence[Outcome]:
        """Errors at all amplitudes together, or where that is refused at each half of them."""
        try:
            return self._together()
        except InputError as error:
            middle = len(self.amplitudes) // 2
            if not middle:
                return (str(error),) * len(self.orders)
        halves = (self.amplitudes[:middle], self.amplitudes[middle:])
        parts = [BackboneTask(self.system, self.method, self.orders, part, self.highest).compute() for part in halves]
        return [outcome for part in parts for outcome in part]

    def _together(self) -> Sequence[Outcome]:
        rest = rest_of(self.system)
        refusals: dict[int, str] = {}

        def truncate(_: Undamped, orders: Sequence[int], grid: Array) -> Truncations:
            if self.method in KINDS:
                return self._resummed(orders, grid, refusals)
            if self.method == "multiple-scales":
                return SERIES[self.method](rest, orders, grid)
            series, found = _series(self.system, self.method, max(self.orders))
            return of_expansion(series, orders, grid, found)

        found = study_of(rest, self.orders, self.amplitudes, truncate=truncate, method=self.method)
        return [
            refusals.get(order) or _values(found.omega[i, j], found.reference[j], found.reference_error[j])
            for j in range(len(self.amplitudes))
            for i, order in enumerate(self.orders)
        ]

    def _resummed(self, orders: Sequence[int], grid: Array, refusals: dict[int, str]) -> Truncations:
        """The same for formulas made from the series; the orders that give none are noted with their reason."""
        series, found = _series(self.system, "lindstedt", max(self.orders))
        rows = []
        for order in orders:
            try:
                formula = _formula(self.system, self.method, max(self.orders), order, self.highest)
                rows.append(np.asarray(formula(grid), dtype=float))
            except (InputError, ZeroDivisionError) as error:
                refusals[order] = str(error)
                rows.append(np.full(grid.size, np.nan))
        scale = float(series.scale)
        return Truncations(np.stack(rows), series.variable, series.amplitude, scale, found.radius, None, "")


def _values(omega: float, reference: float, uncertainty: float) -> Outcome:
    if not (np.isfinite(omega) and np.isfinite(reference)):
        return "the formula has no finite value there"
    return float(omega), float(reference), float(uncertainty), float(omega / reference - 1.0)


@lru_cache(maxsize=32)
def rest_of(system: System) -> Undamped:
    """The oscillator without its damping, made once in a process."""
    return without_damping(system.oscillator())


@lru_cache(maxsize=32)
def _series(system: System, method: str, order: int) -> tuple[Expansion, Limits]:
    derive = energy_integral if method == "energy-integral" else lindstedt
    series = derive(rest_of(system).oscillator, order)
    return series, limits(series)


@lru_cache(maxsize=256)
def _formula(system: System, kind: str, highest_order: int, order: int, highest: float) -> Resummation:
    series, _ = _series(system, "lindstedt", highest_order)
    return resum(rest_of(system).oscillator, series.truncated(order), kind, up_to=Fraction(highest))


def series_of(system: System, method: str, order: int) -> Expansion | None:
    """The series that a method truncates at any order; None for a method that does something else.

    >>> series_of(System("p", "pendulum"), "lindstedt", 2).coefficients
    (1, 0, -1/16)
    """
    if method == "multiple-scales":
        return _series(system, "lindstedt", order)[0].convert("fundamental")
    return _series(system, method, order)[0] if method in SERIES else None


def exact_at(system: System, amplitudes: Array) -> Reference:
    """The exact frequency at rising amplitudes; raises InputError as a study does."""

    def truncate(_: Undamped, orders: Sequence[int], grid: Array) -> Truncations:
        series, found = _series(system, "lindstedt", 0)
        return of_expansion(series, orders, grid, found)

    found = study_of(rest_of(system), (0,), amplitudes, truncate=truncate)
    return Reference(found.reference, found.reference_error, found.reference_name)


def tasks(plan: Plan) -> Iterator[Task]:
    """Blocks by oscillator, method and stretch of amplitudes."""
    for subject in plan.subjects:
        size = block_size(subject, len(plan.orders))
        grid = tuple(sorted(subject.amplitudes))
        for method in plan.methods:
            for first in range(0, len(grid), size):
                yield BackboneTask(subject.system, method, plan.orders, grid[first : first + size], grid[-1])


def block_size(subject: Subject, orders: int) -> int:
    """Amplitudes in a block."""
    if subject.system.oscillator().kind == "limit-cycle":
        return ORBITS
    return max(1, CELLS // orders)


MEASURE = Measure(
    name="backbone",
    coordinates=(
        Column("method", "", "how the frequency is computed"),
        Column("amplitude", "unit of the unknown", "peak amplitude, or the value of eps of a limit cycle"),
        Column("order", "1", "highest power kept"),
    ),
    values=(
        Column("omega", "rad per time unit", "angular frequency by the method"),
        Column("omega_reference", "rad per time unit", "exact angular frequency"),
        Column("reference_error", "1", "relative uncertainty of omega_reference"),
        Column("relative_error", "1", "omega / omega_reference - 1"),
    ),
    methods=METHODS,
    defaults=("lindstedt",),
    tasks=tasks,
)
