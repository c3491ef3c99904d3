"""``ridgeback study --estimators``: which frequency estimator is best where, as a table."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

import click

from ridgeback.common.numbers import uncertain
from ridgeback.common.progress import showing
from ridgeback.console.output import json_text, write_text
from ridgeback.console.tables import aligned, csv_text
from ridgeback.options.budget import checkpoint_path

if TYPE_CHECKING:
    from ridgeback.compare.noise.estimator_study import CaseResult, EstimatorStudy
    from ridgeback.compare.noise.results import NoiseCell

Decorated = TypeVar("Decorated", bound=Callable[..., Any])

FLAGSHIP = "harmonic-least-squares"


def estimator_options(command: Decorated) -> Decorated:
    """``--estimators``, ``--trials``, ``--seed`` and ``--checkpoint``."""
    for option in (
        click.option(
            "--checkpoint",
            type=checkpoint_path,
            default=None,
            metavar="FILE",
            help="With --estimators: keep the cases done in this file, and go on from it.",
        ),
        click.option(
            "--seed", type=click.IntRange(0), default=1, show_default=True, help="With --estimators: of the noise."
        ),
        click.option(
            "--trials", type=click.IntRange(2), default=None, metavar="N", help="With --estimators: records per case."
        ),
        click.option(
            "--estimators",
            is_flag=True,
            help="Instead: which frequency estimator is best where, over damping, amplitude, sampling, noise, length.",
        ),
    ):
        command = option(command)
    return command


def estimators_verb(*, trials: int | None, seed: int, checkpoint: str | None, style: str, output: str) -> None:
    """Run the study and write its table; what an interrupt leaves is written too, and called partial."""
    from ridgeback.compare.noise.estimator_study import TRIALS, estimator_study

    with showing(True) as progress:
        study = estimator_study(
            trials=TRIALS if trials is None else trials, seed=seed, checkpoint=checkpoint, progress=progress
        )
    write_text(output, study_text(study, style))
    if not study.complete:
        raise KeyboardInterrupt(f"{stopped(study)}; {onward(checkpoint)}")


def stopped(study: EstimatorStudy) -> str:
    """How far an interrupted study came."""
    count = len(study.results)
    return f"interrupted after {count} case{'' if count == 1 else 's'}: the table is partial"


def onward(checkpoint: str | None) -> str:
    """How to go on after an interrupt.

    >>> onward(None), onward("cases.json")
    ('with --checkpoint FILE the next run could go on from here', 'run the same command again to go on from cases.json')
    """
    if checkpoint is None:
        return "with --checkpoint FILE the next run could go on from here"
    return f"run the same command again to go on from {checkpoint}"


def study_text(study: EstimatorStudy, style: str) -> str:
    """The study in the form asked for; ``markdown`` is the table of ``docs/results/estimators.md``."""
    if style == "json":
        return json_text(study.as_dict())
    if style == "csv":
        rows = study.rows()
        return csv_text(list(rows[0]), rows)
    rows = [row_of(result, plain=style != "markdown") for result in study.results]
    partial = "" if study.complete else f"\n{stopped(study).capitalize()}.\n"
    if style == "markdown":
        return markdown(list(rows[0]), rows) + partial
    return heading(study) + "\n\n" + aligned(list(rows[0]), rows) + "\n" + partial


def heading(study: EstimatorStudy) -> str:
    """What was done."""
    return (
        f"Relative rms error of omega(t) over the interior of {study.trials} records per case, seed {study.seed}.\n"
        "+- is one standard deviation; a method is as good as the best when it is within two of them."
    )


def row_of(result: CaseResult, *, plain: bool = True) -> dict[str, str]:
    """One case: the best method and those as good, the flagship with its bound, and the best method of another kind."""
    from ridgeback.compare.noise.results import estimator_of

    best, flagship = result.best, result.of(FLAGSHIP)
    equal = [cell.method for cell in result.tied() if cell is not best]
    bound = None if flagship is None else flagship.bound
    other = next((c for c in result.cells if estimator_of(c.method) != FLAGSHIP and c.rms is not None), None)
    return {
        "case": result.case.label,
        "best": best.method if best.rms is not None else "none",
        "as good": ", ".join(equal) or "-",
        FLAGSHIP: "-" if flagship is None else shown(flagship, plain=plain),
        "its bound": "-" if bound is None else f"{bound:.2g}",
        "best of another kind": "-"
        if other is None or other.rms is None
        else f"{other.method}: {shown(other, plain=plain)}",
    }


def shown(cell: NoiseCell, *, plain: bool) -> str:
    """The error of a cell, and how many records lost the ridge or were refused."""
    lost = cell.outliers + cell.failures
    return uncertain(cell.rms, cell.rms_sd, plain=plain) + (f" ({lost} of {cell.trials} lost)" if lost else "")


def markdown(columns: list[str], rows: list[dict[str, str]]) -> str:
    """Rows as a Markdown table.

    >>> print(markdown(["a", "b"], [{"a": "1", "b": "2 ± 1"}]), end="")
    | a | b |
    |---|---|
    | 1 | 2 ± 1 |
    """
    lines = [columns, ["---"] * len(columns), *([row[name] for name in columns] for row in rows)]
    text = "\n".join("| " + " | ".join(line) + " |" for line in lines)
    return text.replace("| --- " * len(columns), "|---" * len(columns)) + "\n"
