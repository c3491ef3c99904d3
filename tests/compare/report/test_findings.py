"""Sentences of a benchmark's verdict: every outcome has one of its own, with the numbers that decide it."""

from __future__ import annotations

from dataclasses import replace

import pytest

from ridgeback.compare.benchmark.contenders import Reference, Row, Verdict
from ridgeback.compare.report.findings import title_of

BEST, RIVAL = (Row("x", f"order {n}", "expansion", order=n, relative_rms_error=e) for n, e in ((8, 1e-3), (2, 1e-2)))
DECIDED = Verdict("expansions", BEST, "estimates", RIVAL, 10.0, True, "")
CLEAR, OPEN = Reference("", 1e-9, 1e-6), Reference("", 1e-9, 2e-3)


@pytest.mark.parametrize(
    ("verdict", "reference", "title", "sentence"),
    [
        (DECIDED, CLEAR, "10 times closer than order 2", "10 times less than order 2"),
        (replace(DECIDED, rival=None, ratio=None), CLEAR, "within 0.10 %", "nothing of another way could be ranked"),
        (DECIDED, OPEN, "as closely as it is defined", "10 times less than order 2"),
        (replace(DECIDED, decided=False), OPEN, "order 2", "cannot be told from it: omega0(t) itself is open by"),
        (replace(DECIDED, decided=False), CLEAR, "both follow ω₀(t) within 1.0 %", "does as well, within 5 %"),
        (
            replace(DECIDED, ratio=0.1),
            OPEN,
            "order 2 is at least 10 times closer",
            "at least 10 times more than order 2",
        ),
        (replace(DECIDED, ratio=2e7), CLEAR, "times closer than order 2", "times less than order 2"),
    ],
)
def test_every_outcome_has_its_words(verdict: Verdict, reference: Reference, title: str, sentence: str) -> None:
    assert title in title_of(verdict, reference)
    assert sentence in verdict.sentence(reference)
    assert verdict.sentence(reference).startswith("Order 8 errs")
