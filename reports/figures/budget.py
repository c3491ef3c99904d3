"""Where the errors come from: a bar for each method's total, marks for its parts."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ridgeback.common.numbers import listing, per_cent
from ridgeback.compare.benchmark.contenders import Reference
from ridgeback.compare.motion.estimate_curves import RECIPES
from ridgeback.compare.motion.results import BudgetRow
from ridgeback.compare.report.naming import at_most, capital, floor_words, written_of
from ridgeback.reports.drawing.apart import text_width
from ridgeback.reports.drawing.figure import NARROW, WIDE, Figure, toggles
from ridgeback.reports.drawing.marks import dot, drawing, group, line, places, rect, text
from ridgeback.reports.drawing.scale import Scale
from ridgeback.reports.drawing.ticks import error_ticks
from ridgeback.reports.figures.contending import least_drawn

ESTIMATES = frozenset(recipe.name for recipe in RECIPES)
LEAST = 1e-15
PARTS = ("truncation", "averaging", "estimator")


def letter(row: BudgetRow) -> str:
    """The way that a row belongs to."""
    if row.method in ESTIMATES or row.estimator is not None:
        return "T"
    return "E" if row.method.startswith(("lindstedt", "multiple-scales")) else "S"


def ordered(rows: Sequence[BudgetRow]) -> list[BudgetRow]:
    """By way, worst first within each."""
    return sorted(rows, key=lambda row: ("EST".index(letter(row)), -row.total))


def budget_figure(rows: Sequence[BudgetRow], reference: Reference | None = None) -> Figure:
    """The figure; totals below the reference's floor are told as at most the floor."""
    shown = ordered(rows)
    label = "Total error of each method and its parts"
    return Figure(
        key="budget",
        wide=_draw(shown, label, reference, narrow=False),
        narrow=_draw(shown, label, reference, narrow=True),
        caption="Bar: total rms error, printed at the right. Marks: its parts, measured apart; rms values do not add "
        f"up, and the table says what they leave unexplained.{_sources(rows)}"
        f"{floor_words((row.total for row in rows), reference)}",
        toggles=toggles(
            *(letter_ for letter_ in "EST" if any(letter(row) == letter_ for row in shown)),
            series=any(row.method.startswith("series-") for row in shown),
        ),
        label=label,
        table="budget-table",
    )


def _sources(rows: Sequence[BudgetRow]) -> str:
    """Where series and expansions take their amplitude from, where they stand."""
    named = any(row.method == "closed-form" for row in rows)
    return " Series and expansions are taken at A(t) from the energy of each instant." if named else ""


def _draw(rows: Sequence[BudgetRow], label: str, reference: Reference | None, *, narrow: bool) -> str:
    width, step = (NARROW, 20.0) if narrow else (WIDE, 21.0)
    size = 11.5 if narrow else 13.5
    left = min(max(text_width(short(row.label), size) for row in rows) + 12, (0.44 if narrow else 0.3) * width)
    floor = reference.floor if reference else 0.0
    written = written_of([row.total for row in rows], reference)
    totals = [at_most(row.total, reference, "≤ ", written=written) for row in rows]
    right = width - max(64.0 if narrow else 84.0, *(text_width(total, size) + 10 for total in totals))
    parts = [p for row in rows for p in (row.total, row.truncation, row.averaging, row.estimator) if p]
    x = Scale(max(0.5 * min(parts), LEAST, least_drawn(floor)), min(2.0 * max(parts), 30.0), left, right, log=True)
    gaps = [0.0, *(8.0 * (letter(a) != letter(b)) for a, b in zip(rows[1:], rows, strict=False))]
    tops = 28 + np.cumsum(gaps) + step * np.arange(len(rows))
    bottom = float(tops[-1]) + step + 4 if rows else 40.0
    marks = [*_key(rows, left, bottom + 16, width)]
    ticks = x.ticks(3 if narrow else 7)
    for value, words in zip(ticks, map(error_ticks(ticks), ticks), strict=True):
        marks += [line(x(value), 20, x(value), bottom, "g"), text(x(value), 13, words, "m sm", "middle")]
    marks += [_row(row, float(top), x, width, total) for row, top, total in zip(rows, tops, totals, strict=True)]
    return drawing(width, bottom + 26, "narrow" if narrow else "wide", label, marks)


def _key(rows: Sequence[BudgetRow], x: float, y: float, width: float) -> Iterator[str]:
    """The marks of the parts that stand in the figure, with their names."""
    names = [name for name in PARTS if any(getattr(row, name) for row in rows)]
    x = min(x, width - sum(34 + text_width(name, 12.6) for name in names))
    for name in names:
        yield _mark(name, x + 6, y) + text(x + 18, y + 4, name, "m sm")
        x += 34 + text_width(name, 12.6)


def _mark(part: str, x: float, y: float) -> str:
    if part == "truncation":
        return f'<path d="M{places(x)} {places(y - 8)}v16" class="mk1"/>'
    if part == "averaging":
        return dot(x, y, 4.2, "mk2")
    return f'<path d="M{places(x)} {places(y - 6)}l6 6-6 6-6-6z" class="mk3"/>'


def _row(row: BudgetRow, top: float, x: Scale, width: float, total: str) -> str:
    style = {"E": "e", "S": "s", "T": "t"}[letter(row)]
    y = top + 8
    end = float(x.clipped(np.array([row.total]))[0])
    marks = [
        text(x.start - 8, y + 4, short(row.label), style, "end"),
        rect(x.start, y - 4, end - x.start, 8, f"{style}f"),
    ]
    marks.append(text(width, y + 4, total, style, "end"))
    for part in PARTS:
        if size := getattr(row, part):
            marks.append(_mark(part, float(x.clipped(np.array([size]))[0]), y))
    return group(marks, f"f{letter(row)}", _told(row, total))


def _told(row: BudgetRow, total: str) -> str:
    """A row as a pointer reads it: its total and the parts that were measured."""
    parts = [f"{part} {per_cent(size)}" for part in PARTS if (size := getattr(row, part)) is not None]
    return "; ".join([f"{capital(short(row.label))}: total {total}", *parts])


def budget_heading(rows: Sequence[BudgetRow], floor: float = 0.0) -> str:
    """What rules each way, from the largest part of those of its rows that are above the reference's floor."""
    ruled: dict[str, list[str]] = {}
    for letter_, name in (("E", "the expansions"), ("S", "the models"), ("T", "the estimates")):
        own = [row for row in rows if letter(row) == letter_ and row.total > floor]
        ruling = {_ruling(row) for row in own} - {""}
        if own and len(ruling) == 1:
            ruled.setdefault(ruling.pop(), []).append(name)
    text_ = ", ".join(f"{cause} rules {listing(names)}" for cause, names in ruled.items())
    return text_[:1].upper() + text_[1:] if text_ else "Where the errors come from"


def short(label: str) -> str:
    """A label without the signal that nearly all of them see.

    >>> short("harmonic least squares on u"), short("Wigner peak of u'"), short("exact backbone at V(A) = E(t)")
    ('harmonic least squares', 'Wigner peak of u′', 'exact ω₀ at V(A) = E(t)')
    """
    plain = label.removesuffix(" on u").removesuffix(" of u")
    return plain.replace("exact backbone", "exact ω₀").replace("u'", "u′")


def _ruling(row: BudgetRow) -> str:
    """The part that is most of a row's total; empty where none is."""
    parts = {"truncation": row.truncation, "averaging": row.averaging, "the estimator’s own bias": row.estimator}
    known = {name: value for name, value in parts.items() if value}
    if not known:
        return ""
    name = max(known, key=lambda n: known[n])
    return name if known[name] > 0.7 * row.total else ""
