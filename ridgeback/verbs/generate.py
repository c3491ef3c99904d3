"""``ridgeback generate``: an expansion as source text."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

import click

from ridgeback.answers.resummation import resummed_from
from ridgeback.console.output import json_text, write_text
from ridgeback.console.verb import Verb
from ridgeback.options.arguments import rational, written
from ridgeback.options.demand import Demand
from ridgeback.options.demand_options import degrees
from ridgeback.options.derivation import Request, derived, requesting
from ridgeback.options.shared import format_option, output_option
from ridgeback.options.system import Choice, choosing

if TYPE_CHECKING:
    from ridgeback.symbolic.expansion.expansion import Expansion
    from ridgeback.symbolic.flow.slow_flow import SlowFlow
    from ridgeback.symbolic.resummation.resummation import Resummation
    from ridgeback.symbolic.systems.oscillator import Oscillator


@click.command("generate", cls=Verb, short_help="Write an expansion as Python or C.")
@choosing
@click.option(
    "--language",
    type=click.Choice(["python", "c", "c-header"]),
    default="python",
    show_default=True,
    help="Target language.",
)
@requesting
@click.option(
    "--resummed",
    type=click.Choice(("pade", "map", "nome")),
    default=None,
    help="Another formula from the same coefficients in place of the series; see derive.",
)
@click.option(
    "--degrees", type=written(degrees), default=None, metavar="M/N", help="With --resummed: degrees.  Default: equal."
)
@click.option("--growth", type=written(rational), default=None, metavar="P", help="With --resummed map: see derive.")
@click.option(
    "--up-to",
    type=written(rational),
    default=None,
    metavar="R",
    help="With --resummed: no pole up to there, and rounding bounded over that range.",
)
@format_option("source", "json", default="source")
@output_option
def command(
    *,
    choice: Choice,
    language: str,
    request: Request,
    resummed: str | None,
    degrees: tuple[int, int] | None,
    growth: Fraction | None,
    up_to: Fraction | None,
    style: str,
    output: str,
) -> None:
    """Write the frequency of SYSTEM as source text: a Python module, or C99 functions.

    Each exact coefficient is rounded once, to the nearest double, and what rounding can do to the result is proved
    and written beside it.  Parameters without a value become arguments, as do all small ones of a slow flow.

    \b
    ridgeback generate pendulum --order 12 -o pendulum.py
    ridgeback generate pendulum --order 12 --language c -o pendulum.c
    ridgeback generate damped-pendulum --order 6          omega0(a, mu) and damping(a, mu)
    ridgeback generate pendulum --order 16 --resummed pade --up-to 3
    ridgeback generate --equation "u'' + u + c*u**3 = 0"   omega0(A, c)
    """
    needless = [n for n, v in (("degrees", degrees), ("growth", growth), ("up-to", up_to)) if v is not None]
    if resummed is None and needless:
        raise click.UsageError(f"--{needless[0]} needs --resummed; leave it out")
    if up_to is not None and up_to <= 0:
        raise click.BadParameter("the range must end above 0", param_hint="--up-to")
    oscillator = choice.oscillator()
    result: Expansion | SlowFlow | Resummation
    result = series = derived(oscillator, request)
    if resummed is not None:
        at = None if up_to is None else (up_to,)
        result = resummed_from(oscillator, series, Demand(resummed=resummed, degrees=degrees, growth=growth, at=at))
    source = written_out(oscillator, series, result, language, up_to)
    described_so = {"language": language, **result.to_dict(), "source": source}
    write_text(output, json_text(described_so) if style == "json" else source)


def written_out(
    oscillator: Oscillator,
    series: Expansion | SlowFlow,
    result: Expansion | SlowFlow | Resummation,
    language: str,
    up_to: Fraction | None,
) -> str:
    """The source with what is known about the formula: where the oscillation ends, and its certified error."""
    from ridgeback.compare.study.derivation import described
    from ridgeback.compare.study.derived import Undamped
    from ridgeback.symbolic.codegen import generate
    from ridgeback.symbolic.flow.slow_flow import SlowFlow

    limit = Undamped(oscillator).limit if result.amplitude == "peak" and not free(oscillator) else None
    if isinstance(result, SlowFlow) or isinstance(series, SlowFlow):
        return generate(result, language, equation=described(oscillator), limit=limit)
    from ridgeback.symbolic.codegen.facts import before_pole, certified_facts, reach_of

    end = up_to or (reach_of(oscillator, series, result) if limit is None else before_pole(Fraction(limit), result))
    facts = () if end is None else certified_facts(oscillator, result, end)
    return generate(result, language, equation=described(oscillator), limit=limit, up_to=end, more=facts)


def free(oscillator: Oscillator) -> bool:
    """Whether a parameter has no value, so that no limit can be computed."""
    return any(value is None for value in oscillator.parameters.values())
