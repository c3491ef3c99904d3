"""What a study will cost, from one block of each kind: cells, processor time, memory, size of the store."""

from __future__ import annotations

import sys
import time
from dataclasses import dataclass

from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.running import spoken, tasks_of
from ridgeback.compare.studies.tasks import Task, inputs_of, outcomes_text, run

try:
    import resource
except ImportError:  # where the system does not count, memory is not said
    resource = None  # type: ignore[assignment]

LONGEST = 20.0
"""Seconds that blocks are tried for; kinds that are not reached cost what the others do."""


@dataclass(frozen=True)
class Prediction:
    """The cost of a study."""

    cells: int
    blocks: int
    seconds: float
    """Of one processor, for all cells."""
    megabytes: float | None
    """Of each process."""
    store_megabytes: float
    tried: int
    """Blocks that this is predicted from."""

    def sentences(self, workers: int) -> list[str]:
        """The prediction in words.

        >>> print(*Prediction(100, 10, 90.0, 200.0, 0.5, 2).sentences(2)[:2], sep="; ")
        100 cells in 10 blocks; about 90 s of one processor, 45 s on 2
        """
        memory = [] if self.megabytes is None else [f"about {self.megabytes:.0f} MB in each process"]
        on = f", {spoken(self.seconds / workers)} on {workers}" if workers > 1 else ""
        return [
            f"{self.cells} cells in {self.blocks} blocks",
            f"about {spoken(self.seconds)} of one processor{on}",
            *memory,
            f"about {self.store_megabytes:.2g} MB stored",
        ]


def predicted(plan: Plan, *, longest: float = LONGEST) -> Prediction:
    """Compute one block of each kind, and scale.

    Parameters
    ----------
    plan : Plan
        The study.
    longest : float
        Seconds that may be spent on it, about.

    Returns
    -------
    Prediction
        Its cost.
    """
    counts: dict[str, int] = {}
    costs: dict[str, float] = {}
    cells = blocks = size = tried_cells = 0
    began = time.monotonic()
    for task in tasks_of(plan):
        kind, count = kind_of(task), len(task.cells())
        cells, blocks = cells + count, blocks + 1
        counts[kind] = counts.get(kind, 0) + count
        if kind not in costs and time.monotonic() - began < longest:
            start = time.process_time()
            outcomes = run(task)
            costs[kind] = (time.process_time() - start) / count
            size += len(inputs_of(task)) + len(outcomes_text(outcomes)) + 200
            tried_cells += count
    usual = sum(costs.values()) / max(len(costs), 1)
    seconds = sum(count * costs.get(kind, usual) for kind, count in counts.items())
    return Prediction(cells, blocks, seconds, peak(), size * cells / max(tried_cells, 1) / 1e6, len(costs))


def kind_of(task: Task) -> str:
    """Blocks of one kind cost about the same for a cell: same oscillator, same methods."""
    methods = getattr(task, "methods", None) or getattr(task, "method", "")
    return f"{task.system.name} {methods}"


def peak() -> float | None:
    """The most memory that this process has had, in MB."""
    if resource is None:
        return None
    unit = 1.0 if sys.platform == "darwin" else 1024.0
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit / 1e6
