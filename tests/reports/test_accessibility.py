"""The page for everyone: contrast, names, headings, and what a keyboard reaches; and axe-core, where it is here.

axe-core is npm's package of that name: ``npm install axe-core`` in the root of the project, or the path of its
``axe.min.js`` in the environment variable ``AXE_CORE``.  Without it that one test is skipped and says so; the rules
that a page could break are looked at without it.
"""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import pytest

from tests.pages.axe import VIOLATIONS, axe_core
from tests.pages.scripts import UNFOLD
from tests.reports.chromium import Browser

SIDES = ("full", "recording", "runs", "study")


@pytest.mark.parametrize(("width", "dark"), [(1280, False), (400, True)], ids=["wide light", "narrow dark"])
@pytest.mark.parametrize("side", [*SIDES, "empty"])
def test_axe_core_finds_nothing(browser: Browser, pages: dict[str, Path], side: str, dark: bool, width: int) -> None:
    source = axe_core()
    if source is None:
        pytest.skip("no axe-core: neither AXE_CORE nor node_modules has it")
    browser.open(pages[side], width=width, dark=dark)
    browser.evaluate(UNFOLD)
    browser.evaluate(source)
    assert browser.evaluate(VIOLATIONS) == []


def test_ids_are_unique(browser: Browser, pages: dict[str, Path]) -> None:
    for side in SIDES:
        browser.open(pages[side])
        ids = browser.evaluate("[...document.querySelectorAll('[id]')].map(e => e.id)")
        assert len(ids) > 10
        assert len(ids) == len(set(ids))


NAMED = {
    "button",
    "link",
    "checkbox",
    "radio",
    "slider",
    "image",
    "region",
    "radiogroup",
    "navigation",
    "table",
}
"""Roles that a screen reader announces by their name."""


@pytest.mark.parametrize("side", SIDES)
def test_whatever_is_announced_has_a_name(browser: Browser, pages: dict[str, Path], side: str) -> None:
    """As Chromium tells assistive technology."""
    browser.open(pages[side])
    browser.evaluate(UNFOLD)
    nodes = [n for n in browser.call("Accessibility.getFullAXTree")["nodes"] if not n["ignored"]]
    told = [(n["role"]["value"], n.get("name", {}).get("value", "").strip()) for n in nodes if "role" in n]
    kinds = [role for role, _ in told]
    assert {"main", "heading", "image", "button"} <= set(kinds)
    assert kinds.count("main") == 1
    assert [role for role, name in told if role in NAMED and not name] == []
    assert browser.evaluate("document.querySelectorAll('[role]:not([aria-label]):not([aria-labelledby])').length") == 0


@pytest.mark.parametrize("side", [*SIDES, "empty"])
def test_headings_start_at_one_and_skip_no_level(browser: Browser, pages: dict[str, Path], side: str) -> None:
    browser.open(pages[side])
    levels = browser.evaluate("[...document.querySelectorAll('h1,h2,h3,h4')].map(h => +h.tagName[1])")
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert all(after <= before + 1 for before, after in pairwise(levels))


# What can be scrolled sideways or down, and neither has the focus nor holds what can have it.
UNREACHED = """[...document.querySelectorAll("main *, nav")].filter(e => {
  const style = getComputedStyle(e), over = /auto|scroll/;
  const moves = (e.scrollWidth > e.clientWidth + 1 && over.test(style.overflowX))
    || (e.scrollHeight > e.clientHeight + 1 && over.test(style.overflowY));
  return moves && e.tabIndex < 0 && !e.querySelector("a[href],button,input,[tabindex='0']");
}).map(e => e.tagName + "." + e.className)"""


@pytest.mark.parametrize("side", SIDES)
def test_whatever_scrolls_is_reached_by_the_keyboard(browser: Browser, pages: dict[str, Path], side: str) -> None:
    browser.open(pages[side], width=400)
    browser.evaluate(UNFOLD)
    assert browser.evaluate(UNREACHED) == []


@pytest.mark.parametrize("side", SIDES)
def test_every_cell_has_its_heads(browser: Browser, pages: dict[str, Path], side: str) -> None:
    browser.open(pages[side])
    tables = "[...document.querySelectorAll('table')]"
    assert browser.evaluate(f"{tables}.length") > 0
    assert (
        browser.evaluate(f"{tables}.filter(t => t.querySelector('th:not([scope])') || !t.tHead).map(t => t.id)") == []
    )
    assert browser.evaluate("document.documentElement.lang") == "en"


def test_a_page_with_faults_is_caught(browser: Browser, tmp_path: Path) -> None:
    """The tests above can fail: a box that scrolls without focus, a level left out, a button without a name."""
    wrong = tmp_path / "wrong.html"
    wide = "<div style='overflow:auto;width:99px'><p style='width:999px'>x</p></div>"
    wrong.write_text(f"<!DOCTYPE html><main><h1>x</h1><h3>y</h3>{wide}<button></button></main>", encoding="utf-8")
    browser.open(wrong)
    assert browser.evaluate(UNREACHED) == ["DIV."]
    nodes = browser.call("Accessibility.getFullAXTree")["nodes"]
    buttons = [n for n in nodes if n.get("role", {}).get("value") == "button"]
    assert not buttons[0].get("name", {}).get("value")
    source = axe_core()
    if source is not None:
        browser.evaluate(source)
        assert len(browser.evaluate(VIOLATIONS)) >= 3
