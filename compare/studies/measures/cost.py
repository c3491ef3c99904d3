"""Cells of work against precision: what a value costs as generated code, and how far it errs over the amplitudes.

Times are those of the processor of the machine and in the run that the cell was computed in.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import ClassVar

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.compare.benchmark.ways.formulas import fitted
from ridgeback.compare.benchmark.ways.timing import per_value
from ridgeback.compare.binding.compiled_code import NotCompiled, OfAmplitude, compiled
from ridgeback.compare.binding.generated_code import python_module
from ridgeback.compare.motion.motion import setting
from ridgeback.compare.studies.measures.backbone import exact_at, rest_of, series_of
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.systems import System
from ridgeback.compare.studies.tasks import Column, Coordinates, Measure, Outcome, Task
from ridgeback.compare.study.reference import Reference
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.orbits.paper_model import series_frequency
from ridgeback.symbolic.resummation.by_name import KINDS, resum

GENERATED = ("lindstedt", *KINDS, "minimax")
LANGUAGES = ("python", "c")
METHODS = (*(f"{name}/{way}" for name in GENERATED for way in LANGUAGES), "series/numpy", "closed-form/numpy")
"""The truncated expansion, its resummations and minimax fits (of the order as degree in A) as generated Python over an
array and as compiled C, the paper's (14) by its number of terms, and the closed form where there is one."""
DEFAULTS = ("lindstedt/python", "lindstedt/c", "series/numpy", "closed-form/numpy")


@dataclass(frozen=True)
class CostTask:
    """All orders of one method on one oscillator."""

    MEASURE: ClassVar[str] = "cost"

    system: System
    method: str
    orders: tuple[int, ...]
    amplitudes: tuple[float, ...]

    def cells(self) -> Sequence[Coordinates]:
        """By order; the closed form has none."""
        orders: Sequence[int | None] = self.orders if self.method != "closed-form/numpy" else (None,)
        return [(self.method, order) for order in orders]

    def compute(self) -> Sequence[Outcome]:
        """Time and error of each order."""
        x = np.array(self.amplitudes)
        exact = exact_at(self.system, x)
        return [self._outcome(None if order is None else int(order), x, exact) for _, order in self.cells()]

    def _outcome(self, order: int | None, x: Array, exact: Reference) -> Outcome:
        try:
            name, _, language = self.method.partition("/")
            if language in LANGUAGES:
                return self._generated(name, language, order or 0, x, exact)
            function, count = self._formula(order)
            return measured(function, x, exact, count)
        except (InputError, ZeroDivisionError) as error:
            return str(error)

    def _generated(self, name: str, language: str, order: int, x: Array, exact: Reference) -> Outcome:
        formula, count = self._by_name(name, order)
        if language == "python":
            return measured(python_module(formula).omega0, x, exact, count)
        with compiled(formula) as native:
            return native.reason if isinstance(native, NotCompiled) else measured(native, x, exact, count)

    def _by_name(self, name: str, order: int) -> tuple[OfAmplitude, int | None]:
        """The formula of an order, and how many coefficients it has."""
        rest, largest = rest_of(self.system), Fraction(max(self.amplitudes))
        if name == "minimax":
            if order % 2 or not order:
                raise InputError(f"a minimax fit is a polynomial in A^2; order {order} is not even and above 0")
            return fitted(rest.oscillator, rest.dynamics, largest, order // 2), order // 2 + 1
        series = series_of(self.system, "lindstedt", max(self.orders))
        if series is None:
            raise InputError(f"{self.system.name} has no expansion")
        part = series.truncated(order)
        if name == "lindstedt":
            return part, sum(1 for c in part.coefficients if c != 0)
        return resum(rest.oscillator, part, name, up_to=largest), None

    def _formula(self, order: int | None) -> tuple[Callable[[Array], object], int | None]:
        rest = rest_of(self.system)
        if self.method == "closed-form/numpy":
            if rest.dynamics.closed_form is None:
                raise InputError(f"{self.system.name} has no closed form")
            return rest.dynamics.closed_form, None
        if not setting(rest.oscillator).is_pendulum:
            raise InputError(f"{self.system.name} is no pendulum; the series (14) is of k^2 sin(u)")
        if not order:
            raise InputError("the series (14) has one term or more")
        return partial(series_frequency, k=rest.dynamics.natural_frequency, terms=order), order


def measured(function: Callable[[Array], object], x: Array, exact: Reference, count: int | None) -> Outcome:
    """Nanoseconds a value, and the largest and rms relative error over the amplitudes.

    No error is less than the uncertainty of what it is taken against.
    """
    error = np.abs(np.asarray(function(x), dtype=float) / exact.omega - 1.0)
    if not np.isfinite(error).all():
        return "the formula has no finite value at some of the amplitudes"
    error = np.maximum(error, exact.relative_error)
    return 1e9 * per_value(function, x).seconds, float(error.max()), float(np.sqrt(np.mean(error**2))), count


def tasks(plan: Plan) -> Iterator[Task]:
    """Blocks by oscillator and method."""
    for subject in plan.subjects:
        for method in plan.methods:
            yield CostTask(subject.system, method, plan.orders, tuple(sorted(subject.amplitudes)))


MEASURE = Measure(
    name="cost",
    coordinates=(
        Column("method", "", "formula and language"),
        Column("order", "1", "highest power kept, or number of terms of the paper's series"),
    ),
    values=(
        Column("time_ns_per_value", "ns", "processor time of one value in an array, median of repeats"),
        Column("largest", "1", "largest magnitude of the relative error over the amplitudes"),
        Column("rms", "1", "root mean square of the relative error over the amplitudes"),
        Column("coefficients", "1", "coefficients that are not zero"),
    ),
    methods=METHODS,
    defaults=DEFAULTS,
    tasks=tasks,
)
