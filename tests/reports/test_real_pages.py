"""A real page of each kind in headless Chromium, held to the rules of a page: ten kinds, one rule a test.

Each page is made from a request as a reader makes it, opened wide and light, narrow and dark, and without scripts, and
looked at once.  The made-up pages of ``test_browser.py`` show what these do not: names that would run, figures without
data, zooming and reading to the digit.
"""

from __future__ import annotations

import csv
import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest

from tests.reports import rules
from tests.reports.chromium import Browser
from tests.reports.real_pages import REQUESTS, make
from tests.reports.test_accessibility import COLOURS, VIOLATIONS, _contrast, axe_core

KINDS = pytest.mark.parametrize("kind", REQUESTS)
WIDTHS = pytest.mark.parametrize("width", [1280, 400])
HEIGHT = "document.documentElement.scrollHeight"
MOST = {1280: 7500, 400: 10_500}
"""Height of a page with its details folded, px."""
LEAST = {1280: 12.0, 400: 9.0}
"""Size of a label in a figure, px."""
Look = Callable[[str], dict[str, Any]]


@pytest.fixture(scope="module")
def look(browser: Browser, tmp_path_factory: pytest.TempPathFactory) -> Look:
    """What is seen of the page of a kind, which is made and opened when it is first asked for."""
    folder, seen = tmp_path_factory.mktemp("real"), {}

    def of(kind: str) -> dict[str, Any]:
        if kind not in seen:
            seen[kind] = everything(browser, make(kind, folder))
        return seen[kind]

    return of


def everything(browser: Browser, page: Path) -> dict[str, Any]:
    """All that the rules are about, by width; what a reader does is done on the wide page."""
    found: dict[str, Any] = {}
    for width in (400, 1280):
        browser.open(page, width=width, dark=width == 400)
        found[str(width)] = {"height": browser.evaluate(HEIGHT)}
        browser.evaluate(rules.UNFOLD)
        found[str(width)] |= {name: browser.evaluate(said) for name, said in rules.LOOKED_AT.items()}
        found[str(width)]["colours"] = browser.evaluate(COLOURS)
    found["figures"] = [figure | read(browser, figure["id"]) for figure in browser.evaluate(rules.FIGURES)]
    found |= {name: browser.evaluate(said) for name, said in rules.DONE.items()}
    found["complaints"], found["requests"] = browser.complaints(), browser.requests()
    found["smuggled"] = browser.evaluate(rules.SMUGGLED)
    browser.open(page, scripts=False)
    browser.evaluate(rules.UNFOLD)
    found["without scripts"] = browser.evaluate(rules.SHOWN)
    found["drawn without scripts"] = [figure["drawn"] for figure in browser.evaluate(rules.FIGURES)]
    found["buttons without scripts"] = browser.evaluate(rules.BUTTONS)
    found["page"] = page.as_uri()
    return found


def read(browser: Browser, key: str) -> dict[str, Any]:
    """What a figure says to the keys and to a pointer, and whether the page keeps its height."""
    out = f"document.getElementById({json.dumps(key)}).querySelector('.out')?.textContent"
    browser.hover((1, 1))
    before, said = browser.evaluate(HEIGHT), []
    browser.evaluate(f"document.getElementById({json.dumps(key)}).querySelector('.drawing').focus()")
    browser.evaluate(rules.SETTLED)
    for pressed in ("Home", "ArrowRight", "End", "Escape"):
        browser.press(pressed)
        said.append(browser.evaluate(out))
    place = browser.evaluate(rules.READ % json.dumps(key))
    browser.evaluate(rules.SETTLED)
    browser.hover(place)
    pointed = browser.evaluate(out)
    return {"keys": said, "pointed": pointed, "still": browser.evaluate(HEIGHT) == before}


# --- what is seen ---


@KINDS
def test_nothing_is_said_on_the_console_and_nothing_is_fetched(look: Look, kind: str) -> None:
    seen = look(kind)
    assert seen["complaints"] == []
    assert seen["requests"] == [seen["page"]]


@WIDTHS
@KINDS
def test_nothing_is_beyond_the_width(look: Look, kind: str, width: int) -> None:
    seen = look(kind)[str(width)]
    assert seen["beyond"] == []
    assert seen["across"] <= width


@WIDTHS
@KINDS
def test_a_page_is_no_longer_than_it_may_be(look: Look, kind: str, width: int) -> None:
    assert 900 < look(kind)[str(width)]["height"] <= MOST[width]


@WIDTHS
@KINDS
def test_no_label_covers_another(look: Look, kind: str, width: int) -> None:
    assert look(kind)[str(width)]["overlaps"] == []


@WIDTHS
@KINDS
def test_labels_are_large_enough_and_inside(look: Look, kind: str, width: int) -> None:
    labels = look(kind)[str(width)]["texts"]
    assert len(labels) > 10
    assert [label for label in labels if label[2] < LEAST[width]] == []
    assert [label for label in labels if label[3] > 4.0] == []


@WIDTHS
@KINDS
def test_no_drawing_and_no_panel_is_empty(look: Look, kind: str, width: int) -> None:
    assert look(kind)[str(width)]["empty"] == []


@WIDTHS
@KINDS
def test_mathematics_is_large_enough(look: Look, kind: str, width: int) -> None:
    found = look(kind)[str(width)]["mathematics"]
    assert found or kind in ("runs", "study")
    assert [one for one in found if one[1] < 12.0] == []


@WIDTHS
@KINDS
def test_text_meets_wcag_aa(look: Look, kind: str, width: int) -> None:
    pairs = look(kind)[str(width)]["colours"]
    assert len(pairs) >= 4
    assert [pair for pair in pairs if _contrast(pair[1], pair[2]) < 4.5] == []


@KINDS
def test_a_page_without_scripts_is_complete(look: Look, kind: str) -> None:
    """Whatever a reader with scripts is shown, figures too, and no button that would do nothing."""
    seen = look(kind)
    assert len(seen["shown"]) > 40
    assert [text for text in seen["shown"] if text not in set(seen["without scripts"])] == []
    assert seen["drawn without scripts"] == [figure["drawn"] for figure in seen["figures"]]
    assert seen["buttons without scripts"] == 0


# --- what is done ---


@KINDS
def test_every_figure_is_read_by_keys_and_pointer(look: Look, kind: str) -> None:
    figures = look(kind)["figures"]
    assert figures
    for figure in figures:
        assert figure["named"], figure["id"]
        assert figure["caption"] > 20, figure["id"]
        assert figure["keyboard"], figure["id"]
        assert all(re.search(r"\d", said or "") for said in (*figure["keys"][:3], figure["pointed"])), figure
        assert figure["keys"][0] != figure["keys"][1], figure
        assert figure["keys"][3] == "", figure["id"]
        assert figure["still"], figure["id"]


@KINDS
def test_check_boxes_hide_their_series_and_show_them_again(look: Look, kind: str) -> None:
    for name, before, without, after in look(kind)["toggles"]:
        assert before > 0, name
        assert without == 0, name
        assert after == before, name


def size(cell: str) -> float | None:
    """The size of the number that a cell begins with; None where it holds none."""
    text = cell.replace("\u2007", "").replace("\u2008", "").replace("−", "-").strip().removeprefix("≤ ").strip()
    found = re.match(r"([+-]?[\d.]+)(?: ± [\d.]+)?(?: × 10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?(?: (%|ns|µs|ms|s))?(?: |$|\()", text)
    if found is None:
        return None
    power = int((found[2] or "0").translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")))
    unit = {"%": 1e-2, "ns": 1e-9, "µs": 1e-6, "ms": 1e-3}.get(found[3] or "", 1.0)
    return abs(float(found[1])) * 10.0**power * unit


@KINDS
def test_columns_sort_by_size_both_ways(look: Look, kind: str) -> None:
    """Numbers by their size whatever their unit, what is none last; up, then down."""
    for name, announced, up, down in look(kind)["sorted"]:
        assert announced == "ascending", name
        assert sorted(up) == sorted(down), name
        sizes = [[size(cell) for cell in cells] for cells in (up, down)]
        numbers = [[v for v in column if v is not None] for column in sizes]
        if numbers[0]:
            assert numbers[0] == sorted(numbers[0]), name
            assert numbers[1] == sorted(numbers[1], reverse=True), name
            assert sizes[0][: len(numbers[0])] == numbers[0], f"{name}: what is no number stands last"
            assert sizes[1][: len(numbers[1])] == numbers[1], f"{name}: what is no number stands last"
        else:
            assert up == sorted(up, key=str.casefold), name


@KINDS
def test_figures_and_data_are_saved(look: Look, kind: str) -> None:
    """Each drawing as an SVG that needs no style sheet, one as a picture, each table as rows of one length."""
    saved, files = look(kind)["saved"]
    assert {Path(name).suffix for name, _ in saved} == {".svg", ".png", ".csv"}
    for name, address in saved:
        kind_of, _, text = address.partition(",")
        match Path(name).suffix:
            case ".svg":
                assert ElementTree.fromstring(text).tag.endswith("svg"), name  # noqa: S314
                assert "var(--" not in text, name
            case ".png":
                assert kind_of == "data:image/png;base64"
                assert len(text) > 5000
            case ".csv":
                assert_rectangular(name, text)
    for name, address in files:
        assert_rectangular(name, address.partition(",")[2])


def assert_rectangular(name: str, text: str) -> None:
    """Rows of one length; a figure of two planes holds two tables, one below the other."""
    rows = list(csv.reader(line for line in text.splitlines() if not line.startswith("#")))
    assert len(rows) > 1, name
    assert len({len(row) for row in rows}) <= (2 if "plane" in name else 1), name


@KINDS
def test_what_is_not_the_pages_own_is_refused(look: Look, kind: str) -> None:
    """The content-security policy, as the browser applies it: a script put into the page does not run."""
    assert look(kind)["smuggled"] == [False, ["img-src", "script-src-elem"]]


def test_axe_core_finds_nothing_on_a_real_page(browser: Browser, look: Look) -> None:
    """On the kinds with most on them; the made-up pages are judged wide and narrow, light and dark."""
    source = axe_core()
    if source is None:
        pytest.skip("no axe-core: neither AXE_CORE nor node_modules has it")
    for kind in ("paper", "decay", "study"):
        page = look(kind)["page"]
        browser.open(Path(page.removeprefix("file://")), width=400, dark=True)
        browser.evaluate(rules.UNFOLD)
        browser.evaluate(source)
        assert browser.evaluate(VIOLATIONS) == [], kind
