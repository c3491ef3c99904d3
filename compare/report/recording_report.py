"""Assemble the report on a recording: its tracks, what made it, and its estimators in noise."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from ridgeback.common.progress import Progress, silent
from ridgeback.compare.identification.results import Identification
from ridgeback.compare.recording.recording import compare_recording
from ridgeback.compare.recording.results import RecordingComparison
from ridgeback.compare.report import csv_tables as tables
from ridgeback.compare.report.identification_part import identified
from ridgeback.compare.report.noise_part import TRIALS, noise_of_recording
from ridgeback.compare.report.provenance import provenance
from ridgeback.compare.report.recording_summary import recording_cards, recording_sentences, recording_title
from ridgeback.compare.report.results import Report
from ridgeback.compare.report.stages import Stages
from ridgeback.compare.study.results import Range
from ridgeback.numeric.recording.recording import Recording, read_recording
from ridgeback.symbolic.systems.door import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.oscillator import Oscillator


def assemble_recording(
    source: str | Path | Recording,
    *,
    column: str | int | None = None,
    time_column: str | int | None = None,
    rate: float | None = None,
    oscillator: OscillatorLike | None = None,
    cycles: float | None = None,
    trials: int = TRIALS,
    command: str = "",
    progress: Progress = silent,
) -> Report:
    """Estimate frequency, backbone and damping of a recording, say what was found, and which oscillator made it.

    ``cycles`` is how many of the first cycles foretell the rest (default: a third of them); ``trials`` is the number
    of noisy records a point of the noise study (0: none).  A study that the recording does not allow is left out, and
    the page says why.  Raises InputError for a file that holds no usable signal, OSError when it cannot be read.
    """
    stages = Stages(progress)
    oscillator = None if oscillator is None else as_oscillator(oscillator)
    if isinstance(source, Recording):
        recording = source
    else:
        recording = read_recording(source, column=column, time_column=time_column, rate=rate)
    with stages.stage("recording", 0.0, 0.3) as inner:
        found = compare_recording(recording, oscillator=oscillator, progress=inner)
    with stages.stage("what made it", 0.3, 0.7) as inner:
        made, why = identified(recording, found, cycles, inner)
    with stages.stage("estimators in noise", 0.7, 1.0) as inner:
        noisy, why_not = noise_of_recording(recording, trials, inner) if trials else (None, "")
    progress(1.0, "done")
    left_out = tuple(reason for reason in (why, why_not) if reason)
    report = _recording_report(found, oscillator, {"cycles": cycles, "trials": trials}, command, stages.seconds)
    return replace(report, identification=made, noise=noisy, summary=(*_verdict(made), *report.summary, *left_out))


def _verdict(made: Identification | None) -> tuple[str, ...]:
    return () if made is None else (f"What made it: {made.verdict}",)


def _recording_report(
    found: RecordingComparison,
    oscillator: Oscillator | None,
    chosen: Mapping[str, object],
    command: str,
    seconds: Mapping[str, float],
) -> Report:
    settings = {
        "source": found.source,
        "column": found.column,
        "rate": found.rate,
        "method": found.chosen,
        "theory": "" if oscillator is None else oscillator.equation,
        **{name: value for name, value in chosen.items() if value is not None},
    }
    nothing: tuple[Range, ...] = ()
    return Report(
        title=recording_title(found),
        lead=f"{found.source}, {found.column}: {found.time.size} samples shown, {found.rate:g} per second.",
        summary=recording_sentences(found),
        cards=recording_cards(found),
        derivation=None,
        study=None,
        ranges=nothing,
        decay=None,
        recording=found,
        timings=(),
        provenance=provenance(settings, command=command, input_hash=found.sha256, seconds=seconds),
        csv={"backbone.csv": tables.backbone_table(found), "tracks.csv": tables.curves_table(found.curves)},
    )
