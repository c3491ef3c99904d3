"""A benchmark as text, CSV and JSON."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from ridgeback.common.numbers import number, relative
from ridgeback.common.quantities import measured_time
from ridgeback.console.output import json_text
from ridgeback.console.tables import Row, aligned, csv_text

if TYPE_CHECKING:
    from ridgeback.compare.benchmark.contenders import OrderCrossing
    from ridgeback.compare.benchmark.contenders import Row as Contender
    from ridgeback.compare.benchmark.results import Benchmark

COLUMNS = (
    *("method", "kind", "order", "coefficients", "amplitude_from", "language", "corrected_by"),
    *("relative_rms_error", "largest", "mean", "support_start", "support_end", "coverage", "ranked"),
    *("time_ns_per_value", "time_s_per_track", "time_scatter", "refused"),
)
OFF_SCALE = 10.0
SHOWN = ("method", "A(t) from", "code", "rms error", "largest", "mean", "cost of a value")


def benchmark_text(found: Benchmark, style: str) -> str:
    """The benchmark in the form asked for."""
    if style == "json":
        return json_text(record(found))
    if style == "csv":
        return csv_text(COLUMNS, [flat(row) for row in found.contenders])
    return readable(found)


def record(found: Benchmark) -> dict[str, Any]:
    """The benchmark as JSON knows it."""
    from dataclasses import asdict

    verdict = found.verdict
    orders = [{"kind": "order", **asdict(c), "sentence": c.sentence()} for c in found.crossings.orders]
    amplitudes = [{"kind": "amplitude", **asdict(c)} for c in found.crossings.amplitudes]
    equal = [{"kind": "equal-coefficients", **asdict(c)} for c in found.crossings.equal_coefficients]
    return {
        "case": asdict(found.case),
        "reference": {**asdict(found.reference), "floor": found.reference.floor},
        "support": found.support,
        "motion": None if found.account is None else found.account.to_dict(),
        "rows": [row.to_dict() for row in found.contenders],
        "crossings": [*orders, *amplitudes, *equal],
        "verdict": {
            "way": verdict.way,
            "best": verdict.best.method,
            "rival_way": verdict.rival_way,
            "rival": None if verdict.rival is None else verdict.rival.method,
            "ratio": verdict.ratio,
            "decided": verdict.decided,
            "limit": verdict.limit,
            "sentence": verdict.sentence(found.reference),
        },
    }


def flat(row: Contender) -> Row:
    """A row of CSV: the support in two columns."""
    values = row.to_dict()
    start, end = row.support or (None, None)
    cells = {**values, "support_start": start, "support_end": end}
    return {name: cells[name] for name in COLUMNS}


def readable(found: Benchmark) -> str:
    """The table of what is ranked, best first, then what is not, the crossings and the verdict."""
    from ridgeback.compare.report.naming import parameters_line

    ranked = sorted(merged(found), key=lambda r: r[0].relative_rms_error or 0.0)
    begin, end = (number(x) for x in found.support)
    parts = [
        f"{found.case.title}: {found.case.equation}",
        parameters_line(found.case),
        f"errors relative to the {found.reference.label}, over t = {begin} to {end}; it is open by "
        f"{relative(found.reference.floor)}",
        "",
        aligned(SHOWN, [shown(rows) for rows in alike(ranked)]),
        *unranked(found),
        *passed(found),
        *equal(found),
        "",
        *(() if found.account is None else (*found.account.sentences(), "")),
        f"{found.verdict.sentence(found.reference)}; {found.verdict.limit}.",
    ]
    return "\n".join(parts) + "\n"


def merged(found: Benchmark) -> list[list[Contender]]:
    """The ranked rows, those of one formula in several languages together: their values agree to rounding."""
    groups: dict[str, list[Contender]] = {}
    for row in found.contenders:
        if row.ranked:
            groups.setdefault(row.label, []).append(row)
    return list(groups.values())


def alike(groups: list[list[Contender]]) -> list[list[Contender]]:
    """The same, with orders of an expansion whose errors are written alike as one line: the lowest, with its cost."""
    kept: dict[tuple[object, ...], list[list[Contender]]] = {}
    for rows in groups:
        row = rows[0]
        same = (row.amplitude_from, *(written(x) for x in errors(row))) if row.kind == "expansion" else (row.method,)
        kept.setdefault(same, []).append(rows)
    return [shortened(sorted(found, key=lambda rows: rows[0].order or 0)) for found in kept.values()]


def shortened(groups: list[list[Contender]]) -> list[Contender]:
    """The first group; its label names how many higher orders are alike."""
    if len(groups) == 1:
        return groups[0]
    last = groups[-1][0].order
    label = groups[0][0].label.partition(", A(t) from")[0]
    more = f"{label}; {len(groups) - 1} up to order {last} alike"
    return [replace(groups[0][0], label=more), *groups[0][1:]]


def errors(row: Contender) -> tuple[float | None, ...]:
    """The three errors that are shown."""
    return row.relative_rms_error, row.largest, row.mean


def written(value: float | None, *, signed: bool = False) -> str:
    """A relative error; no digits beyond ten times the frequency itself.

    >>> written(0.0019), written(-25.0, signed=True)
    ('0.19 %', 'over 1000 %')
    """
    return "over 1000 %" if value is not None and abs(value) >= OFF_SCALE else relative(value, signed=signed)


def shown(rows: list[Contender]) -> Row:
    """One line of the table."""
    row = rows[0]
    return {
        "method": row.label.partition(", A(t) from")[0],
        "A(t) from": row.amplitude_from or "-",
        "code": ", ".join(r.language for r in rows if r.language) or "-",
        "rms error": written(row.relative_rms_error),
        "largest": written(row.largest),
        "mean": written(row.mean, signed=True),
        "cost of a value": ", ".join(cost(r) for r in rows),
    }


def cost(row: Contender) -> str:
    """What a value costs, with its unit and its scatter from run to run."""
    return measured_time(None if row.time_ns_per_value is None else 1e-9 * row.time_ns_per_value, row.time_scatter)


def passed(found: Benchmark) -> list[str]:
    """Where the expansions pass each estimate: by order, and the amplitude below which an order is ahead."""
    sources = dict.fromkeys(c.amplitude_from for c in found.crossings.orders)
    return [line for source in sources for line in at_source(found, source)]


def at_source(found: Benchmark, source: str | None) -> list[str]:
    """The same at one amplitude."""
    below = {(c.estimate, c.order): c.words() for c in found.crossings.amplitudes if c.amplitude_from == source}
    orders = sorted({order for _, order in below})
    ahead = {order: f"order {order} ahead" for order in orders}
    lines = [
        {"estimate": c.estimate, "passed": place(c)} | {ahead[n]: below.get((c.estimate, n), "-") for n in orders}
        for c in found.crossings.orders
        if c.amplitude_from == source
    ]
    head = f"expansions {f'at A(t) from the {source}' if source else 'in eps'} against estimates"
    return ["", head, aligned(["estimate", "passed", *ahead.values()], lines)] if lines else []


def place(crossing: OrderCrossing) -> str:
    """Between which orders an estimate is passed."""
    if crossing.after is None:
        text = f"not to order {crossing.before}"
    elif crossing.before is None:
        text = f"from order {crossing.after}"
    else:
        text = f"between orders {crossing.before} and {crossing.after}"
    return text if crossing.settled else f"{text}, within what is open"


def unranked(found: Benchmark) -> list[str]:
    """What was refused or covers too little, and why."""
    reasons: dict[str, list[str]] = {}
    for row in found.contenders:
        if not row.ranked:
            reasons.setdefault(row.refused or f"covers {row.coverage:.0%} of the interior", []).append(row.label)
    lines = [f"  {'; '.join(dict.fromkeys(labels))}: {reason}" for reason, labels in reasons.items()]
    return ["", "not ranked:", *lines] if lines else []


def equal(found: Benchmark) -> list[str]:
    """The paper's series beside the expansion with as many coefficients."""
    lines = [
        f"{c.coefficients} coefficients, A(t) from the {c.amplitude_from}: {c.terms} terms of (14) "
        f"{relative(c.series_error)}, order {c.order} {relative(c.expansion_error)}"
        for c in found.crossings.equal_coefficients
    ]
    return ["", *lines] if lines else []
