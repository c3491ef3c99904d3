"""The options of ``generate``: which language, which arithmetic, under which name, of which functions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from fractions import Fraction
from functools import wraps
from typing import Any

import click

from ridgeback.options.arguments import rational, written
from ridgeback.options.demand_options import degrees
from ridgeback.options.unused import refuse_unused

Command = Callable[..., None]

KNOWN = "python, array-api, numba, c, c-header, cpp, rust, julia, fortran, matlab, javascript, latex"
MODES = ("strict", "fma", "accurate")
FORMULAS = ("pade", "map", "nome", "agm", "sine")
CLOSED = ("agm", "sine")
"""Formulas that are made of the oscillator itself and not of a series."""
DERIVING = ("order", "method", "amplitude", "weight", "weights", "budget")
"""The options of a derivation."""


@dataclass(frozen=True)
class Code:
    """What was said about the code to be written."""

    language: str = "python"
    real: str = "float64"
    mode: str = "strict"
    name: str = ""
    motion: bool = False
    check: bool = False
    gappa: bool = False
    resummed: str | None = None
    degrees: tuple[int, int] | None = None
    growth: Fraction | None = None
    terms: int | None = None
    fit: str | None = None
    degree: int | None = None
    tolerance: Fraction | None = None
    up_to: Fraction | None = None

    def check_together(self) -> None:
        """Raise click.UsageError for options that do not go together."""
        self.check_formula()
        if self.gappa and self.language != "c":
            raise click.UsageError("--gappa goes with --language c; leave it out")
        if self.fit is None and (self.degree is not None or self.tolerance is not None):
            raise click.UsageError("--degree and --tolerance need --fit minimax; leave them out")
        if self.fit is not None and (self.up_to is None or (self.degree is None) == (self.tolerance is None)):
            raise click.UsageError("--fit needs --up-to, and --degree or --tolerance")
        if self.fit is not None and (self.resummed is not None or self.motion):
            raise click.UsageError("--fit stands by itself; leave out --resummed and --motion")
        if self.motion and self.resummed is not None:
            raise click.UsageError("--motion belongs to a series, not to --resummed; leave one of them out")
        if self.up_to is not None and self.up_to <= 0:
            raise click.BadParameter("the range must end above 0", param_hint="--up-to")
        if self.fit is not None or self.resummed in CLOSED:
            refuse_unused("--fit" if self.fit is not None else f"--resummed {self.resummed}", *DERIVING)

    def check_formula(self) -> None:
        """Raise click.UsageError for options that the formula does not have."""
        if self.resummed is None:
            for name in ("degrees", "growth"):
                if getattr(self, name) is not None:
                    raise click.UsageError(f"--{name} needs --resummed; leave it out")
        if self.growth is not None and self.resummed != "map":
            raise click.UsageError(f"--growth belongs to --resummed map, not to {self.resummed}; leave it out")
        if self.degrees is not None and self.resummed in CLOSED:
            raise click.UsageError(f"--resummed {self.resummed} is no quotient of polynomials; leave --degrees out")
        if (self.terms is not None) != (self.resummed == "sine"):
            raise click.UsageError("--terms and --resummed sine go together; give both or none")


def coding(command: Command) -> Command:
    """Give a verb these options, as one ``code``."""

    @wraps(command)
    def wrapped(**options: Any) -> None:
        own = {item.name: options.pop(item.name) for item in fields(Code)}
        command(code=Code(**own), **options)

    for option in reversed(OPTIONS):
        wrapped = option(wrapped)
    return wrapped


OPTIONS = (
    click.option("--language", default="python", show_default=True, metavar="NAME", help=f"Target: {KNOWN}."),
    click.option(
        "--real",
        type=click.Choice(("float64", "float32")),
        default="float64",
        show_default=True,
        help="Numbers of the code; float32 in C and Rust.",
    ),
    click.option(
        "--mode",
        type=click.Choice(MODES),
        default="strict",
        show_default=True,
        help="strict: the same bits in every language.  fma: a*b + c in one rounding.  accurate: last steps "
        "compensated.",
    ),
    click.option("--name", default="", metavar="WORD", help="Identifier of what is written.  Default: the system's."),
    click.option("--motion", is_flag=True, help="Write u(t) and its harmonics too."),
    click.option(
        "--gappa", is_flag=True, help="With C and -o: a script beside it by which Gappa proves the rounding again."
    ),
    click.option(
        "--check", is_flag=True, help="Compile the code with the tools of this machine and run its self-test."
    ),
    click.option(
        "--resummed",
        type=click.Choice(FORMULAS),
        default=None,
        help="Another formula in place of the series: pade, map, nome as for derive; agm, the closed form; sine, the "
        "pendulum's series in sin(A/2).",
    ),
    click.option(
        "--degrees",
        type=written(degrees),
        default=None,
        metavar="M/N",
        help="With --resummed: degrees.  Default: equal.",
    ),
    click.option(
        "--growth", type=written(rational), default=None, metavar="P", help="With --resummed map: see derive."
    ),
    click.option("--terms", type=int, default=None, metavar="N", help="With --resummed sine: terms of the series."),
    click.option(
        "--fit",
        type=click.Choice(("minimax",)),
        default=None,
        help="In place of a series: the polynomial next to the exact frequency up to --up-to, its error proved.",
    ),
    click.option(
        "--degree", type=int, default=None, metavar="D", help="With --fit: degree in A^2, in A of a potential not even."
    ),
    click.option(
        "--tolerance",
        type=written(rational),
        default=None,
        metavar="E",
        help="With --fit: the lowest degree whose relative error is at most this.",
    ),
    click.option(
        "--up-to",
        type=written(rational),
        default=None,
        metavar="R",
        help="End of the domain: nan beyond, no pole and a bounded rounding error up to there.",
    ),
)
