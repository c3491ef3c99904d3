"""The page in headless Chromium: what is drawn, how large, in which colours, and that nothing else is asked for.

The browser is Debian's ``chromium`` (or ``chromium-browser``, ``google-chrome``) on the path; without one these
tests are skipped and say so.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from ridgeback.compare.report.results import Report
from ridgeback.reports.page import html_page
from tests.reports import synthetic
from tests.reports.chromium import NAMES, Browser, binary

WIDTHS = (1280, 400)
FIGURES = {
    "full": [
        *("backbone", "error", "map", "needed", "tracks", "residuals", "budget"),
        *("paper1", "paper2", "paper3", "paper4", "paper5", "paper6", "paper7", "paper7w", "paper8", "paper9"),
        *("noise-error", "noise-ratio"),
    ],
    "recording": [
        *(f"recording-{name}" for name in ("backbone", "growth", "signal", "plane", "tracks")),
        *("identify-backbone", "identify-growth"),
        *(f"prediction-{name}" for name in ("amplitude", "frequency", "phase")),
    ],
}
SIDES = tuple(FIGURES)


@pytest.fixture(scope="module")
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


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory, full_page: str, recording_page: str) -> dict[str, Path]:
    folder = tmp_path_factory.mktemp("pages")
    made = {
        "full": full_page,
        "recording": recording_page,
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


# Every drawing that is laid out, with its accessible name, its size and its texts.
DRAWINGS = """
[...document.querySelectorAll("figure")].map(figure => {
  const named = svg => (svg.getAttribute("aria-labelledby") || "").split(" ").filter(Boolean)
    .map(id => (document.getElementById(id) || {textContent: ""}).textContent.trim());
  const drawn = [...figure.querySelectorAll("svg[role=img]")].filter(s => s.getClientRects().length);
  return {id: figure.id, drawings: drawn.map(svg => {
    const box = svg.getBoundingClientRect();
    return {width: box.width, height: box.height, names: named(svg),
      texts: [...svg.querySelectorAll("text")].map(text => {
      const r = text.getBoundingClientRect(), m = text.getScreenCTM();
      return {text: text.textContent, size: parseFloat(getComputedStyle(text).fontSize) * Math.hypot(m.a, m.b),
        over: Math.max(box.left - r.left, r.right - box.right, box.top - r.top, r.bottom - box.bottom)};
    })};
  })};
})
"""


@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("side", SIDES)
def test_every_figure_is_drawn_once_with_a_name_and_a_size(
    browser: Browser, pages: dict[str, Path], side: str, width: int
) -> None:
    browser.open(pages[side], width=width)
    figures = browser.evaluate(DRAWINGS)
    ids = [figure["id"] for figure in figures]
    assert sorted(ids) == sorted(FIGURES[side])
    for figure in figures:
        (drawing,) = figure["drawings"]
        assert drawing["width"] > 0.7 * min(width, 760), figure["id"]
        assert drawing["height"] > 100, figure["id"]
        assert len(drawing["names"]) == 2, figure["id"]
        assert all(drawing["names"]), figure["id"]


@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("side", SIDES)
def test_text_in_figures_is_large_enough_and_inside(
    browser: Browser, pages: dict[str, Path], side: str, width: int
) -> None:
    browser.open(pages[side], width=width)
    texts = [
        (figure["id"], text["text"], text["size"], text["over"])
        for figure in browser.evaluate(DRAWINGS)
        for drawing in figure["drawings"]
        for text in drawing["texts"]
    ]
    assert len(texts) > 40
    assert [found for found in texts if found[2] < 9.0] == []
    assert [found for found in texts if found[3] > 1.0] == []


@pytest.mark.parametrize("side", [*SIDES, "empty", "hostile"])
def test_nothing_is_said_on_the_console_and_nothing_leaves_the_file(
    browser: Browser, pages: dict[str, Path], side: str
) -> None:
    browser.open(pages[side])
    assert browser.evaluate("document.querySelectorAll('details').forEach(d => d.open = true); document.readyState")
    browser.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    assert browser.complaints() == []
    assert browser.requests() == [pages[side].as_uri()]
    assert (
        browser.evaluate("performance.getEntriesByType('resource').filter(e => !e.name.startsWith('data:')).length")
        == 0
    )


def test_a_console_error_and_a_request_would_be_seen(browser: Browser, tmp_path: Path) -> None:
    """The two tests above can fail: a page that does wrong is caught by the same client."""
    wrong = tmp_path / "wrong.html"
    wrong.write_text("<!DOCTYPE html><script>console.error('no')</script><img src='absent.png'>", encoding="utf-8")
    browser.open(wrong)
    browser.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    assert browser.complaints()
    assert (tmp_path / "absent.png").as_uri() in browser.requests()


def test_hostile_names_run_nothing(browser: Browser, pages: dict[str, Path]) -> None:
    browser.open(pages["hostile"])
    assert browser.evaluate("document.title") != "run"
    assert browser.evaluate("document.querySelectorAll('img,link,iframe').length") == 0


@pytest.mark.parametrize("side", [*SIDES, "hostile"])
def test_nothing_is_wider_than_a_small_screen(browser: Browser, pages: dict[str, Path], side: str) -> None:
    browser.open(pages[side], width=400)
    browser.evaluate("document.querySelectorAll('details').forEach(d => { d.open = true; })")
    wide = """[...document.querySelectorAll("main *")].filter(e => e.getBoundingClientRect().right > 400.5
      && !e.closest("pre") && !e.closest("svg")).map(e => e.tagName + "." + e.className).slice(0, 9)"""
    assert browser.evaluate("document.documentElement.scrollWidth") <= 400, browser.evaluate(wide)


def test_ids_are_unique(browser: Browser, pages: dict[str, Path]) -> None:
    for side in SIDES:
        browser.open(pages[side])
        ids = browser.evaluate("[...document.querySelectorAll('[id]')].map(e => e.id)")
        assert len(ids) > 20
        assert len(ids) == len(set(ids))


# Text colour against the nearest painted background, for all text that is laid out.
COLOURS = r"""
(() => {
  const found = {}, walk = document.createTreeWalker(document.querySelector("main"), NodeFilter.SHOW_TEXT);
  const parse = c => c.match(/[\d.]+/g).map(Number);
  while (walk.nextNode()) {
    const e = walk.currentNode.parentElement;
    if (!walk.currentNode.data.trim() || !e.getClientRects().length || e.closest("script,style,title,desc")) continue;
    const style = getComputedStyle(e), ink = e.closest("svg") ? style.fill : style.color;
    let ground = "", up = e;
    for (; up && !ground; up = up.parentElement) {
      const c = getComputedStyle(up).backgroundColor, v = parse(c);
      if (v.length === 3 || v[3] > 0) ground = c;
    }
    found[ink + " on " + ground] = walk.currentNode.data.trim().slice(0, 40);
  }
  return Object.entries(found).map(([k, text]) => [text, ...k.split(" on ").map(parse)]);
})()
"""


def _contrast(ink: list[float], ground: list[float]) -> float:
    """WCAG 2.1, relative luminance and contrast ratio."""

    def luminance(colour: list[float]) -> float:
        channels = [v / 255 for v in colour[:3]]
        red, green, blue = (v / 12.92 if v <= 0.03928 else ((v + 0.055) / 1.055) ** 2.4 for v in channels)
        return 0.2126 * red + 0.7152 * green + 0.0722 * blue

    low, high = sorted((luminance(ink), luminance(ground)))
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
@pytest.mark.parametrize("side", SIDES)
def test_all_text_as_rendered_meets_wcag_aa(browser: Browser, pages: dict[str, Path], side: str, dark: bool) -> None:
    browser.open(pages[side], dark=dark)
    pairs = browser.evaluate(COLOURS)
    assert len(pairs) >= 5
    assert [pair for pair in pairs if _contrast(pair[1], pair[2]) < 4.5] == []


def test_a_dark_screen_gets_a_dark_page(browser: Browser, pages: dict[str, Path]) -> None:
    background = "getComputedStyle(document.body).backgroundColor"
    curve = "getComputedStyle(document.querySelector('#backbone svg g path[style*=s2]')).stroke"
    browser.open(pages["full"])
    light = browser.evaluate(background), browser.evaluate(curve)
    browser.open(pages["full"], dark=True)
    dark = browser.evaluate(background), browser.evaluate(curve)
    assert light[0] == "rgb(255, 255, 255)"
    assert max(int(v) for v in re.findall(r"\d+", dark[0])) < 60
    assert light[1] != dark[1]


def test_the_page_is_read_without_scripts(browser: Browser, pages: dict[str, Path]) -> None:
    browser.open(pages["full"], scripts=False)
    text = browser.evaluate("document.querySelector('main').innerText")
    for wanted in ("Range of use", "Frequency against amplitude", "The paper's figures, measured", "Provenance"):
        assert wanted in text
    shown = browser.evaluate(
        "[...document.querySelectorAll('svg.wide')].filter(s => s.getBoundingClientRect().height > 100).length"
    )
    assert shown == browser.evaluate("document.querySelectorAll('figure').length") > 15
    assert (
        browser.evaluate("[...document.querySelectorAll('button')].filter(b => b.getClientRects().length).length") == 0
    )


def test_check_boxes_hide_curves_without_scripts(browser: Browser, pages: dict[str, Path]) -> None:
    browser.open(pages["full"], scripts=False)
    drawn = "[...document.querySelectorAll('#backbone svg.wide g.t0')].filter(g => g.getClientRects().length).length"
    assert browser.evaluate(drawn) >= 1
    browser.evaluate("document.querySelector('#backbone input.t0').checked = false")
    assert browser.evaluate(drawn) == 0


def test_arrow_keys_read_a_curve(browser: Browser, pages: dict[str, Path]) -> None:
    """At the left end the readout gives the first amplitude and the exact frequency there, and marks both curves."""
    browser.open(pages["full"])
    readout = "document.querySelector('#backbone .readout').textContent"
    assert browser.evaluate(readout) == ""
    browser.evaluate("document.querySelector('#backbone .drawing').focus()")
    browser.press("Home")
    study = synthetic.make_study()
    said = browser.evaluate(readout)
    assert said.startswith("A = 0.1 rad")
    assert f"{study.reference[0]:.5g}" in said
    browser.press("ArrowRight")
    assert browser.evaluate(readout) != said
    assert browser.evaluate("document.querySelectorAll('#error .cross').length") >= 1, "linked figures move together"
    browser.press("Escape")
    assert browser.evaluate(readout) == ""
    assert browser.complaints() == []


def test_the_readout_dot_lies_on_its_curve(browser: Browser, pages: dict[str, Path]) -> None:
    browser.open(pages["full"])
    browser.evaluate("document.querySelector('#backbone .drawing').focus()")
    for key in ("Home", *("PageDown",) * 2):
        browser.press(key)
    distance = browser.evaluate("""(() => {
      const svg = document.querySelector("#backbone svg.wide"), dots = [...svg.querySelectorAll(".dot")];
      const paths = [...svg.querySelectorAll("g path")].filter(p => !p.closest("defs"));
      return dots.map(dot => Math.min(...paths.map(path => {
        const length = path.getTotalLength();
        let best = Infinity;
        for (let i = 0; i <= 800; i++) {
          const p = path.getPointAtLength(length * i / 800);
          best = Math.min(best, Math.hypot(p.x - dot.cx.baseVal.value, p.y - dot.cy.baseVal.value));
        }
        return best;
      })));
    })()""")
    assert len(distance) >= 2
    assert max(distance) < 1.0


@pytest.mark.parametrize("scripts", [True, False], ids=["scripts", "no scripts"])
def test_a_page_prints_light_and_with_everything_unfolded(
    browser: Browser, pages: dict[str, Path], scripts: bool
) -> None:
    browser.open(pages["full"], dark=True, scripts=scripts)
    unfolded = "[...document.querySelectorAll('details pre, details dl')].map(e => e.checkVisibility())"
    assert len(browser.evaluate(unfolded)) > 4
    assert not any(browser.evaluate(unfolded))
    browser.media(dark=True, kind="print")
    browser.evaluate("dispatchEvent(new Event('beforeprint'))")
    assert browser.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
    assert all(browser.evaluate(unfolded))
    assert browser.evaluate("document.querySelector('nav').getClientRects().length") == 0


def test_a_page_prints_to_more_than_one_sheet(browser: Browser, pages: dict[str, Path]) -> None:
    browser.open(pages["full"], dark=True)
    printed = browser.pdf()
    assert printed.startswith(b"%PDF-")
    assert len(re.findall(rb"/Type\s*/Page\b(?!s)", printed)) > 1
