"""Which oscillator ``--method model-fit`` fits, and which of its parameters are to be found."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import wraps
from typing import TYPE_CHECKING, Any

import click

from ridgeback.options.arguments import NAME, shown, written
from ridgeback.options.shared import set_option
from ridgeback.options.system import Choice

if TYPE_CHECKING:
    from ridgeback.numeric.model_fit.family import Family
    from ridgeback.symbolic.systems.oscillator import Oscillator

Command = Callable[..., None]
MODEL_FIT = "model-fit"


def names(text: str) -> tuple[str, ...]:
    """Names with commas between.

    >>> names("k, mu")
    ('k', 'mu')
    """
    words = tuple(word.strip() for word in text.split(","))
    wrong = [word for word in words if not NAME.fullmatch(word)]
    if wrong:
        raise ValueError(f"{shown(wrong[0])} is not the name of a parameter; write for example k,mu")
    return words


@dataclass(frozen=True)
class Model:
    """The oscillator as it was said; it is read when it is asked for."""

    choice: Choice
    free: tuple[str, ...]

    @property
    def said(self) -> bool:
        """Whether any of it was given."""
        return self.choice.made or bool(self.free) or bool(self.choice.assignments)

    def check(self, method: str) -> None:
        """Refuse an oscillator where no method wants one, and the method without one."""
        if self.said and MODEL_FIT not in method:
            raise click.UsageError("--system, --equation, --set and --free belong to --method model-fit")
        if self.said and not self.choice.made:
            raise click.UsageError("name the oscillator that --set and --free are about: --system or --equation")

    def oscillator(self) -> Oscillator | None:
        """The oscillator, None when none was named."""
        return self.choice.oscillator() if self.choice.made else None

    def to_find(self, oscillator: Oscillator) -> tuple[str, ...]:
        """Parameters to be found: those of ``--free``, else all that ``--set`` gives no value."""
        fixed = [name for name, _ in self.choice.assignments]
        return self.free or tuple(name for name in oscillator.parameters if name not in fixed)

    def family(self, method: str) -> Family | None:
        """What the fit needs; None for the other methods."""
        self.check(method)
        if method != MODEL_FIT:
            return None
        from ridgeback.compare.binding.family import family_of

        oscillator = self.oscillator()
        if oscillator is None:
            raise click.UsageError("--method model-fit fits an oscillator; name it by --system or --equation")
        return family_of(oscillator, self.to_find(oscillator))


def model_options(command: Command) -> Command:
    """Give a verb ``--system``, ``--equation``, ``--set`` and ``--free``, as one ``model``."""

    @wraps(command)
    def wrapped(
        *args: Any,
        system: str | None,
        equation: str | None,
        free: tuple[str, ...] | None,
        assignments: tuple[tuple[str, Fraction], ...],
        **rest: Any,
    ) -> None:
        command(*args, model=Model(Choice(system, equation, None, None, assignments), free or ()), **rest)

    for option in (
        click.option(
            "--free",
            type=written(names),
            default=None,
            metavar="NAME,...",
            help="Parameters that model-fit finds, starting at their values.  Default: all that --set leaves.",
        ),
        set_option,
        click.option(
            "--equation", default=None, metavar="TEXT", help="The oscillator of model-fit as an equation instead."
        ),
        click.option(
            "--system", default=None, metavar="NAME|FILE.toml", help="The oscillator that --method model-fit fits."
        ),
    ):
        wrapped = option(wrapped)
    return wrapped
