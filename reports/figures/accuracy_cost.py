"""Accuracy against cost: every contender on one motion, the page's first figure."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from functools import partial
from itertools import pairwise

import numpy as np

from ridgeback.common.numbers import listing, number, per_cent, power_of_ten, threshold
from ridgeback.compare.benchmark.contenders import WAYS, Row
from ridgeback.compare.benchmark.results import Benchmark
from ridgeback.compare.report.naming import refused_names, short_name, told
from ridgeback.reports.drawing.apart import apart, text_width
from ridgeback.reports.drawing.figure import NARROW, WIDE, Figure, toggles
from ridgeback.reports.drawing.marks import curve, dot, drawing, group, line, rect, text, trace
from ridgeback.reports.drawing.panel import Panel
from ridgeback.reports.drawing.scale import Scale
from ridgeback.reports.drawing.ticks import error_ticks, round_duration
from ridgeback.reports.figures.contending import (
    LEAST,
    LETTERS,
    NUMBERED,
    Shown,
    brief,
    error,
    least_drawn,
    shown,
)
from ridgeback.reports.figures.ranked import ranked_drawing

HEIGHT = 430.0
HEAD = 0.12
"""Share of the panel that its heading takes."""


def accuracy_cost(found: Benchmark, target: float) -> Figure:
    """The figure; without measured times it ranks the errors alone."""
    which = shown(found)
    timed = any(math.isfinite(which.cost(row)) for row in which.all)
    label = "Relative rms error of every contender" + (" against the cost of one track" if timed else "")
    letters = [letter for letter in "EST" if any(LETTERS[WAYS[row.kind]] == letter for row in which.all)]
    ranked = partial(ranked_drawing, which, target, label)
    return Figure(
        key="accuracy-cost",
        wide=_wide(which, target, label) if timed else ranked(WIDE, timed=False),
        narrow=ranked(NARROW, timed=timed),
        caption=_caption(which, target, timed=timed),
        leads=_leads(found, timed=timed),
        toggles=toggles(*letters, series=bool(which.terms)),
        label=label,
        table="contenders",
    )


def _leads(found: Benchmark, *, timed: bool) -> tuple[str, str]:
    """How the wide drawing is read, and how the narrow one."""
    floor = found.reference.floor
    shaded = f" Shaded: below {per_cent(floor)}, where {found.reference.open_words}." if floor > 0.0 else ""
    narrow = f"Left: error, right: cost; further left is better in both.{shaded}"
    return ("Further down is closer, further left is cheaper.", narrow) if timed else (f"Left is closer.{shaded}",) * 2


def _caption(which: Shown, target: float, *, timed: bool) -> str:
    found = which.found
    low, high = (number(x, 3) for x in found.support)
    span = f"{low} to {high} {found.case.time_unit}".strip()
    parts = [f"Rms error relative to the {found.reference.label}, t = {span}."]
    if timed and _beyond_the_top(which, target):
        parts.append("At the edge of the largest errors: off scale.")
    if which.expansions and which.expansions[0].amplitude_from == "action":
        parts.append("Expansions and series take A(t) from the averaged action, whose own cost is not counted.")
    if which.resummed:
        parts.append(f"Dots apart: resummed ({listing([brief(row) for row in which.resummed])}).")
    if which.corrected:
        parts.append("Open, and corr.: an estimate with the bias of its own track removed.")
    missing = [row for row in found.contenders if row.refused]
    if missing:
        parts.append(f"No result from {refused_names(missing)}; the table says why.")
    return " ".join(parts)


def _beyond_the_top(which: Shown, target: float) -> bool:
    """Whether an error is too large for the wide drawing, so that its mark stands at the edge."""
    top = _panel(which, target).y.high
    return any(error(row) > top for row in which.all if math.isfinite(which.cost(row)))


# --- the wide drawing


def _wide(which: Shown, target: float, label: str) -> str:
    panel = _panel(which, target)
    marks = [
        *_frame(which, panel, target),
        *_families(which, panel, _height_of(panel, target)),
        *_estimates(which, panel, _height_of(panel, target)),
    ]
    return drawing(WIDE, HEIGHT, "wide", label, marks)


def _height_of(panel: Panel, target: float) -> float | None:
    """Where the target is drawn; None outside the panel."""
    return panel.y(target) if panel.y.low < target < panel.y.high else None


def _panel(which: Shown, target: float) -> Panel:
    """Scales around all points; a target near the top gets room above it for the words that stand there."""
    rows = [row for row in which.all if math.isfinite(which.cost(row))]
    costs, errors = [which.cost(row) for row in rows], [error(row) for row in rows]
    floor = which.found.reference.floor
    low, high = max(min(*errors, max(floor, LEAST)), least_drawn(floor)), min(max(errors), 30.0)
    span = high / low
    low, high = max(low / max(span**0.11, 2.2), least_drawn(floor)), high * max(span**0.14, 2.2)
    if low < target < high < target * (target / low) ** (HEAD / (1.0 - HEAD)):
        high = target * (target / low) ** (HEAD / (1.0 - HEAD))
    x = Scale(0.4 * min(costs), 4.0 * max(costs), 70.0, 968.0, log=True)
    return Panel(x, Scale(low, high, 384.0, 48.0, log=True))


def _frame(which: Shown, panel: Panel, target: float) -> Iterable[str]:
    found, count = which.found, which.found.time.size
    floor = found.reference.floor
    if floor > panel.y.low:
        top = panel.y(min(floor, panel.y.high))
        yield rect(panel.left, top, panel.right - panel.left, panel.bottom - top)
    ticks = panel.y.ticks(9)
    yield panel.rows(ticks, label=error_ticks(ticks))
    for value in panel.x.ticks(9):
        yield line(panel.x(value), panel.bottom, panel.x(value), panel.bottom + 5, "ax")
        yield text(panel.x(value), panel.bottom + 19, round_duration(value), "m", "middle")
    above = Scale(panel.x.low / count, panel.x.high / count, panel.left, panel.right, log=True)
    for value in above.ticks(9):
        yield line(above(value), 44, above(value), 39, "ax")
        yield text(above(value), 34, round_duration(value), "m", "middle")
    yield line(panel.left, panel.bottom, panel.right, panel.bottom, "ax") + line(panel.left, 44, panel.right, 44, "ax")
    yield text(0, 12, "relative rms error of ω₀(t)", "m") + text(panel.right, 12, "cost per value", "m", "end")
    yield text(panel.right, HEIGHT - 10, f"cost of one track of {count} values", "m", "end")
    if panel.y.low < target < panel.y.high:
        yield line(panel.left, panel.y(target), panel.right, panel.y(target), "tg")
        y = panel.y(target)
        free = y - 5 > panel.top + 30 or y < panel.top + 4
        place = y - 5 if free else max(y, panel.top + 18) + 15
        yield group([text(panel.right, place, f"target {_target(target, ticks)}", "m sm", "end")], "halo")
    if floor > panel.y.low:
        words = f"below {per_cent(floor)} {found.reference.open_words}"
        formulas = (*which.expansions, *which.in_python)
        low = [x for x, y, _ in _places(which, panel, formulas) if y > panel.bottom - 26]
        clear = all(x > panel.left + text_width(words, 12.6) + 16 for x in low)
        x = panel.left + 8 if clear else 0.3 * (panel.left + panel.right)
        yield group([text(x, panel.bottom - 8, words, "m sm")], "halo")


def _target(target: float, ticks: Sequence[float]) -> str:
    """The target, as a power of ten too where the axis is written so."""
    exponent = round(math.log10(target))
    whole = math.isclose(target, 10.0**exponent, rel_tol=1e-9) and error_ticks(ticks)(target) == power_of_ten(exponent)
    return threshold(target) + (f", {power_of_ten(exponent)}" if whole and "%" in threshold(target) else "")


def _places(which: Shown, panel: Panel, rows: Sequence[Row]) -> list[tuple[float, float, Row]]:
    return [(panel.x(which.cost(r)), float(panel.y.clipped(np.array([error(r)]))[0]), r) for r in rows]


def _title(which: Shown, row: Row) -> str:
    return told(row, which.found.reference, which.cost(row))


def _chain(which: Shown, panel: Panel, rows: Sequence[Row], style: str, *, dashed: bool = False) -> str:
    at = _places(which, panel, rows)
    if not at:
        return ""
    x, y = (np.array([p[i] for p in at]) for i in (0, 1))
    stroke = curve(x, y, f"{style}d nf" if dashed else f"{style}l th")
    filled = style if not dashed else f"{style}o"
    return stroke + "".join(dot(a, b, 3.0 if dashed else 4.0, filled, _title(which, row)) for a, b, row in at)


Placed = tuple[float, float, str, str]
"""Place, words and anchor of a label."""


def _numbers(which: Shown, panel: Panel, rows: Sequence[Row], *, left: bool = False) -> list[Placed]:
    """The numbers of some orders or terms beside their points, or above where the next point stands there."""
    wanted = [row for row in rows if row.order in NUMBERED or len(rows) < 7]
    taken: list[tuple[float, float]] = []
    found: list[Placed] = []
    everywhere = _places(which, panel, rows)
    for x, y, row in _places(which, panel, wanted):
        if all(abs(x - a) > 20 or abs(y - b) > 12 for a, b in taken):
            taken.append((x, y))
            side = -1 if left else 1
            crowded = any(0 < side * (a - x) < 32 and abs(b - y) < 5 for a, b, _ in everywhere)
            beside = (x + 9 * side, y + 4, str(row.order), "end" if left else "start")
            found.append((x, y - 9, str(row.order), "middle") if crowded else beside)
    return found


def _families(which: Shown, panel: Panel, line_at: float | None) -> Iterable[str]:
    e = [_chain(which, panel, which.in_python, "e", dashed=True), _chain(which, panel, which.expansions, "e")]
    e += [_chain(which, panel, which.flows, "e", dashed=True)]
    resummed = _finite(_places(which, panel, which.resummed))
    e += [dot(x, y, 4.0, "e", _title(which, row)) for x, y, row in resummed]
    numbers = _numbers(which, panel, which.expansions, left=True)
    words = [text(x, y, number_, "e", anchor) for x, y, number_, anchor in numbers]
    native = any(row.language == "c" for row in which.expansions)
    name = f"expansions{' in C' if native else ''}"
    words += _named(which, panel, which.expansions, "e b", name, line_at=line_at, clear=numbers)
    below = _name_is_below(_places(which, panel, which.expansions), panel)
    words += _named(which, panel, which.in_python, "e sm", "in Python", last=True, down=17.0 * below)
    words += [_named_point(which, panel, x, y, brief(r)) for x, y, r in resummed if r is which.best_resummed]
    words += _named(which, panel, which.flows, "e sm", "multiple scales", line_at=line_at)
    yield group([*e, group(words, "halo")], "fE")
    s = [_chain(which, panel, which.terms, "s")]
    exact = [place for place in _places(which, panel, which.exact) if math.isfinite(place[0])]
    s += [dot(x, y, 4.5, "s", _title(which, row)) for x, y, row in exact]
    words = [text(x, y, number_, "s", anchor) for x, y, number_, anchor in _numbers(which, panel, which.terms)]
    words += _named(which, panel, which.terms, "s b", "paper’s series, by terms")
    for x, y, row in exact if not _crowded(which, panel) else ():
        struck = line_at is not None and abs(y - line_at) < 11
        words.append(text(x - 9, (line_at or 0.0) + 17 if struck else y + 4, _exact_name(row), "s", "end"))
    yield group([*s, group(words, "halo")], "fS")


def _named_point(which: Shown, panel: Panel, x: float, y: float, name: str) -> str:
    """A point's name at its right, left, above or below it: where it covers least of the marks and of other names."""
    wide = 1.2 * text_width(name)
    spots = [(x + 9, y + 4, "start"), (x - 9, y + 4, "end"), (x - 6, y - 10, "start"), (x - 6, y + 20, "start")]
    taken = [(a - 5, b - 5, a + 5, b + 5) for a, b, _ in _finite(_places(which, panel, which.all)) if (a, b) != (x, y)]
    at = _finite(_places(which, panel, which.estimates))
    if at:
        edge, heights = _column(which, panel, at)
        names = [text_width(short_name(row)) for _, _, row in at]
        taken += [(edge - w, h - 8, edge + 4, h + 8) for w, h in zip(names, heights, strict=True)]

    def covered(spot: tuple[float, float, str]) -> int:
        left, foot = spot[0] - (wide if spot[2] == "end" else 0.0), spot[1]
        out = left < panel.left or foot > panel.bottom - 4
        return 99 * out + sum(a < left + wide and left < c and b < foot + 3 and foot - 12 < d for a, b, c, d in taken)

    a, b, anchor = min(spots, key=covered)
    return text(a, b, name, "e b", anchor)


def _exact_name(row: Row) -> str:
    return f"{short_name(row)} at A(t) by energy"


def _crowded(which: Shown, panel: Panel) -> bool:
    """Whether the name of the exact frequency has no room at its left: it then stands among those of the estimates."""
    at = _finite(_places(which, panel, which.estimates))
    if not at:
        return False
    edge, heights = _column(which, panel, at)
    boxes = [(edge - text_width(short_name(row)), h, edge + 14) for (_, _, row), h in zip(at, heights, strict=True)]
    boxes += [(x - 8, y, x + 8) for x, y, _ in at]
    boxes += [(x - 6, y, x + 6) for x, y, _ in _finite(_places(which, panel, (*which.expansions, *which.flows)))]
    return any(
        x - 13 - text_width(_exact_name(row)) < right and x + 8 > left and abs(y - height) < 17
        for x, y, row in _finite(_places(which, panel, which.exact))
        for left, height, right in boxes
    )


def _finite(at: Sequence[tuple[float, float, Row]]) -> list[tuple[float, float, Row]]:
    return [place for place in at if math.isfinite(place[0])]


def _column(which: Shown, panel: Panel, at: Sequence[tuple[float, float, Row]]) -> tuple[float, list[float]]:
    """Where names that stand left of all points end, and how high each stands; left of the slow flows' curve, too."""
    heights = apart([y for _, y, _ in at], 16.0, panel.top + 34, panel.bottom - 30)
    edge = min(x for x, _, _ in at) - 26
    flows = _finite(_places(which, panel, which.flows))
    names = [text_width(_exact_name(row) if row.kind == "closed-form" else short_name(row)) for _, _, row in at]
    met = any(_passes(flows, height, edge - wide, edge + 4) for wide, height in zip(names, heights, strict=True))
    return (min(edge, min(x for x, _, _ in flows) - 26) if met else edge), heights


def _passes(curve: Sequence[tuple[float, float, Row]], height: float, left: float, right: float) -> bool:
    """Whether a curve goes through a name of a height, between its ends."""
    for (a, b, _), (c, d, _) in pairwise(curve):
        along = np.linspace(0.0, 1.0, 50)
        x, y = a + (c - a) * along, b + (d - b) * along
        if bool(np.any((np.abs(y - height) < 10.0) & (x > left - 6.0) & (x < right + 6.0))):
            return True
    return False


def _name_is_below(at: Sequence[tuple[float, float, Row]], panel: Panel) -> bool:
    """Whether a family reaches so far up that its name stands below it."""
    return min((y for _, y, _ in at), default=panel.bottom) < panel.top + 20


def _named(
    which: Shown,
    panel: Panel,
    rows: Sequence[Row],
    style: str,
    name: str,
    *,
    last: bool = False,
    down: float = 0.0,
    line_at: float | None = None,
    clear: Sequence[Placed] = (),
) -> list[str]:
    """The name of a family above its highest point, or below its last; clear of a line at a height, and of labels."""
    at = [p for p in _places(which, panel, rows) if math.isfinite(p[0])]
    if not at:
        return []
    if last:
        x, y, _ = max(at, key=lambda p: p[1])
        if y + 17 + down < panel.bottom - 22:
            return [text(x + 9, y + 17 + down, name, style)]
        return [text(max(p[0] for p in at) + 10, y + 4, name, style)]
    x, y, _ = min(at, key=lambda p: p[1])
    if _name_is_below(at, panel):
        x, y, _ = max(at, key=lambda p: p[1])
        return [text(max(x - 12, panel.left + 4), min(y + 20, panel.bottom - 22), name, style)]
    if line_at is not None and abs(y - 15 - line_at) < 9:
        return [text(*((x - 12, line_at - 7) if style == "e b" else (x + 10, y + 4)), name, style)]
    left = max(x - 12, panel.left + 4)
    met = any(left - 16 < a < left + text_width(name) + 8 and abs(b - y + 10) < 12 for a, b, _, _ in clear)
    return [text(left, y - (25 if met else 10), name, style)]


def _estimates(which: Shown, panel: Panel, target: float | None) -> Iterable[str]:
    """Estimates with their names at the left, clear of the line of the target."""
    at = _finite(_places(which, panel, which.estimates))
    if not at:
        return
    at += _finite(_places(which, panel, which.exact)) if _crowded(which, panel) else ()
    own = {row.method.removesuffix("-corrected"): (x, y, row) for x, y, row in _places(which, panel, which.corrected)}
    edge, heights = _column(which, panel, at)
    best = which.estimates[0].method
    parts, words, exact = [], [], []
    for (x, y, row), height in zip(at, heights, strict=True):
        name = short_name(row)
        led = max(edge + 14, min(x - 34, min(a for a, _, r in at if r.kind == "estimate") - 12))
        if row.kind != "estimate":
            exact += [
                trace("sk nf", "M", edge + 4, height, "H", edge + 14, "L", x, y),
                dot(x, y, 4.5, "s", _title(which, row)),
            ]
            exact += _behind(edge, height, _exact_name(row), target)
            exact.append(group([text(edge, height + 4, _exact_name(row), "s", "end")], "halo"))
            continue
        parts.append(trace("tk nf", "M", edge + 4, height, "H", led, "L", x, y))
        if row.method in own and math.isfinite(own[row.method][0]):
            a, b, bare = own[row.method]
            parts.append(trace("tt nf", "M", x, y, "L", a, b))
            parts.append(dot(a, b, 3.6, "to", _title(which, bare)))
        parts.append(dot(x, y, 4.5, "t", _title(which, row)))
        words += _behind(edge, height, name, target)
        words.append(text(edge, height + 4, name, "t b" if row.method == best else "t", "end"))
    head = text(panel.right, panel.top + 16, f"estimates from {which.found.time.size} samples", "t b", "end")
    yield group([*parts, group([head, *words], "halo")], "fT")
    yield group(exact, "fS") if exact else ""


def _behind(edge: float, height: float, name: str, target: float | None) -> list[str]:
    """What hides the line of the target behind a name that ends at an edge."""
    wide = text_width(name)
    return (
        [] if target is None or abs(height - target) >= 10 else [rect(edge - wide - 2, height - 8, wide + 4, 16, "bgf")]
    )
