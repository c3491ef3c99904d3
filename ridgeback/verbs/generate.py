"""``ridgeback generate``: an expansion as source text."""

from __future__ import annotations

import click

from ridgeback.choice import Choice, choosing
from ridgeback.derivation import Request, derived, requesting
from ridgeback.options import format_option, output_option
from ridgeback.output import json_text, write_text


@click.command("generate", short_help="Write an expansion as Python or C.")
@choosing
@click.option(
    "--language",
    type=click.Choice(["python", "c", "c-header"]),
    default="python",
    show_default=True,
    help="Target language.",
)
@requesting
@format_option("source", "json", default="source")
@output_option
def command(
    *,
    choice: Choice,
    language: str,
    request: Request,
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
    result = derived(oscillator, request)
    limit = limit_of(oscillator) if result.amplitude == "peak" else None
    source = generate(result, language, equation=described(oscillator), limit=limit)
    described_so = {"language": language, **result.to_dict(), "source": source}
    write_text(output, json_text(described_so) if style == "json" else source)
