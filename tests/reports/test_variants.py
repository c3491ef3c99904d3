"""Pages beside the usual one: what is missing is left out or said, what lies elsewhere is drawn elsewhere."""

from __future__ import annotations

import re
from dataclasses import replace
from importlib.metadata import EntryPoint
from itertools import combinations
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from ridgeback.common import plugins
from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.compare.benchmark.contenders import Row
from ridgeback.compare.benchmark.results import Benchmark
from ridgeback.compare.identification.results import Parameter
from ridgeback.compare.motion.harmonics.folding import folding
from ridgeback.compare.motion.results import MotionComparison
from ridgeback.compare.report.results import Report
from ridgeback.compare.study.results import Checked, Range
from ridgeback.reports import outside_sections, sections, study_sections
from ridgeback.reports.drawing.canvas import padded
from ridgeback.reports.drawing.figure import Series, _read
from ridgeback.reports.drawing.marks import needed
from ridgeback.reports.drawing.ticks import round_duration
from ridgeback.reports.figures import benchmark as cost_figure
from ridgeback.reports.figures import in_time, noise, order_map
from ridgeback.reports.figures.accuracy_cost import accuracy_cost
from ridgeback.reports.figures.answer import answer_figure
from ridgeback.reports.figures.budget import _ruling, budget_figure
from ridgeback.reports.figures.contending import shown
from ridgeback.reports.figures.motion import motion
from ridgeback.reports.figures.planes import planes, signed_plane
from ridgeback.reports.figures.recordings import identification
from ridgeback.reports.figures.recordings.sample_fit import line_sentence
from ridgeback.reports.parts import Section
from ridgeback.reports.runs_sections import runs_sections
from ridgeback.reports.text.tables import budget_table, contender_table
from tests.reports import synthetic, synthetic_several
from tests.reports.synthetic_motion import budget
from tests.reports.synthetic_records import fitted


def drawn_of(part: Any) -> str:
    """What a figure holds, as text."""
    return f"{part.wide}{part.narrow}{part.caption}"


@pytest.fixture(scope="module")
def decay(full: Report) -> MotionComparison:
    assert full.decay is not None
    return full.decay


@pytest.fixture(scope="module")
def found(full: Report) -> Benchmark:
    assert full.benchmark is not None
    return full.benchmark


def only(found: Benchmark, *kinds: str) -> Benchmark:
    keep = [i for i, row in enumerate(found.contenders) if row.kind in kinds]
    return replace(found, contenders=tuple(found.contenders[i] for i in keep), errors=found.errors[keep])


# --- accuracy against cost ---


def test_each_family_is_named_in_the_caption_only_where_it_is_drawn(found: Benchmark) -> None:
    whole = accuracy_cost(found, 1e-3).caption
    assert "averaged action, whose own cost" in whole
    assert "bias of its own track removed" in whole
    raw = replace(found, contenders=tuple(r for r in found.contenders if not r.corrected_by))
    assert "bias of its own track" not in accuracy_cost(raw, 1e-3).caption
    alone = accuracy_cost(only(found, "expansion"), 1e-9)
    assert "target" not in alone.wide
    assert "estimates from" not in alone.wide
    energy = tuple(r for r in found.contenders if r.amplitude_from != "action")
    assert "averaged action" not in accuracy_cost(replace(found, contenders=energy), 1e-3).caption


def test_below_the_floor_of_the_reference_is_shaded_only_where_it_is_in_sight(found: Benchmark) -> None:
    assert "two readings" in accuracy_cost(found, 1e-3).wide
    sharp = replace(found, reference=replace(found.reference, definition=0.0, numerical_error=0.0))
    assert "two readings" not in accuracy_cost(sharp, 1e-3).wide


def test_below_the_floor_an_error_is_told_as_at_most_the_floor_everywhere(full: Report, found: Benchmark) -> None:
    """What lies below 3 % is nowhere printed with digits of its own: labels, titles, tables, budget, readout."""
    wide = replace(found.reference, definition=0.03)
    assert full.decay is not None
    blunt = replace(found, reference=wide)
    table, budget = contender_table(blunt), budget_table(full.decay.budget, wide)
    cells = [cell for row in table.rows for cell in row.cells[1:4]]
    cells += [cell for row in budget.rows for cell in row.cells[4:]]
    drawn, bars = in_time.in_time(blunt, full.decay), budget_figure(full.decay.budget, wide)
    cells += re.findall(r"<title>[^<]*: ([^<,]*)", accuracy_cost(blunt, 1e-3).wide)
    cells += re.findall(r'class="[est]" text-anchor="end">([^<]*%)<', drawn.wide + drawn.narrow + bars.wide)
    cells += re.findall(r"total ([^<;]*)", bars.wide)
    sizes = [float(cell.split()[0].strip("\u2007\u2008")) for cell in cells if re.match(r"\d[^×]* %", cell)]
    assert len(cells) > 40
    assert cells.count("≤ 3.0 %") > 10
    assert [size for size in sizes if 0 < size < 3.0] == []
    assert all("≤: under 3.0 %" in caption for caption in (table.caption, budget.caption, bars.caption))
    assert drawn.data["least"] == 0.03


def test_the_target_passes_behind_the_name_of_an_estimate(found: Benchmark) -> None:
    error = next(r.relative_rms_error for r in shown(found).estimates if r.method == "wigner")
    assert error is not None
    assert accuracy_cost(found, error).wide.count('class="bgf"') > accuracy_cost(found, 10 * error).wide.count('"bgf"')


def test_durations_below_a_tenth_of_a_nanosecond_are_said() -> None:
    assert round_duration(3e-12) == "0.003 ns"


def test_the_plot_for_files_names_each_contender_once(found: Benchmark) -> None:
    rows = [Row("w", "", "estimate", time_s_per_track=2.0), Row("e", "", "expansion", time_ns_per_value=5.0)]
    assert [cost_figure.seconds(row, 100) for row in rows] == [2.0, pytest.approx(5e-7)]
    own = replace(rows[0], method="wigner-corrected", corrected_by="its own track")
    series = replace(rows[1], method="lindstedt-4-energy", amplitude_from="energy")
    assert [cost_figure.short(row) for row in (own, series)] == ["wigner, own bias off", "lindstedt-4 (energy)"]
    for which in (found, only(found, "expansion", "series-model")):
        texts = {text.get_text() for text in cost_figure.drawn(which).panels[0].texts}
        assert "expansions, in C" in texts
        assert ("wigner" in texts) == any(row.method == "wigner" for row in which.contenders)


# --- along the motion ---


def test_flows_stand_for_expansions_that_there_are_none_of(found: Benchmark) -> None:
    row = Row("flow-4", "", "slow-flow", order=4, relative_rms_error=0.01, ranked=True, coverage=1.0)
    flows = replace(only(found, "estimate"), contenders=(*only(found, "estimate").contenders, row))
    assert row in in_time.chosen(flows)


def test_where_contenders_err_most(found: Benchmark, decay: MotionComparison) -> None:
    told = sections._time_title(found, decay)
    assert told.startswith("In time, expansions")
    nowhere = replace(found, errors=np.full_like(found.errors, np.nan))
    assert sections._time_title(nowhere, decay) == "Frequency in time"
    models = sections._time_title(only(found, "series-model"), decay)
    assert "expansions" not in models
    holes = np.where(np.arange(found.time.size)[None, :] % 40 < 39, np.nan, found.errors)
    assert in_time.in_time(replace(found, errors=holes), decay).wide


def test_the_last_turn_of_a_limit_cycle_is_drawn_over_its_velocity(decay: MotionComparison) -> None:
    figure = motion(decay, cycle=True)
    assert "Right: velocity against displacement" in figure.caption
    for drawing in (figure.wide, figure.narrow):
        assert f"{decay.case.symbol}′" in drawing
    assert f">{decay.case.symbol}′<" not in motion(decay, cycle=False).wide


def test_folded_multiples_are_dashed_and_said(decay: MotionComparison) -> None:
    folded = planes(replace(decay, folding=folding((3, 5), 12.0, decay.case.rate)))
    assert "Dashed: multiples beyond half the sampling rate" in folded.caption
    assert "folded" in folded.wide
    assert "Dashed: multiples" not in planes(decay).caption


def test_names_of_folded_multiples_stand_in_the_panel_clear_of_each_other_and_of_the_title(
    decay: MotionComparison,
) -> None:
    top = float(np.nanmax(decay.reference.omega)) / (2 * np.pi)
    several = folding((3, 5, 7, 9, 11), top, 7.0 * top)
    drawn = planes(replace(decay, folding=several)).wide
    found = re.findall(r'x="([-\d.]+)" y="([-\d.]+)"[^>]*>(\d+) ω₀, folded<', drawn)
    places = {int(m): (float(x), float(y)) for x, y, m in found}
    assert set(places) == {5, 7, 9, 11}
    assert all(28.0 < y < 286.0 for _, y in places.values())
    for (x0, y0), (x1, y1) in combinations(places.values(), 2):
        assert abs(x0 - x1) > 80.0 or abs(y0 - y1) > 12.0


def test_a_ridge_that_is_nowhere_valid_has_no_enlargement(decay: MotionComparison) -> None:
    plane, clock = decay.wigner_u, SimpleNamespace(factor=1 / (2 * np.pi), unit="Hz", time_unit="s", time_title="t / s")
    reference, ridge = plane.overlays
    nowhere = replace(ridge, valid=np.zeros(ridge.time.size, dtype=bool))
    blank = replace(ridge, omega=np.full(ridge.time.size, np.nan))
    usual = signed_plane("key", plane, clock, (0.0, 20.0), (2.0, 18.0))  # type: ignore[arg-type]
    for overlays in ((reference, nowhere), (reference, blank), (ridge,)):
        bare = signed_plane("key", replace(plane, overlays=overlays), clock, (0.0, 20.0), (2.0, 18.0))  # type: ignore[arg-type]
        assert len(bare) < len(usual)


# --- order and amplitude ---


def test_a_motion_in_eps_is_marked_at_its_own_eps(full: Report, decay: MotionComparison) -> None:
    assert full.study is not None
    assert full.grid is not None
    panel = order_map._layout(full.study, full.grid, narrow=False, observed=True)[0]
    study = replace(full.study, variable="eps")
    own = replace(decay, case=replace(decay.case, parameters={"eps": 1.0}))
    marks = "".join(order_map._motion(study, own, panel))
    assert f'x1="{panel.x(1.0):.1f}'[:-2] in marks or f"{panel.x(1.0):.1f}" in marks
    assert list(order_map._motion(study, decay, panel)) == []
    assert order_map.reach_sentence(full.study, 1e-3, 4, None) == "Order 4 keeps 0.1 % at no A studied"
    powers = tuple((low, high, np.full_like(p, np.nan)) for low, high, p in full.grid.observed)
    figure = order_map.order_map(full.study, replace(full.grid, observed=powers), Range(3, 1e-3, None), None)
    assert "order seen" not in figure.narrow


# --- sections ---


def test_a_check_that_failed_stands_above_the_fold(full: Report) -> None:
    assert full.derivation is not None
    wrong = Checked("residual", "order 4 does not cancel", False)
    failing = replace(full.derivation, certificate=(wrong,), harmonics=None)
    section = sections._expansion(replace(full, derivation=failing))
    assert section is not None
    assert [part.kind for part in section.parts][:2] == ["formula", "lines"]
    bare = replace(full.derivation, formulas=full.derivation.formulas[:1], certificate=(), harmonics=None)
    section = sections._expansion(replace(full, derivation=bare))
    assert section is not None
    assert [part.kind for part in section.parts] == ["formula"]


def test_sections_of_other_distributions_are_checked(full: Report, monkeypatch: pytest.MonkeyPatch) -> None:
    made = {"good": lambda _: Section("", "Own", "Own", ()), "none": lambda _: None, "text": lambda _: "text", "no": 1}

    class Point(EntryPoint):
        def load(self) -> object:
            return made[self.name]

    points = tuple(Point(name, "elsewhere:section", outside_sections.GROUP) for name in made)
    monkeypatch.setattr(plugins, "entry_points", lambda group: points if group == outside_sections.GROUP else ())
    found = {section.key: section for section in outside_sections.outside_sections(full)}
    assert set(found) == {"plugin-good", "plugin-text", "plugin-no"}
    assert "returned a str, not a Section" in str(found["plugin-text"].parts[0])
    assert "is a int, not a function of a Report" in str(found["plugin-no"].parts[0])


def test_a_study_of_one_answer_is_led_by_its_figure() -> None:
    report = synthetic_several.study_report()
    assert report.answered is not None
    judged = replace(report.answered.answers[0], passed=True, table=(), sentences=("all hold",))
    alone = replace(report, answered=replace(report.answered, panels=(), answers=(judged,), failures=()))
    (head,) = study_sections.study_head(alone)
    assert head.kind == "figure"
    told = list(study_sections.study_sections(alone))
    assert told[-1].title == "All hold: passed"
    assert [part.kind for part in told[-1].parts] == []
    assert study_sections.study_head(replace(alone, answered=replace(alone.answered, answers=()))) == ()
    assert study_sections._set(r"\nosuchcommand{") == ""


def test_runs_that_nothing_is_known_of_have_no_section_of_it() -> None:
    runs = synthetic_several.runs_report()
    assert runs.runs is not None
    measured = tuple(replace(one, notes=(), backbone=None) for one in runs.runs.found.measured)
    quiet = replace(runs.runs, named=(), found=replace(runs.runs.found, measured=measured, notes=(), failed=()))
    assert [section.key for section in runs_sections(replace(runs, runs=quiet))] == ["signals", "tracks", "samples"]


# --- small words ---


def test_small_words() -> None:
    fit = fitted()
    places = {0.01: ", a drift", 1.5: " 1.5 times the fundamental", 2.0: "at 2 times the fundamental", 1.0: "beside"}
    for ratio, words in places.items():
        assert words in line_sentence(replace(fit, line=ratio * fit.fundamental))
    assert replace(fit, line=None).multiple is None
    assert list(needed(np.array([0.0, 1.0, 3.0, 1.0, 0.0]), np.array([0.0, 1.0, 0.0, -1.0, 0.0]))) == [0, 1, 2, 3, 4]
    assert identification._with_interval(Parameter("k", 2.0, 0.0)) == ("2", "exact")
    assert identification._with_interval(Parameter("k", 2.0, np.nan))[1] == "not claimed"
    row = budget()[0]
    assert _read(Series("one", np.array([1.0]), np.array([1.0])), np.array([1.0, 2.0])) == [None, None]
    assert _ruling(replace(row, truncation=0.0, averaging=None, estimator=None)) == ""
    study = synthetic.make_noise()
    cells = tuple(replace(c, ratio=None if c.rms is None else 3.0 + (c.method == "hilbert")) for c in study.cells)
    assert "comes nearest to its bound, 3 times it" in noise.noise_heading(replace(study, cells=cells))
    refused = tuple(replace(c, ratio=None, rms=None) for c in study.cells)
    assert noise.noise_heading(replace(study, cells=refused)) == "In noise, no estimator gives a value"
    assert padded([np.array([np.nan])]) == (0.0, 1.0)


def test_pictures_without_a_point_and_with_a_band() -> None:
    x = np.linspace(1.0, 2.0, 5)
    blank = Picture("nothing", "x", "y", (Stroke(x, np.full(5, np.nan)),))
    assert answer_figure("key", blank) is None
    banded = Picture("band", "x", "y", (Stroke(x, x, "line", low=x - 0.1, high=x + 0.1),))
    figure = answer_figure("key", banded)
    assert figure is not None
    assert "s1f" in figure.wide or 'f"' in figure.wide
    zeros = Picture("zeros", "x", "y", (Stroke(x, 0 * x),), None, True)
    assert answer_figure("key", zeros) is not None
