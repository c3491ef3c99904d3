"""An index of reports: what each found, what it is about, a link to it."""

from __future__ import annotations

from collections.abc import Iterator
from urllib.parse import quote

from ridgeback.compare.report.results import Report
from ridgeback.reports.parts import Part, Section

NAMES = {
    "oscillator": "Oscillators",
    "drift": "Drifts",
    "recording": "Recordings",
    "recordings": "Several recordings",
    "study": "Studies",
}


def index_sections(report: Report) -> Iterator[Section]:
    """One section for each kind of page; none of another page."""
    for kind, name in NAMES.items():
        pages = [page for page in report.indexed if page.kind == kind]
        if pages:
            rows = [
                {
                    "href": quote(page.link),
                    "title": page.title,
                    "subject": page.subject,
                    "lead": page.lead,
                    "file": f"{page.link}, {page.size / 1000:.0f} kB",
                }
                for page in pages
            ]
            yield Section(f"kind-{kind}", name, name, (Part("links", rows),))
