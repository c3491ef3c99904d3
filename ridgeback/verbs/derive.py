"""``ridgeback derive``: an exact expansion, in the form asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from ridgeback.choice import Choice, choosing
from ridgeback.demand import Demand, demanding
from ridgeback.derivation import Request, derived, requesting
from ridgeback.failure import PartialError
from ridgeback.high_order import by_primes, in_balls
from ridgeback.options import format_option, output_option
from ridgeback.output import json_text, write_text
from ridgeback.wording import as_text, certified, expressions, joined, range_of_use

if TYPE_CHECKING:
    from symbolic.ball_expansion import BallExpansion
    from symbolic.certificate import Check
    from symbolic.expansion import Expansion
    from symbolic.oscillator import Oscillator
    from symbolic.slow_flow import SlowFlow

    Result = Expansion | SlowFlow


@click.command("derive", short_help="Derive the frequency as an exact series.")
@choosing
@requesting
@demanding
@format_option("text", "json", "latex", "mathml", "python", default="text")
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
    ridgeback derive van-der-pol --order 96 --workers 8

    JSON: system, method, amplitude, order, variables; frequency (damping, amplitude_series) as a list of powers and
    coefficient.  Of balls also radius, ball and certain_digits (null: exact), and limits.  With --verify certificate.
    """
    oscillator = choice.oscillator()
    result: Result | BallExpansion
    if demand.digits is not None:
        result = in_balls(oscillator, request, demand.digits, demand.checkpoint)
    elif demand.workers is not None:
        result = by_primes(oscillator, request, demand.workers)
    else:
        result = derived(oscillator, request)
    checks = certificate(oscillator, result) if demand.verify else None
    write_text(output, printed(oscillator, result, demand.style, checks))
    if checks and not all(check.passed for check in checks if check.passed is not None):
        raise PartialError("the certificate does not hold; the output says which check failed")


def certificate(oscillator: Oscillator, result: Result | BallExpansion) -> tuple[Check, ...]:
    """Every independent check that applies."""
    from symbolic.ball_expansion import BallExpansion
    from symbolic.certificate import certify, certify_balls

    return certify_balls(oscillator, result) if isinstance(result, BallExpansion) else certify(oscillator, result)


def printed(
    oscillator: Oscillator, result: Result | BallExpansion, style: str, checks: tuple[Check, ...] | None
) -> str:
    """The result in the form asked for, with a line end; the certificate goes with text and JSON."""
    from symbolic.ball_expansion import BallExpansion

    if style == "text":
        return as_text(oscillator, result.to_dict()) + range_of_use(oscillator, result) + certified(checks)
    if isinstance(result, BallExpansion) or style == "json":
        return json_text({**result.to_dict(), **limit_rows(oscillator, result), **certificate_rows(checks)})
    match style:
        case "latex":
            return joined(result.latex())
        case "mathml":
            return joined(result.mathml())
    return joined(tuple(map(str, expressions(result))))


def limit_rows(oscillator: Oscillator, result: Result | BallExpansion) -> dict[str, dict[str, object]]:
    """The limits that balls show, in JSON."""
    from symbolic.accuracy import settled_limits
    from symbolic.ball_expansion import BallExpansion

    return {"limits": settled_limits(oscillator, result).to_dict()} if isinstance(result, BallExpansion) else {}


def certificate_rows(checks: tuple[Check, ...] | None) -> dict[str, list[dict[str, object]]]:
    """The certificate in JSON, when there is one."""
    return {} if checks is None else {"certificate": [check.to_dict() for check in checks]}
