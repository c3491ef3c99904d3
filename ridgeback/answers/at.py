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
    from ridgeback.symbolic.systems.oscillator import Oscillator

DIGITS = 20
"""Digits printed when ``--digits`` does not say."""
TEXT = {
    "amplitude_exact": "A",
    "omega0": "omega0",
    "radius": "radius",
    "formula_omega0": "formula",
    "relative_error": "relative error",
}


def read_at(oscillator: Oscillator, formula: Any, demand: Demand) -> tuple[Reading | Unread, ...]:
    """Hold the formula against the enclosures, wherever there is one.

    Raises click.UsageError for a slow flow.  An amplitude without an enclosure leaves the series standing.
    """
    from ridgeback.symbolic.certificates.at_amplitudes import reading, wherever
    from ridgeback.symbolic.flow.slow_flow import SlowFlow

    if isinstance(formula, SlowFlow):
        raise click.UsageError(
            "--at belongs to a series in the amplitude, and a slow flow is none: set the damping to 0 "
            "(--set mu=0), or use --transient"
        )
    series: Formula = formula
    return wherever(lambda a: reading(oscillator, series, a, bits=bits(demand)), demand.at or ())


def complete(found: Sequence[Reading | Unread]) -> None:
    """Raise PartialError, which names the first, when amplitudes were refused; the output is written by then."""
    from ridgeback.symbolic.certificates.at_amplitudes import Unread

    refused = [row for row in found if isinstance(row, Unread)]
    if refused:
        raise PartialError(
            f"{len(refused)} of {len(found)} amplitudes have no enclosure and are left empty in the output; "
            f"A = {refused[0].amplitude}: {refused[0].why}"
        )


def bits(demand: Demand) -> int:
    """The precision that the digits need.

    >>> bits(Demand(digits=30))
    116
    """
    return max(64, math.ceil((demand.digits or DIGITS) * math.log2(10)) + 16)


def rows(found: Sequence[Reading | Unread], demand: Demand) -> list[dict[str, object]]:
    """The public rows."""
    return [reading.to_dict(demand.digits or DIGITS) for reading in found]


def as_csv(found: Sequence[Reading | Unread], demand: Demand) -> str:
    """One row per amplitude, the public keys as columns."""
    public = rows(found, demand)
    keys = dict.fromkeys(key for row in public for key in row)
    return csv_text(sorted(keys, key="refused".__eq__), public)  # the reason last, and only where there is one


def as_text(found: Sequence[Reading | Unread], demand: Demand, what: str, definition: str) -> str:
    """A table for reading; ``what`` says which formula stands beside the exact frequency."""
    public = [
        {title: zero_error(row) if key == "relative_error" else row.get(key) for key, title in TEXT.items()}
        for row in rows(found, demand)
    ]
    columns = list(TEXT.values()) if what else list(TEXT.values())[:3]
    beside = f"; formula: {what}, and its relative error, proved" if what else ""
    return (
        f"\nomega0 at given amplitudes ({definition}), within the radius of the exact frequency, certified{beside}\n"
        + aligned(columns, public)
        + "\n"
    )


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
