"""``ridgeback estimate``: the frequency of a recording over time, with its uncertainty, and its backbone."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import click

from ridgeback.answers.measurements_text import asides, measurements_text, misfit
from ridgeback.answers.monte_carlo import monte_carlo_options, monte_carlo_verb, trials_and_file
from ridgeback.common.progress import step
from ridgeback.console.failure import PartialError, say
from ridgeback.console.output import STDOUT, write_bytes, write_text
from ridgeback.console.verb import Verb
from ridgeback.options.estimator import Estimator, estimator_options
from ridgeback.options.model import MODEL_FIT, Model, model_options
from ridgeback.options.plot import plane_path, plot_option
from ridgeback.options.recording import Reading, reading_options
from ridgeback.options.shared import format_option, output_option
from ridgeback.options.unused import refuse_unused

if TYPE_CHECKING:
    from ridgeback.compare.recording.measurements import Measurements

OF_A_FILE = ("column", "time_column", "rate", "decimal", "quantity", "span", "resample", "fill", "detrend", "unit")
"""Options that say where samples are and how they are treated."""


@click.command("estimate", cls=Verb, short_help="Estimate the frequency of a recording over time.")
@click.argument("files", nargs=-1, metavar="FILE...")
@reading_options
@estimator_options
@model_options
@click.option(
    "--harmonic", type=click.IntRange(1, 99), default=1, show_default=True, metavar="N", help="Harmonic to track."
)
@click.option("--half-cycles", is_flag=True, help="Frequency, amplitude and growth rate of each half cycle instead.")
@click.option(
    "--backbone", "backbone_wanted", is_flag=True, help="Frequency and growth rate against amplitude instead."
)
@click.option(
    "--combine",
    type=click.Choice(("runs", "all", "none")),
    default="runs",
    show_default=True,
    help="Backbones to average: of the runs and stretches of a channel, or of all channels too.",
)
@click.option(
    "--all", "every", is_flag=True, help="Every row and column of the table in the terminal, not some thirty."
)
@plot_option("the signal, frequency, backbone and damping with their bands")
@click.option(
    "--planes",
    type=plane_path,
    default=None,
    metavar="FILE.npz|png",
    help="Write the time-frequency plane that the method follows, with the track; a spectrogram for methods without.",
)
@monte_carlo_options
@format_option("text", "json", "csv", default="text")
@output_option
def command(
    files: tuple[str, ...],
    reading: Reading,
    estimator: Estimator,
    model: Model,
    harmonic: int,
    half_cycles: bool,
    backbone_wanted: bool,
    combine: str,
    every: bool,
    plot: str | None,
    planes: str | None,
    monte_carlo: str | None,
    snr: tuple[float, ...],
    seed: int,
    workers: int | None,
    style: str,
    output: str,
) -> None:
    """Estimate frequency, amplitude and growth rate of the signals in FILE... (CSV, NPZ, WAV, MAT, HDF5) over time.

    Rows of time_s, omega_rad_s, frequency_hz, the amplitude of the fundamental and its rate of change a'/a
    (growth_rate_per_s), each with the standard deviation that noise causes; the bias, where the estimator knows it;
    "valid" is false near the borders, where it does not see a whole window.  In the terminal a summary stands above
    some thirty of the rows, values beside their deviations; --all or a file has every row and column.

    --backbone gives rows of amplitude (of the first harmonic, in the unit of the samples; the turning point with
    --half-cycles) with amplitude_standard_deviation, omega_rad_s, frequency_hz, omega_standard_deviation_rad_s,
    growth_rate_per_s (a'/a, negative in a decay) with growth_rate_standard_deviation_per_s,
    growth_rate_low_95_per_s and growth_rate_high_95_per_s, and damping_ratio, -a'/(a omega), with
    damping_ratio_standard_deviation instead: means over bins of amplitude, with everything that is known of their
    error. A note gives the damping ratio, Q = 1 / (2 zeta) and the logarithmic decrement 2 pi zeta at both ends.
    These are the columns in CSV too; with several signals run, channel and stretch come first, and component with
    --components N; combined backbones follow as the run "combined", with runs (how many reach there) and the scatter
    between them, omega_between_runs_rad_s and growth_rate_between_runs_per_s. JSON has the rows under "backbone",
    beside "method", "settings", "recording" (gaps, clipping, interpolation, drift), "notes", "offset" and
    "amplitude_definition", and without --backbone also "track"; several signals are "signals", and "combined" follows.

    Several FILEs, or the values of --run-column, are runs.  A signal is cut where values or times are missing, and
    each stretch taken by itself; uneven times, clipped samples and drift are named, and treated as the options say.

    \b
    ridgeback estimate run.csv --column u --method pseudo-wigner
    ridgeback estimate decay.csv --column displacement --backbone --format csv -o backbone.csv
    ridgeback estimate decay.mat --column u --plot decay.svg
    ridgeback estimate run1.csv run2.csv run3.csv --column u --backbone --plot runs.pdf
    ridgeback estimate rig.h5 --column all --fill 0.1 --format json
    ridgeback estimate take.wav --half-cycles
    ridgeback estimate run.csv --column u --method model-fit --system pendulum --free k,mu
    ridgeback estimate --monte-carlo 100 --snr 0,10,20,30
    """
    check_fit(harmonic, estimator, half_cycles=half_cycles, backbone=backbone_wanted)
    if half_cycles:
        refuse_unused("--half-cycles, which follow no plane,", "planes")
    if not backbone_wanted and style != "json" and plot is None:
        refuse_unused("the table of a track", "combine")
    if files or monte_carlo is None:
        model.check(estimator.method)
    if monte_carlo is not None:
        unused = ("backbone_wanted", "half_cycles", "harmonic", "plot", "planes", "combine", "run_column")
        refuse_unused("--monte-carlo, which is about the track of the fundamental,", *unused)
        if len(files) > 1:
            raise click.UsageError(f"--monte-carlo takes one FILE, not {len(files)}; leave the others out")
        refuse_beside(estimator, "--monte-carlo", "method", "band", "lag_seconds", "remove_bias")
        trials, file = trials_and_file(monte_carlo, files[0] if files else None)
        if file is None:
            refuse_unused("--monte-carlo without a FILE", *OF_A_FILE)
        monte_carlo_verb(
            None if file is None else reading.one(file),
            trials=trials,
            method=estimator.method,
            snr_db=snr,
            seed=seed,
            band=estimator.band,
            lag=estimator.lag,
            model=model,
            remove_bias=estimator.remove_bias,
            workers=workers or 1,
            style=style,
            output=output,
        )
        return
    refuse_unused("an estimate without --monte-carlo", "workers", "snr", "seed")
    if not files:
        raise click.UsageError("name the FILE of a recording; only --monte-carlo goes without one")
    estimator = replace(estimator, model=model)
    if estimator.method == MODEL_FIT:
        refuse_beside(estimator, "--method model-fit", "method", "band", "family")
    estimator.check()
    found = measured_files(files, reading, estimator, combine=combine, harmonic=harmonic, halves=half_cycles)
    if backbone_wanted:
        check_backbones(found)
    if plot is not None:
        from ridgeback.reports.figures.recordings.measurement import plot_file

        with step("figure"):
            picture = plot_file(found, plot.rpartition(".")[2].lower())
        write_bytes(plot, picture)
    if planes is not None:
        with step("time-frequency plane"):
            drawn = plane_file(found, planes.rpartition(".")[2].lower())
        write_bytes(planes, drawn)
    with step("table"):
        text = measurements_text(found, style, backbone=backbone_wanted, every=every or output != STDOUT)
    write_text(output, text)
    if style == "csv":
        tell(found)
    refuse_empty(found, backbone=backbone_wanted)


def plane_file(found: Measurements, kind: str) -> bytes:
    """The plane of the one signal that was measured, as ``npz`` or ``png``."""
    from ridgeback.common.errors import InputError
    from ridgeback.compare.recording.planes import npz_of, plane_of

    labels = list(dict.fromkeys(one.recording.label for one in found.measured))
    if len(labels) > 1:
        raise InputError(f"--planes writes the plane of one signal, not of {len(labels)}; name one --column or --span")
    one = found.measured[0]
    plane = plane_of(one)
    assert one.track is not None  # noqa: S101 - ``plane_of`` has seen to it
    if kind == "npz":
        return npz_of(plane, one.track)
    from ridgeback.reports.plane_file import plane_png

    return plane_png(plane, one.track, f"{labels[0]}: {plane.name}")


def refuse_beside(estimator: Estimator, option: str, *names: str) -> None:
    """Refuse settings of the estimator that an option would leave unused."""
    unused = estimator.given_besides(*names)
    if unused:
        raise click.UsageError(f"{option} has no use for {', '.join(unused)}; leave out")


def check_fit(harmonic: int, estimator: Estimator, *, half_cycles: bool, backbone: bool) -> None:
    """Refuse what does not go together."""
    if half_cycles:
        refuse_beside(estimator, "--half-cycles", "band")
    if backbone and harmonic != 1:
        raise click.UsageError(
            f"--backbone is that of the fundamental, not of harmonic {harmonic}; leave one of them out"
        )
    if half_cycles and harmonic != 1:
        raise click.UsageError(f"--half-cycles are those of the signal, not of harmonic {harmonic}; leave one out")


def measured_files(
    files: tuple[str, ...], reading: Reading, estimator: Estimator, *, combine: str, harmonic: int, halves: bool
) -> Measurements:
    """Every signal of the files, measured."""
    from ridgeback.compare.recording.measurements import measure_recordings

    with step(f"reading {files[0]}" if len(files) == 1 else f"reading {len(files)} files") as progress:
        return measure_recordings(
            reading.all(files),
            combine_over=combine,
            harmonic=harmonic,
            halves=halves,
            progress=progress,
            **estimator.given(),
        )


def check_backbones(found: Measurements) -> None:
    """Refuse when there is no backbone at all, for the reason that the first signal gives."""
    from ridgeback.common.errors import InputError

    if all(one.backbone is None for one in found.measured):
        first = found.measured[0]
        raise InputError(f"{first.recording.label}: no backbone, {first.unmeasured}")


def tell(found: Measurements) -> None:
    """Say on standard error what a table of numbers has no room for."""
    for one in found.measured:
        for note in asides(one):
            say(f"{one.recording.label}: {note}")
    for note in found.notes:
        say(note)


def refuse_empty(found: Measurements, *, backbone: bool) -> None:
    """Raise PartialError where a signal gave nothing, or nothing that its estimator can bound the error of."""
    reasons = [f"{one.recording.label}: {said.rstrip('.')}" for one in found.measured for said in misfit(one)]
    reasons += [
        f"{one.recording.label}: {one.noise}; give a longer recording or a --band"
        if one.noise
        else f"{one.recording.label}: {one.method} found no sample whose error it can bound; give a longer recording "
        "or a shorter --lag"
        for one in found.measured
        if not one.usable
    ]
    missing = [*found.failed, *(without_backbone(found) if backbone else ())]
    if missing:
        reasons.append(f"the rest is written, but gave no result: {'; '.join(missing)}")
    if reasons:
        raise PartialError("; ".join(reasons))


def without_backbone(found: Measurements) -> Iterator[str]:
    """Every signal of which no stretch gave a backbone, with the reason."""
    from ridgeback.compare.recording.measurements import signal_of

    given = {signal_of(one.recording) for one in found.measured if one.backbone is not None}
    for one in found.measured:
        if signal_of(one.recording) not in given:
            yield f"{one.recording.label}: no backbone, {one.unmeasured}"
