"""``crossings``: where an expansion and an estimate change places, along each axis of the study.

The ratio ln(e_expansion / e_estimate) of their errors is followed along one axis (order, amplitude, a parameter, the
noise, the length) while all others stand still.  Where it changes its sign between two values, the crossing lies
between them; it is interpolated linearly in the ratio.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.compare.studies.answer import Answer
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.questions.motions import Pooled, pooled
from ridgeback.compare.studies.tasks import Column, Finished

COLUMNS = (
    Column("oscillator", "", "name of the oscillator"),
    Column("axis", "", "what is changed while all else stands still"),
    Column("at", "", "what stands still"),
    Column("expansion", "", "the prediction"),
    Column("estimate", "", "the estimate"),
    Column("below", "of the axis", "last value before the crossing"),
    Column("above", "of the axis", "first value behind it"),
    Column("crossing", "of the axis", "the crossing, interpolated between the two"),
    Column("ahead_above", "", "which errs less above: expansion or estimate"),
    Column("settled", "", "whether the errors on both sides differ by more than noise and the motion leave open"),
)
CLEAN = math.inf
SIGMAS = 2.0
DRAWN = ("amplitude", "order", "snr_db")
"""Axes that the figure shows."""
SHOWN = 12
"""Most curves in the figure."""
Place = Mapping[str, float]


@dataclass(frozen=True)
class Duel:
    """An expansion and an estimate at one place of the study."""

    system: str
    place: Place
    """Value on each axis."""
    expansion: str
    estimate: str
    ratio: float
    """ln(e_expansion / e_estimate): below 0 the expansion errs less."""
    settled: bool


@dataclass(frozen=True)
class Crossing:
    """Between two neighbours on one axis the better one changes."""

    axis: str
    before: Duel
    after: Duel

    @property
    def at(self) -> float:
        """The place where both err alike, by linear interpolation of the ratio; infinite where an end of it is."""
        x, y = self.before.place[self.axis], self.after.place[self.axis]
        share = self.before.ratio / (self.before.ratio - self.after.ratio)
        return x + (y - x) * share if math.isfinite(y) else y


def answer(plan: Plan, blocks: Iterable[Finished]) -> Answer:
    """Every crossing along every axis.

    Parameters
    ----------
    plan : Plan
        The study.
    blocks : iterable of Finished
        Cells along motions.

    Returns
    -------
    Answer
        A row for each crossing; the figure shows the crossing order over the amplitude, by noise.
    """
    rows = list(pooled(blocks))
    duels = list(duels_of(rows))
    axes = axes_of(duels)
    found = [crossing for axis in axes for crossing in crossings(duels, axis)]
    failed = sum(row.failures for row in rows)
    said = tuple(sentences(duels, found)) or ("no expansion stands beside an estimate here",)
    title = "where expansions and estimates change places"
    table = tuple(row_of(crossing, axes) for crossing in found)
    return Answer("crossings", title, COLUMNS, table, said, drawing(found, plan.title), failed)


def duels_of(rows: Sequence[Pooled]) -> Iterator[Duel]:
    """Each ranked prediction beside each ranked estimate of the same case, at each ratio of signal to noise."""
    cases: dict[tuple[Any, ...], list[Pooled]] = {}
    for row in rows:
        if row.ranked and row.rms:
            cases.setdefault((row.system, row.amplitude, row.duration), []).append(row)
    for mine in cases.values():
        for prediction in (row for row in mine if row.is_prediction):
            for estimate in (row for row in mine if not row.is_prediction):
                yield duel(prediction, estimate)


def duel(prediction: Pooled, estimate: Pooled) -> Duel:
    """Hold a prediction against an estimate."""
    place = {
        "amplitude": prediction.amplitude,
        "duration": prediction.duration,
        "snr_db": estimate.snr_db,
        **prediction.system.numbers(),
        **({} if prediction.order is None else {"order": float(prediction.order)}),
    }
    mine, other = prediction.rms or 0.0, estimate.rms or 0.0
    doubt = max(prediction.floor, SIGMAS * (estimate.rms_sd or 0.0))
    return Duel(
        prediction.system.name,
        place,
        prediction.method,
        estimate.method,
        math.log(mine / other),
        abs(mine - other) > doubt,
    )


def axes_of(duels: Sequence[Duel]) -> list[str]:
    """The axes with more than one value, the order first."""
    values: dict[str, set[float]] = {"order": set()}
    for item in duels:
        for name, value in item.place.items():
            values.setdefault(name, set()).add(value)
    return [name for name, found in values.items() if len(found) > 1]


def crossings(duels: Iterable[Duel], axis: str) -> Iterator[Crossing]:
    """Every change of sign along one axis."""
    lines: dict[tuple[Any, ...], list[Duel]] = {}
    for item in duels:
        if axis in item.place:
            still = tuple(sorted((name, value) for name, value in item.place.items() if name != axis))
            lines.setdefault((item.system, item.expansion, item.estimate, still), []).append(item)
    for line in lines.values():
        line.sort(key=lambda item: item.place[axis])
        for before, after in pairwise(line):
            if (before.ratio < 0) != (after.ratio < 0):
                yield Crossing(axis, before, after)


def row_of(crossing: Crossing, axes: Sequence[str]) -> dict[str, Any]:
    """One row of the table; of what stands still it names the axes that the study has."""
    before, after = crossing.before, crossing.after
    still = {name: value for name, value in before.place.items() if name != crossing.axis and name in axes}
    return {
        "oscillator": before.system,
        "axis": crossing.axis,
        "at": ", ".join(f"{name} = {value:.6g}" for name, value in still.items()) or "-",
        "expansion": before.expansion,
        "estimate": before.estimate,
        "below": before.place[crossing.axis],
        "above": after.place[crossing.axis],
        "crossing": crossing.at,
        "ahead_above": "expansion" if after.ratio < 0 else "estimate",
        "settled": before.settled and after.settled,
    }


def sentences(duels: Sequence[Duel], found: Sequence[Crossing]) -> Iterator[str]:
    """For each expansion and estimate, how often the first is ahead, and where it crosses; those that cross first."""
    ahead: dict[tuple[str, str, str], list[bool]] = {}
    for item in duels:
        ahead.setdefault(pair_of(item), []).append(item.ratio < 0)
    counts: dict[tuple[str, str, str], Counter[str]] = {pair: Counter() for pair in ahead}
    for crossing in found:
        counts[pair_of(crossing.before)][crossing.axis] += 1
    for pair in sorted(ahead, key=lambda pair: not counts[pair]):
        where = ", ".join(f"{count} along {axis}" for axis, count in counts[pair].items()) or "none"
        share = f"{sum(ahead[pair])} of {len(ahead[pair])} places"
        yield f"{pair[0]}: {pair[1]} errs less than {pair[2]} at {share}; crossings: {where}"


def pair_of(item: Duel) -> tuple[str, str, str]:
    """Oscillator, expansion and estimate."""
    return item.system, item.expansion, item.estimate


def drawing(found: Sequence[Crossing], title: str) -> Picture:
    """The order from which an expansion stays ahead of an estimate, over the amplitude, by pair and noise.

    Damping, length and other parameters stand at the first of their values for each oscillator; the title says them.
    """
    last = last_along_order(found)
    first: dict[str, Place] = {}
    for one in last:
        first.setdefault(one.system, standing(one))
    shown = [one for one in last if one.ratio < 0 and standing(one) == first[one.system]]
    several = len({one.system for one in shown}) > 1
    lines: dict[str, dict[float, float]] = {}
    for one in shown:
        lines.setdefault(label_of(one, named=several), {})[one.place["amplitude"]] = one.place["order"]
    strokes = tuple(
        Stroke(sorted(line), [line[x] for x in sorted(line)], label, dots=len(line) == 1)
        for label, line in list(lines.items())[:SHOWN]
    )
    places = list(dict.fromkeys(said(first[one.system]) for one in shown))
    at = "; ".join(place for place in places if place)
    name = ": ".join(part for part in (title or "crossings", at) if part)
    return Picture(name, "amplitude", "order from which the expansion errs less", strokes)


def last_along_order(found: Sequence[Crossing]) -> list[Duel]:
    """What lies behind the last crossing along the order, for each pair at each place, in the order of ``found``."""
    last: dict[tuple[object, ...], Duel] = {}
    for crossing in found:
        if crossing.axis == "order":
            still = tuple((name, value) for name, value in crossing.after.place.items() if name != "order")
            key = (pair_of(crossing.after), still)
            if key not in last or last[key].place["order"] < crossing.after.place["order"]:
                last[key] = crossing.after
    return list(last.values())


def standing(one: Duel) -> Place:
    """The value of each axis that the figure does not show."""
    return {name: value for name, value in one.place.items() if name not in DRAWN}


def said(place: Place) -> str:
    """The values of a place in words."""
    return ", ".join(f"{name} = {value:.6g}" for name, value in place.items())


def label_of(one: Duel, *, named: bool) -> str:
    """Which pair, in which noise."""
    noise = one.place["snr_db"]
    parts = (one.system if named else "", one.expansion, one.estimate, "" if noise == CLEAN else f"{noise:g} dB")
    return ", ".join(part for part in parts if part)
