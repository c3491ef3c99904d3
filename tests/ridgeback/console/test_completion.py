"""Completion in bash, zsh and fish: what ``docs/how-to/shell.md`` says to source works."""

from __future__ import annotations

import pytest

from ridgeback.cli import main


def asked(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], **variables: str) -> list[str]:
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    assert main() == 0
    return capsys.readouterr().out.splitlines()


@pytest.mark.parametrize("shell", ["zsh", "fish"])
def test_the_script_names_the_program(
    shell: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    script = "\n".join(asked(monkeypatch, capsys, _RIDGEBACK_COMPLETE=f"{shell}_source"))
    assert f"_RIDGEBACK_COMPLETE={shell}_complete" in script


@pytest.mark.parametrize(
    ("words", "position", "found"),
    [("ridgeback der", "1", "plain,derive"), ("ridgeback derive --meth", "2", "plain,--method")],
)
def test_verbs_and_options_are_completed(
    words: str, position: str, found: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    told = asked(monkeypatch, capsys, _RIDGEBACK_COMPLETE="bash_complete", COMP_WORDS=words, COMP_CWORD=position)
    assert told == [found]
