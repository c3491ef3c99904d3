"""An index of the reports in a folder, from what stands at the head of each page."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path

from ridgeback.common.errors import InputError
from ridgeback.common.numbers import listing
from ridgeback.compare.report.provenance import provenance
from ridgeback.compare.report.results import Report
from ridgeback.compare.report.several.indexed import Page

HEAD_BYTES = 65_536
"""Of a file, in which its head stands."""
KINDS = ("oscillator", "drift", "recording", "recordings", "study")
PLURALS = {"study": "studies", "recordings": "sets of recordings", "drift": "drifts"}


class Head(HTMLParser):
    """Reads the title and the named metas of a page."""

    def __init__(self) -> None:
        super().__init__()
        self.metas: dict[str, str] = {}
        self.title = ""
        self._within = False

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """A tag begins."""
        found = {name: value or "" for name, value in attrs}
        self._within = tag == "title" and not self.title
        if tag == "meta" and "name" in found:
            self.metas.setdefault(found["name"], found.get("content", ""))

    def handle_endtag(self, tag: str) -> None:
        """A tag ends."""
        self._within = self._within and tag != "title"

    def handle_data(self, data: str) -> None:
        """Text between tags."""
        if self._within:
            self.title += data


def read_page(path: Path, start: Path) -> Page | None:
    """What a page says of itself; None for a file that is no report, or is an index.

    Parameters
    ----------
    path
        The file.
    start
        The folder from which it will be linked.
    """
    with path.open("rb") as file:
        text = file.read(HEAD_BYTES).decode("utf-8", errors="replace")
    head = Head()
    head.feed(text)
    kind = head.metas.get("ridgeback-kind", "")
    if head.metas.get("generator") != "ridgeback" or kind not in KINDS:
        return None
    link = Path(os.path.relpath(path, start)).as_posix()
    size = path.stat().st_size
    return Page(
        link, head.title, kind, head.metas.get("description", ""), head.metas.get("ridgeback-subject", ""), size
    )


def index_report(folder: str | os.PathLike[str], *, beside: str | os.PathLike[str] = "", command: str = "") -> Report:
    """An index of a folder of reports.

    Parameters
    ----------
    folder
        Where the pages are; folders in it are not looked into.
    beside
        The folder that the index will be in, from which it links; the same by default.
    command
        The command line that makes the same index, for its provenance.

    Returns
    -------
    Report
        With the pages in the order of their names.

    Raises
    ------
    InputError
        For a folder without a report.
    OSError
        For one that cannot be read.
    """
    place = Path(folder)
    start = Path(beside) if os.fspath(beside) else place
    files = sorted(path for path in place.iterdir() if path.suffix in (".html", ".htm") and path.is_file())
    found = tuple(page for path in files if (page := read_page(path, start)) is not None)
    if not found:
        raise InputError(f"{place} holds no report of ridgeback; write some there first (ridgeback report -o)")
    return Report(
        title=f"{len(found)} report{'s' if len(found) > 1 else ''}: {listing(list(_counts(found)))}",
        lead="",
        summary=(),
        cards=(),
        derivation=None,
        study=None,
        ranges=(),
        decay=None,
        recording=None,
        provenance=provenance({"reports": len(found)}, command=command),
        indexed=found,
    )


def _counts(pages: tuple[Page, ...]) -> Iterator[str]:
    count = Counter(page.kind for page in pages)
    for kind in KINDS:
        if count[kind]:
            one = "set of recordings" if kind == "recordings" else kind
            yield f"{count[kind]} {PLURALS.get(kind, f'{kind}s') if count[kind] > 1 else one}"
