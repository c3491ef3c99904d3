"""What all figures over time share: Hz or rad, time-frequency planes, tracks over a reference, residuals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ridgeback.common.numbers import decibels, number
from ridgeback.compare.motion.results import Curve, Image
from ridgeback.numeric.arrays import Array
from ridgeback.reports.drawing.block import Block, Key, Readout, block
from ridgeback.reports.drawing.canvas import Canvas, Line, Trace, draw, linear, padded, titles
from ridgeback.reports.drawing.labels import place
from ridgeback.reports.drawing.raster import plane_uri
from ridgeback.reports.drawing.theme import SERIES

TAU = 2 * np.pi


@dataclass(frozen=True)
class Clock:
    """How time and frequency are written: Hz when time is in seconds, else rad per time unit."""

    time_unit: str

    @property
    def factor(self) -> float:
        """Return what an angular frequency is multiplied with for display."""
        return 1 / TAU if self.time_unit == "s" else 1.0

    @property
    def unit(self) -> str:
        """Return the unit of displayed frequencies.

        >>> Clock("s").unit, Clock("").unit
        ('Hz', '')
        """
        return "Hz" if self.time_unit == "s" else (f"rad/{self.time_unit}" if self.time_unit else "")

    @property
    def x_title(self) -> str:
        """Return the title of a time axis."""
        return f"t / {self.time_unit}" if self.time_unit else "t"

    def y_title(self, symbol: str) -> str:
        """Return the title of a frequency axis."""
        symbol = f"{symbol}/2π" if self.time_unit == "s" else symbol
        if not self.unit:
            return symbol
        return f"{symbol} / ({self.unit})" if "/" in self.unit else f"{symbol} / {self.unit}"


def shown(curve: Curve) -> Array:
    """Return the angular frequency of a curve, not a number where it is not valid."""
    return np.where(curve.valid, curve.omega, np.nan)


def curve_line(curve: Curve, clock: Clock, token: str, *, style: str = "", width: float = 1.8) -> Line:
    """Return a curve as a line in display units."""
    dash: str | tuple[float, tuple[float, ...]] = (0, (6, 2)) if curve.kind == "expansion" else "-"
    return Line(curve.time, shown(curve) * clock.factor, curve.label, token, style=style, width=width, dash=dash)


def traces_of(lines: Sequence[Line], panel: int = 0) -> tuple[Trace, ...]:
    """Return lines as the readout shows them."""
    return tuple(Trace(line.label, line.x, line.y, line.style, line.token, panel) for line in lines)


def usable(curves: Sequence[Curve]) -> list[Curve]:
    """Return the curves that have something to show."""
    return [curve for curve in curves if bool((curve.valid & np.isfinite(curve.omega)).any())]


def relative_to(curve: Curve, reference: Curve) -> Array:
    """Return ``omega / reference - 1`` on the curve's own times; not a number where either is missing."""
    target = shown(reference)
    known = np.isfinite(target)
    if not known.any():
        return np.full(curve.time.shape, np.nan)
    times = reference.time[known]
    base = np.interp(curve.time, times, target[known], left=np.nan, right=np.nan)
    return shown(curve) / base - 1


def tracks_block(
    key: str,
    curves: Sequence[Curve],
    clock: Clock,
    *,
    title: str,
    caption: str,
    symbol: str = "ω₀",
    span: tuple[float, float] | None = None,
    height: tuple[float, float] = (3.4, 3.2),
) -> Block:
    """Draw up to five tracks over time; the first is drawn as the reference when it is one."""
    references = [curve_line(c, clock, "fg", width=2.6) for c in usable(curves) if c.kind == "reference"][:1]
    others = [c for c in usable(curves) if c.kind != "reference"]
    lines = [*references, *(curve_line(c, clock, token) for c, token in zip(others, SERIES, strict=False))]

    def drawing(canvas: Canvas) -> None:
        (axes,) = canvas.stack()
        linear(axes, "x", *(span or time_span([line.x for line in lines])), ticks=5 if canvas.narrow else 9)
        linear(axes, "y", *padded([line.y for line in lines], share=0.12))
        titles(axes, x=clock.x_title, y=clock.y_title(symbol))
        for line in lines:
            draw(axes, line)
        place(axes, lines)

    description = "; ".join(f"{line.label} {_ends(line)}" for line in lines)
    readout = Readout("t", clock.time_unit, clock.unit, traces_of(lines), "time")
    return block(
        key, title=title, description=description, caption=caption, draw=drawing, readout=readout, heights=height
    )


def _ends(line: Line) -> str:
    known = line.y[np.isfinite(line.y)]
    return f"runs from {number(float(known[0]))} to {number(float(known[-1]))}" if known.size else "has no value"


def time_span(times: Sequence[Array]) -> tuple[float, float]:
    """Return the common extent of time arrays."""
    filled = [t for t in times if t.size]
    if not filled:
        return 0.0, 1.0
    return float(min(t[0] for t in filled)), float(max(t[-1] for t in filled))


def plane_block(key: str, image: Image, clock: Clock, *, title: str, caption: str, top: float | None = None) -> Block:
    """Draw a time-frequency plane: levels in dB as ink on the page, tracks over it."""
    keep = slice(None) if top is None else slice(0, int(np.searchsorted(image.omega, top, side="right")) or None)
    omega, level = image.omega[keep], image.level_db[keep]
    overlays = [
        curve_line(curve, clock, SERIES[1 + k % 4], style="over", width=1.2)
        for k, curve in enumerate(usable(image.overlays)[:4])
    ]
    uri = plane_uri(level, image.floor_db)

    def drawing(canvas: Canvas) -> None:
        (axes,) = canvas.stack()
        axes.grid(visible=False)
        linear(axes, "x", *_half_step(image.time), ticks=5 if canvas.narrow else 9)
        low, high = (v * clock.factor for v in _half_step(omega))
        linear(axes, "y", max(low, 0.0) if omega[0] >= 0 else low, high)
        titles(axes, x=clock.x_title, y=clock.y_title("ω"))
        canvas.insert(axes, "plane", _plane_markup(canvas, key, low, high))
        for line in overlays:
            draw(axes, line)
        place(axes, overlays)

    shared = (
        f'<svg class="store" width="0" height="0" aria-hidden="true"><defs><image id="shared-{key}" '
        f'width="1" height="1" preserveAspectRatio="none" href="{uri}"/></defs></svg>'
    )
    drawn = block(
        key,
        title=title,
        description=f"{image.name}: level in dB re its maximum, {number(float(omega[0] * clock.factor))} to "
        f"{number(float(omega[-1] * clock.factor))} {clock.unit}. {image.note}".strip(),
        caption=caption,
        draw=drawing,
        readout=Readout("t", clock.time_unit, clock.unit, traces_of(overlays), "time"),
        keys=_level_keys(image.floor_db),
        heights=(3.4, 3.2),
    )
    return Block(drawn.key, title, caption, shared + drawn.wide, drawn.narrow, (), drawn.keys, drawn.data)


def _half_step(values: Array) -> tuple[float, float]:
    half = float(values[1] - values[0]) / 2 if values.size > 1 else 0.5
    return float(values[0]) - half, float(values[-1]) + half


def _plane_markup(canvas: Canvas, key: str, low: float, high: float) -> str:
    """Ink where the grey image is bright.  The image covers ``low..high``; the panel cuts off what is below zero."""
    x0, y0, x1, y1 = canvas.box(canvas.panels[0])
    bottom, upper = canvas.panels[0].get_ylim()
    scale = (y1 - y0) / (upper - bottom)
    top, size = y0 - (high - upper) * scale, (high - low) * scale
    name = f"{key}-{canvas.variant.name[0]}"
    frame = f'x="{x0:.2f}" y="{y0:.2f}" width="{x1 - x0:.2f}" height="{y1 - y0:.2f}"'
    return (
        f'<mask id="{name}-k" maskUnits="userSpaceOnUse" {frame}>'
        f'<use href="#shared-{key}" transform="translate({x0:.2f} {top:.2f}) scale({x1 - x0:.2f} {size:.2f})"/></mask>'
        f'<rect {frame} mask="url(#{name}-k)" style="fill:var(--b5)"/>'
    )


def _level_keys(floor_db: float) -> tuple[Key, ...]:
    return tuple(Key(f"ink{i}", decibels(floor_db * (4 - i) / 4)) for i in range(5))
