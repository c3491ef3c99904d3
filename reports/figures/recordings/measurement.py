"""One picture of what was measured: signal and amplitude, frequency over time, backbone and growth rate, with bands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from textwrap import wrap

import numpy as np
from matplotlib.axes import Axes

from ridgeback.common.visible import visible
from ridgeback.compare.recording.measurement import Measurement
from ridgeback.compare.recording.measurements import Measurements
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.tracking.track import NORMAL_95
from ridgeback.reports.drawing.canvas import LINE, Canvas, Line, draw, heading, linear, padded, titles
from ridgeback.reports.drawing.labels import place
from ridgeback.reports.drawing.picture import picture
from ridgeback.reports.drawing.theme import SERIES, Variant, colour_of
from ridgeback.reports.figures.clock import Clock
from ridgeback.reports.figures.recording import amplitudes
from ridgeback.reports.figures.recordings.slow_records import clock_at

PAGE = Variant("wide", 9.6, 6.4)
MOST_POINTS = 4000
"""Samples drawn of each signal: more than a picture has columns."""
LEFT, GAP = 52.0, 66.0
WIDEST = 100
"""Letters of a line over the panels."""
LONGEST_NAME = 28
"""Letters of a channel's name that fit under a panel."""


@dataclass(frozen=True)
class Band:
    """A curve, and the lower and upper end of its 95 % interval, NaN where it claims none."""

    line: Line
    low: Array
    high: Array


def band_of(line: Line, deviation: Array) -> Band:
    """A curve with its standard deviation either side, 1.96 times."""
    return Band(line, line.y - NORMAL_95 * deviation, line.y + NORMAL_95 * deviation)


def plot_file(found: Measurements, kind: str) -> bytes:
    """The picture of what was measured: signal and amplitude, frequency, backbone and growth rate.

    Parameters
    ----------
    found
        Measured signals, the first few of which are drawn.
    kind
        ``svg``, ``png`` or ``pdf``.

    Returns
    -------
    bytes
        The file; the same measurements give the same bytes.
    """
    return picture(lambda: drawn(found), kind)


def drawn(found: Measurements) -> Canvas:
    """Draw the four panels."""
    shown = found.measured[: len(SERIES)]
    said = unclaimed(shown)
    canvas = Canvas(PAGE, height=PAGE.height + LINE * len(said) / 72.0)
    heading(canvas, said, left=10.0)
    panels = canvas.grid((1.0, 1.0), 2, left=LEFT, gap=GAP, above=LINE * len(said))
    cut = f", {len(shown)} of {len(found.measured)} signals" if len(shown) < len(found.measured) else ""
    clock = clock_for(shown)
    signal_panel(panels[0], shown, cut, clock)
    frequency_panel(panels[1], shown, clock)
    curve_panel(panels[2], found, "omega", clock)
    curve_panel(panels[3], found, "growth_rate", clock)
    return canvas


def clock_for(shown: Sequence[Measurement]) -> Clock:
    """The clock of the first signal that has a frequency, in which all are drawn."""
    omega = (one.track.omega[np.isfinite(one.track.omega)] for one in shown if one.track is not None)
    return clock_at(next(omega, np.array([])))


def unclaimed(shown: Sequence[Measurement]) -> list[str]:
    """Why there is no interval or no backbone of the signals drawn, in lines; none where everything is claimed."""
    reasons = dict.fromkeys(
        reason for one in shown for reason in (one.track and one.track.no_interval, one.unmeasured) if reason
    )
    return [line for reason in reasons for line in wrap(f"Not claimed: {visible(reason)}.", WIDEST)]


def channels(shown: Sequence[Measurement]) -> str:
    """The channels drawn, for an axis title."""
    names = list(dict.fromkeys(m.recording.channel for m in shown))
    text = names[0] if len(names) == 1 else f"{names[0]} and others"
    return clipped(text)


def clipped(text: str) -> str:
    """A name cut to what fits.

    >>> clipped("x" * 40).count("x")
    27
    """
    text = visible(text)
    return text if len(text) <= LONGEST_NAME else text[: LONGEST_NAME - 1] + "…"


def label_of(one: Measurement, shown: Sequence[Measurement]) -> str:
    """What tells a signal from the others; nothing when it is the only one."""
    if len(shown) == 1:
        return ""
    recording = one.recording
    parts = []
    if len({m.recording.run for m in shown}) > 1:
        parts.append(recording.run)
    if len({m.recording.channel for m in shown}) > 1:
        parts.append(recording.name)
    if len({(m.recording.run, m.recording.channel) for m in shown}) < len(shown):
        parts.append(f"stretch {recording.stretch}")
    return clipped(", ".join(part for part in parts if part))


def signal_panel(axes: Axes, shown: Sequence[Measurement], more: str, clock: Clock) -> None:
    """The samples, and the amplitude of each on them."""
    lines, envelopes = [], []
    for one, token in zip(shown, SERIES, strict=False):
        recording = one.recording
        step = max(1, recording.time.size // MOST_POINTS)
        lines.append(Line(recording.time[::step] / clock.seconds, recording.values[::step], "", token, width=0.6))
        if one.backbone is not None:
            curve = one.backbone
            gap = np.diff(curve.time, prepend=curve.time[0]) > 1.5 * float(np.median(np.diff(curve.time)))
            height = np.where(gap, np.nan, curve.offset + curve.amplitude)
            label = "amplitude" if len(shown) == 1 else ""
            own = "s2" if len(shown) == 1 else "fg"
            envelopes.append(Line(curve.time / clock.seconds, height, label, own, width=1.4))
    span(axes, lines)
    linear(axes, "y", *padded([line.y for line in lines], share=0.14))
    titles(axes, x=clock.time_title, y=channels(shown) + more)
    for line in [*lines, *envelopes]:
        draw(axes, line)
    place(axes, envelopes[:1] if len(shown) == 1 else [])


def frequency_panel(axes: Axes, shown: Sequence[Measurement], clock: Clock) -> None:
    """Frequency over time where it is valid, with its band."""
    bands = [track_band(one, label_of(one, shown), token, clock) for one, token in zip(shown, SERIES, strict=False)]
    span(axes, [band.line for band in bands])
    draw_bands(axes, bands, titled=(clock.time_title, clock.title()))


def track_band(one: Measurement, label: str, token: str, clock: Clock) -> Band:
    """The frequency of one signal in display units."""
    along, factor = one.frequency(), clock.seconds * clock.factor
    line = Line(along.time / clock.seconds, along.omega * factor, label, token, width=1.3)
    return Band(line, along.low * factor, along.high * factor)


def curve_panel(axes: Axes, found: Measurements, what: str, clock: Clock) -> None:
    """Frequency or growth rate against amplitude: each signal, and what they have in common."""
    shown = found.measured[: len(SERIES)]
    factor = clock.seconds * (clock.factor if what == "omega" else 1.0)
    bands = []
    for one, token in zip(shown, SERIES, strict=False):
        if one.backbone is not None:
            curve = one.backbone
            values, deviation = getattr(curve, f"curve_{what}"), getattr(curve, f"curve_{what}_sd")
            line = Line(curve.curve_amplitude, values * factor, label_of(one, shown), token, width=1.3)
            bands.append(band_of(line, deviation * factor))
    for common in found.combined:
        mean, deviation = getattr(common.curve, what), getattr(common.curve, f"{what}_sd")
        label = "combined" if len(found.combined) == 1 else f"combined, {common.channel}"
        line = Line(common.curve.amplitude, mean * factor, label, "fg", width=2.4)
        bands.append(band_of(line, deviation * factor))
    linear(axes, "x", *amplitudes(np.concatenate([band.line.x for band in bands] or [np.array([])])), ticks=6)
    title = clock.title() if what == "omega" else clock.growth_title.removeprefix("growth rate ")
    draw_bands(axes, bands, titled=(f"amplitude of {channels(shown)}", title))


def draw_bands(axes: Axes, bands: Sequence[Band], *, titled: tuple[str, str]) -> None:
    """Curves over their bands."""
    linear(axes, "y", *padded([values for band in bands for values in (band.line.y, band.low, band.high)], share=0.12))
    claimed = any(np.isfinite(band.low).any() for band in bands)
    told = "95 % band" if claimed else "no interval" if bands else "not claimed"
    titles(axes, x=titled[0], y=f"{titled[1]}, {told}")
    if not bands:
        axes.set_xticks([])
        axes.set_yticks([])
    for band in bands:
        axes.fill_between(band.line.x, band.low, band.high, color=colour_of(band.line.token), alpha=0.18, linewidth=0.0)
        draw(axes, band.line)
    place(axes, [band.line for band in bands if np.isfinite(band.line.y).any()])


def span(axes: Axes, lines: Sequence[Line]) -> None:
    """A time axis from the first time to the last."""
    filled = [line.x for line in lines if line.x.size]
    linear(axes, "x", min(float(x[0]) for x in filled), max(float(x[-1]) for x in filled), ticks=6)
