"""Assemble the report on a recording: its tracks, what made it, and its estimators in noise."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ridgeback.common.progress import Progress, silent
from ridgeback.compare.identification.preparation import part_of
from ridgeback.compare.noise.monte_carlo import truth_of
from ridgeback.compare.recording.recording import compare_recording
from ridgeback.compare.recording.results import RecordingComparison
from ridgeback.compare.report import csv_tables as tables
from ridgeback.compare.report.identification_part import identification_part
from ridgeback.compare.report.noise_part import TRIALS, NoisePart, noise_part
from ridgeback.compare.report.provenance import provenance
from ridgeback.compare.report.recording_summary import (
    recording_cards,
    recording_lead,
    recording_sentences,
    recording_title,
)
from ridgeback.compare.report.results import Report
from ridgeback.compare.report.stages import Stopwatch
from ridgeback.numeric.recording.reading import read_recording
from ridgeback.numeric.recording.recording import Recording
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.oscillator import Oscillator

MOST_SAMPLES = 2000
"""Of a recording, whose smooth model the estimators are tried on in noise: a longer one tells no more of them."""
NO_NOISE_IN_A_BAND = "No noise study: with --band no estimators are tried in noise; leave it out for one."


def recording_report(
    source: str | Path | Recording,
    *,
    column: str | int | None = None,
    time_column: str | int | None = None,
    rate: float | None = None,
    band: tuple[float, float] | None = None,
    oscillator: OscillatorLike | None = None,
    cycles: float | None = None,
    trials: int = TRIALS,
    timed: bool = True,
    command: str = "",
    progress: Progress = silent,
) -> Report:
    """Estimate frequency, backbone and growth rate of a recording, and say which oscillator made it.

    Parameters
    ----------
    source
        A file (CSV, NPZ, WAV, MAT, HDF5), or a recording already read.
    column, time_column
        Names or numbers of the columns that hold the samples and their times; found by default.
    rate
        Samples per second, in place of a time column.
    band
        Lowest and highest frequency of the oscillation, rad per time unit; by default about the strongest component.
        Estimators in noise are tried on the strongest component alone, and not in a band.
    oscillator
        Its exact backbone is drawn over the measured one.
    cycles
        How many of the first cycles predict the rest; by default a third of them.
    trials
        Noisy records a point of the noise study; 0 for none.
    timed
        Whether measured times are kept; without them the same inputs give the same report.
    command
        The command line that makes the same report, for its provenance.
    progress
        Called with the share of the work that is done, 0 to 1, and the name of the step.

    Returns
    -------
    Report
        Complete; a study that the recording does not allow is left out, and the summary says why.

    Raises
    ------
    InputError
        For a file that holds no usable signal.
    OSError
        For a file that cannot be read.
    """
    watch = Stopwatch(progress)
    theory = None if oscillator is None else as_oscillator(oscillator)
    recording = _read(source, column=column, time_column=time_column, rate=rate)
    with watch.stage("recording", 0.0, 0.3) as inner:
        found = compare_recording(recording, band=band, oscillator=theory, progress=inner)
    with watch.stage("what made it", 0.3, 0.7) as inner:
        made = identification_part(recording, found, cycles, inner, band=band)
    with watch.stage("estimators in noise", 0.7, 1.0) as inner:
        noise = (
            NoisePart(None, NO_NOISE_IN_A_BAND)
            if band is not None and trials
            else noise_part(lambda: truth_of(part_of(recording, slice(MOST_SAMPLES))), trials, inner)
        )
    progress(1.0, "done")
    left_out = tuple(reason for reason in (made.left_out, noise.left_out) if reason)
    settings = _settings(found, theory, {"cycles": cycles, "trials": trials, "band": band})
    return Report(
        title=recording_title(found),
        lead=recording_lead(found),
        summary=(*recording_sentences(found, made.found), *left_out),
        cards=recording_cards(found),
        derivation=None,
        study=None,
        ranges=(),
        decay=None,
        recording=found,
        provenance=provenance(
            settings, command=command, input_hash=found.sha256, seconds=watch.seconds() if timed else None
        ),
        noise=noise.study,
        identification=made.found,
        timed=timed,
        csv={"backbone.csv": tables.backbone_table(found), "tracks.csv": tables.curves_table(found.curves)},
    )


def _read(
    source: str | Path | Recording,
    *,
    column: str | int | None,
    time_column: str | int | None,
    rate: float | None,
) -> Recording:
    if isinstance(source, Recording):
        return source
    return read_recording(source, column=column, time_column=time_column, rate=rate)


def _settings(found: RecordingComparison, theory: Oscillator | None, chosen: Mapping[str, object]) -> dict[str, object]:
    """Everything that determines the result, for the settings hash."""
    return {
        "source": found.source,
        "column": found.column,
        "rate": found.rate,
        "method": found.chosen,
        "theory": "" if theory is None else theory.equation,
        **{name: value for name, value in chosen.items() if value is not None},
    }
