"""The figure and the table of a noise study: error of each estimator against noise, beside the Cramér-Rao bound."""

from __future__ import annotations

import numpy as np

from ridgeback.common.numbers import NONE, number, relative, uncertain
from ridgeback.compare.noise.results import OUTLIER, NoiseCell, NoiseStudy
from ridgeback.numeric.arrays import Array
from ridgeback.reports.drawing.block import Block, Readout, block
from ridgeback.reports.drawing.canvas import Canvas, Line, Trace, decades, draw, linear, titles
from ridgeback.reports.drawing.labels import place
from ridgeback.reports.drawing.theme import SERIES, sentinel
from ridgeback.reports.text.tables import Row, Table

EFFICIENT = 1.2
"""Ratio to the bound that an efficient estimator keeps."""
MOST = len(SERIES)


def noise_blocks(study: NoiseStudy) -> tuple[Block, ...]:
    """Return the figures of a noise study: error against noise, and its ratio to the bound."""
    return error_figure(study), ratio_figure(study)


def _values(cells: tuple[NoiseCell, ...], name: str) -> Array:
    return np.array([np.nan if (value := getattr(cell, name)) is None else float(value) for cell in cells])


def _drawn(study: NoiseStudy) -> tuple[str, ...]:
    """The methods that are drawn: the first few, as the colours go."""
    return study.methods[:MOST]


def _lines(study: NoiseStudy, name: str) -> list[Line]:
    snr = np.array(study.snr_db)
    return [
        Line(snr, _values(study.of(method), name), method, token)
        for method, token in zip(_drawn(study), SERIES, strict=False)
    ]


def _bands(axes_fill: Canvas, lines: list[Line], deviations: list[Array]) -> None:
    (axes,) = axes_fill.panels
    for line, sd in zip(lines, deviations, strict=True):
        low = np.maximum(line.y - 2 * sd, line.y * 1e-3)
        axes.fill_between(line.x, low, line.y + 2 * sd, color=sentinel(line.token), alpha=0.15, linewidth=0.0)


def _span(study: NoiseStudy) -> tuple[float, float]:
    low, high = min(study.snr_db), max(study.snr_db)
    return (low, high) if high > low else (low - 1.0, high + 1.0)


def _limits(values: list[Array]) -> tuple[float, float]:
    """Whole decades around all positive values."""
    joined = np.concatenate([np.ravel(v) for v in values])
    kept = joined[np.isfinite(joined) & (joined > 0)]
    if kept.size == 0:
        return 1e-4, 1.0
    return 10.0 ** np.floor(np.log10(kept.min())), 10.0 ** np.ceil(np.log10(kept.max()) + 1e-9)


def _shared(study: NoiseStudy) -> str:
    left = len(study.methods) - len(_drawn(study))
    more = f" The table holds {left} more." if left else ""
    return (
        f"{study.title}, {study.samples} samples at {number(study.rate)} per time unit, {study.trials} seeded trials "
        f"a point; bands: two standard deviations of the Monte-Carlo mean.{more}"
    )


def error_figure(study: NoiseStudy) -> Block:
    """Relative rms error of omega0 against the signal-to-noise ratio, with the bound."""
    lines = _lines(study, "rms")
    deviations = [_values(study.of(method), "rms_sd") for method in _drawn(study)]
    snr = np.array(study.snr_db)
    bound = Line(snr, _values(study.of(study.methods[0]), "bound"), "Cramér-Rao bound", "fg", dash=(0, (4, 2)))

    def drawing(canvas: Canvas) -> None:
        (axes,) = canvas.stack()
        linear(axes, "x", *_span(study), ticks=5)
        decades(axes, "y", *_limits([bound.y, *(line.y for line in lines)]))
        titles(axes, x="signal-to-noise ratio / dB", y="relative rms error of ω₀")
        _bands(canvas, lines, deviations)
        for line in (bound, *lines):
            draw(axes, line)
        place(axes, [bound, *lines])

    caption = (
        f"Relative rms error of ω₀(t) over the interior of the record against noise: {_shared(study)} "
        f"The dashed line is the Cramér-Rao bound of the {study.bound}."
    )
    return block(
        "noise-error",
        title="Error against noise",
        description="; ".join(_said(line) for line in lines),
        caption=caption,
        draw=drawing,
        readout=Readout("SNR", "dB", "", _traces([bound, *lines])),
        heights=(3.8, 3.6),
    )


def _traces(lines: list[Line]) -> tuple[Trace, ...]:
    return tuple(Trace(line.label, line.x, line.y, line.style, line.token) for line in lines)


def _said(line: Line) -> str:
    known = line.y[np.isfinite(line.y)]
    if known.size == 0:
        return f"{line.label} gave nothing"
    return f"{line.label}: {relative(float(known[0]))} to {relative(float(known[-1]))}"


def ratio_figure(study: NoiseStudy) -> Block:
    """Ratio of the rms error to the bound of each method's own window."""
    lines = _lines(study, "ratio")
    deviations = [_values(study.of(method), "ratio_sd") for method in _drawn(study)]

    def drawing(canvas: Canvas) -> None:
        (axes,) = canvas.stack()
        low, high = _span(study)
        linear(axes, "x", low, high, ticks=5)
        bottom, top = _limits([*(line.y for line in lines), np.array([1.0])])
        decades(axes, "y", min(bottom, 0.5) if bottom >= 0.1 else bottom, max(top, 10.0))
        titles(axes, x="signal-to-noise ratio / dB", y="rms error over the bound")
        axes.axhline(EFFICIENT, color=sentinel("fg"), linewidth=0.9, linestyle=(0, (4, 2)), zorder=2.0)
        _bands(canvas, lines, deviations)
        for line in lines:
            draw(axes, line)
        place(axes, lines)

    return block(
        "noise-ratio",
        title="Efficiency",
        description=f"Ratio of the error to the Cramér-Rao bound; {EFFICIENT:g} is dashed.",
        caption=f"Rms error divided by the Cramér-Rao bound of the method's own window; dashed: {EFFICIENT:g}. A curve "
        "that rises to the right is ruled by bias, not by noise; one that rises to the left has lost the ridge; one "
        "below 1 answers to fewer parameters than the model of the bound, and pays in bias.",
        draw=drawing,
        readout=Readout("SNR", "dB", "", _traces(lines)),
        heights=(3.4, 3.2),
    )


def noise_table(study: NoiseStudy) -> Table:
    """Return one row per method and ratio, each figure with the uncertainty of the Monte-Carlo mean."""
    covered = any(cell.coverage is not None for cell in study.cells)
    said = " Coverage is of the 95 % interval; a dash: none claimed." if covered else ""
    head = ("method", "SNR", "rms", "mean error", "over bound", "coverage", "lost", "refused")
    return Table(
        "noise",
        f"Estimators in white noise: {study.truth}. Seed {study.seed}, {study.trials} trials a row; ± is one standard "
        f"deviation of the Monte-Carlo mean; lost: trials more than {100 * OUTLIER:.0f} % off.{said}",
        tuple(name for name in head if covered or name != "coverage"),
        tuple(_row(cell, covered=covered) for cell in study.cells),
    )


def _row(cell: NoiseCell, *, covered: bool) -> Row:
    coverage = NONE if cell.coverage is None else f"{100 * cell.coverage:.0f} %"
    counts = (*((coverage,) if covered else ()), str(cell.outliers), str(cell.failures))
    named = (cell.method, f"{number(cell.snr_db)} dB")
    if cell.rms is None:
        return Row((*named, *(NONE,) * (2 + len(counts)), str(cell.failures)), cell.reason, failed=True)
    rms = uncertain(100 * cell.rms, None if cell.rms_sd is None else 100 * cell.rms_sd)
    ratio = uncertain(cell.ratio, cell.ratio_sd)
    return Row((*named, f"{rms} %", relative(cell.bias, signed=True), ratio, *counts))
