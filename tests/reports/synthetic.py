"""A report that nobody computed with care but that looks like one: for trying the page, never for results."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass, replace
from typing import Any

from ridgeback.compare.motion.results import (
    Statement,
)
from ridgeback.compare.report.results import Card, Described, Provenance, Report
from tests.reports.synthetic_motion import (
    make_benchmark,
    make_certified,
    make_decay,
    make_derivation,
    make_grid,
    make_ranges,
    make_study,
)
from tests.reports.synthetic_records import make_identification, make_noise, make_recording


def provenance() -> Provenance:
    versions = {"ridgeback": "0.1.0", "numpy": "2.4.6"}
    return Provenance("ridgeback report", versions, {"orders": "2 to 30"}, "0123abcd", "", {"study": 1.25})


def empty_report() -> Report:
    return Report("Nothing was run", "An empty report.", (), (), None, None, (), None, None, provenance())


def full_report() -> Report:
    study, decay = make_study(), make_decay()
    ranges = make_ranges(study)
    finding = next(r for r in ranges if r.order == 6 and r.target == 1e-3)
    rows = [f"{r['order']},{r['amplitude']}" for r in study.rows()]
    needs = ("needs", "the equation and a start")
    return Report(
        title="Harmonic least squares and order 40 both follow ω₀(t)",
        lead="The paper's series, cut after 21 terms, is 2.9 % off.",
        summary=("The Wigner peak lies 0.95 % low over 2 to 18 s.", "Equation (21) ripples twice per cycle."),
        cards=(
            Card("Perturbation expansion", "0.011 %", "order 40", (("cost", "3 ns"), needs), "expansions"),
            Card("The paper’s series model", "2.9 %", "21 terms", (("cost", "31 ns"), needs), "series model"),
            Card("Estimate from samples", "0.0012 %", "least squares", (("cost", "0.3 s"), needs), "estimates"),
        ),
        derivation=make_derivation(),
        study=study,
        ranges=ranges,
        decay=decay,
        recording=None,
        provenance=provenance(),
        certified=make_certified(),
        noise=make_noise(),
        csv={"study.csv": "order,amplitude\n" + "\n".join(rows) + "\n"},
        finding=finding,
        benchmark=make_benchmark(decay),
        grid=make_grid(study),
        described=Described(
            "Pendulum", r"\ddot{\theta} + k^2 \sin\theta = 0", "k = 4 π; from 0.95 π", "Galleani, Cohen"
        ),
        paper=True,
    )


def recording_report() -> Report:
    title = "The recording softens: 1.18 Hz at amplitude 4.7, 1.26 Hz at 0.3"
    return replace(
        empty_report(),
        title=title,
        lead="A free decay.",
        recording=make_recording(),
        identification=make_identification(),
    )


def small_report() -> Report:
    """Everything a page can show, of little size."""
    study, decay = make_study(8, (2, 4, 8)), make_decay()
    ranges = make_ranges(study)
    statements = tuple(s for s in decay.statements if s.figure in (2, 4, 9))
    return replace(
        full_report(),
        study=study,
        ranges=ranges,
        finding=next(r for r in ranges if r.order == 8 and r.target == 1e-3),
        grid=make_grid(study),
        decay=replace(decay, curves=decay.curves[::4], statements=statements),
        recording=make_recording(),
        identification=make_identification(),
    )


# Strings that choose among meanings instead of being shown.
FIXED = {"variable", "kind", "name", "chosen", "symbol", "curves", "time_unit", "csv", "way", "rival_way", "grid"}
FIXED |= {"amplitude_from", "language", "corrected_by", "amplitude_unit", "method", "methods", "part"}


def poisoned(value: Any, text: str, key: str = "") -> Any:
    """The same value with ``text`` appended to every string that is shown."""
    if key == "grid":
        return value
    if isinstance(value, str):
        return value if key in FIXED or not value else value + text
    if is_dataclass(value) and not isinstance(value, type):
        return replace(
            value, **{f.name: poisoned(getattr(value, f.name), text, _key(value, f.name)) for f in fields(value)}
        )
    if isinstance(value, Mapping):
        return {name + text: poisoned(inner, text, key) for name, inner in value.items()}
    if isinstance(value, tuple):
        return tuple(poisoned(inner, text, key) for inner in value)
    return value


def _key(owner: object, name: str) -> str:
    """``curves`` of a statement are names; of anything else they are curves with labels."""
    return "" if name == "curves" and not isinstance(owner, Statement) else name
