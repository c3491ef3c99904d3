"""The three cards: every way with a result, without one, and with what each kind of row needs."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from ridgeback.compare.benchmark.contenders import EqualCoefficients, Row
from ridgeback.compare.benchmark.results import Benchmark
from ridgeback.compare.motion.harmonics.folding import folding
from ridgeback.compare.report.cards import Known, _needs, cards, cost, in_noise, within
from ridgeback.compare.report.findings import _cured, findings, lead_of
from ridgeback.numeric.orbits.paper_model import series_frequency
from tests.reports import synthetic
from tests.reports.synthetic_motion import K

STUDY = replace(synthetic.make_study(), scale=K)
DECAY = synthetic.make_decay()
BENCHMARK = synthetic.make_benchmark(DECAY)
RANGES = synthetic.make_ranges(STUDY)


def known(found: Benchmark, **more: object) -> Known:
    usual = {"noise": synthetic.make_noise(), "target": 1e-3, "pendulum": True, "natural_frequency": 1.0}
    return Known(found, STUDY, RANGES, **{**usual, **more})  # type: ignore[arg-type]


def without(*kinds: str, why: str = "") -> Benchmark:
    """The benchmark without kinds of contenders, one of which may have been refused."""
    rows = [row for row in BENCHMARK.contenders if row.kind not in kinds]
    refused = [Row(kinds[0], kinds[0], kinds[0], refused=why)] if why else []
    return replace(BENCHMARK, contenders=(*rows, *refused))


def test_a_pendulum_s_series_holds_up_to_the_first_amplitude_that_violates_the_target() -> None:
    expansion, series, estimate = cards(known(BENCHMARK))
    assert "40" in expansion.text
    rows = dict(series.rows)
    assert rows["at best"].startswith("0.19 %, all terms")
    assert expansion.value.startswith("≤ ") == ("limit" in dict(expansion.rows))
    grid = STUDY.amplitudes
    terms = series_frequency(grid, k=1.0, terms=21) / STUDY.reference - 1
    first = grid[np.flatnonzero(np.abs(terms) > 1e-3)[0] - 1]
    assert f"up to A = {first:.2f}"[:-1] in rows["holds"]
    assert "noise at 20 dB" in dict(estimate.rows)["holds"]
    unstudied = dict(cards(replace(known(BENCHMARK), study=None))[1].rows)
    assert unstudied["holds"] == "along this motion, t = 2 to 18 s"


@pytest.mark.parametrize(("kinds", "at"), [(("expansion", "slow-flow"), 0), (("series-model",), 1), (("estimate",), 2)])
def test_a_way_without_a_result_says_why(kinds: tuple[str, ...], at: int) -> None:
    for why, said in (("", "no contender of this way covers enough"), ("it was refused", "it was refused")):
        card = cards(known(without(*kinds, why=why)))[at]
        assert card.text == "no result"
        assert dict(card.rows)["why"].startswith(said)


def test_what_a_formula_needs() -> None:
    row = Row("x", "x", "expansion")
    sources = {"energy": "the trajectory’s energy", "fit": "turning points", "action": "a start", None: "alone"}
    for source, words in sources.items():
        assert words in _needs(replace(row, amplitude_from=source))
    assert _needs(Row("x", "x", "slow-flow")) == "the equation and a start"
    assert within(STUDY, 1e-3, None).endswith("at no A studied")
    assert in_noise(replace(synthetic.make_noise(), cells=()), row) == ""


def test_findings_name_folding_and_equal_numbers_of_coefficients() -> None:
    pair = EqualCoefficients(
        coefficients=21, terms=21, order=40, amplitude_from="action", series_error=0.03, expansion_error=1e-4
    )
    found = replace(BENCHMARK, crossings=replace(BENCHMARK.crossings, equal_coefficients=(pair,)))
    said = " ".join(findings(found, replace(DECAY, folding=folding((3, 5), 12.0, 64.0)), None, 1.0))
    assert "With 21 coefficients each, the paper’s series errs 3.0 %" in said
    assert "fold" in said
    assert "With 21" not in " ".join(findings(BENCHMARK, DECAY, None, 1.0))


def test_costs_are_said_where_both_ways_are_timed() -> None:
    assert "times less than one of" in lead_of(BENCHMARK, timed=True)
    assert " ± " in lead_of(BENCHMARK, timed=True)
    once = Row("", "", "estimate", time_ns_per_value=2e5, time_s_per_track=0.25)
    assert cost(replace(once, time_scatter=0.1)) == "0.25 ± 0.03 s a track, 200 ± 20 µs a value"
    assert cost(once) == "0.2 s a track, 200 µs a value"
    rows = tuple(replace(row, time_ns_per_value=None) for row in BENCHMARK.contenders)
    assert "costs" not in lead_of(replace(BENCHMARK, contenders=rows), timed=True)


def test_a_start_beyond_the_radius_is_said_first() -> None:
    derived = SimpleNamespace(expansion=SimpleNamespace(variable="A"), limits=SimpleNamespace(radius=2.0))
    said = [findings(BENCHMARK, DECAY, derived, start)[0] for start in (3.0, 1.0)]  # type: ignore[arg-type]
    assert "outside the radius of convergence 2 of the series in A" in said[0]
    assert "radius" not in said[1]


def test_a_corrected_estimate_is_told_only_where_it_is_closer() -> None:
    def with_error(size: float) -> Benchmark:
        rows = (replace(r, relative_rms_error=size) if r.corrected_by else r for r in BENCHMARK.contenders)
        return replace(BENCHMARK, contenders=tuple(rows))

    assert _cured(with_error(1e-3)).startswith(" Wigner peak errs 0.94 %, and 0.10 %")
    assert _cured(with_error(0.5)) == ""
    assert _cured(without("estimate")) == ""
