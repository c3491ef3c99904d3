"""``decay-error``: how far each way to omega0(t), and to the growth rate, errs along each motion."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from typing import Any

from ridgeback.common.numbers import relative
from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.compare.studies.answer import Answer
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.questions.grids import parameters_text
from ridgeback.compare.studies.questions.motions import FLOOR, METHOD, WHERE, Pooled, of_motions
from ridgeback.compare.studies.tasks import Column, Finished

COLUMNS = (
    *WHERE,
    *METHOD,
    Column("rms", "1", "root mean square of the relative error of omega0(t) over the interior and all trials"),
    Column("rms_sd", "1", "its standard deviation over the trials"),
    Column("mean", "1", "mean relative error; negative means low"),
    Column("growth_rms", "1", "root mean square of the relative error of the growth rate, by cycle"),
    Column("coverage", "1", "least share of the interior that has a value"),
    FLOOR,
)


SHOWN = 16
"""Most curves in the figure."""


def answer(plan: Plan, blocks: Iterable[Finished]) -> Answer:
    """The error of every method along every motion.

    Parameters
    ----------
    plan : Plan
        The study.
    blocks : iterable of Finished
        Cells along motions.

    Returns
    -------
    Answer
        A row for each case, ratio, method and order that gave a value; the figure has the error over the order.
    """
    title = "relative error of omega0(t) and of the growth rate along each motion"
    figure = partial(drawing, title=plan.title)
    return of_motions("decay-error", title, COLUMNS, blocks, sentences, figure, lambda row: row.rms is not None)


def by_case(rows: Sequence[Pooled]) -> dict[tuple[Any, ...], list[Pooled]]:
    """Rows by case and ratio."""
    found: dict[tuple[Any, ...], list[Pooled]] = {}
    for row in rows:
        found.setdefault((row.system, row.amplitude, row.duration), []).append(row)
    return found


def sentences(rows: Sequence[Pooled]) -> Iterator[str]:
    """The best prediction, and the best estimate in the least noise, of each case."""
    for (system, amplitude, _), mine in by_case(rows).items():
        head = f"{system.name} ({parameters_text(system)}) from {amplitude:.6g}"
        fit = [row for row in mine if row.ranked]
        best = [
            min((row for row in fit if row.is_prediction is kind), key=lambda row: (-row.snr_db, row.rms), default=None)
            for kind in (True, False)
        ]
        said = [f"{named(row)} errs {relative(row.rms)}" for row in best if row is not None]
        yield f"{head}: {', '.join(said) or 'nothing could be ranked'}"


def named(row: Pooled) -> str:
    """A method with its order."""
    return row.method if row.order is None else f"{row.method} of order {row.order}"


def drawing(rows: Sequence[Pooled], title: str) -> Picture:
    """Error over order of the first case, a curve for each method; a method without order is a level."""
    first = next(iter(by_case(rows).values()), [])
    clean = [row for row in first if row.snr_db == float("inf") and row.rms]
    orders = sorted({row.order for row in clean if row.order is not None}) or [0, 1]
    strokes = []
    for method in dict.fromkeys(row.method for row in clean):
        mine = [row for row in clean if row.method == method]
        x = orders if mine[0].order is None else [row.order or 0 for row in mine]
        y = [mine[0].rms or 0.0] * len(orders) if mine[0].order is None else [row.rms or 0.0 for row in mine]
        strokes.append(Stroke(x, y, method, dashed=mine[0].order is None, dots=False))
    name = f"{first[0].system.name} from {first[0].amplitude:.4g}" if first else title
    return Picture(name, "order", "relative error of omega0(t), rms", tuple(strokes[:SHOWN]), None, True)
