"""Options that several verbs share, so that each reads and says the same everywhere."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from typing import Any, TypeVar

import click

from ridgeback.console.output import STDOUT, output_path
from ridgeback.options.arguments import ASSIGNMENT, LAW, WEIGHTS

Decorated = TypeVar("Decorated", bound=Callable[..., Any])
Given = TypeVar("Given", Fraction, str)

METHODS = ("lindstedt", "multiple-scales", "energy-integral")
AMPLITUDES = ("peak", "trough", "fundamental", "action", "energy")


def added(command: Decorated, options: Iterable[Callable[[Decorated], Decorated]]) -> Decorated:
    """Give a command options, the first of them first in its help."""
    for option in reversed(tuple(options)):
        command = option(command)
    return command


def set_option(command: Decorated) -> Decorated:
    """``--set NAME=VALUE``, repeatable."""
    return click.option(
        "--set",
        "assignments",
        type=ASSIGNMENT,
        multiple=True,
        metavar="NAME=VALUE",
        help="Give a parameter a value, exactly as written (0.01 is 1/100).  Repeatable.",
    )(command)


def drift_option(command: Decorated) -> Decorated:
    """``--drift NAME=LAW``, repeatable."""
    return click.option(
        "--drift",
        "laws",
        type=LAW,
        multiple=True,
        metavar="NAME=P(t)",
        help="Let a parameter change slowly with the time t, e.g. L=1+0.01*t, and hold omega0 at its conserved action "
        "against the cycle frequency.  Repeatable.",
    )(command)


def output_option(command: Decorated) -> Decorated:
    """``-o FILE``, by default standard output."""
    return click.option(
        "-o",
        "--output",
        "output",
        type=output_path,
        default=STDOUT,
        metavar="FILE",
        help="Where to write; the file appears whole or not at all.  Default: standard output.",
    )(command)


def format_option(*formats: str, default: str) -> Callable[[Decorated], Decorated]:
    """``--format``, one of those that the verb has."""

    def decorate(command: Decorated) -> Decorated:
        """Add the option."""
        return click.option(
            "--format",
            "style",
            type=click.Choice(formats),
            default=default,
            show_default=True,
            help="Form of the output.",
        )(command)

    return decorate


def expansion_options(command: Decorated) -> Decorated:
    """``--method``, ``--amplitude``, ``--weight``, ``--weights``: which derivation, in which variables."""
    for option in (
        click.option(
            "--weight",
            type=click.IntRange(1, 1000),
            default=None,
            help="Weight of mu in the order of multiple scales: mu counts like a^WEIGHT.  Default: 2.",
        ),
        click.option(
            "--weights",
            type=WEIGHTS,
            default=None,
            metavar="NAME=W,...",
            help="Weights of single small parameters, e.g. mu=2,c3=1; weight 0 makes one a coefficient.",
        ),
        click.option(
            "--amplitude",
            type=click.Choice(AMPLITUDES),
            default=None,
            help="A turning point (peak, trough) or the first harmonic (fundamental); for forces without u' also "
            "sqrt(2J/k) (action) and sqrt(2E)/k (energy).",
        ),
        click.option(
            "--method",
            type=click.Choice(METHODS),
            default=None,
            help="Derivation.  Default: multiple-scales for a damped system and where no series in eps describes a "
            "limit cycle, else lindstedt.",
        ),
    ):
        command = option(command)
    return command


def unique(assignments: tuple[tuple[str, Given], ...], option: str = "--set") -> dict[str, Given]:
    """The parameters by name; click.UsageError when one is set twice.

    >>> unique((("k", Fraction(2)),))
    {'k': Fraction(2, 1)}
    """
    values: dict[str, Given] = {}
    for name, value in assignments:
        if name in values:
            raise click.UsageError(f"{option} gives {name} twice; keep one of them")
        values[name] = value
    return values


def refuse_twice(assignments: tuple[tuple[str, Fraction], ...], laws: Mapping[str, str]) -> None:
    """Refuse a parameter that is both set and said to drift.

    >>> refuse_twice((("k", Fraction(2)),), {"mu": "t"})
    """
    for name, _ in assignments:
        if name in laws:
            raise click.UsageError(f"--set and --drift both give {name}; keep one")
