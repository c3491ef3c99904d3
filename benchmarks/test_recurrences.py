"""The general engine beside recurrences written by hand for one equation, in one run, because machines differ.

``RIDGEBACK_LONG_BENCHMARKS=1`` adds the orders that take minutes.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.systems.catalogue import find

sys.path.insert(0, str(Path(__file__).parent))
import recurrences

SUPERSCRIPT = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")
LONG = bool(os.environ.get("RIDGEBACK_LONG_BENCHMARKS"))
CASES: list[tuple[str, str, int, Callable[[int], list[Any]]]] = [
    ("pendulum", "A", 100, recurrences.pendulum),
    ("pendulum", "A", 200, recurrences.pendulum),
    ("van-der-pol", "ε", 48, recurrences.van_der_pol),
    ("van-der-pol", "ε", 96, recurrences.van_der_pol),
    *([("van-der-pol", "ε", 164, recurrences.van_der_pol)] if LONG else []),
]


@pytest.mark.parametrize("who", ["by hand", "Ridgeback"])
@pytest.mark.parametrize(("system", "letter", "order", "by_hand"), CASES, ids=lambda x: str(x) if x else "")
def test_against_the_recurrence(
    benchmark: Any, system: str, letter: str, order: int, by_hand: Callable[[int], list[Any]], who: str
) -> None:
    benchmark.group = f"{system} {order}"
    title = {"pendulum": "pendulum", "van-der-pol": "van der Pol"}[system]
    benchmark.extra_info.update(series=f"{title} to {letter}{str(order).translate(SUPERSCRIPT)}", who=who)
    oscillator = find(system)
    run = (lambda: by_hand(order)) if who == "by hand" else (lambda: list(lindstedt(oscillator, order).coefficients))
    found = benchmark.pedantic(run, rounds=1 if order > 100 else 3, warmup_rounds=0)
    assert found[4] == lindstedt(oscillator, 4).coefficients[4]
