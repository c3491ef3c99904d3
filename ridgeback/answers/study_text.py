"""The answers of a study as text and JSON, its cells as CSV: cells are read and written one after the other."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Iterable, Iterator, Mapping
from itertools import islice
from typing import TYPE_CHECKING, Any

from ridgeback.common.csv_text import cell
from ridgeback.common.visible import no_formula
from ridgeback.console.output import json_text, plain
from ridgeback.console.tables import aligned, csv_text
from ridgeback.console.tables import readable as readable_value

if TYPE_CHECKING:
    from ridgeback.compare.studies.against import Comparison
    from ridgeback.compare.studies.answer import Answer
    from ridgeback.compare.studies.result import StudyResult

SHOWN_ROWS = 40
"""Rows of a table for reading; the others are counted."""
SHOWN_FAILURES = 8
SHOWN_SENTENCES = 24
LEADING = ("oscillator", "parameters", "method", "amplitude", "duration", "snr_db", "tolerance")
"""Columns that say what a row is about."""
AT_ONCE = 2000
"""Rows that are turned into text at once."""


def parts(found: StudyResult, style: str) -> Iterator[str]:
    """The output in the form asked for, piece by piece."""
    if style == "csv":
        yield from csv_parts(found)
    elif style == "json":
        yield from json_parts(found)
    elif style == "markdown":
        yield "\n".join(line for answer in found.answers for line in markdown_lines(answer)) + "\n"
    else:
        yield readable(found)


def markdown_lines(answer: Answer) -> Iterator[str]:
    """One answer as Markdown: a heading, what all rows share, its whole table, what follows from it."""
    yield f"## {answer.title[:1].upper()}{answer.title[1:]}"
    same = shared(answer)
    if same:
        yield ""
        yield ", ".join(f"{name} {same[name]}" for name in same) + "."
    columns = [column.name for column in answer.columns if column.name not in same]
    yield from ("", markdown_row(columns), markdown_row(["---"] * len(columns)))
    for row in answer.table:
        named = named_infinities(row)
        yield markdown_row([readable_value(named.get(name)) for name in columns])
    yield from ("", *(f"- {sentence}" for sentence in answer.sentences), "")


def markdown_row(cells: Iterable[str]) -> str:
    """A row of a Markdown table.

    >>> markdown_row(["a", "1 | 2"])
    '| a | 1 \\\\| 2 |'
    """
    return f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} |"


def csv_parts(found: StudyResult) -> Iterator[str]:
    """A header and one line for each cell."""
    from ridgeback.compare.studies.tidy import columns_of

    names = [column.name for column in columns_of(found.plan)]
    yield csv_lines([[no_formula(name) for name in names]])
    for rows in batches(found.rows(), AT_ONCE):
        yield csv_lines([cell(row[name]) for name in names] for row in rows)


def csv_lines(rows: Iterable[list[str]]) -> str:
    """Lines of CSV."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()


def json_parts(found: StudyResult) -> Iterator[str]:
    """One JSON object: about, columns, answers, failures, cells; a cell a line."""
    from ridgeback.compare.studies.tidy import columns_of

    columns = {column.name: {"unit": column.unit, "meaning": column.meaning} for column in columns_of(found.plan)}
    head: dict[str, Any] = {
        "about": found.about(),
        "plan": found.plan.to_dict(),
        "answers": [answer.to_dict() for answer in found.answers],
        "failures": [vars(failure) for failure in found.failures],
        "columns": columns,
    }
    text = json.dumps(plain(head), indent=2, allow_nan=False)
    yield text.removesuffix("\n}") + ',\n  "cells": [\n'
    for i, row in enumerate(found.rows()):
        yield ("" if i == 0 else ",\n") + "    " + json.dumps(plain(row), allow_nan=False)
    yield "\n  ]\n}\n"


def readable(found: StudyResult) -> str:
    """The answers, then what gave no value."""
    head = found.plan.title or "Study"
    subjects = len(found.plan.subjects)
    lines = [f"{head}: {found.cells} cells, {subjects} oscillator{'' if subjects == 1 else 's'}; {found.program}"]
    for answer in found.answers:
        lines += ["", *answer_lines(answer)]
    if found.failures:
        lines += ["", f"{found.failed} cells have no value and are left out:"]
        shown = found.failures[:SHOWN_FAILURES]
        lines += [f"  {f.cells}, the first of {f.oscillator}: {f.reason}" for f in shown]
        lines += [f"  {len(found.failures) - len(shown)} more reasons"] if len(found.failures) > len(shown) else []
    return "\n".join(lines) + "\n"


def answer_lines(answer: Answer) -> Iterator[str]:
    """One answer: its title, what all rows share, its table, what follows from it."""
    yield f"{answer.question}: {answer.title}"
    same = shared(answer)
    if same:
        yield ", ".join(f"{name} {same[name]}" for name in same)
    if answer.table:
        columns = [column.name for column in answer.columns if column.name not in same]
        yield aligned(columns, [named_infinities(row) for row in answer.table[:SHOWN_ROWS]])
    if len(answer.table) > SHOWN_ROWS:
        yield f"... {len(answer.table) - SHOWN_ROWS} more rows; --format json has them all"
    yield from answer.sentences[:SHOWN_SENTENCES]
    if len(answer.sentences) > SHOWN_SENTENCES:
        yield f"... {len(answer.sentences) - SHOWN_SENTENCES} more sentences; --format json has them all"


def shared(answer: Answer) -> dict[str, str]:
    """The leading columns that have one value in all rows, with that value."""
    if len(answer.table) < 2:
        return {}
    table = [named_infinities(row) for row in answer.table]
    values = {name: {row.get(name) for row in table} for name in LEADING if name in table[0]}
    return {name: readable_value(found.pop()) for name, found in values.items() if len(found) == 1}


def named_infinities(row: Mapping[str, Any]) -> dict[str, Any]:
    """A row for reading, its infinite numbers as words."""
    return {name: "inf" if value == math.inf else value for name, value in row.items()}


def comparison_text(found: Comparison, style: str) -> str:
    """What differs between two stores."""
    if style == "json":
        return json_text(found.to_dict())
    columns = ("cell", "column", "before", "after", "relative")
    rows = [vars(change) for change in found.changes]
    if style == "csv":
        return csv_text(columns, rows)
    counts = f"{found.equal} cells are equal to the last digit, {found.changed} differ"
    lone = f"{found.only_first} are in the first store only, {found.only_second} in the second only"
    lines = [*found.settings, f"{counts}; {lone}"]
    if rows:
        lines += ["", aligned(columns, rows)]
    return "\n".join(lines) + "\n"


def batches(rows: Iterable[Any], size: int) -> Iterator[list[Any]]:
    """Rows in lists of so many.

    >>> list(batches(range(5), 2))
    [[0, 1], [2, 3], [4]]
    """
    source = iter(rows)
    while batch := list(islice(source, size)):
        yield batch
