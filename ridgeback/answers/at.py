"""``derive --at``: the exact frequency at amplitudes, certified, beside what an expansion gives there."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click
from click.core import ParameterSource

from ridgeback.console.failure import PartialError
from ridgeback.console.output import json_text
from ridgeback.console.tables import aligned, csv_text
from ridgeback.options.demand import Demand
from ridgeback.options.derivation import Request

if TYPE_CHECKING:
    from ridgeback.symbolic.certificates.at_amplitudes import Formula, Reading, Unread
    from ridgeback.symbolic.certificates.at_cycles import CycleReading
    from ridgeback.symbolic.systems.oscillator import Oscillator

    Row = CycleReading | Reading | Unread

DIGITS = 20
"""Digits printed when ``--digits`` does not say."""
CYCLE_DIGITS = 30
"""Likewise of limit cycles, each of which costs a second, however many digits it has."""
TEXT = {
    "amplitude_exact": "A",
    "omega0": "omega0",
    "radius": "radius",
    "formula_omega0": "formula",
    "relative_error": "relative error",
}
CYCLE_TEXT = {
    "omega0": "omega0",
    "radius": "radius",
    "amplitude": "peak",
    "amplitude_radius": "its radius",
    "stable": "stable",
    "formula_omega0": "formula",
    "relative_error": "relative error",
}


def read_at(oscillator: Oscillator, formula: Any, demand: Demand) -> tuple[CycleReading | Reading | Unread, ...]:
    """Hold the formula against the enclosures, wherever there is one; of a limit cycle at values of its parameter.

    Raises click.UsageError for a slow flow without limit cycles.  What has no enclosure leaves the series standing.
    """
    from ridgeback.symbolic.certificates.at_amplitudes import reading, wherever
    from ridgeback.symbolic.flow.slow_flow import SlowFlow

    small = cycle_parameter(oscillator, formula)
    if small is not None:
        from ridgeback.symbolic.certificates.at_cycles import certified_cycles

        held, precision = None if isinstance(formula, SlowFlow) else formula, bits(demand, CYCLE_DIGITS)
        return certified_cycles(oscillator, demand.at or (), small=small, formula=held, bits=precision)
    if isinstance(formula, SlowFlow):
        raise click.UsageError(
            "--at belongs to a series in the amplitude, and a slow flow is none: set the damping to 0 "
            "(--set mu=0), or use --transient"
        )
    series: Formula = formula
    return wherever(lambda a: reading(oscillator, series, a, bits=bits(demand)), demand.at or ())


def cycle_parameter(oscillator: Oscillator, formula: Any) -> str | None:
    """The parameter whose values ``--at`` gives, where there are limit cycles; None where it gives amplitudes."""
    if oscillator.kind == "limit-cycle" and oscillator.small is not None:
        return oscillator.small
    from ridgeback.symbolic.cycles.found import limits_itself
    from ridgeback.symbolic.flow.slow_flow import SlowFlow

    if not isinstance(formula, SlowFlow) or len(formula.weights) != 1:
        return None
    name = next(iter(formula.weights))
    return name if limits_itself(oscillator, name) else None


def complete(found: Sequence[Row]) -> None:
    """Raise PartialError, which names the first, when amplitudes were refused; the output is written by then."""
    from ridgeback.symbolic.certificates.at_amplitudes import Unread

    refused = [row for row in found if isinstance(row, Unread)]
    if refused:
        first = refused[0]
        what = "amplitudes" if first.variable == "A" else f"values of {first.variable}"
        raise PartialError(
            f"{len(refused)} of {len(found)} {what} have no enclosure and are left empty in the output; "
            f"{first.variable} = {first.amplitude}: {first.why}"
        )


def bits(demand: Demand, usual: int = DIGITS) -> int:
    """The precision that the digits need.

    >>> bits(Demand(digits=30))
    116
    """
    return max(64, math.ceil((demand.digits or usual) * math.log2(10)) + 16)


def rows(found: Sequence[Row], demand: Demand) -> list[dict[str, object]]:
    """The public rows."""
    return [reading.to_dict(demand.digits or (CYCLE_DIGITS if small_of(found) else DIGITS)) for reading in found]


def small_of(found: Sequence[Row]) -> str:
    """The name of the small parameter that the readings are at; empty where they are at amplitudes."""
    names = (getattr(row, "variable", "A") for row in found)
    return next((name for name in names if name != "A"), "")


def as_csv(found: Sequence[Row], demand: Demand) -> str:
    """One row per amplitude, the public keys as columns."""
    public = rows(found, demand)
    keys = dict.fromkeys(key for row in public for key in row)
    return csv_text(sorted(keys, key="refused".__eq__), public)  # the reason last, and only where there is one


def as_text(found: Sequence[Row], demand: Demand, what: str, definition: str) -> str:
    """A table for reading; ``what`` says which formula stands beside the exact frequency."""
    small = small_of(found)
    titles = {f"{small}_exact": small, **CYCLE_TEXT} if small else TEXT
    public = [{title: shown(row, key) for key, title in titles.items()} for row in rows(found, demand)]
    columns = list(titles.values()) if what else list(titles.values())[:-2]
    beside = f"; formula: {what}, and its relative error, proved" if what else ""
    where = f"values of {small}, limit cycles" if small else f"amplitudes ({definition})"
    return (
        f"\nomega0 at given {where}, within the radius of the exact frequency, certified{beside}\n"
        + aligned(columns, public)
        + "\n"
    )


def shown(row: dict[str, object], key: str) -> object:
    """What stands in a cell of the table.

    >>> shown({"stable": False}, "stable")
    'no'
    """
    if key == "relative_error":
        return zero_error(row)
    return {True: "yes", False: "no"}.get(bool(row[key])) if key == "stable" and key in row else row.get(key)


def zero_error(row: dict[str, object]) -> object:
    """An error that is not told from zero is printed by its bound, rounded up.

    >>> zero_error({"relative_error": None, "error_bound": 1.23e-38})
    'below 1.4e-38'
    """
    bound = row.get("error_bound")
    return row.get("relative_error") or (f"below {1.1 * bound:.1e}" if isinstance(bound, float) else None)


def read_strong(oscillator: Oscillator, request: Request, demand: Demand) -> tuple[Reading | Unread, ...]:
    """The enclosures for an oscillator without a linear restoring force, which has no expansion but orbits.

    Raises click.UsageError for options of expansions, InputError for forces that have no enclosure.
    """
    refuse_expansion(demand)
    from ridgeback.common.errors import InputError
    from ridgeback.symbolic.certificates.at_amplitudes import Reading, Unread, wherever
    from ridgeback.symbolic.enclosure.no_linear_part import enclose_strong

    definition, precision = request.amplitude or "peak", bits(demand)
    found = wherever(
        lambda a: Reading(enclose_strong(oscillator, a, definition=definition, bits=precision)), demand.at or ()
    )
    refused = [row for row in found if isinstance(row, Unread)]
    if refused and len(refused) == len(found):  # and no series stands beside them
        raise InputError(refused[0].why)
    return found


def strong(oscillator: Oscillator, found: Sequence[Reading | Unread], request: Request, demand: Demand) -> str:
    """The output for an oscillator without a linear restoring force: its law where it has one, and the enclosures."""
    from ridgeback.symbolic.enclosure.no_linear_part import law_of, law_row

    definition, law = request.amplitude or "peak", law_of(oscillator)
    if demand.style == "csv":
        return as_csv(found, demand)
    public = {
        "system": oscillator.name,
        "method": "enclosure",
        "amplitude": definition,
        **law_row(law, demand.digits or DIGITS),
    }
    if demand.style == "json":
        return json_text({**public, "at": rows(found, demand)})
    heading = (
        f"{oscillator.title}: {oscillator.equation}\nno linear restoring force, so no expansion in the amplitude\n"
    )
    formula = f"\nomega0 = {public['law']}\n       = {public['factor']} * A^{public['power']}\n" if law else ""
    return heading + formula + as_text(found, demand, "", definition)


def refuse_expansion(demand: Demand) -> None:
    """Raise click.UsageError for options that only an expansion has."""
    context = click.get_current_context()
    names = ("order", "method", "weight", "weights", "workers", "checkpoint", "verify", "resummed")
    given = [name for name in names if context.get_parameter_source(name) is ParameterSource.COMMANDLINE]
    if given:
        raise click.UsageError(
            f"--{given[0]} belongs to an expansion, and without a linear restoring force there is none; "
            "leave it out, --at encloses the frequency itself"
        )
    if demand.style not in ("text", "json", "csv"):
        raise click.UsageError(f"--format {demand.style} writes an expansion, and here is none; use text, json or csv")
