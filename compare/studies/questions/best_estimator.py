"""``best-estimator``: which estimator errs least in each case and noise, and which others are as good."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from typing import Any

from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.compare.studies.answer import Answer
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.questions.grids import SHOWN_STROKES
from ridgeback.compare.studies.questions.motions import WHERE, Pooled, pooled
from ridgeback.compare.studies.tasks import Column, Finished

COLUMNS = (
    *WHERE,
    Column("best", "", "the estimator that errs least"),
    Column("rms", "1", "root mean square of its relative error over the interior and all trials"),
    Column("rms_sd", "1", "its standard deviation over the trials"),
    Column("as_good", "", "those within two standard deviations of it"),
    Column("next", "", "the best of those that are not as good"),
    Column("next_rms", "1", "its error"),
    Column("not_ranked", "", "those that refused a trial or covered too little"),
)
SIGMAS = 2.0


def answer(plan: Plan, blocks: Iterable[Finished]) -> Answer:
    """The best estimator of each case and noise.

    Parameters
    ----------
    plan : Plan
        The study.
    blocks : iterable of Finished
        Cells along motions.

    Returns
    -------
    Answer
        A row for each case and ratio; the figure has the error over the noise of the first case.
    """
    rows = [row for row in pooled(blocks) if not row.is_prediction]
    table = tuple(best_of(list(group)) for _, group in groupby(rows, key=place))
    wins: dict[str, int] = {}
    for line in table:
        wins[line["best"]] = wins.get(line["best"], 0) + 1
    said = tuple(f"{name} errs least in {count} of {len(table)}" for name, count in ranked(wins))
    failed = sum(row.failures for row in rows)
    title = "the estimator of least error in each case"
    return Answer("best-estimator", title, COLUMNS, table, said, drawing(rows, plan.title), failed)


def place(row: Pooled) -> tuple[Any, ...]:
    """Case and noise."""
    return row.system, row.amplitude, row.duration, row.snr_db


def ranked(wins: dict[str, int]) -> list[tuple[str, int]]:
    """Names by how often they win."""
    return sorted(wins.items(), key=lambda item: (-item[1], item[0]))


def best_of(rows: Sequence[Pooled]) -> dict[str, Any]:
    """One row of the table."""
    fit = sorted((row for row in rows if row.ranked), key=lambda row: row.rms or 0.0)
    lost = ", ".join(row.method for row in rows if not row.ranked) or "-"
    if not fit:
        blank = {column.name: None for column in COLUMNS[len(WHERE) :]}
        return {**rows[0].where(), **blank, "best": "none", "not_ranked": lost}
    best, *others = fit
    equal = [row for row in others if as_good(row, best)]
    behind = [row for row in others if row not in equal]
    return {
        **rows[0].where(),
        "best": best.method,
        "rms": best.rms,
        "rms_sd": best.rms_sd,
        "as_good": ", ".join(row.method for row in equal) or "-",
        "next": behind[0].method if behind else "-",
        "next_rms": behind[0].rms if behind else None,
        "not_ranked": lost,
    }


def as_good(row: Pooled, best: Pooled) -> bool:
    """Whether an error exceeds the least one by no more than the trials leave open."""
    doubt = SIGMAS * math.hypot(row.rms_sd or 0.0, best.rms_sd or 0.0)
    return (row.rms or 0.0) - (best.rms or 0.0) <= doubt


def drawing(rows: Sequence[Pooled], title: str) -> Picture:
    """Error over the noise of the first case, a curve for each estimator."""
    first = [row for row in rows if place(row)[:3] == place(rows[0])[:3] and math.isfinite(row.snr_db)] if rows else []
    strokes = tuple(curves(first))[:SHOWN_STROKES]
    return Picture(
        title or "estimators in noise", "SNR, dB", "relative error, rms", strokes[:SHOWN_STROKES], None, True
    )


def curves(rows: Sequence[Pooled]) -> Iterator[Stroke]:
    """One curve for each estimator."""
    for method in dict.fromkeys(row.method for row in rows):
        mine = sorted((row for row in rows if row.method == method and row.rms), key=lambda row: row.snr_db)
        yield Stroke([row.snr_db for row in mine], [row.rms or math.nan for row in mine], method, dots=len(mine) == 1)
