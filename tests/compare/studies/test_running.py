"""The loop of a study: a bounded window, any executor, any order of completion, the same table."""

from __future__ import annotations

import threading
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest

from ridgeback.compare.studies.file.reading import plan_of
from ridgeback.compare.studies.measures import backbone
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.running import complete, counted, finished, spread, tasks_of
from ridgeback.compare.studies.store import opened
from ridgeback.compare.studies.tasks import Outcome, Task, inputs_of, run

TEXT = """
[study]
ask = "error"
[grid]
orders = [2, 4]
amplitudes = { from = 0.1, to = 3, count = 24 }
[[oscillator]]
system = "pendulum"
"""


@pytest.fixture
def plan(monkeypatch: pytest.MonkeyPatch) -> Plan:
    monkeypatch.setattr(backbone, "CELLS", 4)
    return plan_of(TEXT)


class Counting(ThreadPoolExecutor):
    """Threads that know how many pieces they held at most."""

    def __init__(self) -> None:
        super().__init__(3)
        self.lock, self.most, self.waiting = threading.Lock(), 0, 0

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        with self.lock:
            self.waiting += 1
            self.most = max(self.most, self.waiting)
        return super().submit(self.counted, fn, *args, **kwargs)

    def counted(self, fn: Callable[..., Any], *args: Any, **kwargs: Any) -> Any:
        value = fn(*args, **kwargs)
        with self.lock:
            self.waiting -= 1
        return value


def outcomes(plan: Plan, path: Path, **how: Any) -> list[Outcome]:
    with opened(path, plan, "test", warned=pytest.fail) as store:
        complete(plan, store, **how)
        return [o for block in finished(plan, store, warned=pytest.fail) for o in block.outcomes]


def test_results_do_not_depend_on_who_computes_them(plan: Plan, tmp_path: Path) -> None:
    alone = outcomes(plan, tmp_path / "a.db")
    with Counting() as pool:
        assert outcomes(plan, tmp_path / "b.db", executor=pool, window=3) == alone
    assert pool.most <= 3


def test_tasks_are_handed_out_a_few_at_a_time(plan: Plan) -> None:
    taken = 0

    def counting() -> Any:
        nonlocal taken
        for task in tasks_of(plan):
            taken += 1
            yield task

    with ThreadPoolExecutor(1) as pool:
        for done, _ in enumerate(spread(counting(), pool, 2)):
            assert taken <= done + 3
    assert taken == counted(plan).blocks == 12


def test_an_interrupt_keeps_what_was_done_and_the_next_run_goes_on(
    plan: Plan, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    computed: list[str] = []

    def interrupted(task: Task) -> tuple[Outcome, ...]:
        if len(computed) == 5:
            raise KeyboardInterrupt
        computed.append(inputs_of(task))
        return run(task)

    monkeypatch.setattr("ridgeback.compare.studies.running.run", interrupted)
    with pytest.raises(KeyboardInterrupt):
        outcomes(plan, tmp_path / "s.db")
    monkeypatch.setattr(
        "ridgeback.compare.studies.running.run", lambda task: (computed.append(inputs_of(task)), run(task))[1]
    )
    resumed = outcomes(plan, tmp_path / "s.db")
    assert len(computed) == len(set(computed)) == 12
    assert resumed == outcomes(plan, tmp_path / "whole.db")


def test_a_fault_in_one_block_is_its_reason(plan: Plan, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def faulty(self: backbone.BackboneTask) -> Any:
        if 0.1 in self.amplitudes:
            raise ZeroDivisionError("by nothing")
        return original(self)

    original = backbone.BackboneTask.compute
    monkeypatch.setattr(backbone.BackboneTask, "compute", faulty)
    found = outcomes(plan, tmp_path / "s.db")
    assert found[:4] == ["unexpected ZeroDivisionError: by nothing"] * 4
    assert all(isinstance(outcome, tuple) for outcome in found[4:])


def test_full_disks_stop_the_study_and_spoil_no_cell(
    plan: Plan, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(_: backbone.BackboneTask) -> Any:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(backbone.BackboneTask, "compute", full)
    with pytest.raises(OSError, match="No space"):
        outcomes(plan, tmp_path / "s.db")
    monkeypatch.undo()
    monkeypatch.setattr(backbone, "CELLS", 4)
    assert all(isinstance(outcome, tuple) for outcome in outcomes(plan, tmp_path / "s.db"))
