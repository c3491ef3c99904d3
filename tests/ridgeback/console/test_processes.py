"""A pool of processes ends with its user's interrupt and with its parent: a study on two processes, stopped midway."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

RUN = """
import sys
import ridgeback.cli as cli, ridgeback.options.budget as budget
from ridgeback.compare.studies.measures import backbone
backbone.CELLS = 8  # small blocks, and progress at each, so that a test knows when the work is under way
budget.EVERY = 0.0
if __name__ == "__main__":
    sys.exit(cli.main(["study", "big.toml", "--workers", "2"]))
"""
STUDY = """
[study]
ask = ["error"]
[grid]
orders = [2, 4]
amplitudes = { from = 0.01, to = 3, count = 40000 }
[[oscillator]]
system = "pendulum"
"""


def under_way(folder: Path) -> subprocess.Popen[str]:
    """The study, once some of its blocks are done; it would take minutes."""
    (folder / "run.py").write_text(RUN)
    (folder / "big.toml").write_text(STUDY)
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[3])}
    process = subprocess.Popen(
        [sys.executable, "run.py"],
        cwd=folder,
        env=environment,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    assert process.stderr is not None
    while "%" not in process.stderr.readline():
        assert process.poll() is None
    return process


def test_an_interrupt_of_all_of_them_ends_the_pool_in_one_line(tmp_path: Path) -> None:
    """Ctrl-C goes to the whole group of processes; only one line may come of it, and no process may stay."""
    with under_way(tmp_path) as process:
        os.killpg(process.pid, signal.SIGINT)
        assert process.stderr is not None
        said = process.stderr.read()
        assert process.wait(60) == 130
    assert "interrupted; the same command goes on from big.db" in said.splitlines()[-1]
    assert all(line.startswith("ridgeback: ") for line in said.splitlines()), said
    assert gone(process.pid)


def test_workers_end_with_their_parent(tmp_path: Path) -> None:
    with under_way(tmp_path) as process:
        process.kill()
        process.wait(60)
    assert gone(process.pid)


def gone(group: int) -> bool:
    """Whether no process of a group is left, the tracker of shared memory a moment after its parent."""
    for _ in range(200):
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return True
        time.sleep(0.1)
    return False
