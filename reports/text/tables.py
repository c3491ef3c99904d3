"""The tables of a page: scores, budget, ranges of use, timings, as text cells ready to be set."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ridgeback.common.numbers import NONE, number, relative, rounded_down, threshold
from ridgeback.compare.motion.results import BudgetRow, Score
from ridgeback.compare.report.results import EstimatorScore
from ridgeback.compare.study.results import Certified, Range, Timing


@dataclass(frozen=True)
class Row:
    """One row; ``remark`` is set below it over the whole width, ``failed`` marks a method that gave nothing."""

    cells: tuple[str, ...]
    remark: str = ""
    failed: bool = False


@dataclass(frozen=True)
class Table:
    """A table; the first column is text, the others are numbers."""

    key: str
    caption: str
    head: tuple[str, ...]
    rows: tuple[Row, ...]


def score_table(scores: Sequence[Score], reference: str) -> Table:
    """Return one row per method, failures kept."""
    return Table(
        "methods",
        f"Relative error of ω₀(t) against {reference}. Mean is signed: negative means low. "
        "Start and end are the border zones hatched above.",
        ("method", "kind", "rms, interior", "largest, interior", "mean, interior", "rms, start", "rms, end"),
        tuple(_score_row(score) for score in scores),
    )


def _score_row(score: Score) -> Row:
    if score.failed:
        return Row((score.label, score.kind, *(NONE,) * 5), f"Failed: {score.failed}", failed=True)
    cells = (
        score.label,
        score.kind,
        relative(score.rms_interior),
        relative(score.max_interior),
        relative(score.mean_interior, signed=True),
        relative(score.rms_start),
        relative(score.rms_end),
    )
    return Row(cells, score.note)


def estimator_table(scores: Sequence[EstimatorScore], reference: str) -> Table:
    """Return every estimator on the same samples, failures kept."""
    return Table(
        "estimators",
        f"Every estimator with its own defaults on the samples of u: relative rms error of ω₀(t) against {reference} "
        "as the method gives it, then with its own estimate of its bias removed; the half width of its 95 % interval "
        "(median over the interior), the share of the interior where that interval holds the reference, and CPU time, "
        "bias and interval included. A dash: nothing valid there, or no interval claimed.",
        ("method", "raw, interior", "interior", "start", "end", "half width", "coverage", "CPU"),
        tuple(_estimator_row(score) for score in scores),
    )


def _estimator_row(score: EstimatorScore) -> Row:
    if score.failed:
        return Row((score.method, *(NONE,) * 7), f"Failed: {score.failed}", failed=True)
    cells = (
        score.method,
        relative(score.rms_raw),
        relative(score.rms_interior),
        relative(score.rms_start),
        relative(score.rms_end),
        relative(score.half_width),
        NONE if score.coverage is None else f"{100 * score.coverage:.0f} %",
        f"{number(score.seconds, 2)} s",
    )
    return Row(cells, score.note)


def budget_table(rows: Sequence[BudgetRow]) -> Table:
    """Return where each curve's distance from the reference comes from."""
    return Table(
        "budget-table",
        "Parts of the relative error, rms over the interior. Closure is the rms of what the named parts leave "
        "unexplained; a dash means that the part does not apply.",
        ("method", "truncation", "averaging", "estimator", "reference", "total", "closure"),
        tuple(
            Row(
                (
                    row.label,
                    relative(row.truncation),
                    relative(row.averaging),
                    relative(row.estimator),
                    relative(row.reference),
                    relative(row.total),
                    relative(row.closure),
                ),
                row.note,
            )
            for row in rows
        ),
    )


def range_table(ranges: Sequence[Range], letter: str, unit: str) -> Table:
    """Return how far each order may be used, one column per target."""
    targets = sorted({r.target for r in ranges}, reverse=True)
    reach = {(r.order, r.target): r.up_to for r in ranges}
    orders = sorted({r.order for r in ranges})
    return Table(
        "ranges",
        f"Range of use: largest {letter} studied below which the target holds everywhere"
        + (f" ({unit})." if unit else "."),
        ("order", *(f"within {threshold(target)}" for target in targets)),
        tuple(Row((str(order), *(_reach(reach, order, target) for target in targets))) for order in orders),
    )


def _reach(reach: dict[tuple[int, float], float | None], order: int, target: float) -> str:
    if (order, target) not in reach:
        return NONE
    up_to = reach[order, target]
    return "nowhere" if up_to is None else number(rounded_down(up_to, 4))


def certified_table(found: Certified, unit: str) -> Table:
    """Return the series beside its resummations, one column per amplitude."""
    largest = max((row.radius for row in found.rows), default=0.0)
    where = "peak amplitudes" if found.variable == "A" else f"values of {found.variable}"
    return Table(
        "certified",
        f"Relative error of ω₀ by each formula of order {found.order} at {where}"
        + (f" in {unit}" if unit else "")
        + f", enclosed against the exact frequency in ball arithmetic: proved to within {relative(largest)}. "
        "A dash means that the formula does not hold there.",
        ("formula", *(f"{found.variable} = {number(a)}" for a in found.amplitudes)),
        tuple(Row((row.method, *(relative(e, signed=True) for e in row.errors))) for row in found.rows),
    )


def timing_table(timings: Sequence[Timing]) -> Table:
    """Return what one evaluation costs."""
    return Table(
        "timings",
        "Median time of one evaluation over an array, per value, with the fastest and slowest repeat. "
        "Measured on the machine that made this page.",
        ("evaluation", "ns per value", "fastest", "slowest", "values"),
        tuple(
            Row((t.name, number(t.nanoseconds, 3), number(t.low, 3), number(t.high, 3), str(t.values)), t.note)
            for t in timings
        ),
    )
