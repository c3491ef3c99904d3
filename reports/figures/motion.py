"""The motion itself with its amplitude; of a limit cycle also its phase portrait."""

from __future__ import annotations

import numpy as np

from ridgeback.common.quantities import short_amplitude
from ridgeback.compare.motion.results import MotionComparison
from ridgeback.reports.drawing.figure import FINE, NARROW, WIDE, Figure, Series, readout
from ridgeback.reports.drawing.marks import curve, drawing, group, line, text
from ridgeback.reports.drawing.panel import Panel
from ridgeback.reports.drawing.scale import Scale, padded, tick_labels

TURNS = 12
"""Turns of the phase portrait that are drawn, at most: the first ones, and the last."""


def unit_of(decay: MotionComparison) -> str:
    """The unknown with its unit, as an axis is named."""
    return f"{decay.case.symbol}, {decay.case.unit}" if decay.case.unit else decay.case.symbol


def motion(decay: MotionComparison, *, cycle: bool) -> Figure:
    """The signal with its amplitude, and the phase portrait of a limit cycle."""
    label = f"{decay.case.symbol} over time with its amplitude" + (", and its phase portrait" if cycle else "")
    wide = _panel(decay, narrow=False, cycle=cycle)
    narrow = _panel(decay, narrow=True, cycle=cycle)
    series = [Series(decay.case.symbol, decay.time, decay.u, decay.case.unit)]
    series.append(Series("amplitude", decay.amplitudes.time, decay.amplitudes.energy, decay.case.unit))
    return Figure(
        key="motion",
        wide=_draw(decay, wide, label, narrow=False, cycle=cycle),
        narrow=_draw(decay, narrow, label, narrow=True, cycle=cycle),
        caption=_caption(decay, cycle=cycle),
        data=readout(((wide,), (narrow,)), series, name="t", unit=decay.case.time_unit, link="time", places=FINE),
        label=label,
    )


def _caption(decay: MotionComparison, *, cycle: bool) -> str:
    first, last = (short_amplitude(float(x), decay.case.unit) for x in decay.amplitudes.energy[[0, -1]])
    kind = "Amplitude by the turning points" if decay.amplitudes.averaged is None else "Amplitude by the energy"
    text_ = f"{kind}, {first} throughout." if first == last else f"{kind}, from {first} to {last}."
    if decay.disagreement is not None:
        unit = f" {decay.case.unit}" if decay.case.unit else ""
        text_ += f" Two integrators agree within {decay.disagreement:.1e}{unit}.".replace("e-0", "e-")
    return _powers(text_) + (" Right: velocity against displacement, the last turn thick." if cycle else "")


def _powers(words: str) -> str:
    """Powers of ten as they are printed, in place of a computer's."""
    head, mark, tail = words.partition("e-")
    if not mark:
        return words
    digits = tail[: len(tail) - len(tail.lstrip("0123456789"))]
    raised = digits.translate(str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"{head} × 10⁻{raised}{tail[len(digits) :]}"


def _panel(decay: MotionComparison, *, narrow: bool, cycle: bool) -> Panel:
    right = 360.0 if narrow else (700.0 if cycle else 988.0)
    x = Scale(float(decay.time[0]), float(decay.time[-1]), 44.0, right)
    low, high = padded([decay.u, decay.amplitudes.energy], share=0.06)
    return Panel(x, Scale(low, high, 160.0 if narrow else 210.0, 24.0))


def _draw(decay: MotionComparison, panel: Panel, label: str, *, narrow: bool, cycle: bool) -> str:
    marks = [panel.rows(most=4), panel.columns(most=4 if narrow else 8)]
    marks.append(
        text(panel.right, panel.bottom + 34, f"t, {decay.case.time_unit}" if decay.case.time_unit else "t", "m", "end")
    )
    marks.append(text(0, 11, unit_of(decay), "m"))
    amplitude = decay.amplitudes
    curves = [panel.curve(decay.time, decay.u, "ul nf"), panel.curve(amplitude.time, amplitude.energy, "sl nf")]
    if (
        decay.amplitudes.averaged is not None
        and abs(float(np.min(decay.u)) + amplitude.energy[0]) < 0.1 * amplitude.energy[0]
    ):
        curves.append(panel.curve(amplitude.time, -amplitude.energy, "sl nf"))
    marks.append(panel.zooming(curves))
    height = panel.bottom + 44
    if cycle:
        side = Panel(
            Scale(*padded([decay.u]), 56.0, 320.0), Scale(*padded([decay.velocity]), height + 250, height + 20)
        )
        if not narrow:
            side = Panel(Scale(*padded([decay.u]), 770.0, 990.0), Scale(*padded([decay.velocity]), 210.0, 24.0))
        marks += _portrait(decay, side)
        height = height + 290 if narrow else height
    return drawing(NARROW if narrow else WIDE, height, "narrow" if narrow else "wide", label, marks)


def _portrait(decay: MotionComparison, panel: Panel) -> list[str]:
    middle = float(np.nanmedian(decay.reference.omega[decay.reference.valid]))
    turn = max(2, round(2 * np.pi / middle * decay.case.rate))
    early = slice(0, min(TURNS * turn, decay.u.size))
    x, y = panel.x.of(decay.u), panel.y.of(decay.velocity)
    marks = [panel.rows(most=4)]
    ticks = panel.x.ticks(4)
    marks += [
        text(panel.x(v), panel.bottom + 19, name, "m", "middle")
        for v, name in zip(ticks, tick_labels(ticks), strict=True)
    ]
    marks += [line(panel.left, panel.bottom, panel.right, panel.bottom, "ax")]
    marks += [curve(x[early], y[early], "ul nf"), curve(x[-turn - 1 :], y[-turn - 1 :], "sl nf")]
    velocity = f"{decay.case.symbol}′"
    marks.append(
        group(
            [
                text(panel.left - 44, panel.top - 12, velocity, "m"),
                text(panel.right, panel.bottom + 34, decay.case.symbol, "m", "end"),
            ],
            "",
        )
    )
    return marks
