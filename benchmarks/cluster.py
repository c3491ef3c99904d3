"""Ten thousand cells of a shipped study on a dask cluster of two workers, one of them killed on the way.

    python -m benchmarks.cluster

Needs the extra ``distributed``.  Starts a scheduler and two workers on loopback, runs the study "five-oscillators" with
finer amplitudes through ``ridgeback study --scheduler``, kills one worker when a third of the cells is done, and holds
the table against that of an undisturbed run in one process, byte for byte.  Prints what it found; exit code 1 when the
two differ.
"""

from __future__ import annotations

import json
import sqlite3
import subprocess
import sys
import tempfile
import time
from contextlib import suppress
from pathlib import Path

from ridgeback.compare.studies.examples import example

SETTINGS = (
    *("oscillator.1.amplitudes={ from = 0.05, to = 3.1, count = 615 }", "ask=error"),
    "amplitudes={ from = 0.02, to = 0.9, count = 615 }",
    "oscillator.5.amplitudes={ from = 0.05, to = 1.5, count = 40 }",
)
CELLS = 4 * (4 * 615 + 40)
PATIENCE = 120.0


def module(*arguments: str, quiet: bool = False) -> subprocess.Popen[bytes]:
    """A Python module as a process of its own."""
    errors = subprocess.DEVNULL if quiet else None
    return subprocess.Popen([sys.executable, "-m", *arguments], stderr=errors)  # noqa: S603


def study(folder: Path, name: str, *more: str) -> subprocess.Popen[bytes]:
    """The study, its table in a file of this name."""
    settings = [word for setting in SETTINGS for word in ("--set", setting)]
    place = ("--store", str(folder / f"{name}.db"), "--format", "csv", "-o", str(folder / f"{name}.csv"))
    return module("ridgeback", "study", str(folder / "five.toml"), *settings, *place, *more)


def done(store: Path) -> int:
    """Blocks in a store that somebody else writes."""
    with suppress(sqlite3.Error):
        connection = sqlite3.connect(f"file:{store}?mode=ro", uri=True)
        try:
            return int(connection.execute("SELECT count(*) FROM blocks").fetchone()[0])
        finally:
            connection.close()
    return 0


def main() -> int:
    """Run both, and compare."""
    with tempfile.TemporaryDirectory(prefix="ridgeback-cluster-") as root:
        folder = Path(root)
        (folder / "five.toml").write_text(example("five-oscillators"), encoding="utf-8")
        began = time.monotonic()
        study(folder, "alone").wait()
        alone = time.monotonic() - began
        blocks, table = done(folder / "alone.db"), (folder / "alone.csv").read_bytes()
        file = folder / "scheduler.json"
        place = ("--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", str(file))
        processes = [module("distributed.cli.dask_scheduler", *place, quiet=True)]
        try:
            while not file.exists() and time.monotonic() - began < alone + PATIENCE:
                time.sleep(0.1)
            worker = ("--scheduler-file", str(file), "--nthreads", "1", "--no-dashboard", "--no-nanny")
            processes += [module("distributed.cli.dask_worker", *worker, quiet=True) for _ in range(2)]
            address = json.loads(file.read_text(encoding="utf-8"))["address"]
            began = time.monotonic()
            run = study(folder, "cluster", "--scheduler", address)
            killed = None
            while run.poll() is None:
                time.sleep(0.1)
                if killed is None and done(folder / "cluster.db") * 3 >= blocks:
                    killed = done(folder / "cluster.db")
                    processes[1].kill()
            spent = time.monotonic() - began
        finally:
            for process in reversed(processes):
                process.kill()
        rows = table.count(b"\n") - 1
        if run.returncode:
            return run.returncode
        same = (folder / "cluster.csv").read_bytes() == table
        print(f"{rows} cells in {blocks} blocks; one process {alone:.1f} s, two workers {spent:.1f} s")
        print(
            f"one worker killed after {killed} blocks; the tables are {'equal byte for byte' if same else 'different'}"
        )
        return 0 if same and killed is not None and rows == CELLS else 1


if __name__ == "__main__":
    sys.exit(main())
