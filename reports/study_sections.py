"""The sections of a study: its oscillators, each question with its figure, sentences and table, and what failed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ridgeback.common.numbers import NONE, how_many, number, scientific
from ridgeback.common.show.picture import Picture
from ridgeback.compare.report.results import Report
from ridgeback.numeric.arrays import floats
from ridgeback.reports.figures.answer import answer_figure, side_by_side
from ridgeback.reports.parts import Part, Section, fold
from ridgeback.reports.text.mathml import FormulaError, mathml
from ridgeback.reports.text.tables import Row, Table

if TYPE_CHECKING:
    from ridgeback.compare.report.several.answered import Answered
    from ridgeback.compare.studies.answer import Answer

SPREAD = 1e3
"""Ratio of largest to smallest from which on a column of positive numbers is written as powers of ten."""
MOST_ROWS = 400
ROUNDING = 1e-15
CAPTIONS: Mapping[str, str] = {
    "order-needed": "Smallest studied order that stays within a tolerance there and at every smaller "
    "amplitude{panels}. A line ends where no studied order does.",
    "observed-order": "Power with which the error of an order grows, less the power of the first term that is left "
    "out; bars: 95 % intervals. Points of one order stand beside one another.",
}
"""What the figure of a question shows."""


def study_head(report: Report) -> tuple[Part, ...]:
    """The oscillators side by side, or the figure of the first question."""
    found = report.answered
    if found is None:
        return ()
    if found.panels:
        name = found.panels[0].y_label
        shared = _one_each(len(found.panels), found.grids, len(found.subjects))
        caption = f"{name[:1].upper()}{name[1:]}, its size, against {_axes(found.panels)}{shared}."
        caption += (
            " Below about 10⁻¹⁵ it is that of the arithmetic."
            if any(_rounded(picture) for picture in found.panels)
            else ""
        )
        return (Part("figure", side_by_side("side-by-side", found.panels, caption, "table-error")),)
    figure = answer_figure("first", found.answers[0].picture()) if found.answers else None
    return () if figure is None else (Part("figure", figure),)


def _axes(panels: Sequence[Picture]) -> str:
    """What the panels have across."""
    return " or ".join(dict.fromkeys(picture.x_label for picture in panels))


def _one_each(shown: int, total: int, subjects: int) -> str:
    """What the panels of a figure are of.

    >>> _one_each(5, 5, 5), _one_each(12, 20, 10), _one_each(1, 1, 1)
    (', one panel for each oscillator', ', one panel for each oscillator and method, the first 12 of 20', '')
    """
    if total < 2:
        return ""
    cut = f", the first {shown} of {total}" if shown < total else ""
    return f", one panel for each oscillator{' and method' if total > subjects else ''}{cut}"


def _rounded(picture: Picture) -> bool:
    """Whether errors are drawn that are no larger than the rounding of a double."""
    y = [floats(stroke.y) for stroke in picture.strokes]
    return any(bool((values[np.isfinite(values)] < ROUNDING).any()) for values in y)


def study_sections(report: Report) -> Iterator[Section]:
    """Sections of a page on a study; none of another page."""
    found = report.answered
    if found is None:
        return
    yield Section("systems", "Oscillators", how_many(len(found.subjects), "oscillator"), (_subjects(found),))
    for i, answer in enumerate(found.answers):
        yield _answer(answer, found, first=i == 0)
    if found.failures:
        lines = [f"{cells} cells: {reason}" for reason, cells in found.failures]
        yield Section("failed", "Without a value", "Cells without a value", (Part("lines", lines),))


def _subjects(found: Answered) -> Part:
    rows = [(f"{s.name} ({s.given})" if s.given else s.name, _set(s.equation_latex), s.name) for s in found.subjects]
    return Part("equations", rows)


def _set(latex: str) -> str:
    try:
        return mathml(latex)
    except FormulaError:
        return ""


def _answer(answer: Answer, found: Answered, *, first: bool) -> Section:
    parts = []
    if not (first and (found.panels or answer.question == "error")):
        shared = _one_each(len(answer.panels), max(len(answer.panels), found.grids), len(found.subjects))
        words = CAPTIONS.get(answer.question, "")
        key = f"answer-{answer.question}"
        caption = words.format(panels=shared if answer.panels else "") or f"{_capital(answer.title)}."
        table = f"table-{answer.question}"
        figure = (
            side_by_side(key, answer.panels, caption, table)
            if answer.panels
            else answer_figure(key, answer.picture(), caption, table)
        )
        parts += [] if figure is None else [Part("figure", figure)]
    said = [f"{_capital(sentence)}." for sentence in answer.sentences]
    if len(said) > 1:
        parts.append(Part("lines", said))
    if answer.rows():
        parts.append(fold(f"{_capital(answer.title)}, {len(answer.rows())} rows", Part("table", _table(answer))))
    title = _capital(answer.sentences[0] if len(answer.sentences) == 1 else answer.title)
    if answer.passed is not None:
        title = f"{title}: {'passed' if answer.passed else 'not passed'}"
    return Section(f"q-{answer.question}", _capital(answer.question.replace("-", " ")), title, tuple(parts))


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def _table(answer: Answer) -> Table:
    """The rows of an answer, its words in the first column."""
    rows = answer.rows()[:MOST_ROWS]
    words = [c.name for c in answer.columns if c.kind == "text"]
    telling = [name for name in words if len({row[name] for row in rows}) > 1] or words[:1]
    numbers = [c for c in answer.columns if c.kind == "number"]
    columns = [_column([row[c.name] for row in rows]) for c in numbers]
    cut = f" The first {MOST_ROWS} of {len(answer.rows())} rows." if len(answer.rows()) > MOST_ROWS else ""
    return Table(
        f"table-{answer.question}",
        f"{_capital(answer.title)}; {'; '.join(f'{_words(c.name)}: {c.meaning}' for c in numbers)}.{cut}",
        (", ".join(telling), *(_words(c.name) for c in numbers)),
        tuple(Row((_who(row, telling), *cells)) for row, cells in zip(rows, _across(columns, len(rows)), strict=True)),
    )


def _words(name: str) -> str:
    return name.replace("_", " ")


def _who(row: Mapping[str, Any], names: Sequence[str]) -> str:
    return ", ".join(str(row[name]) for name in names if row[name])


def _across(columns: Sequence[Sequence[str]], count: int) -> list[tuple[str, ...]]:
    return [tuple(column[i] for column in columns) for i in range(count)]


def _column(values: Sequence[Any]) -> list[str]:
    """Cells of one column in one notation.

    >>> _column([1e-9, 0.5, None]), _column([2, 16])
    (['1.0 × 10⁻⁹', '5.0 × 10⁻¹', '–'], ['2', '16'])
    """
    sizes = [abs(float(v)) for v in values if v]
    wide = bool(sizes) and max(sizes) / min(sizes) > SPREAD
    return [NONE if v is None else scientific(float(v)) if wide and v else number(float(v)) for v in values]
