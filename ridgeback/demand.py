"""What ``derive`` is to make of an expansion beyond printing it, and which of the options go together."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, fields
from fractions import Fraction
from functools import wraps
from typing import Any

import click

from ridgeback.arguments import MAX_GRID, number, positive, rational, shown, written
from ridgeback.grids import amplitudes
from ridgeback.long_run import checkpoint_path

Command = Callable[..., None]

PLAIN = ("text", "json", "latex", "mathml", "python")
TABLE = ("text", "json", "csv")
ALL = (*PLAIN, "csv")

# What can be made of an expansion, one at a time, and the forms that each has; --at goes with the first three.
USES = {"digits": ("text", "json"), "workers": PLAIN, "resummed": PLAIN, "transient": TABLE, "harmonics": PLAIN}
NEEDS = {
    "checkpoint": "digits",
    "degrees": "resummed",
    "growth": "resummed",
    "until": "transient",
    "points": "transient",
    "transient": "until",
}
# Not of the expansion that is printed, so that a certificate would be of something else.
UNVERIFIED = ("resummed", "transient", "harmonics")
NOT_AT = ("transient", "harmonics")


@dataclass(frozen=True)
class Demand:
    """The options of ``derive`` beyond those of the derivation, as they were said; None or False where not."""

    digits: int | None = None
    checkpoint: str | None = None
    workers: int | None = None
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
        for name, other in NEEDS.items():
            if self.asked(name) and not self.asked(other):
                raise click.UsageError(f"--{name} needs --{other}; give that, or leave --{name} out")
        uses = [name for name in USES if self.asked(name)]
        if len(uses) > 1:
            raise click.UsageError(f"--{uses[0]} and --{uses[1]} exclude each other; keep one")
        if self.verify and uses and uses[0] in UNVERIFIED:
            raise click.UsageError(f"--verify certifies an expansion, not what --{uses[0]} makes of it; keep one")
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


def degrees(text: str) -> tuple[int, int]:
    """The degrees of a quotient of polynomials.

    >>> degrees("3/2")
    (3, 2)
    """
    found = re.fullmatch(r"(\d{1,4})/(\d{1,4})", text.strip(), re.ASCII)
    if found is None:
        raise ValueError(f"{shown(text)} are no degrees; write for example 3/2")
    return int(found[1]), int(found[2])


def start(text: str) -> tuple[float, float]:
    """An amplitude above 0, and a phase in rad, 0 unless it is given.

    >>> start("0.5"), start("2,1.5")
    ((0.5, 0.0), (2.0, 1.5))
    """
    amplitude, _, phase = text.partition(",")
    return positive(amplitude), number(phase) if phase else 0.0


def demanding(command: Command) -> Command:
    """Give a verb these options, as one ``demand``."""

    @wraps(command)
    def wrapped(**options: Any) -> None:
        demand = Demand(**{item.name: options.pop(item.name) for item in fields(Demand)})
        demand.check()
        command(demand=demand, **options)

    for option in (
        click.option("--verify", is_flag=True, help="Check by independent routes and print the certificate."),
        click.option("--harmonics", is_flag=True, help="Print the motion u itself: every harmonic, exactly."),
        click.option(
            "--points",
            type=click.IntRange(2, MAX_GRID),
            default=None,
            metavar="N",
            help="With --transient: how many equidistant times.  Default: 11.",
        ),
        click.option(
            "--until",
            type=written(positive),
            default=None,
            metavar="T",
            help="With --transient: the last time; the first is 0.",
        ),
        click.option(
            "--transient",
            type=written(start),
            default=None,
            metavar="A0[,PHI0]",
            help="Follow amplitude and phase of the slow flow (multiple-scales) from these at time 0.",
        ),
        click.option(
            "--growth",
            type=written(rational),
            default=None,
            metavar="P",
            help="With --resummed map: the power of x that omega0 follows at infinity, x the square of the variable.",
        ),
        click.option(
            "--degrees",
            type=written(degrees),
            default=None,
            metavar="M/N",
            help="With --resummed: degrees of numerator and denominator.  Default: equal ones; for a map N = 0.",
        ),
        click.option(
            "--resummed",
            type=click.Choice(("pade", "map", "nome")),
            default=None,
            help="Another formula from the same coefficients: a Padé approximant, the change of variable that moves "
            "the nearest singularity away, the elliptic nome.",
        ),
        click.option(
            "--at",
            type=written(amplitudes),
            default=None,
            metavar="A,...",
            help="Enclose the exact frequency at these amplitudes (or START:STOP:COUNT), and prove the error of the "
            "series there.",
        ),
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
