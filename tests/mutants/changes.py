"""The changes: one operator, comparison, constant or condition of a file at a time."""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ARITHMETIC = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.FloorDiv: ast.Mult}
COMPARED = {ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq}


@dataclass(frozen=True)
class Mutant:
    """One place of one file; the number counts the places in the order of the tree."""

    path: str
    place: int
    line: int
    what: str
    text: str
    """The line as it stands in the file."""
    nth: int
    """Which of those of the file that say the same of the same line; 1 but for doubles."""

    @property
    def name(self) -> str:
        """What it is called wherever the file's other lines may have moved it."""
        return f"{self.path}: {self.text}: {self.what}" + (f" ({self.nth})" if self.nth > 1 else "")


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


def places(root: Path, path: Path) -> Iterator[Mutant]:
    """Every place of a file of the tree under ``root``."""
    changer, text = Changer(), path.read_text(encoding="utf-8")
    changer.visit(ast.parse(text))
    lines, seen = text.splitlines(), Counter[tuple[str, str]]()
    for i, (number, what) in enumerate(changer.found):
        line = lines[number - 1].strip()
        seen[line, what] += 1
        yield Mutant(str(path.relative_to(root)), i, number, what, line, seen[line, what])


def changed(text: str, place: int) -> str:
    """The text of a file with one place changed."""
    return ast.unparse(ast.fix_missing_locations(Changer(place).visit(ast.parse(text))))
