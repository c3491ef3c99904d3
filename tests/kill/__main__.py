"""Stop jobs that keep state at random moments, take them up again, and hold the results against undisturbed runs.

    python -m tests.kill --kills 20 --seed 1
    python -m tests.kill --kills 500

Every chain is one job with SIGKILL, SIGTERM or SIGINT sent once to three times, then left to finish.  Required: output
whole or absent after every signal and equal byte for byte at the end; exit code 130 for what can be answered; nothing
half written left over; no process of the job alive.  Prints a table; exit code 1 when anything falls short.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from tests.kill.job import JOBS

SIGNALS = (signal.SIGKILL, signal.SIGTERM, signal.SIGINT)
LONGEST = 3600.0
"""Seconds after which a run counts as hanging: a busy machine may take many minutes for what takes seconds."""
SHORTEST = 0.3
"""Least share of the undisturbed time over which the moments are drawn: start-up stays."""
GRACE = 20.0
"""Seconds in which every process of a stopped job must be gone."""


@dataclass
class Trial:
    """A job in a folder of its own, and what came of its stops."""

    name: str
    folder: Path
    reference: bytes
    faults: list[str] = field(default_factory=list)
    counts: Counter[str] = field(default_factory=Counter)

    def run(self, stop: signal.Signals | None = None, after: float = 0.0) -> float:
        """Run the job; send it a signal after so many seconds, if it still runs then.  Answers how long it ran."""
        begin, before = time.monotonic(), self.parts()
        process = started(self.name, self.folder)
        try:
            process.wait(after if stop else LONGEST)
        except subprocess.TimeoutExpired:
            if stop is None:
                self.faults.append(f"no end after {LONGEST:.0f} s")
            process.send_signal(stop or signal.SIGKILL)
            process.wait(LONGEST)
        lasted = time.monotonic() - begin
        self.judge(process, stop, before if stop else frozenset())
        return lasted

    def judge(self, process: subprocess.Popen[bytes], stop: signal.Signals | None, before: frozenset[str]) -> None:
        """Note what came of a run; what was left ``before`` it by one that was killed goes when state is saved."""
        code, error = process.returncode, (self.folder / "error").read_text(encoding="utf-8", errors="replace")
        allowed = {0, -signal.SIGKILL} if stop == signal.SIGKILL else {0, 130, -signal.SIGINT, -signal.SIGTERM}
        met = stop is not None and (code in allowed or (code == 1 and before_it_began(error)))
        if not met and code != 0:
            self.faults.append(f"exit code {code} after {stop.name if stop else 'nothing'}: {error[-300:]}")
        self.counts["finished first" if code == 0 and stop else "stopped" if stop else "resumed"] += 1
        output = self.folder / "output"
        if output.exists() and output.read_bytes() != self.reference and not said_partial(output):
            self.faults.append("an output that is neither whole nor says that it is partial")
        if stop != signal.SIGKILL and (left := sorted(self.parts() - before)):
            self.faults.append(f"left over after {stop.name if stop else 'the end'}: {left}")
        if not gone(process.pid):
            self.faults.append(f"processes of the job alive {GRACE:.0f} s after {stop.name if stop else 'its end'}")
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)

    def parts(self) -> frozenset[str]:
        """Files that are neither state nor output."""
        return frozenset(path.name for path in self.folder.iterdir()) - {"state", "output", "error"}


def before_it_began(error: str) -> bool:
    """Whether an interrupt met the interpreter itself, before it had read a line of a file."""
    return "<frozen site>" in error and 'File "/' not in error and error.rstrip().endswith("KeyboardInterrupt")


def said_partial(output: Path) -> bool:
    """Whether an output is whole JSON that calls itself incomplete, as an interrupted study's is."""
    try:
        return json.loads(output.read_text(encoding="utf-8")).get("complete") is False
    except (ValueError, AttributeError):
        return False


def started(name: str, folder: Path) -> subprocess.Popen[bytes]:
    """Start a job at the head of a process group of its own."""
    command = [sys.executable, "-m", "tests.kill.job", name, str(folder / "state"), str(folder / "output")]
    with (folder / "error").open("wb") as error:
        return subprocess.Popen(command, stdout=error, stderr=error, stdin=subprocess.DEVNULL, start_new_session=True)


def gone(group: int) -> bool:
    """Whether no process of a group is left, within the grace."""
    end = time.monotonic() + GRACE
    while time.monotonic() < end:
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return True
        time.sleep(0.05)
    return False


def references(root: Path) -> dict[str, tuple[bytes, float]]:
    """The output of each job undisturbed, and how long it took."""
    found = {}
    for name in JOBS:
        folder = Path(tempfile.mkdtemp(dir=root))
        begin = time.monotonic()
        code = started(name, folder).wait(LONGEST)
        if code:
            raise SystemExit(f"{name} undisturbed: exit code {code}: {(folder / 'error').read_text()}")
        found[name] = ((folder / "output").read_bytes(), time.monotonic() - begin)
    return found


def chains(kills: int, rng: random.Random) -> Iterator[tuple[str, list[tuple[signal.Signals, float]]]]:
    """Jobs in turn, each with its signals and the moments as shares of the undisturbed time; every pair is met."""
    number = 0
    while number < kills:
        name = tuple(JOBS)[number % len(JOBS)]
        count = min(rng.choice((1, 1, 2, 3)), kills - number)
        yield name, [(SIGNALS[(number // len(JOBS) + i) % 3], rng.uniform(0.2, 1.1)) for i in range(count)]
        number += count


def main(arguments: Sequence[str] | None = None) -> int:
    """Run chains until enough signals were sent."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=float("inf"), help="begin no chain after so long")
    given = parser.parse_args(arguments)
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background job ignores it, and so would ours
    last = time.monotonic() + 60.0 * given.minutes
    totals: dict[str, Counter[str]] = {name: Counter() for name in JOBS}
    faults: list[str] = []
    with tempfile.TemporaryDirectory(prefix="ridgeback-kill-") as root:
        undisturbed = references(Path(root))
        with suppress(KeyboardInterrupt):  # what was tried until then is told all the same
            for name, stops in chains(given.kills, random.Random(given.seed)):  # noqa: S311 - moments, no secrets
                if time.monotonic() > last:
                    break
                reference, seconds = undisturbed[name]
                trial = Trial(name, Path(tempfile.mkdtemp(dir=root)), reference)
                left = seconds
                for stop, share in stops:
                    lasted = trial.run(stop, share * left)
                    if lasted < share * left and left == seconds:  # the machine is less busy than it was
                        seconds = max(lasted, SHORTEST * seconds)
                    left = max(left - lasted, SHORTEST * seconds)  # a job that is taken up again has less to do
                undisturbed[name] = reference, seconds
                trial.run()
                if not (output := trial.folder / "output").exists() or output.read_bytes() != reference:
                    trial.faults.append("the end differs")
                totals[name] += trial.counts + Counter({"chains": 1, "equal at the end": not trial.faults})
                found = [f"{name}, {', '.join(s.name for s, _ in stops)}: {fault}" for fault in trial.faults]
                print(*found, sep="\n", end="\n" if found else "", file=sys.stderr, flush=True)
                faults += found
    columns = ("stopped", "finished first", "chains", "equal at the end")
    print(f"| job | {' | '.join(columns)} |\n|---|{'---|' * len(columns)}")
    for name, counts in totals.items():
        print(f"| {name} | {' | '.join(str(counts[column]) for column in columns)} |")
    whole = sum(totals.values(), Counter[str]())
    print(f"| in all | {' | '.join(str(whole[column]) for column in columns)} |")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
