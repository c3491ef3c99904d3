"""Which tests can notice a change of a file: those that reach it by imports, the nearest first."""

from __future__ import annotations

import ast
from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

ROOMS = ("symbolic", "numeric", "compare", "ridgeback")
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

    def near(self, path: str) -> list[str]:
        """The examples of a file and the tests of its folder."""
        folder = self.root / "tests" / Path(path).parent
        return [f"ridgeback/{path}", *(str(test.relative_to(self.root)) for test in sorted(folder.glob("test_*.py")))]

    def others(self, path: str) -> dict[str, int]:
        """Further tests of its room and of the one where rooms meet that reach a file, with their distances."""
        rooms, near = (f"tests/{path.partition('/')[0]}/", "tests/compare/"), set(self.near(path))
        reached = self.distances(path)
        return {t: far for t, far in reached.items() if t not in near and far <= FARTHEST and t.startswith(rooms)}

    def far(self, path: str) -> list[str]:
        """The others, the nearest first."""
        others = self.others(path)
        return sorted(others, key=lambda test: (others[test], test))


def choice_in(root: Path) -> Choice:
    """Read the imports of a tree."""
    importers = dict[str, set[str]]()
    files = [path for room in ROOMS for path in (root / room).rglob("*.py") if not path.is_symlink()]
    for path in [*files, *(root / "tests").rglob("test_*.py")]:
        name = str(path.relative_to(root))
        for found in imports(root, path):
            importers.setdefault(found, set()).add(name)
    return Choice(root, {name: frozenset(users) for name, users in importers.items()})
