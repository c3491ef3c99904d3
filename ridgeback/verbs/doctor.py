"""``ridgeback doctor``: versions, optional parts, compilers and browsers found, and what each would add."""

from __future__ import annotations

import click

from ridgeback.console.output import json_text, write_text
from ridgeback.console.surroundings import Part, about, parts
from ridgeback.console.tables import aligned
from ridgeback.console.verb import Verb
from ridgeback.options.shared import format_option, output_option

TITLES = {"needed": "Needed", "optional": "Optional libraries", "program": "Programs", "plugin": "Plugins"}


@click.command("doctor", cls=Verb, short_help="Say what is installed, and what else would add what.")
@format_option("text", "json", default="text")
@output_option
def command(style: str, output: str) -> None:
    """Say which libraries, compilers, browsers and plugins are found, and what each that is missing would add.

    Nothing is imported or run.  The exit code is 4 where a library that is needed is missing or too old.

    \b
    ridgeback doctor
    ridgeback doctor --format json
    """
    found = parts()
    write_text(output, json_text(about()) if style == "json" else told(found))
    wrong = [part for part in found if part.wrong]
    if wrong:
        raise OSError("; ".join(f"{part.name} is {part.found or 'missing'}: {part.remedy}" for part in wrong))


def told(found: tuple[Part, ...]) -> str:
    """The parts by kind, each with what it adds and how to get it."""
    head = about()
    lines = [f"ridgeback {head['ridgeback'] or 'not installed'}, Python {head['python']}, {head['system']}", ""]
    for kind, title in TITLES.items():
        rows = [row(part) for part in found if part.kind == kind]
        lines += [*([title, aligned(("name", "found", "adds", "to get it"), rows), ""] if rows else [])]
    return "\n".join(lines[:-1]) + "\n"


def row(part: Part) -> dict[str, object]:
    """One part as a line."""
    return {"name": part.name, "found": part.found, "adds": part.adds, "to get it": part.remedy or ""}
