"""The sections of a recording: backbone, what made it, its forecast, the record and its plane."""

from __future__ import annotations

from ridgeback.common.numbers import per_cent
from ridgeback.compare.report.results import Report
from ridgeback.compare.study.results import Trend, trend_of
from ridgeback.reports.figures.clock import SECONDS, Clock
from ridgeback.reports.figures.recording import backbone_figure, plane_figure, signal_figure, tracks_figure
from ridgeback.reports.figures.recordings.identification import (
    candidates_figure,
    forecast_figure,
    parameter_table,
    ranking_table,
)
from ridgeback.reports.figures.recordings.sample_fit import fit_figure, spectrum_figure
from ridgeback.reports.figures.recordings.slow_records import clock_of, identification_in, recording_in
from ridgeback.reports.parts import Part, Section, fold, set_formula
from ridgeback.reports.text.bibtex import bibtex
from ridgeback.reports.text.equation import class_mathml

EQUATIONS = 4
"""Classes whose equation is set."""


def recording_head(report: Report) -> tuple[Part, ...]:
    """The measured backbone, below the cards."""
    found = report.recording
    if found is None or not found.backbone_amplitude.size:
        return ()
    clock = clock_of(found)
    return (Part("figure", backbone_figure(recording_in(found, clock), clock)),)


def recording_sections(report: Report) -> tuple[Section, ...]:
    """Sections of a report on a recording; none of another report."""
    clock = SECONDS if report.recording is None else clock_of(report.recording)
    found = (
        _made(report, clock),
        _fit(report, clock),
        _forecast(report, clock),
        _record(report, clock),
        _tracks(report, clock),
        _backbone(report),
    )
    return tuple(section for section in found if section is not None)


def _backbone(report: Report) -> Section | None:
    found = report.recording
    if found is None:
        return None
    parts = [Part("formula", set_formula(found.fit, bibtex(report.provenance, report.title)))] if found.fit else []
    if found.notes:
        parts.append(fold("Notes on the measurement", Part("lines", found.notes)))
    return Section("recording", "Formula", "The measured backbone as a formula", tuple(parts)) if parts else None


def _made(report: Report, clock: Clock) -> Section | None:
    found = report.identification
    if found is None:
        return None
    classes = [
        Part("figure", candidates_figure(identification_in(found, clock), clock)),
        Part("equations", [(c.title, class_mathml(c.equation), c.equation) for c in found.candidates[:EQUATIONS]]),
        Part("table", parameter_table(found.best)),
        fold("All classes, ranked", Part("table", ranking_table(found))),
    ]
    parts = [Part("text", found.verdict), *(() if found.hum else classes)]
    if found.notes:
        parts.append(fold("Notes on the ranking", Part("lines", found.notes)))
    return Section("identification", "What made it", found.title, tuple(parts))


def _fit(report: Report, clock: Clock) -> Section | None:
    made = report.identification
    if made is None or made.fitted is None or made.hum:
        return None
    best = made.best
    share, named = per_cent(made.unexplained), f"The nearest, {best.title}," if made.unclaimed else best.title
    parts = (
        Part("figure", fit_figure(made.fitted, best.title, made.unit, clock)),
        Part("figure", spectrum_figure(made.fitted, clock)),
    )
    return Section("fit", "Samples and fit", f"{named} leaves {share} of the signal’s rms", parts)


def _forecast(report: Report, clock: Clock) -> Section | None:
    found = report.identification
    if found is None or found.prediction is None:
        return None
    title = f"The forecast of the later cycles {found.prediction.outcome.verb}"
    shown = identification_in(found, clock)
    figure = () if shown.prediction is None else (Part("figure", forecast_figure(shown.prediction, shown, clock)),)
    return Section("forecast", "Forecast", title, figure)


def _record(report: Report, clock: Clock) -> Section | None:
    found = report.recording
    if found is None:
        return None
    found = recording_in(found, clock)
    parts = (Part("figure", signal_figure(found, clock)), Part("figure", plane_figure(found, clock)))
    return Section("record", "The record", "The record and its time-frequency plane", parts)


def _tracks(report: Report, clock: Clock) -> Section | None:
    found = report.recording
    if found is None:
        return None
    return Section(
        "tracks",
        "Frequency in time",
        _tracks_title(report),
        (Part("figure", tracks_figure(recording_in(found, clock), clock)),),
    )


def _tracks_title(report: Report) -> str:
    found = report.recording
    if found is None:
        return ""
    if found.doubt or not found.backbone_omega.size:
        return "Frequency in time by every estimator"
    way = trend_of(found.backbone_omega, found.backbone_omega_sd)
    return "Frequency in time by every estimator" + (", no change beyond noise" if way is Trend.CONSTANT else "")
