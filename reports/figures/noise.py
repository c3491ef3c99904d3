"""The estimators in noise: one small panel each, the others in grey, its own Cramér-Rao bound dashed."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ridgeback.common.numbers import NONE, listing, number, per_cent, uncertain
from ridgeback.compare.noise.results import NoiseCell, NoiseStudy
from ridgeback.compare.report.naming import capital, estimator
from ridgeback.numeric.arrays import Array
from ridgeback.reports.drawing.figure import Figure
from ridgeback.reports.drawing.marks import area, curve, dot, drawing, group, line, text
from ridgeback.reports.drawing.panel import Panel
from ridgeback.reports.drawing.scale import Scale
from ridgeback.reports.drawing.ticks import error_ticks
from ridgeback.reports.text.tables import Row, Table

AT_BOUND = 1.5
"""Ratio to the bound within which an estimator is said to reach it."""
LOST = 0.1


def values(cells: Sequence[NoiseCell], name: str) -> Array:
    """One number of each cell, NaN where there is none."""
    return np.array([np.nan if getattr(cell, name) is None else float(getattr(cell, name)) for cell in cells])


def noise_figure(study: NoiseStudy) -> Figure:
    """Small multiples that share their axes."""
    snr = np.array(study.snr_db)
    rms = {method: values(study.of(method), "rms") for method in study.methods}
    bounds = [values(study.of(method), "bound") for method in study.methods]
    joined = np.concatenate([*(v for v in rms.values()), *bounds])
    kept = joined[np.isfinite(joined) & (joined > 0)]
    low, high = (float(kept.min()), float(kept.max())) if kept.size else (1e-4, 1.0)
    scale = (0.6 * low, min(max(1.6 * high, 10 * low), 0.4))
    small = [_small(study, method, snr, rms, scale) for method in study.methods]
    return Figure(
        key="noise",
        wide="".join(small),
        narrow="",
        caption=f"Rms error against signal-to-noise ratio, {study.trials} seeded trials a point, band one standard "
        f"deviation; dashed, the Cramér-Rao bound of the method’s own window; grey, the other methods. "
        f"True ω₀(t): {study.truth}.",
        many="five",
        label="Error of each estimator against noise",
        table="noise-table",
    )


def _small(study: NoiseStudy, method: str, snr: Array, rms: dict[str, Array], scale: tuple[float, float]) -> str:
    wide = float(snr.max() - snr.min()) or 2.0
    panel = Panel(
        Scale(float(snr.min()) - 0.06 * wide, float(snr.max()) + 0.06 * wide, 58.0, 198.0),
        Scale(*scale, 176.0, 30.0, log=True),
    )
    marks = [text(0, 12, estimator(method), "fgt b")]
    ticks = panel.y.ticks(4)
    for value, words in zip(ticks, map(error_ticks(ticks), ticks), strict=True):
        marks += [
            line(panel.left, panel.y(value), panel.right, panel.y(value)),
            text(panel.left - 5, panel.y(value) + 4, words, "m sm", "end"),
        ]
    shown = snr[:: max(1, (snr.size + 2) // 3)]
    marks += [text(panel.x(float(v)), 192, f"{v:g}", "m sm", "middle") for v in shown]
    marks += [text(198, 206, "SNR, dB", "m sm", "end"), line(panel.left, panel.bottom, panel.right, panel.bottom, "ax")]
    marks += [panel.curve(snr, other, "gh nf") for name, other in rms.items() if name != method]
    cells = study.of(method)
    marks.append(panel.curve(snr, values(cells, "bound"), "tg2 nf"))
    own, sd = rms[method], values(cells, "rms_sd")
    x = panel.x.of(snr)
    low = panel.y.clipped(np.maximum(own - np.nan_to_num(sd), 0.3 * own))
    marks.append(area(x, low, panel.y.clipped(own + np.nan_to_num(sd)), "tf"))
    y = panel.y.clipped(own)
    marks.append(curve(x, y, "tl2 nf"))
    for i, (a, b) in enumerate(zip(x, y, strict=True)):
        if np.isfinite(b):
            marks.append(dot(float(a), float(b), 3.0, "t", _told(cells[i])))
    off = np.flatnonzero(own > scale[1])
    if off.size:  # said once, beside the last of them
        last = int(off[-1])
        shift, anchor = (9, "start") if last < snr.size - 1 else (-9, "end")
        marks.append(group([text(float(x[last]) + shift, panel.top + 5, "off scale", "t sm", anchor)], "halo"))
    return drawing(204, 210, "one", f"{estimator(method)}: error against noise", marks)


def _told(cell: NoiseCell) -> str:
    """A cell as a pointer reads it."""
    bound = "" if cell.bound is None else f", Cramér-Rao bound {per_cent(cell.bound)}"
    spread = "" if cell.rms_sd is None else f" ± {per_cent(cell.rms_sd)}"
    return f"{capital(estimator(cell.method))} at {number(cell.snr_db)} dB: {per_cent(cell.rms)}{spread}{bound}"


def noise_heading(study: NoiseStudy) -> str:
    """Who stays at its bound, from the cells' ratios; none is an answer too."""
    at_bound = [m for m in study.methods if _holds(study.of(m))]
    if at_bound:
        names = listing([estimator(m) for m in at_bound])
        verb, whose = ("stays", "its bound") if len(at_bound) == 1 else ("stay", "their bounds")
        return f"In noise, {names} {verb} within {AT_BOUND:g} times {whose}"
    ratios = {m: values(study.of(m), "ratio") for m in study.methods}
    medians = {m: float(np.nanmedian(found)) for m, found in ratios.items() if np.isfinite(found).any()}
    if not medians:
        return "In noise, no estimator gives a value"
    nearest = min(medians, key=lambda m: medians[m])
    ratio = medians[nearest]
    return f"In noise, {estimator(nearest)} comes nearest to its bound, {number(ratio, 2)} times it in the median"


def _holds(cells: Sequence[NoiseCell]) -> bool:
    ratios, sd = values(cells, "ratio"), values(cells, "ratio_sd")
    return bool(np.isfinite(ratios).all() and (ratios - np.nan_to_num(sd) <= AT_BOUND).all())


def noise_sentence(study: NoiseStudy) -> str:
    """Which methods stop at their bias at the best ratio of all."""
    best = max(study.snr_db)
    stopped = []
    for method in study.methods:
        cell = study.cell(method, best)
        if cell.rms and cell.bias is not None and abs(cell.bias) > 0.5 * cell.rms:
            stopped.append(f"{estimator(method)} ({per_cent(cell.rms)})")
    parts = [f"At {number(best)} dB bias rules {listing(stopped)}." if stopped else "", _lost(study)]
    return " ".join(part for part in parts if part)


def _lost(study: NoiseStudy) -> str:
    """Which methods are lost at which ratio."""
    said = []
    for snr in sorted(study.snr_db):
        lost = [estimator(method) for method in study.methods if (study.cell(method, snr).rms or 0.0) > LOST]
        every = len(lost) == len(study.methods) > 1
        said += [f"at {number(snr)} dB {f'all {len(lost)}' if every else listing(lost)}"] if lost else []
    return f"Lost: {'; '.join(said)}." if said else ""


def noise_table(study: NoiseStudy) -> Table:
    """Error of every method at every ratio, with its ratio to the bound."""
    return Table(
        "noise-table",
        f"Rms error of ω₀ in white noise, {study.trials} seeded trials a cell; in brackets its ratio to the Cramér-Rao "
        f"bound ± one standard deviation; lost: above {per_cent(LOST)}."
        f"{'' if study.complete else ' Interrupted: not all trials were run.'}",
        ("method", *(f"{number(snr)} dB" for snr in study.snr_db)),
        tuple(
            Row((capital(estimator(method)), *(_cell(cell) for cell in study.of(method))), _reason(study.of(method)))
            for method in study.methods
        ),
    )


def _cell(cell: NoiseCell) -> str:
    if cell.rms is None:
        return NONE
    if cell.rms > LOST:
        return "lost"
    ratio = "" if cell.ratio is None else f" ({uncertain(cell.ratio, cell.ratio_sd)})"
    return f"{per_cent(cell.rms)}{ratio}"


def _reason(cells: Sequence[NoiseCell]) -> str:
    said = [
        f"{number(c.snr_db)} dB: {c.failures} of {c.trials} trials refused: {c.reason}" for c in cells if c.failures
    ]
    return "; ".join(said[:2])
