"""The examples of the README and of every page in docs/ are true: what is printed is what they say.

On each page the blocks ``console`` (commands with their output), ``pycon`` (doctests) and ``python`` run in their
order, in one namespace and one empty folder, as a reader would type them.  Of ``sh`` blocks, whose commands may take
minutes, every verb and option must exist.
"""

from __future__ import annotations

import doctest
import re
import shlex
from pathlib import Path

import pytest

from ridgeback.cli import main

ROOT = Path(__file__).parent.parent
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
FENCED = re.compile(r"^```(\w+)\n(.*?)^```", flags=re.DOTALL | re.MULTILINE)
FLAGS = doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS


def name_of(page: Path) -> str:
    return str(page.relative_to(ROOT))


def blocks(page: Path, *languages: str) -> list[tuple[str, str]]:
    """Language and text of the blocks of code on a page, in their order."""
    found = FENCED.findall(page.read_text(encoding="utf-8"))
    return [(language, text) for language, text in found if language in languages]


def runs_console(text: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Each ``$ command`` prints what stands below it; line breaks may be elsewhere."""
    for command, output in re.findall(r"\$ (.*)\n((?:(?!\$ ).*\n)*)", text):
        program, *arguments = shlex.split(command)
        assert program == "ridgeback"
        capsys.readouterr()
        assert main(arguments) == 0, command
        assert capsys.readouterr().out.split() == output.split(), command


def runs_doctest(text: str, names: dict[str, object], page: str) -> None:
    """Each ``>>>`` gives what stands below it."""
    runner = doctest.DocTestRunner(optionflags=FLAGS)
    found = doctest.DocTestParser().get_doctest(text, names, page, page, 0)
    found.globs = names
    said: list[str] = []
    assert runner.run(found, out=said.append, clear_globs=False).failed == 0, "".join(said)


@pytest.mark.parametrize("page", [p for p in PAGES if blocks(p, "console", "pycon", "python")], ids=name_of)
def test_examples_are_true(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    for language, text in blocks(page, "console", "pycon", "python"):
        if language == "console":
            runs_console(text, capsys)
        elif language == "pycon":
            runs_doctest(text, names, name_of(page))
        else:
            exec(compile(text, name_of(page), "exec"), names)  # noqa: S102 - our own text


def test_shell_examples_name_options_that_exist(capsys: pytest.CaptureFixture[str]) -> None:
    lines = [line for page in PAGES for _, text in blocks(page, "sh") for line in text.splitlines()]
    used = [shlex.split(line, comments=True) for line in lines if line.startswith("ridgeback ")]
    assert len(used) >= 6
    helps: dict[str, str] = {}
    for _, verb, *rest in used:
        if verb not in helps:
            assert main([verb, "--help"]) == 0
            helps[verb] = capsys.readouterr().out
        assert all(word in helps[verb] for word in rest if re.fullmatch(r"--[a-z-]+|-[a-z]", word)), (verb, rest)


def test_links_between_pages_lead_somewhere() -> None:
    broken = [
        f"{name_of(page)}: {target}"
        for page in PAGES
        for target in re.findall(r"\]\((?!https?:|#)([^)#\s]+)", page.read_text(encoding="utf-8"))
        if "/made/" not in f"/{target}" and not (page.parent / target).exists()
    ]
    assert broken == []


def test_the_benchmark_table_is_the_one_that_was_measured() -> None:
    table = ROOT / "benchmarks" / "table.md"
    assert table.read_text(encoding="utf-8") in (ROOT / "docs" / "results" / "speed.md").read_text(encoding="utf-8")
