"""Pages of recordings and of a study in headless Chromium, held to the rules of a page, and judged by axe-core."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.pages import scripts
from tests.pages.axe import VIOLATIONS, axe_core
from tests.pages.look import Look
from tests.pages.page_rules import PageRules
from tests.reports.chromium import Browser


@pytest.mark.parametrize("kind", ["decay", "degrees", "runs", "study"])
class TestPagesOfRecords(PageRules):
    """A decay, one whose equation is known, two runs, the answers of a study."""


def test_axe_core_finds_nothing_on_a_real_page(browser: Browser, look: Look) -> None:
    """On kinds with much on them; the made-up pages are judged wide and narrow, light and dark."""
    source = axe_core()
    if source is None:
        pytest.skip("no axe-core: neither AXE_CORE nor node_modules has it")
    for kind in ("decay", "study"):
        page = look(kind)["page"]
        browser.open(Path(page.removeprefix("file://")), width=400, dark=True)
        browser.evaluate(scripts.UNFOLD)
        browser.evaluate(source)
        assert browser.evaluate(VIOLATIONS) == [], kind
