"""The house's walls: who may import whom, what no room may call, and that the command line starts light."""

from __future__ import annotations

import ast
import sys
from collections import Counter
from pathlib import Path

import pytest

from tests.walls import (
    ALLOWED,
    BY_NAME,
    EXACT_FILES,
    EXACT_FOLDERS,
    FORBIDDEN_MODULES,
    HEAVY,
    INEXACT,
    MOST_FILES,
    MOST_LINES,
    OF_THE_HOUSE,
    ORDER,
    ROOMS,
    ROOT,
    beside,
    circles,
    floats,
    folder_of,
    forbidden_calls,
    graph,
    imported,
    imported_by_name,
    modules,
    of_the_site,
    ours_or_allowed,
    owner,
    parsed,
    run,
    sources,
)


def test_imports_by_name_are_few_and_said() -> None:
    found = {
        str(path.relative_to(ROOT)): names
        for path in modules().values()
        if (names := frozenset(imported_by_name(parsed(path))))
    }
    assert found == BY_NAME


@pytest.mark.parametrize("room", ROOMS)
def test_imports_keep_to_the_table(room: str) -> None:
    allowed = ALLOWED[room] | sys.stdlib_module_names
    found = {
        f"{path.relative_to(ROOT)}: {name}"
        for path in sources(room)
        for name in imported(parsed(path))
        if not ours_or_allowed(name, allowed)
    }
    assert not found, f"{room} may import {sorted(ALLOWED[room])} and the standard library only: {sorted(found)}"


@pytest.mark.parametrize("room", ROOMS)
def test_no_room_turns_text_into_code(room: str) -> None:
    calls = [f"{p.relative_to(ROOT)}: {call}" for p in sources(room) for call in forbidden_calls(parsed(p))]
    modules = [
        f"{p.relative_to(ROOT)}: {name}"
        for p in sources(room)
        for name in imported(parsed(p))
        if owner(name) in FORBIDDEN_MODULES
    ]
    assert not calls + modules


def test_there_is_no_circle_between_files() -> None:
    assert circles(graph(modules())) == []
    around = graph(beside())
    assert sum(map(len, around.values())) > 50
    assert circles(around) == []


@pytest.mark.parametrize("room", ROOMS)
def test_folders_keep_their_order(room: str) -> None:
    """Each folder of a room imports only those before it in ``ORDER``; every folder stands in it."""
    order = ORDER[room]
    folders = {path.parent.name for path in sources(room) if path.parent.parent == ROOT / room}
    assert folders == set(order)
    backwards = [
        f"{module} imports {other}"
        for module, others in graph(modules()).items()
        for other in others
        if (here := folder_of(module, room)) in order
        and (there := folder_of(other, room)) in order
        and order.index(there) > order.index(here)
    ]
    assert not backwards


def house() -> tuple[Path, ...]:
    """All the project's own files of Python."""
    return (*modules().values(), *of_the_site(), *beside().values())


def test_no_folder_is_crowded() -> None:
    crowd = Counter(path.parent for path in house() if path.name != "__init__.py")
    crowded = {str(folder.relative_to(ROOT)): n for folder, n in crowd.items() if n > MOST_FILES}
    assert not crowded


def test_no_file_is_long() -> None:
    lines = {str(path.relative_to(ROOT)): path.read_text(encoding="utf-8").count("\n") for path in house()}
    assert {file: count for file, count in lines.items() if count > MOST_LINES} == {}


def test_every_folder_says_what_lives_there() -> None:
    silent = [
        str(path.parent.relative_to(ROOT))
        for path in modules().values()
        if path.name == "__init__.py" and len((ast.get_docstring(parsed(path)) or "").splitlines()) < 3
    ]
    assert not silent


def test_the_site_turns_no_text_into_code() -> None:
    assert [f"{path.name}: {call}" for path in of_the_site() for call in forbidden_calls(parsed(path))] == []


@pytest.mark.parametrize("room", ROOMS)
def test_the_page_of_the_house_tells_the_folders(room: str) -> None:
    page = (ROOT / "docs" / "explanation" / "house.md").read_text(encoding="utf-8")
    assert f"| `{room}/` | {', '.join(f'`{folder}`' for folder in ORDER[room])} |" in page


@pytest.mark.parametrize("room", ["symbolic", "numeric", "compare"])
def test_a_room_tells_its_folders_in_their_order(room: str) -> None:
    said = " ".join((ast.get_docstring(parsed(ROOT / room / "__init__.py")) or "").split())
    assert ", ".join(ORDER[room]) in said


def test_derivations_hold_no_float() -> None:
    exact = {path for folder in EXACT_FOLDERS for path in sources(folder)} - {ROOT / name for name in INEXACT}
    found = {
        str(path.relative_to(ROOT)): list(floats(parsed(path))) for path in exact | {ROOT / n for n in EXACT_FILES}
    }
    assert not {name: values for name, values in found.items() if values}


@pytest.mark.parametrize("room", ROOMS)
def test_every_room_ships_its_types(room: str) -> None:
    assert (ROOT / room / "py.typed").is_file()
    assert (ROOT / room / "__init__.py").is_file()


def test_tests_mirror_the_rooms() -> None:
    """Each folder of a room has its folder of tests, and a folder of tests stands for one, or is of the whole house.

    A folder further down may be tried in the one that it belongs to.
    """
    folders = {path.parent.relative_to(ROOT) for path in modules().values()}
    tested = {path.parent.relative_to(ROOT / "tests") for path in (ROOT / "tests").rglob("test_*.py")}
    doors = {folder for folder in folders if len(folder.parts) == 2}
    assert sorted(map(str, doors - tested)) == []
    strangers = {folder for folder in tested - folders if folder.parts and folder.parts[0] not in OF_THE_HOUSE}
    assert sorted(map(str, strangers)) == []


def test_tests_are_no_package() -> None:
    """An ``__init__.py`` under tests/ would make a second package of the same name."""
    assert not list((ROOT / "tests").rglob("__init__.py"))


def test_symbolic_and_numeric_stay_strangers_at_run_time() -> None:
    """Also through what they import: no numpy behind symbolic, no sympy behind numeric."""
    load = "import importlib, sys\nfor name in {names!r}:\n    importlib.import_module(name)\n"
    load += "print(' '.join(name for name in sys.modules if name.startswith({forbidden!r})))"
    names = {room: [name for name in modules() if name.startswith(f"ridgeback.{room}.")] for room in ROOMS}
    ours = ("ridgeback.compare", "ridgeback.reports", "ridgeback.console")
    assert run(load.format(names=names["symbolic"], forbidden=("numpy", "scipy", "ridgeback.numeric", *ours))) == ""
    assert run(load.format(names=names["numeric"], forbidden=("sympy", "flint", "ridgeback.symbolic", *ours))) == ""


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
    assert {owner(name) for name in imported(tree)} == {"numpy", "sympy", "pickle"}
    assert [call.split()[0] for call in forbidden_calls(tree)] == ["sympy.lambdify", "eval", "S"]
    assert list(floats(tree)) == ["0.5 on line 5"]
    assert circles({"a": {"b"}, "b": {"c"}, "c": {"b"}, "d": {"a"}}) == [["b", "c"]]
    assert owner("ridgeback.numeric.arrays.Array") == "ridgeback.numeric"
    assert owner("numpy.fft") == "numpy"
