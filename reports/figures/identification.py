"""What made it: the candidates against the measured backbone and growth rate, their ranking, and the prediction."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ridgeback.common.numbers import number, relative
from ridgeback.compare.identification.results import Candidate, Identification, MeasuredBackbone, Parameter, Prediction
from ridgeback.numeric.arrays import Array
from ridgeback.reports.drawing.block import Block, Readout, block
from ridgeback.reports.drawing.canvas import Canvas, Line, draw, linear, padded, titles
from ridgeback.reports.drawing.labels import place
from ridgeback.reports.drawing.theme import SERIES, sentinel
from ridgeback.reports.figures.over_time import Clock, traces_of
from ridgeback.reports.text.tables import Row, Table

CLOCK = Clock("s")
MOST = 4
"""Candidates drawn: the best, and those that come next."""


def identification_blocks(found: Identification) -> tuple[Block, ...]:
    """Return the figures of an identification, in reading order."""
    first = (frequency_figure(found), growth_figure(found))
    return first if found.prediction is None else (*first, *prediction_figures(found.prediction, found))


def _unit(found: Identification) -> str:
    return f" / {found.unit}" if found.unit else ""


def _fitted(
    key: str,
    found: Identification,
    measured: tuple[Array, Array],
    bands: list[tuple[Candidate, Array, Array, Array]],
    *,
    texts: tuple[str, str, str],
    unit: str,
) -> Block:
    """Measured points with two deviations, candidates as curves, the best one's band."""
    title, y_title, caption = texts
    values, sd = measured
    x = found.data.amplitude
    lines = [
        Line(c.amplitude, y, c.title, token, width=2.2 if c is found.best else 1.6)
        for (c, y, _, _), token in zip(bands, SERIES, strict=False)
    ]
    points = Line(x, values, "measured", "fg", marker="o", order=4.0)

    def drawing(canvas: Canvas) -> None:
        (axes,) = canvas.stack()
        linear(axes, "x", 0.0, 1.04 * float(np.nanmax(x)) if x.size else 1.0, ticks=5 if canvas.narrow else 8)
        linear(axes, "y", *padded([values - 2 * sd, values + 2 * sd, *(line.y for line in lines[:1])], share=0.1))
        titles(axes, x=f"amplitude of the fundamental{_unit(found)}", y=y_title)
        _, _, low, high = bands[0]
        axes.fill_between(lines[0].x, low, high, color=sentinel("s1"), alpha=0.18, linewidth=0.0)
        axes.vlines(x, values - 2 * sd, values + 2 * sd, color=sentinel("muted"), linewidth=0.9, zorder=3.5)
        for line in (*reversed(lines), points):
            draw(axes, line)
        place(axes, [*lines, replace(points, label="")])

    return block(
        key,
        title=title,
        description=caption,
        caption=caption,
        draw=drawing,
        readout=Readout("amplitude", found.unit, unit, traces_of([*lines, points]), "amplitude"),
        heights=(3.8, 3.5),
    )


def _caption(found: Identification, what: str) -> str:
    return (
        f"{what} against the amplitude of the fundamental: points measured without any class in mind, bars two "
        f"standard deviations; curves are the fitted candidates, best first, band: 95 % of {found.best.title}."
    )


def frequency_figure(found: Identification) -> Block:
    """The measured backbone and those of the leading candidates."""
    data, f = found.data, CLOCK.factor
    bands = [(c, c.omega * f, c.omega_low * f, c.omega_high * f) for c in found.candidates[:MOST]]
    texts = ("Which backbone fits", CLOCK.y_title("ω₀"), _caption(found, "Fundamental frequency"))
    return _fitted("identify-backbone", found, (data.omega * f, data.omega_sd * f), bands, texts=texts, unit="Hz")


def growth_figure(found: Identification) -> Block:
    """The measured growth rate and those of the leading candidates."""
    data: MeasuredBackbone = found.data
    bands = [(c, c.growth_rate, c.growth_rate_low, c.growth_rate_high) for c in found.candidates[:MOST]]
    texts = ("Which growth rate fits", "a′/a / (1/s)", _caption(found, "Growth rate a′/a"))
    return _fitted("identify-growth", found, (data.growth_rate, data.growth_rate_sd), bands, texts=texts, unit="1/s")


def prediction_figures(made: Prediction, found: Identification) -> tuple[Block, ...]:
    """The rest of the decay as predicted from its first cycles, against what was measured."""
    f = CLOCK.factor
    share = ", ".join(f"{name} {100 * value:.0f} %" for name, value in made.coverage.items())
    errors = made.errors
    caption = (
        f"{_title(made.candidate, found)} fitted to the first "
        f"{number(made.cycles, 3)} cycles (up to t = {number(made.until)} s) predicts the rest. Bands: 95 %; share of "
        f"the measured values inside: {share}. Rms distance: amplitude {relative(errors.get('amplitude'))}, "
        f"frequency {relative(errors.get('omega'))}, phase {number(errors.get('phase'), 3)} rad."
    )
    return (
        _prediction_block(
            "prediction-amplitude",
            made,
            (made.amplitude, made.amplitude_low, made.amplitude_high, made.measured_amplitude),
            texts=("Amplitude predicted", f"amplitude{_unit(found)}", caption),
            unit=found.unit,
        ),
        _prediction_block(
            "prediction-frequency",
            made,
            (made.omega * f, made.omega_low * f, made.omega_high * f, made.measured_omega * f),
            texts=("Frequency predicted", CLOCK.y_title("ω₀"), "The same for the fundamental frequency."),
            unit="Hz",
        ),
        _prediction_block(
            "prediction-phase",
            made,
            (np.zeros_like(made.time), -made.phase_band, made.phase_band, made.phase_error),
            texts=("Phase error", "phase / rad", "Measured less predicted phase, unwrapped; band: 95 %."),
            unit="rad",
        ),
    )


def _title(name: str, found: Identification) -> str:
    """The title of a candidate by its name; the name itself where it was not ranked."""
    return next((c.title for c in found.candidates if c.name == name), name)


def _prediction_block(
    key: str, made: Prediction, values: tuple[Array, Array, Array, Array], *, texts: tuple[str, str, str], unit: str
) -> Block:
    title, y_title, caption = texts
    centre, low, high, measured = values
    lines = [Line(made.time, centre, "predicted", "s1", width=2.2), Line(made.time, measured, "measured", "s2")]

    def drawing(canvas: Canvas) -> None:
        (axes,) = canvas.stack()
        linear(axes, "x", float(made.time[0]), float(made.time[-1]), ticks=5 if canvas.narrow else 9)
        linear(axes, "y", *padded([low, high, measured], share=0.12))
        titles(axes, x=CLOCK.x_title, y=y_title)
        axes.fill_between(made.time, low, high, color=sentinel("s1"), alpha=0.18, linewidth=0.0)
        for line in lines:
            draw(axes, line)
        place(axes, lines)

    return block(
        key,
        title=title,
        description=caption,
        caption=caption,
        draw=drawing,
        readout=Readout("t", "s", unit, traces_of(lines), "time"),
        heights=(3.2, 3.0),
    )


def ranking_table(found: Identification) -> Table:
    """Return the candidates, best first; those that could not be fitted come last with the reason."""
    fitted = tuple(
        Row(
            (
                f"{c.title}, {c.damping_law} damping",
                number(c.delta, 3),
                f"{100 * c.weight:.1f} %",
                number(c.residual, 3),
            ),
            c.note,
        )
        for c in found.candidates
    )
    return Table(
        "candidates",
        f"Candidates by {found.criterion_title}, counted on "
        f"{number(found.effective_samples, 3)} independent samples; Δ is the distance from the best, weight its share; "
        f"residual: rms of samples less model{_unit(found)}.",
        ("class", "Δ", "weight", "residual"),
        (*fitted, *(Row((text, "", "", ""), failed=True) for text in found.failed)),
    )


def parameter_table(candidate: Candidate) -> Table:
    """Return the fitted numbers of one candidate with their 95 % intervals."""
    return Table(
        "parameters",
        f"{candidate.title}: {candidate.equation}",
        ("parameter", "value", "95 % interval"),
        tuple(
            Row((_named(p), number(p.value, 6), " to ".join(number(end, 5) for end in p.interval())))
            for p in candidate.parameters
        ),
    )


def _named(parameter: Parameter) -> str:
    name = f"{parameter.name}, {parameter.meaning}" if parameter.meaning else parameter.name
    return f"{name}, in {parameter.unit}" if parameter.unit else name
