"""``study --estimators``: its table, and what does not go with it."""

from __future__ import annotations

import pytest

import compare.estimator_study
from compare.estimator_study import METHODS, Case
from ridgeback.cli import main


def test_the_table_of_one_small_case(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(compare.estimator_study, "cases", lambda: (Case(length=10.0, sampling=8.0),))
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
