"""Change the code in one place and see whether its tests notice: ``python -m tests.mutants --count 200 --seed 1``.

A mutant is one changed operator, comparison, constant or condition in the cores of ``symbolic`` and ``numeric``.  It
is killed when a test fails, or does not end, that passes on the unchanged code: first the examples of its file, then
the tests that name what is changed, then those that reach it through other files, for so many seconds of processor time
as ``--seconds`` says.  The tests are collected once; every mutant lives in a copy of that process.
Prints every mutant with the test that killed it, the survivors to be looked at, those known to change nothing
(``equivalent.toml``: they are not tried, and count among all as not killed), and the share killed.  With ``--log`` it
takes up where it stopped, and tries again those whose file has changed.  A seed draws a mutant as long as its line
stands, whatever becomes of the others.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest

from tests.mutants.changes import Mutant, places
from tests.mutants.choice import Choice, choice_in
from tests.mutants.equivalent import equivalents
from tests.mutants.log import Log
from tests.mutants.processes import Tests

ROOT = Path(__file__).resolve().parents[2]
CORES = (
    *(
        f"symbolic/{name}"
        for name in ("arithmetic", "series", "expansion", "singularities", "resummation", "enclosure")
    ),
    *("symbolic/flow", "symbolic/high_order", "symbolic/certificates"),
    *(f"numeric/{name}" for name in ("signal", "harmonics", "tracking", "motion", "model_fit", "distributions")),
    *("numeric/estimators", "numeric/orbits", "numeric/recording", "numeric/backbone"),
)


class Trial:
    """Tries mutants in the place of pytest's loop over the tests."""

    def __init__(self, given: argparse.Namespace, every: Sequence[Mutant], choice: Choice) -> None:
        self.given, self.choice, self.log, self.same = given, choice, Log(ROOT, given.log), equivalents()
        self.chosen = [m for m in every if m.name in self.log.known] if given.survivors else drawn(every, given)

    def killer(self, mutant: Mutant) -> str | None:
        """What came of a mutant; empty for one that changes nothing, None for one that is still to be tried."""
        if mutant.name in self.same:
            return ""
        return self.log.last(mutant) if self.given.survivors else self.log.killer(mutant)

    def open(self) -> list[Mutant]:
        """Those to be tried."""
        known = [(mutant, self.killer(mutant)) for mutant in self.chosen if mutant.name not in self.same]
        return [mutant for mutant, test in known if test is None or (not test and self.given.survivors)]

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        tests, last = Tests(session.items, ROOT), time.monotonic() + 60.0 * self.given.minutes
        for mutant in self.open():
            if time.monotonic() > last:
                break
            test = tests.killer(mutant, self.choice, self.given.seconds)
            self.say(mutant, test)
            if test is not None:
                self.log.note(mutant, test)
        return True

    @staticmethod
    def say(mutant: Mutant, test: str | None) -> None:
        came = f"killed by {test}" if test else "SURVIVED" if test == "" else "shows in no copy of a process"
        print(f"{mutant.path}:{mutant.line} {mutant.what}: {came}", flush=True)


def mutants_within(within: str) -> list[Mutant]:
    """Every mutant of the cores in files whose path begins so."""
    files = [path for core in CORES for path in sorted((ROOT / core).glob("*.py")) if path.name != "__init__.py"]
    return [m for path in files for m in places(ROOT, path) if m.path.startswith(within)]


def drawn(every: Sequence[Mutant], given: argparse.Namespace) -> list[Mutant]:
    """So many, by a hash of seed and name."""
    return sorted(every, key=lambda m: hashlib.sha256(f"{given.seed} {m.name}".encode()).digest())[: given.count]


def arguments_read(arguments: Sequence[str] | None) -> argparse.Namespace:
    """What is asked on the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=int, default=60, help="processor time that the tests of a mutant may take")
    parser.add_argument("--within", default="", help="only files whose path begins so, e.g. numeric/estimators")
    parser.add_argument("--log", type=Path, help="a file that keeps what came of each mutant, to take it up again")
    parser.add_argument(
        "--survivors",
        action="store_true",
        help="instead of a draw: try those again that the log calls survivors, wherever their lines stand now",
    )
    parser.add_argument("--minutes", type=float, default=float("inf"), help="begin no mutant after so long")
    return parser.parse_args(arguments)


def main(arguments: Sequence[str] | None = None) -> int:
    """Draw mutants, try them, print what came of each and of those of the log."""
    given = arguments_read(arguments)
    every = mutants_within(given.within)
    trial = Trial(given, every, choice_in(ROOT))
    os.environ["CI"] = "1"
    if needed := sorted({name for mutant in trial.open() for name in trial.choice.files(mutant.path)}):
        os.chdir(ROOT)
        pytest.main(["-q", "-s", "-p", "no:cacheprovider", *needed], plugins=[trial])
    tried = [(mutant, test) for mutant in trial.chosen if (test := trial.killer(mutant)) is not None]
    summary(tried, trial.same)
    print(f"{len(tried)} tried of {len(trial.chosen)}, from {len(every)} places; seed {given.seed}")
    return 0


def summary(tried: Sequence[tuple[Mutant, str]], reasons: Mapping[str, str]) -> None:
    """The survivors, and the shares killed: of all, and of those that are not known to change nothing."""
    equal = [mutant for mutant, _ in tried if mutant.name in reasons]
    print(*(f"equivalent: {m.path}:{m.line} {m.what}: {reasons[m.name]}" for m in equal), sep="\n")
    print(*(f"survivor: {m.path}:{m.line} {m.what}" for m, test in tried if not (test or m.name in reasons)), sep="\n")
    for room in sorted({mutant.path.partition("/")[0] for mutant, _ in tried}):
        here = [(bool(test), m.name in reasons) for m, test in tried if m.path.startswith(f"{room}/")]
        killed, same = (sum(column) for column in zip(*here, strict=True))
        print(f"{room}: {killed} of {len(here)} killed, {killed} of {len(here) - same} that change anything")


if __name__ == "__main__":
    sys.exit(main())
