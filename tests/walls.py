"""The walls of the house as data, and the readers that find what stands where in its files."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

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
BESIDE = ("tests", "benchmarks")
"""Folders beside the rooms that are held to their measures: files in a folder, lines in a file, no circles."""
MOST_FILES = 14
"""Files in one folder, its ``__init__`` left out."""
MOST_LINES = 400

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


def beside() -> dict[str, Path]:
    """Every file of tests and benchmarks by its dotted name."""
    return {".".join(path.relative_to(ROOT).with_suffix("").parts): path for top in BESIDE for path in sources(top)}


def graph(known: dict[str, Path]) -> dict[str, set[str]]:
    """Which of some files imports which, type-checking imports included."""

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


def folder_of(module: str, room: str) -> str:
    """The folder of a file in a room, empty for what stands elsewhere or beside the folders."""
    prefix = "ridgeback." if room == "ridgeback" else f"ridgeback.{room}."
    return module.removeprefix(prefix).partition(".")[0] if module.startswith(prefix) else ""


def of_the_site() -> list[Path]:
    """The code of the documentation: how the site is built, its gallery, and the example of a plugin."""
    return [path for path in sorted((ROOT / "docs").rglob("*.py")) if "made" not in path.parts]
