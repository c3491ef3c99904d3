"""What made it: candidates over the measured backbone and growth rate, their ranking, and the forecast."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ridgeback.common.numbers import number, per_cent
from ridgeback.common.quantities import symbol, unit_text
from ridgeback.compare.identification.results import Candidate, Identification, Parameter, Prediction
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.tracking.track import NORMAL_95
from ridgeback.reports.drawing.figure import NARROW, WIDE, Figure, Series, readout, switched, switches
from ridgeback.reports.drawing.marks import area, drawing, text
from ridgeback.reports.drawing.panel import Panel
from ridgeback.reports.drawing.scale import Scale, padded
from ridgeback.reports.figures.clock import SECONDS, Clock
from ridgeback.reports.figures.recording import Band, side_by_side
from ridgeback.reports.text.tables import Row, Table

SPELT = {"w": "omega", "phase": "phi"}
"""Stems of parameters whose symbol is another one."""
STYLES = ("el nf", "sl d1 nf", "el d2 nf", "sl d3 nf")


def unit_of(found: Identification) -> str:
    """The signal's unit behind a comma."""
    return f", {unit_text(found.unit)}" if found.unit else ""


def candidates_figure(found: Identification, clock: Clock = SECONDS) -> Figure:
    """The leading candidates over what was measured without any class in mind."""
    data, f = found.data, clock.factor

    def over(name: str, factor: float) -> tuple[tuple[str, Array, str], ...]:
        shown = [(c, np.interp(data.amplitude, *_ordered(c, name))) for c in found.candidates[: len(STYLES)]]
        return tuple((c.title, factor * y, style) for (c, y), style in zip(shown, STYLES, strict=False))

    omega_sd, growth_sd = (np.nan_to_num(sd) for sd in (data.omega_sd, data.growth_rate_sd))
    bands = (
        Band(clock.title(), data.amplitude, data.omega * f, omega_sd * f, over("omega", f)),
        Band(clock.growth_title, data.amplitude, data.growth_rate, growth_sd, over("growth_rate", 1.0)),
    )
    claimed = ", bands 95 %" if omega_sd.any() else ""
    return side_by_side(
        "identify-backbone",
        bands,
        x_title=f"amplitude of the fundamental{unit_of(found)}",
        caption=f"Measured without any class in mind{claimed}, and the classes that fit best, best first.",
        label="Candidates over the measured backbone and growth rate",
        unit=found.unit,
    )


def _ordered(candidate: Candidate, name: str) -> tuple[Array, Array]:
    order = np.argsort(candidate.amplitude)
    return candidate.amplitude[order], np.asarray(getattr(candidate, name))[order]


@dataclass(frozen=True)
class Panelled:
    """What one panel of a forecast shows, in its own unit: the forecast and what was measured, each with its band."""

    title: str
    centre: Array
    low: Array
    high: Array
    measured: Array
    half: Array

    def apart(self, title: str) -> Panelled:
        """In per cent of the forecast from it."""
        centre, low, high, measured = (
            100.0 * (values / self.centre - 1.0) for values in (self.centre, self.low, self.high, self.measured)
        )
        return Panelled(title, centre, low, high, measured, 100.0 * self.half / self.centre)

    @property
    def shown(self) -> tuple[Array, ...]:
        """All that the panel has room for."""
        return self.low, self.high, self.measured - self.half, self.measured + self.half


def panels_of(made: Prediction, unit: str) -> tuple[Panelled, ...]:
    """Amplitude, amplitude and frequency off the forecast in per cent, and phase off it in rad."""
    halves = (NORMAL_95 * sd for sd in (made.measured_amplitude_sd, made.measured_omega_sd, made.measured_phase_sd))
    a, omega, phase = (np.nan_to_num(half) for half in halves)
    amplitude = Panelled(
        f"amplitude{unit}", made.amplitude, made.amplitude_low, made.amplitude_high, made.measured_amplitude, a
    )
    frequency = Panelled("", made.omega, made.omega_low, made.omega_high, made.measured_omega, omega)
    none = np.zeros_like(made.time)
    return (
        amplitude,
        amplitude.apart("amplitude, off by %"),
        frequency.apart("frequency, off by %"),
        Panelled("phase, off by rad", none, -made.phase_band, made.phase_band, made.phase_error, phase),
    )


def forecast_figure(made: Prediction, found: Identification, clock: Clock = SECONDS) -> Figure:
    """Amplitude, frequency and phase as forecast from the first cycles, with what was measured later."""
    rows = panels_of(made, unit_of(found))
    label = "Forecast amplitude, frequency and phase with what was measured"
    groups = tuple(
        tuple(_panel(made, row.shown, i, narrow=narrow) for i, row in enumerate(rows)) for narrow in (False, True)
    )
    drawn = []
    for narrow, panels in zip((False, True), groups, strict=True):
        marks = []
        for row, panel in zip(rows, panels, strict=True):
            x = panel.x.of(made.time)
            marks += [panel.rows(most=4), text(0, panel.top - 10, row.title, "m")]
            low, high = panel.y.clipped(row.measured - row.half), panel.y.clipped(row.measured + row.half)
            bands = [
                switched(0, area(x, panel.y.clipped(row.low), panel.y.clipped(row.high), "ef")),
                switched(1, area(x, low, high, "tf")),
            ]
            curves = [
                switched(0, panel.curve(made.time, row.centre, "el nf")),
                switched(1, panel.curve(made.time, row.measured, "tl nf")),
            ]
            marks.append(panel.zooming([*bands, *curves]))
        marks.append(panels[-1].columns(most=4 if narrow else 8, unit=clock.time_title))
        drawn.append(drawing(NARROW if narrow else WIDE, 550, "narrow" if narrow else "wide", label, marks))
    series = [Series(f"{row.title}, measured", made.time, row.measured) for row in rows]
    series += [Series("forecast", made.time, rows[0].centre)]
    errors = made.errors
    return Figure(
        key="forecast",
        wide=drawn[0],
        narrow=drawn[1],
        caption=f"{_title(made.candidate, found)} fitted to the first {number(made.cycles, 3)} cycles, to t = "
        f"{number(made.until)} {clock.time_unit}. Orange: forecast; teal: what was measured later, less the forecast "
        f"below the first panel; each with its 95 % band. Rms distance: amplitude {per_cent(errors.get('amplitude'))}, "
        f"frequency {per_cent(errors.get('omega'))}, phase {number(errors.get('phase'), 3)} rad.",
        toggles=switches(["forecast", "measured"]),
        data=readout((groups[0], groups[1]), series, name="t", unit=clock.time_unit, link="time"),
        label=label,
    )


def _panel(made: Prediction, values: tuple[Array, ...], i: int, *, narrow: bool) -> Panel:
    x = (
        Scale(float(made.time[0]), float(made.time[-1]), 56.0, 360.0)
        if narrow
        else Scale(float(made.time[0]), float(made.time[-1]), 70.0, 990.0)
    )
    top = 24.0 + 128.0 * i
    return Panel(x, Scale(*padded(values, share=0.08), top + 94.0, top))


def _title(name: str, found: Identification) -> str:
    """The title of a candidate by its name; the name itself where it was not ranked."""
    return next((c.title for c in found.candidates if c.name == name), name)


def ranking_table(found: Identification) -> Table:
    """The candidates, best first; those that could not be fitted come last with the reason."""
    fitted = tuple(
        Row(
            (
                c.named,
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
        f"residual: rms of samples less model{unit_of(found)}.",
        ("class", "Δ", "weight", "residual"),
        (*fitted, *(Row((text, "", "", ""), failed=True) for text in found.failed)),
    )


def parameter_table(candidate: Candidate, key: str = "parameters", of: str = "") -> Table:
    """The fitted numbers of one candidate with their 95 % intervals, value and ends to the same decimals.

    ``of`` names the signal where a page has several.
    """
    return Table(
        key,
        f"{of}, {candidate.named}" if of else candidate.named,
        ("parameter", "value", "95 % interval"),
        tuple(Row((_named(p), *_with_interval(p))) for p in candidate.parameters),
    )


def _with_interval(parameter: Parameter) -> tuple[str, str]:
    low, high = parameter.interval()
    half = 0.5 * (high - low)
    if np.isnan(half):
        return number(parameter.value, 4), "not claimed"
    if np.isinf(half):
        return number(parameter.value, 2), "undetermined"
    if not half > 0:
        return number(parameter.value, 6), "exact"
    places = int(np.clip(1 - np.floor(np.log10(half)), 0, 12))
    value, start, end = (f"{v:.{places}f}".replace("-", "−") for v in (parameter.value, low, high))
    return value, f"{start} to {end}"


def _named(parameter: Parameter) -> str:
    """A parameter as the equation above has it, with its meaning and its unit.

    >>> _named(Parameter("phase0", 0.1, 0.0, "rad", "phase at the start"))
    'φ₀, phase at the start, in rad'
    """
    stem = parameter.name.rstrip("0123456789")
    sign = symbol(SPELT.get(stem, stem) + parameter.name[len(stem) :])
    name = f"{sign}, {unit_text(parameter.meaning)}" if parameter.meaning else sign
    return f"{name}, in {unit_text(parameter.unit)}" if parameter.unit else name
