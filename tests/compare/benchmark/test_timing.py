"""What costs are made of: a few laps, their median and scatter; nothing here looks at a clock."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import pytest

from ridgeback.compare.benchmark.ways import estimates, timing
from ridgeback.compare.benchmark.ways.expansions import theory
from ridgeback.compare.benchmark.ways.timing import FEWEST, PATIENCE, REPEATS, cost_of, per_value, repeated
from ridgeback.compare.motion.motion import integrate_motion, setting
from ridgeback.symbolic.systems.catalogue import find


@pytest.fixture
def laps(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """Laps that runs are made to take, one after the other; what is left was not run."""
    found: list[float] = []

    def lap(run: object) -> float:
        assert callable(run)
        run()
        return found.pop(0)

    monkeypatch.setattr(timing, "lap", lap)
    return found


def test_the_scatter_is_that_of_normal_laps_and_one_disturbed_lap_leaves_it() -> None:
    drawn = 3.0 + 0.1 * np.random.default_rng(5).normal(size=4001)
    found = cost_of(drawn.tolist())
    assert found.seconds == pytest.approx(3.0, rel=0.01)
    assert found.scatter == pytest.approx(0.1 / 3.0, rel=0.1)
    assert cost_of([1.0, 1.01, 1.02, 1.03, 1.04, 50.0]).scatter < 0.1
    assert cost_of([1.0, 1.1]).scatter == pytest.approx(np.std([1.0, 1.1], ddof=1) / 1.05)
    assert math.isnan(cost_of([1.0]).scatter)


def test_a_quick_run_is_repeated_and_a_slow_one_is_made_twice(laps: list[float]) -> None:
    laps += [PATIENCE / 100] * 20
    repeated(lambda: None)
    assert len(laps) == 20 - REPEATS
    laps[:] = [2 * PATIENCE] * 20
    repeated(lambda: None)
    assert len(laps) == 20 - FEWEST
    repeated(lambda: None, laps=(1.0,))
    assert len(laps) == 20 - 2 * FEWEST + 1


def test_the_first_call_is_not_counted_unless_it_is_a_slow_one(laps: list[float]) -> None:
    sizes: list[int] = []
    laps += [PATIENCE / 2, *[PATIENCE / 1000] * REPEATS]
    quick = per_value(lambda x: sizes.append(x.size), np.ones(10), values=1000)
    assert (quick.seconds, sizes, laps) == (pytest.approx(PATIENCE / 1e6), [1000] * (REPEATS + 1), [])
    laps += [2 * PATIENCE, 4 * PATIENCE]
    assert per_value(np.sin, np.ones(10), values=5).seconds == pytest.approx(0.3 * PATIENCE)


def test_a_track_is_timed_by_the_runs_that_its_correction_makes_anyway(monkeypatch: pytest.MonkeyPatch) -> None:
    """Three for one that is corrected; one that is not runs once more, on samples that nothing is kept of."""
    motion = integrate_motion(setting(find("duffing"), initial=(0.5, 0.0), duration=60.0))
    seen: list[float] = []

    def method(x: np.ndarray) -> object:
        seen.append(float(x[0]))
        return plain(x)

    def plain(x: np.ndarray) -> estimates.Track:
        return estimates._plain(x, motion.trajectory.rate, "zero-crossing")

    monkeypatch.setattr(estimates, "METHODS", ())
    raw, corrected = estimates.estimates(motion, {"mine": method}, lambda _: None)  # type: ignore[dict-item]
    assert len(seen) == 3
    for row in (raw.row, corrected.row):
        assert row.time_scatter is not None
        assert row.time_scatter >= 0.0
    monkeypatch.setattr(estimates, "UNCORRECTED", ("mine",))
    for timed, runs in ((True, 2), (False, 1)):
        seen.clear()
        assert len(list(estimates.estimates(motion, {"mine": method}, lambda _: None, timed=timed))) == 1  # type: ignore[dict-item]
        assert len(set(seen)) == runs


def test_nothing_from_theory_runs_for_its_time_where_that_is_not_wanted(monkeypatch: pytest.MonkeyPatch) -> None:
    motion = integrate_motion(setting(find("damped-pendulum"), initial=(0.5, 0.0), duration=60.0, rate=8.0))

    def refused(run: object) -> float:
        raise AssertionError(f"{run} was timed")

    monkeypatch.setattr(timing, "lap", refused)
    rows = [c.row for c in theory(motion, (2, 4), lambda _: None, timed=False)]
    kinds = {"expansion", "resummation", "slow-flow", "series-model", "closed-form", "averaged", "linear"}
    assert kinds <= {row.kind for row in rows if not row.refused}
    with pytest.raises(AssertionError, match="was timed"):
        list(theory(motion, (2, 4), lambda _: None))


def test_clocks_of_the_processor_stand_still_while_a_run_waits(monkeypatch: pytest.MonkeyPatch) -> None:
    clock: Iterator[float] = iter([5.0, 7.0])
    monkeypatch.setattr(timing.time, "process_time", lambda: next(clock))
    assert timing.lap(lambda: None) == 2.0
