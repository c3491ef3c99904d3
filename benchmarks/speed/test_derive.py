"""Time of exact derivations by order: ``python -m pytest benchmarks`` with the development tools installed.

Outside the test run, and without a bound: machines differ.  Compare lines of one run with each other.
"""

from __future__ import annotations

from typing import Any

import pytest

from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.systems.catalogue import find


@pytest.mark.parametrize("order", [10, 20, 50, 100])
@pytest.mark.parametrize("system", ["pendulum", "duffing-hardening", "helmholtz-duffing"])
@pytest.mark.parametrize("derive", [lindstedt, energy_integral], ids=["lindstedt", "energy-integral"])
def test_conservative(benchmark: Any, derive: Any, system: str, order: int) -> None:
    result = benchmark.pedantic(derive, args=(find(system), order), rounds=3, warmup_rounds=1)
    assert result.order == order


@pytest.mark.parametrize("order", [8, 16, 24])
def test_limit_cycle(benchmark: Any, order: int) -> None:
    result = benchmark.pedantic(lindstedt, args=(find("van-der-pol"), order), rounds=3, warmup_rounds=1)
    assert result.order == order


@pytest.mark.parametrize("order", [4, 8, 12])
def test_slow_flow(benchmark: Any, order: int) -> None:
    result = benchmark.pedantic(multiple_scales, args=(find("damped-pendulum"), order), rounds=3, warmup_rounds=1)
    assert result.order == order
