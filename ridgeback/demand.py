"""What ``derive`` is to make of an expansion beyond printing it, and which of the options go together."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import wraps
from typing import Any

import click

from ridgeback.long_run import checkpoint_path

Command = Callable[..., None]

# The forms that each use has; the first use that is asked for names the row.
FORMS = {
    "digits": ("text", "json"),
    "workers": ("text", "json", "latex", "mathml", "python"),
}
PLAIN = ("text", "json", "latex", "mathml", "python")
NEEDS = {"checkpoint": "digits"}


@dataclass(frozen=True)
class Demand:
    """The options of ``derive`` beyond those of the derivation, as they were said; None or False where not."""

    digits: int | None = None
    checkpoint: str | None = None
    workers: int | None = None
    verify: bool = False
    style: str = "text"

    def asked(self, name: str) -> bool:
        """Whether an option was given."""
        return getattr(self, name) not in (None, False)

    def check(self) -> None:
        """Raise click.UsageError for options that do not go together.

        >>> Demand(digits=20, style="latex").check()
        Traceback (most recent call last):
            ...
        click.exceptions.UsageError: --format latex does not go with --digits; use text or json
        """
        for name, other in NEEDS.items():
            if self.asked(name) and not self.asked(other):
                raise click.UsageError(f"--{name} belongs to --{other}; leave it out, or give --{other}")
        uses = [name for name in FORMS if self.asked(name)]
        if len(uses) > 1:
            raise click.UsageError(f"--{uses[0]} and --{uses[1]} exclude each other; keep one")
        forms = FORMS[uses[0]] if uses else PLAIN
        if self.style not in forms:
            with_what = f"--{uses[0]}" if uses else "an expansion"
            raise click.UsageError(
                f"--format {self.style} does not go with {with_what}; use {', '.join(forms[:-1])} or {forms[-1]}"
            )


def demanding(command: Command) -> Command:
    """Give a verb these options, as one ``demand``."""

    @wraps(command)
    def wrapped(**options: Any) -> None:
        demand = Demand(**{item.name: options.pop(item.name) for item in fields(Demand)})
        demand.check()
        command(demand=demand, **options)

    for option in (
        click.option("--verify", is_flag=True, help="Check by independent routes and print the certificate."),
        click.option(
            "--workers",
            type=click.IntRange(1, 1024),
            default=None,
            metavar="N",
            help="Derive exactly modulo many primes, N processes at a time: for very high orders on many cores.",
        ),
        click.option(
            "--checkpoint",
            type=checkpoint_path,
            default=None,
            metavar="FILE",
            help="With --digits: keep the state there, every few minutes and on Ctrl-C; the same command resumes it.",
        ),
        click.option(
            "--digits",
            type=click.IntRange(1, 10_000),
            default=None,
            metavar="D",
            help="Certified balls of at least D digits instead of exact coefficients: for very high orders.",
        ),
    ):
        wrapped = option(wrapped)
    return wrapped
