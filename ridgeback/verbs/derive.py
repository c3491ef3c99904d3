"""``ridgeback derive``: an exact expansion, in the form asked for."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

import click

from ridgeback.arguments import ORDER
from ridgeback.derivation import derived
from ridgeback.options import chosen, expansion_options, format_option, output_option, set_option
from ridgeback.output import json_text, write_text
from ridgeback.tables import aligned

if TYPE_CHECKING:
    from symbolic.expansion import Expansion
    from symbolic.oscillator import Oscillator
    from symbolic.slow_flow import SlowFlow

    Result = Expansion | SlowFlow


@click.command("derive", short_help="Derive the frequency as an exact series.")
@click.argument("system")
@click.option("--order", type=ORDER, default="8", show_default=True, metavar="N", help="Highest power kept.")
@expansion_options
@set_option
@format_option("text", "json", "latex", "mathml", "python", default="text")
@output_option
def command(
    system: str,
    order: int,
    method: str | None,
    amplitude: str | None,
    weight: int | None,
    assignments: tuple[tuple[str, Fraction], ...],
    style: str,
    output: str,
) -> None:
    """Derive the fundamental frequency of SYSTEM as a power series with exact coefficients.

    In the amplitude for conservative oscillators, in eps for limit cycles, and by multiple scales in the amplitude
    a and the damping mu together with the decay a'/a.

    \b
    ridgeback derive pendulum --order 8
    ridgeback derive damped-pendulum --method multiple-scales --order 6 --format latex
    ridgeback derive van-der-pol --order 12 --format json
    """
    oscillator = chosen(system, assignments)
    result = derived(oscillator, order, method=method, amplitude=amplitude, weight=weight)
    write_text(output, printed(oscillator, result, style))


def printed(oscillator: Oscillator, result: Result, style: str) -> str:
    """The result in the form asked for, with a line end."""
    match style:
        case "json":
            return json_text(result.to_dict())
        case "latex":
            return joined(result.latex())
        case "mathml":
            return joined(result.mathml())
        case "python":
            return joined(tuple(map(str, expressions(result))))
    return as_text(oscillator, result.to_dict())


def joined(parts: str | tuple[str, ...]) -> str:
    """One relation per line; a slow flow has two."""
    return "".join(f"{part}\n" for part in ((parts,) if isinstance(parts, str) else parts))


def expressions(result: Result) -> tuple[Any, ...]:
    """The right-hand sides as SymPy expressions; printed, they are Python, exact for SymPy symbols and Fractions."""
    from symbolic.slow_flow import SlowFlow

    if isinstance(result, SlowFlow):
        return result.frequency_expression(), result.damping_expression()
    return (result.expression(),)


def as_text(oscillator: Oscillator, public: dict[str, Any]) -> str:
    """The equation, what the amplitude is, and every coefficient, exactly and as a decimal."""
    values = ", ".join(f"{name} = {value}" for name, value in oscillator.parameters.items())
    heading = [
        f"{oscillator.title}: {oscillator.equation}" + (f"   ({values})" if values else ""),
        f"{public['method']}, order {public['order']}, variables {', '.join(public['variables'])}"
        + (f", amplitude: {public['amplitude']}" if public.get("amplitude") else ""),
    ]
    titles = {"frequency": "omega0", "damping": "a'/a", "amplitude_series": "amplitude"}
    tables = [f"{title} = sum of\n{coefficients(public[key])}" for key, title in titles.items() if public.get(key)]
    return "\n\n".join(["\n".join(heading), *tables]) + "\n"


def coefficients(terms: list[dict[str, Any]]) -> str:
    """One line per term: its powers, the exact coefficient and six digits of it."""
    rows = [
        {
            "term": "*".join(f"{v}^{p}" if p > 1 else v for v, p in term["powers"].items() if p) or "1",
            "decimal": decimal(term["coefficient"]),
            "coefficient": term["coefficient"],
        }
        for term in terms
    ]
    return aligned(["term", "decimal", "coefficient"], rows)


def decimal(exact: str) -> float | None:
    """A rational as a float; None for what is no rational (an irrational natural frequency, a parameter).

    >>> decimal("-1/16"), decimal("sqrt(2)")
    (-0.0625, None)
    """
    try:
        return float(Fraction(exact))
    except (ValueError, OverflowError):
        return None
