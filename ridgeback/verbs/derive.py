"""``ridgeback derive``: an exact expansion, in the form asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from ridgeback.choice import Choice, choosing
from ridgeback.derivation import Request, derived, requesting
from ridgeback.failure import PartialError
from ridgeback.high_order import ball_checks, high_order_options, in_balls
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
@high_order_options
@click.option("--verify", is_flag=True, help="Check the result by independent routes and print the certificate.")
@format_option("text", "json", "latex", "mathml", "python", default="text")
@output_option
def command(
    *,
    choice: Choice,
    request: Request,
    digits: int | None,
    checkpoint: str | None,
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
    ridgeback derive van-der-pol --order 400 --digits 30 --checkpoint vdp.state --budget 30min
    """
    if checkpoint is not None and digits is None:
        raise click.UsageError("--checkpoint belongs to --digits; leave it out, or say how many digits")
    oscillator = choice.oscillator()
    if digits is not None:
        checks = show_balls(oscillator, request, digits, checkpoint, verify=verify, style=style, output=output)
    else:
        result = derived(oscillator, request)
        checks = certificate(oscillator, result) if verify else None
        write_text(output, printed(oscillator, result, style, checks))
    if checks and not all(check.passed for check in checks if check.passed is not None):
        raise PartialError("the certificate does not hold; the output says which check failed")


def show_balls(
    oscillator: Oscillator,
    request: Request,
    digits: int,
    checkpoint: str | None,
    *,
    verify: bool,
    style: str,
    output: str,
) -> tuple[Check, ...] | None:
    """Derive in balls and write them; the certificate is returned."""
    if style not in ("text", "json"):
        raise click.UsageError(f"--format {style} writes exact coefficients, not balls; use text or json")
    found = in_balls(oscillator, request, digits, checkpoint)
    checks = ball_checks(oscillator, found) if verify else None
    write_text(output, printed_balls(oscillator, found, style, checks))
    return checks


def certificate(oscillator: Oscillator, result: Result) -> tuple[Check, ...]:
    """Every independent check that applies."""
    from symbolic.certificate import certify

    return certify(oscillator, result)


def printed(oscillator: Oscillator, result: Result, style: str, checks: tuple[Check, ...] | None) -> str:
    """The result in the form asked for, with a line end; the certificate goes with text and JSON."""
    match style:
        case "json":
            return json_text({**result.to_dict(), **certificate_rows(checks)})
        case "latex":
            return joined(result.latex())
        case "mathml":
            return joined(result.mathml())
        case "python":
            return joined(tuple(map(str, expressions(result))))
    return as_text(oscillator, result.to_dict()) + range_of_use(oscillator, result) + certified(checks)


def printed_balls(oscillator: Oscillator, found: BallExpansion, style: str, checks: tuple[Check, ...] | None) -> str:
    """Balls as text or JSON, with the limits that they show."""
    if style == "text":
        return as_text(oscillator, found.to_dict()) + range_of_use(oscillator, found) + certified(checks)
    from symbolic.accuracy import settled_limits

    limits = settled_limits(oscillator, found).to_dict()
    return json_text({**found.to_dict(), "limits": limits, **certificate_rows(checks)})


def certificate_rows(checks: tuple[Check, ...] | None) -> dict[str, list[dict[str, object]]]:
    """The certificate in JSON, when there is one."""
    return {} if checks is None else {"certificate": [check.to_dict() for check in checks]}
