"""Which way to omega0(t) is best here: a typed judgement."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Final

from ridgeback.common.errors import InputError
from ridgeback.common.numbers import relative
from ridgeback.compare.benchmark.contenders import WAYS, Reference, Row, Verdict, Way
from ridgeback.compare.benchmark.crossings import SOURCES, expansions, passing

TOLD: Final = 1.05
"""Ratio of two errors, both no less than the floor, from which on they are told apart."""
YARDSTICKS: Final = ("closed-form", "averaged")
"""What the best way is held against where no other way could be ranked."""


def judge(rows: Sequence[Row], reference: Reference) -> Verdict:
    """Return the verdict on ranked rows; corrected estimates take part as estimates."""
    floor = reference.floor
    best = {way: closest([r for r in rows if r.ranked and WAYS[r.kind] == way], floor) for way in _ways()}
    known = {way: row for way, row in best.items() if row is not None}
    if not known:
        raise InputError("no expansion, series model or estimate could be ranked on this motion")
    first, *others = sorted(known, key=lambda way: _error(known[way]))
    rival = known[others[0]] if others else closest([r for r in rows if r.ranked and r.kind in YARDSTICKS], floor)
    ratio = None if rival is None else max(_error(rival), floor) / max(_error(known[first]), floor)
    return Verdict(
        way=first,
        best=known[first],
        rival_way=others[0] if others else None,
        rival=rival,
        ratio=ratio,
        decided=rival is not None and ratio is not None and _decided(known[first], rival, ratio, reference),
        limit="; ".join((_limit(known[first]), *_ends(known[first], known.get("estimates"), rows, reference))),
    )


def _decided(best: Row, rival: Row, ratio: float, reference: Reference) -> bool:
    return max(ratio, 1.0 / ratio) >= TOLD and reference.told_apart(_error(best), _error(rival))


def _ways() -> tuple[Way, ...]:
    return ("expansions", "series model", "estimates")


def _error(row: Row) -> float:
    return float(row.relative_rms_error or 0.0)


def closest(rows: Iterable[Row], floor: float) -> Row | None:
    """The row of least error; among those that the reference cannot tell apart, a plain expansion of least order.

    Measured times decide nothing: the same motion has the same verdict.

    >>> rows = [Row("x", "", "expansion", order=n, relative_rms_error=e) for n, e in ((8, 3e-9), (20, 1e-9))]
    >>> [found.order for floor in (0.0, 1e-8) if (found := closest(rows, floor))]
    [20, 8]
    """
    known = [row for row in rows if row.relative_rms_error is not None]
    return min(
        known,
        key=lambda r: (max(_error(r), floor), r.kind != "expansion", r.order or 0, r.language != "c", r.method),
        default=None,
    )


def _limit(row: Row) -> str:
    largest = "" if row.largest is None else f"its largest error on the support is {relative(row.largest)}"
    if row.kind == "slow-flow":
        return f"it needs no trajectory, only the equation and its start; {largest}"
    if WAYS[row.kind] == "estimates":
        return f"it needs the samples, and nothing of the equation; {largest}"
    if row.amplitude_from is None:
        return f"it needs the equation, and holds on the limit cycle alone; {largest}"
    return f"it needs the equation and A(t) from the {row.amplitude_from}; {largest}"


def _ends(row: Row, estimate: Row | None, rows: Sequence[Row], reference: Reference) -> Iterator[str]:
    """At which order expansion and best estimate change places, as far as the best row is one of the two."""
    if estimate is None or row.kind not in ("expansion", "estimate"):
        return
    for source in SOURCES if row.kind == "estimate" else (row.amplitude_from,):
        series = expansions(rows, source)
        if series and not (source == "energy" and expansions(rows, "action")):
            yield passing(series, estimate, source, reference).sentence()
