"""``ridgeback study FILE.toml``: run a study, or go on with it, and write its answers or its cells."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ridgeback.answers.study_text import parts
from ridgeback.console.failure import PartialError, say
from ridgeback.console.output import write_parts
from ridgeback.options.budget import Watch
from ridgeback.options.study import Run

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from ridgeback.compare.studies.plan import Plan
    from ridgeback.compare.studies.result import StudyResult

EACH = 4
"""Blocks that wait for each worker: enough that none idles while one is stored."""
FORMATS = ("text", "csv", "json")


def is_study_file(system: str | None) -> bool:
    """Whether the argument names a study, and not an oscillator."""
    if system is None or not system.endswith(".toml"):
        return False
    from ridgeback.compare.studies.file.reading import is_study

    return is_study(Path(system))


def study_file_verb(path: str, run: Run, *, style: str, output: str) -> None:
    """Run the study of a file; exit code 3 where cells have no value or a test did not pass."""
    from ridgeback.interface.studies import planned

    if style not in FORMATS:
        raise click.UsageError(f"--format {style} does not belong to a study file; use {', '.join(FORMATS)}")
    plan, store = planned(path, run.store, {}, run.settings)
    found = computed(plan, store, run)
    write_parts(output, parts(found, style))
    failed_tests = [answer.question for answer in found.answers if answer.passed is False]
    if failed_tests:
        raise PartialError(f"{', '.join(failed_tests)}: not all that was tested passes; the output says what")
    if found.failed:
        raise PartialError(f"{found.failed} of {found.cells} cells have no value; the output says why")


def computed(plan: Plan, store: Path, run: Run) -> StudyResult:
    """Compute what the store lacks, and answer."""
    from ridgeback.compare.studies.running import complete
    from ridgeback.interface.studies import computing

    try:
        with executing(run) as (executor, window), computing(plan, store, warned=say) as work:
            with Watch("study", None) as progress:
                complete(plan, work.store, executor=executor, window=window, progress=progress)
            return work.result()
    except KeyboardInterrupt:
        raise KeyboardInterrupt(f"interrupted; the same command goes on from {store}") from None


@contextmanager
def executing(run: Run) -> Iterator[tuple[Executor | None, int]]:
    """Where cells are computed, and how many blocks wait there."""
    from ridgeback.console.processes import processes

    workers = run.workers or 1
    with processes(workers) as executor:
        yield executor, EACH * workers
