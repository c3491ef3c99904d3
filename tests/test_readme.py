"""The README's examples are true: its console lines print what they say, its Python runs."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

from ridgeback.cli import main

README = (Path(__file__).parent.parent / "README.md").read_text(encoding="utf-8")


def console_examples() -> list[tuple[str, str]]:
    """Each ``$ command`` of a console block with the output printed below it."""
    blocks = re.findall(r"```console\n(.*?)```", README, flags=re.DOTALL)
    return [
        (command, output) for block in blocks for command, output in re.findall(r"\$ (.*)\n((?:(?!\$ ).*\n)*)", block)
    ]


@pytest.mark.parametrize("example", console_examples(), ids=lambda e: e[0])
def test_console_examples_print_what_they_say(example: tuple[str, str], capsys: pytest.CaptureFixture[str]) -> None:
    command, output = example
    program, *arguments = shlex.split(command)
    assert program == "ridgeback"
    assert main(arguments) == 0
    assert words(capsys.readouterr().out) == words(output)


def words(text: str) -> list[str]:
    """The text without its line breaks, which the README may put elsewhere."""
    return text.split()


def test_shell_examples_name_options_that_exist(capsys: pytest.CaptureFixture[str]) -> None:
    lines = [line for block in re.findall(r"```sh\n(.*?)```", README, flags=re.DOTALL) for line in block.splitlines()]
    used = [shlex.split(line, comments=True) for line in lines if line.startswith("ridgeback ")]
    assert len(used) >= 6
    for _, verb, *rest in used:
        assert main([verb, "--help"]) == 0
        known = capsys.readouterr().out
        assert all(word in known for word in rest if re.fullmatch(r"--[a-z-]+|-[a-z]", word)), (verb, rest)


def test_python_examples_run() -> None:
    blocks = re.findall(r"```python\n(.*?)```", README, flags=re.DOTALL)
    assert blocks
    for block in blocks:
        exec(compile(block, "README.md", "exec"), {})  # noqa: S102 - our own text


def test_the_benchmark_table_is_the_one_that_was_measured() -> None:
    table = Path(__file__).parent.parent / "benchmarks" / "table.md"
    assert table.read_text(encoding="utf-8") in README
