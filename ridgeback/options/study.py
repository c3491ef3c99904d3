"""The options of a study that comes from a file, and of one that is said in words on the command line."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import wraps
from typing import Any

import click

from ridgeback.console.output import OutputPath
from ridgeback.options.arguments import ASSIGNMENT, shown, written
from ridgeback.options.budget import checkpoint_path
from ridgeback.options.plot import plot_option
from ridgeback.options.shared import Decorated, added
from ridgeback.options.system import Choice, named_by

EXAMPLES = ("paper", "five-oscillators", "noise", "crossing", "estimators")
KEY = re.compile(r"[A-Za-z_][A-Za-z0-9_]*(\.[A-Za-z0-9_-]{1,60}){0,5}", re.ASCII)
STORE = ".db"


@dataclass(frozen=True)
class Run:
    """How a study from a file is run."""

    store: OutputPath | None
    settings: tuple[tuple[str, str], ...]
    workers: int | None
    scheduler: str | None
    against: str | None
    dry: bool
    plot: str | None

    @property
    def made(self) -> bool:
        """Whether anything was said that belongs to a study from a file alone."""
        return any((self.store, self.workers, self.scheduler, self.against, self.dry, self.plot))


def setting(text: str) -> tuple[str, str]:
    """A key of a study, or a parameter, and the text of its value.

    >>> setting("orders=2,4"), setting("signal.trials = 12")
    (('orders', '2,4'), ('signal.trials', '12'))
    """
    name, sign, value = text.partition("=")
    if not sign or not KEY.fullmatch(name.strip()) or not value.strip():
        raise ValueError(f"{shown(text)} is not KEY=VALUE; write for example mu=0.01 or orders=2,4,8")
    return name.strip(), value.strip()


OPTIONS = (
    click.option(
        "--store",
        type=checkpoint_path,
        default=None,
        metavar="FILE",
        help="Of a study file: where finished cells are kept.  Default: beside it, with the ending .db.",
    ),
    click.option(
        "--workers", type=click.IntRange(1, 1024), default=None, metavar="N", help="Of a study file: N processes."
    ),
    click.option(
        "--scheduler",
        default=None,
        metavar="tcp://HOST:PORT",
        help="Of a study file: the workers of a dask scheduler (pip install ridgeback[distributed]).",
    ),
    click.option(
        "--dry-run", "dry", is_flag=True, help="Of a study file: say cells, time and memory, and compute no study."
    ),
    click.option(
        "--against", default=None, metavar="STORE", help="Of a study file or store: what differs from another store."
    ),
    plot_option("the answers to the questions of a study file"),
)
EXAMPLE = click.option(
    "--example", type=click.Choice(EXAMPLES), default=None, help="Print a study file that ships with ridgeback."
)
SET = click.option(
    "--set",
    "settings",
    type=written(setting),
    multiple=True,
    metavar="KEY=VALUE",
    help="Give a parameter a value, exactly as written (0.01 is 1/100); of a study file, any of its keys.  Repeatable.",
)


def studying(command: Decorated) -> Callable[..., Any]:
    """Give the verb ``study`` its system as ``choice``, and what belongs to a study file as ``run``."""

    @wraps(command)
    def wrapped(
        *args: Any,
        system: str | None,
        equation: str | None,
        about: str | None,
        potential: str | None,
        settings: tuple[tuple[str, str], ...],
        store: OutputPath | None,
        workers: int | None,
        scheduler: str | None,
        dry: bool,
        against: str | None,
        plot: str | None,
        **rest: Any,
    ) -> None:
        choice = Choice(system, equation, about, potential, ())
        run = Run(store, settings, workers, scheduler, against, dry, plot)
        command(*args, choice=choice, run=run, **rest)

    return added(named_by(wrapped), (EXAMPLE, SET, *OPTIONS))


def with_parameters(choice: Choice, run: Run) -> Choice:
    """The oscillator with the parameters that were set, for a study that is no file.

    Raises click.BadParameter for a value that is no number, click.UsageError for options that need a file.
    """
    if run.made:
        raise click.UsageError(
            "--store, --workers, --scheduler, --dry-run, --against and --plot belong to a study file; "
            "ridgeback study --example paper prints one"
        )
    return replace(choice, assignments=tuple(ASSIGNMENT(f"{key}={value}") for key, value in run.settings))
