"""How a benchmark shows itself: its verdict in a line, its contenders as a table, their errors along the motion."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from ridgeback.common.show.displayed import Displayed
from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.compare.benchmark.contenders import WAYS, Reference, Row, Verdict
from ridgeback.compare.motion.results import Case
from ridgeback.numeric.arrays import Array

COLUMNS = (
    *("method", "kind", "order", "relative_rms_error", "largest", "mean", "coverage", "ranked"),
    *("time_ns_per_value", "time_s_per_track", "time_scatter"),
)


class ShownBenchmark(Displayed):
    """What a benchmark shows of itself."""

    INDEX: ClassVar[tuple[str, ...]] = ("method",)

    case: Case
    reference: Reference
    contenders: tuple[Row, ...]
    verdict: Verdict
    time: Array
    errors: Array

    def rows(self) -> list[dict[str, Any]]:
        """One row per contender: errors relative to the reference, coverage and cost; NaN where there is none."""
        whole = [row.to_dict() for row in self.contenders]
        return [{name: float("nan") if row[name] is None else row[name] for name in COLUMNS} for row in whole]

    def headline(self) -> str:
        """The case and the verdict."""
        return f"{self.case.title}: {self.verdict.sentence(self.reference)}"

    def picture(self) -> Picture:
        """Relative error along the motion of the best of each way, on a logarithmic axis."""
        best: dict[str, int] = {}
        for i, row in sorted(enumerate(self.contenders), key=lambda pair: pair[1].relative_rms_error or 0.0):
            if row.ranked and (way := WAYS[row.kind]) is not None:
                best.setdefault(way, i)
        errors = np.where(self.errors == 0.0, np.nan, np.abs(self.errors))
        strokes = tuple(Stroke(self.time, errors[i], self.contenders[i].label) for i in best.values())
        return Picture(self.case.title, "time", "relative error of omega0", strokes, logarithmic=True)
