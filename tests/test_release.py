"""Release files say the same: version, licence and libraries of project, citation, recipe and changelog."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
CONDA = {"matplotlib": "matplotlib-base"}
"""Libraries that conda-forge has under another name."""


def text(name: str) -> str:
    return (ROOT / name).read_text(encoding="utf-8")


def test_there_is_one_version() -> None:
    version = PROJECT["version"]
    assert re.findall(r"^version: (.*)$", text("CITATION.cff"), flags=re.M) == [version]
    assert f'{{% set version = "{version}" %}}' in text("recipe/meta.yaml")
    assert re.search(rf"^## {re.escape(version)} \(", text("CHANGELOG.md"), flags=re.M)


def test_the_recipe_asks_for_what_the_project_needs() -> None:
    run = text("recipe/meta.yaml").partition("  run:\n")[2].partition("\ntest:")[0]
    stated = dict(re.findall(r"- (\S+) >=(\S+)", run))
    needed = dict(re.split(">=", line) for line in PROJECT["dependencies"])
    assert stated.pop("python") == PROJECT["requires-python"].removeprefix(">=")
    assert stated == {CONDA.get(name, name): floor for name, floor in needed.items()}


def test_the_citation_has_what_the_format_requires() -> None:
    """The keys that version 1.2.0 of the Citation File Format requires, of the work and of each reference."""
    top, _, references = text("CITATION.cff").partition("references:\n")
    assert {"cff-version", "message", "title", "authors", "license"} <= set(re.findall(r"^([a-z-]+):", top, flags=re.M))
    assert "cff-version: 1.2.0" in top
    for entry in re.split(r"^  - ", references, flags=re.M)[1:]:
        assert {"type", "title", "authors"} <= set(re.findall(r"^(?:    )?([a-z]+):", entry, flags=re.M))
