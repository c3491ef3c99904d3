"""Change the code in one place and see whether its tests notice: ``python -m tests.mutants --count 200 --seed 1``.

A mutant is one changed operator, comparison, constant or condition in the cores of ``symbolic`` and ``numeric``.  It
is killed when a test fails or hangs: first the examples of its file and the tests of its folder, then further tests
that reach it by imports, the nearest first, for a minute.  Prints every survivor with its place, to be looked at, and
the share killed; works on a copy of the tree and takes a while on each mutant.
"""

from __future__ import annotations

import argparse
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from queue import SimpleQueue
from xml.etree import ElementTree

from tests.mutants.changes import Mutant, changed, places
from tests.mutants.choice import Choice, choice_in

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
PATIENCE, AT_LEAST = 10.0, 60.0
"""How many times as long as on unchanged code the tests of a mutant may take, and what they may take in any case."""
MOST_MEMORY = 6_000_000_000


def limited() -> None:
    """Keep a mutant from taking the machine's memory."""
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))


def outcome(tree: Path, tests: Sequence[str], limit: float | None, *more: str) -> int | None:
    """The exit code of these tests in a copy of the tree; None when they ran past the limit."""
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *more, *tests]
    environment = {**os.environ, "PYTHONPATH": str(tree), "PYTHONDONTWRITEBYTECODE": "1", "CI": "1"}
    with subprocess.Popen(
        command,
        cwd=tree,
        env=environment,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
        preexec_fn=limited,  # noqa: PLW1509 - the threads here only wait
    ) as process:
        try:
            return process.wait(limit)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            return None


def usual_seconds(tree: Path, tests: Sequence[str]) -> dict[str, float]:
    """What each file of tests takes on the unchanged code, on which all must pass."""
    report = tree / "times.xml"
    if outcome(tree, tests, None, f"--junit-xml={report}", "-o", "junit_family=xunit1") != 0:
        raise SystemExit("the tests fail on the unchanged code")
    spent = Counter[str]()
    for case in ElementTree.parse(report).iter("testcase"):  # noqa: S314 - written by the run above
        spent[case.get("file", "")] += float(case.get("time", 0.0))  # type: ignore[assignment]
    report.unlink()
    return {test: float(spent[test]) for test in tests}


def survives(tree: Path, mutant: Mutant, choice: Choice, seconds: Mapping[str, float]) -> bool:
    """Whether no test notices a mutant."""
    file = tree / mutant.path
    whole = file.read_text(encoding="utf-8")
    rounds = (choice.near(mutant.path), choice.far(mutant.path, seconds))
    try:
        file.write_text(changed(whole, mutant.place), encoding="utf-8")
        return all(
            outcome(tree, tests, AT_LEAST + PATIENCE * sum(seconds[t] for t in tests), "-x") in (0, 5)
            for tests in rounds
            if tests
        )
    finally:
        file.write_text(whole, encoding="utf-8")


def drawn(count: int, seed: int, within: str) -> tuple[list[Mutant], int]:
    """So many mutants, and the number of places that they are drawn from."""
    files = [path for core in CORES for path in sorted((ROOT / core).glob("*.py")) if path.name != "__init__.py"]
    every = [m for path in files for m in places(ROOT, path) if m.path.startswith(within)]
    return random.Random(seed).sample(every, min(count, len(every))), len(every)  # noqa: S311 - a draw, no secret


def main(arguments: Sequence[str] | None = None) -> int:
    """Draw mutants, try them, print what came of each."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--within", default="", help="only files whose path begins so, e.g. numeric/estimators")
    given = parser.parse_args(arguments)
    chosen, places_in_all = drawn(given.count, given.seed, given.within)
    choice = choice_in(ROOT)
    with tempfile.TemporaryDirectory(prefix="ridgeback-mutants-") as name:
        trees: SimpleQueue[Path] = SimpleQueue()
        for i in range(given.jobs):
            copy = Path(name) / str(i)
            shutil.copytree(ROOT, copy, symlinks=True, ignore=shutil.ignore_patterns(".*", "__pycache__"))
            trees.put(copy)
        seconds = usual_seconds(Path(name) / "0", choice.all_of([mutant.path for mutant in chosen]))
        print(f"{len(seconds)} files of tests take {sum(seconds.values()):.0f} s on the unchanged code", flush=True)

        def attempt(mutant: Mutant) -> tuple[str, bool]:
            tree = trees.get()
            try:
                alive = survives(tree, mutant, choice, seconds)
            finally:
                trees.put(tree)
            print(f"{'SURVIVED' if alive else 'killed  '} {mutant.path}:{mutant.line} {mutant.what}", flush=True)
            return mutant.path.partition("/")[0], alive

        with ThreadPoolExecutor(given.jobs) as pool:
            found = list(pool.map(attempt, chosen))
    for room in sorted({room for room, _ in found}):
        here = [alive for of, alive in found if of == room]
        print(f"{room}: {len(here) - sum(here)} of {len(here)} killed")
    print(
        f"{sum(not a for _, a in found)} of {len(found)} mutants killed, of {places_in_all} places; seed {given.seed}"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
