"""``ridgeback simulate``: an integrated trajectory as columns of numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import click

from ridgeback.console.failure import PartialError, say
from ridgeback.console.output import json_text, write_text
from ridgeback.console.tables import csv_text
from ridgeback.console.verb import Verb
from ridgeback.options.arguments import PAIR, POSITIVE
from ridgeback.options.shared import drift_option, format_option, output_option, refuse_twice, unique
from ridgeback.options.system import Choice, choosing

if TYPE_CHECKING:
    from ridgeback.compare.drift.results import DriftComparison
    from ridgeback.numeric.motion.trajectory import Trajectory
    from ridgeback.symbolic.systems.oscillator import Oscillator

COLUMNS = ("time_s", "u", "velocity")


@click.command("simulate", cls=Verb, short_help="Integrate the equation of motion.")
@choosing
@drift_option
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
@click.option("--energy", is_flag=True, help="Add the terms of the energy balance, eq. (15)-(19), per unit of mass.")
@format_option("csv", "json", default="csv")
@output_option
def command(
    *,
    choice: Choice,
    laws: tuple[tuple[str, str], ...],
    initial: tuple[float, float] | None,
    duration: float,
    rate: float,
    method: str,
    digits: int | None,
    energy: bool,
    style: str,
    output: str,
) -> None:
    """Integrate SYSTEM from the state U,V and write the columns time_s, u, velocity.

    Every number is written with all the digits that it needs to be read back the same.  A force with kinks (abs, sign)
    is integrated from one located switch to the next; JSON says when dry friction holds the motion (rest_from).
    With --drift the columns omega0 (at the conserved action and the parameters of the moment), amplitude (the peak
    of that orbit) and cycle_omega0 (between located crossings, where there are) follow, and their error is said.

    \b
    ridgeback simulate pendulum --set mu=0.01 --set k=12.566370614359172 --initial 2.984513,0 -o run.csv
    ridgeback simulate --equation "x'' + 9.81/L*sin(x) = 0" --drift "L=1+0.01*t" --initial 1,0 --duration 60
    ridgeback simulate damped-duffing --energy -o energy.csv
    ridgeback simulate van-der-pol --duration 60 --method taylor --digits 40 --format json
    """
    oscillator = choice.oscillator()
    if laws:
        drifting = unique(laws, "--drift")
        refuse_twice(choice.assignments, drifting)
        if energy:
            raise click.UsageError("--energy is of a force that does not change; under --drift energy is not conserved")
        followed(oscillator, drifting, Run(initial, duration, rate, method, digits), style, output)
        return
    start = oscillator.initial if initial is None else initial
    run = trajectory(oscillator, start, duration=duration, rate=rate, method=method, digits=digits)
    write_text(output, printed(oscillator.name, run, style, energy_of(oscillator, run) if energy else ()))


def energy_of(oscillator: Oscillator, run: Trajectory) -> Sequence[Mapping[str, float]]:
    """The terms of the energy balance, one row per sample."""
    from ridgeback.interface.simulate import energy_terms

    return energy_terms(oscillator, run).rows()


@dataclass(frozen=True)
class Run:
    """What an integration is asked to do, as it was said."""

    initial: tuple[float, float] | None
    duration: float
    rate: float
    method: str
    digits: int | None


def followed(oscillator: Oscillator, laws: Mapping[str, str], run: Run, style: str, output: str) -> None:
    """Write a motion under a drift, with omega0 by the action where there is one, and say how far that is off.

    Raises click.UsageError for ``--digits``, PartialError for a drift that is not slow.
    """
    if run.digits is not None:
        raise click.UsageError("--digits belongs to --method taylor, which follows no drift; leave it out")
    from ridgeback.compare.drift.comparison import sentences
    from ridgeback.interface.drift import drift
    from ridgeback.interface.simulate import simulate
    from ridgeback.numeric.motion.trajectory import METHODS
    from ridgeback.symbolic.flow.drift import drifting

    if run.method.lower() not in {name.lower() for name in METHODS}:
        raise click.UsageError(f"--method {run.method} follows no drift; use one of {', '.join(METHODS)}")
    own = drifting(oscillator, laws)
    if own.potential is None:
        say(f"{own.start.name}: without a potential no action is conserved; this is the integrated motion alone")
        plain = simulate(oscillator, run.initial, duration=run.duration, rate=run.rate, method=run.method, drift=laws)
        write_text(output, printed(oscillator.name, plain, style))
        return
    found = drift(oscillator, laws, run.initial, duration=run.duration, rate=run.rate, method=run.method)
    rows = found.rows()
    write_text(output, csv_text(tuple(rows[0]), rows) if style == "csv" else drift_json(found))
    for sentence in sentences(found):
        say(sentence)
    if not found.adiabatic.is_slow:
        raise PartialError("omega0 by the action is not to be relied on where the drift is not slow")


def drift_json(found: DriftComparison) -> str:
    """A motion under a drift: what drifts, the errors, and the samples."""
    run = found.trajectory
    return json_text(
        {
            "system": found.case.system,
            "method": run.method,
            "rtol": run.rtol,
            "rate": run.rate,
            "drift": found.laws,
            "relative_change_per_radian": found.rate,
            "slow": found.adiabatic.is_slow,
            "expected_error": found.expected_error,
            "rms_error": found.rms_error,
            "max_error": found.max_error,
            "error_without_drift": found.frozen_error,
            "integrators_differ_by": found.disagreement,
            "samples": found.rows(),
        }
    )


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


def printed(system: str, run: Trajectory, style: str, more: Sequence[Mapping[str, float]] = ()) -> str:
    """The samples in the form asked for, with more columns where there are any."""
    arrays = (run.time.tolist(), run.u.tolist(), run.velocity.tolist())
    rows = [dict(zip(COLUMNS, values, strict=True)) for values in zip(*arrays, strict=True)]
    columns: tuple[str, ...] = COLUMNS
    if more:
        columns = tuple(dict.fromkeys((*COLUMNS, *more[0])))
        rows = [{**row, **other} for row, other in zip(rows, more, strict=True)]
    if style == "csv":
        return csv_text(columns, rows)
    about: dict[str, Any] = {"system": system, "method": run.method, "rtol": run.rtol, "rate": run.rate}
    rest = {} if run.rest_from is None else {"rest_from": run.rest_from}
    return json_text({**about, **rest, "samples": rows})
