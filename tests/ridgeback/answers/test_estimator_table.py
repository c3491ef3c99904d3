"""``study --estimators``: its table, and what does not go with it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from ridgeback.cli import main
from ridgeback.compare.noise import estimator_study as study
from ridgeback.compare.noise.estimator_study import METHODS, Case
from ridgeback.compare.noise.results import NoiseStudy


def test_the_table_of_one_small_case(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(study, "cases", lambda: (Case(length=10.0, sampling=8.0),))
    assert main(["study", "--estimators", "--trials", "2", "--format", "csv"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert sorted(line.split(",")[1] for line in lines[1:]) == sorted(METHODS)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("pendulum --estimators", "a study of its own"),
        ("--estimators --amplitudes 1,2", "a study of its own"),
        ("pendulum --amplitudes 1 --trials 3", "belong to --estimators"),
        ("pendulum --amplitudes 1 --format markdown", "belong to --estimators"),
        ("pendulum", "--amplitudes"),
        ("--estimators --trials 1", "trials"),
    ],
)
def test_refusals(words: str, message: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["study", *words.split()]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1


@pytest.mark.parametrize("checkpoint", [True, False])
@pytest.mark.parametrize("style", ["markdown", "text", "json"])
def test_an_interrupted_table_says_so(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path, style: str, checkpoint: bool
) -> None:
    """It is written as far as it came, says that it is partial and how to go on; the exit code is that of Ctrl-C."""
    monkeypatch.setattr(study, "cases", lambda: (Case(length=10.0), Case(length=12.0)))
    run, calls = study._run, []

    def pressed(*given: Any) -> NoiseStudy:
        calls.append(given)
        if len(calls) == 2:
            raise KeyboardInterrupt
        return run(given[0], ("hilbert", "wigner"), *given[2:])

    monkeypatch.setattr(study, "_run", pressed)
    state = tmp_path / "cases.json"
    more = ["--checkpoint", str(state)] if checkpoint else []
    assert main(["study", "--estimators", "--trials", "2", "--format", style, *more]) == 130
    captured = capsys.readouterr()
    assert captured.err.startswith("ridgeback: interrupted after 1 case: the table is partial; ")
    assert captured.err.count("\n") == 1
    assert ("run the same command again" in captured.err) is checkpoint
    assert ("with --checkpoint FILE" in captured.err) is not checkpoint
    if style == "json":
        assert json.loads(captured.out)["complete"] is False
    else:
        assert captured.out.endswith("\nInterrupted after 1 case: the table is partial.\n")
