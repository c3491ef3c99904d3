"""Change the code in one place and see whether its tests notice: ``python -m tests.mutants --count 200 --seed 1``.

A mutant is one changed operator, comparison, constant or condition in the cores of ``symbolic`` and ``numeric``.  It
is killed when a test fails, or does not end, that passes on the unchanged code: first the examples of its file and the
tests that bear its name, then those that import it, then those that reach it through other files, for so many seconds
of processor time as ``--seconds`` says.  The tests are collected once; every mutant lives in a copy of that process.
Prints every mutant with the test that killed it, the survivors to be looked at, and the share killed.  With ``--log``
it takes up where it stopped, and tries again those whose file has changed and, with ``--survivors``, those that
survived.
"""

from __future__ import annotations

import argparse
import os
import random
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import pytest

from tests.mutants.changes import Mutant, places
from tests.mutants.choice import Choice, choice_in
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

    def __init__(self, given: argparse.Namespace, chosen: Sequence[Mutant], choice: Choice) -> None:
        self.given, self.chosen, self.choice = given, chosen, choice
        self.log, self.found = Log(ROOT, given.log), list[tuple[Mutant, str | None]]()

    def open(self) -> list[Mutant]:
        """Those that no log knows."""
        known = [(mutant, self.log.killer(mutant)) for mutant in self.chosen]
        return [mutant for mutant, test in known if test is None or (not test and self.given.survivors)]

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        tests, last = Tests(session.items, ROOT), time.monotonic() + 60.0 * self.given.minutes
        for mutant in self.open():
            if time.monotonic() > last:
                break
            test = tests.killer(mutant, self.choice.files(mutant.path), self.given.seconds)
            self.say(mutant, test)
            if test is not None:
                self.log.note(mutant, test)
        return True

    @staticmethod
    def say(mutant: Mutant, test: str | None) -> None:
        came = f"killed by {test}" if test else "SURVIVED" if test == "" else "shows in no copy of a process"
        print(f"{mutant.path}:{mutant.line} {mutant.what}: {came}", flush=True)


def drawn(count: int, seed: int, within: str) -> tuple[list[Mutant], int]:
    """So many mutants, and the number of places that they are drawn from."""
    files = [path for core in CORES for path in sorted((ROOT / core).glob("*.py")) if path.name != "__init__.py"]
    every = [m for path in files for m in places(ROOT, path) if m.path.startswith(within)]
    return random.Random(seed).sample(every, min(count, len(every))), len(every)  # noqa: S311 - a draw, no secret


def arguments_read(arguments: Sequence[str] | None) -> argparse.Namespace:
    """What is asked on the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=int, default=60, help="processor time that the tests of a mutant may take")
    parser.add_argument("--within", default="", help="only files whose path begins so, e.g. numeric/estimators")
    parser.add_argument("--log", type=Path, help="a file that keeps what came of each mutant, to take it up again")
    parser.add_argument("--survivors", action="store_true", help="try those again that the log calls survivors")
    parser.add_argument("--minutes", type=float, default=float("inf"), help="begin no mutant after so long")
    return parser.parse_args(arguments)


def main(arguments: Sequence[str] | None = None) -> int:
    """Draw mutants, try them, print what came of each and of those of the log."""
    given = arguments_read(arguments)
    chosen, places_in_all = drawn(given.count, given.seed, given.within)
    trial = Trial(given, chosen, choice_in(ROOT))
    os.environ["CI"] = "1"
    if needed := sorted({name for mutant in trial.open() for name in trial.choice.files(mutant.path)}):
        os.chdir(ROOT)
        pytest.main(["-q", "-s", "-p", "no:cacheprovider", *needed], plugins=[trial])
    killers = [(mutant, trial.log.killer(mutant)) for mutant in chosen]
    found = [(mutant, test) for mutant, test in killers if test is not None]
    print(*(f"survivor: {m.path}:{m.line} {m.what}" for m, test in found if not test), sep="\n")
    for room in sorted({mutant.path.partition("/")[0] for mutant, _ in found}):
        here = [test for mutant, test in found if mutant.path.startswith(f"{room}/")]
        print(f"{room}: {sum(map(bool, here))} of {len(here)} killed")
    print(
        f"{sum(bool(test) for _, test in found)} of {len(found)} mutants killed,"
        f" of {len(chosen)} drawn from {places_in_all} places; seed {given.seed}"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
