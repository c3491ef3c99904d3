"""Sentences of a benchmark's verdict: every outcome has one of its own, with the numbers that decide it."""

from __future__ import annotations

from dataclasses import replace

import pytest

from ridgeback.compare.benchmark.contenders import Reference, Row, Verdict
from ridgeback.compare.benchmark.verdict import judge
from ridgeback.compare.report.findings import title_of
from ridgeback.compare.report.naming import at_most

BEST, RIVAL = (Row("x", f"order {n}", "expansion", order=n, relative_rms_error=e) for n, e in ((8, 1e-3), (2, 1e-2)))
DECIDED = Verdict("expansions", BEST, "estimates", RIVAL, 10.0, True, "")
UNDECIDED, BEHIND = replace(DECIDED, decided=False), replace(DECIDED, best=RIVAL, rival=BEST, ratio=0.1)
CLEAR, OPEN, WIDE = Reference("", 1e-9, 1e-6), Reference("", 1e-9, 2e-3), Reference("", 1e-9, 6e-3)


@pytest.mark.parametrize(
    ("verdict", "reference", "title", "sentence"),
    [
        (DECIDED, CLEAR, "10 times closer than order 2", "10 times less than order 2"),
        (replace(DECIDED, rival=None, ratio=None), CLEAR, "within 0.10 %", "nothing of another way could be ranked"),
        (DECIDED, OPEN, "as it is defined (0.20 %), at least 2.6 times closer than order 2", "at least 2.6 times less"),
        (DECIDED, Reference("", 3.5e-3, 2e-3), "as it is known (0.35 %), order 2 within 1.0 %", "at least 1.4 times"),
        (UNDECIDED, WIDE, "both follow ω₀(t) within 1.0 %; it is defined to 0.60 %", "omega0(t) itself is open by"),
        (UNDECIDED, Reference("", 2e-2, 1e-3), "as closely as it is known, to 2.0 %", "cannot be told from it"),
        (UNDECIDED, CLEAR, "both follow ω₀(t) within 1.0 %", "does as well, within 5 %"),
        (BEHIND, OPEN, "order 8 is at least 2.6 times closer", "at least 2.6 times more than order 8"),
    ],
)
def test_every_outcome_has_its_words(verdict: Verdict, reference: Reference, title: str, sentence: str) -> None:
    assert title in title_of(verdict, reference)
    assert sentence in verdict.sentence(reference)
    assert verdict.sentence(reference).startswith(f"Order {verdict.best.order} errs")


def test_an_error_is_never_told_below_the_floor() -> None:
    """Each error may be wrong by the floor: two that differ by less than twice it have no order."""
    rows = (replace(row, ranked=True) for row in (BEST, replace(RIVAL, kind="estimate")))
    assert not judge(list(rows), WIDE).decided
    assert at_most(1e-3, WIDE) == "at most 0.60 %"
    assert (WIDE.open_words, WIDE.defined) == ("two readings of ω₀(t) disagree", True)
    assert Reference("", 1e-3, 1e-9).open_words == "the integration leaves ω₀(t) open"
