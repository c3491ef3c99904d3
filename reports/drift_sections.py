"""The sections of a motion whose parameters drift: frequency, its error, the motion with its amplitude, the plane."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.compare.report.results import Report
from ridgeback.reports.drawing.figure import Figure
from ridgeback.reports.figures.answer import answer_figure
from ridgeback.reports.figures.clock import Clock
from ridgeback.reports.figures.planes import level_plane
from ridgeback.reports.parts import Part, Section

if TYPE_CHECKING:
    from ridgeback.compare.drift.results import DriftComparison


def drift_head(report: Report) -> tuple[Part, ...]:
    """omega0 over time: by the action, between crossings, and without the drift."""
    found = report.drift
    if found is None:
        return ()
    time = found.trajectory.time
    strokes = (
        Stroke(time, found.adiabatic.omega, "conserved action"),
        Stroke(time, found.reference.omega, "cycle frequency"),
        Stroke(time, found.frozen, "parameters of t = 0"),
    )
    caption = (
        "ω₀ in rad per time unit. The cycle frequency is read between the located crossings of the motion that is "
        "integrated with p(t) in the equation; the action needs no integration."
    )
    return _drawn("frequency", Picture("", "t", "ω₀", strokes), caption)


def drift_sections(report: Report) -> Iterator[Section]:
    """Sections of a page on a drift; none of another page."""
    found = report.drift
    if found is None:
        return
    yield Section("error", "Error", "Error of ω₀ by the action, and the one that is expected", _error(found))
    yield Section("motion", "Motion, plane", "The motion, its amplitude, and where its frequency shows", _motion(found))


def _drawn(key: str, picture: Picture, caption: str) -> tuple[Part, ...]:
    figure = answer_figure(key, picture, caption)
    return () if figure is None else (Part("figure", figure),)


def _error(found: DriftComparison) -> tuple[Part, ...]:
    time = found.trajectory.time
    strokes = (
        Stroke(time, np.abs(found.adiabatic.expected_error), "expected"),
        Stroke(time, np.abs(found.error), "measured"),
        Stroke(time, np.abs(found.frozen / found.reference.omega - 1), "parameters of t = 0"),
    )
    picture = Picture("", "t", "relative error of ω₀", strokes, None, True)
    caption = (
        "Sizes, over decades. Expected: |ω₀''/(4 ω₀³) − 3 ω₀'²/(8 ω₀⁴) + (μ² + μ')/(2 ω₀²)|, μ = −(ln J)'/2. Near its "
        "ends the cycle frequency is continued beyond its last crossings and less sure."
    )
    return _drawn("drift-error", picture, caption)


def _motion(found: DriftComparison) -> tuple[Part, ...]:
    run, symbol = found.trajectory, found.case.symbol
    strokes = (Stroke(run.time, run.u, symbol), Stroke(run.time, found.adiabatic.peak, "amplitude by the action"))
    parts = _drawn(
        "drift-motion", Picture("", "t", symbol, strokes), "The peak of the orbit with the conserved action."
    )
    image, span = found.spectrogram, (float(run.time[0]), float(run.time[-1]))
    plane = level_plane("spectrogram", image, Clock(found.case.time_unit), span, image.overlays[0], (1, 2, 3))
    figure = Figure(
        key="plane",
        wide=plane,
        narrow="",
        caption=f"{image.note.split('.  ')[0]}; lines are multiples of ω₀ by the action.",
        many="two",
        label=image.name,
    )
    return (*parts, Part("figure", figure))
