"""The general engine beside what is written by hand for one equation, in one run, because machines differ.

The best of several rounds, in seconds of CPU, since others may use the machine.  ``RIDGEBACK_LONG_BENCHMARKS=1`` adds
the orders that take minutes.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import pytest

from benchmarks.speed import recurrences, reversion
from ridgeback.symbolic.expansion.cost import Budget
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.lindstedt import conservative_recursion, lindstedt
from ridgeback.symbolic.series.spaces import space_for
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator

SUPERSCRIPT = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")
TITLES = {"pendulum": "pendulum", "van-der-pol": "van der Pol", "helmholtz-duffing": "Helmholtz-Duffing"}
LONG = bool(os.environ.get("RIDGEBACK_LONG_BENCHMARKS"))
FREE = Budget(1e9, 1e9)


def recursion(oscillator: Oscillator, order: int, *, budget: Budget) -> SimpleNamespace:  # noqa: ARG001
    """Lindstedt's recursion, also where ``lindstedt`` knows a closed form."""
    found = conservative_recursion(oscillator, order, "peak", space_for((), order + 1))
    return SimpleNamespace(coefficients=found.omega)


@dataclass(frozen=True)
class Case:
    """A series by hand and by the engine."""

    system: str
    letter: str
    order: int
    by_hand: Callable[[int], list[Any]]
    derive: Callable[..., Any]

    @property
    def long(self) -> bool:
        """Whether one round is enough."""
        return self.order > (300 if self.letter == "A" else 100)

    @property
    def series(self) -> str:
        """What the table calls it."""
        limit = ", by its mean" if self.by_hand is reversion.pendulum_mean else ""
        by = {lindstedt: "", recursion: ", order by order"}.get(self.derive, f", frequency alone{limit}")
        return f"{TITLES[self.system]} to {self.letter}{str(self.order).translate(SUPERSCRIPT)}{by}"


CASES = [
    *(Case("pendulum", "A", n, recurrences.pendulum, recursion) for n in (100, 200)),
    *(Case("pendulum", "A", n, recurrences.pendulum, lindstedt) for n in (100, 200, *([400] if LONG else []))),
    *(Case("van-der-pol", "ε", n, recurrences.van_der_pol, lindstedt) for n in (48, 96, *([164] if LONG else []))),
    *(Case("pendulum", "A", n, reversion.pendulum, energy_integral) for n in (400, 800)),
    *(Case("pendulum", "A", n, reversion.pendulum_mean, energy_integral) for n in (200, 400)),
    *(Case("helmholtz-duffing", "A", n, reversion.helmholtz_duffing, energy_integral) for n in (400, 800)),
]


@pytest.mark.benchmark(timer=time.process_time)
@pytest.mark.parametrize("who", ["by hand", "Ridgeback"])
@pytest.mark.parametrize("case", CASES, ids=lambda case: case.series)
def test_against_what_is_written_by_hand(benchmark: Any, case: Case, who: str) -> None:
    benchmark.group = case.series
    benchmark.extra_info.update(series=case.series, who=who)
    oscillator = find(case.system)
    engine = lambda order: list(case.derive(oscillator, order, budget=FREE).coefficients)  # noqa: E731
    run = case.by_hand if who == "by hand" else engine
    found = benchmark.pedantic(run, args=(case.order,), rounds=1 if case.long else 3, warmup_rounds=0)
    assert found[:41] == engine(40) == run(40)
