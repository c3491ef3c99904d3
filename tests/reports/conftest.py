"""The synthetic pages, drawn once for all tests of a process."""

from __future__ import annotations

import pytest

from ridgeback.compare.report.results import Report
from ridgeback.reports.page import html_page
from tests.reports import synthetic, synthetic_several


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
