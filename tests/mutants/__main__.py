"""Change the code in one place and see whether its tests notice: ``python -m tests.mutants --count 200 --seed 1``.

A mutant is one changed operator, comparison, constant or condition in the cores of ``symbolic`` and ``numeric``.  It is
killed when the examples of its file or the tests of its folder fail or take ten times as long.  Prints every survivor
with its place, to be looked at, and the share killed; works on a copy of the tree and takes a while on each mutant.
"""

from __future__ import annotations

import argparse
import ast
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from queue import SimpleQueue

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
ARITHMETIC = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.FloorDiv: ast.Mult}
COMPARED = {ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq}
PATIENCE = 10.0
"""How many times as long as the whole code's the tests of a mutant may take."""


@dataclass(frozen=True)
class Mutant:
    """One place of one file; the number counts the places in the order of the tree."""

    path: str
    place: int
    line: int
    what: str


class Changer(ast.NodeTransformer):
    """Walk a tree, note every place that can be changed, and change one of them."""

    def __init__(self, target: int | None = None) -> None:
        self.target, self.found = target, list[tuple[int, str]]()

    def chosen(self, node: ast.expr, what: str) -> bool:
        """Note a place; whether it is the one to be changed."""
        self.found.append((node.lineno, what))
        return len(self.found) - 1 == self.target

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        self.generic_visit(node)
        new = ARITHMETIC.get(type(node.op))
        if new is not None and self.chosen(node, f"{type(node.op).__name__} to {new.__name__}: {ast.unparse(node)}"):
            node.op = new()
        return node

    def visit_Compare(self, node: ast.Compare) -> ast.AST:
        self.generic_visit(node)
        new = COMPARED.get(type(node.ops[0]))
        if new is not None and self.chosen(
            node, f"{type(node.ops[0]).__name__} to {new.__name__}: {ast.unparse(node)}"
        ):
            node.ops[0] = new()
        return node

    def visit_BoolOp(self, node: ast.BoolOp) -> ast.AST:
        self.generic_visit(node)
        if self.chosen(node, f"and, or exchanged: {ast.unparse(node)}"):
            node.op = ast.Or() if isinstance(node.op, ast.And) else ast.And()
        return node

    def visit_IfExp(self, node: ast.IfExp) -> ast.AST:
        self.generic_visit(node)
        if self.chosen(node, f"condition turned: {ast.unparse(node)}"):
            node.test = ast.UnaryOp(ast.Not(), node.test)
        return node

    def visit_Constant(self, node: ast.Constant) -> ast.AST:
        if type(node.value) in (int, float) and self.chosen(node, f"{node.value!r} to {node.value + 1!r}"):
            return ast.copy_location(ast.Constant(node.value + 1), node)
        return node

    def visit_AnnAssign(self, node: ast.AnnAssign) -> ast.AST:
        if node.value is not None:
            node.value = self.visit(node.value)
        return node


def mutants(path: Path) -> Iterator[Mutant]:
    """Every place of a file."""
    changer = Changer()
    changer.visit(ast.parse(path.read_text(encoding="utf-8")))
    yield from (Mutant(str(path.relative_to(ROOT)), i, *found) for i, found in enumerate(changer.found))


def tests_of(path: str) -> list[str]:
    """The examples of a file and the tests of its folder."""
    folder = Path("tests") / Path(path).parent
    return [f"ridgeback/{path}", *([str(folder)] if (ROOT / folder).is_dir() else [])]


def passed(tree: Path, path: str, limit: float | None = None) -> bool:
    """Whether the tests of a file pass in a copy of the tree, in time."""
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", *tests_of(path)]
    environment = {**os.environ, "PYTHONPATH": str(tree), "PYTHONDONTWRITEBYTECODE": "1", "CI": "1"}
    try:
        done = subprocess.run(command, cwd=tree, env=environment, capture_output=True, timeout=limit, check=False)
    except subprocess.TimeoutExpired:
        return False
    return done.returncode == 0


@cache
def usual(tree: Path, folder: str, path: str) -> float:
    """Seconds that the tests of the unchanged code take; they must pass."""
    begin = time.monotonic()
    if not passed(tree, path):
        raise SystemExit(f"the tests of {path} fail as they are (in {folder})")
    return time.monotonic() - begin


def survives(tree: Path, mutant: Mutant) -> bool:
    """Whether no test notices a mutant."""
    file = tree / mutant.path
    limit = 30.0 + PATIENCE * usual(tree, str(Path(mutant.path).parent), mutant.path)
    whole = file.read_text(encoding="utf-8")
    changed = Changer(mutant.place).visit(ast.parse(whole))
    try:
        file.write_text(ast.unparse(ast.fix_missing_locations(changed)), encoding="utf-8")
        return passed(tree, mutant.path, limit)
    finally:
        file.write_text(whole, encoding="utf-8")


def main(arguments: Sequence[str] | None = None) -> int:
    """Draw mutants, try them, print what came of each."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--within", default="", help="only files whose path begins so, e.g. numeric/estimators")
    given = parser.parse_args(arguments)
    files = [path for core in CORES for path in sorted((ROOT / core).glob("*.py")) if path.name != "__init__.py"]
    every = [m for path in files for m in mutants(path) if m.path.startswith(given.within)]
    drawn = random.Random(given.seed).sample(every, min(given.count, len(every)))  # noqa: S311 - a draw, no secret
    with tempfile.TemporaryDirectory(prefix="ridgeback-mutants-") as name:
        trees: SimpleQueue[Path] = SimpleQueue()
        for i in range(given.jobs):
            copy = Path(name) / str(i)
            shutil.copytree(ROOT, copy, symlinks=True, ignore=shutil.ignore_patterns(".*", "__pycache__"))
            trees.put(copy)

        def attempt(mutant: Mutant) -> bool:
            tree = trees.get()
            try:
                alive = survives(tree, mutant)
            finally:
                trees.put(tree)
            print(f"{'SURVIVED' if alive else 'killed  '} {mutant.path}:{mutant.line} {mutant.what}", flush=True)
            return alive

        with ThreadPoolExecutor(given.jobs) as pool:
            alive = sum(pool.map(attempt, drawn))
    print(f"{len(drawn) - alive} of {len(drawn)} mutants killed, of {len(every)} places; seed {given.seed}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
