"""A panel: two scales with their grid, ticks and titles, and curves drawn in it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from ridgeback.common.numbers import power_of_ten
from ridgeback.numeric.arrays import Array
from ridgeback.reports.drawing.marks import curve, line, places, rect, text
from ridgeback.reports.drawing.scale import Scale, shared_power, tick_labels

Labelled = Callable[[float], str]


@dataclass(frozen=True)
class Panel:
    """A rectangle of a drawing with a scale in each direction."""

    x: Scale
    y: Scale

    @property
    def left(self) -> float:
        """Left edge."""
        return self.x.start

    @property
    def right(self) -> float:
        """Right edge."""
        return self.x.end

    @property
    def top(self) -> float:
        """Upper edge."""
        return self.y.end

    @property
    def bottom(self) -> float:
        """Lower edge."""
        return self.y.start

    def rows(self, ticks: Sequence[float] | None = None, *, label: Labelled | None = None, most: int = 5) -> str:
        """Horizontal grid lines with their values at the left, a power of ten that they share below them."""
        values = self.y.ticks(most) if ticks is None else ticks
        power = shared_power(values) if label is None else 0
        names = tick_labels(v / 10.0**power for v in values) if label is None else [label(v) for v in values]
        marks = [
            line(self.left, self.y(v), self.right, self.y(v)) + text(self.left - 7, self.y(v) + 4, name, "m", "end")
            for v, name in zip(values, names, strict=True)
        ]
        if power:
            marks.append(text(self.left - 20, self.bottom + 19, f"× {power_of_ten(power)}", "m", "end"))
        return "".join(marks)

    def columns(
        self, ticks: Sequence[float] | None = None, *, label: Labelled | None = None, most: int = 6, unit: str = ""
    ) -> str:
        """Ticks below with their values, the last with a unit."""
        values = self.x.ticks(most) if ticks is None else ticks
        names = tick_labels(values) if label is None else [label(v) for v in values]
        base = line(self.left, self.bottom, self.right, self.bottom, "ax")
        title = text((self.left + self.right) / 2, self.bottom + 36, unit, "m", "middle") if unit else ""
        return base + self.named_columns(values, names) + title

    def named_columns(self, ticks: Sequence[float], names: Sequence[str]) -> str:
        """Ticks below with their names, which the page's script writes anew where the axis is stretched."""
        marks = (
            line(self.x(v), self.bottom, self.x(v), self.bottom + 5, "ax")
            + text(self.x(v), self.bottom + 19, name, "m", "middle")
            for v, name in zip(ticks, names, strict=True)
        )
        edges = " ".join(places(v) for v in (self.left, self.right, self.bottom))
        return f'<g class="xt" data-x="{edges}">{"".join(marks)}</g>'

    def zooming(self, marks: Iterable[str]) -> str:
        """Marks without text whose x axis a pointer may stretch: a drawing of its own, which shows all at first."""
        x, y, width, height = (places(v) for v in (self.left, self.top, self.right - self.left, self.bottom - self.top))
        place = f'x="{x}" y="{y}" width="{width}" height="{height}" style="width:{width}px;height:{height}px"'
        view = f'viewBox="{x} {y} {width} {height}" preserveAspectRatio="none"'
        return f'<svg class="z" {place} {view}>{"".join(marks)}</svg>'

    def curve(self, x: Array, y: Array, kind: str) -> str:
        """A curve; what lies outside is drawn at the edge."""
        return curve(self.x.of(x), self.y.clipped(y), kind)

    def shaded(self, low: float, high: float, kind: str = "band") -> str:
        """A vertical band."""
        a, b = sorted((self.x(low), self.x(high)))
        a, b = max(a, self.left), min(b, self.right)
        return rect(a, self.top, b - a, self.bottom - self.top, kind) if b > a else ""

    def box(self) -> list[float]:
        """Place and ranges, as the page's script takes them."""
        x, y = self.x, self.y
        return [*(round(v, 1) for v in (self.left, self.top, self.right, self.bottom)), x.low, x.high, y.low, y.high]
