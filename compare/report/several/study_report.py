"""A study's store as a report: its oscillators side by side, its answers, and what gave no value."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from ridgeback.common.csv_text import csv_text
from ridgeback.common.errors import InputError
from ridgeback.common.numbers import how_many, listing, number, per_cent
from ridgeback.common.progress import Progress, silent
from ridgeback.common.quantities import symbol
from ridgeback.common.show.picture import Picture
from ridgeback.compare.report.provenance import provenance
from ridgeback.compare.report.results import Report
from ridgeback.compare.report.several.answered import Answered, Subject
from ridgeback.compare.studies.answer import Answer
from ridgeback.compare.studies.measures import backbone
from ridgeback.compare.studies.measures.by_name import measure_of
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.questions.error import drawing
from ridgeback.compare.studies.questions.grids import backbone_text, called, grids, titles
from ridgeback.compare.studies.result import StudyResult, result_of
from ridgeback.compare.studies.running import counted, finished
from ridgeback.compare.studies.store import Store, Warned, existing
from ridgeback.compare.studies.systems import System

PANELS = 12
"""Oscillators side by side, at most."""
MOST_CELLS = 5000
"""Cells that go into the page as a file; the store has them all."""


def study_report(
    store: str | Path, *, command: str = "", warned: Warned = lambda _: None, progress: Progress = silent
) -> Report:
    """The answers and the cells of a finished study, from its store.

    Parameters
    ----------
    store : path
        The store of a study all of whose cells are there.
    command : str
        The command line that makes the same report, for its provenance.
    warned : callable
        Told in a line of each damaged block, which is computed again.
    progress : callable
        Called with the share of the work that is done, 0 to 1, and the name of the step.

    Returns
    -------
    Report
        Complete; cells without a value are counted by reason.

    Raises
    ------
    InputError
        For a file that is no store, and for a study that is not finished.
    OSError
        For a file that cannot be read.
    """
    path = Path(store)
    with existing(path) as kept:
        plan, program = kept.plan(), kept.about()["program"]
        _check_finished(plan, kept)
        progress(0.1, "answering")
        found = result_of(plan, kept, program, warned=warned)
        progress(0.7, "oscillators side by side")
        panels = tuple(_panels(plan, kept))
    return assembled(found, panels, command)


def assembled(found: StudyResult, panels: tuple[Picture, ...], command: str) -> Report:
    """Put the parts together; of the panels as many as a page shows."""
    plan = found.plan
    settings = {"title": plan.title, "questions": ", ".join(plan.ask), "program": found.program}
    text = json.dumps(plan.to_dict(), sort_keys=True)
    return Report(
        title=study_title(found),
        lead=study_lead(found),
        summary=tuple(_findings(found)),
        cards=(),
        derivation=None,
        study=None,
        ranges=(),
        decay=None,
        recording=None,
        provenance=provenance(settings, command=command, input_hash=hashlib.sha256(text.encode()).hexdigest()),
        csv=dict(_files(found)),
        answered=Answered(
            subjects=tuple(_subject(s.system) for s in plan.subjects),
            panels=panels[:PANELS],
            grids=len(panels),
            answers=found.answers,
            failures=tuple((failure.reason, failure.cells) for failure in found.failures),
        ),
    )


def _check_finished(plan: Plan, kept: Store) -> None:
    count = counted(plan, kept)
    if count.done < count.cells:
        raise InputError(
            f"{kept.path} holds {count.done} of {count.cells} cells; go on with its study first (ridgeback study)"
        )


def _panels(plan: Plan, kept: Store) -> Iterator[Picture]:
    if measure_of(plan.ask) is not backbone.MEASURE:
        return
    found = list(grids(finished(plan, kept, warned=lambda _: None)))
    for grid, name in zip(found, titles(found), strict=True):
        yield drawing(grid, name)


def study_title(found: StudyResult) -> str:
    """The finding of the first question: how the highest order errs on the best and on the worst oscillator."""
    name = found.plan.title or how_many(len(found.plan.subjects), "oscillator")
    first = found.answers[0]
    names = called(subject.system for subject in found.plan.subjects)
    named = {(system.name, backbone_text(system)): title for system, title in names.items()}
    verdict = _spread(first, named) if first.question == "error" else ""
    return f"{name}: {verdict or (first.sentences[0] if first.sentences else first.title)}"


def _spread(answer: Answer, named: Mapping[tuple[str, str], str]) -> str:
    """The least and the largest of the errors of the highest order; ``named`` by oscillator and parameters."""
    rows = answer.rows()
    several = len({row["method"] for row in rows}) > 1

    def who(row: Mapping[str, Any]) -> str:
        name = named[row["oscillator"], row["parameters"]]
        return f"{name}, {row['method']}" if several else name

    top = max((row["order"] for row in rows), default=None)
    mine = sorted((row for row in rows if row["order"] == top), key=lambda row: float(row["largest"]))
    if len(mine) < 2:
        return ""
    best, worst = mine[0], mine[-1]
    return (
        f"order {top} errs at most {per_cent(best['largest'])} ({who(best)}) "
        f"to {per_cent(worst['largest'])} ({who(worst)})"
    )


def study_lead(found: StudyResult) -> str:
    """How large the study is, and what was asked."""
    count = how_many(len(found.plan.subjects), "oscillator")
    text = f"{found.cells} cells over {count}; asked: {_asked(found.plan.ask)}."
    lost = f" {found.failed} cells have no value; the reasons are below." if found.failed else ""
    failed = [answer.question for answer in found.answers if answer.passed is False]
    return text + lost + (f" Not all that was tested holds: {_asked(failed)}." if failed else "")


def _asked(questions: Sequence[str]) -> str:
    """Questions in a sentence."""
    return listing([name.replace("-", " ") for name in questions])


MOST = 5


def _findings(found: StudyResult) -> Iterator[str]:
    """The answers that are one sentence, else the first sentences of all; at most five."""
    single = [answer.sentences[0] for answer in found.answers if len(answer.sentences) == 1]
    every = [sentence for answer in found.answers for sentence in answer.sentences]
    for sentence in (single or every)[:MOST]:
        yield f"{sentence[:1].upper()}{sentence[1:]}."


def _subject(system: System) -> Subject:
    oscillator = system.oscillator()
    given = ", ".join(f"{symbol(name)} = {number(value)}" for name, value in system.numbers().items())
    return Subject(system.title, oscillator.equation_latex, given)


def _files(found: StudyResult) -> Iterator[tuple[str, str]]:
    for answer in found.answers:
        names = [column.name for column in answer.columns]
        yield f"{answer.question}.csv", csv_text(names, [[row[n] for n in names] for row in answer.rows()])
    if found.cells <= MOST_CELLS:
        rows = list(found.rows())
        if rows:
            yield "cells.csv", csv_text(list(rows[0]), [list(row.values()) for row in rows])
