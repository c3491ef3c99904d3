"""An index of a folder: pages of ours by what their heads say, nothing else, and names from outside stay text."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from ridgeback.common.errors import InputError
from ridgeback.compare.report.several.index import index_report
from ridgeback.reports.page import html_page
from tests.reports import synthetic, synthetic_several

BAIT = "<script>alert(1)</script> & \"quotes\" 'single'"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    pages = {
        "b study.html": synthetic_several.study_report(),
        "a.html": replace(synthetic.empty_report(), title=f"Spring {BAIT}", lead="First of all."),
    }
    for name, report in pages.items():
        (tmp_path / name).write_text(html_page(report), encoding="utf-8")
    (tmp_path / "other.html").write_text("<!DOCTYPE html><title>not ours</title>", encoding="utf-8")
    (tmp_path / "notes.txt").write_text("nothing", encoding="utf-8")
    return tmp_path


def test_pages_of_ours_are_listed_by_kind(folder: Path) -> None:
    made = index_report(folder)
    assert [(page.link, page.kind) for page in made.indexed] == [("a.html", "oscillator"), ("b study.html", "study")]
    assert made.indexed[0].title == f"Spring {BAIT}"
    assert made.title == "2 reports: 1 oscillator and 1 study"
    text = html_page(made)
    assert 'href="b%20study.html"' in text
    assert "not ours" not in text
    assert "<script>alert" not in text


def test_an_index_does_not_list_itself_and_links_from_where_it_is(folder: Path) -> None:
    (folder / "index.html").write_text(html_page(index_report(folder)), encoding="utf-8")
    below = folder / "below"
    below.mkdir()
    assert [page.link for page in index_report(folder, beside=below).indexed] == ["../a.html", "../b study.html"]


def test_a_folder_without_reports_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="holds no report"):
        index_report(tmp_path)
