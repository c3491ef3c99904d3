"""``ridgeback identify``: which oscillator made this decay, and with which parameters."""

from __future__ import annotations

from math import isinf, isnan
from typing import TYPE_CHECKING

import click

from ridgeback.common.quantities import sampling_text
from ridgeback.console.failure import PartialError
from ridgeback.console.output import json_text, write_text
from ridgeback.console.tables import aligned, csv_text, readable
from ridgeback.console.verb import Verb
from ridgeback.options.arguments import POSITIVE
from ridgeback.options.recording import Reading, Treatment, band_option, decimal_option, treatment_options
from ridgeback.options.shared import format_option, output_option

if TYPE_CHECKING:
    from ridgeback.compare.identification.results import Identification, Prediction

Row = dict[str, object]


def names(text: str | None) -> tuple[str, ...] | None:
    """The names in a list with commas; None when there is no list.

    >>> names("linear, pendulum")
    ('linear', 'pendulum')
    """
    return None if text is None else tuple(word.strip() for word in text.split(",") if word.strip())


@click.command("identify", cls=Verb, short_help="Say which oscillator made a decay.")
@click.argument("file")
@click.option(
    "--column", default=None, metavar="NAME", help="The samples.  Needed when the file holds several signals."
)
@click.option("--time-column", default=None, metavar="NAME", help="The times.  Default: found by its name.")
@click.option("--rate", type=POSITIVE, default=None, metavar="R", help="Samples per second, in place of a time column.")
@decimal_option
@treatment_options
@band_option
@click.option(
    "--candidates", default=None, metavar="NAME,...", help="Classes to try.  Default: all; a wrong name lists them."
)
@click.option(
    "--damping",
    type=click.Choice(("linear", "quadratic", "cubic", "coulomb")),
    default=None,
    help="Linear damping alone, or with one more term (coulomb: dry friction).  Default: what the criterion prefers "
    "of the first three.",
)
@click.option(
    "--criterion", type=click.Choice(("bic", "aicc")), default="bic", show_default=True, help="What ranks them."
)
@click.option(
    "--predict-from", type=POSITIVE, default=None, metavar="CYCLES", help="Fit these cycles and predict the rest too."
)
@format_option("text", "json", "csv", default="text")
@output_option
def command(
    file: str,
    column: str | None,
    time_column: str | None,
    rate: float | None,
    decimal: str | None,
    treatment: Treatment,
    band: tuple[float, float] | None,
    candidates: str | None,
    damping: str | None,
    criterion: str,
    predict_from: float | None,
    style: str,
    output: str,
) -> None:
    """Fit oscillator classes to the free decay in FILE (CSV, NPZ, WAV, MAT, HDF5), and rank them.

    Each class is fitted to the samples along its slow flow; the information criterion weighs what is left against
    the number of parameters.  CSV has one row per parameter, JSON also the backbones with their 95 % bands.

    \b
    ridgeback identify decay.csv --column displacement
    ridgeback identify decay.csv --candidates linear,pendulum,duffing-softening --format json
    ridgeback identify decay.csv --span 0,40 --predict-from 20
    """
    from ridgeback.interface.identify import identify

    recording = Reading(column, time_column, rate, decimal=decimal, treatment=treatment).one(file)
    found = identify(
        recording,
        candidates=names(candidates),
        damping=damping,
        criterion=criterion,
        band=band,
        predict_from=predict_from,
        progress=True,
    )
    write_text(output, text_of(found, style))
    if found.failed:
        raise PartialError(f"{len(found.failed)} of the candidates could not be fitted: {'; '.join(found.failed)}")


def text_of(found: Identification, style: str) -> str:
    """The result in the form asked for."""
    if style == "json":
        return json_text(found.record())
    if style == "csv":
        rows = parameter_rows(found)
        return csv_text(list(rows[0]), rows)
    return prose(found)


def parameter_rows(found: Identification) -> list[Row]:
    """One row per parameter of each candidate."""
    return [
        {
            "candidate": c.name,
            "damping": c.damping_law,
            "criterion": c.criterion,
            "delta": c.delta,
            "weight": c.weight,
            "residual": c.residual,
            "parameter": p.name,
            "value": p.value,
            "standard_deviation": p.standard_deviation,
            "low_95": p.interval()[0],
            "high_95": p.interval()[1],
            "unit": p.unit,
        }
        for c in found.candidates
        for p in c.parameters
    ]


def prose(found: Identification) -> str:
    """The verdict, the ranking, and the parameters of the best candidate."""
    unit = f" [{found.unit}]" if found.unit else ""
    parts = [
        f"{found.source}, {found.column}{unit}: {found.samples} samples at {sampling_text(found.rate)}, "
        f"of which {found.effective_samples:.0f} are independent",
        found.verdict,
        *found.notes,
    ]
    if found.hum:
        return "\n\n".join(parts) + "\n"
    parts += [
        aligned(["candidate", "damping", "parameters", "delta", "weight", "residual"], ranking(found)),
        best_of(found),
    ]
    if found.prediction is not None:
        parts.append(prediction_of(found.prediction))
    parts += [c.name + ": " + c.note for c in found.candidates[:1] if c.note]
    return "\n\n".join(parts) + "\n"


def ranking(found: Identification) -> list[Row]:
    """One row per candidate."""
    return [
        {
            "candidate": c.name,
            "damping": c.damping_law,
            "parameters": len(c.parameters),
            "delta": round(c.delta, 2),
            "weight": round(c.weight, 4),
            "residual": c.residual,
        }
        for c in found.candidates
    ]


def best_of(found: Identification) -> str:
    """The equation and parameters of the best candidate, with one standard deviation."""
    rows: list[Row] = [
        {
            "parameter": p.name,
            "value": readable(p.value),
            "±": deviation(p.standard_deviation),
            "unit": p.unit,
            "meaning": p.meaning,
        }
        for p in found.best.parameters
    ]
    return found.best.equation + "\n" + aligned(["parameter", "value", "±", "unit", "meaning"], rows)


def deviation(value: float) -> str:
    """One standard deviation as text.

    >>> deviation(0.0123), deviation(float("nan")), deviation(float("inf"))
    ('0.012', '-', 'undetermined')
    """
    return "undetermined" if isinf(value) else "-" if isnan(value) else f"{value:.2g}"


def prediction_of(ahead: Prediction) -> str:
    """How well the rest was predicted."""
    rows: list[Row] = [
        {
            "predicted": name,
            "rms error": f"{ahead.errors[name]:.2%}" if name != "phase" else f"{ahead.errors[name]:.3g} rad",
            "inside the 95 % band": f"{ahead.coverage[name]:.0%}" if name in ahead.coverage else "-",
        }
        for name in ("amplitude", "omega", "phase")
    ]
    span = f"From the first {ahead.cycles:g} cycles (to {ahead.until:.4g} s) to {ahead.time[-1]:.4g} s"
    head = f"{span}: the forecast {ahead.outcome.verb}. {ahead.note}."
    return head + "\n" + aligned(["predicted", "rms error", "inside the 95 % band"], rows)
