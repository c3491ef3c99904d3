"""Figures 1 to 9 of the paper, drawn from our own numbers, each beside what the paper says of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from ridgeback.common.numbers import decibels, number, relative
from ridgeback.compare.motion.results import DecayComparison, Image, Integrator, Statement
from ridgeback.reports.drawing.block import Block, Readout, block
from ridgeback.reports.drawing.canvas import Canvas, Line, draw, linear, padded, titles
from ridgeback.reports.drawing.labels import place
from ridgeback.reports.figures.over_time import Clock, plane_block, traces_of, tracks_block


@dataclass(frozen=True)
class PaperFigure:
    """One figure of the paper: its statement and what we draw for it."""

    statement: Statement
    blocks: tuple[Block, ...]


def paper_figures(decay: DecayComparison) -> tuple[PaperFigure, ...]:
    """Return the paper's figures for which the decay carries a statement, in the paper's order."""
    ordered = sorted(decay.statements, key=lambda statement: statement.figure)
    return tuple(PaperFigure(s, DRAWN[s.figure](decay, s) if s.figure in DRAWN else ()) for s in ordered)


def _angle_title(decay: DecayComparison, symbol: str) -> str:
    return f"{symbol} / {decay.case.unit}" if decay.case.unit else symbol


def _signal_block(decay: DecayComparison, key: str, lines: list[Line], caption: str, title: str) -> Block:
    clock = Clock(decay.case.time_unit)

    def drawing(canvas: Canvas) -> None:
        (axes,) = canvas.stack()
        linear(axes, "x", float(decay.time[0]), float(decay.time[-1]), ticks=5 if canvas.narrow else 9)
        linear(axes, "y", *padded([line.y for line in lines], share=0.14))
        titles(axes, x=clock.x_title, y=_angle_title(decay, decay.case.symbol))
        for line in lines:
            draw(axes, line)
        place(axes, [line for line in lines if line.label] if len(lines) > 1 else [])

    readout = Readout("t", clock.time_unit, decay.case.unit, traces_of(lines), "time")
    return block(
        key, title=title, description=caption, caption=caption, draw=drawing, readout=readout, heights=(3.2, 3.0)
    )


def _integrator(one: Integrator, unit: str) -> str:
    """One integrator with its tolerance and cost, and how far it is from the one before."""
    facts = [
        one.method,
        *([] if one.tolerance is None else [f"relative tolerance {number(one.tolerance)}"]),
        *([] if one.evaluations is None else [f"{one.evaluations} evaluations"]),
    ]
    checked = "" if one.difference is None else ", which differs from the one before by at most "
    return ", ".join(facts) + checked + ("" if one.difference is None else f"{number(one.difference, 2)}{unit}")


def figure_1(decay: DecayComparison, _: Statement) -> tuple[Block, ...]:
    """The integrated oscillation."""
    symbol = decay.case.symbol
    case = decay.case
    unit = f" {case.unit}" if case.unit else ""
    caption = (
        f"{symbol}(t) of {case.title} with {', '.join(f'{k} = {number(v)}' for k, v in case.parameters.items())}; "
        f"{symbol}(0) = {number(case.initial[0])}{unit}, {symbol}′(0) = {number(case.initial[1])}. "
        f"Integrated by {'; '.join(_integrator(one, unit) for one in decay.integrators) or 'an unnamed integrator'}."
    )
    line = Line(decay.time, decay.u, f"{symbol}(t)", "s1", width=1.4)
    return (_signal_block(decay, "paper1", [line], caption, f"Oscillation {symbol}(t)"),)


def figure_2(decay: DecayComparison, _: Statement) -> tuple[Block, ...]:
    """The spectrogram of the signal."""
    title = f"Spectrogram of {decay.case.symbol}"
    return (_plane(decay, "paper2", decay.spectrogram_u, title=title),)


def figure_3(decay: DecayComparison, _: Statement) -> tuple[Block, ...]:
    """The spectrogram of its derivative."""
    title = f"Spectrogram of {decay.case.symbol}′"
    return (_plane(decay, "paper3", decay.spectrogram_velocity, title=title),)


def _plane(decay: DecayComparison, key: str, image: Image, *, title: str) -> Block:
    caption = f"{image.name}, level in dB re its maximum, floor {decibels(image.floor_db)}. {image.note}"
    return plane_block(key, image, Clock(decay.case.time_unit), title=title, caption=caption)


def figure_4(decay: DecayComparison, _: Statement) -> tuple[Block, ...]:
    """The amplitude (21) as envelope, beside the averaged action and the turning points."""
    symbol = decay.case.symbol
    amplitudes = decay.amplitudes
    lines = [
        Line(decay.time, decay.u, f"{symbol}(t)", "muted", width=0.9),
        Line(amplitudes.time, amplitudes.energy, "A(t), eq. (21)", "s2"),
    ]
    if amplitudes.averaged is not None:
        lines.append(Line(amplitudes.time, amplitudes.averaged, "A(t), averaged action", "s1", dash=(0, (6, 2))))
    lines.append(Line(amplitudes.turning_time, amplitudes.turning_value, "turning points", "s3", marker="o"))
    known = amplitudes.energy[np.isfinite(amplitudes.energy)]
    ends = f"{number(float(known[0]))} to {number(float(known[-1]))} {decay.case.unit}".strip() if known.size else ""
    caption = (
        f"Peak amplitude A(t) from the energy, {ends}, over the oscillation; dots mark its turning points. "
        f"{amplitudes.note}".strip()
    )
    return (_signal_block(decay, "paper4", lines, caption, "Amplitude A(t) as the envelope"),)


def _tracks(decay: DecayComparison, statement: Statement) -> Block:
    curves = statement.curves
    scores = {score.method: score for score in decay.scores if score.rms_interior is not None}
    errors = [
        f"{curve.label} {relative(scores[curve.name].rms_interior)} rms, "
        f"{relative(scores[curve.name].mean_interior, signed=True)} mean"
        for curve in curves
        if curve.name in scores
    ]
    caption = f"Relative error over the interior: {'; '.join(errors)}." if errors else ""
    return tracks_block(
        f"paper{statement.figure}",
        [decay.reference, *curves],
        Clock(decay.case.time_unit),
        title=statement.title,
        caption=caption,
        span=(float(decay.time[0]), float(decay.time[-1])),
    )


def figure_5(decay: DecayComparison, statement: Statement) -> tuple[Block, ...]:
    """Estimated frequency, the paper's (14) and a low-order expansion."""
    return (_tracks(decay, statement),)


def figure_6(decay: DecayComparison, _: Statement) -> tuple[Block, ...]:
    """The signal against its simple and its multicomponent model."""
    symbol = decay.case.symbol
    made = decay.reconstruction
    lines = [
        Line(made.time, made.signal, f"{symbol}(t)", "fg", width=2.2),
        Line(made.time, made.single, "model (22)", "s2", width=1.2),
    ]
    caption = f"Model (22), one component: rms of the difference {relative(made.rms_single)} of the signal's rms"
    if made.multicomponent is not None:
        lines.append(Line(made.time, made.multicomponent, f"model (7), {made.components} components", "s3", width=1.2))
        caption += f"; model (7), {made.components} components: {relative(made.rms_multicomponent)}"
    clock = Clock(decay.case.time_unit)

    def drawing(canvas: Canvas) -> None:
        upper, lower = canvas.stack((1.5, 1.0), gap=36)
        for axes in (upper, lower):
            linear(axes, "x", float(made.time[0]), float(made.time[-1]), ticks=5 if canvas.narrow else 9)
        rest = [Line(line.x, line.y - made.signal, line.label, line.token, width=1.2) for line in lines[1:]]
        linear(upper, "y", *padded([line.y for line in lines], share=0.06), ticks=5)
        linear(lower, "y", *padded([line.y for line in rest], share=0.3), ticks=4)
        titles(upper, y=_angle_title(decay, decay.case.symbol))
        titles(lower, x=clock.x_title, y=_angle_title(decay, f"model − {symbol}"))
        for line in lines:
            draw(upper, line)
        for line in rest:
            draw(lower, line)
        place(lower, rest)

    readout = Readout("t", clock.time_unit, decay.case.unit, traces_of(lines), "time")
    return (
        block(
            "paper6",
            title=f"{symbol}(t) and its models",
            description=caption,
            caption=f"{caption}. {made.note}".strip(),
            draw=drawing,
            readout=readout,
            heights=(4.2, 4.2),
        ),
    )


def figure_7(decay: DecayComparison, statement: Statement) -> tuple[Block, ...]:
    """Frequency from the Wigner peak of the signal and of its derivative, and the Wigner plane itself."""
    plane = _plane(decay, "paper7w", decay.wigner_u, title=f"Wigner plane of {decay.case.symbol}")
    return _tracks(decay, statement), plane


def figure_8(decay: DecayComparison, statement: Statement) -> tuple[Block, ...]:
    """Frequency from the Wigner and the smoothed pseudo-Wigner peak."""
    return (_tracks(decay, statement),)


def figure_9(decay: DecayComparison, statement: Statement) -> tuple[Block, ...]:
    """The harmonic against three times the fundamental."""
    return (_tracks(decay, statement),)


DRAWN: Mapping[int, Callable[[DecayComparison, Statement], tuple[Block, ...]]] = MappingProxyType(
    {
        1: figure_1,
        2: figure_2,
        3: figure_3,
        4: figure_4,
        5: figure_5,
        6: figure_6,
        7: figure_7,
        8: figure_8,
        9: figure_9,
    }
)
