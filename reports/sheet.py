"""What stands on one page, whatever it is about: title, cards, first figure, findings, sections."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ridgeback.compare.report.results import Card, Described, Report
from ridgeback.reports.drift_sections import drift_head
from ridgeback.reports.parts import Part, Section
from ridgeback.reports.recording_sections import recording_head
from ridgeback.reports.runs_sections import runs_head
from ridgeback.reports.sections import head_parts, head_tables, sections
from ridgeback.reports.study_sections import study_head


@dataclass(frozen=True)
class Sheet:
    """A page before it is set."""

    title: str
    kind: str
    """What an index of pages calls it."""
    subject: str = ""
    """What it is about, for an index."""
    lead: str = ""
    described: Described | None = None
    cards: tuple[Card, ...] = ()
    figure: tuple[Part, ...] = ()
    """Below the cards."""
    summary: tuple[str, ...] = ()
    tables: tuple[Part, ...] = ()
    """Below the summary."""
    head_name: str = "Overview"
    """The head in the table of contents."""
    sections: tuple[Section, ...] = ()
    code: Mapping[int, str] = field(default_factory=dict)
    """The JavaScript of each order, for the sliders."""


def report_sheet(report: Report) -> Sheet:
    """The page of a report on one oscillator or one recording."""
    return Sheet(
        title=report.title,
        kind=_kind(report),
        subject=_subject(report),
        lead=report.lead,
        described=report.described,
        cards=report.cards,
        figure=(
            *head_parts(report),
            *recording_head(report),
            *runs_head(report),
            *study_head(report),
            *drift_head(report),
        ),
        summary=report.summary,
        tables=head_tables(report),
        head_name="Accuracy and cost" if report.benchmark else "Overview" if report.cards or report.answered else "",
        sections=sections(report),
        code={} if report.grid is None else report.grid.code,
    )


def _subject(report: Report) -> str:
    """The oscillator, or the recording."""
    if report.described is not None:
        return ", ".join(part for part in (report.described.name, report.described.given) if part)
    return "" if report.recording is None else f"{report.recording.source}, {report.recording.column}"


def _kind(report: Report) -> str:
    """What an index calls the page."""
    if report.indexed:
        return "index"
    if report.drift is not None:
        return "drift"
    if report.answered is not None:
        return "study"
    if report.runs is not None:
        return "recordings"
    return "recording" if report.recording is not None else "oscillator"
