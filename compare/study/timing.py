"""Evaluation time per value: generated code, the paper's series, the closed form, all in one run on one array.

Medians over repeats, with the lower and upper quartile: on a shared machine the spread says more than digits.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from functools import partial

import numpy as np

from ridgeback.compare.binding.compiled_code import NotCompiled, compiled
from ridgeback.compare.binding.generated_code import python_module
from ridgeback.compare.study.results import Timing
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.numeric.orbits.paper_model import series_frequency
from ridgeback.symbolic.expansion.expansion import Expansion

VALUES = 4096
REPEATS = 15
SERIES_TERMS = (3, 20)


def timings(
    expansion: Expansion, dynamics: Dynamics, *, upper: float, pendulum: bool, values: int = VALUES
) -> tuple[Timing, ...]:
    """Time every way to omega0 on one array of arguments; where compiled C cannot be had, its row says why instead.

    Parameters
    ----------
    expansion
        The series whose generated code is timed.
    dynamics
        The same oscillator bound to numbers, for its closed form.
    upper
        Largest argument, in the expansion's variable; they are spread evenly over (0, upper].
    pendulum
        Whether the paper's series (14) belongs to this oscillator.
    values
        Number of arguments.

    Raises
    ------
    InputError
        When the coefficients have no double.
    """
    x = np.linspace(upper / values, upper, values)
    return tuple(
        measure(name, function, x, note=note)
        for name, function, note in _candidates(expansion, dynamics, pendulum=pendulum)
    )


def _candidates(
    expansion: Expansion, dynamics: Dynamics, *, pendulum: bool
) -> Iterator[tuple[str, Callable[[Array], object] | NotCompiled, str]]:
    order = f"order {expansion.order}"
    with compiled(expansion) as native:
        yield "generated C", native, f"{order}, compiled with -O3"
    module = python_module(expansion)
    yield "generated Python, NumPy array", module.omega0, order
    yield "generated Python, one float at a time", _one_by_one(module.omega0), order
    if pendulum:
        k = dynamics.natural_frequency
        for terms in SERIES_TERMS:
            yield f"series (14), {terms} terms", partial(series_frequency, k=k, terms=terms), "NumPy array"
    if dynamics.closed_form is not None and expansion.variable == "A":
        yield "closed form (agm)", dynamics.closed_form, "NumPy array"


def _one_by_one(function: Callable[[float], float]) -> Callable[[Array], object]:
    return lambda x: [function(value) for value in x.tolist()]


def measure(name: str, function: Callable[[Array], object] | NotCompiled, x: Array, *, note: str = "") -> Timing:
    """Median time per value over repeats, after one call that is not counted.

    >>> measure("square", np.square, np.ones(64)).nanoseconds > 0
    True
    """
    if isinstance(function, NotCompiled):
        return Timing(name, math.nan, math.nan, math.nan, x.size, f"not timed: {function.reason}")
    function(x)
    laps = [_lap(function, x) for _ in range(REPEATS)]
    low, middle, high = np.percentile(laps, (25, 50, 75)) / x.size
    return Timing(name, float(middle), float(low), float(high), x.size, note)


def _lap(function: Callable[[Array], object], x: Array) -> float:
    start = time.perf_counter_ns()
    function(x)
    return float(time.perf_counter_ns() - start)
