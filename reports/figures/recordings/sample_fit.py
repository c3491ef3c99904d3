"""Samples against the fit of the best class, what it leaves over time, and the spectra of both."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ridgeback.common.numbers import minus, number, per_cent
from ridgeback.common.quantities import frequency
from ridgeback.reports.drawing.figure import FINE, NARROW, WIDE, Figure, Series, readout, switched, switches
from ridgeback.reports.drawing.marks import drawing, group, line, text
from ridgeback.reports.drawing.panel import Panel
from ridgeback.reports.drawing.scale import Scale, padded
from ridgeback.reports.figures.clock import SECONDS, Clock
from ridgeback.reports.figures.recordings.slow_records import fit_in

if TYPE_CHECKING:
    from ridgeback.compare.identification.sample_fit import SampleFit

LEAST_DB = -120.0


def fit_figure(found: SampleFit, title: str, unit: str, clock: Clock = SECONDS) -> Figure:
    """Samples and model above, their difference below on a scale of its own.

    Parameters
    ----------
    found
        Samples and model.
    title
        The class that was fitted.
    unit
        Of the signal; may be empty.
    clock
        In which its times, s, are shown.
    """
    found = fit_in(found, clock.seconds)
    residual = found.samples - found.model
    label = f"Samples and the fit of {title} over time, and their difference"
    groups = tuple(_panels(found, narrow=narrow) for narrow in (False, True))
    behind = f", {unit}" if unit else ""

    def marks(panels: Sequence[Panel], narrow: bool) -> list[str]:
        upper, lower = panels
        parts = [upper.rows(most=4), lower.rows(most=4), text(0, 11, f"samples and fit{behind}", "m")]
        parts += [text(0, lower.top - 10, f"samples less fit{behind}", "m")]
        parts += [lower.columns(most=4 if narrow else 8, unit=clock.time_title)]
        both = [
            switched(0, upper.curve(found.time, found.samples, "ul nf")),
            switched(1, upper.curve(found.time, found.model, "el th nf")),
        ]
        return [*parts, upper.zooming(both), lower.zooming([lower.curve(found.time, residual, "tl th nf")])]

    series = [
        Series("samples", found.time, found.samples, unit),
        Series("fit", found.time, found.model, unit),
        Series("samples less fit", found.time, residual, unit),
    ]
    share = float(np.sqrt(np.mean(residual**2)) / np.std(found.samples))
    return Figure(
        key="sample-fit",
        wide=drawing(WIDE, 380, "wide", label, marks(groups[0], False)),
        narrow=drawing(NARROW, 380, "narrow", label, marks(groups[1], True)),
        caption=f"Grey: samples; orange: {title}, fitted to them; teal: what it leaves, {per_cent(share)} of the "
        "signal’s rms.",
        toggles=switches(["samples", "fit"]),
        data=readout((groups[0], groups[1]), series, name="t", unit=clock.time_unit, link="time", places=FINE),
        label=label,
    )


def _panels(found: SampleFit, *, narrow: bool) -> tuple[Panel, Panel]:
    x = Scale(float(found.time[0]), float(found.time[-1]), *((56.0, 360.0) if narrow else (70.0, 990.0)))
    upper = Scale(*padded([found.samples, found.model], share=0.06), 180.0, 24.0)
    return Panel(x, upper), Panel(x, Scale(*padded([found.samples - found.model], share=0.08), 338.0, 222.0))


def spectrum_figure(found: SampleFit, clock: Clock = SECONDS) -> Figure:
    """Spectra of samples and of the residual, with the multiples of the fundamental."""
    said, found, f = line_sentence(found), fit_in(found, clock.seconds), clock.factor
    label = "Spectra of the samples and of what the fit leaves"
    low = max(LEAST_DB, float(np.min(found.residual_level)) - 4.0)
    panels = tuple(
        Panel(
            Scale(0.0, float(found.omega[-1]) * f, *((52.0, 360.0) if narrow else (70.0, 990.0))),
            Scale(low, 5.0, 240.0, 34.0),
        )
        for narrow in (False, True)
    )

    def marks(panel: Panel, narrow: bool) -> list[str]:
        parts = [panel.rows(most=6, label=lambda v: minus(f"{v:g}")), text(0, 11, "dB of the samples’ highest", "m")]
        parts += [panel.columns(most=4 if narrow else 8, unit=f"frequency, {clock.unit}"), *_multiples(found, panel, f)]
        parts += [switched(0, panel.curve(found.omega * f, found.samples_level, "ul nf"))]
        parts += [switched(1, panel.curve(found.omega * f, found.residual_level, "tl nf"))]
        return parts

    series = [
        Series("samples, dB", found.omega * f, found.samples_level),
        Series("samples less fit, dB", found.omega * f, found.residual_level),
    ]
    return Figure(
        key="residual-spectrum",
        wide=drawing(WIDE, 284, "wide", label, marks(panels[0], False)),
        narrow=drawing(NARROW, 284, "narrow", label, marks(panels[1], True)),
        caption=f"Grey: samples; teal: samples less fit, Welch’s averages under a Hann window. {said}",
        toggles=switches(["samples", "samples less fit"]),
        data=readout(((panels[0],), (panels[1],)), series, name="frequency", unit=clock.unit, link=""),
        label=label,
    )


def _multiples(found: SampleFit, panel: Panel, factor: float) -> list[str]:
    marks, names = [], []
    for n in range(1, 9):
        x = panel.x(n * found.fundamental * factor)
        if x < panel.right - 12:
            marks.append(line(x, panel.top, x, panel.bottom, "g"))
            names.append(text(x, panel.top - 6, "ω₀" if n == 1 else f"{n} ω₀", "m sm", "middle"))
    return [*marks, group(names, "halo")]


def line_sentence(found: SampleFit) -> str:
    """What the residual's highest line is.

    >>> from dataclasses import replace
    >>> from ridgeback.compare.identification.sample_fit import sample_fit
    >>> t = np.arange(64) / 8.0
    >>> flat = sample_fit(t, np.cos(t), 0.9 * np.cos(t), 8.0, 1.0)
    >>> line_sentence(replace(flat, line=None))
    'No line of the residual stands out of white noise.'
    """
    if found.line is None:
        return "No line of the residual stands out of white noise."
    where = frequency(found.line, "s")
    multiple = found.multiple
    if multiple == 1:
        near = ", beside the fundamental: what is left there is amplitude or phase that the class does not follow"
    elif multiple is not None and multiple > 1:
        near = f", at {multiple} times the fundamental: a harmonic that the class does not give"
    elif multiple == 0:
        near = ", a drift"
    else:
        near = f", {number(found.line / found.fundamental, 3)} times the fundamental"
    return f"Its highest line, {per_cent(found.share)} of the residual’s power, is at {where}{near}."
