"""The contenders that a page draws, by family, with what each costs: one choice for all of its figures."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ridgeback.compare.benchmark.contenders import Row
from ridgeback.compare.benchmark.results import Benchmark
from ridgeback.compare.report.naming import short_name

LETTERS = {"expansions": "E", "series model": "S", "estimates": "T", None: "S"}
STYLE = {"E": "e", "S": "s", "T": "t"}
NUMBERED = (2, 4, 8, 12, 20, 30, 40)
LEAST = 1e-17
PER_CENT_ENDS = 1e-6
"""The least error that is written in per cent."""


@dataclass(frozen=True)
class Shown:
    """The contenders that are drawn, by family, and their common scales."""

    found: Benchmark
    expansions: tuple[Row, ...]
    in_python: tuple[Row, ...]
    flows: tuple[Row, ...]
    resummed: tuple[Row, ...]
    terms: tuple[Row, ...]
    exact: tuple[Row, ...]
    estimates: tuple[Row, ...]
    corrected: tuple[Row, ...]

    @property
    def all(self) -> tuple[Row, ...]:
        """All of them."""
        formulas = (self.expansions, self.in_python, self.flows, self.resummed, self.terms)
        return tuple(row for part in (*formulas, self.exact, self.estimates, self.corrected) for row in part)

    @property
    def best_resummed(self) -> Row | None:
        """The best resummation, where it is closer than every truncated series: then it is named."""
        best = min(self.resummed, key=error, default=None)
        floor = self.found.reference.floor
        rest = min((max(error(row), floor) for row in (*self.expansions, *self.flows)), default=math.inf)
        return best if best is not None and max(error(best), floor) < rest else None

    def cost(self, row: Row) -> float:
        """What a track costs, s."""
        if row.time_s_per_track is not None:
            return row.time_s_per_track
        return float(row.time_ns_per_value or math.nan) * 1e-9 * self.found.time.size


def error(row: Row) -> float:
    """Its relative rms error, never 0 on a logarithmic axis."""
    return max(float(row.relative_rms_error or 0.0), LEAST)


def shown(found: Benchmark) -> Shown:
    """Choose one amplitude for the formulas: the averaged action's where there is one, so that no floor hides them."""
    ranked = [row for row in found.contenders if row.ranked and row.relative_rms_error is not None]
    sources = {row.amplitude_from for row in ranked if row.kind in ("expansion", "series-model")}
    source = "action" if "action" in sources else next(iter(sorted(sources, key=str)), None)

    def of(kind: str, language: str | None = None) -> tuple[Row, ...]:
        rows = [r for r in ranked if r.kind == kind and (kind == "slow-flow" or r.amplitude_from == source)]
        return tuple(sorted((r for r in rows if language in (None, r.language)), key=lambda r: r.order or 0))

    native, python = of("expansion", "c"), of("expansion", "python")
    resummed = of("resummation", "c") or of("resummation", "python")
    raw = [row for row in ranked if row.kind == "estimate" and row.corrected_by is None]
    return Shown(
        found=found,
        expansions=native or python,
        in_python=python if native else (),
        flows=of("slow-flow"),
        resummed=resummed,
        terms=of("series-model"),
        exact=tuple(row for row in ranked if row.kind == "closed-form"),
        estimates=tuple(sorted(raw, key=error)),
        corrected=tuple(row for row in ranked if row.corrected_by is not None),
    )


def brief(row: Row) -> str:
    """A contender where room is short.

    >>> brief(Row("nome-24", "elliptic nome after 2 Landen steps", "resummation", order=24))
    'elliptic nome'
    """
    return short_name(row).partition(" after ")[0]


def least_drawn(floor: float) -> float:
    """Where an axis of errors ends below: far under a floor nothing is known, and no decade is spent on it.

    >>> least_drawn(1.8e-4), least_drawn(1e-9)
    (1e-06, 0.0)
    """
    return PER_CENT_ENDS if floor >= 5.0 * PER_CENT_ENDS else 0.0
