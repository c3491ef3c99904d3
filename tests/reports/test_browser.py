"""The page in headless Chromium: what is drawn, how large, in which colours, and that nothing else is asked for.

The browser is Debian's ``chromium`` (or ``chromium-browser``, ``google-chrome``) on the path; without one these
tests are skipped and say so.
"""

from __future__ import annotations

import csv
import re
from pathlib import Path

import numpy as np
import pytest

from tests.reports import synthetic
from tests.reports.chromium import Browser

WIDTHS = (1280, 400)
FIGURES = {
    "full": ["accuracy-cost", "in-time", "order-map", "motion", "planes", "noise", "budget"],
    "recording": [
        *(f"recording-{name}" for name in ("backbone", "signal", "plane", "tracks")),
        *("identify-backbone", "sample-fit", "residual-spectrum", "forecast"),
    ],
    "runs": ["runs-backbone", "runs-tracks", "runs-samples"],
    "study": ["side-by-side", "answer-order-needed"],
}
MANY = {"planes": 2, "noise": 5, "side-by-side": 5}
"""Figures that are rows of small drawings."""
SIDES = tuple(FIGURES)


# Every drawing that is laid out, with its accessible name, its size and its texts.
DRAWINGS = """
[...document.querySelectorAll("figure")].map(figure => {
  const drawn = [...figure.querySelectorAll("svg[role=img]")].filter(s => s.getClientRects().length);
  return {id: figure.id, drawings: drawn.map(svg => {
    const box = svg.getBoundingClientRect();
    return {width: box.width, height: box.height, name: svg.getAttribute("aria-label"),
      texts: [...svg.querySelectorAll("text")].filter(t => t.getClientRects().length).map(text => {
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
        assert len(figure["drawings"]) == MANY.get(figure["id"], 1), figure["id"]
        for drawing in figure["drawings"]:
            assert drawing["width"] > (100 if figure["id"] in MANY else 0.7 * min(width, 760)), figure["id"]
            assert drawing["height"] > 100, figure["id"]
            assert len(drawing["name"]) > 5, figure["id"]


@pytest.mark.parametrize("side", ["empty", "hostile"])
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


def test_a_dark_screen_gets_a_dark_page(browser: Browser, pages: dict[str, Path]) -> None:
    background = "getComputedStyle(document.body).backgroundColor"
    curve = "getComputedStyle(document.querySelector('#motion svg path.sl')).stroke"
    browser.open(pages["full"])
    light = browser.evaluate(background), browser.evaluate(curve)
    browser.open(pages["full"], dark=True)
    dark = browser.evaluate(background), browser.evaluate(curve)
    assert light[0] == "rgb(255, 255, 255)"
    assert max(int(v) for v in re.findall(r"\d+", dark[0])) < 60
    assert light[1] != dark[1]


HEIGHT = "document.documentElement.scrollHeight"


def test_the_contents_stay_and_mark_where_the_reader_is(browser: Browser, pages: dict[str, Path]) -> None:
    browser.open(pages["full"])
    current = "document.querySelector('.toc [aria-current]').textContent"
    assert browser.evaluate(current) == "Accuracy and cost"
    browser.evaluate("document.querySelector('#section-motion').scrollIntoView()")
    browser.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    assert browser.evaluate(current) == "Motion, planes"
    assert browser.evaluate("document.querySelector('.toc').getBoundingClientRect().top") < 40


def test_the_page_is_read_without_scripts(browser: Browser, pages: dict[str, Path]) -> None:
    browser.open(pages["full"], scripts=False)
    text = browser.evaluate("document.querySelector('main').innerText")
    for wanted in ("Perturbation expansion", "All 13 contenders", "The paper, claim by claim", "Provenance"):
        assert wanted in text
    shown = browser.evaluate(
        "[...document.querySelectorAll('svg[role=img]')].filter(s => s.getBoundingClientRect().height > 100).length"
    )
    assert shown == browser.evaluate("document.querySelectorAll('figure').length") - 2 + MANY["planes"] + MANY["noise"]
    hidden = "[...document.querySelectorAll('button,input[type=range]')].filter(b => b.getClientRects().length).length"
    assert browser.evaluate(hidden) == 0


def test_check_boxes_hide_a_way_without_scripts(browser: Browser, pages: dict[str, Path]) -> None:
    browser.open(pages["full"], scripts=False)
    drawn = "[...document.querySelectorAll('#in-time svg.wide .fT')].filter(g => g.getClientRects().length).length"
    assert browser.evaluate(drawn) >= 1
    browser.evaluate("document.querySelector('#in-time input.kT').checked = false")
    assert browser.evaluate(drawn) == 0


def test_arrow_keys_read_a_curve_and_linked_figures_follow(browser: Browser, pages: dict[str, Path]) -> None:
    """At the left end the readout gives the first time and the displacement there; nothing on the page moves."""
    browser.open(pages["full"])
    readout = "document.querySelector('#motion .out').textContent"
    before = browser.evaluate(HEIGHT)
    assert browser.evaluate(readout) == ""
    browser.evaluate("document.querySelector('#motion .drawing').focus()")
    browser.press("Home")
    said = browser.evaluate(readout)
    assert said.startswith("t = 0 s")
    assert f"{synthetic.make_decay().u[0]:.5g}" in said
    browser.press("ArrowRight")
    assert browser.evaluate(readout) != said
    assert browser.evaluate("document.querySelectorAll('#in-time .xh').length") == 2, "linked figures move together"
    assert browser.evaluate(HEIGHT) == before
    browser.press("Escape")
    assert browser.evaluate(readout) == ""
    assert browser.complaints() == []


def test_every_figure_is_read_from_end_to_end(browser: Browser, pages: dict[str, Path]) -> None:
    """Linked figures that cover another stretch say nothing beyond their own, and raise nothing."""
    for side in SIDES:
        browser.open(pages[side])
        for key in browser.evaluate("[...document.querySelectorAll('figure.reads')].map(f => f.id)"):
            browser.evaluate(f"document.querySelector('#{key} .drawing').focus()")
            for end in ("Home", "End"):
                browser.press(end)
        assert browser.complaints() == []


TOLD = [("full", key) for key in ("accuracy-cost", "noise", "budget")] + [("study", "side-by-side")]
"""Figures whose marks are read one by one."""
MARKS = """[...document.querySelectorAll('#{0} .drawing > svg title')].map(t => t.parentElement)
  .filter(e => e.getClientRects().length)"""


@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize(("side", "key"), TOLD)
def test_marks_are_read_by_pointer_finger_and_keys(
    browser: Browser, pages: dict[str, Path], side: str, key: str, width: int
) -> None:
    """Each way gives the title of the very mark, rings it alone, and moves nothing."""
    browser.open(pages[side], width=width)
    marks, out = MARKS.format(key), f"document.querySelector('#{key} .out').textContent"
    rings = f"document.querySelectorAll('#{key} .ring').length"
    titles = browser.evaluate(f"{marks}.map(e => e.querySelector('title').textContent)")
    assert len(titles) > 3
    assert all(re.search(r"[^:]+: .*\d", title) for title in titles)
    before = browser.evaluate(HEIGHT)
    browser.evaluate(f"document.querySelector('#{key} .drawing').focus()")
    said = []
    for pressed in ("Home", "ArrowRight", "End", "ArrowLeft"):
        browser.press(pressed)
        said.append(browser.evaluate(out))
        assert browser.evaluate(rings) == 1
    assert said == [titles[0], titles[1], titles[-1], titles[-2]]
    browser.press("Escape")
    assert (browser.evaluate(out), browser.evaluate(rings)) == ("", 0)
    browser.evaluate(f"{marks}[3].scrollIntoView({{block: 'center'}})")
    box = browser.evaluate(f"(r => [r.left, r.top, r.width, r.height])({marks}[3].getBoundingClientRect())")
    browser.hover((box[0] + box[2] / 2, box[1] + box[3] / 2))
    assert browser.evaluate(out) == titles[3]
    assert browser.evaluate(HEIGHT) == before
    for kind, x in (("pointerdown", box[0]), ("pointerleave", 0)):
        event = f"{{bubbles: true, pointerType: 'touch', clientX: {x}, clientY: {box[1] + box[3] / 2}}}"
        browser.evaluate(
            f"document.querySelector('#{key} .drawing').dispatchEvent(new PointerEvent('{kind}', {event}))"
        )
    assert browser.evaluate(out) == titles[3], "a finger's reading stays"
    assert browser.complaints() == []


def test_marks_of_a_way_that_is_hidden_are_not_read(browser: Browser, pages: dict[str, Path]) -> None:
    browser.open(pages["full"])
    count = f"{MARKS.format('accuracy-cost')}.length"
    every = browser.evaluate(count)
    browser.evaluate("document.querySelector('#accuracy-cost .drawing').focus()")
    browser.press("Home")
    browser.evaluate("document.querySelector('#accuracy-cost input.kE').click()")
    assert 0 < browser.evaluate(count) < every
    assert browser.evaluate("document.querySelectorAll('#accuracy-cost .ring').length") == 0
    assert browser.evaluate("document.querySelector('#accuracy-cost .out').textContent") == ""


def test_sliders_move_value_error_and_curve(browser: Browser, pages: dict[str, Path]) -> None:
    """The value is that of the code in the page at the very amplitude, the error the grid's own, rounded up."""
    browser.open(pages["full"])
    study = synthetic.make_study()
    curve = "document.querySelector('#order-map svg.wide .moving path').getAttribute('d')"
    before = browser.evaluate(curve)
    browser.evaluate("""(() => { for (const [s, v] of [[".so", 2], [".sa", 20]]) {
      const e = document.querySelector("#order-map " + s); e.value = v; e.dispatchEvent(new Event("input")); } })()""")
    amplitude = study.amplitudes[20]
    value = (1 - 0.0625 * amplitude**2) / (2 * np.pi)
    assert browser.evaluate("document.querySelector('#order-map .rv').textContent") == f"{value:.5g} Hz"
    assert browser.evaluate("document.querySelector('#order-map .oo').textContent") == "6"
    said = browser.evaluate("document.querySelector('#order-map .re').textContent")
    assert float(said.split()[1]) / 100 >= 1.001 * abs(study.relative_error[2, 20])
    assert before.startswith("M")
    assert browser.complaints() == []


def test_a_figure_is_saved_as_a_file_of_its_own(browser: Browser, pages: dict[str, Path]) -> None:
    """The SVG stands without the page's style sheet, and the CSV holds what the readout says."""
    browser.open(pages["full"])
    saved = browser.evaluate("""(() => {
      const got = [];
      HTMLAnchorElement.prototype.click = function () { got.push([this.download, decodeURIComponent(this.href)]); };
      document.querySelectorAll('#motion [data-save=svg], #motion [data-save=csv]').forEach(b => b.click());
      return got;
    })()""")
    assert [name for name, _ in saved] == ["motion.svg", "motion.csv"]
    drawing = saved[0][1].partition(",")[2]
    assert drawing.startswith("<svg")
    assert "stroke:rgb(" in drawing
    assert "var(--" not in drawing
    rows = saved[1][1].partition(",")[2].splitlines()
    assert rows[0] == '"t","θ","amplitude"'
    assert float(rows[1].split(",")[1]) == pytest.approx(synthetic.make_decay().u[0], rel=1e-5)
    assert browser.complaints() == []


def _at(browser: Browser, selector: str, across: float, down: float) -> tuple[float, float]:
    """A place in a drawing, in pixels of the window."""
    browser.evaluate(f"document.querySelector('{selector}').scrollIntoView()")
    box = f"(r => [r.left, r.top, r.width, r.height])(document.querySelector('{selector}').getBoundingClientRect())"
    x, y, width, height = browser.evaluate(box)
    return x + across * width, y + down * height


def test_a_time_figure_is_stretched_by_dragging_and_linked_ones_follow(
    browser: Browser, pages: dict[str, Path]
) -> None:
    """From 5 s to 10 s of 20: the views of all panels are a quarter of theirs, the ticks are new; 0 shows all again."""
    browser.open(pages["full"])
    views = """[...document.querySelectorAll("#in-time svg.wide .z, #motion svg.wide .z, #planes .z")]
      .map(z => +z.getAttribute("viewBox").split(" ")[2])"""
    labels = "[...document.querySelectorAll('#motion svg.wide .xt text')].map(t => t.textContent)"
    whole, before = browser.evaluate(views), browser.evaluate(labels)
    left, middle = (_at(browser, "#motion svg.wide", 0.044 + 0.944 * share, 0.5) for share in (0.25, 0.5))
    browser.drag(left, middle)
    found = browser.evaluate(views)
    assert found == pytest.approx([0.25 * width for width in whole], rel=0.02)
    assert {"5", "10"} < {str(int(float(t))) for t in browser.evaluate(labels)}
    assert not browser.evaluate("document.querySelector('#motion .whole').hidden")
    browser.evaluate("document.querySelector('#motion .drawing').focus()")
    browser.press("0")
    assert browser.evaluate(views) == whole
    assert browser.evaluate(labels) == before
    browser.press("+")
    assert browser.evaluate(views) == pytest.approx([0.5 * width for width in whole], rel=0.02)
    assert browser.complaints() == []


def test_a_plane_is_stretched_too_and_read_in_the_stretch(browser: Browser, pages: dict[str, Path]) -> None:
    """From 5 s to 10 s of the second plane: its middle then reads 7.5 s."""
    browser.open(pages["full"])
    width = "+document.querySelector('#{} .z').getAttribute('viewBox').split(' ')[2]"
    whole = browser.evaluate(width.format("motion svg.wide"))
    plane = "#planes svg:nth-of-type(2)"
    browser.drag(*(_at(browser, plane, (44 + 448 * share) / 500, 0.5) for share in (0.25, 0.5)))
    assert browser.evaluate(width.format("motion svg.wide")) == pytest.approx(0.25 * whole, rel=0.02)
    browser.hover(_at(browser, plane, (44 + 448 * 0.5) / 500, 0.6))
    said = browser.evaluate("document.querySelector('#planes .out').textContent")
    assert float(re.search(r"^t = ([\d.]+)", said)[1]) == pytest.approx(7.5, abs=0.1)
    browser.evaluate("document.querySelector('#planes .whole').click()")
    assert browser.evaluate(width.format("motion svg.wide")) == whole
    assert browser.complaints() == []


def test_planes_and_the_map_are_read_under_the_pointer(browser: Browser, pages: dict[str, Path]) -> None:
    browser.open(pages["full"])
    said = "document.querySelector('#{} .out').textContent"
    browser.hover(_at(browser, "#planes svg", 0.5, 0.6))
    browser.evaluate("new Promise(done => setTimeout(done, 50))")
    browser.hover(_at(browser, "#planes svg", 0.5, 0.61))
    text = browser.evaluate(said.format("planes"))
    assert re.search(r"^t = [\d.]+ s   ω / 2π = [\d.]+ Hz   (below )?−?\d+ dB", text), text
    assert browser.evaluate("document.querySelectorAll('#motion .xh').length") == 1
    browser.hover(_at(browser, "#order-map svg.wide", 0.4, 0.7))
    assert re.search(r"^order \d+   A = [\d.]+ rad   error ≤ ", browser.evaluate(said.format("order-map")))
    browser.evaluate("document.querySelector('#planes .drawing').focus()")
    browser.press("ArrowUp")
    assert browser.evaluate(said.format("planes")).startswith("t = ")
    assert browser.complaints() == []


def test_every_figure_with_numbers_is_saved_as_csv(browser: Browser, pages: dict[str, Path]) -> None:
    for side in SIDES:
        browser.open(pages[side])
        saved = browser.evaluate("""(() => {
          const got = [];
          HTMLAnchorElement.prototype.click = function () { got.push([this.download, decodeURIComponent(this.href)]); };
          document.querySelectorAll('[data-save=csv]').forEach(b => b.click());
          return got;
        })()""")
        assert len(saved) == browser.evaluate("document.querySelectorAll('figure[data-table], figure.reads').length")
        for name, text in saved:
            rows = list(csv.reader(text.partition(",")[2].splitlines()))
            assert len(rows) > 2, name
            assert len({len(row) for row in rows}) <= (2 if name == "planes.csv" else 1), name
        assert browser.complaints() == []


def test_tables_sort_by_a_column(browser: Browser, pages: dict[str, Path]) -> None:
    browser.open(pages["full"])
    browser.evaluate("document.querySelectorAll('details').forEach(d => d.open = true)")
    first = "document.querySelector('#contenders tbody tr').textContent"
    best = browser.evaluate(first)
    click = "document.querySelectorAll('#contenders thead button')[0].click()"
    browser.evaluate(click)
    browser.evaluate(click)
    assert browser.evaluate("document.querySelector('#contenders th[aria-sort]').ariaSort") == "descending"
    assert browser.evaluate(first) != best


@pytest.mark.parametrize("scripts", [True, False], ids=["scripts", "no scripts"])
def test_a_page_prints_light_and_with_everything_unfolded(
    browser: Browser, pages: dict[str, Path], scripts: bool
) -> None:
    browser.open(pages["full"], dark=True, scripts=scripts)
    unfolded = "[...document.querySelectorAll('details table, details dl')].map(e => e.checkVisibility())"
    assert len(browser.evaluate(unfolded)) > 4
    assert not any(browser.evaluate(unfolded))
    browser.media(dark=True, kind="print")
    browser.evaluate("dispatchEvent(new Event('beforeprint'))")
    assert browser.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
    assert all(browser.evaluate(unfolded))
    assert browser.evaluate("document.querySelector('nav').getClientRects().length") == 0


def test_a_page_prints_on_at_most_ten_sheets(browser: Browser, pages: dict[str, Path]) -> None:
    for side in SIDES:
        browser.open(pages[side], dark=True)
        printed = browser.pdf()
        assert printed.startswith(b"%PDF-")
        assert 1 < len(re.findall(rb"/Type\s*/Page\b(?!s)", printed)) <= 10, side
