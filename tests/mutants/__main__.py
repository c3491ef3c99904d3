"""Change the code in one place and see whether its tests notice: ``python -m tests.mutants --count 200 --seed 1``.

A mutant is one changed operator, comparison, constant or condition in the cores of ``symbolic`` and ``numeric``.  It
is killed when a test fails that passes on the unchanged code, or hangs: first the examples of its file and the tests of
its folder, then further tests that reach it by imports, the nearest first, as long as FAR seconds of processor time
last.  Prints every mutant with the test that killed it, the survivors to be looked at, and the share killed; works on
a copy of the tree and takes a while on each mutant.
"""

from __future__ import annotations

import argparse
import os
import random
import shutil
import sys
import tempfile
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path
from queue import SimpleQueue

from tests.mutants.changes import Mutant, changed, places
from tests.mutants.choice import Choice, choice_in
from tests.mutants.processes import tried

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
NEAR, FAR = 300, 20
"""Processor seconds that the two rounds of tests may take: in the first more is a hang, in the second it is enough."""


def killer(tree: Path, mutant: Mutant, choice: Choice) -> str:
    """The test that notices a mutant; empty for a survivor."""
    file = tree / mutant.path
    whole = file.read_text(encoding="utf-8")
    try:
        file.write_text(changed(whole, mutant.place), encoding="utf-8")
        near = tried(tree, choice.near(mutant.path), NEAR)
        if not near.passed:
            return near.failed or "a hang"
        far = choice.far(mutant.path)
        return tried(tree, far, FAR).failed if far else ""
    finally:
        file.write_text(whole, encoding="utf-8")


@cache
def sound(tree: Path, test: str) -> bool:
    """Whether a test passes on the unchanged code, so that its failure means something."""
    return tried(tree, [test], NEAR).passed


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
    parser.add_argument("--skip", type=int, default=0, help="leave out so many of those drawn, tried elsewhere")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--within", default="", help="only files whose path begins so, e.g. numeric/estimators")
    given = parser.parse_args(arguments)
    chosen, places_in_all = drawn(given.count, given.seed, given.within)
    chosen = chosen[given.skip :]
    choice = choice_in(ROOT)
    with tempfile.TemporaryDirectory(prefix="ridgeback-mutants-") as name:
        trees: SimpleQueue[Path] = SimpleQueue()
        for i in range(given.jobs):
            copy = Path(name) / str(i)
            shutil.copytree(ROOT, copy, symlinks=True, ignore=shutil.ignore_patterns(".*", "__pycache__"))
            trees.put(copy)

        def attempt(mutant: Mutant) -> tuple[str, bool]:
            tree = trees.get()
            try:
                test = killer(tree, mutant, choice)
                if "::" in test and not sound(tree, test):
                    print(f"{test} fails on the unchanged code", flush=True)
                    test = ""
            finally:
                trees.put(tree)
            came = f"killed by {test}" if test else "SURVIVED"
            print(f"{mutant.path}:{mutant.line} {mutant.what}: {came}", flush=True)
            return mutant.path.partition("/")[0], not test

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
