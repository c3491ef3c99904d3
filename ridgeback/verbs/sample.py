"""``ridgeback sample``: a recording of our own making, with its truth, to try things on."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from ridgeback.console.output import json_text, write_text
from ridgeback.console.tables import csv_text
from ridgeback.console.verb import Verb
from ridgeback.options.shared import format_option, output_option

if TYPE_CHECKING:
    from ridgeback.compare.recording.samples import Sample

COLUMNS = ("time_s", "value", "omega_rad_s", "amplitude", "growth_rate_per_s")


@click.command("sample", cls=Verb, short_help="Write a sample recording, with its truth.")
@click.argument("name", type=click.Choice(("decay", "hammer", "pendulum")))
@click.option("--truth", is_flag=True, help="CSV with the true frequency, amplitude and growth rate at each sample.")
@format_option("csv", "json", default="csv")
@output_option
def command(name: str, truth: bool, style: str, output: str) -> None:
    """Write the sample recording NAME as an instrument would: a column of times and one of samples.

    decay softens, with linear and cubic damping, in millimetres; hammer is the ringdown of two modes after a blow;
    pendulum is one with linear damping, in degrees.  Each comes out the same every time.  JSON, and CSV with --truth,
    have what is known of it; angles are in radians there.

    \b
    ridgeback sample decay -o decay.csv
    ridgeback estimate decay.csv --backbone
    ridgeback sample decay --truth -o truth.csv
    """
    if truth and style == "json":
        raise click.UsageError("--truth is for CSV; JSON has the truth, leave it out")
    from ridgeback.compare.recording.samples import sample

    write_text(output, printed(sample(name), style, truth=truth))


def printed(found: Sample, style: str, *, truth: bool) -> str:
    """The sample in the form asked for."""
    if style == "csv":
        return csv_text(COLUMNS, found.rows()) if truth else found.csv()
    about = {"name": found.name, "about": found.about, "rate": found.recording.rate, "units": found.recording.units}
    return json_text({**about, "parameters": dict(found.parameters), "samples": found.rows()})
