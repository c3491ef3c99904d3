"""The figures of a recording: signal, spectrogram with its ridge, tracks, backbone and growth rate with bands."""

from __future__ import annotations

import numpy as np

from ridgeback.common.numbers import number
from ridgeback.compare.recording.results import RecordingComparison
from ridgeback.numeric.arrays import Array
from ridgeback.reports.drawing.block import Block, Readout, block
from ridgeback.reports.drawing.canvas import Canvas, Line, Trace, draw, linear, padded, titles
from ridgeback.reports.drawing.labels import place
from ridgeback.reports.drawing.theme import sentinel
from ridgeback.reports.figures.over_time import Clock, plane_block, traces_of, tracks_block

CLOCK = Clock("s")


def recording_blocks(recording: RecordingComparison) -> tuple[Block, ...]:
    """Return all figures of a recording, in reading order."""
    return (
        backbone_figure(recording),
        growth_figure(recording),
        signal_figure(recording),
        spectrogram_figure(recording),
        tracks_figure(recording),
    )


def signal_figure(recording: RecordingComparison) -> Block:
    """The recording itself with its amplitude."""
    lines = [
        Line(recording.time, recording.signal, recording.column, "s1", width=1.1),
        Line(recording.amplitude_time, recording.amplitude, "amplitude", "s2"),
    ]

    def drawing(canvas: Canvas) -> None:
        (axes,) = canvas.stack()
        linear(axes, "x", float(recording.time[0]), float(recording.time[-1]), ticks=5 if canvas.narrow else 9)
        linear(axes, "y", *padded([line.y for line in lines], share=0.14))
        titles(axes, x=CLOCK.x_title, y=recording.column)
        for line in lines:
            draw(axes, line)
        place(axes, lines[1:])

    return block(
        "recording-signal",
        title="Recording",
        description=f"{recording.column} over time with its amplitude.",
        caption=f"{recording.column}, {recording.time.size} samples at {number(recording.rate)} Hz, with the "
        "amplitude of its fundamental.",
        draw=drawing,
        readout=Readout("t", "s", "", traces_of(lines), "time"),
        heights=(3.2, 3.0),
    )


def spectrogram_figure(recording: RecordingComparison) -> Block:
    """The plane with the ridge that the track follows."""
    image = recording.spectrogram
    return plane_block(
        "recording-plane",
        image,
        CLOCK,
        title="Spectrogram and ridge",
        caption=f"{image.name}, level in dB re its maximum. {image.note}".strip(),
    )


def tracks_figure(recording: RecordingComparison) -> Block:
    """All tracks over time."""
    chosen = [curve for curve in recording.curves if curve.name == recording.chosen]
    others = [curve for curve in recording.curves if curve.name != recording.chosen]
    name = chosen[0].label if chosen else recording.chosen
    return tracks_block(
        "recording-tracks",
        [*chosen, *others, *recording.theory],
        CLOCK,
        title="Frequency along the recording",
        caption=f"Estimates of the fundamental frequency over time; the backbone is made from {name}.",
    )


def _band_block(
    key: str,
    recording: RecordingComparison,
    x: Array,
    y: Array,
    sd: Array,
    *,
    texts: tuple[str, str, str, str],
    unit: str,
) -> Block:
    title, y_title, caption, name = texts
    order = np.argsort(x, kind="stable")
    x, y, sd = x[order], y[order], np.nan_to_num(sd[order])
    line = Line(x, y, name, "s1")

    def drawing(canvas: Canvas) -> None:
        (axes,) = canvas.stack()
        linear(axes, "x", 0.0, float(x[-1]) * 1.03 if x.size else 1.0, ticks=5 if canvas.narrow else 8)
        linear(axes, "y", *padded([y - 2 * sd, y + 2 * sd], share=0.1))
        titles(axes, x=f"amplitude of {recording.column}", y=y_title)
        axes.fill_between(x, y - 2 * sd, y + 2 * sd, color=sentinel("s1"), alpha=0.18, linewidth=0.0)
        draw(axes, line)

    trace = Trace(name, x, y, "", "s1")
    return block(
        key,
        title=title,
        description=caption,
        caption=caption,
        draw=drawing,
        readout=Readout("amplitude", "", unit, (trace,), "amplitude"),
        heights=(3.6, 3.2),
    )


def backbone_figure(recording: RecordingComparison) -> Block:
    """Frequency against amplitude with its band."""
    x, y = recording.backbone_amplitude, recording.backbone_omega * CLOCK.factor
    ends = ""
    if x.size:
        small, large = int(np.argmin(x)), int(np.argmax(x))
        ends = (
            f"{number(float(y[large]))} Hz at amplitude {number(float(x[large]), 3)}, "
            f"{number(float(y[small]))} Hz at {number(float(x[small]), 3)}. "
        )
    caption = f"Backbone: fundamental frequency against amplitude, {ends}Band: two standard deviations either side."
    texts = ("Backbone of the recording", CLOCK.y_title("ω₀"), caption, "backbone")
    sd = recording.backbone_omega_sd * CLOCK.factor
    return _band_block("recording-backbone", recording, x, y, sd, texts=texts, unit="Hz")


def growth_figure(recording: RecordingComparison) -> Block:
    """Growth rate a'/a against amplitude with its band."""
    caption = "Growth rate a′/a of the amplitude, negative in a decay. Band: two standard deviations either side."
    texts = ("Growth rate of the recording", "a′/a / (1/s)", caption, "growth rate")
    return _band_block(
        "recording-growth",
        recording,
        recording.backbone_amplitude,
        recording.growth_rate,
        recording.growth_rate_sd,
        texts=texts,
        unit="1/s",
    )
