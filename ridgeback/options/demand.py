"""What ``derive`` is to make of an expansion beyond printing it, and which of the options go together."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from fractions import Fraction
from functools import wraps
from typing import Any

import click

from ridgeback.options.demand_options import OPTIONS
from ridgeback.options.shared import added

Command = Callable[..., None]

PLAIN = ("text", "json", "latex", "mathml", "python")
TABLE = ("text", "json", "csv")

# What can be made of an expansion, one at a time, and the forms that each has; --at goes with the first three.
USES = {"digits": ("text", "json"), "resummed": PLAIN, "transient": TABLE, "harmonics": PLAIN}
NEEDS = {
    "checkpoint": ("digits",),
    "degrees": ("resummed",),
    "growth": ("resummed",),
    "until": ("transient",),
    "points": ("transient",),
    "transient": ("until",),
}
CERTIFIED = ("text", "json")  # the forms that show a certificate
# Not of the expansion that is printed, so that a certificate would be of something else.
UNVERIFIED = ("resummed", "transient", "harmonics")
NOT_AT = ("transient", "harmonics")


@dataclass(frozen=True)
class Demand:
    """The options of ``derive`` beyond those of the derivation, as they were said; None or False where not."""

    digits: int | None = None
    checkpoint: str | None = None
    at: tuple[Fraction, ...] | None = None
    resummed: str | None = None
    degrees: tuple[int, int] | None = None
    growth: Fraction | None = None
    transient: tuple[float, float] | None = None
    until: float | None = None
    points: int | None = None
    harmonics: bool = False
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
        for name, others in NEEDS.items():
            if self.asked(name) and not any(map(self.asked, others)):
                wanted = " or ".join(f"--{other}" for other in others)
                raise click.UsageError(f"--{name} needs {wanted}; give that, or leave --{name} out")
        if self.growth is not None and self.resummed != "map":
            raise click.UsageError(f"--growth belongs to --resummed map, not to {self.resummed}; leave it out")
        uses = [name for name in USES if self.asked(name)]
        if len(uses) > 1:
            raise click.UsageError(f"--{uses[0]} and --{uses[1]} exclude each other; keep one")
        if self.verify and uses and uses[0] in UNVERIFIED:
            raise click.UsageError(f"--verify certifies an expansion, not what --{uses[0]} makes of it; keep one")
        if self.verify and self.style not in CERTIFIED:
            raise click.UsageError(
                f"--format {self.style} shows no certificate; use text or json, or leave --verify out"
            )
        if self.asked("at") and uses and uses[0] in NOT_AT:
            raise click.UsageError(f"--at and --{uses[0]} exclude each other; keep one")
        self._check_form("at" if self.asked("at") else uses[0] if uses else "")

    def _check_form(self, use: str) -> None:
        forms = TABLE if use == "at" else USES.get(use, PLAIN)
        if self.style not in forms:
            with_what = f"--{use}" if use else "an expansion"
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

    return added(wrapped, OPTIONS)
