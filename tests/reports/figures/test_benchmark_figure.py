"""Accuracy against cost: every ranked contender is a point, names keep apart, the same rows give the same bytes."""

from __future__ import annotations

import numpy as np
import pytest

from ridgeback.compare.benchmark.contenders import Crossings, Reference, Row
from ridgeback.compare.benchmark.results import Benchmark
from ridgeback.compare.benchmark.verdict import judge
from ridgeback.compare.motion.results import Case
from ridgeback.reports.figures.benchmark import apart, drawn, plot_file


@pytest.fixture(scope="module")
def found() -> Benchmark:
    def row(name: str, kind: str, error: float, cost: float, **more: object) -> Row:
        return Row(name, name, kind, relative_rms_error=error, time_ns_per_value=cost, ranked=True, **more)  # type: ignore[arg-type]

    rows = (
        *(row(f"e{n}", "expansion", 0.1**n, 9.0 + n, order=n, amplitude_from="action", language="c") for n in (2, 4)),
        row("s", "series-model", 0.2, 40.0, order=3, amplitude_from="action", language="numpy"),
        *(row(f"estimate {n}", "estimate", 1e-3 * (1 + 0.01 * n), 1e6) for n in range(6)),
    )
    reference = Reference("given", 1e-7, 1e-5)
    case = Case("x", "X", "u'' + u = 0", "u", "u", "", "", "", {}, (1.0, 0.0), 9.0, 9.0)
    verdict = judge(rows, reference)
    time = np.arange(9.0)
    return Benchmark(case, reference, (1.0, 8.0), rows, Crossings(), verdict, time, time, np.zeros((len(rows), 9)))


def test_names_keep_apart_and_inside(found: Benchmark) -> None:
    heights = apart([5.0, 5.0, 5.0, 99.0, 100.0], 10.0, 100.0)
    assert np.diff(heights).min() >= 10.0 - 1e-9
    assert max(heights) <= 100.0
    texts = [text.get_text() for text in drawn(found).panels[0].texts]
    assert {f"estimate {n}" for n in range(6)} <= set(texts)


@pytest.mark.parametrize("kind", ["svg", "png", "pdf"])
def test_the_same_rows_give_the_same_bytes(found: Benchmark, kind: str) -> None:
    data = plot_file(found, kind)
    assert data == plot_file(found, kind)
    assert data[:5] in (b"<?xml", b"\x89PNG\r", b"%PDF-")
