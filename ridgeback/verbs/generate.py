"""``ridgeback generate``: an expansion as source text."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from ridgeback.arguments import ORDER
from ridgeback.choice import Choice, choosing
from ridgeback.derivation import derived
from ridgeback.options import expansion_options, format_option, output_option
from ridgeback.output import json_text, write_text

if TYPE_CHECKING:
    pass


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
@format_option("source", "json", default="source")
@output_option
def command(
    *,
    choice: Choice,
    language: str,
    order: int,
    method: str | None,
    amplitude: str | None,
    weight: int | None,
    weights: dict[str, int] | None,
    style: str,
    output: str,
) -> None:
    """Write the frequency of SYSTEM as source text: a Python module, or C99 functions.

    Each exact coefficient is rounded once, to the nearest double.

    \b
    ridgeback generate pendulum --order 12 -o pendulum.py
    ridgeback generate pendulum --order 12 --language c -o pendulum.c
    ridgeback generate damped-pendulum --order 6          omega0(a, mu) and damping(a, mu)
    """
    from compare.derivation import described, limit_of
    from symbolic.codegen import generate

    oscillator = choice.oscillator()
    result = derived(oscillator, order, method=method, amplitude=amplitude, weight=weight, weights=weights)
    limit = limit_of(oscillator) if result.amplitude == "peak" else None
    source = generate(result, language, equation=described(oscillator), limit=limit)
    described_so = {"language": language, **result.to_dict(), "source": source}
    write_text(output, json_text(described_so) if style == "json" else source)
