"""The synthetic pages, drawn once for all tests of a process, and the browser that opens them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from ridgeback.compare.report.results import Report
from ridgeback.reports.page import html_page
from tests.reports import synthetic, synthetic_several
from tests.reports.chromium import NAMES, Browser, binary


@pytest.fixture(scope="session")
def full() -> Report:
    return synthetic.full_report()


@pytest.fixture(scope="session")
def full_page(full: Report) -> str:
    return html_page(full)


@pytest.fixture(scope="session")
def study_page() -> str:
    return html_page(synthetic_several.study_report())


@pytest.fixture(scope="session")
def runs_page() -> str:
    return html_page(synthetic_several.runs_report())


@pytest.fixture(scope="session")
def recording_page() -> str:
    return html_page(synthetic.recording_report())


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    path = binary()
    if path is None:
        pytest.skip(f"no browser: none of {', '.join(NAMES)} is on the path, so the page was not opened")
    started = Browser(path)
    try:
        started.attach()
        yield started
    finally:
        started.close()


@pytest.fixture(scope="session")
def pages(
    tmp_path_factory: pytest.TempPathFactory, full_page: str, recording_page: str, runs_page: str, study_page: str
) -> dict[str, Path]:
    folder = tmp_path_factory.mktemp("pages")
    made = {
        "full": full_page,
        "recording": recording_page,
        "runs": runs_page,
        "study": study_page,
        "empty": html_page(synthetic.empty_report()),
        "hostile": html_page(_hostile()),
    }
    for name, page in made.items():
        (folder / f"{name}.html").write_text(page, encoding="utf-8")
    return {name: folder / f"{name}.html" for name in made}


def _hostile() -> Report:
    """Names that would run or fetch something if they were not text."""
    bait = "<script>document.title='run'</script><img src='https://example.org/x.png' onerror=\"document.title='run'\">"
    bait += "<link rel=stylesheet href=https://example.org/x.css></svg></title></style>"
    report: Report = synthetic.poisoned(synthetic.small_report(), bait)
    return report
