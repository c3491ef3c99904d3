"""omega0(t) of the leading contenders over the reference, and their running errors below."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from ridgeback.common.numbers import listing, number, per_cent
from ridgeback.compare.benchmark.contenders import WAYS, Row
from ridgeback.compare.benchmark.crossings import running_rms
from ridgeback.compare.benchmark.results import Benchmark
from ridgeback.compare.motion.results import MotionComparison
from ridgeback.compare.report.naming import at_most, written_of
from ridgeback.numeric.arrays import Array
from ridgeback.reports.drawing.apart import apart, text_width
from ridgeback.reports.drawing.figure import NARROW, WIDE, Figure, Series, readout, toggles
from ridgeback.reports.drawing.marks import drawing, group, line, places, rect, text
from ridgeback.reports.drawing.panel import Panel
from ridgeback.reports.drawing.scale import Scale, padded
from ridgeback.reports.drawing.ticks import error_ticks, per_cent_tick
from ridgeback.reports.figures.clock import Clock, shown
from ridgeback.reports.figures.contending import LETTERS, PER_CENT_ENDS, STYLE, brief, least_drawn
from ridgeback.reports.figures.contending import shown as contending

DASHES = ("", "d1", "d2", "d3")
LEAST, MOST = 1e-15, 3.0


@dataclass(frozen=True)
class Drawn:
    """One contender along the motion."""

    row: Row
    letter: str
    dash: str
    omega: Array
    error: Array
    """Running rms over a cycle."""

    @property
    def style(self) -> str:
        """Classes of its curve."""
        return f"{STYLE[self.letter]}l {self.dash} nf".replace("  ", " ")


def chosen(found: Benchmark) -> list[Row]:
    """At most nine rows that tell the story: few and many orders, few and many terms, estimates raw and corrected."""
    which = contending(found)
    orders = {row.order: row for row in which.expansions}
    wanted = [orders[n] for n in (4, 20) if n in orders] or list(which.expansions[:1])
    if which.expansions and which.expansions[-1] not in wanted:
        wanted.append(which.expansions[-1])
    wanted += [] if which.best_resummed is None else [which.best_resummed]
    if not which.expansions and which.flows:
        wanted.append(which.flows[-1])
    terms = [which.terms[0], which.terms[-1]] if len(which.terms) > 1 else list(which.terms)
    named = {row.method: row for row in which.estimates}
    estimates = [named[n] for n in ("wigner", "pseudo-wigner") if n in named]
    estimates += [row for row in which.estimates[:1] if row not in estimates]
    return [*wanted, *terms[:2], *which.exact[:1], *estimates][:9]


def along(found: Benchmark, decay: MotionComparison) -> list[Drawn]:
    """The chosen rows with their values, dashes counted within each way."""
    reference = np.asarray(shown(decay.reference))
    middle = float(np.nanmedian(reference))
    window = max(1, round(2 * np.pi / middle * decay.case.rate))
    index = {row.method: i for i, row in enumerate(found.contenders)}
    count = {"E": 0, "S": 0, "T": 0}
    result = []
    for row in chosen(found):
        error = found.errors[index[row.method]]
        letter = LETTERS[WAYS[row.kind]]
        dash = DASHES[count[letter] % len(DASHES)]
        count[letter] += 1
        smooth = np.where(np.isfinite(error), running_rms(error, window), np.nan)
        result.append(Drawn(row, letter, dash, reference * (1 + error), smooth))
    return result


def in_time(found: Benchmark, decay: MotionComparison) -> Figure:
    """The figure."""
    drawn = along(found, decay)
    clock = Clock(decay.case.time_unit)
    wide, narrow = (_panels(decay, drawn, clock, found.reference.floor, narrow=n) for n in (False, True))
    label = "Frequency against time above, running relative error of each contender below"
    reference = shown(decay.reference) * clock.factor
    series = [Series("reference", decay.time, reference, clock.unit)]
    series += [Series(brief(d.row), found.time, d.error, per_cent=True) for d in drawn]
    return Figure(
        key="in-time",
        wide=_draw(found, decay, drawn, clock, wide, label, narrow=False),
        narrow=_draw(found, decay, drawn, clock, narrow, label, narrow=True),
        caption=_caption(found, decay, drawn, wide),
        toggles=toggles(
            *(letter for letter in "EST" if any(d.letter == letter for d in drawn)),
            series=any(d.row.kind == "series-model" for d in drawn),
        ),
        data={
            **readout((wide, narrow), series, name="t", unit=clock.time_unit, link="time"),
            "least": float(f"{found.reference.floor:.3g}"),
        },
        label=label,
    )


def _caption(found: Benchmark, decay: MotionComparison, drawn: Sequence[Drawn], panels: tuple[Panel, Panel]) -> str:
    low, high = (number(x, 3) for x in found.support)
    span = f"{low} to {high} {decay.case.time_unit}".strip()
    below = f" Shaded below: under {per_cent(found.reference.floor)}, where {found.reference.open_words}."
    return (
        f"Thick: {found.reference.label}. Errors are running rms over one cycle, so that a change of sign does not "
        f"look like accuracy; printed beside them, rms over t = {span}. Shaded at the sides: left out of every rms."
        f"{below if found.reference.floor > LEAST else ''}{_off(drawn, panels)}"
    )


def _off(drawn: Sequence[Drawn], panels: tuple[Panel, Panel]) -> str:
    """Which curves leave the panel of errors above, and whether some do below."""
    y = panels[1].y
    above = [brief(d.row) for d in drawn if np.nanmax(d.error, initial=0.0) > y.high * (1 + 1e-9)]
    cut = y.low == PER_CENT_ENDS and any(np.nanmin(d.error, initial=np.inf) < y.low for d in drawn)
    text_ = f" At the upper edge: off scale ({listing(above)})." if above else ""
    return f"{text_} At the lower edge: below {per_cent_tick(y.low)}." if cut else text_


def _panels(
    decay: MotionComparison, drawn: Sequence[Drawn], clock: Clock, known: float, *, narrow: bool
) -> tuple[Panel, Panel]:
    left, right = (62.0, 360.0) if narrow else (70.0, 716.0)
    x = Scale(float(decay.time[0]), float(decay.time[-1]), left, right)
    reference = shown(decay.reference) * clock.factor
    near = [d.omega * clock.factor for d in drawn if (d.row.relative_rms_error or 1.0) < 0.3]
    low, high = padded([reference], share=0.3)
    near_low, near_high = padded([reference, *near], share=0.05)
    room = 1.2 * (high - low)
    y = (max(near_low, low - room), min(near_high, high + room))
    errors = np.concatenate([d.error[np.isfinite(d.error)] for d in drawn] or [np.array([1.0])])
    kept = errors[errors > 0]
    floor, top = float(np.quantile(kept, 0.005)) if kept.size else LEAST, float(kept.max()) if kept.size else 1.0
    below = Scale(
        max(0.6 * floor, LEAST, least_drawn(known)), min(max(1.5 * top, 10 * floor), MOST), 0.0, 0.0, log=True
    )
    tops = ((24.0, 190.0), (234.0, 472.0)) if narrow else ((24.0, 204.0), (252.0, 472.0))
    first = Panel(x, Scale(y[0], y[1], tops[0][1], tops[0][0]))
    return first, Panel(x, Scale(below.low, below.high, tops[1][1], tops[1][0], log=True))


def _draw(
    found: Benchmark,
    decay: MotionComparison,
    drawn: Sequence[Drawn],
    clock: Clock,
    panels: tuple[Panel, Panel],
    label: str,
    *,
    narrow: bool,
) -> str:
    upper, lower = panels
    marks: list[str] = []
    ticks = lower.y.ticks(8)
    marks += [upper.rows(most=5), lower.rows(ticks, label=error_ticks(ticks))]
    marks += [lower.columns(most=4 if narrow else 8, unit=clock.time_title)]
    marks += [text(0, 11, clock.title(), "m"), text(0, lower.top - 14, "relative error, rms over a cycle", "m")]
    above, below = (
        [panel.shaded(panel.x.low, found.support[0]), panel.shaded(found.support[1], panel.x.high)] for panel in panels
    )
    floor = found.reference.floor
    if floor > lower.y.low:
        top = lower.y(min(floor, lower.y.high))
        below.insert(0, rect(lower.left, top, lower.right - lower.left, lower.bottom - top))
    above.append(upper.curve(decay.time, shown(decay.reference) * clock.factor, "rf nf"))
    for d in drawn:
        inside = np.where(_within(upper, d.omega * clock.factor), d.omega * clock.factor, np.nan)
        above.append(group([upper.curve(found.time, inside, d.style)], f"f{d.letter}"))
        below.append(group([lower.curve(found.time, d.error, d.style)], f"f{d.letter}"))
    marks += [upper.zooming(above), lower.zooming(below)]
    said = _rms(found, drawn)
    marks += _beside(found, drawn, lower, said) if not narrow else _below(drawn, lower, said)
    marks += [group(_upper_names(found, decay, drawn, upper, clock), "halo nz")]
    height = lower.bottom + (58.0 + 17.0 * -(-len(drawn) // _across(drawn, said)) if narrow else 40.0)
    return drawing(NARROW if narrow else WIDE, height, "narrow" if narrow else "wide", label, marks)


def _within(panel: Panel, values: Array) -> Array:
    with np.errstate(invalid="ignore"):
        return np.asarray((values >= panel.y.low) & (values <= panel.y.high))


def _upper_names(
    found: Benchmark, decay: MotionComparison, drawn: Sequence[Drawn], panel: Panel, clock: Clock
) -> Iterable[str]:
    """Names of the reference and of what stands clear of it, on the side away from it; the others are named below."""
    reference = shown(decay.reference) * clock.factor
    span = panel.y.high - panel.y.low
    where = int(0.42 * found.time.size)
    centre = reference[where] if np.isfinite(reference[where]) else float(np.nanmedian(reference))
    rising = np.nanmean(np.diff(reference[np.isfinite(reference)])) >= 0 if np.isfinite(reference).sum() > 1 else True
    taken = [panel.y(centre)]
    yield text(panel.x(found.time[where]), panel.y(centre) + (20 if rising else -10), "reference", "fgt b")
    taken.append(taken[0] + (16 if rising else -14))
    for i, d in enumerate(drawn):
        values = d.omega * clock.factor
        at = int((0.2 + 0.13 * (i % 5)) * found.time.size)
        if not np.isfinite(values[at]) or not np.isfinite(reference[at]):
            continue
        if abs(values[at] - reference[at]) > 0.09 * span and panel.y.low < values[at] < panel.y.high:
            y = panel.y(float(values[at])) + (-7 if values[at] > reference[at] else 17)
            if all(abs(y - other) > 13 for other in taken):
                taken.append(y)
                yield group([text(panel.x(found.time[at]), y, brief(d.row), STYLE[d.letter])], f"f{d.letter}")


def _last(found: Benchmark, d: Drawn) -> int:
    """The last sample at which a contender has an error on the support."""
    inside = np.isfinite(d.error) & (found.time <= found.support[1])
    return int(np.flatnonzero(inside)[-1]) if inside.any() else -1


def _beside(found: Benchmark, drawn: Sequence[Drawn], panel: Panel, said: Sequence[str]) -> list[str]:
    """Names at the right edge with their rms, led to the end of their curve in its own dash."""
    every = [(d, _last(found, d), words) for d, words in zip(drawn, said, strict=True)]
    ends = [(d, i, words) for d, i, words in every if i >= 0]
    places_ = [float(panel.y.clipped(np.array([d.error[i]]))[0]) for d, i, _ in ends]
    heights = apart(places_, 17.0, panel.top + 6, panel.bottom - 4)
    marks = [text(WIDE, panel.top - 14, "rms", "m sm", "end")]
    for (d, i, words), y, height in zip(ends, places_, heights, strict=True):
        x = panel.x(float(found.time[i]))
        path = f"M{places(x)} {places(y)}L{places(panel.right + 12)} {places(height)}H{places(panel.right + 22)}"
        style = STYLE[d.letter]
        parts = [f'<path d="{path}" class="{style}k {d.dash} nf nz"/>']
        parts.append(text(panel.right + 26, height + 4, brief(d.row), style))
        parts.append(text(WIDE, height + 4, words, style, "end"))
        marks.append(group(parts, f"f{d.letter}"))
    return marks


def _across(drawn: Sequence[Drawn], said: Sequence[str]) -> int:
    """How many curves the narrow drawing names on a line: two where name and error have room side by side."""
    wide = (text_width(f"{_brief(d)}{words}", 11.5) for d, words in zip(drawn, said, strict=True))
    return 2 if max(wide, default=0.0) < 142.0 else 1


def _rms(found: Benchmark, drawn: Sequence[Drawn]) -> list[str]:
    """The rms errors of the curves, in one notation."""
    errors = [d.row.relative_rms_error for d in drawn]
    written = written_of(errors, found.reference)
    return [at_most(error, found.reference, "≤ ", written=written) for error in errors]


def _brief(d: Drawn) -> str:
    return brief(d.row).replace("harmonic least squares", "least squares")


def _below(drawn: Sequence[Drawn], panel: Panel, said: Sequence[str]) -> list[str]:
    """The narrow drawing names the curves below, each behind a piece of its own."""
    marks, across = [], _across(drawn, said)
    for i, (d, words) in enumerate(zip(drawn, said, strict=True)):
        x, y = 4.0 + 184.0 * (i % across), panel.bottom + 58.0 + 17.0 * (i // across)
        parts = [line(x, y - 4, x + 20, y - 4, d.style), text(x + 26, y, _brief(d), STYLE[d.letter])]
        parts.append(text(x + 360.0 / across - 4, y, words, STYLE[d.letter], "end"))
        marks.append(group(parts, f"f{d.letter}"))
    return marks
