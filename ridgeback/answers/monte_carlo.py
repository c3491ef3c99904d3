"""The table of ``ridgeback estimate --monte-carlo``: estimators in noise beside the Cramer-Rao bound."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

import click

from ridgeback.common.numbers import uncertain
from ridgeback.common.progress import showing
from ridgeback.console.output import json_text, write_text
from ridgeback.console.tables import aligned, csv_text
from ridgeback.options.arguments import number, shown, written

if TYPE_CHECKING:
    from ridgeback.compare.noise.results import NoiseCell, NoiseStudy
    from ridgeback.compare.noise.truth import Truth
    from ridgeback.numeric.recording.recording import Recording
    from ridgeback.options.model import Model
    from ridgeback.symbolic.systems.oscillator import Oscillator

Decorated = TypeVar("Decorated", bound=Callable[..., Any])

DEFAULT = "default"
MOST_RATIOS = 50


def ratios(text: str) -> tuple[float, ...]:
    """Signal-to-noise ratios in decibels, rising.

    >>> ratios("20,0,-5")
    (-5.0, 0.0, 20.0)
    """
    values = sorted({number(word) for word in text.split(",")})
    if len(values) > MOST_RATIOS:
        raise ValueError(f"{len(values)} ratios are more than {MOST_RATIOS}; give fewer")
    return tuple(values)


def monte_carlo_options(command: Decorated) -> Decorated:
    """``--monte-carlo``, ``--snr``, ``--seed`` and ``--workers``."""
    for option in (
        click.option(
            "--workers",
            type=click.IntRange(1, 1024),
            default=None,
            metavar="N",
            help="With --monte-carlo: N processes at a time; the table is the same.  Default: 1.",
        ),
        click.option("--seed", type=click.IntRange(0), default=1, show_default=True, help="Of the noise."),
        click.option(
            "--snr",
            type=written(ratios),
            default="0,10,20,30,40",
            show_default=True,
            metavar="DB,DB,...",
            help="Signal-to-noise ratios of --monte-carlo.",
        ),
        click.option(
            "--monte-carlo",
            "monte_carlo",
            is_flag=False,
            flag_value=DEFAULT,
            default=None,
            metavar="[TRIALS]",
            help="Errors in noise instead: trials on FILE's smooth model, else on SYSTEM, else on the paper's case.",
        ),
    ):
        command = option(command)
    return command


def trials_and_file(word: str, file: str | None) -> tuple[int | None, str | None]:
    """The number of trials, None for the default, and FILE, which may have come right after the option.

    >>> trials_and_file("100", "run.csv"), trials_and_file("run.csv", None)
    ((100, 'run.csv'), (None, 'run.csv'))
    >>> trials_and_file("many", "run.csv")
    Traceback (most recent call last):
        ...
    click.exceptions.BadParameter: 'many' is not a number of trials; give a whole number such as 100
    """
    if word == DEFAULT:
        return None, file
    if word.isdecimal() and len(word) <= 9:
        return int(word), file
    if file is None:
        return None, word
    raise click.BadParameter(
        f"{shown(word)} is not a number of trials; give a whole number such as 100", param_hint="'--monte-carlo'"
    )


def monte_carlo_verb(
    source: Recording | Truth | None,
    *,
    trials: int | None,
    method: str,
    snr_db: tuple[float, ...],
    seed: int,
    band: tuple[float, float] | None,
    lag: float | None,
    model: Model,
    remove_bias: bool,
    workers: int,
    style: str,
    output: str,
) -> None:
    """Run the study and write its table; ``method`` is ``auto`` for all, or names with commas between."""
    from ridgeback.compare.noise.monte_carlo import METHODS, TRIALS, monte_carlo
    from ridgeback.console.processes import processes

    oscillator = model.oscillator()
    if source is None and oscillator is not None:
        source = simulated(oscillator)
    with showing(True) as progress, processes(workers) as executor:
        study = monte_carlo(
            source,
            methods=METHODS if method == "auto" else tuple(word.strip() for word in method.split(",")),
            snr_db=snr_db,
            trials=TRIALS if trials is None else trials,
            seed=seed,
            band=band,
            lag_seconds=lag,
            remove_bias=remove_bias,
            oscillator=oscillator,
            free=() if oscillator is None else model.to_find(oscillator),
            executor=executor,
            progress=progress,
        )
    write_text(output, study_text(study, style))
    if not study.complete:
        fewest = min(cell.trials for cell in study.cells)
        raise KeyboardInterrupt(f"interrupted: {fewest} or more of {study.trials} trials were done in each cell")


def simulated(oscillator: Oscillator) -> Truth:
    """An oscillator from its own initial state, over as long and as finely as a report would show it."""
    from ridgeback.compare.motion.motion import setting
    from ridgeback.compare.noise.truth import oscillator_truth

    chosen = setting(oscillator)
    return oscillator_truth(oscillator, chosen.initial, duration=chosen.duration, rate=chosen.rate)


def study_text(study: NoiseStudy, style: str) -> str:
    """A noise study in the form asked for."""
    if style == "json":
        return json_text(study.as_dict())
    rows = study.rows()
    if style == "csv":
        return csv_text(list(rows[0]), rows)
    cells = [readable_cell(cell) for cell in study.cells]
    return heading(study) + "\n\n" + aligned(list(cells[0]), cells) + "\n" + reasons(study)


def heading(study: NoiseStudy) -> str:
    """What was done, and what the columns mean."""
    low, high = study.interior
    return (
        f"{study.title}: {study.samples} samples at {study.rate:g} per time unit in white noise, "
        f"{study.trials} trials, seed {study.seed}\n"
        f"truth: {study.truth}\n"
        f"bound: Cramer-Rao, {study.bound}\n"
        f"errors are relative, over times {low:g} to {high:g}; +- is one standard deviation of the Monte-Carlo mean"
    )


def readable_cell(cell: NoiseCell) -> dict[str, Any]:
    """One line of the table."""
    return {
        "method": cell.method,
        "snr_db": cell.snr_db,
        "rms_error": uncertain(cell.rms, cell.rms_sd, plain=True),
        "bias": uncertain(cell.bias, cell.bias_sd, plain=True),
        "rms/bound": uncertain(cell.ratio, cell.ratio_sd, plain=True),
        "coverage_95": uncertain(cell.coverage, cell.coverage_sd, plain=True),
        "lost": cell.outliers,
        "refused": cell.failures,
        "trials": cell.trials,
    }


def reasons(study: NoiseStudy) -> str:
    """Why methods refused, each reason once."""
    found = dict.fromkeys(cell.reason for cell in study.cells if cell.reason)
    return "".join(f"\nrefused: {reason}" for reason in found) + ("\n" if found else "")
