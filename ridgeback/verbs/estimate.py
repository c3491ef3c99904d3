"""``ridgeback estimate``: the frequency of a recording over time, with its uncertainty, and its backbone."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import click

from ridgeback.arguments import BAND, POSITIVE
from ridgeback.failure import PartialError
from ridgeback.monte_carlo import monte_carlo_options, monte_carlo_verb, trials_and_file
from ridgeback.options import format_option, output_option
from ridgeback.output import json_text, write_text
from ridgeback.progress import Progress
from ridgeback.tables import aligned, csv_text, readable

if TYPE_CHECKING:
    from numeric.backbone import Backbone
    from numeric.recording import Recording
    from numeric.track import Track


@dataclass(frozen=True)
class Columns:
    """Where the samples and their times are in the file."""

    column: str | None
    time_column: str | None
    rate: float | None


@click.command("estimate", short_help="Estimate the frequency of a recording over time.")
@click.argument("file", required=False)
@click.option(
    "--column", default=None, metavar="NAME", help="The samples.  Needed when the file holds several signals."
)
@click.option("--time-column", default=None, metavar="NAME", help="The times.  Default: found by its name.")
@click.option("--rate", type=POSITIVE, default=None, metavar="R", help="Samples per second, in place of a time column.")
@click.option(
    "--method", default="auto", show_default=True, metavar="NAME", help="Estimator; a wrong name lists them all."
)
@click.option(
    "--harmonic", type=click.IntRange(1, 99), default=1, show_default=True, metavar="N", help="Harmonic to track."
)
@click.option(
    "--band", type=BAND, default=None, metavar="LOW,HIGH", help="Search band in rad/s.  Default: from the data."
)
@click.option(
    "--lag", type=POSITIVE, default=None, metavar="SECONDS", help="Length of the window.  Default: four cycles."
)
@click.option("--remove-bias", is_flag=True, help="Take the estimated bias off the values.")
@click.option("--backbone", "backbone_wanted", is_flag=True, help="Frequency and damping against amplitude instead.")
@monte_carlo_options
@format_option("text", "json", "csv", default="text")
@output_option
def command(
    file: str | None,
    column: str | None,
    time_column: str | None,
    rate: float | None,
    method: str,
    harmonic: int,
    band: tuple[float, float] | None,
    lag: float | None,
    remove_bias: bool,
    backbone_wanted: bool,
    monte_carlo: str | None,
    snr: tuple[float, ...],
    seed: int,
    style: str,
    output: str,
) -> None:
    """Estimate the fundamental frequency of the signal in FILE (CSV, NPZ or WAV) over time.

    Rows of time_s, omega_rad_s and frequency_hz, with the standard deviation that noise causes and the bias, where
    the estimator knows them; "valid" is false near the borders, where it does not see a whole window.

    \b
    ridgeback estimate run.csv --column u --method pseudo-wigner
    ridgeback estimate decay.csv --column displacement --backbone --format csv -o backbone.csv
    ridgeback estimate take.wav --method smoothed-pseudo-wigner --format json
    ridgeback estimate --monte-carlo 100 --snr 0,10,20,30
    """
    if backbone_wanted and harmonic != 1:
        raise click.UsageError(
            f"--backbone is that of the fundamental, not of harmonic {harmonic}; leave one of them out"
        )
    where = Columns(column, time_column, rate)
    if monte_carlo is not None:
        if backbone_wanted or harmonic != 1:
            raise click.UsageError("--monte-carlo is about the track of the fundamental; leave out what else is asked")
        trials, file = trials_and_file(monte_carlo, file)
        monte_carlo_verb(
            None if file is None else read(file, where),
            trials=trials,
            method=method,
            snr_db=snr,
            seed=seed,
            band=band,
            lag=lag,
            remove_bias=remove_bias,
            style=style,
            output=output,
        )
        return
    if file is None:
        raise click.UsageError("name the FILE of a recording; only --monte-carlo goes without one")
    recording = read(file, where)
    with Progress() as progress:
        progress(0.0, f"estimating by {method}")
        track = tracked(recording, method=method, band=band, lag_seconds=lag, remove_bias=remove_bias)
        if harmonic > 1:
            track = harmonic_of(recording, track, harmonic)
    if backbone_wanted:
        write_text(output, backbone_text(recording, track, style))
    else:
        write_text(output, track_text(recording, track, style))
    if not track.valid.any():
        raise PartialError(
            f"{track.method} found no sample it can vouch for; give a longer recording or a shorter --lag"
        )


def read(file: str, where: Columns) -> Recording:
    """The recording; the file's own problems are named by the reader."""
    from numeric.recording import read_recording

    return read_recording(file, column=where.column, time_column=where.time_column, rate=where.rate)


def tracked(recording: Recording, *, method: str, **settings: Any) -> Track:
    """The fundamental's track."""
    from numeric.estimate import estimate

    return estimate(recording.values, recording.rate, method=method, start=float(recording.time[0]), **settings)


def harmonic_of(recording: Recording, fundamental: Track, multiple: int) -> Track:
    """The track of a harmonic, found along multiples of the fundamental's phase."""
    from numeric.harmonics import harmonic_track

    first = float(recording.time[0])
    return harmonic_track(recording.values, recording.rate, fundamental, multiple=multiple, start=first)


def track_text(recording: Recording, track: Track, style: str) -> str:
    """The rows of a track in the form asked for."""
    rows = track.rows()
    if style == "json":
        return json_text({"method": track.method, "settings": about(recording, track.settings), "track": rows})
    columns = list(rows[0]) if rows else ["time_s", "omega_rad_s", "frequency_hz"]
    if style == "csv":
        return csv_text(columns, rows)
    return heading(recording, track) + "\n\n" + aligned(columns, rows) + "\n"


def backbone_text(recording: Recording, track: Track, style: str) -> str:
    """The rows of a backbone in the form asked for."""
    from numeric.backbone import backbone

    curve: Backbone = backbone(track, recording.values, recording.rate, start=float(recording.time[0]))
    rows = curve.rows()
    if style == "json":
        return json_text({"method": track.method, "settings": about(recording, track.settings), "backbone": rows})
    if style == "csv":
        return csv_text(list(rows[0]), rows)
    return heading(recording, track) + "\n\n" + aligned(list(rows[0]), rows) + "\n"


def about(recording: Recording, settings: Mapping[str, object]) -> dict[str, object]:
    """The estimator's settings, and which samples of which file they were used on."""
    return {"source": recording.source, "sha256": recording.sha256, "column": recording.name, **settings}


def heading(recording: Recording, track: Track) -> str:
    """What was estimated, from what, and how."""
    known = {name: value for name, value in track.settings.items() if isinstance(value, (int, float, str))}
    settings = ", ".join(f"{name} = {readable(value)}" for name, value in known.items())
    samples = f"{len(recording.values)} samples at {recording.rate:g} per second"
    return f"{recording.source}, {recording.name}: {samples}\n{track.method}: {settings}"
