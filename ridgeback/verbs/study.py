"""``ridgeback study``: the error of truncated expansions over order and amplitude."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import click

from ridgeback.answers.atlas_table import atlas_verb
from ridgeback.answers.study_file import is_study_file, study_file_verb
from ridgeback.answers.study_tables import FORMATS as TABLES
from ridgeback.console.failure import PartialError, say
from ridgeback.console.output import json_text, write_text
from ridgeback.console.tables import Row, aligned, csv_text
from ridgeback.console.verb import Verb
from ridgeback.options.arguments import GRID, ORDERS
from ridgeback.options.shared import format_option, output_option
from ridgeback.options.study import Run, studying, with_parameters
from ridgeback.options.system import Choice
from ridgeback.options.unused import refuse_unused

if TYPE_CHECKING:
    from ridgeback.compare.study.results import Study
    from ridgeback.symbolic.systems.oscillator import Oscillator

BESIDE_AN_EXAMPLE = (
    *(
        "system",
        "equation",
        "about",
        "potential",
        "settings",
        "store",
        "workers",
        "scheduler",
        "dry",
        "against",
        "plot",
    ),
    *("orders", "amplitudes", "method", "certified", "style"),
)
BESIDE_AN_ATLAS = (
    *("system", "equation", "about", "potential", "settings", "store", "workers", "scheduler", "dry", "against"),
    *("plot", "amplitudes", "method", "certified"),
)


@click.command("study", cls=Verb, short_help="Error of expansions over order and amplitude.")
@studying
@click.option(
    "--orders", type=ORDERS, default=None, show_default="2,4,8,16", metavar="N,N,...", help="Orders to compare."
)
@click.option(
    "--amplitudes",
    type=GRID,
    default=None,
    metavar="START:STOP:COUNT",
    help="Peak amplitudes (or values of eps), as a range with both ends or as a list with commas.",
)
@click.option(
    "--method",
    type=click.Choice(["lindstedt", "energy-integral"]),
    default=None,
    help="How the expansion is derived.  Default: lindstedt, and energy-integral for a force with a kink at rest or "
    "without a linear part.",
)
@click.option(
    "--certified",
    is_flag=True,
    help="Prove every error in ball arithmetic, and put the resummations of the series beside it.",
)
@click.option(
    "--atlas",
    is_flag=True,
    help="Instead: where the series of every oscillator of the catalogue converges, what stops it, and its proved "
    "errors inside.",
)
@format_option("text", "json", "csv", "markdown", "parquet", "netcdf", "zarr", default="text")
@output_option
def command(
    *,
    choice: Choice,
    run: Run,
    example: str | None,
    orders: tuple[int, ...] | None,
    amplitudes: tuple[float, ...] | None,
    method: str | None,
    certified: bool,
    atlas: bool,
    style: str,
    output: str,
) -> None:
    """Hold truncated expansions of SYSTEM against its exact frequency: one row per order and amplitude.

    With a study file (TOML with a table [study]) run all that it asks: in parallel, kept as it goes, resumable.

    \b
    ridgeback study pendulum --orders 2,4,8,16 --amplitudes 0.1:3.0:30
    ridgeback study pendulum --orders 8,16 --amplitudes 1,2,3 --certified
    ridgeback study van-der-pol --orders 4,8 --amplitudes 0.1,0.5,1 --format csv
    ridgeback study van-der-pol --orders 8,16 --amplitudes 0.5,1,2 --certified
    ridgeback study --atlas --orders 4,8,16,32 --format markdown -o atlas.md
    ridgeback study --example estimators > estimators.toml
    ridgeback study estimators.toml --workers 2 --format markdown
    ridgeback study --example five-oscillators > five.toml
    ridgeback study five.toml --workers 2 --format csv -o cells.csv
    ridgeback study five.toml --set orders=2,4,8,16,32 --store other.db
    """
    if example is not None:
        refuse_unused("--example, which prints a study file,", *BESIDE_AN_EXAMPLE)
        from ridgeback.compare.studies.examples import example as text_of

        write_text(output, text_of(example))
        return
    if is_study_file(choice.system):
        if orders or amplitudes or certified:
            raise click.UsageError("a study file has orders and amplitudes of its own; use --set to change them")
        refuse_unused("a study file", "method", "equation", "about", "potential")
        study_file_verb(str(choice.system), run, style=style, output=output)
        return
    choice = with_parameters(choice, run)
    if atlas:
        refuse_unused("--atlas", *BESIDE_AN_ATLAS)
        atlas_verb(orders, style=style, output=output)
        return
    orders = orders or (2, 4, 8, 16)
    if style in TABLES:
        raise click.UsageError(f"--format {style} belongs to a study file; ridgeback study --example paper prints one")
    if style == "markdown":
        raise click.UsageError("--format markdown belongs to --atlas and to a study file")
    if certified:
        refuse_unused("--certified", "method")
    if amplitudes is None:
        raise click.UsageError("Missing option '--amplitudes': give a range such as 0.1:3.0:30, or a list with commas")
    if certified:
        proved(choice.oscillator(), orders, amplitudes, style, output)
        return
    from ridgeback.compare.study.study import study

    oscillator = choice.oscillator()
    result = study(oscillator, orders, amplitudes, method=method)
    rows = result.rows()
    dropped = dropped_by_study(oscillator)
    write_text(output, printed(result, rows, style, dropped=dropped))
    say_dropped(dropped, style)
    unknown = sum(not math.isfinite(float(row["omega_reference"])) for row in rows)
    if unknown:
        raise PartialError(f"{unknown} of {len(rows)} cells have no reference; they are left empty in the output")


def proved(
    oscillator: Oscillator, orders: tuple[int, ...], amplitudes: tuple[float, ...], style: str, output: str
) -> None:
    """The series and its resummations with proved errors; ``error_radius`` bounds what each error may still be off.

    Raises PartialError, with the reason, when some of the frequencies could not be enclosed.
    """
    from ridgeback.compare.study.certified import certified_rows
    from ridgeback.compare.study.derived import without_damping

    rows = certified_rows(without_damping(oscillator).oscillator, orders, amplitudes)
    columns = list(dict.fromkeys(key for row in rows for key in row))
    text = {"csv": lambda: csv_text(columns, rows), "json": lambda: json_text(rows)}
    dropped = dropped_by_study(oscillator)
    above = f"{oscillator.title}: {dropped}\n\n" if dropped else ""
    write_text(output, text.get(style, lambda: above + aligned(columns, rows) + "\n")())
    say_dropped(dropped, style)
    refused = [row for row in rows if "refused" in row]
    if refused:
        raise PartialError(f"{len(refused)} of {len(rows)} cells have no enclosed reference: {refused[0]['refused']}")


def printed(result: Study, rows: list[dict[str, float | int | str]], style: str, *, dropped: str = "") -> str:
    """The rows in the form asked for."""
    columns = list(rows[0])
    if style == "csv":
        return csv_text(columns, rows)
    if style == "json":
        return json_text(rows)
    return heading(result, dropped=dropped) + "\n\n" + aligned(columns, as_rows(rows)) + "\n"


def dropped_by_study(oscillator: Oscillator) -> str:
    """The damping that a study leaves out, in words; empty where there is none."""
    from ridgeback.compare.study.derived import damping_names

    if oscillator.kind != "damped":
        return ""
    return ", ".join(["the study is of the undamped motion", *(f"{name} = 0" for name in damping_names(oscillator))])


def say_dropped(dropped: str, style: str) -> None:
    """Say beside rows for machines, which have no heading, what damping the study leaves out."""
    if dropped and style != "text":
        say(dropped)


def as_rows(rows: list[dict[str, float | int | str]]) -> list[Row]:
    """Rows as the table wants them."""
    return list(rows)


def heading(result: Study, *, dropped: str = "") -> str:
    """What the rows hold, and against what; ``dropped`` is the sentence about damping."""
    variable = f"{result.variable} ({result.amplitude_definition})" if result.variable == "A" else result.variable
    lines = [
        f"{result.title}: omega0 in rad per time unit over {variable}, {result.method}",
        f"reference: {result.reference_name}",
    ]
    if dropped:
        lines.append(dropped)
    if result.limit is not None:
        lines.append(f"the oscillation ends at {result.variable} = {result.limit:.6g}")
    if result.convergence_radius is not None:
        lines.append(f"the series converges for {result.variable} below about {result.convergence_radius:.4g}")
    return "\n".join(lines)
