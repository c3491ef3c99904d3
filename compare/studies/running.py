"""The loop of a study: blocks that are missing go to an executor, a few at a time, and each is kept when it is done."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass

from ridgeback.common.progress import Progress, silent
from ridgeback.compare.studies.measures.by_name import measure_of
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.store import Store, Warned
from ridgeback.compare.studies.tasks import Finished, Outcome, Task, run

WINDOW = 8
"""Blocks that wait at an executor at any time, unless it is said otherwise: enough that no worker idles."""


@dataclass(frozen=True)
class Count:
    """Cells of a study."""

    cells: int
    blocks: int
    done: int
    """Cells whose block is in the store."""


def tasks_of(plan: Plan) -> Iterator[Task]:
    """The blocks of a plan, always in the same order."""
    return measure_of(plan.ask).tasks(plan)


def counted(plan: Plan, store: Store | None = None) -> Count:
    """How large a study is, and how much of it is there."""
    cells = blocks = done = 0
    for task in tasks_of(plan):
        size = len(task.cells())
        cells, blocks = cells + size, blocks + 1
        done += size if store is not None and store.has(task) else 0
    return Count(cells, blocks, done)


def complete(
    plan: Plan, store: Store, *, executor: Executor | None = None, window: int = WINDOW, progress: Progress = silent
) -> None:
    """Compute every block that the store lacks, and keep each at once.

    Parameters
    ----------
    plan : Plan
        The study.
    store : Store
        Opened for this plan.
    executor : concurrent.futures.Executor, optional
        Where blocks are computed; here by default.  What comes out does not depend on it.
    window : int
        Blocks handed out at a time.
    progress : callable
        Told the share of the cells that is done, and the rate and remaining time in words.

    Raises
    ------
    OSError
        When the store cannot be written, or a worker process was ended from outside.
    """
    count = counted(plan, store)
    clock = Clock(count.cells, count.done)
    missing = (task for task in tasks_of(plan) if not store.has(task))
    progress(clock.share, clock.words())
    results = in_turn(missing) if executor is None else spread(missing, executor, window)
    for task, outcomes in results:
        store.write(task, outcomes)
        clock.add(len(outcomes))
        progress(clock.share, clock.words())


def in_turn(tasks: Iterable[Task]) -> Iterator[tuple[Task, tuple[Outcome, ...]]]:
    """Compute blocks here, one after the other."""
    for task in tasks:
        yield task, run(task)


def spread(tasks: Iterable[Task], executor: Executor, window: int) -> Iterator[tuple[Task, tuple[Outcome, ...]]]:
    """Compute blocks on an executor, at most ``window`` at a time, in the order of completion."""
    waiting: dict[Future[tuple[Outcome, ...]], Task] = {}
    source = iter(tasks)
    try:
        while True:
            while len(waiting) < window and (task := next(source, None)) is not None:
                waiting[executor.submit(run, task)] = task
            if not waiting:
                return
            for future in wait(waiting, return_when=FIRST_COMPLETED).done:
                yield waiting.pop(future), future.result()
    except BrokenProcessPool as error:
        raise OSError(
            None, "a worker process was ended from outside, perhaps for its memory; the same command goes on from here"
        ) from error


def finished(plan: Plan, store: Store, *, warned: Warned) -> Iterator[Finished]:
    """Every block of a plan from the store, in order; one that is damaged is computed again, here, and kept.

    Parameters
    ----------
    plan : Plan
        The study.
    store : Store
        With all its blocks.
    warned : callable
        Told of each damaged block.
    """
    for task in tasks_of(plan):
        outcomes = store.read(task)
        if outcomes is None:
            place = "is damaged" if store.has(task) else "is missing"
            warned(f"{store.path}: a block of {len(task.cells())} cells {place}; it is computed again")
            outcomes = run(task)
            store.write(task, outcomes)
        yield Finished(task, outcomes)


class Clock:
    """Counts cells, and says how fast they come and how long the rest takes.

    >>> clock = Clock(100, 40, now=lambda: 5.0)
    >>> clock.add(10)
    >>> clock.share, clock.words()
    (0.5, '50 of 100 cells')
    """

    def __init__(self, cells: int, done: int, *, now: Callable[[], float] = time.monotonic) -> None:
        self.now = now
        self.cells, self.done, self.fresh = cells, done, 0
        self.began = self.now()

    def add(self, cells: int) -> None:
        """Count cells that were computed now."""
        self.done += cells
        self.fresh += cells

    @property
    def share(self) -> float:
        """Share of all cells that is done."""
        return self.done / max(self.cells, 1)

    def words(self) -> str:
        """Cells done, cells a second, and the time that remains at this rate."""
        head = f"{self.done} of {self.cells} cells"
        seconds = self.now() - self.began
        if not self.fresh or seconds <= 0:
            return head
        rate = self.fresh / seconds
        return f"{head}, {rate:.3g} a second, {spoken((self.cells - self.done) / rate)} left"


def spoken(seconds: float) -> str:
    """A time for reading.

    >>> spoken(8.2), spoken(600.0), spoken(7200.0)
    ('8 s', '10 min', '2.0 h')
    """
    if seconds < 120:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 7200 else f"{seconds / 3600:.1f} h"
