"""Long derivations: what they may cost, how far they are, and what an interrupt leaves behind."""

from __future__ import annotations

import re
import time
from typing import TYPE_CHECKING, Any, TextIO

import click

from ridgeback.common.progress import Bar, is_terminal
from ridgeback.console.failure import say
from ridgeback.console.output import STDOUT, OutputPath, is_special, open_descriptor, output_path
from ridgeback.options.arguments import shown, written
from ridgeback.options.shared import Decorated

if TYPE_CHECKING:
    from ridgeback.symbolic.expansion.cost import Budget, Cost

SECONDS = {"s": 1.0, "min": 60.0, "h": 3600.0, "d": 86400.0}
GIGABYTES = {"MB": 1e-3, "GB": 1.0, "TB": 1e3}
AMOUNT = re.compile(r"(\d{1,9}(?:\.\d{1,9})?)\s*([A-Za-z]+)", re.ASCII)

SAID_FROM = 10.0
"""Predicted seconds from which the prediction is said before the work."""
EVERY = 60.0
"""Seconds between two lines of progress where nobody looks at a terminal."""


def budget(text: str) -> Budget:
    """A time, a memory, or both with a comma between; what is not said stays as it is by default.

    >>> budget("2h"), budget("90min,8GB")
    (Budget(seconds=7200.0, gigabytes=4.0), Budget(seconds=5400.0, gigabytes=8.0))
    """
    from ridgeback.symbolic.expansion.cost import Budget

    given: dict[str, float] = {}
    for word in text.split(","):
        found = AMOUNT.fullmatch(word.strip())
        unit = found[2] if found else ""
        name = "seconds" if unit in SECONDS else "gigabytes"
        if found is None or unit not in {**SECONDS, **GIGABYTES} or name in given or float(found[1]) == 0:
            raise ValueError(
                f"{shown(text)} is not a budget; give a time (s, min, h, d), a memory (MB, GB, TB), or both, "
                "for example 2h or 90min,8GB"
            )
        given[name] = float(found[1]) * {**SECONDS, **GIGABYTES}[unit]
    return Budget(**given)


def checkpoint_path(text: str) -> OutputPath:
    """A file for a checkpoint, refused before the work starts."""
    if text == STDOUT or open_descriptor(text) is not None or is_special(text):
        raise click.BadParameter("a checkpoint is a file that is read again; give its name")
    return output_path(text)


def budget_option(command: Decorated) -> Decorated:
    """``--budget``."""
    return click.option(
        "--budget",
        type=written(budget),
        default=None,
        metavar="TIME,MEMORY",
        help="What the derivation may take, e.g. 2h or 90min,8GB.  Default: 10min,4GB.  More is refused beforehand.",
    )(command)


class Watch:
    """Says how far a derivation is: on a terminal in one line, elsewhere in a plain line a minute.

    >>> watch = Watch("order", None)
    >>> watch(0.5, "order 5 of 10")
    >>> watch.last
    'order 5 of 10'
    """

    def __init__(self, what: str, cost: Cost | None, *, stream: TextIO | None = None) -> None:
        self.line = Bar(stream)
        self.plain = not is_terminal(self.line.stream)
        self.said = self.started = time.monotonic()
        self.last = ""
        if cost is not None and cost.seconds >= SAID_FROM:
            from ridgeback.symbolic.expansion.cost import duration

            say(f"{what}: about {duration(cost.seconds)} and {cost.gigabytes:.2g} GB are predicted")

    def __call__(self, fraction: float, step: str) -> None:
        """Say the step, when it is time to."""
        self.last = step
        self.line(fraction, step)
        if self.plain and time.monotonic() - self.said >= EVERY:
            self.said = time.monotonic()
            say(f"{self.said - self.started:.0f} s, {fraction:.0%}, {step}")

    def __enter__(self) -> Watch:
        return self

    def __exit__(self, *_: Any) -> None:
        self.line.close()
