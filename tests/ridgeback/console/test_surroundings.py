"""What ``doctor`` says: true of this environment, and of what the house itself looks for."""

from __future__ import annotations

import json
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest

from ridgeback.console import surroundings
from ridgeback.console.surroundings import EXTRAS, NEEDED, PROGRAMS, about, parts
from ridgeback.symbolic.codegen.languages.registry import OURS

PROJECT = tomllib.loads((Path(__file__).parents[3] / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def test_it_knows_every_library_of_the_project() -> None:
    assert set(NEEDED) == {text.partition(">=")[0] for text in PROJECT["dependencies"]}
    stated = {
        text.partition(">=")[0]: extra
        for extra in ("hdf5", "excel", "tables", "heyoka", "distributed", "studies")
        for text in PROJECT["optional-dependencies"][extra]
    }
    assert set(EXTRAS) == set(stated)


def test_it_knows_every_tool_that_checks_generated_code() -> None:
    tools = {language.tool for language in OURS if language.tool and "python" not in language.name}
    assert tools - {commands for commands, _ in PROGRAMS.values()} <= {("python3", "python")}


def test_versions_are_those_that_are_imported() -> None:
    assert next(part.found for part in parts() if part.name == "numpy") == np.__version__
    assert not any(part.wrong for part in parts())


def test_a_library_too_old_is_wrong_and_says_what_would_do(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from ridgeback.cli import main

    real = surroundings.installed
    monkeypatch.setattr(surroundings, "installed", lambda name: "0.9" if name == "scipy" else real(name))
    assert main(["doctor"]) == 4
    shown = capsys.readouterr()
    assert "scipy is 0.9: pip install 'scipy>=1.13'" in shown.err
    assert "python-flint" in shown.out


def test_json_holds_every_part_and_nothing_heavy_is_imported() -> None:
    code = (
        "import sys; from ridgeback.cli import main; code = main(['doctor', '--format', 'json']); "
        "heavy = {'sympy', 'scipy', 'matplotlib', 'numpy', 'mpmath', 'flint', 'jinja2'} & set(sys.modules); "
        "assert not heavy, heavy; sys.exit(code)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert json.loads(done.stdout) == about()
