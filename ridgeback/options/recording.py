"""How a verb is told where the samples are in a file, and what is to be done with gaps, uneven times and drift."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import wraps
from typing import TYPE_CHECKING, Any

import click

from ridgeback.options.arguments import BAND, POSITIVE, SPAN
from ridgeback.options.shared import added

if TYPE_CHECKING:
    from ridgeback.numeric.recording.recording import Recording

Command = Callable[..., None]
DETRENDS = ("none", "linear", "slow")


@dataclass(frozen=True)
class Treatment:
    """Which times count, what is to be done with uneven ones, gaps and drift, and what was measured."""

    resample: float | None = None
    fill: float | None = None
    detrend: str = "none"
    span: tuple[float, float] | None = None
    unit: str | None = None
    quantity: str | None = None
    """What was measured; None where nobody says so."""

    def given(self) -> dict[str, Any]:
        """What was asked of the readers, by the names of their arguments."""
        said = {
            "resample": self.resample,
            "fill": self.fill,
            "detrend": self.detrend,
            "span": self.span,
            "unit": self.unit,
        }
        return {name: value for name, value in said.items() if value not in (None, "none")}


@dataclass(frozen=True)
class Reading:
    """Where the samples and their times are in a file, and how they are to be treated."""

    column: str | None = None
    time_column: str | None = None
    rate: float | None = None
    run_column: str | None = None
    decimal: str | None = None
    treatment: Treatment = field(default_factory=Treatment)

    def one(self, file: str) -> Recording:
        """The longest stretch of the one signal; the file's own problems are named by the reader."""
        from ridgeback.numeric.recording.quantity import as_said
        from ridgeback.numeric.recording.reading import read_recording

        return as_said(read_recording(file, column=self.column, **self.given()), self.treatment.quantity)

    def all(self, files: Sequence[str]) -> tuple[Recording, ...]:
        """Every stretch of every channel of every run."""
        from ridgeback.numeric.recording.quantity import as_said
        from ridgeback.numeric.recording.reading import read_recordings

        found = read_recordings(
            files,
            columns=self.column,
            run_column=self.run_column,
            **self.given(),
        )
        return tuple(as_said(one, self.treatment.quantity) for one in found)

    def given(self) -> dict[str, Any]:
        """What was asked of the reader of any number of signals, by the names of its arguments."""
        mark = {} if self.decimal is None else {"decimal": self.decimal}
        return {"time_column": self.time_column, "rate": self.rate, **mark, **self.treatment.given()}


def treatment_options(command: Command) -> Command:
    """Give a verb ``--quantity``, ``--span``, ``--resample``, ``--fill``, ``--detrend``, as one ``treatment``."""

    @wraps(command)
    def wrapped(
        *args: Any,
        resample: float | None,
        fill: float | None,
        detrend: str,
        span: tuple[float, float] | None,
        unit: str | None,
        quantity: str | None,
        **rest: Any,
    ) -> None:
        command(*args, treatment=Treatment(resample, fill, detrend, span, unit, quantity), **rest)

    return added(wrapped, TREATMENT_OPTIONS)


def reading_options(command: Command) -> Command:
    """Give a verb all options of reading, as one ``reading``."""

    @treatment_options
    @wraps(command)
    def wrapped(
        *args: Any,
        column: str | None,
        time_column: str | None,
        rate: float | None,
        run_column: str | None,
        decimal: str | None,
        treatment: Treatment,
        **rest: Any,
    ) -> None:
        command(*args, reading=Reading(column, time_column, rate, run_column, decimal, treatment), **rest)

    return added(wrapped, PLACE_OPTIONS)


decimal_option = click.option(
    "--decimal",
    type=click.Choice(("auto", "point", "comma", ".", ",")),
    default=None,
    help="The mark of the decimals in a table of text.  Default: auto, what each column's cells prove.",
)
band_option = click.option(
    "--band", type=BAND, default=None, metavar="LOW,HIGH", help="Where a recording's oscillation is, rad/s."
)
PLACE_OPTIONS = (
    click.option(
        "--column",
        default=None,
        metavar="NAME[,NAME...]",
        help='The samples: names or numbers from 1, or "all".  Needed when the file holds several signals.',
    ),
    click.option("--time-column", default=None, metavar="NAME", help="The times.  Default: found by its name."),
    click.option(
        "--rate", type=POSITIVE, default=None, metavar="R", help="Samples per second, in place of a time column."
    ),
    click.option("--run-column", default=None, metavar="NAME", help="The column that numbers the runs."),
    decimal_option,
)
TREATMENT_OPTIONS = (
    click.option(
        "--quantity",
        type=click.Choice(("displacement", "velocity", "acceleration")),
        default=None,
        help="What was measured; a velocity or an acceleration is converted, each harmonic by its frequency.  Default: "
        "a displacement, unless its name, its unit or its waveform say otherwise.",
    ),
    click.option(
        "--span",
        type=SPAN,
        default=None,
        metavar="T0,T1",
        help="Use the samples from time T0 to T1 only: the free decay, without what comes before and after.",
    ),
    click.option(
        "--unit",
        default=None,
        metavar="UNIT",
        help='Of the samples, in place of the header\'s; "deg" is converted to radians.',
    ),
    click.option(
        "--resample",
        type=POSITIVE,
        default=None,
        metavar="R",
        help="Interpolate uneven times to R samples per second; bring even ones to this rate.",
    ),
    click.option(
        "--fill",
        type=POSITIVE,
        default=None,
        metavar="SECONDS",
        help="Interpolate between samples up to this far apart.  Default: cut where one is missing.",
    ),
    click.option(
        "--detrend",
        type=click.Choice(DETRENDS),
        default="none",
        show_default=True,
        help="Take off a straight line, or the slow part (a mean over six cycles).",
    ),
)
