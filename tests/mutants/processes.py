"""Run pytest in a process that starts with the libraries imported, bounded in time and memory."""

from __future__ import annotations

import os
import resource
import signal
import sys
import tempfile
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
MOST_MEMORY = 6_000_000_000
HANG = 1800.0
"""Seconds on the clock after which a process that hardly computes is ended."""
IMPORTED = (
    "numpy scipy.integrate scipy.interpolate scipy.linalg scipy.ndimage scipy.optimize scipy.signal scipy.special"
)
IMPORTED_ONCE = (*IMPORTED.split(), "scipy.stats", "sympy", "mpmath", "flint", "click", "pytest")
"""What every process of tests starts with, imported: none of it is ours."""
WAYS = get_context("forkserver")
WAYS.set_forkserver_preload(list(IMPORTED_ONCE))
PASSED = (0, 5)
"""Exit codes of pytest when no test failed, and when there was none."""


@dataclass(frozen=True)
class Outcome:
    """Whether tests passed, the first that failed, and whether their processor time ran out."""

    passed: bool
    failed: str = ""
    exhausted: bool = False


class Recorder:
    """Writes down the first test, or file of tests, that fails."""

    def __init__(self, place: str) -> None:
        self.place = Path(place)

    def pytest_runtest_logreport(self, report: Any) -> None:
        self.note(report)

    def pytest_collectreport(self, report: Any) -> None:
        self.note(report)

    def note(self, report: Any) -> None:
        if report.failed and not self.place.read_text():
            self.place.write_text(report.nodeid)


def pytest_in(tree: Path, tests: Sequence[str], seconds: int, place: str) -> None:
    """Run pytest in a copy of the tree, in a process of its own, and end with its exit code."""
    os.setsid()
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
    silence = os.open(os.devnull, os.O_RDWR)
    for stream in range(3):
        os.dup2(silence, stream)
    os.chdir(tree)
    os.environ.update(PYTHONPATH=str(tree), PYTHONDONTWRITEBYTECODE="1", CI="1")
    sys.dont_write_bytecode = True
    for name in [name for name in sys.modules if name.partition(".")[0] in ("tests", "ridgeback")]:
        del sys.modules[name]
    sys.path[:] = [str(tree), *(place for place in sys.path if Path(place).resolve() != ROOT)]
    import pytest

    os._exit(int(pytest.main(["-q", "-x", "-p", "no:cacheprovider", *tests], plugins=[Recorder(place)])))


def tried(tree: Path, tests: Sequence[str], seconds: int) -> Outcome:
    """Run tests in a copy of the tree until one fails, for so many seconds of processor time."""
    with tempfile.NamedTemporaryFile() as place:
        process = WAYS.Process(target=pytest_in, args=(tree, list(tests), seconds, place.name))
        process.start()
        process.join(HANG)
        if process.exitcode is None and process.pid is not None:
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.join()
        failed = Path(place.name).read_text(encoding="utf-8")
    code = process.exitcode
    return Outcome(code in PASSED, failed, exhausted=not failed and (code is None or code < 0))
