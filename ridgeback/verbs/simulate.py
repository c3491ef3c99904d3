"""``ridgeback simulate``: an integrated trajectory as columns of numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from ridgeback.console.output import json_text, write_text
from ridgeback.console.tables import csv_text
from ridgeback.console.verb import Verb
from ridgeback.options.arguments import PAIR, POSITIVE
from ridgeback.options.shared import format_option, output_option
from ridgeback.options.system import Choice, choosing

if TYPE_CHECKING:
    from ridgeback.numeric.motion.trajectory import Trajectory
    from ridgeback.symbolic.systems.oscillator import Oscillator

COLUMNS = ("time_s", "u", "velocity")


@click.command("simulate", cls=Verb, short_help="Integrate the equation of motion.")
@choosing
@click.option("--initial", type=PAIR, default=None, metavar="U,V", help="State at time 0.  Default: the catalogue's.")
@click.option("--duration", type=POSITIVE, default="20", show_default=True, metavar="T", help="Time to integrate over.")
@click.option("--rate", type=POSITIVE, default="64", show_default=True, metavar="R", help="Samples per time unit.")
@click.option(
    "--method",
    default="auto",
    show_default=True,
    help="DOP853, RK45, Radau, BDF, LSODA, taylor, heyoka where it is installed; auto is DOP853, or Radau if stiff.",
)
@click.option(
    "--digits", type=click.IntRange(15, 200), default=None, help="Digits that taylor works with.  Default: 30."
)
@format_option("csv", "json", default="csv")
@output_option
def command(
    *,
    choice: Choice,
    initial: tuple[float, float] | None,
    duration: float,
    rate: float,
    method: str,
    digits: int | None,
    style: str,
    output: str,
) -> None:
    """Integrate SYSTEM from the state U,V and write the columns time_s, u, velocity.

    Every number is written with all the digits that it needs to be read back the same.  A force with kinks (abs, sign)
    is integrated from one located switch to the next; JSON says when dry friction holds the motion (rest_from).

    \b
    ridgeback simulate pendulum --set mu=0.01 --set k=12.566370614359172 --initial 2.984513,0 -o run.csv
    ridgeback simulate van-der-pol --duration 60 --method taylor --digits 40 --format json
    """
    oscillator = choice.oscillator()
    start = oscillator.initial if initial is None else initial
    run = trajectory(oscillator, start, duration=duration, rate=rate, method=method, digits=digits)
    write_text(output, printed(oscillator.name, run, style))


def trajectory(
    oscillator: Oscillator,
    initial: tuple[float, float],
    *,
    duration: float,
    rate: float,
    method: str,
    digits: int | None,
) -> Trajectory:
    """Integrate by the method asked for.

    Raises click.UsageError when ``--digits`` is given to a method in double precision.
    """
    if digits is not None and method.lower() != "taylor":
        raise click.UsageError(f"--digits belongs to --method taylor; {method} works in double precision")
    from ridgeback.interface.simulate import simulate

    return simulate(oscillator, initial, duration=duration, rate=rate, method=method, digits=digits)


def printed(system: str, run: Trajectory, style: str) -> str:
    """The samples in the form asked for."""
    arrays = (run.time.tolist(), run.u.tolist(), run.velocity.tolist())
    rows = [dict(zip(COLUMNS, values, strict=True)) for values in zip(*arrays, strict=True)]
    if style == "csv":
        return csv_text(COLUMNS, rows)
    about: dict[str, Any] = {"system": system, "method": run.method, "rtol": run.rtol, "rate": run.rate}
    rest = {} if run.rest_from is None else {"rest_from": run.rest_from}
    return json_text({**about, **rest, "samples": rows})
