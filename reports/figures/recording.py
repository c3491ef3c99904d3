"""The figures of a recording: backbone and growth rate with bands and theory, signal, spectrogram, tracks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ridgeback.common.numbers import number, per_cent
from ridgeback.common.quantities import unit_text
from ridgeback.compare.motion.error_norms import distance
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.tracking.track import NORMAL_95
from ridgeback.reports.drawing.apart import apart
from ridgeback.reports.drawing.figure import FINE, NARROW, WIDE, Figure, Series, readout, switched, switches
from ridgeback.reports.drawing.marks import area, drawing, group, line, places, text
from ridgeback.reports.drawing.panel import Panel
from ridgeback.reports.drawing.scale import Scale, padded
from ridgeback.reports.figures.clock import SECONDS, Clock, shown
from ridgeback.reports.figures.planes import level_plane, record_data

if TYPE_CHECKING:
    from ridgeback.compare.recording.results import RecordingComparison

LETTER, ROW, HEIGHTS = 7.0, 17.0, 5
"""Width of a letter of a key, about, height of its lines, and heights at which it may stand."""
CLOSE = 0.5
"""Share of the largest amplitude above which all of them may lie for their axis not to begin at zero."""
STYLES = ("tl nf", "tl d1 nf", "tl d2 nf", "tl d3 nf", "el nf", "sl nf")


@dataclass(frozen=True)
class Band:
    """A curve over amplitude with one standard deviation either side, and others drawn over it."""

    title: str
    x: Array
    y: Array
    sd: Array
    over: tuple[tuple[str, Array, str], ...] = ()
    """Name, values and style of each."""

    @property
    def name(self) -> str:
        """The title without its unit."""
        return self.title.partition(", ")[0]

    @property
    def unit(self) -> str:
        """The unit that the title ends with."""
        return self.title.partition(", ")[2]


def side_by_side(key: str, bands: Sequence[Band], *, x_title: str, caption: str, label: str, unit: str = "") -> Figure:
    """Two curves over the same amplitude beside each other, below each other on a phone.

    Parameters
    ----------
    key
        Id of the figure.
    bands
        What is drawn, one panel each.
    x_title, caption, label
        Words of the figure.
    unit
        Of the readout's amplitude.
    """
    wide = [_band_panel(band, i, len(bands), narrow=False) for i, band in enumerate(bands)]
    narrow = [_band_panel(band, i, len(bands), narrow=True) for i, band in enumerate(bands)]
    height = (356.0, 300.0 * len(bands) - 28.0)
    names = _named(bands[0])
    series = [Series(band.name, band.x, band.y, band.unit) for band in bands]
    series += [Series(name, band.x, y, band.unit) for band in bands for name, y, _ in band.over]
    return Figure(
        key=key,
        wide=drawing(WIDE, height[0], "wide", label, [*_bands(bands, wide, x_title), _key(bands[0], wide[0])]),
        narrow=drawing(
            NARROW,
            height[1] + ROW * len(names) + (12.0 if names else 0.0),
            "narrow",
            label,
            [*_bands(bands, narrow, x_title), *_rows(names, 4.0, height[1] + 16.0)],
        ),
        caption=caption,
        toggles=switches([name for name, _ in names]),
        data=readout((wide, narrow), series, name="amplitude", unit=unit, link="amplitude"),
        label=label,
    )


def _bands(bands: Sequence[Band], panels: Sequence[Panel], x_title: str) -> list[str]:
    """All panels."""
    return [_band(band, panel, x_title) for band, panel in zip(bands, panels, strict=True)]


def _band_panel(band: Band, i: int, count: int, *, narrow: bool) -> Panel:
    width = WIDE / count
    left, right = (66.0, 360.0) if narrow else (i * width + 64.0, (i + 1) * width - 16.0)
    top = 300.0 * i + 34.0 if narrow else 34.0
    kept = np.isfinite(band.sd) & (band.sd <= 6.0 * np.nanmedian(band.sd))
    others = [y[kept] for _, y, _ in band.over[:1] if np.isfinite(y[kept]).any()]
    half = NORMAL_95 * band.sd[kept]
    low, high = padded([band.y, band.y[kept] - half, band.y[kept] + half, *others], share=0.08)
    return Panel(Scale(*amplitudes(band.x), left, right), Scale(low, high, top + (196.0 if narrow else 280.0), top))


def amplitudes(x: Array) -> tuple[float, float]:
    """The range of an amplitude's axis: from zero, unless that left most of it empty.

    >>> amplitudes(np.array([0.2, 1.0])), amplitudes(np.array([0.9, 1.0]))
    ((0.0, 1.03), (0.895, 1.005))
    """
    if not x.size:
        return 0.0, 1.0
    low, high = float(np.nanmin(x)), float(np.nanmax(x))
    if high - low >= (1.0 - CLOSE) * high:
        return 0.0, 1.03 * high
    room = 0.05 * (high - low) if high > low else 0.05 * high
    return low - room, high + room


def _band(band: Band, panel: Panel, x_title: str) -> str:
    order = np.argsort(band.x, kind="stable")
    x, y, sd = band.x[order], band.y[order], np.nan_to_num(band.sd[order])
    marks = [
        panel.rows(most=5),
        panel.columns(most=5, unit=x_title),
        text(panel.left - 56, panel.top - 16, band.title, "m"),
    ]
    low, high = panel.y.clipped(y - NORMAL_95 * sd), panel.y.clipped(y + NORMAL_95 * sd)
    marks.append(switched(0, area(panel.x.of(x), low, high, "tf"), panel.curve(x, y, "tl nf")))
    for i, (_, values, style) in enumerate(band.over, 1):
        inside = np.where((values[order] >= panel.y.low) & (values[order] <= panel.y.high), values[order], np.nan)
        marks.append(switched(i, panel.curve(x, inside, style)))
    return "".join(marks)


def _named(band: Band) -> list[tuple[str, str]]:
    """Names and styles of a panel's curves; none where there is but one."""
    measured = "measured, 95 %" if np.nan_to_num(band.sd).any() else "measured"
    return [(measured, "tl nf"), *((name, style) for name, _, style in band.over)] if band.over else []


def _rows(names: Sequence[tuple[str, str]], x: float, top: float) -> list[str]:
    """Names below each other, each behind a piece of its line."""
    return [
        f'<path d="M{places(x)} {places(top + ROW * i - 4)}h22" class="{style}"/>'
        + text(x + 28, top + ROW * i, name, "sm")
        for i, (name, style) in enumerate(names)
    ]


def _key(band: Band, panel: Panel) -> str:
    """The names of the curves, at the side and height where the fewest points of the curves go."""
    names = _named(band)
    if not names:
        return ""
    wide = 40.0 + LETTER * max(len(name) for name, _ in names)
    places_of = [
        (left, top)
        for top in np.linspace(panel.bottom - 8 - ROW * (len(names) - 1), panel.top + 14, HEIGHTS).tolist()
        for left in (panel.left + 12, panel.right - wide)
    ]
    x, top = min(places_of, key=lambda at: crossing(band, panel, at, (wide, ROW * len(names))))
    return group(_rows(names, x, top), "halo")


def crossing(band: Band, panel: Panel, at: tuple[float, float], size: tuple[float, float]) -> int:
    """How many points of the curves, between those that are drawn too, lie in a box whose first line is at a place."""
    if not band.x.size:
        return 0
    order, (left, top) = np.argsort(band.x, kind="stable"), at
    fine = np.linspace(0.0, band.x.size - 1.0, 16 * band.x.size)
    step = np.arange(band.x.size)
    x = panel.x.of(np.interp(fine, step, band.x[order]))
    beside = (x >= left) & (x <= left + size[0])
    count = 0
    for values in (band.y, *(values for _, values, _ in band.over)):
        y = panel.y.of(np.interp(fine, step, values[order]))
        count += int(np.count_nonzero(beside & (y >= top - 14.0) & (y <= top - 14.0 + size[1])))
    return count


def backbone_figure(recording: RecordingComparison, clock: Clock = SECONDS) -> Figure:
    """Frequency and growth rate against amplitude with 95 % bands, the named oscillator's backbone over them."""
    f = clock.factor
    x = recording.backbone_amplitude
    theory = recording.over
    over = () if theory is None else ((f"{theory.title}, exact", theory.omega * f, "el d1 nf"),)
    bands = (
        Band(clock.title(), x, recording.backbone_omega * f, np.nan_to_num(recording.backbone_omega_sd * f), over),
        Band(clock.growth_title, x, recording.growth_rate, np.nan_to_num(recording.growth_rate_sd)),
    )
    caption = (
        "Fundamental frequency and growth rate a′/a, negative in a decay, against the amplitude of the fundamental. "
    )
    caption += f"{recording.doubt}." if recording.doubt else "Bands: 95 %."
    return side_by_side(
        "recording-backbone",
        bands,
        x_title=f"amplitude of the fundamental{f', {unit_text(recording.unit)}' if recording.unit else ''}",
        caption=caption,
        label="Measured backbone and growth rate",
    )


def signal_figure(recording: RecordingComparison, clock: Clock = SECONDS) -> Figure:
    """The recording itself with its amplitude."""
    label = f"{recording.column} over time with its amplitude"
    wide, narrow = (
        _time_panel(recording, [recording.signal, recording.amplitude], narrow=n, height=200.0) for n in (False, True)
    )
    series = [Series(recording.column, recording.time, recording.signal)]
    series.append(Series("amplitude", recording.amplitude_time, recording.amplitude))

    def marks(panel: Panel, narrow: bool) -> list[str]:
        parts = [
            panel.rows(most=4),
            panel.columns(most=4 if narrow else 8, unit=clock.time_title),
            text(0, 11, recording.column, "m"),
        ]
        curves = [switched(0, panel.curve(recording.time, recording.signal, "ul nf"))]
        curves.append(switched(1, panel.curve(recording.amplitude_time, recording.amplitude, "tl nf")))
        return [*parts, panel.zooming(curves)]

    return Figure(
        key="recording-signal",
        wide=drawing(WIDE, 270, "wide", label, marks(wide, False)),
        narrow=drawing(NARROW, 270, "narrow", label, marks(narrow, True)),
        caption=f"{recording.column} at {number(recording.rate)} samples per {clock.word}, with the amplitude of "
        "its fundamental.",
        toggles=switches([recording.column, "amplitude"]),
        data=readout(((wide,), (narrow,)), series, name="t", unit=clock.time_unit, link="time", places=FINE),
        label=label,
    )


def _time_panel(recording: RecordingComparison, values: Sequence[Array], *, narrow: bool, height: float) -> Panel:
    span = float(recording.time[0]), float(recording.time[-1])
    x = Scale(*span, 52.0, 360.0) if narrow else Scale(*span, 64.0, 990.0)
    return Panel(x, Scale(*padded(values, share=0.08), 24.0 + height, 24.0))


def plane_figure(recording: RecordingComparison, clock: Clock = SECONDS) -> Figure:
    """The spectrogram with the ridge that the chosen track follows."""
    image = recording.spectrogram
    chosen = next((curve for curve in recording.curves if curve.name == recording.chosen), None)
    span = float(recording.time[0]), float(recording.time[-1])
    return Figure(
        key="recording-plane",
        wide=level_plane("recording-plane-p", image, clock, span, chosen),
        narrow="",
        caption=f"{image.name}, level in decibels of its maximum, with the track. {image.note}".strip(),
        many="single",
        label=image.name,
        data=record_data(image, clock, span),
    )


def tracks_figure(recording: RecordingComparison, clock: Clock = SECONDS) -> Figure:
    """All tracks over time, the chosen one thick, named at the right edge with their distance from it."""
    f = clock.factor
    chosen = next((c for c in recording.curves if c.name == recording.chosen), recording.curves[0])
    others = [c for c in recording.curves if c is not chosen]
    drawn = [chosen, *others, *recording.theory]
    styles = dict(zip([c.name for c in drawn], ("rf nf", *STYLES), strict=False))
    label = "Fundamental frequency over time by every estimator"
    values = [np.asarray(shown(c)) * f for c in drawn]
    spread = [np.quantile(v[np.isfinite(v)], [0.01, 0.99]) for v in values if np.isfinite(v).any()]
    panels = tuple(_time_panel(recording, spread, narrow=n, height=230.0) for n in (False, True))
    wide = Panel(Scale(panels[0].x.low, panels[0].x.high, 64.0, 700.0), panels[0].y)
    series = [Series(c.label, c.time, v, clock.unit) for c, v in zip(drawn, values, strict=True)]

    def marks(panel: Panel, narrow: bool) -> list[str]:
        parts = [
            panel.rows(most=5),
            panel.columns(most=4 if narrow else 8, unit=clock.time_title),
            text(0, 11, clock.title(), "m"),
        ]
        curves = []
        for i, (c, v) in enumerate(zip(drawn, values, strict=True)):
            inside = np.where((v >= panel.y.low) & (v <= panel.y.high), v, np.nan)
            curves.append(switched(i, panel.curve(c.time, inside, styles[c.name])))
        return [*parts, panel.zooming(curves)]

    names = [
        (c.label, styles[c.name], None if c is chosen else distance(chosen, c), v)
        for c, v in zip(drawn, values, strict=True)
    ]
    beside = _names(names, wide)
    told = [(name if away is None else f"{name}, {per_cent(away)}", style) for name, style, away, _ in names]
    below = _rows(told, 4.0, 304.0)
    return Figure(
        key="recording-tracks",
        wide=drawing(WIDE, 300, "wide", label, [*marks(wide, False), *beside]),
        narrow=drawing(NARROW, 300 + ROW * len(names), "narrow", label, [*marks(panels[1], True), *below]),
        toggles=switches([c.label for c in drawn]),
        caption=f"Thick: {chosen.label}, from which the backbone is made; beside the others, their rms distance.",
        data=readout(((wide,), (panels[1],)), series, name="t", unit=clock.time_unit, link="time"),
        label=label,
    )


def _names(names: Sequence[tuple[str, str, float | None, Array]], panel: Panel) -> list[str]:
    ends = []
    for _, _, _, values in names:
        kept = values[np.isfinite(values)]
        ends.append(float(panel.y.clipped(np.array([kept[-1]]))[0]) if kept.size else panel.bottom)
    heights = apart(ends, 17.0, panel.top, panel.bottom)
    marks = []
    for (name, style, away, _), height in zip(names, heights, strict=True):
        marks.append(line(panel.right + 6, height, panel.right + 24, height, style))
        marks.append(text(panel.right + 30, height + 4, name))
        if away is not None:
            marks.append(text(WIDE, height + 4, per_cent(away), "", "end"))
    return marks
