"""Order against amplitude: the backbone above, the map of errors below it, the observed order beside it."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from ridgeback.common.numbers import number, per_cent, rounded_down, threshold, uncertain
from ridgeback.compare.motion.results import MotionComparison
from ridgeback.compare.report.error_grid import ErrorGrid
from ridgeback.compare.study.results import Range, Study
from ridgeback.numeric.arrays import Array
from ridgeback.reports.drawing import cells
from ridgeback.reports.drawing.apart import text_width
from ridgeback.reports.drawing.figure import NARROW, WIDE, Figure
from ridgeback.reports.drawing.marks import dot, drawing, group, line, places, text, trace
from ridgeback.reports.drawing.panel import Panel
from ridgeback.reports.drawing.scale import ROUNDING, Scale, padded, tick_labels
from ridgeback.reports.figures.clock import Clock

KINDS = {1e-2: "c1", 1e-3: "c2", 1e-6: "c3"}
DASHES = {"c1": "solid", "c2": "dashed", "c3": "dotted"}
LIMITS = (1e-6, 1e-4, 1e-3, 1e-2, 1e-1)
TALL, FLAT = 290.0, 60.0
"""Height of the map, and of one whose cells are all alike."""


def letter(study: Study) -> str:
    """What the study goes over."""
    return "A" if study.variable == "A" else "ε"


def order_map(study: Study, grid: ErrorGrid, finding: Range, decay: MotionComparison | None) -> Figure:
    """The figure with the place of the sliders marked."""
    clock = Clock("" if decay is None else decay.case.time_unit)
    label = "Backbone above; relative error over order and amplitude in six bands below"
    observed = any(np.isfinite(powers).any() for _, _, powers in grid.observed)
    row = grid.orders.index(finding.order) if finding.order in grid.orders else len(grid.orders) - 1
    inside = grid.amplitudes <= (finding.up_to or grid.amplitudes[0])
    start = (row, max(int(np.count_nonzero(inside)) - 1, 0))
    spots = tuple(_layout(study, grid, narrow=narrow, observed=observed) for narrow in (False, True))
    return Figure(
        key="order-map",
        wide=_draw(study, grid, start, decay, spots[0], label, narrow=False),
        narrow=_draw(study, grid, start, decay, spots[1], label, narrow=True),
        caption=_caption(study, grid, observed),
        keys=tuple(_keys()),
        data={**_data(study, grid, start, spots), "factor": clock.factor, "frequency_unit": clock.unit},
        label=label,
    )


def _caption(study: Study, grid: ErrorGrid, observed: bool) -> str:
    name = letter(study)
    count = f"{len(grid.orders)} × {grid.amplitudes.size} cells"
    if grid.certified:
        known = f"enclosed in ball arithmetic at the {name} of each cell: the value of the generated code, to the bit"
    else:
        worst = float(np.nanmax(study.reference_error))
        known = f"against the {study.reference_name}, itself known to {per_cent(worst)}"
    text_ = f"|relative error of ω₀| in {count}, {known}.{_lines(grid)}"
    if observed:
        low, high = grid.observed[0][:2], grid.observed[1][:2]
        text_ += (
            f" Right: the power of A with which the enclosed error grows, less n (filled: A from {number(low[0], 2)} "
            f"to {number(low[1], 2)}; open: {number(high[0], 2)} to {number(high[1], 2)})."
        )
    if study.convergence_radius:
        open_ = study.convergence_uncertainty or 0.0
        exact = open_ <= ROUNDING * study.convergence_radius
        radius = number(study.convergence_radius) if exact else uncertain(study.convergence_radius, open_)
        text_ += f" The series converges for {name} below {radius}."
    return text_


def _lines(grid: ErrorGrid) -> str:
    """Which lines are drawn, where any is."""
    size = np.where(np.isfinite(grid.bounds), np.abs(grid.errors), np.nan)
    drawn = [level for level in KINDS if bool((size <= level).any()) and not bool((size <= level).all())]
    words = ", ".join(f"{100 * level:.6g} % {DASHES[KINDS[level]]}" for level in drawn)
    return f" Lines follow cells, none interpolated: {words}." if drawn else ""


def _keys() -> Iterable[tuple[str, str]]:
    for i, limit in enumerate(LIMITS):
        yield f"b{i}", f"to {100 * limit:.6g} %"
    yield "b5", "above 10 %"


def _layout(study: Study, grid: ErrorGrid, *, narrow: bool, observed: bool) -> tuple[Panel, Panel]:
    left = 36.0 if narrow else 70.0
    right = (300.0 if observed else 362.0) if narrow else (836.0 if observed else 990.0)
    x_edges = edges(grid)
    x = Scale(float(x_edges[0]), float(x_edges[-1]), left, right)
    low, high = padded([grid.exact / study.scale], share=0.15)
    room = 0.6 * (high - low)
    upper = Panel(x, Scale(low - 0.2 * room, high + 0.2 * room, 150.0, 24.0))
    return upper, Panel(x, Scale(0.0, float(len(grid.orders)), 190.0 + (FLAT if _flat(grid) else TALL), 190.0))


def _flat(grid: ErrorGrid) -> bool:
    """Whether all orders are in the best band at every amplitude."""
    return bool(np.isfinite(grid.bounds).all() and (np.abs(grid.errors) <= LIMITS[0]).all())


def edges(grid: ErrorGrid) -> Array:
    """Edges of the cells in amplitude."""
    return np.maximum(cells.edges(grid.amplitudes), 0.0)


def _draw(
    study: Study,
    grid: ErrorGrid,
    start: tuple[int, int],
    decay: MotionComparison | None,
    spots: tuple[Panel, Panel],
    label: str,
    *,
    narrow: bool,
) -> str:
    upper, lower = spots
    natural = f"ω₀ / k, natural frequency k = {number(study.scale)}"
    marks = [text(0, 11, natural if study.scale != 1 else "ω₀", "m"), upper.rows(most=4)]
    marks += [line(upper.left, upper.bottom, upper.right, upper.bottom, "ax")]
    marks += [upper.curve(grid.amplitudes, grid.exact / study.scale, "rf nf")]
    held = np.where(_inside(upper, grid.values[start[0]] / study.scale), grid.values[start[0]] / study.scale, np.nan)
    moving = upper.curve(grid.amplitudes, held, "el nf") or '<path d="" class="el nf"/>'
    marks += [group([moving], "moving"), *_names(study, grid, upper)]
    marks += [*_map(grid, lower), *_axes(study, grid, lower, narrow=narrow), *_motion(study, decay, lower)]
    if any(np.isfinite(powers).any() for _, _, powers in grid.observed):
        marks += _observed(grid, lower, narrow=narrow)
    marks.append(_marker(upper, lower, start[0], float(grid.amplitudes[start[1]])))
    height = lower.bottom + 54
    return drawing(NARROW if narrow else WIDE, height, "narrow" if narrow else "wide", label, marks)


def _inside(panel: Panel, values: Array) -> Array:
    return np.asarray((values >= panel.y.low) & (values <= panel.y.high))


def _names(study: Study, grid: ErrorGrid, panel: Panel) -> list[str]:
    """Names of the two curves in the corner that they leave free, each behind a piece of its line."""
    falling = grid.exact[-1] < grid.exact[0]
    y = panel.bottom - 22 if falling else panel.top + 14
    x = panel.left + 14
    exact = "exact, enclosed" if grid.certified else study.reference_name
    first = [f'<path d="M{places(x)} {places(y - 4)}h22" class="rf nf"/>', text(x + 28, y, exact, "fgt")]
    second = [
        f'<path d="M{places(x)} {places(y + 13)}h22" class="el nf"/>',
        text(x + 28, y + 17, "order chosen below", "e"),
    ]
    return [group([*first, *second], "halo")]


def _map(grid: ErrorGrid, panel: Panel) -> Iterable[str]:
    size = np.where(np.isfinite(grid.bounds), np.abs(grid.errors), np.nan)
    x = panel.x.of(edges(grid))
    y = panel.y.of(np.arange(len(grid.orders) + 1.0))
    for band, path in cells.rectangles(cells.bands(size), x, y).items():
        yield f'<path d="{path}" class="{f"b{band}" if band >= 0 else "band"}"/>'
    for level, kind in KINDS.items():
        path = cells.outline(cells.staircase(size <= level), x, y)
        if path:
            yield f'<path d="{path}" class="cc nf"/><path d="{path}" class="{kind} nf"/>'


def _axes(study: Study, grid: ErrorGrid, panel: Panel, *, narrow: bool) -> Iterable[str]:
    last = -100.0
    for i, order in enumerate(grid.orders):
        y = panel.y(i + 0.5)
        if i in (0, len(grid.orders) - 1) or (order % 10 == 0 and abs(y - last) > 16):
            last = y
            yield line(panel.left - 4, y, panel.left, y, "ax") + text(panel.left - 8, y + 4, str(order), "m", "end")
    for value, name in _ticks(study, panel, narrow=narrow):
        yield line(panel.x(value), panel.bottom, panel.x(value), panel.bottom + 5, "ax")
        yield text(panel.x(value), panel.bottom + 19, name, "m", "middle")
    middle = (panel.left + panel.right) / 2
    unit = f", {study.amplitude_unit}" if study.amplitude_unit else ""
    title = f"{study.amplitude_definition} amplitude A{unit}" if study.variable == "A" else "ε"
    yield text(middle, panel.bottom + 38, title, "m", "middle")
    yield text(0, panel.top - (24 if narrow else 10), "order n", "m")


def _ticks(study: Study, panel: Panel, *, narrow: bool) -> Iterable[tuple[float, str]]:
    """Multiples of pi / 4 for an angle, else round values."""
    if study.amplitude_unit == "rad" and panel.x.high > 1.2:
        names = {0: "0", 1: "π/4", 2: "π/2", 3: "3π/4", 4: "π"}
        return [(n * math.pi / 4, name) for n, name in names.items() if panel.x.low <= n * math.pi / 4 <= panel.x.high]
    values = panel.x.ticks(4 if narrow else 8)
    return list(zip(values, tick_labels(values), strict=True))


def _motion(study: Study, decay: MotionComparison | None, panel: Panel) -> Iterable[str]:
    """The amplitudes that the motion passes, or its own eps."""
    if decay is None:
        return
    if study.variable == "A":
        passed = decay.amplitudes.energy
        low, high = float(np.nanmin(passed)), float(np.nanmax(passed))
    else:
        own = [v for name, v in decay.case.parameters.items() if name in ("eps", "epsilon")]
        if not own:
            return
        low = high = own[0]
    a, b = (min(max(panel.x(v), panel.left), panel.right) for v in (low, high))
    y = panel.top - 8
    b = max(b, a + 1)
    yield trace("ann nf", "M", a, y, "H", b, "M", b, y - 4, "v", 8.0, "M", a, y - 4, "v", 8.0)
    free = text_width("this motion", 12.6) + 12
    if a > panel.left + free:
        yield text(a - 6, y + 4, "this motion", "m sm", "end")
    elif b < panel.right - free:
        yield text(b + 6, y + 4, "this motion", "m sm")
    else:
        yield group([text((a + b) / 2, y + 4, "this motion", "m sm", "middle")], "halo")


def _observed(grid: ErrorGrid, panel: Panel, *, narrow: bool) -> Iterable[str]:
    """The power of each order's error less the order itself, on a common scale."""
    excess = [powers - np.array(grid.orders) for _, _, powers in grid.observed]
    finite = np.concatenate([e[np.isfinite(e)] for e in excess])
    low, high = float(np.floor(finite.min() - 0.2)), float(np.ceil(finite.max() + 0.2))
    high = min(high, low + 8)
    left = panel.right + (18 if narrow else 46)
    x = Scale(low, max(high, low + 2), left, (NARROW if narrow else WIDE) - 10)
    step = 1 + int(x.high - x.low) // (3 if not narrow else 2)
    for value in range(int(x.low), int(x.high) + 1):
        if value % step:
            continue
        name = f"n+{value}" if value > 0 else f"n{value}".replace("-", "−") if value else "n"
        yield line(x(value), panel.top, x(value), panel.bottom, "g")
        yield text(x(value), panel.bottom + 19, name, "m sm", "middle")
    yield text(x.end, panel.top - 8, "order seen" if narrow else "observed order", "m sm", "end")
    for kind, values in zip(("e", "eo"), excess, strict=False):
        for i, value in enumerate(values):
            if np.isfinite(value) and x.low <= value <= x.high:
                yield dot(x(float(value)), panel.y(i + 0.5), 3.0, kind)


def _marker(upper: Panel, lower: Panel, row: int, amplitude: float) -> str:
    x, y = lower.x(amplitude), lower.y(row + 0.5)
    cross = trace("mh", "M", lower.left, y, "H", lower.right, "M", x, upper.top, "V", lower.bottom)
    return group([cross, dot(x, y, 6.0, "")], "mk")


def _data(
    study: Study, grid: ErrorGrid, start: tuple[int, int], spots: tuple[tuple[Panel, Panel], ...]
) -> dict[str, object]:
    """What the sliders need: amplitudes to the bit, bounds as certain as printed, signs, and where the panels are."""
    scale = grid.scale
    return {
        "map": True,
        "orders": list(grid.orders),
        "amplitudes": grid.amplitudes.tolist(),
        "bounds": [[_up(v) for v in row] for row in grid.bounds.tolist()],
        "signs": ["".join("+" if e > 0 else "-" for e in row) for row in grid.errors.tolist()],
        "k": scale,
        "scale": study.scale,
        "certified": grid.certified,
        "letter": letter(study),
        "unit": study.amplitude_unit,
        "start": list(start),
        "boxes": [[panel.box() for panel in group_] for group_ in spots],
    }


def _up(value: float) -> float | None:
    """Three digits, rounded up, so that what is printed still holds."""
    if not math.isfinite(value):
        return None
    if value == 0:
        return 0.0
    power = 10.0 ** (math.floor(math.log10(value)) - 2)
    rounded = float(f"{math.ceil(value / power * (1 - 1e-12)) * power:.3g}")
    return rounded if rounded >= value * (1 - 1e-12) else float(f"{rounded + power:.3g}")


def reach_sentence(study: Study, target: float, order: int, up_to: float | None) -> str:
    """How far the chosen order holds, as a heading."""
    name = letter(study)
    if np.ptp(study.reference) <= ROUNDING * abs(float(study.reference[0])):
        return f"ω₀ is the same at every {name} studied"
    if up_to is None:
        return f"Order {order} keeps {threshold(target)} at no {name} studied"
    end = f"{name} = {three_digits(rounded_down(up_to, 3))} {study.amplitude_unit}".strip()
    if up_to >= study.amplitudes[-1]:
        return f"Order {order} keeps {threshold(target)} over all of the range studied, to {end}"
    return f"Order {order} keeps {threshold(target)} up to {end}"


def three_digits(value: float) -> str:
    """A limit with as many digits as those beside it have.

    >>> three_digits(1.2), three_digits(0.956), three_digits(12.0), three_digits(2e-7)
    ('1.20', '0.956', '12.0', '2 × 10⁻⁷')
    """
    return f"{value:#.3g}" if 1e-3 <= value < 100.0 else number(value, 3)
