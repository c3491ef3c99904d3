"""``ridgeback derive``: an exact expansion, in the form asked for."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

import click

from ridgeback.arguments import ORDER
from ridgeback.choice import Choice, choosing
from ridgeback.derivation import derived
from ridgeback.failure import PartialError
from ridgeback.options import expansion_options, format_option, output_option
from ridgeback.output import json_text, write_text
from ridgeback.tables import aligned

if TYPE_CHECKING:
    from symbolic.certificate import Check
    from symbolic.expansion import Expansion
    from symbolic.oscillator import Oscillator
    from symbolic.slow_flow import SlowFlow

    Result = Expansion | SlowFlow


@click.command("derive", short_help="Derive the frequency as an exact series.")
@choosing
@click.option("--order", type=ORDER, default="8", show_default=True, metavar="N", help="Highest power kept.")
@expansion_options
@click.option("--verify", is_flag=True, help="Check the result by independent routes and print the certificate.")
@format_option("text", "json", "latex", "mathml", "python", default="text")
@output_option
def command(
    *,
    choice: Choice,
    order: int,
    method: str | None,
    amplitude: str | None,
    weight: int | None,
    weights: dict[str, int] | None,
    verify: bool,
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
    ridgeback derive --equation "u'' + u + alpha2*u**2 + alpha3*u**3 = 0" --order 4 --verify
    ridgeback derive --equation "u'' - u + u**3 = 0" --about 1
    """
    oscillator = choice.oscillator()
    result = derived(oscillator, order, method=method, amplitude=amplitude, weight=weight, weights=weights)
    checks = certificate(oscillator, result) if verify else None
    write_text(output, printed(oscillator, result, style, checks))
    if checks and not all(check.passed for check in checks if check.passed is not None):
        raise PartialError("the certificate does not hold; the output says which check failed")


def certificate(oscillator: Oscillator, result: Result) -> tuple[Check, ...]:
    """Every independent check that applies."""
    from symbolic.certificate import certify

    return certify(oscillator, result)


def printed(oscillator: Oscillator, result: Result, style: str, checks: tuple[Check, ...] | None) -> str:
    """The result in the form asked for, with a line end; the certificate goes with text and JSON."""
    match style:
        case "json":
            lines = {} if checks is None else {"certificate": [check.to_dict() for check in checks]}
            return json_text({**result.to_dict(), **lines})
        case "latex":
            return joined(result.latex())
        case "mathml":
            return joined(result.mathml())
        case "python":
            return joined(tuple(map(str, expressions(result))))
    return as_text(oscillator, result.to_dict()) + range_of_use(oscillator, result) + certified(checks)


def range_of_use(oscillator: Oscillator, result: Result) -> str:
    """Where a series converges and how far it may be used, in one line; a slow flow's limit cycles."""
    from symbolic.accuracy import settled_limits
    from symbolic.expansion import Expansion

    if isinstance(result, Expansion):
        return f"\n{settled_limits(oscillator, result).sentence()}\n"
    return limit_cycles(oscillator, result)


def limit_cycles(oscillator: Oscillator, flow: SlowFlow) -> str:
    """The fixed points of a self-excited slow flow that belong to a series, at the oscillator's own parameters."""
    if oscillator.kind != "limit-cycle" or any(oscillator.parameters.get(name) is None for name in flow.weights):
        return ""
    from symbolic.fixed_points import fixed_points

    values = {name: oscillator.parameters[name] for name in flow.weights}
    found = [point for point in fixed_points(flow, values) if point.square_series is not None]
    at = ", ".join(f"{name} = {value}" for name, value in values.items())
    return "".join(
        f"\nlimit cycle of this order at {at}: a = {float(p.amplitude.mid()):.10g}, "
        f"omega0 = {float(p.frequency.mid()):.10g}, {_STABILITY[p.stable]}\n"
        for p in found
    )


_STABILITY = {True: "stable", False: "unstable", None: "of undecided stability"}


def certified(checks: tuple[Check, ...] | None) -> str:
    """The certificate, a line a check."""
    if checks is None:
        return ""
    words = {True: "holds", False: "FAILS", None: "-"}
    rows = [{"check": c.name, "": words[c.passed], "statement": c.statement} for c in checks]
    return "\ncertificate\n" + aligned(["check", "", "statement"], rows) + "\n"


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
    values = ", ".join(f"{n} = {v}" if v is not None else f"{n} symbolic" for n, v in oscillator.parameters.items())
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
