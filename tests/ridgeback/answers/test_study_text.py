"""What the answers of a study and two stores held against each other look like in words."""

from __future__ import annotations

import csv
import io
import math
from types import SimpleNamespace
from typing import cast

import pytest

from ridgeback.answers.study_file import complain
from ridgeback.answers.study_text import SHOWN_ROWS, SHOWN_SENTENCES, answer_lines, comparison_text
from ridgeback.common.show.picture import Picture
from ridgeback.compare.studies.against import Change, Comparison
from ridgeback.compare.studies.answer import Answer
from ridgeback.compare.studies.result import StudyResult
from ridgeback.compare.studies.tasks import Column
from ridgeback.console.failure import PartialError

COLUMNS = (Column("oscillator", "", "its name"), Column("order", "1", "of the series"))


def answered(rows: int, *, sentences: int = 0, passed: bool | None = None) -> Answer:
    table = tuple({"oscillator": "pendulum", "order": n} for n in range(rows))
    said = tuple(f"sentence {n}" for n in range(sentences))
    return Answer("error", "errors", COLUMNS, table, said, Picture("", "", ""), 0, passed)


def test_what_all_rows_share_stands_above_them_and_what_is_too_much_is_counted() -> None:
    few = list(answer_lines(answered(2, sentences=1)))
    assert few[:2] == ["error: errors", "oscillator pendulum"]
    assert few[2].split() == ["order", "0", "1"]
    assert few[3:] == ["sentence 0"]
    many = list(answer_lines(answered(SHOWN_ROWS + 3, sentences=SHOWN_SENTENCES + 2)))
    assert "... 3 more rows; --format json has them all" in many
    assert many[-1] == "... 2 more sentences; --format json has them all"
    assert sum(line.startswith("sentence") for line in many) == SHOWN_SENTENCES
    assert list(answer_lines(answered(0))) == ["error: errors"]
    assert list(answer_lines(answered(1)))[1].split() == ["oscillator", "order", "pendulum", "0"]


def test_changes_between_stores_are_a_table_in_words_and_in_csv() -> None:
    changes = (
        Change("pendulum (), 1", "reason", "values", "lost", math.inf),
        Change("pendulum (), 2", "omega", 1.0, 2.0, 0.5),
    )
    found = Comparison((), 3, 2, 0, 1, changes)
    text = comparison_text(found, "text")
    assert "3 cells are equal to the last digit, 2 differ; 0 are in the first store only, 1 in the second only" in text
    assert "lost" in text
    rows = list(csv.DictReader(io.StringIO(comparison_text(found, "csv"))))
    assert [(row["cell"], row["after"], row["relative"]) for row in rows] == [
        ("pendulum (), 1", "lost", ""),
        ("pendulum (), 2", "2.0", "0.5"),
    ]


def test_a_test_that_does_not_pass_is_named() -> None:
    def result(*answers: Answer, failed: int = 0) -> StudyResult:
        return cast(StudyResult, SimpleNamespace(answers=answers, failed=failed, cells=5))

    complain(result(answered(1), answered(1, passed=True)))
    with pytest.raises(PartialError, match="error: not all that was tested passes"):
        complain(result(answered(1, passed=False)))
    with pytest.raises(PartialError, match="2 of 5 cells have no value"):
        complain(result(answered(1), failed=2))
