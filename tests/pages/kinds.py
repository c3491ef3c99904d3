"""Make a page of every kind, and pictures of each as screens of three sizes and paper show it: for looking at them.

    python -m tests.pages.kinds FOLDER [--decay FILE] [--axe axe.min.js] [--no-pictures] [KIND...]

Told of each page: the seconds of a core that it took with all processes it started, its size, its height at 1280 and at
400 px, its sheets of A4, and with ``--axe`` what axe-core (npm's ``axe-core``) finds in it, light and dark, wide and
narrow.  A page that is already in the folder is kept, with no seconds told.
"""

from __future__ import annotations

import argparse
import base64
import re
import resource
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from tests.pages.axe import VIOLATIONS
from tests.pages.requests import KINDS, prepare
from tests.pages.scripts import HEIGHT, UNFOLD
from tests.reports.chromium import NAMES, Browser, binary

PICTURES = {
    "1280": {"width": 1280},
    "1280-dark": {"width": 1280, "dark": True},
    "768": {"width": 768},
    "400": {"width": 400},
    "400-dark": {"width": 400, "dark": True},
    "no-scripts": {"width": 1280, "scripts": False},
}


def ridgeback(folder: Path, *words: str) -> float:
    """Run a command in a folder; the seconds of a core that it took, its processes' included."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, "-m", "ridgeback", *words], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def sheets(pdf: bytes) -> int:
    """The pages of a PDF."""
    return len(re.findall(rb"/Type\s*/Page\b(?!s)", pdf))


def photographed(browser: Browser, page: Path) -> None:
    """Pictures of the whole page in every manner, and its PDF, beside it."""
    for name, manner in PICTURES.items():
        browser.open(page, **manner)
        size = {"x": 0, "y": 0, "width": manner["width"], "height": browser.evaluate(HEIGHT), "scale": 1}
        taken = browser.call("Page.captureScreenshot", format="png", captureBeyondViewport=True, clip=size)
        page.with_name(f"{page.stem}-{name}.png").write_bytes(base64.b64decode(taken["data"]))


def judged(browser: Browser, page: Path, axe: str) -> Iterator[str]:
    """What axe-core finds, with where it was found."""
    for width in (1280, 400):
        for dark in (False, True):
            browser.open(page, width=width, dark=dark)
            browser.evaluate(UNFOLD)
            browser.evaluate(axe)
            yield from (f"{width} {'dark' if dark else 'light'}: {found}" for found in browser.evaluate(VIOLATIONS))


def told(browser: Browser, page: Path) -> str:
    """Size, heights and sheets of a page; its PDF is written beside it."""
    heights = []
    for width in (1280, 400):
        browser.open(page, width=width)
        heights.append(browser.evaluate(HEIGHT))
    printed = browser.pdf()
    page.with_suffix(".pdf").write_bytes(printed)
    size = page.stat().st_size / 1000
    return f"{size:6.0f} kB {heights[0]:6d} px at 1280 {heights[1]:6d} px at 400 {sheets(printed):3d} sheets"


def main() -> int:
    """Make, measure, photograph and judge; 1 where axe-core finds something."""
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("folder", type=Path)
    options.add_argument("--decay", type=Path, help="a measured decay in place of the sample")
    options.add_argument("--axe", type=Path, help="axe.min.js")
    options.add_argument("--no-pictures", action="store_true")
    options.add_argument("kinds", nargs="*", metavar="KIND", help=", ".join(KINDS))
    given = options.parse_intermixed_args()
    path = binary()
    if path is None:
        sys.exit(f"no browser: none of {', '.join(NAMES)} is on the path")
    given.folder.mkdir(parents=True, exist_ok=True)
    if given.decay is not None:
        (given.folder / "decay.csv").write_bytes(given.decay.read_bytes())
    browser, wrong = Browser(path), 0
    try:
        browser.attach()
        for kind in given.kinds or KINDS:
            page = given.folder / f"{kind}.html"
            prepare(kind, given.folder, ridgeback)
            spent = "" if page.exists() else f"{ridgeback(given.folder, 'report', *KINDS[kind], '-o', page.name):.1f} s"
            print(f"{kind:20s} {spent:>7s} {told(browser, page)}", flush=True)
            found = list(judged(browser, page, given.axe.read_text(encoding="utf-8"))) if given.axe else []
            wrong += len(found)
            print("".join(f"    {line}\n" for line in found), end="", flush=True)
            if not given.no_pictures:
                photographed(browser, page)
    finally:
        browser.close()
    return int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main())
