"""A benchmark as text, CSV and JSON."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ridgeback.common.numbers import number, relative
from ridgeback.console.output import json_text
from ridgeback.console.tables import Row, aligned, csv_text

if TYPE_CHECKING:
    from ridgeback.compare.benchmark.contenders import Row as Contender
    from ridgeback.compare.benchmark.results import Benchmark

COLUMNS = (
    *("method", "kind", "order", "coefficients", "amplitude_from", "language", "corrected_by"),
    *("relative_rms_error", "largest", "mean", "support_start", "support_end", "coverage", "ranked"),
    *("time_ns_per_value", "time_s_per_track", "refused"),
)
SHOWN = ("method", "A(t) from", "code", "rms error", "largest", "mean", "ns a value")


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
    ranked = sorted(merged(found), key=lambda r: r[0].relative_rms_error or 0.0)
    begin, end = (number(x) for x in found.support)
    parts = [
        f"{found.case.title}: {found.case.equation}",
        f"errors relative to the {found.reference.label}, over t = {begin} to {end}; two of its readings differ by "
        f"{relative(found.reference.definition)}",
        "",
        aligned(SHOWN, [shown(rows) for rows in ranked]),
        *unranked(found),
        "",
        *(
            f"{crossing.sentence()}{'' if crossing.settled else ' (within what the reference leaves open)'}"
            for crossing in found.crossings.orders
        ),
        *equal(found),
        "",
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


def shown(rows: list[Contender]) -> Row:
    """One line of the table."""
    row = rows[0]
    return {
        "method": row.label.partition(", A(t) from")[0],
        "A(t) from": row.amplitude_from or "-",
        "code": ", ".join(r.language for r in rows if r.language) or "-",
        "rms error": relative(row.relative_rms_error),
        "largest": relative(row.largest),
        "mean": relative(row.mean, signed=True),
        "ns a value": ", ".join(number(r.time_ns_per_value, 2) for r in rows),
    }


def unranked(found: Benchmark) -> list[str]:
    """What was refused or covers too little, and why."""
    left = [row for row in found.contenders if not row.ranked]
    reasons = [f"  {row.label}: {row.refused or f'covers {row.coverage:.0%} of the interior'}" for row in left]
    return ["", "not ranked:", *dict.fromkeys(reasons)] if left else []


def equal(found: Benchmark) -> list[str]:
    """The paper's series beside the expansion with as many coefficients."""
    return [
        f"{c.coefficients} coefficients, A(t) from the {c.amplitude_from}: {c.terms} terms of (14) "
        f"{relative(c.series_error)}, order {c.order} {relative(c.expansion_error)}"
        for c in found.crossings.equal_coefficients
    ]
