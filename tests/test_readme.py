"""The examples of the README and of every page in docs/ are true: console lines print what they say, Python runs."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator
from pathlib import Path

import pytest

from ridgeback.cli import main

ROOT = Path(__file__).parent.parent
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]


def name_of(page: Path) -> str:
    return str(page.relative_to(ROOT))


def blocks(page: Path, language: str) -> list[str]:
    """The blocks of code of one language on a page."""
    return re.findall(rf"^```{language}\n(.*?)^```", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)


def console_examples() -> Iterator[tuple[str, str]]:
    """Each ``$ command`` of a console block with the output printed below it."""
    for page in PAGES:
        for block in blocks(page, "console"):
            yield from re.findall(r"\$ (.*)\n((?:(?!\$ ).*\n)*)", block)


@pytest.mark.parametrize("example", list(console_examples()), ids=lambda e: e[0])
def test_console_examples_print_what_they_say(example: tuple[str, str], capsys: pytest.CaptureFixture[str]) -> None:
    command, output = example
    program, *arguments = shlex.split(command)
    assert program == "ridgeback"
    assert main(arguments) == 0
    assert words(capsys.readouterr().out) == words(output)


def words(text: str) -> list[str]:
    """The text without its line breaks, which a page may put elsewhere."""
    return text.split()


def test_shell_examples_name_options_that_exist(capsys: pytest.CaptureFixture[str]) -> None:
    lines = [line for page in PAGES for block in blocks(page, "sh") for line in block.splitlines()]
    used = [shlex.split(line, comments=True) for line in lines if line.startswith("ridgeback ")]
    assert len(used) >= 6
    for _, verb, *rest in used:
        assert main([verb, "--help"]) == 0
        known = capsys.readouterr().out
        assert all(word in known for word in rest if re.fullmatch(r"--[a-z-]+|-[a-z]", word)), (verb, rest)


@pytest.mark.parametrize("page", [page for page in PAGES if blocks(page, "python")], ids=name_of)
def test_python_examples_run(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """One after the other in one namespace, as a reader would type them, in an empty folder."""
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    for block in blocks(page, "python"):
        exec(compile(block, name_of(page), "exec"), names)  # noqa: S102 - our own text


def test_links_between_pages_lead_somewhere() -> None:
    broken = [
        f"{name_of(page)}: {target}"
        for page in PAGES
        for target in re.findall(r"\]\((?!https?:|#)([^)#]+)", page.read_text(encoding="utf-8"))
        if not (page.parent / target).exists()
    ]
    assert broken == []


def test_the_benchmark_table_is_the_one_that_was_measured() -> None:
    table = ROOT / "benchmarks" / "table.md"
    assert table.read_text(encoding="utf-8") in (ROOT / "docs" / "results" / "speed.md").read_text(encoding="utf-8")
