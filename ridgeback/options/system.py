"""Which oscillator a verb is about: a name of the catalogue, a TOML file, or an equation on the command line."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import wraps
from typing import TYPE_CHECKING, Any

import click

from ridgeback.options.shared import set_option, unique

if TYPE_CHECKING:
    from ridgeback.symbolic.systems.oscillator import Oscillator

Command = Callable[..., None]


@dataclass(frozen=True)
class Choice:
    """The oscillator as it was said; it is read when it is asked for."""

    system: str | None
    equation: str | None
    about: str | None
    potential: str | None
    assignments: tuple[tuple[str, Fraction], ...]

    @property
    def made(self) -> bool:
        """Whether an oscillator was named at all."""
        return self.system is not None or self.equation is not None

    def oscillator(self) -> Oscillator:
        """The oscillator with the parameters that were set, about the equilibrium that was named.

        Raises click.UsageError when none or two are named, InputError for what cannot be read, OSError for a file.
        """
        if self.system is not None and self.equation is not None:
            raise click.UsageError(f"both the system {self.system} and --equation are given; keep one")
        values = unique(self.assignments)
        if self.equation is not None:
            from ridgeback.symbolic.systems.description import from_text

            details = {} if self.potential is None else {"potential": self.potential}
            return from_text(self.equation, about=self.about or "0", parameters=values, **details)
        if self.potential is not None:
            raise click.UsageError("--potential belongs to --equation; a TOML file has a key for it")
        if self.system is None:
            raise click.UsageError("name a SYSTEM (ridgeback systems lists them), a TOML file, or give --equation")
        from ridgeback.symbolic.systems.any_form import as_oscillator

        return as_oscillator(self.system, parameters=values, about=self.about)


def choosing(command: Command) -> Command:
    """Give a verb the argument SYSTEM and the options ``--equation``, ``--about`` and ``--set``, as one ``choice``."""

    @wraps(command)
    def wrapped(
        *args: Any,
        system: str | None,
        equation: str | None,
        about: str | None,
        potential: str | None,
        assignments: tuple[tuple[str, Fraction], ...],
        **rest: Any,
    ) -> None:
        command(*args, choice=Choice(system, equation, about, potential, assignments), **rest)

    return named_by(set_option(wrapped))


def named_by(command: Command) -> Command:
    """Give a verb the argument SYSTEM and what may stand in its place."""
    for option in (
        click.option(
            "--about",
            default=None,
            metavar="U",
            help="Measure the unknown from this equilibrium: 1, -1/2, 2**(1/3), pi, or a decimal near one.",
        ),
        click.option(
            "--potential",
            default=None,
            metavar="P",
            help='The potential of the restoring force of --equation, checked by differentiation, e.g. "u**2/2".',
        ),
        click.option(
            "--equation",
            default=None,
            metavar="TEXT",
            help="The equation itself in place of SYSTEM, e.g. \"u'' + u + c*u**3 = 0\".",
        ),
        click.argument("system", required=False, metavar="[SYSTEM|FILE.toml]"),
    ):
        command = option(command)
    return command
