"""Which tests can notice a change of a file: those that reach it by imports, the nearest first.

Of those, the tests come first that name what is changed: the function or class itself, or others of its file.
"""

from __future__ import annotations

import ast
from collections import deque
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

from tests.mutants.changes import Mutant

ROOMS = ("symbolic", "numeric", "compare", "ridgeback")
Rank: TypeAlias = Callable[[str], tuple[int, int]]
"""Of a test's name in pytest; the tests of the lowest come first."""
FARTHEST = 3
"""Imports between a file and a test of it, at most."""


def home(root: Path, module: str) -> str | None:
    """The file of a module, relative to the tree; None for what is not ours."""
    if not module.startswith("ridgeback."):
        return None
    inner = module.removeprefix("ridgeback.").replace(".", "/") + ".py"
    return next((name for name in (inner, f"ridgeback/{inner}") if (root / name).is_file()), None)


def imports(root: Path, path: Path) -> frozenset[str]:
    """The files of ours that a file imports, anywhere in it."""
    named = list[str]()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module is not None:
            named += [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
        elif isinstance(node, ast.Import):
            named += [alias.name for alias in node.names]
    return frozenset(found for found in (home(root, name) for name in named) if found is not None)


@dataclass(frozen=True)
class Choice:
    """The tests of a file: its examples and its folder's first, then others that reach it."""

    root: Path
    importers: Mapping[str, frozenset[str]]
    """Of each file, those that import it."""

    def distances(self, path: str) -> dict[str, int]:
        """How many imports lie between a file and each test that reaches it."""
        far, waiting = {path: 0}, deque([path])
        while waiting:
            here = waiting.popleft()
            for user in self.importers.get(here, ()):
                if user not in far:
                    far[user] = far[here] + 1
                    waiting.append(user)
        return {name: steps for name, steps in far.items() if name.startswith("tests/")}

    def files(self, path: str) -> list[str]:
        """The tests of a file, the nearest first: its examples, the tests that bear its name, those that import it.

        Then those that reach it through other files, of its room or of the one where rooms meet.
        """
        rooms, reached = (f"tests/{path.partition('/')[0]}/", "tests/compare/"), self.distances(path)
        tests = [name for name, far in reached.items() if far <= FARTHEST and name.startswith(rooms)]

        def near(name: str) -> tuple[bool, int, bool, str]:
            named = Path(name).stem.startswith(f"test_{Path(path).stem}")
            return not named, reached[name], Path(name).parent != Path("tests", path).parent, name

        return [f"ridgeback/{path}", *sorted(tests, key=near)]

    def ranks(self, mutant: Mutant) -> Rank:
        """A key to sort the tests by: whether they name what is changed, or others of its file; then the file."""
        place = {name: at for at, name in enumerate(self.files(mutant.path))}
        tree = ast.parse((self.root / mutant.path).read_text(encoding="utf-8"))
        own, every = defined(tree, mutant.line), defined(tree)
        used = {name: named_in(ast.parse((self.root / name).read_text(encoding="utf-8"))) for name in place}

        def rank(test: str) -> tuple[int, int]:
            file, _, name = test.partition("[")[0].partition("::")
            names = used[file].get(name.rpartition("::")[2], frozenset())
            far = 0 if place[file] == 0 else 1 if names & own else 2 if names & every else 3
            return far, place[file]

        return rank


def defined(tree: ast.Module, line: int | None = None) -> frozenset[str]:
    """The names that a file gives at its top; with a line, only that of the definition around it, and its method's."""
    if line is None:
        return frozenset(name for node in tree.body for name in names_of(node))
    around = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef | ast.ClassDef)]
    return frozenset(node.name for node in around if node.lineno <= line <= (node.end_lineno or line))


def names_of(node: ast.stmt) -> Iterator[str]:
    """What a statement defines."""
    if isinstance(node, ast.FunctionDef | ast.ClassDef):
        yield node.name
    elif isinstance(node, ast.Assign | ast.AnnAssign):
        targets = node.targets if isinstance(node, ast.Assign) else [node.target]
        yield from (target.id for target in targets if isinstance(target, ast.Name))


def named_in(tree: ast.Module) -> dict[str, frozenset[str]]:
    """Of each test of a file, the names that it uses."""
    classes = [inner for node in tree.body if isinstance(node, ast.ClassDef) for inner in node.body]
    return {
        node.name: frozenset(
            inner.id if isinstance(inner, ast.Name) else inner.attr
            for inner in ast.walk(node)
            if isinstance(inner, ast.Name | ast.Attribute)
        )
        for node in (*tree.body, *classes)
        if isinstance(node, ast.FunctionDef)
    }


def choice_in(root: Path) -> Choice:
    """Read the imports of a tree."""
    importers = dict[str, set[str]]()
    files = [path for room in ROOMS for path in (root / room).rglob("*.py") if not path.is_symlink()]
    for path in [*files, *(root / "tests").rglob("test_*.py")]:
        name = str(path.relative_to(root))
        for found in imports(root, path):
            importers.setdefault(found, set()).add(name)
    return Choice(root, {name: frozenset(users) for name, users in importers.items()})
