"""Several signals in one figure each: their backbones with what they have in common, the samples, the frequencies."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ridgeback.common.quantities import unit_text
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.tracking.track import NORMAL_95
from ridgeback.reports.drawing.apart import apart
from ridgeback.reports.drawing.figure import FINE, NARROW, WIDE, Figure, Series, readout, switched, switches
from ridgeback.reports.drawing.marks import area, drawing, line, text
from ridgeback.reports.drawing.panel import Panel
from ridgeback.reports.drawing.scale import Scale, padded
from ridgeback.reports.figures.answer import STYLES
from ridgeback.reports.figures.clock import Clock
from ridgeback.reports.figures.recording import amplitudes
from ridgeback.reports.figures.recordings.slow_records import clock_at

if TYPE_CHECKING:
    from ridgeback.compare.report.several.runs import Runs

MOST = 9
"""Signals that are drawn."""
MOST_POINTS = 3000


@dataclass(frozen=True)
class Curve:
    """A curve with the ends of its 95 % interval."""

    name: str
    x: Array
    y: Array
    low: Array
    high: Array
    style: str


def backbones(runs: Runs, what: str, factor: float) -> list[Curve]:
    """Each signal's curve against amplitude, what they have in common, and the theory's."""
    curves = []
    for common in runs.found.combined:
        y, sd = (factor * getattr(common.curve, f"{what}{end}") for end in ("", "_sd"))
        name = "combined" if len(runs.found.combined) == 1 else f"combined, {common.channel}"
        curves.append(Curve(name, common.curve.amplitude, y, y - NORMAL_95 * sd, y + NORMAL_95 * sd, "rf nf"))
    for label, one, style in zip(runs.labels, runs.found.measured, STYLES, strict=False):
        if one.backbone is not None:
            y, sd = (factor * getattr(one.backbone, f"curve_{what}{end}") for end in ("", "_sd"))
            x = one.backbone.curve_amplitude
            curves.append(Curve(label, x, y, y - NORMAL_95 * sd, y + NORMAL_95 * sd, style))
    if what == "omega" and runs.theory is not None:
        y = factor * runs.theory.omega
        curves.append(Curve(f"{runs.theory.title}, exact", runs.theory.amplitude, y, y, y, "rf2 nf"))
    return curves


def runs_backbone(runs: Runs) -> Figure:
    """Frequency and growth rate against amplitude, all signals over one another."""
    unit, clock = unit_text(runs.unit), _clock(runs)
    titles = (clock.title(), clock.growth_title)
    groups = (
        backbones(runs, "omega", clock.seconds * clock.factor),
        backbones(runs, "growth_rate", clock.seconds),
    )
    label = "Backbone and growth rate of every signal against amplitude"
    names = groups[0]
    wide = [_panel(group, i, narrow=False) for i, group in enumerate(groups)]
    narrow = [_panel(group, i, narrow=True) for i, group in enumerate(groups)]
    x_title = f"amplitude of the fundamental{f', {unit}' if unit else ''}"
    marks = {
        "wide": [m for g, p, t in zip(groups, wide, titles, strict=True) for m in _drawn(g, p, t, x_title)],
        "narrow": [m for g, p, t in zip(groups, narrow, titles, strict=True) for m in _drawn(g, p, t, x_title)],
    }
    marks["wide"] += _key(names, 64.0, 372.0, 3)
    marks["narrow"] += _key(names, 4.0, 604.0, 1)
    rows = -(-len(names) // 3)
    series = [Series(curve.name, curve.x, curve.y, clock.unit) for curve in groups[0]]
    return Figure(
        key="runs-backbone",
        wide=drawing(WIDE, 376 + 18 * rows, "wide", label, marks["wide"]),
        narrow=drawing(NARROW, 608 + 17 * len(names), "narrow", label, marks["narrow"]),
        caption="Frequency and growth rate against the amplitude of the fundamental, bands 95 %."
        + (" Thick: combined, weighted by precision and by the scatter between runs." if runs.found.combined else ""),
        toggles=switches([curve.name for curve in names]),
        data=readout((wide, narrow), series, name="amplitude", unit=unit, link="amplitude"),
        label=label,
    )


def _panel(curves: Sequence[Curve], i: int, *, narrow: bool) -> Panel:
    left, right = (66.0, 360.0) if narrow else (500.0 * i + 64.0, 500.0 * (i + 1) - 16.0)
    top = 300.0 * i + 34.0 if narrow else 34.0
    tops = [c.y for c in curves]
    for c in curves:
        width = np.abs(c.high - c.low)
        near = np.isfinite(width) & (width <= 6.0 * np.nanmedian(width))
        tops += [c.low[near], c.high[near]]
    y = Scale(*padded(tops, share=0.06), top + (196.0 if narrow else 280.0), top)
    return Panel(Scale(*amplitudes(np.concatenate([c.x for c in curves])), left, right), y)


def _drawn(curves: Sequence[Curve], panel: Panel, title: str, x_title: str) -> list[str]:
    marks = [panel.rows(most=5), panel.columns(most=5, unit=x_title), text(panel.left - 56, panel.top - 16, title, "m")]
    for i, curve in enumerate(curves):
        x, band = panel.x.of(curve.x), ""
        if not curve.style.startswith("rf2"):
            kind = "band" if curve.style.startswith("rf") else f"{curve.style[0]}f"
            band = area(x, panel.y.clipped(curve.low), panel.y.clipped(curve.high), kind)
        inside = np.where((curve.y >= panel.y.low) & (curve.y <= panel.y.high), curve.y, np.nan)
        marks.append(switched(i, band, panel.curve(curve.x, inside, curve.style)))
    return marks


def _key(curves: Sequence[Curve], left: float, top: float, columns: int) -> list[str]:
    marks = []
    for i, curve in enumerate(curves):
        x, y = left + 310.0 * (i % columns), top + (18.0 if columns > 1 else 17.0) * (i // columns)
        marks.append(line(x, y, x + 22, y, curve.style) + text(x + 28, y + 4, curve.name, "sm"))
    return marks


def runs_samples(runs: Runs) -> Figure:
    """The samples of each signal with its amplitude, one panel below the other on a common time."""
    shown, clock = list(zip(runs.labels, runs.found.measured, STYLES, strict=False))[:MOST], _clock(runs)
    span = _span([one.recording.time / clock.seconds for _, one, _ in shown])
    label = "Samples of every signal over time with their amplitude"
    groups = tuple(
        tuple(
            Panel(
                Scale(*span, *((52.0, 360.0) if narrow else (64.0, 990.0))),
                Scale(*padded([one.recording.values], share=0.06), 118.0 + 124.0 * i, 28.0 + 124.0 * i),
            )
            for i, (_, one, _) in enumerate(shown)
        )
        for narrow in (False, True)
    )

    def marks(panels: Sequence[Panel], narrow: bool) -> list[str]:
        parts = []
        for panel, (name, one, style) in zip(panels, shown, strict=True):
            recording = one.recording
            unit = f", {recording.units}" if recording.units else ""
            step = max(1, recording.time.size // MOST_POINTS)
            parts += [panel.rows(most=3), text(0, panel.top - 10, f"{name}{unit}", "m")]
            time = recording.time[::step] / clock.seconds
            curves = [panel.curve(time, recording.values[::step], "ul nf")]
            if one.backbone is not None:
                curve = one.backbone
                curves.append(
                    panel.curve(curve.time / clock.seconds, curve.offset + curve.amplitude, style.replace(" d", " x"))
                )
            parts.append(panel.zooming(curves))
        return [*parts, panels[-1].columns(most=4 if narrow else 8, unit=clock.time_title)]

    series = [
        Series(name, one.recording.time / clock.seconds, one.recording.values, one.recording.units)
        for name, one, _ in shown
    ]
    height = 124.0 * len(shown) + 46.0
    return Figure(
        key="runs-samples",
        wide=drawing(WIDE, height, "wide", label, marks(groups[0], False)),
        narrow=drawing(NARROW, height, "narrow", label, marks(groups[1], True)),
        caption="Samples, and the amplitude of the fundamental on them." + _cut(runs),
        data=readout((groups[0], groups[1]), series, name="t", unit=clock.time_unit, link="time", places=FINE),
        label=label,
    )


def _clock(runs: Runs) -> Clock:
    """The clock of the first signal that has a backbone, in which all are shown."""
    own = next((one.backbone.curve_omega for one in runs.found.measured if one.backbone is not None), np.array([]))
    return clock_at(own)


def _cut(runs: Runs) -> str:
    count = len(runs.found.measured)
    return f" The first {MOST} of {count} signals." if count > MOST else ""


def _span(times: Sequence[Array]) -> tuple[float, float]:
    return min(float(t[0]) for t in times), max(float(t[-1]) for t in times)


def runs_tracks(runs: Runs) -> Figure:
    """Frequency over time of every signal with its 95 % interval, named at the right edge."""
    clock = _clock(runs)
    f = clock.seconds * clock.factor
    curves = []
    for label, one, style in list(zip(runs.labels, runs.found.measured, STYLES, strict=False))[:MOST]:
        along = one.frequency()
        time = along.time / clock.seconds
        curves.append(Curve(label, time, along.omega * f, along.low * f, along.high * f, style))
    label = "Fundamental frequency of every signal over time"
    values = [np.quantile(c.y[np.isfinite(c.y)], [0.005, 0.995]) for c in curves if np.isfinite(c.y).any()]
    y = Scale(*padded(values, share=0.1), 260.0, 28.0)
    span = _span([c.x for c in curves])
    wide, narrow = Panel(Scale(*span, 64.0, 760.0), y), Panel(Scale(*span, 52.0, 360.0), y)
    series = [Series(c.name, c.x, c.y, clock.unit) for c in curves]

    def marks(panel: Panel, narrow_: bool) -> list[str]:
        parts = [panel.rows(most=5), panel.columns(most=4 if narrow_ else 8, unit=clock.time_title)]
        parts.append(text(0, 11, clock.title(), "m"))
        bands = [
            switched(i, area(panel.x.of(c.x), y.clipped(c.low), y.clipped(c.high), f"{c.style[0]}f"))
            for i, c in enumerate(curves)
        ]
        inside = [np.where((c.y >= y.low) & (c.y <= y.high), c.y, np.nan) for c in curves]
        pairs = enumerate(zip(curves, inside, strict=True))
        drawn = [switched(i, panel.curve(c.x, values, c.style)) for i, (c, values) in pairs]
        return [*parts, panel.zooming([*bands, *drawn])]

    ends = [float(wide.y.clipped(c.y[np.isfinite(c.y)][-1:])[0]) if np.isfinite(c.y).any() else 260.0 for c in curves]
    heights = apart(ends, 17.0, 28.0, 260.0)
    beside = [
        line(wide.right + 8, h, wide.right + 28, h, c.style) + text(wide.right + 34, h + 4, c.name, "sm")
        for c, h in zip(curves, heights, strict=True)
    ]
    return Figure(
        key="runs-tracks",
        wide=drawing(WIDE, 304, "wide", label, [*marks(wide, False), *beside]),
        narrow=drawing(
            NARROW, 312 + 17 * len(curves), "narrow", label, [*marks(narrow, True), *_key(curves, 4.0, 316.0, 1)]
        ),
        caption="Frequency of the fundamental where it is valid, bands 95 %." + _cut(runs),
        toggles=switches([c.name for c in curves]),
        data=readout(((wide,), (narrow,)), series, name="t", unit=clock.time_unit, link="time"),
        label=label,
    )
