"""The options of ``derive`` beyond those of the derivation, and the small languages of their values."""

from __future__ import annotations

import re
from typing import Final

import click

from ridgeback.options.arguments import MAX_GRID, amplitudes, number, positive, rational, shown, written
from ridgeback.options.budget import checkpoint_path


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


HIGH_ORDER: Final = (
    click.option(
        "--digits",
        type=click.IntRange(1, 10_000),
        default=None,
        metavar="D",
        help="Certified balls of at least D digits instead of exact coefficients: for very high orders.",
    ),
    click.option(
        "--checkpoint",
        type=checkpoint_path,
        default=None,
        metavar="FILE",
        help="Keep the state of --digits there, now and then and on Ctrl-C; the same command resumes.",
    ),
)
"""Very high orders."""

FORMULA: Final = (
    click.option(
        "--at",
        type=written(amplitudes),
        default=None,
        metavar="A,...",
        help="Enclose the exact frequency at these amplitudes, or values of eps for a limit cycle (or "
        "START:STOP:COUNT), and prove the error of the series there.",
    ),
    click.option(
        "--resummed",
        type=click.Choice(("pade", "map", "nome")),
        default=None,
        help="Another formula from the same coefficients: a Padé approximant, the change of variable that moves "
        "the nearest singularity away, the elliptic nome.",
    ),
    click.option(
        "--degrees",
        type=written(degrees),
        default=None,
        metavar="M/N",
        help="With --resummed: degrees of numerator and denominator.  Default: equal ones; for a map N = 0.",
    ),
    click.option(
        "--growth",
        type=written(rational),
        default=None,
        metavar="P",
        help="With --resummed map: the power of x that omega0 follows at infinity, x the square of the variable.",
    ),
)
"""The frequency at amplitudes, and other formulas for it."""

MOTION: Final = (
    click.option(
        "--transient",
        type=written(start),
        default=None,
        metavar="A0[,PHI0]",
        help="Follow amplitude and phase of the slow flow (multiple-scales) from these at time 0.",
    ),
    click.option(
        "--until",
        type=written(positive),
        default=None,
        metavar="T",
        help="With --transient: the last time; the first is 0.",
    ),
    click.option(
        "--points",
        type=click.IntRange(2, MAX_GRID),
        default=None,
        metavar="N",
        help="With --transient: how many equidistant times.  Default: 11.",
    ),
    click.option("--harmonics", is_flag=True, help="Print the motion u itself: every harmonic, exactly."),
)
"""The motion behind an expansion."""

PROOF: Final = (click.option("--verify", is_flag=True, help="Check by independent routes and print the certificate."),)
"""Proofs."""

OPTIONS: Final = (*HIGH_ORDER, *FORMULA, *MOTION, *PROOF)
"""All of them, in the order in which help shows them."""
