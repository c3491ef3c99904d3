"""A study on a real dask scheduler with two workers on loopback, one of them killed on the way."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import pytest

from ridgeback.common.errors import InputError
from ridgeback.compare.studies.file.reading import plan_of
from ridgeback.compare.studies.measures import backbone
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.running import complete, finished
from ridgeback.compare.studies.store import opened
from ridgeback.compare.studies.tasks import Outcome

TEXT = """
[study]
ask = "error"
[grid]
orders = [2, 4]
amplitudes = { from = 0.01, to = 3, count = 400 }
[[oscillator]]
system = "pendulum"
"""
PATIENCE = 60.0


def started(*arguments: str) -> subprocess.Popen[bytes]:
    command = [sys.executable, "-m", "distributed.cli." + arguments[0], *arguments[1:]]
    environment = {**os.environ, "PYTHONWARNINGS": "ignore", "DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "8"}
    return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment)


@pytest.fixture
def scheduler(tmp_path: Path) -> Iterator[tuple[str, list[subprocess.Popen[bytes]]]]:
    pytest.importorskip("distributed")
    file = tmp_path / "scheduler.json"
    processes = [
        started("dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", str(file))
    ]
    worker = ("dask_worker", "--scheduler-file", str(file), "--nthreads", "1", "--no-dashboard", "--no-nanny")
    try:
        end = time.monotonic() + PATIENCE
        while not file.exists() and time.monotonic() < end:
            time.sleep(0.1)
        processes += [started(*worker, "--local-directory", str(tmp_path)) for _ in range(2)]
        yield json.loads(file.read_text(encoding="utf-8"))["address"], processes[1:]
    finally:
        for process in reversed(processes):
            process.kill()
            process.wait(PATIENCE)


def outcomes(plan: Plan, path: Path, **how: object) -> list[Outcome]:
    with opened(path, plan, "test", warned=pytest.fail) as store:
        complete(plan, store, **how)  # type: ignore[arg-type]
        return [o for block in finished(plan, store, warned=pytest.fail) for o in block.outcomes]


@pytest.mark.filterwarnings("ignore")
def test_a_killed_worker_changes_nothing(
    scheduler: tuple[str, list[subprocess.Popen[bytes]]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from ridgeback.console.cluster import cluster

    address, workers = scheduler
    monkeypatch.setattr(backbone, "CELLS", 8)
    plan = plan_of(TEXT)

    def kill_one(share: float, _: str) -> None:
        if share > 0.3 and workers[0].poll() is None:
            workers[0].kill()

    with cluster(address) as (executor, threads):
        assert threads in (1, 2)  # the second worker may still be starting
        found = outcomes(plan, tmp_path / "cluster.db", executor=executor, window=8, progress=kill_one)
    assert workers[0].wait(PATIENCE) != 0
    assert found == outcomes(plan, tmp_path / "alone.db")


@pytest.mark.filterwarnings("ignore")
def test_a_scheduler_that_is_not_there_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed")
    from ridgeback.console import cluster

    monkeypatch.setattr(cluster, "PATIENCE", 1.0)
    with pytest.raises(OSError, match="no scheduler answers"), cluster.cluster("tcp://127.0.0.1:1"):
        pass


def test_dask_that_is_not_installed_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    from ridgeback.console import cluster

    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InputError, match=r'pip install "ridgeback\[distributed\]"'), cluster.cluster("tcp://x:1"):
        pass
    with suppress(KeyError):
        monkeypatch.delitem(sys.modules, "distributed")
