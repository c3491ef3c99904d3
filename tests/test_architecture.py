"""The house's walls: who may import whom, what no room may call, and that the command line starts light."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
ROOMS = ("symbolic", "numeric", "compare", "reports", "ridgeback")

ALLOWED: dict[str, frozenset[str]] = {
    "symbolic": frozenset({"symbolic", "sympy", "flint", "latex2mathml"}),
    "numeric": frozenset({"numeric", "numpy", "scipy", "mpmath", "h5py"}),
    # sympy is the language in which symbolic hands over expressions; scipy and mpmath are numeric's.
    "compare": frozenset({"compare", "symbolic", "numeric", "sympy", "numpy", "scipy", "mpmath"}),
    "reports": frozenset({"reports", "compare", "matplotlib", "jinja2", "markupsafe", "latex2mathml", "numpy"}),
    "ridgeback": frozenset({*ROOMS, "click", "numpy"}),
}

# Where coefficients are derived: a float literal here would end exactness silently.
DERIVATIONS = (
    "series",
    "recurrences",
    "spaces",
    "modular",
    "amplitude",
    "ordering",
    "truncated",
    "fourier",
    "rings",
    "lindstedt",
    "strained",
    "limit_cycle",
    "multiple_scales",
    "energy_integral",
    "convert",
)

# Names that turn text into code; `lambdify` evaluates a string that it prints itself.
FORBIDDEN_CALLS = frozenset({"eval", "exec", "compile", "__import__", "sympify", "parse_expr", "lambdify", "S"})
FORBIDDEN_MODULES = frozenset({"pickle", "marshal", "shelve", "yaml", "dill", "joblib"})
HEAVY = {"sympy", "scipy", "matplotlib", "numpy", "mpmath", "flint", "jinja2"}
HARMLESS_OWNERS = frozenset({"re"})  # re.compile


def sources(room: str) -> list[Path]:
    return sorted((ROOT / room).rglob("*.py"))


def imported(tree: ast.AST) -> Iterator[str]:
    """Top-level package of every import in a file, also inside functions; relative ones stay in the room."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name.partition(".")[0] for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
            yield node.module.partition(".")[0]


def forbidden_calls(tree: ast.AST) -> Iterator[str]:
    for node in ast.walk(tree):
        if not isinstance(node, ast.Call):
            continue
        match node.func:
            case ast.Name(id=name) if name in FORBIDDEN_CALLS:
                yield f"{name} on line {node.lineno}"
            case ast.Attribute(value=ast.Name(id=owner), attr=name) if name in FORBIDDEN_CALLS - {"S"}:
                if owner not in HARMLESS_OWNERS:
                    yield f"{owner}.{name} on line {node.lineno}"
            case ast.Attribute(value=ast.Name(id="sympy"), attr="S"):
                yield f"sympy.S(...) on line {node.lineno}"


def floats(tree: ast.AST) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, (float, complex)):
            yield f"{node.value!r} on line {node.lineno}"


def parsed(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"), filename=str(path))


def run(code: str) -> str:
    """Standard output of a fresh interpreter that starts in the project's root."""
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, timeout=120, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


@pytest.mark.parametrize("room", ROOMS)
def test_imports_keep_to_the_table(room: str) -> None:
    allowed = ALLOWED[room] | sys.stdlib_module_names
    found = {
        f"{path.relative_to(ROOT)}: {name}"
        for path in sources(room)
        for name in imported(parsed(path))
        if name not in allowed
    }
    assert not found, f"{room} may import {sorted(ALLOWED[room])} and the standard library only: {sorted(found)}"


@pytest.mark.parametrize("room", ROOMS)
def test_no_room_turns_text_into_code(room: str) -> None:
    calls = [f"{p.relative_to(ROOT)}: {call}" for p in sources(room) for call in forbidden_calls(parsed(p))]
    modules = [
        f"{p.relative_to(ROOT)}: {name}"
        for p in sources(room)
        for name in imported(parsed(p))
        if name in FORBIDDEN_MODULES
    ]
    assert not calls + modules


@pytest.mark.parametrize("name", DERIVATIONS)
def test_derivations_hold_no_float(name: str) -> None:
    path = ROOT / "symbolic" / f"{name}.py"
    assert path.exists(), f"{path.name} is gone: bring the list of derivation modules up to date"
    assert not list(floats(parsed(path)))


@pytest.mark.parametrize("room", ROOMS)
def test_every_room_ships_its_types(room: str) -> None:
    assert (ROOT / room / "py.typed").is_file()
    assert (ROOT / room / "__init__.py").is_file()


def test_tests_are_no_package() -> None:
    """An ``__init__.py`` under tests/ would shadow the rooms of the same name."""
    assert not list((ROOT / "tests").rglob("__init__.py"))


def test_symbolic_and_numeric_stay_strangers_at_run_time() -> None:
    """Also through what they import: no numpy behind symbolic, no sympy behind numeric."""
    load = (
        "import importlib, pathlib, sys\n"
        "for path in sorted(pathlib.Path({room!r}).rglob('*.py')):\n"
        "    parts = path.with_suffix('').parts\n"
        "    importlib.import_module('.'.join(parts[:-1] if parts[-1] == '__init__' else parts))\n"
        "print(' '.join(sorted({{name.partition('.')[0] for name in sys.modules}} & {forbidden!r})))"
    )
    assert run(load.format(room="symbolic", forbidden={"numpy", "scipy", "matplotlib", "numeric", "ridgeback"})) == ""
    assert run(load.format(room="numeric", forbidden={"sympy", "flint", "symbolic", "ridgeback"})) == ""


@pytest.mark.parametrize("arguments", [["--help"], ["--version"], ["derive", "--help"], ["report", "--help"]])
def test_help_loads_nothing_heavy(arguments: list[str]) -> None:
    heavy = run(
        "import contextlib, io, sys\n"
        "from ridgeback.cli import main\n"
        "with contextlib.redirect_stdout(io.StringIO()):\n"
        f"    code = main({arguments!r})\n"
        "assert code == 0, code\n"
        f"print(' '.join({HEAVY!r} & set(sys.modules)))"
    )
    assert heavy == ""


def test_the_walls_are_seen() -> None:
    """The readers above find what they are meant to find."""
    tree = ast.parse(
        "import numpy.fft\nfrom sympy import S\ndef f():\n    from pickle import loads\n"
        "    return sympy.lambdify(x), eval('1'), re.compile('x'), S('x'), 0.5, from_\n"
    )
    assert set(imported(tree)) == {"numpy", "sympy", "pickle"}
    assert [call.split()[0] for call in forbidden_calls(tree)] == ["sympy.lambdify", "eval", "S"]
    assert list(floats(tree)) == ["0.5 on line 5"]
