"""``derive --at``: the exact frequency at amplitudes, certified, beside what an expansion gives there."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

from ridgeback.common.numbers import exact_text
from ridgeback.console.failure import PartialError
from ridgeback.console.tables import aligned, csv_text
from ridgeback.options.demand import Demand

if TYPE_CHECKING:
    from ridgeback.symbolic.certificates.at_amplitudes import CertifiedFrequency, Formula, Refused
    from ridgeback.symbolic.certificates.at_cycles import CertifiedCycle
    from ridgeback.symbolic.flow.fixed_points import FixedPoint
    from ridgeback.symbolic.flow.slow_flow import SlowFlow
    from ridgeback.symbolic.systems.oscillator import Oscillator

    Row = CertifiedCycle | CertifiedFrequency | Refused

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


def read_at(
    oscillator: Oscillator, formula: Any, demand: Demand
) -> tuple[CertifiedCycle | CertifiedFrequency | Refused, ...]:
    """Hold the formula against the enclosures, wherever there is one; of a limit cycle at values of its parameter.

    Raises click.UsageError for a slow flow without limit cycles.  What has no enclosure leaves the series standing.
    """
    from ridgeback.symbolic.certificates.at_amplitudes import at_each, certified_frequency
    from ridgeback.symbolic.flow.loss_flow import LossFlow
    from ridgeback.symbolic.flow.slow_flow import SlowFlow

    small = cycle_parameter(oscillator, formula)
    if small is not None:
        from ridgeback.symbolic.certificates.at_cycles import certified_cycles

        held, precision = None if isinstance(formula, SlowFlow) else formula, bits(demand, CYCLE_DIGITS)
        return certified_cycles(oscillator, demand.at or (), small=small, formula=held, bits=precision)
    if isinstance(formula, LossFlow):
        raise click.UsageError(
            "--at belongs to a series in the amplitude or to a limit cycle of a smooth law, and averaged losses give "
            "neither: leave the losses out, or follow the motion by simulate"
        )
    if isinstance(formula, SlowFlow):
        raise click.UsageError(
            "--at belongs to a series in the amplitude, and a slow flow is none: set the damping to 0 "
            "(--set mu=0), or use --transient"
        )
    series: Formula = formula
    return at_each(lambda a: certified_frequency(oscillator, series, a, bits=bits(demand)), demand.at or ())


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
    if not found:
        return
    from ridgeback.symbolic.certificates.at_amplitudes import Refused

    refused = [row for row in found if isinstance(row, Refused)]
    if refused:
        first = refused[0]
        what = "amplitudes" if first.variable == "A" else f"values of {first.variable}"
        raise PartialError(
            f"{len(refused)} of {len(found)} {what} have no enclosure and are left empty in the output; "
            f"{first.variable} = {exact_text(first.amplitude)}: {first.why}"
        )


def bits(demand: Demand, usual: int = DIGITS) -> int:
    """The precision that the digits need.

    >>> bits(Demand(digits=30))
    116
    """
    return max(64, math.ceil((demand.digits or usual) * math.log2(10)) + 16)


def rows(found: Sequence[Row], demand: Demand) -> list[dict[str, object]]:
    """The public rows."""
    return [row.to_dict(demand.digits or (CYCLE_DIGITS if small_of(found) else DIGITS)) for row in found]


def small_of(found: Sequence[Row]) -> str:
    """The name of the small parameter that the rows are at; empty where they are at amplitudes."""
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


def true_cycles(
    oscillator: Oscillator, flow: SlowFlow, points: Sequence[FixedPoint]
) -> tuple[CertifiedCycle | Refused, ...]:
    """Enclose the limit cycles at the oscillator's own parameters, where the fixed points do not tell of them.

    That is so when one that belongs to a series lies beyond the reach of the order; of others only if there is none.
    """
    telling = [point for point in points if point.square_series is not None] or points
    if not any(point.reach.beyond for point in telling):
        return ()
    from fractions import Fraction

    from ridgeback.symbolic.certificates.at_cycles import certified_cycles

    name = next(iter(flow.weights))
    value = oscillator.parameters[name]
    if value is None:
        return ()
    return certified_cycles(oscillator, [Fraction(int(value.p), int(value.q))], small=name, bits=bits(Demand()))


def cycle_rows(oscillator: Oscillator, flow: SlowFlow, points: Sequence[FixedPoint]) -> dict[str, object]:
    """The rows in JSON, when there are any."""
    found = true_cycles(oscillator, flow, points)
    return {"limit_cycles": [row.to_dict(DIGITS) for row in found]} if found else {}


def cycle_lines(oscillator: Oscillator, flow: SlowFlow, points: Sequence[FixedPoint]) -> str:
    """The same in words, a line each."""
    return "".join(_true_line(row.to_dict(DIGITS)) for row in true_cycles(oscillator, flow, points))


def _true_line(row: dict[str, object]) -> str:
    if row["omega0"] is None:
        return f"\nno true limit cycle is enclosed: {row['refused']}\n"
    return (
        f"\ntrue limit cycle, enclosed: peak = {row['amplitude']}, omega0 = {row['omega0']} within {row['radius']}, "
        f"{'stable' if row['stable'] else 'unstable'}\n"
    )
