"""Questions about the backbone: errors, orders needed, observed orders, ranges of use, work against precision."""

from __future__ import annotations

import numpy as np
import pytest

from ridgeback.compare.studies.file.reading import plan_of
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.questions import error, observed_order, order_needed, reach, work_precision
from ridgeback.compare.studies.questions.observed_order import Slope, slope, verdict
from ridgeback.compare.studies.running import tasks_of
from ridgeback.compare.studies.tasks import Finished, run
from ridgeback.compare.study.study import study
from ridgeback.symbolic.systems.catalogue import find

TEXT = """
[study]
ask = "ASK"
[grid]
orders = [2, 8]
amplitudes = { from = 0.1, to = 3.1, count = 31 }
tolerances = [1e-3, 1e-6]
[[oscillator]]
system = "pendulum"
"""


def asked(question: str, *overrides: tuple[str, str]) -> tuple[Plan, list[Finished]]:
    plan = plan_of(TEXT.replace("ASK", question), overrides=overrides)
    return plan, [Finished(task, run(task)) for task in tasks_of(plan)]


def test_errors_are_those_of_the_plain_study() -> None:
    rows = error.answer(*asked("error")).rows()
    plain = study(find("pendulum"), (2, 8), np.linspace(0.1, 3.1, 31))
    assert [row["largest"] for row in rows] == pytest.approx(np.abs(plain.relative_error).max(axis=1), rel=1e-9)
    assert [row["at_amplitude"] for row in rows] == pytest.approx([3.1, 3.1])


def test_the_order_needed_holds_at_every_smaller_amplitude() -> None:
    rows = order_needed.answer(*asked("order-needed")).rows()
    first = [(row["order"], row["amplitude_from"], row["amplitude_to"]) for row in rows if row["tolerance"] == 1e-3]
    assert first == [(2, 0.1, 1.3), (8, 1.4, 2.2), (None, 2.3, 3.1)]


def test_ranges_of_use_are_roots_and_not_points_of_the_grid() -> None:
    """Found independently: order 2 at 1e-6 holds to 0.2355, order 8 at 0.1 % to 2.2135."""
    for count in ("31", "7"):
        grid = f"{{ from = 0.1, to = 3.1, count = {count} }}"
        rows = reach.answer(*asked("range", ("amplitudes", grid))).rows()
        found = {(row["order"], row["tolerance"]): row["up_to"] for row in rows}
        assert found[2, 1e-6] == pytest.approx(0.235537, abs=1e-6)
        assert found[8, 1e-3] == pytest.approx(2.21352, abs=1e-5)


def test_a_range_that_nothing_ends_says_so() -> None:
    plan, blocks = asked("range", ("amplitudes", "[0.1, 0.2]"), ("tolerances", "[0.5, 1e-9]"))
    found = reach.answer(plan, blocks)
    assert {row["order"]: (row["up_to"], row["throughout"]) for row in found.rows() if row["tolerance"] == 0.5} == {
        2: (0.2, True),
        8: (0.2, True),
    }
    assert found.failed == 1
    assert any("at the smallest amplitude" in o for block in blocks for o in block.outcomes if isinstance(o, str))


def test_observed_orders_are_the_theoretical_ones() -> None:
    grid = "{ from = 0.02, to = 0.9, count = 40, spacing = 'log' }"
    found = observed_order.answer(*asked("observed-order", ("amplitudes", grid), ("orders", "[2, 4]")))
    assert [(row["theoretical"], row["verdict"]) for row in found.rows()] == [(4, "pass"), (6, "pass")]
    assert found.passed is True


@pytest.mark.parametrize("power", [3, 4, 7])
def test_a_wrong_power_is_not_passed(power: int) -> None:
    A = np.geomspace(0.02, 0.6, 40)
    found = slope(A, 0.3 * A**power * (1 + 0.4 * A - 0.7 * A**2), np.full(40, 1e-18))
    assert found is not None
    assert verdict(power, found) == "pass"
    assert verdict(power + 1, found) == "fail"
    assert verdict(power, Slope(float(power), 0.3, 9)).startswith("not decided")


def test_what_is_efficient_has_nothing_cheaper_that_errs_less() -> None:
    found = work_precision.answer(*asked("work-precision", ("amplitudes", "{ from = 0.1, to = 2, count = 9 }")))
    rows = found.rows()
    assert {row["method"] for row in rows} >= {"lindstedt/python", "series/numpy", "closed-form/numpy"}
    for row in rows:
        cheaper = [r for r in rows if r["time_ns_per_value"] < row["time_ns_per_value"]]
        assert row["efficient"] == (not any(r["largest"] <= row["largest"] for r in cheaper))
        assert row["largest"] > 0


def test_resummations_and_minimax_fits_take_part_in_work_against_precision() -> None:
    methods = '["lindstedt/python", "pade/python", "nome/python", "minimax/python", "minimax/c"]'
    plan, blocks = asked("work-precision", ("amplitudes", "[0.5, 1, 2]"), ("orders", "[3, 8]"), ("methods", methods))
    rows = {(row["method"], row["order"]): row for row in work_precision.answer(plan, blocks).rows()}
    assert rows["minimax/python", 8]["largest"] < 0.01 * rows["lindstedt/python", 8]["largest"]
    assert rows["pade/python", 8]["largest"] < rows["lindstedt/python", 8]["largest"]
    assert rows["minimax/python", 8]["coefficients"] == 5
    assert ("minimax/python", 3) not in rows  # a polynomial in A^2 has an even degree in A
    if ("minimax/c", 8) in rows:
        assert rows["minimax/c", 8]["largest"] == pytest.approx(rows["minimax/python", 8]["largest"], rel=1e-6)


def test_an_order_that_cannot_be_judged_is_not() -> None:
    """Too few amplitudes, an interval too wide, and a formula that is no truncated series."""
    A = np.geomspace(0.01, 0.5, 20)
    assert slope(A[:5], A[:5] ** 4, np.full(5, 1e-16)) is None
    assert slope(A, np.full(20, 1e-17), np.full(20, 1e-16)) is None
    assert verdict(4, None).startswith("not decided: fewer than")
    assert verdict(4, Slope(4.0, 9.0, 20)) == "not decided: the interval is too wide"
    assert verdict(None, None) == "no theoretical order: not a truncated series"
