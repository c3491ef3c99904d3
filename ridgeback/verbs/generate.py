"""``ridgeback generate``: an expansion as source text."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from ridgeback.arguments import ORDER
from ridgeback.choice import Choice, choosing
from ridgeback.derivation import derived
from ridgeback.options import expansion_options, output_option
from ridgeback.output import write_text

if TYPE_CHECKING:
    from symbolic.oscillator import Oscillator


@click.command("generate", short_help="Write an expansion as Python or C.")
@choosing
@click.option(
    "--language",
    type=click.Choice(["python", "c", "c-header"]),
    default="python",
    show_default=True,
    help="Target language.",
)
@click.option("--order", type=ORDER, default="8", show_default=True, metavar="N", help="Highest power kept.")
@expansion_options
@output_option
def command(
    *,
    choice: Choice,
    language: str,
    order: int,
    method: str | None,
    amplitude: str | None,
    weight: int | None,
    output: str,
) -> None:
    """Write the frequency of SYSTEM as source text: a Python module, or C99 functions.

    Each exact coefficient is rounded once, to the nearest double.

    \b
    ridgeback generate pendulum --order 12 -o pendulum.py
    ridgeback generate pendulum --order 12 --language c -o pendulum.c
    ridgeback generate damped-pendulum --order 6          omega0(a, mu) and damping(a, mu)
    """
    from symbolic.codegen import generate

    oscillator = choice.oscillator()
    result = derived(oscillator, order, method=method, amplitude=amplitude, weight=weight)
    limit = peak_limit_of(oscillator) if result.amplitude == "peak" else None
    write_text(output, generate(result, language, equation=described(oscillator), limit=limit))


def described(oscillator: Oscillator) -> str:
    """The equation with its numbers."""
    values = ", ".join(f"{name} = {value}" for name, value in oscillator.parameters.items())
    return f"{oscillator.equation} with {values}" if values else oscillator.equation


def peak_limit_of(oscillator: Oscillator) -> float | None:
    """The peak amplitude at which the oscillation itself ends, where there is one."""
    if oscillator.kind != "conservative" or oscillator.potential is None:
        return None
    from math import isfinite

    from compare.bind import bind
    from numeric.period import peak_limit

    limit = peak_limit(bind(oscillator))
    return limit if isfinite(limit) else None
