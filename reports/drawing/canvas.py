"""Where a figure is drawn: panels at known places, axis titles, ticks, curves in the light page's colours.

matplotlib is used through its objects alone (no pyplot, no global state); one unit is one point of the SVG.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

from ridgeback.common.numbers import power_of_ten
from ridgeback.numeric.arrays import Array
from ridgeback.reports.drawing.scale import round_values, shared_power, tick_labels
from ridgeback.reports.drawing.theme import Variant, colour_of

LINE = 15.0
"""Height of a line of text."""
TOP, BOTTOM, LEFT, RIGHT, GAP = 26.0, 34.0, 46.0, 18.0, 34.0


@dataclass(frozen=True)
class Line:
    """One drawn curve: its values, its label, its colour token, and the class by which it is toggled."""

    x: Array
    y: Array
    label: str
    token: str
    width: float = 1.8
    dash: str | tuple[float, tuple[float, ...]] = "-"
    style: str = ""
    marker: str = ""
    order: float = 3.0


@dataclass
class Canvas:
    """One variant of one figure while it is drawn."""

    variant: Variant
    height: float | None = None
    figure: Figure = field(init=False)
    panels: list[Axes] = field(default_factory=list)

    def __post_init__(self) -> None:
        size = (self.variant.width, self.height or self.variant.height)
        self.figure = Figure(figsize=size, dpi=72)
        self.figure.patch.set_visible(False)

    def stack(self, shares: Sequence[float] = (1.0,), *, left: float = LEFT, gap: float = GAP) -> list[Axes]:
        """Make panels one above the other, of heights in proportion to ``shares``."""
        return self.grid(shares, 1, left=left, gap=gap)

    def grid(
        self,
        shares: Sequence[float],
        columns: int,
        *,
        left: float = LEFT,
        gap: float = GAP,
        right: float = RIGHT,
        above: float = 0.0,
    ) -> list[Axes]:
        """Make rows of panels below what stands ``above`` them, ``columns`` of equal width; row by row.

        Their heights are in proportion to ``shares``.
        """
        width, height = self.figure.get_size_inches() * 72
        cell = (width - (left + right) * columns) / columns
        usable = height - above - TOP - BOTTOM - gap * (len(shares) - 1)
        top = height - above - TOP
        for share in shares:
            size = usable * share / sum(shares)
            for column in range(columns):
                x0 = left + column * (cell + left + right)
                place = (x0 / width, (top - size) / height, cell / width, size / height)
                self.panels.append(dress(self.figure.add_axes(place)))
            top -= size + gap
        return self.panels


def heading(canvas: Canvas, lines: Sequence[str], *, left: float) -> None:
    """Write lines at the top of a figure, LINE points each."""
    width, height = canvas.figure.get_size_inches() * 72
    for i, words in enumerate(lines, start=1):
        canvas.figure.text(left / width, 1.0 - LINE * i / height, words, color=colour_of("fg"))


def dress(axes: Axes) -> Axes:
    """Give a panel the house style: grey frame left and below, horizontal grid, short ticks."""
    axes.patch.set_visible(False)
    for side in ("left", "bottom"):
        axes.spines[side].set_color(colour_of("muted"))
    axes.tick_params(color=colour_of("muted"), labelcolor=colour_of("fg"), width=0.8, length=3.5, pad=3)
    axes.grid(visible=True, axis="y", color=colour_of("grid"))
    return axes


def titles(axes: Axes, *, x: str, y: str) -> None:
    """Write the x title under the axis and the y title horizontally above it."""
    axes.set_xlabel(x, color=colour_of("fg"), labelpad=3)
    offset = axes.annotate(y, (0.0, 1.0), (-LEFT + 10.0, 9.0), xycoords="axes fraction", textcoords="offset points")
    offset.set_color(colour_of("fg"))


def linear(axes: Axes, axis: str, low: float, high: float, *, ticks: int = 6) -> None:
    """Set a linear axis with at most so many round ticks, a power of ten that they share beside them."""
    (axes.set_xlim if axis == "x" else axes.set_ylim)(low, high)
    values = round_values(low, high, ticks)
    power = shared_power(values)
    names = tick_labels(value / 10.0**power for value in values)
    (axes.set_xticks if axis == "x" else axes.set_yticks)(values, names)
    if power:
        corner, offset = ((1.0, 0.0), (0.0, -28.0)) if axis == "x" else ((0.0, 0.0), (-13.0, -14.0))
        beside = axes.annotate(
            f"× {power_of_ten(power)}", corner, offset, xycoords="axes fraction", textcoords="offset points", ha="right"
        )
        beside.set_color(colour_of("fg"))


def decades(axes: Axes, axis: str, low: float, high: float, *, ticks: int = 6) -> None:
    """Set a logarithmic axis from ``low`` to ``high`` with ticks at whole powers of ten."""
    (axes.set_xscale if axis == "x" else axes.set_yscale)("log")
    (axes.set_xlim if axis == "x" else axes.set_ylim)(low, high)
    chosen = axes.xaxis if axis == "x" else axes.yaxis
    chosen.set_major_locator(LogLocator(base=10.0, numticks=ticks))
    chosen.set_minor_locator(NullLocator())
    chosen.set_major_formatter(FuncFormatter(lambda value, _: power_of_ten(round(np.log10(value)))))


def draw(axes: Axes, line: Line) -> None:
    """Draw one curve."""
    (artist,) = axes.plot(
        line.x,
        line.y,
        color=colour_of(line.token),
        linewidth=line.width if not line.marker else 0.0,
        linestyle=line.dash,
        marker=line.marker or None,
        markersize=3.2,
        markeredgewidth=0.0,
        zorder=line.order,
    )
    if line.style:
        artist.set_gid(f"class:{line.style}")


def padded(values: Sequence[Array], *, share: float = 0.06) -> tuple[float, float]:
    """Return limits around all finite values with a margin."""
    joined = np.concatenate([np.ravel(v) for v in values] or [np.array([0.0, 1.0])])
    joined = joined[np.isfinite(joined)]
    if joined.size == 0:
        return 0.0, 1.0
    low, high = float(joined.min()), float(joined.max())
    margin = share * (high - low) or 0.05 * abs(high) or 0.5
    return low - margin, high + margin
