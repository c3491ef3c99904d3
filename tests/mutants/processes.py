"""Collect the tests once, and try every mutant in a copy of the process, bounded in time and memory."""

from __future__ import annotations

import os
import resource
import signal
import tempfile
import time
from collections.abc import Callable, Collection, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from tests.mutants.changes import Mutant
from tests.mutants.choice import Choice, Rank
from tests.mutants.patching import patched

MOST_MEMORY = 6_000_000_000
HANG = 1800.0
"""Seconds on the clock after which a process that hardly computes is ended."""
ENDLESS, SHORT = 20, 5
"""Processor seconds of a test that may be in an endless loop, and in which it ends on the unchanged code."""
SOUND = 120
"""Processor seconds in which a test that failed passes on the unchanged code."""
RUNS, UNREAD, UNSEEN = "runs since ", "the module cannot be read", "nothing that is kept shows it"


@dataclass(frozen=True)
class Outcome:
    """The first test that failed, and the one at which the processor time ran out; neither where all passed."""

    failed: str = ""
    endless: str = ""


class Recorder:
    """Writes down the test that runs, while it runs, and the first one that fails; then ends the process."""

    def __init__(self, place: Path) -> None:
        self.place = place

    def begin(self, test: str) -> None:
        self.place.write_text(f"{RUNS}{time.process_time()} {test}", encoding="utf-8")

    def end(self, said: str) -> None:
        self.place.write_text(said, encoding="utf-8")
        os._exit(0)

    def pytest_runtest_logreport(self, report: Any) -> None:
        if report.failed:
            self.end(report.nodeid)


@dataclass
class Tests:
    """The collected tests of a session, by file."""

    items: Sequence[pytest.Item]
    root: Path
    unsound: set[str] = field(default_factory=set)
    known: dict[tuple[str, int], bool] = field(default_factory=dict)

    def of(self, files: Collection[str], rank: Rank) -> list[pytest.Item]:
        """The tests of these files, by rank, that are not known to fail on the unchanged code."""
        found = [i for i in self.items if i.nodeid.partition("::")[0] in files and i.nodeid not in self.unsound]
        return sorted(found, key=lambda item: rank(item.nodeid))

    def killer(self, mutant: Mutant, choice: Choice, seconds: int) -> str | None:
        """The test that notices a mutant; empty for a survivor, None for one that does not show in a copy."""
        files, rank = set(choice.files(mutant.path)), choice.ranks(mutant)
        while True:
            came = copied(lambda: patch(self.root, mutant), self.of(files, rank), seconds)
            if came.failed == UNSEEN:
                return None
            if not came.failed and not (came.endless and self.sound(came.endless, SHORT)):
                return ""
            if came.endless:
                return f"{came.endless}, which did not end"
            if came.failed == UNREAD or self.sound(came.failed, SOUND):
                return came.failed
            self.unsound.add(came.failed)
            print(f"{came.failed} fails on the unchanged code", flush=True)

    def sound(self, test: str, seconds: int) -> bool:
        """Whether a test passes on the unchanged code, so that its failure means something."""
        if (test, seconds) not in self.known:
            came = copied(lambda: None, [item for item in self.items if item.nodeid == test], seconds)
            self.known[test, seconds] = came == Outcome()
        return self.known[test, seconds]


def patch(root: Path, mutant: Mutant) -> str | None:
    """Carry a mutant out here; what to say instead of running tests."""
    try:
        return None if patched(root, mutant) else UNSEEN
    except Exception:
        return UNREAD


def copied(prepare: Callable[[], str | None], items: Sequence[pytest.Item], seconds: int) -> Outcome:
    """Run tests in a copy of this process until one fails, for so many seconds of processor time."""
    with tempfile.TemporaryDirectory(prefix="ridgeback-mutant-") as folder:
        place = Path(folder) / "said"
        place.touch()
        process = os.fork()
        if not process:
            run_here(prepare, items, seconds, place)
        killed = ended(process)
        said = place.read_text(encoding="utf-8")
    if not said.startswith(RUNS):
        return Outcome(failed=said)
    begun, test = said.removeprefix(RUNS).split(" ", 1)
    return Outcome(endless=test if killed and seconds - float(begun) >= ENDLESS else "")


def run_here(prepare: Callable[[], str | None], items: Sequence[pytest.Item], seconds: int, place: Path) -> None:
    """In the copy: run tests, and end."""
    recorder = Recorder(place)
    try:
        os.setsid()
        silence = os.open(os.devnull, os.O_RDWR)
        for stream in range(3):
            os.dup2(silence, stream)
        resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
        if said := prepare():
            recorder.end(said)
        if items:
            items[0].config.pluginmanager.register(recorder)
        for item, following in zip(items, [*items[1:], None], strict=True):
            recorder.begin(item.nodeid)
            item.config.hook.pytest_runtest_protocol(item=item, nextitem=following)
        recorder.end("")
    finally:
        os._exit(1)


def ended(process: int) -> bool:
    """Wait for a copy; whether it was killed."""
    last, pause = time.monotonic() + HANG, 0.005
    while True:
        found, status = os.waitpid(process, os.WNOHANG)
        if found:
            break
        if time.monotonic() > last:
            with suppress(ProcessLookupError):
                os.killpg(process, signal.SIGKILL)
        time.sleep(pause)
        pause = min(2 * pause, 0.2)
    with suppress(ProcessLookupError):
        os.killpg(process, signal.SIGKILL)  # what a test may have left running
    return os.WIFSIGNALED(status)
