"""The sections of several signals: their table, samples, frequencies, and what made each."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ridgeback.common.numbers import NONE, per_cent
from ridgeback.compare.report.several.runs import Named, Runs, facts
from ridgeback.reports.figures.recordings.identification import parameter_table
from ridgeback.reports.figures.recordings.runs import runs_backbone, runs_samples, runs_tracks
from ridgeback.reports.parts import Part, Section, fold
from ridgeback.reports.text.tables import Row, Table

if TYPE_CHECKING:
    from ridgeback.compare.report.results import Report


def runs_head(report: Report) -> tuple[Part, ...]:
    """All backbones over one another, below the cards."""
    runs = report.runs
    if runs is None or all(one.backbone is None for one in runs.found.measured):
        return ()
    return (Part("figure", runs_backbone(runs)),)


def runs_sections(report: Report) -> Iterator[Section]:
    """Sections of a page on several signals; none of another page."""
    runs = report.runs
    if runs is None:
        return
    yield Section("signals", "Signals", f"{len(runs.labels)} signals", (Part("table", signal_table(runs)),))
    yield Section("tracks", "Frequency in time", "Frequency in time", (Part("figure", runs_tracks(runs)),))
    yield Section("samples", "The records", "The records", (Part("figure", runs_samples(runs)),))
    if runs.named:
        yield Section("identification", "What made them", _named_title(runs), tuple(_named(runs)))
    notes = [
        f"{label}: {note}" for label, one in zip(runs.labels, runs.found.measured, strict=True) for note in one.notes
    ]
    said = [*runs.found.failed, *runs.found.notes, *notes]
    if said:
        yield Section("notes", "Notes", "What was found on the way", (fold(f"{len(said)} notes", Part("lines", said)),))


def signal_table(runs: Runs) -> Table:
    """One row for each signal."""
    rows = [facts(one) for one in runs.found.measured]
    return Table(
        "signals",
        "Amplitudes are those of the fundamental; ± one standard deviation; damping ratio: median.",
        ("signal", *rows[0]),
        tuple(Row((label, *row.values())) for label, row in zip(runs.labels, rows, strict=True)),
    )


def _named_title(runs: Runs) -> str:
    made = [named.made for named in runs.named if named.made is not None]
    titles = {one.title for one in made}
    if len(titles) == 1:
        return titles.pop()
    classes = {one.standing.refusal or one.best.title for one in made}
    return f"{classes.pop()}, by every signal" if len(classes) == 1 else "What made each signal"


def _named(runs: Runs) -> Iterator[Part]:
    yield Part("table", _class_table(runs))
    for i, named in enumerate(runs.named):
        if named.made is not None:
            table = parameter_table(named.made.best, key=f"parameters-{i}", of=named.label)
            yield fold(f"Parameters of {named.label}", Part("text", named.made.verdict), Part("table", table))


def _class_table(runs: Runs) -> Table:
    return Table(
        "classes",
        "The class of least criterion for each signal, what it leaves of the signal’s rms, and the classes that the "
        "data cannot tell apart from it.",
        ("signal", "class", "leaves", "not told apart from"),
        tuple(Row(_class_row(named), named.why, failed=named.made is None) for named in runs.named),
    )


def _class_row(named: Named) -> tuple[str, str, str, str]:
    made = named.made
    if made is None:
        return named.label, "", "", ""
    others = [c.title for c in made.candidates[1:] if c.name in made.indistinguishable]
    title = made.title if made.standing.refusal else made.best.named
    return named.label, title, NONE if made.hum else per_cent(made.unexplained), ", ".join(others)
