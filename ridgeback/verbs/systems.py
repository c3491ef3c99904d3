"""``ridgeback systems``: the catalogue, or one oscillator of it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from ridgeback.console.output import json_text, write_text
from ridgeback.console.tables import aligned, csv_text
from ridgeback.console.verb import Verb
from ridgeback.options.shared import format_option, output_option
from ridgeback.options.system import Choice

if TYPE_CHECKING:
    from ridgeback.symbolic.systems.oscillator import Oscillator

COLUMNS = ("name", "kind", "equation", "parameters")


@click.command("systems", cls=Verb, short_help="List the oscillators, or describe one.")
@click.argument("system", required=False)
@format_option("text", "json", "csv", default="text")
@output_option
def command(system: str | None, style: str, output: str) -> None:
    """List the oscillators of the catalogue, or describe the one named SYSTEM.

    \b
    ridgeback systems
    ridgeback systems pendulum --format json
    """
    if system is None and style == "text":
        from ridgeback.symbolic.systems.entries.every import listed as entries

        write_text(output, aligned(COLUMNS, [*entries(), *added()]) + "\n")
        return
    from ridgeback.symbolic.systems.catalogue import catalogue

    listed = catalogue() if system is None else (Choice(system, None, None, None, ()).oscillator(),)
    records = [record(oscillator) for oscillator in listed]
    write_text(output, printed(records, style, detailed=system is not None))


def added() -> list[dict[str, str]]:
    """What other distributions add; SymPy is imported only where there is something."""
    from importlib.metadata import entry_points

    if not entry_points(group="ridgeback.systems"):
        return []
    from ridgeback.symbolic.systems.entries.outsiders import outside_rows

    return list(outside_rows())


def record(oscillator: Oscillator) -> dict[str, Any]:
    """Everything the catalogue says of an oscillator, exact values as text."""
    from ridgeback.symbolic.systems.entries.every import known_frequency

    return {
        "name": oscillator.name,
        "title": oscillator.title,
        "kind": oscillator.kind,
        "equation": oscillator.equation,
        "parameters": {name: str(value) for name, value in oscillator.parameters.items()},
        "natural_frequency": str(oscillator.natural_frequency) if oscillator.is_linear_at_rest else None,
        "exact_frequency": known_frequency(oscillator.name),
        "potential": None if oscillator.potential is None else str(oscillator.potential),
        "aliases": list(oscillator.aliases),
        "reference": oscillator.reference,
        "description": oscillator.description,
    }


def printed(records: list[dict[str, Any]], style: str, *, detailed: bool) -> str:
    """The records in the form asked for."""
    if style == "json":
        return json_text(records[0] if detailed else records)
    rows = [{**r, "parameters": " ".join(f"{n}={v}" for n, v in r["parameters"].items())} for r in records]
    if style == "csv":
        return csv_text([*COLUMNS, "potential", "reference"], rows)
    row = {**rows[0], "aliases": ", ".join(rows[0]["aliases"])}
    width = max(map(len, row))
    return "".join(f"{key.ljust(width)}  {value}\n" for key, value in row.items() if value)
