"""The public names: one list, light to import, each documented, and the type checker's view of them the same."""

from __future__ import annotations

import ast
import inspect
import subprocess
import sys
from pathlib import Path

import pytest

import ridgeback
from ridgeback.public import PUBLIC, home

ROOT = Path(__file__).resolve().parents[3]
HEAVY = ("sympy", "numpy", "scipy", "matplotlib", "flint", "mpmath", "click", "pandas", "xarray")


def run(code: str) -> str:
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=120, check=True)
    return done.stdout.strip()


def test_importing_costs_nothing() -> None:
    look = f"import sys, ridgeback; dir(ridgeback); print([n for n in {HEAVY!r} if n in sys.modules])"
    assert run(look) == "[]"


@pytest.mark.parametrize("entry", PUBLIC, ids=lambda entry: entry.name)
def test_every_name_is_there_and_says_what_it_is(entry) -> None:
    value = getattr(ridgeback, entry.name)
    assert value.__module__ == home(entry)[0]
    assert entry.about
    assert len(entry.about) <= 60
    assert inspect.getdoc(value)


def sections(text: str) -> dict[str, list[str]]:
    """The sections of a numpydoc docstring by their headings; what comes before the first is under ""."""
    lines = text.splitlines()
    heads = [i for i, rule in enumerate(lines[1:]) if rule and set(rule) == {"-"} and lines[i].strip()]
    ends = [*heads[1:], len(lines)]
    found = {lines[i]: lines[i + 2 : end] for i, end in zip(heads, ends, strict=True)}
    return {"": lines[: heads[0]] if heads else lines, **found}


def described(block: list[str]) -> dict[str, str]:
    """Each parameter of a section with the lines below it."""
    found: dict[str, str] = {}
    names: list[str] = []
    for line in block:
        if line and not line[0].isspace():
            names = [name.strip().lstrip("*") for name in line.partition(" : ")[0].split(",")]
            found.update(dict.fromkeys(names, ""))
        found.update({name: f"{found[name]} {line.strip()}" for name in names if line[:1].isspace()})
    return found


CALLABLE = [entry for entry in PUBLIC if entry.name != "InputError"]


@pytest.mark.parametrize("entry", CALLABLE, ids=lambda entry: entry.name)
def test_every_name_documents_each_of_its_parameters_with_returns_and_an_example(entry) -> None:
    value = getattr(ridgeback, entry.name)
    found = sections(inspect.getdoc(value) or "")
    parameters = described(found.get("Parameters", []))
    assert set(parameters) == set(inspect.signature(value).parameters)
    assert all(text.strip() for text in parameters.values()), parameters
    assert inspect.isclass(value) or found.get("Returns")
    assert any(line.startswith(">>> ") for line in found.get("Examples", []))


def test_an_undocumented_parameter_would_be_seen() -> None:
    text = "Do.\n\nParameters\n----------\na, b : int\n    Numbers.\n**more\n    Others.\nlast\n"
    assert described(sections(text)["Parameters"]) == {
        "a": " Numbers.",
        "b": " Numbers.",
        "more": " Others.",
        "last": "",
    }


def test_the_type_checker_sees_the_same_names() -> None:
    """The imports under TYPE_CHECKING are those of the table."""
    tree = ast.parse((ROOT / "ridgeback" / "__init__.py").read_text(encoding="utf-8"))
    guarded = next(node for node in tree.body if isinstance(node, ast.If))
    seen = {
        alias.asname: (node.module, alias.name)
        for node in guarded.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }
    assert seen == {entry.name: home(entry) for entry in PUBLIC}


def test_dir_all_and_help_show_the_names_and_nothing_else() -> None:
    names = {entry.name for entry in PUBLIC}
    assert set(ridgeback.__all__) == names | {"__version__"}
    assert {name for name in dir(ridgeback) if not name.startswith("__")} == names
    text = run("import pydoc, ridgeback; print(pydoc.plain(pydoc.render_doc(ridgeback)))")
    assert all(entry.about in text and entry.group in text for entry in PUBLIC)
    first = [text.index(f"    {entry.name}  ") for entry in PUBLIC]
    assert first == sorted(first)


def test_star_import_gives_every_name() -> None:
    assert run("from ridgeback import *; print(lindstedt('pendulum', 2).frequency, InputError.__name__)") == (
        "(1, 0, -1/16) InputError"
    )


def test_the_one_error_is_a_value_error() -> None:
    assert issubclass(ridgeback.InputError, ValueError)
    for wrong in (
        lambda: ridgeback.lindstedt("no-such-system", 2),
        lambda: ridgeback.estimate([1.0, 2.0], 1.0),
        lambda: ridgeback.estimate([0.0, 1.0] * 99, 1.0, method="no-such-method"),
        lambda: ridgeback.study("pendulum", (2,), [4.0]),
        lambda: ridgeback.simulate("pendulum", (9.0, 0.0)),
        lambda: ridgeback.derive("pendulum", -1),
        lambda: ridgeback.generate("pendulum", "cobol"),
        lambda: ridgeback.identify([0.0, 1.0] * 99, 1.0, candidates=["no-such-class"]),
        lambda: ridgeback.report("pendulum", predict_from=3.0),
        lambda: ridgeback.wigner([0.0, float("nan")] * 20, 1.0),
    ):
        with pytest.raises(ridgeback.InputError) as refused:
            wrong()
        assert "\n" not in str(refused.value)
