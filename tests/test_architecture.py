"""The house's walls: who may import whom, what no room may call, and that the command line starts light."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
ROOMS = ("symbolic", "numeric", "compare", "reports", "ridgeback")

ALLOWED: dict[str, frozenset[str]] = {
    "symbolic": frozenset({"ridgeback.common", "ridgeback.symbolic", "sympy", "flint", "latex2mathml"}),
    "numeric": frozenset(
        {"ridgeback.common", "ridgeback.numeric", "numpy", "scipy", "mpmath", "h5py", "openpyxl", "nptdms"}
    ),
    # sympy is the language in which symbolic hands over expressions; scipy and mpmath are numeric's.
    "compare": frozenset(
        {
            *("ridgeback.common", "ridgeback.compare", "ridgeback.symbolic", "ridgeback.numeric"),
            *("sympy", "numpy", "scipy", "mpmath"),
        }
    ),
    "reports": frozenset(
        {
            *("ridgeback.common", "ridgeback.reports", "ridgeback.compare", "ridgeback.numeric"),
            *("matplotlib", "jinja2", "markupsafe", "latex2mathml", "numpy"),
        }
    ),
    "ridgeback": frozenset({"ridgeback", "click", "numpy"}),
}

# The folders of each room in their order: each may import those before it, never one behind it.
ORDER: dict[str, tuple[str, ...]] = {
    "symbolic": (
        *("arithmetic", "grammar", "systems", "series", "expansion", "high_order", "singularities", "resummation"),
        *("enclosure", "cycles", "flow", "certificates", "codegen"),
    ),
    "numeric": (
        *(
            "signal",
            "harmonics",
            "components",
            "tracking",
            "motion",
            "model_fit",
            "distributions",
            "estimators",
            "orbits",
        ),
        *("files", "recording", "backbone"),
    ),
    "compare": (
        "binding",
        "study",
        "identification",
        "motion",
        "drift",
        "benchmark",
        "noise",
        "studies",
        "recording",
        "report",
    ),
    "reports": ("text", "drawing", "figures"),
    "ridgeback": ("common", "console", "interface", "options", "answers", "verbs"),
}
# Imports by name, which the readers below do not see: the public names, libraries that not everybody has or that take
# long, and the two things that a result asks of the reports, its picture and its page, when somebody asks it for them.
BY_NAME: dict[str, frozenset[str]] = {
    "ridgeback/__init__.py": frozenset({"module"}),
    "ridgeback/cli.py": frozenset({"ridgeback.verbs."}),
    "ridgeback/common/show/optional.py": frozenset({"library"}),
    "ridgeback/common/show/picture.py": frozenset({"ridgeback.reports.pictures"}),
    "ridgeback/common/show/page.py": frozenset({"ridgeback.reports.page"}),
    "compare/binding/heyoka.py": frozenset({"heyoka"}),
    "numeric/late.py": frozenset({"scipy.signal", "scipy.io.wavfile"}),
}
OF_THE_HOUSE = frozenset({"faults", "fuzz", "kill", "mutants", "packaging", "pages"})
"""Folders of tests/ that stand for no folder of a room: what they try goes through the whole house."""
MOST_FILES = 14
MOST_LINES = 400
"""Files in one folder, its ``__init__`` left out."""

# Where coefficients are derived: a float literal here would end exactness silently.
EXACT_FOLDERS = ("symbolic/series", "symbolic/expansion")
EXACT_FILES = (
    "symbolic/arithmetic/truncated.py",
    "symbolic/arithmetic/expression_series.py",
    "symbolic/grammar/to_sympy.py",
    "symbolic/flow/multiple_scales.py",
    "symbolic/flow/ordering.py",
)
INEXACT = ("symbolic/expansion/cost.py", "symbolic/expansion/shown.py")
"""Files of those folders that predict seconds and bytes, or draw what was derived."""

# Names that turn text into code; `lambdify` evaluates a string that it prints itself.
FORBIDDEN_CALLS = frozenset({"eval", "exec", "compile", "__import__", "sympify", "parse_expr", "lambdify", "S"})
FORBIDDEN_MODULES = frozenset({"pickle", "marshal", "shelve", "yaml", "dill", "joblib"})
HEAVY = {"sympy", "scipy", "matplotlib", "numpy", "mpmath", "flint", "jinja2"}
HARMLESS_OWNERS = frozenset({"re"})  # re.compile


def sources(folder: str) -> list[Path]:
    """The files of a folder, without those that a link shows a second time."""
    return [p for p in sorted((ROOT / folder).rglob("*.py")) if not any(above.is_symlink() for above in p.parents)]


def imported(tree: ast.AST) -> Iterator[str]:
    """Dotted name of every import in a file, also inside functions and for type checking only."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def owner(name: str) -> str:
    """Whose an import is: ``ridgeback.room`` for ours, else the top-level package."""
    parts = name.split(".")
    return ".".join(parts[:2]) if parts[0] == "ridgeback" and parts[1:2] else parts[0]


def dotted(path: Path) -> str:
    """A file's name as it is imported."""
    parts = path.relative_to(ROOT).with_suffix("").parts
    parts = parts[:-1] if parts[-1] == "__init__" else parts
    return ".".join(parts if parts[0] == "ridgeback" else ("ridgeback", *parts))


def modules() -> dict[str, Path]:
    """Every file of the project by its dotted name."""
    return {dotted(path): path for room in ROOMS for path in sources(room)}


def graph() -> dict[str, set[str]]:
    """Which file imports which, type-checking imports included."""
    known = modules()

    def home(name: str) -> str | None:
        return name if name in known else above if (above := name.rpartition(".")[0]) in known else None

    return {
        module: {found for name in imported(parsed(path)) if (found := home(name)) is not None} - {module}
        for module, path in known.items()
    }


def circles(arrows: dict[str, set[str]]) -> list[list[str]]:
    """Groups of names that reach one another (Tarjan's strongly connected components of more than one)."""
    index: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    found: list[list[str]] = []

    def visit(name: str) -> None:
        index[name] = low[name] = len(index)
        stack.append(name)
        for other in sorted(arrows.get(name, ())):
            if other not in index:
                visit(other)
                low[name] = min(low[name], low[other])
            elif other in stack:
                low[name] = min(low[name], index[other])
        if low[name] == index[name]:
            group = stack[stack.index(name) :]
            del stack[stack.index(name) :]
            if len(group) > 1:
                found.append(sorted(group))

    for name in sorted(arrows):
        if name not in index:
            visit(name)
    return found


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


def ours_or_allowed(name: str, allowed: frozenset[str]) -> bool:
    """Whether a room may import this: ``ridgeback`` in the table stands for all of ours."""
    return owner(name) in allowed or ("ridgeback" in allowed and owner(name).startswith("ridgeback."))


def imported_by_name(tree: ast.Module) -> Iterator[str]:
    """What a file hands to ``import_module``: text, the text of a constant of the file, else the variable's name."""
    texts = {
        target.id: str(node.value.value)
        for node in tree.body
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Constant)
        for target in node.targets
        if isinstance(target, ast.Name)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and ast.unparse(node.func).rpartition(".")[2] == "import_module":
            match node.args[0]:
                case ast.Constant(value=text):
                    yield str(text)
                case ast.Name(id=name):
                    yield texts.get(name, name)
                case ast.JoinedStr(values=[ast.Constant(value=text), *_]):
                    yield str(text)
                case other:
                    yield ast.unparse(other)


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
    assert circles(graph()) == []


@pytest.mark.parametrize("room", ROOMS)
def test_folders_keep_their_order(room: str) -> None:
    """Each folder of a room imports only those before it in ``ORDER``; every folder stands in it."""
    order = ORDER[room]
    folders = {path.parent.name for path in sources(room) if path.parent.parent == ROOT / room}
    assert folders == set(order)
    backwards = [
        f"{module} imports {other}"
        for module, others in graph().items()
        for other in others
        if (here := folder_of(module, room)) in order
        and (there := folder_of(other, room)) in order
        and order.index(there) > order.index(here)
    ]
    assert not backwards


def folder_of(module: str, room: str) -> str:
    """The folder of a file in a room, empty for what stands elsewhere or beside the folders."""
    prefix = "ridgeback." if room == "ridgeback" else f"ridgeback.{room}."
    return module.removeprefix(prefix).partition(".")[0] if module.startswith(prefix) else ""


def of_the_site() -> list[Path]:
    """The code of the documentation: how the site is built, its gallery, and the example of a plugin."""
    return [path for path in sorted((ROOT / "docs").rglob("*.py")) if "made" not in path.parts]


def test_no_folder_is_crowded() -> None:
    crowd = Counter(path.parent for path in (*modules().values(), *of_the_site()) if path.name != "__init__.py")
    crowded = {str(folder.relative_to(ROOT)): n for folder, n in crowd.items() if n > MOST_FILES}
    assert not crowded


def test_no_file_is_long() -> None:
    files = (*modules().values(), *of_the_site())
    lines = {str(path.relative_to(ROOT)): path.read_text(encoding="utf-8").count("\n") for path in files}
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
