"""``ridgeback study FILE.toml``: run a study, or go on with it, and write its answers or its cells."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ridgeback.answers.study_tables import FORMATS as TABLES
from ridgeback.answers.study_tables import check_table, write_table
from ridgeback.answers.study_text import comparison_text, parts
from ridgeback.console.failure import PartialError, say
from ridgeback.console.output import write_bytes, write_parts, write_text
from ridgeback.options.budget import Watch
from ridgeback.options.study import STORE, Run

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from ridgeback.compare.studies.plan import Plan
    from ridgeback.compare.studies.result import StudyResult

EACH = 4
"""Blocks that wait for each worker: enough that none idles while one is stored."""


def is_study_file(system: str | None) -> bool:
    """Whether the argument names a study or a store of one, and not an oscillator."""
    if system is None or not system.endswith((".toml", STORE)):
        return False
    from ridgeback.compare.studies.file.reading import is_study

    return system.endswith(STORE) or is_study(Path(system))


def study_file_verb(path: str, run: Run, *, style: str, output: str) -> None:
    """Run the study of a file; exit code 3 where cells have no value or a test did not pass."""
    if run.against is not None:
        write_text(output, against(path, run, style))
        return
    if path.endswith(STORE):
        raise click.UsageError(f"{path} is a store; name its study to go on with it, or give --against another store")
    from ridgeback.interface.studies import planned

    plan, store = planned(path, run.store, {}, run.settings)
    if run.dry:
        from ridgeback.compare.studies.prediction import predicted

        write_text(output, "\n".join(predicted(plan).sentences(run.workers or 1)) + "\n")
        return
    if style in TABLES:
        check_table(style, output)
    found = computed(plan, store, run)
    written(found, run, style, output)
    complain(found)


def written(found: StudyResult, run: Run, style: str, output: str) -> None:
    """Write what was asked for."""
    if run.plot is not None:
        from ridgeback.reports.figures.studies import plot_file

        write_bytes(run.plot, plot_file(found.answers, run.plot.rpartition(".")[2].lower()))
    if style in TABLES:
        write_table(found, style, output)
    else:
        write_parts(output, parts(found, style))


def complain(found: StudyResult) -> None:
    """Raise PartialError where a test did not pass or cells have no value."""
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
    if run.scheduler is not None:
        if run.workers is not None:
            raise click.UsageError("--workers are processes here, --scheduler has workers of its own; keep one")
        from ridgeback.console.cluster import cluster

        with cluster(run.scheduler) as (executor, threads):
            yield executor, EACH * threads
        return
    from ridgeback.console.processes import processes

    workers = run.workers or 1
    with processes(workers) as pool:
        yield pool, EACH * workers


def against(path: str, run: Run, style: str) -> str:
    """What differs between the store of a study, or a store, and another."""
    from ridgeback.compare.studies.against import compared
    from ridgeback.compare.studies.store import existing

    one = Path(run.store or (path if path.endswith(STORE) else Path(path).with_suffix(STORE)))
    with existing(one) as first, existing(Path(str(run.against))) as second:
        return comparison_text(compared(first, second, warned=say), style)
