"""A study's store as a report: nothing computed anew, oscillators side by side, unfinished ones refused."""

from __future__ import annotations

import html
from pathlib import Path

import pytest

from ridgeback.common.errors import InputError
from ridgeback.compare.report.results import Report
from ridgeback.compare.report.several.study_report import study_report
from ridgeback.compare.studies.file.reading import read_plan
from ridgeback.compare.studies.store import opened
from ridgeback.interface.studies import PROGRAM, run_study
from ridgeback.reports.page import html_page

TEXT = """[study]
title = "Two springs"
ask = ["error", "order-needed"]
[grid]
orders = [2, 4]
amplitudes = [0.2, 0.4, 0.8, 4.0]
tolerances = 1e-3
[[oscillator]]
system = "duffing-hardening"
[[oscillator]]
system = "pendulum"
"""


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("study") / "two.toml"
    path.write_text(TEXT, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def made(study: Path) -> Report:
    run_study(study)
    return study_report(study.with_suffix(".db"), command="ridgeback report two.db")


def test_the_title_is_the_spread_of_the_first_answer(made: Report) -> None:
    assert made.answered is not None
    largest = {row["oscillator"]: row["largest"] for row in made.answered.answers[0].rows() if row["order"] == 4}
    best = min(largest, key=lambda name: largest[name])
    assert made.title.startswith("Two springs: order 4 errs at most")
    worst, said = max(largest, key=lambda name: largest[name]), made.title.casefold()
    assert said.index(best.partition("-")[0]) < said.index(worst.partition("-")[0])


def test_cells_without_a_value_are_counted_with_their_reason(made: Report) -> None:
    """The pendulum has no motion of amplitude 4."""
    assert made.answered is not None
    ((reason, cells),) = made.answered.failures
    assert cells == 2
    assert "2 cells have no value" in made.lead
    page = html.unescape(html_page(made))
    assert f"2 cells: {reason}" in page


def test_oscillators_stand_side_by_side_on_shared_axes(made: Report) -> None:
    assert made.answered is not None
    assert [picture.title.partition(",")[0] for picture in made.answered.panels] == ["Duffing oscillator", "Pendulum"]
    page = html_page(made)
    assert page.count('<figure id="side-by-side"') == 1
    assert 'id="section-q-order-needed"' in page
    assert set(made.csv) == {"error.csv", "order-needed.csv", "cells.csv"}
    assert html_page(made) == page


def test_an_unfinished_study_is_refused(study: Path, tmp_path: Path) -> None:
    place = tmp_path / "begun.db"
    with opened(place, read_plan(study), PROGRAM, warned=lambda _: None):
        pass
    with pytest.raises(InputError, match="holds 0 of 16 cells"):
        study_report(place)
