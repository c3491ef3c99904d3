"""Finished cells along motions: trials pooled, so that there is one row for each case, noise, method and order."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import Any

from ridgeback.common.show.picture import Picture
from ridgeback.compare.noise.results import finite, mean_and_deviation
from ridgeback.compare.studies.answer import Answer
from ridgeback.compare.studies.measures.decay import DecayTask
from ridgeback.compare.studies.measures.predicted import PREDICTIONS
from ridgeback.compare.studies.questions.grids import WHO, parameters_text
from ridgeback.compare.studies.systems import System
from ridgeback.compare.studies.tasks import Column, Finished

LEAST = 0.75
"""Share of the interior that a method must cover to be ranked."""
WHERE = (
    *WHO[:2],
    Column("amplitude", "unit of the unknown", "initial displacement, at rest"),
    Column("duration", "time unit", "length of the record"),
    Column("snr_db", "dB", "variance of the signal over that of the noise; inf is none"),
)

METHOD = (
    Column("method", "", "way to omega0(t)"),
    Column("order", "1", "highest power kept, or number of terms of the paper's series"),
)
FLOOR = Column("floor", "1", "how far two readings of the motion itself differ, relative")


@dataclass(frozen=True)
class Pooled:
    """One method on one case at one ratio, over all its trials; ``rms`` is None where no trial gave a value."""

    system: System
    amplitude: float
    duration: float
    snr_db: float
    method: str
    order: int | None
    trials: int
    failures: int
    rms: float | None
    rms_sd: float | None
    """One standard deviation of ``rms``; None for a single trial."""
    mean: float | None
    largest: float | None
    coverage: float
    """The least of all trials."""
    growth_rms: float | None
    floor: float
    truncation: float | None
    averaging: float | None
    closure: float | None

    @property
    def is_prediction(self) -> bool:
        """Whether it comes from theory."""
        return self.method in PREDICTIONS

    @property
    def ranked(self) -> bool:
        """Whether every trial gave enough of the interior to be ranked."""
        return self.rms is not None and not self.failures and self.coverage >= LEAST

    def where(self) -> dict[str, Any]:
        """The first columns of a row about it."""
        return {
            "oscillator": self.system.name,
            "parameters": parameters_text(self.system),
            "amplitude": self.amplitude,
            "duration": self.duration,
            "snr_db": self.snr_db,
        }


def pooled(blocks: Iterable[Finished]) -> Iterator[Pooled]:
    """Rows in the order of the plan."""
    for _, group in groupby(blocks, key=case_of):
        found: dict[tuple[Any, ...], list[Any]] = {}
        alike = list(group)
        for block in alike:
            for (method, _, _, snr, order, _), outcome in block.rows():
                found.setdefault((method, snr, order), []).append(outcome)
        for (method, snr, order), outcomes in found.items():
            yield _pooled(task_of(alike[0]), str(method), float(snr), order, outcomes)


def task_of(block: Finished) -> DecayTask:
    """The task of a block, which is along a motion."""
    task = block.task
    if not isinstance(task, DecayTask):
        raise TypeError(f"{type(task).__name__} is no task along a motion")
    return task


def case_of(block: Finished) -> tuple[System, float, float]:
    """What is sampled."""
    task = task_of(block)
    return task.system, task.amplitude, task.duration


def of_motions(
    question: str,
    title: str,
    columns: tuple[Column, ...],
    blocks: Iterable[Finished],
    said: Callable[[Sequence[Pooled]], Iterable[str]],
    drawn: Callable[[Sequence[Pooled]], Picture],
    shown: Callable[[Pooled], bool],
) -> Answer:
    """An answer from pooled rows: a row of the table for each that is shown, sentences and a figure from all."""
    rows = list(pooled(blocks))
    kept = [row for row in rows if shown(row)]
    names = [column.name for column in columns if column not in WHERE]
    table = tuple({**row.where(), **{name: getattr(row, name) for name in names}} for row in kept)
    failed = sum(row.failures for row in rows)
    return Answer(question, title, columns, table, tuple(said(rows)), drawn(rows), failed)


def _pooled(task: DecayTask, method: str, snr: float, order: int | None, outcomes: list[Any]) -> Pooled:
    given = [outcome for outcome in outcomes if isinstance(outcome, tuple)]
    rms = deviation = mean = largest = growth = None
    if given:
        square, square_sd = mean_and_deviation([values[0] ** 2 for values in given])
        rms = math.sqrt(square)
        deviation = finite(0.5 * square_sd / rms) if rms > 0 else 0.0
        mean = math.fsum(values[1] for values in given) / len(given)
        largest = max(values[2] for values in given)
        growth = given[0][4]
    return Pooled(
        task.system,
        task.amplitude,
        task.duration,
        snr,
        method,
        order,
        len(outcomes),
        len(outcomes) - len(given),
        rms,
        deviation,
        mean,
        largest,
        min((values[3] for values in given), default=0.0),
        growth,
        max((values[5] for values in given), default=math.nan),
        *(given[0][6:9] if given else (None, None, None)),
    )
