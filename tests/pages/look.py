"""A page made from its request as a reader makes it, opened wide and light, narrow and dark, and without scripts."""

from __future__ import annotations

import contextlib
import io
import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ridgeback.cli import main
from tests.pages import scripts
from tests.pages.requests import KINDS, LESS, prepare
from tests.reports.chromium import Browser

Seen = dict[str, Any]
Look = Callable[[str], Seen]
"""What is seen of the page of a kind."""


def ridgeback(folder: Path, *words: str) -> None:
    """One command in a folder, which must end well; what it says is not shown."""
    said = io.StringIO()
    with contextlib.chdir(folder), contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(said):
        code = main(words)
    assert code in (0, 3), f"{words}: exit code {code}{os.linesep}{said.getvalue()}"


def make(kind: str, folder: Path) -> Path:
    """Write what a kind needs and its page into a folder."""
    prepare(kind, folder, ridgeback, less=True)
    ridgeback(folder, "report", *KINDS[kind], *LESS[kind], "-o", f"{kind}.html")
    return folder / f"{kind}.html"


def everything(browser: Browser, page: Path, *, spoilt: str = "0") -> Seen:
    """All that the rules are about, by width; what a reader does is done on the wide page.

    ``spoilt`` is done to the page whenever it is opened: by it a rule is seen to see.
    """
    found: Seen = {}
    for width in (400, 1280):
        browser.open(page, width=width, dark=width == 400)
        browser.evaluate(spoilt)
        found[str(width)] = {"height": browser.evaluate(scripts.HEIGHT)}
        browser.evaluate(scripts.UNFOLD)
        found[str(width)] |= {name: browser.evaluate(said) for name, said in scripts.LOOKED_AT.items()}
    found["figures"] = [figure | read(browser, figure["id"]) for figure in browser.evaluate(scripts.FIGURES)]
    found |= {name: browser.evaluate(said) for name, said in scripts.DONE.items()}
    found["complaints"], found["requests"] = browser.complaints(), browser.requests()
    found["smuggled"] = browser.evaluate(scripts.SMUGGLED)
    browser.open(page, scripts=False)
    browser.evaluate(spoilt)
    browser.evaluate(scripts.UNFOLD)
    found["without scripts"] = browser.evaluate(scripts.SHOWN)
    found["drawn without scripts"] = [figure["drawn"] for figure in browser.evaluate(scripts.FIGURES)]
    found["buttons without scripts"] = browser.evaluate(scripts.BUTTONS)
    found["page"] = page.as_uri()
    return found


def read(browser: Browser, key: str) -> dict[str, Any]:
    """What a figure says to the keys and to a pointer, and whether the page keeps its height."""
    out = f"document.getElementById({json.dumps(key)}).querySelector('.out')?.textContent"
    browser.hover((1, 1))
    before, said = browser.evaluate(scripts.HEIGHT), []
    browser.evaluate(f"document.getElementById({json.dumps(key)}).querySelector('.drawing').focus()")
    browser.evaluate(scripts.SETTLED)
    for pressed in ("Home", "ArrowRight", "End", "Escape"):
        browser.press(pressed)
        said.append(browser.evaluate(out))
    place = browser.evaluate(scripts.READ % json.dumps(key))
    browser.evaluate(scripts.SETTLED)
    browser.hover(place)
    pointed = browser.evaluate(out)
    return {"keys": said, "pointed": pointed, "still": browser.evaluate(scripts.HEIGHT) == before}
