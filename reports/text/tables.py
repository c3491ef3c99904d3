"""The tables of a page as text cells ready to be set: contenders, budget, ranges of use, certified errors."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import groupby

from ridgeback.common.numbers import NONE, alike, number, per_cent, rounded_down, threshold
from ridgeback.common.quantities import measured_time, symbol
from ridgeback.compare.benchmark.contenders import Reference
from ridgeback.compare.benchmark.contenders import Row as Contender
from ridgeback.compare.benchmark.results import Benchmark
from ridgeback.compare.motion.results import BudgetRow
from ridgeback.compare.report.naming import at_most, capital, floor_words, refused_names, short_name, written_of
from ridgeback.compare.study.results import Certified, Range
from ridgeback.reports.text.align import aligned


@dataclass(frozen=True)
class Row:
    """One row; ``remark`` is set below it over the whole width, ``failed`` marks a method that gave nothing."""

    cells: tuple[str, ...]
    remark: str = ""
    failed: bool = False


@dataclass(frozen=True)
class Table:
    """A table; the first column is text, the others are numbers, aligned at the decimal point, or text too."""

    key: str
    caption: str
    head: tuple[str, ...]
    rows: tuple[Row, ...]

    def __post_init__(self) -> None:
        """Pad the numbers of each column; a remark that several rows share stands once, in the caption."""
        said = [row.remark for row in self.rows if not row.failed]
        shared = [text for text in dict.fromkeys(said) if text and said.count(text) > 1]
        notes = dict(zip(shared, NOTES, strict=False))
        marked = [_noted(row, notes) for row in self.rows]
        columns = list(zip(*(row.cells for row in marked), strict=True))
        padded = [columns[0], *(aligned(column) for column in columns[1:])] if columns else []
        cells = list(zip(*padded, strict=True))
        object.__setattr__(self, "rows", tuple(replace(row, cells=new) for row, new in zip(marked, cells, strict=True)))
        object.__setattr__(self, "caption", " ".join((self.caption, *(f"{m} {text}" for text, m in notes.items()))))

    @property
    def texts(self) -> tuple[bool, ...]:
        """Which columns are text that is read: letters begin all their cells, and one is longer than a word for none.

        >>> Table("t", "", ("signal", "class", "leaves"), (Row(("first", "Linear oscillator", "0.1 %")),)).texts
        (True, True, False)
        """
        columns = ([cell.strip() for cell in column] for column in zip(*(row.cells for row in self.rows), strict=True))
        read = [
            all(not cell or cell[0].isalpha() for cell in column) and max(map(len, column)) > LONGEST_WORD
            for column in columns
        ]
        return (True, *read[1:]) if read else (True,) * len(self.head)


LONGEST_WORD = 14
"""Letters of what stands in place of a number, such as "not claimed", at most."""

NOTES = ("¹", "²", "³", "⁴")


def _noted(row: Row, notes: Mapping[str, str]) -> Row:
    """A row whose remark stands in the caption, with the mark of it behind its name."""
    if row.failed or row.remark not in notes:
        return row
    name, *numbers = row.cells
    return replace(row, cells=(f"{name}\u2009{notes[row.remark]}", *numbers), remark="")


def contender_table(found: Benchmark) -> Table:
    """Every contender, best first, one row for its amplitudes and languages; refused ones last with the reason."""
    groups: dict[str, list[Contender]] = {}
    for row in found.contenders:
        groups.setdefault(short_name(row), []).append(row)
    ranked = {name: rows for name, rows in groups.items() if any(r.relative_rms_error is not None for r in rows)}
    refused: dict[str, list[Contender]] = {}
    for name, rows in groups.items():
        if name not in ranked:
            refused.setdefault(rows[0].refused or "it gives no value", []).extend(rows[:1])
    sources = [s for s in ("action", "energy", "fit") if any(r.amplitude_from == s for r in found.contenders)]
    both = len(sources) > 1
    named = {"action": "averaged action", "energy": "energy", "fit": "turning points"}
    heads = [f"rms, A(t) by {named[s]}" for s in sources] if both else ["rms error"]
    timed = any(r.time_ns_per_value is not None for r in found.contenders)
    ordered = sorted(ranked.items(), key=lambda item: min(_error(r) for r in item[1]))
    every = [row for _, rows in ordered for row in rows]
    columns = ([_rms(r) for r in every], [r.largest for r in every], [r.mean for r in every])
    written = [written_of(values, found.reference) for values in columns]
    low, high = (number(x, 3) for x in found.support)
    span = f"{low} to {high} {found.case.time_unit}".strip()
    caption = f"Relative error of ω₀(t), t = {span}; mean is signed, negative means low."
    caption += (
        " Cost: processor time in this run, C where it was compiled, ± its scatter over repeats, 1 % at least; "
        "a value of an estimate is its track’s share." * timed
    )
    caption += " An error without A(t) stands in the first column." * both
    caption += floor_words((v for r in found.contenders for v in (r.relative_rms_error, r.mean)), found.reference)
    return Table(
        "contenders",
        caption,
        ("contender", *heads, "largest", "mean", *(("a value", "a track") if timed else ())),
        (
            *(
                _contender(name, rows, sources if both else [], found.reference, timed=timed, written=written)
                for name, rows in ordered
            ),
            *(
                Row(
                    (capital(refused_names(rows)), *(NONE,) * (len(heads) + 2 + 2 * timed)),
                    f"Refused: {why}.",
                    failed=True,
                )
                for why, rows in refused.items()
            ),
        ),
    )


def _rms(row: Contender | None) -> float | None:
    return None if row is None else row.relative_rms_error


def _error(row: Contender) -> float:
    return float("inf") if row.relative_rms_error is None else row.relative_rms_error


def _contender(
    name: str,
    rows: Sequence[Contender],
    sources: Sequence[str],
    reference: Reference,
    *,
    timed: bool,
    written: Sequence[Callable[..., str]],
) -> Row:
    best = min(rows, key=_error)
    by_source = {r.amplitude_from: r for r in reversed(rows)}
    errors = [by_source.get(s) for s in sources] or [best]  # type: ignore[call-overload]
    if sources and None in by_source and all(e is None for e in errors):
        errors = [best, *errors[1:]]
    costs = [r for r in rows if r.time_ns_per_value is not None]
    cheapest = min(costs, key=lambda r: r.time_ns_per_value or 0.0, default=None)
    cost: tuple[str, ...] = ()
    if timed:
        value = None if cheapest is None else 1e-9 * float(cheapest.time_ns_per_value or 0.0)
        scatter, track = (None, None) if cheapest is None else (cheapest.time_scatter, cheapest.time_s_per_track)
        cost = (measured_time(value, scatter), measured_time(track, scatter))
    remark = "" if best.ranked else f"Not ranked: covers {100 * best.coverage:.0f} % of the interior."
    rms, largest, mean = written
    texts = [at_most(_rms(e), reference, "≤ ", missing="", written=rms) for e in errors]
    texts.append(at_most(best.largest, reference, "≤ ", written=largest))
    texts.append(at_most(best.mean, reference, "≤ ", signed=True, written=mean))
    return Row((capital(name), *texts, *cost), remark)


def budget_table(rows: Sequence[BudgetRow], reference: Reference | None = None) -> Table:
    """Where each curve's distance from the reference comes from."""
    below = floor_words((error for row in rows for error in (row.total, row.closure)), reference)
    parts = [(name, alike(getattr(row, name) for row in rows)) for name in ("truncation", "averaging", "estimator")]
    total, closure = (written_of([getattr(row, name) for row in rows], reference) for name in ("total", "closure"))
    return Table(
        "budget-table",
        "Parts of the relative error, rms over the interior. Closure is the rms of what the named parts leave "
        f"unexplained; blank: does not apply.{below}",
        ("method", "truncation", "averaging", "estimator", "total", "closure"),
        tuple(
            Row(
                (
                    capital(row.label),
                    *(written(getattr(row, name), missing="") for name, written in parts),
                    at_most(row.total, reference, "≤ ", written=total),
                    at_most(row.closure, reference, "≤ ", written=closure),
                ),
                row.note,
            )
            for row in rows
        ),
    )


def range_table(ranges: Sequence[Range], letter: str, unit: str) -> Table:
    """How far each order may be used, one column per target."""
    targets = sorted({r.target for r in ranges}, reverse=True)
    reach = {(r.order, r.target): r.up_to for r in ranges}
    orders = sorted({r.order for r in ranges})
    return Table(
        "ranges",
        f"Range of use: up to this {letter} the target holds, interpolated between those studied"
        + (f", in {unit}." if unit else "."),
        ("order", *(f"within {threshold(target)}" for target in targets)),
        tuple(_alike([(order, tuple(_reach(reach, order, target) for target in targets)) for order in orders])),
    )


def _alike(found: Sequence[tuple[int, tuple[str, ...]]]) -> Iterator[Row]:
    """One row for neighbouring orders that reach equally far.

    >>> [row.cells for row in _alike([(2, ("1.1",)), (4, ("1.1",)), (6, ("1.2",))])]
    [('2 to 4', '1.1'), ('6', '1.2')]
    """
    for cells, group in groupby(found, key=lambda pair: pair[1]):
        orders = [order for order, _ in group]
        yield Row((str(orders[0]) if len(orders) == 1 else f"{orders[0]} to {orders[-1]}", *cells))


def _reach(reach: dict[tuple[int, float], float | None], order: int, target: float) -> str:
    if (order, target) not in reach:
        return NONE
    up_to = reach[order, target]
    if up_to is None:
        return "nowhere"
    return number(rounded_down(up_to, 3)) if up_to < 0.01 else f"{math.floor(1000 * up_to) / 1000:.3f}"


def certified_table(found: Certified, unit: str) -> Table:
    """The series beside its resummations, one column per amplitude."""
    largest = max((row.radius for row in found.rows), default=0.0)
    written = [alike(column) for column in zip(*(row.errors for row in found.rows), strict=True)]
    where = "peak amplitudes" if found.variable == "A" else f"values of {symbol(found.variable)}"
    return Table(
        "certified",
        f"Relative error of ω₀ by each formula of order {found.order} at {where}"
        + (f" in {unit}" if unit else "")
        + f", enclosed against the exact frequency in ball arithmetic: proved to within {per_cent(largest)}. "
        "A dash means that the formula does not hold there.",
        ("formula", *(f"{symbol(found.variable)} = {number(a)}" for a in found.amplitudes)),
        tuple(
            Row(
                (
                    capital(row.method).replace("Pade", "Padé"),
                    *(said(e, signed=True) for said, e in zip(written, row.errors, strict=True)),
                )
            )
            for row in found.rows
        ),
    )
