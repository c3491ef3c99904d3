"""``ridgeback derive``: an exact expansion, in the form asked for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import click

from ridgeback.answers.at import as_csv as at_csv
from ridgeback.answers.at import as_text as at_text
from ridgeback.answers.at import complete, read_at, rows
from ridgeback.answers.expansion_text import as_text, certified, expressions, joined, limit_rows, range_of_use
from ridgeback.answers.high_order import in_balls, kept_until_written
from ridgeback.answers.motion import fixed_rows, harmonic_output, transient_output
from ridgeback.answers.resummation import formula_text, resummed_from
from ridgeback.console.failure import PartialError
from ridgeback.console.output import json_text, write_text
from ridgeback.console.verb import Verb
from ridgeback.options.demand import Demand, demanding
from ridgeback.options.derivation import Request, derived, requesting
from ridgeback.options.shared import format_option, output_option
from ridgeback.options.system import Choice, choosing

if TYPE_CHECKING:
    from ridgeback.answers.at import Row
    from ridgeback.symbolic.certificates.certificate import Check
    from ridgeback.symbolic.expansion.ball_expansion import BallExpansion
    from ridgeback.symbolic.expansion.expansion import Expansion
    from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
    from ridgeback.symbolic.flow.loss_flow import LossFlow
    from ridgeback.symbolic.flow.slow_flow import SlowFlow
    from ridgeback.symbolic.systems.oscillator import Oscillator

    Result = Expansion | PowerExpansion | LossFlow | SlowFlow


@click.command("derive", cls=Verb, short_help="Derive the frequency as an exact series.")
@choosing
@requesting
@demanding
@format_option("text", "json", "latex", "mathml", "python", "csv", default="text")
@output_option
def command(*, choice: Choice, request: Request, demand: Demand, output: str) -> None:
    """Derive the fundamental frequency of SYSTEM as a power series with exact coefficients.

    In the amplitude for conservative oscillators, in eps for limit cycles, and by multiple scales in the amplitude
    a and the damping mu together with the decay a'/a.

    \b
    ridgeback derive pendulum --order 8
    ridgeback derive damped-pendulum --method multiple-scales --order 6 --format latex
    ridgeback derive van-der-pol --order 12 --format json
    ridgeback derive --equation "u'' + u + alpha2*u**2 + alpha3*u**3 = 0" --order 4 --verify
    ridgeback derive --equation "u'' - u + u**3 = 0" --about 1
    ridgeback derive van-der-pol --order 400 --digits 30 --checkpoint vdp.state --budget 30min
    ridgeback derive pendulum --at 1,2.5                       certified errors of the series
    ridgeback derive van-der-pol --at 0.1,1,3                  the limit cycle at these eps, enclosed
    ridgeback derive --equation "u'' + u**3 = 0" --at 1,2      no linear force: another power of A
    ridgeback derive --equation "u'' + u + eps*u*abs(u) = 0"   a kink at rest: coefficients in 1/pi
    ridgeback derive pendulum --order 16 --resummed pade --at 2.5
    ridgeback derive damped-pendulum --order 2 --transient 0.5 --until 100
    ridgeback derive damped-pendulum --order 4 --harmonics

    JSON: system, method, amplitude, order, variables; frequency (growth_rate, amplitude_series) as a list of powers and
    coefficient.  Of balls also radius, ball and certain_digits (null: exact).  limits holds radius of convergence,
    uncertainty, range_of_use (null: not known), singularities and the sentence; for a slow flow also which frequency
    they are of.  With --verify certificate.
    With --at a list of amplitude, omega0, radius (of its certified ball), formula_omega0, relative_error and
    error_bound; an amplitude without an enclosure has refused, the reason, and the exit code is 3.  Of limit cycles
    the values are those of eps (eps, eps_exact), a row for each cycle: amplitude the peak, amplitude_radius, trough,
    multiplier (of the return map) and stable; the formula stands at the one that the series is of.  Of a self-excited
    slow flow fixed_points with slope, stable, last_change (by the terms of the last orders) and beyond_reach with why
    (limit_cycles are the true ones then), and the complete_powers they are of, as is the transient; no_limit_cycle
    says why there is none at eps = 0.  With --resummed expression, and of a quotient numerator, denominator (in w),
    growth and the first pole.  With --transient closed_form (or null) and rows of time, amplitude, phase, omega0, u.
    With --harmonics, harmonics.
    """
    oscillator = choice.oscillator()
    with kept_until_written(demand.checkpoint):
        result = derived_as(oscillator, request, demand)
        formula = formula_of(oscillator, result, demand)
        found: Sequence[Row] = read_at(oscillator, formula, demand) if demand.at else ()
        checks = certificate(oscillator, result) if demand.verify else None
        write_text(
            output, made_of(oscillator, formula, found, demand) or printed(oscillator, result, found, demand, checks)
        )
    if checks and not all(check.passed for check in checks if check.passed is not None):
        raise PartialError("the certificate does not hold; the output says which check failed")
    complete(found)


def derived_as(oscillator: Oscillator, request: Request, demand: Demand) -> Result | BallExpansion:
    """The expansion, by the arithmetic asked for."""
    enclosed = demand.at is not None and (oscillator.by_sides or in_no_series(oscillator))
    if demand.digits is not None and not enclosed:  # else the digits are those of the enclosures
        return in_balls(oscillator, request, demand.digits, demand.checkpoint)
    if demand.transient is not None and request.method is None:
        request = replace(request, method="multiple-scales")
    return derived(oscillator, request)


def in_no_series(oscillator: Oscillator) -> bool:
    """Whether an oscillator has limit cycles that no series in its small parameter describes."""
    from ridgeback.interface.derivation import method_for

    return oscillator.kind == "limit-cycle" and method_for(oscillator, None) == "multiple-scales"


def formula_of(oscillator: Oscillator, result: Any, demand: Demand) -> Any:
    """What is held against the exact frequency: the expansion, or the formula made of it."""
    return result if demand.resummed is None else resummed_from(oscillator, result, demand)


def made_of(oscillator: Oscillator, formula: Any, found: Sequence[Row], demand: Demand) -> str | None:
    """The output of what is made of an expansion, in place of the expansion itself; None where nothing is."""
    if demand.transient is not None:
        return transient_output(oscillator, formula, demand)
    if demand.harmonics:
        return harmonic_output(oscillator, formula, demand.style)
    return None if demand.resummed is None else resummation(oscillator, formula, found, demand)


def resummation(oscillator: Oscillator, formula: Any, found: Sequence[Row], demand: Demand) -> str:
    """The output of another formula from the coefficients, with its certified errors where they are asked for."""
    if demand.style == "json":
        return json_text({**formula.to_dict(), **at_rows(found, demand)})
    if demand.style == "csv":
        return at_csv(found, demand)
    table = at_text(found, demand, formula.method, formula.amplitude) if found else ""
    return formula_text(oscillator, formula, demand.style) + table


def certificate(oscillator: Oscillator, result: Result | BallExpansion) -> tuple[Check, ...]:
    """Every independent check that applies."""
    from ridgeback.symbolic.certificates.certificate import certify, certify_balls
    from ridgeback.symbolic.expansion.ball_expansion import BallExpansion

    return certify_balls(oscillator, result) if isinstance(result, BallExpansion) else certify(oscillator, result)


def printed(
    oscillator: Oscillator,
    result: Result | BallExpansion,
    found: Sequence[Row],
    demand: Demand,
    checks: tuple[Check, ...] | None,
) -> str:
    """The result in the form asked for, with a line end; the certificate goes with text and JSON."""
    match demand.style:
        case "csv":
            return at_csv(found, demand)
        case "json":
            more = {**limit_rows(oscillator, result), **certificate_rows(checks), **at_rows(found, demand)}
            more |= {**fixed_rows(oscillator, result), **root_row(oscillator)}
            return json_text({**result.to_dict(), **more})
        case "text":
            held = "" if slow(result) else f"{result.method} to order {result.order}"
            table = at_text(found, demand, held, result.amplitude)
            below = range_of_use(oscillator, result) + (table if found else "") + certified(checks)
            return as_text(oscillator, result.to_dict()) + below
    return formulas(result, demand.style)


def root_row(oscillator: Oscillator) -> dict[str, object]:
    """What the root is that coefficients are polynomials in, where there is one."""
    from ridgeback.symbolic.arithmetic.roots import root_in

    root = root_in(oscillator.substituted_force)
    return {} if root is None else {"root": root.to_dict()}


def slow(result: Any) -> bool:
    """Whether a result is a slow flow, which is no formula for the frequency of a cycle."""
    from ridgeback.symbolic.flow.slow_flow import SlowFlow

    return isinstance(result, SlowFlow)


def formulas(result: Any, style: str) -> str:
    """Exact coefficients in a language of formulas."""
    match style:
        case "latex":
            return joined(result.latex())
        case "mathml":
            return joined(result.mathml())
    return joined(tuple(map(str, expressions(result))))


def at_rows(found: Sequence[Row], demand: Demand) -> dict[str, list[dict[str, object]]]:
    """The frequencies at amplitudes in JSON, when they are asked for."""
    return {"at": rows(found, demand)} if found else {}


def certificate_rows(checks: tuple[Check, ...] | None) -> dict[str, list[dict[str, object]]]:
    """The certificate in JSON, when there is one."""
    return {} if checks is None else {"certificate": [check.to_dict() for check in checks]}
