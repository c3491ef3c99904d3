"""Pages of equations in headless Chromium, held to the rules of a page; and a page that is spoilt breaks every rule.

The made-up pages of ``tests/reports`` show what these do not: names that would run, figures without data, zooming and
reading to the digit.
"""

from __future__ import annotations

import inspect
from pathlib import Path

import pytest

from tests.pages.look import Look, Seen, everything
from tests.pages.page_rules import PageRules
from tests.reports.chromium import Browser


@pytest.mark.parametrize("kind", ["paper", "duffing", "van-der-pol", "bilinear", "cubic", "helmholtz-duffing"])
class TestPagesOfEquations(PageRules):
    """Motions of the paper's pendulum, of others, of a limit cycle, of a kink, of an equation that is typed."""


SPOILT = """(() => {
  const main = document.querySelector("main"), all = s => [...document.querySelectorAll(s)];
  const ground = getComputedStyle(document.body).backgroundColor;
  console.error("said");
  new Image().src = "absent.png";
  const wide = document.createElement("div");
  wide.textContent = "only now " + Math.random();
  Object.assign(wide.style, {width: "3000px", height: "20000px", color: ground});
  main.append(wide);
  for (const text of all("figure svg text")) text.after(text.cloneNode(true));
  for (const text of all("figure svg text, mi, mn")) text.style.fontSize = "2px";
  for (const mark of all("figure path, figure circle, figure rect, figure image, figure line"))
    if (mark.closest("figure") === document.querySelector("figure")) mark.style.display = "none";
  for (const box of all("figure .drawing")) box.tabIndex = -1;
  for (const series of all("figure [class^=f]")) series.style.setProperty("display", "inline", "important");
  for (const button of all("thead button")) button.replaceWith(button.cloneNode(true));
  for (const link of all("a[download]")) link.href = "data:text/csv,a,b%0A1%0A";
})()"""
"""A word on the console, a picture from elsewhere, a text that is wide, high, without contrast and never the same,
labels twice and small, a figure without marks, figures out of the keyboard's reach, series that stay, columns that do
not sort, a table with holes."""


@pytest.fixture(scope="module")
def spoilt(browser: Browser, look: Look, tmp_path_factory: pytest.TempPathFactory) -> Seen:
    """A page that breaks each of the rules; without its policy, too."""
    page = Path(look("bilinear")["page"].removeprefix("file://")).read_text(encoding="utf-8")
    path = tmp_path_factory.mktemp("spoilt") / "spoilt.html"
    policy = '<meta http-equiv="Content-Security-Policy"'
    assert policy in page
    path.write_text(page.replace(policy, "<meta name=none"), encoding="utf-8")
    return everything(browser, path, spoilt=SPOILT)


@pytest.mark.parametrize("rule", [name for name in vars(PageRules) if name.startswith("test_")])
def test_each_rule_sees_a_page_that_breaks_it(spoilt: Seen, rule: str) -> None:
    held = getattr(PageRules(), rule)
    for width in (1280, 400) if "width" in inspect.signature(held).parameters else (None,):
        with pytest.raises(AssertionError):
            held(lambda _: spoilt, "bilinear", *([] if width is None else [width]))
