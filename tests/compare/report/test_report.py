"""Reports as a whole: complete, deterministic apart from times, and honest in their title."""

import csv
import io
import json
import shutil
import subprocess
from collections import Counter

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.common.numbers import relative
from ridgeback.common.progress import silent
from ridgeback.compare.benchmark.contenders import WAYS, Reference, Row
from ridgeback.compare.benchmark.verdict import judge
from ridgeback.compare.benchmark.ways.estimates import METHODS as ESTIMATES
from ridgeback.compare.binding.bind import bind
from ridgeback.compare.motion import motion
from ridgeback.compare.motion.motion import setting
from ridgeback.compare.motion.paper_case import paper_case
from ridgeback.compare.noise import truth
from ridgeback.compare.noise.monte_carlo import truth_of
from ridgeback.compare.report.findings import title_of
from ridgeback.compare.report.noise_part import NoisePart, noise_part
from ridgeback.compare.report.provenance import settings_hash
from ridgeback.compare.report.recording_report import recording_report
from ridgeback.compare.report.results import Report
from ridgeback.compare.report.system_report import system_report
from ridgeback.compare.study import derived, truncations
from ridgeback.compare.study.study import ranges
from ridgeback.numeric.orbits.period import exact_frequency
from ridgeback.numeric.recording.recording import Recording
from ridgeback.reports.page import html_page
from ridgeback.symbolic.systems.catalogue import find


def small(**options) -> Report:
    case = setting(find("damped-duffing-hardening"), initial=(0.8, 0.0), duration=40.0, rate=5.0)
    return system_report(case, orders=(2, 6), amplitudes=np.linspace(0.1, 0.9, 9), order=6, **{"trials": 2, **options})


@pytest.fixture(scope="module")
def calls() -> Counter[str]:
    """How often the costly steps ran for the one report below."""
    return Counter()


@pytest.fixture(scope="module")
def report(calls):
    watched = [(derived, "bind"), (motion, "bind"), (truth, "bind"), (derived, "lindstedt"), (truncations, "lindstedt")]
    watched += [(motion, "integrate"), (truth, "integrate"), (truncations, "limits")]
    with pytest.MonkeyPatch.context() as patch:
        for module, name in watched:
            patch.setattr(module, name, counted(getattr(module, name), calls, name))
        return small(command="ridgeback report duffing")


def counted(function, calls, name):
    def wrapped(*args, **options):
        calls[name] += 1
        return function(*args, **options)

    return wrapped


def test_nothing_is_derived_bound_or_integrated_twice(report, calls):
    assert report.noise is not None
    # bound as it is for the motion, and without damping for the study and the code
    assert calls == {"bind": 2, "lindstedt": 1, "integrate": 1}


def test_a_noise_study_over_its_budget_is_refused_with_a_reason_for_motions_and_recordings_alike():
    swing = motion.integrate_motion(setting(find("damped-pendulum"), initial=(1.0, 0.0), duration=60.0, rate=4.0))
    run = swing.trajectory
    recording = Recording(run.time, run.u, run.rate, "u", "rad", "run.csv", "")
    for source in (lambda: truth.motion_truth(swing), lambda: truth_of(recording)):
        part = noise_part(source, 100_000, silent)
        assert part.study is None
        assert "over the budget of 120 s" in part.left_out
        assert noise_part(source, 0, silent) == NoisePart(None)


def test_the_title_is_the_verdict_of_the_benchmark(report):
    verdict, reference = report.benchmark.verdict, report.benchmark.reference
    assert report.title == title_of(verdict, reference)
    errors = [row.relative_rms_error for row in report.benchmark.contenders if row.ranked and WAYS[row.kind]]
    assert verdict.best.relative_rms_error == min(errors)
    found = next(item for item in ranges(report.study, 1e-3) if item.order == 6)
    assert report.finding == found
    row = np.abs(report.study.relative_error[report.study.orders.index(6)])
    assert (row[report.study.amplitudes <= found.up_to] <= 1e-3).all()


def test_a_title_claims_nothing_below_what_is_defined():
    """Two contenders below the floor are not told apart; one above it is behind by what any reading leaves."""

    def row(kind, error):
        return Row(kind, kind, kind, order=8, relative_rms_error=error, ranked=True)

    reference = Reference("cycle frequency", 1e-9, 1e-4)
    close = judge([row("expansion", 2e-5), row("estimate", 9e-5)], reference)
    assert (
        title_of(close, reference) == "Order 8 and estimate both follow ω₀(t) as closely as it is defined, to 0.010 %"
    )
    apart = judge([row("expansion", 2e-5), row("estimate", 1e-3)], reference)
    assert title_of(apart, reference) == (
        "Order 8 follows ω₀(t) as closely as it is defined (0.010 %), at least 7.5 times closer than estimate"
    )


def test_three_cards_have_the_same_rows_and_every_part_is_there(report):
    assert [card.way for card in report.cards] == ["expansions", "series model", "estimates"]
    for card in report.cards:
        assert [name for name, _ in card.rows[:3]] == ["cost", "holds", "needs"]
    assert len(report.summary) <= 5
    assert report.derivation.formulas
    assert report.derivation.certificate
    assert set(report.derivation.code) == {"C", "JavaScript", "Python"}
    assert not report.paper
    assert report.recording is None
    assert report.provenance.command == "ridgeback report duffing"


def test_estimators_stand_beside_each_other_and_in_noise(report):
    rows = [row for row in report.benchmark.contenders if row.kind == "estimate"]
    assert {row.method.removesuffix("-corrected") for row in rows} == set(ESTIMATES)
    assert all(row.refused or row.relative_rms_error < 0.05 for row in rows)
    loud, quiet = (report.noise.cell("harmonic-least-squares", snr).rms for snr in (0.0, 40.0))
    assert quiet < 0.1 * loud


def test_without_times_the_same_request_gives_the_same_report_and_page(report):
    first, second = small(timed=False), small(timed=False)
    assert repr(first) == repr(second)
    assert html_page(first) == html_page(second)
    assert first.provenance.settings_hash == report.provenance.settings_hash
    assert not first.provenance.seconds
    assert all(row.time_ns_per_value is None for row in first.benchmark.contenders)


def test_the_grid_is_enclosed_and_its_code_gives_its_values_to_the_bit(report):
    """The errors against an independent exact frequency (agm), the JavaScript run by node where it is there."""
    grid = report.grid
    assert grid.certified
    exact = np.array([float(exact_frequency(linearless(), np.array([a])).omega[0]) for a in grid.amplitudes])
    np.testing.assert_allclose(grid.exact, exact, rtol=1e-10)
    assert (np.abs(grid.errors) <= grid.bounds).all()
    np.testing.assert_allclose(grid.errors, grid.values / grid.exact - 1, rtol=1e-6, atol=1e-15)
    assert (np.abs(np.array([p - n - 2 for n, p in zip(grid.orders, grid.observed[0][2], strict=True)])) < 0.1).all()
    node = shutil.which("node")
    if node is None:
        pytest.skip("node is not on the path, so the page's code was not run")
    program = "\n".join(f"const f{order} = {text};" for order, text in grid.code.items())
    calls = ",".join(f"A.map(a => f{order}(a, {grid.scale!r}))" for order in grid.orders)
    program += f"\nconst A = {json.dumps(grid.amplitudes.tolist())};\nconsole.log(JSON.stringify([{calls}]));"
    done = subprocess.run([node, "-e", program], capture_output=True, text=True, check=True, timeout=60)
    np.testing.assert_array_equal(np.array(json.loads(done.stdout)), grid.values)


def linearless():
    """The undamped oscillator of the report above."""
    return bind(find("duffing-hardening"))


def test_another_setting_has_another_hash(report):
    other = system_report(
        setting(find("damped-duffing-hardening"), initial=(0.7, 0.0), duration=40.0, rate=5.0),
        orders=(2,), order=2, amplitudes=[0.1], trials=0,
    )  # fmt: skip
    assert other.provenance.settings_hash != report.provenance.settings_hash
    assert settings_hash({"a": 1}) != settings_hash({"a": 2})


def test_csv_files_read_back_as_the_numbers_they_came_from(report):
    rows = list(csv.DictReader(io.StringIO(report.csv["study.csv"])))
    assert len(rows) == report.study.omega.size
    assert float(rows[3]["omega"]) == report.study.omega[0, 3]
    decay = list(csv.DictReader(io.StringIO(report.csv["decay.csv"])))
    np.testing.assert_allclose([float(row["u"]) for row in decay], report.decay.u, rtol=1e-11)
    found = [float(row["omega_linear"]) for row in decay]
    np.testing.assert_allclose(found, report.decay.curves[2].omega, rtol=1e-6)
    rows = list(csv.DictReader(io.StringIO(report.csv["contenders.csv"])))
    assert [row["method"] for row in rows] == [row.method for row in report.benchmark.contenders]


def test_the_papers_case_is_the_papers():
    case = paper_case()
    numbers = case.case().parameters
    assert numbers["k"] == pytest.approx(4 * np.pi, rel=1e-15)
    assert numbers["mu"] == 0.01
    assert case.initial == (0.95 * np.pi, 0.0)
    assert (case.duration, case.rate, case.time_unit) == (20.0, 64.0, "s")


def test_a_limit_cycle_reports_in_eps():
    case = setting(find("van-der-pol").with_parameters({"eps": "0.4"}), initial=(1.0, 0.0), duration=40.0, rate=5.0)
    report = system_report(case, orders=(2, 4), amplitudes=[0.2, 0.5], order=4, trials=0)
    assert report.cards[1].value == "–"
    assert dict(report.cards[0].rows)["holds"] == "within 0.1 % up to ε = 0.5"
    assert not any("decay" in text for text in (report.title, report.lead, *report.summary))
    assert not report.grid.certified
    assert report.study.limit is None
    assert any("Amplitude of the limit cycle" in formula.title for formula in report.derivation.formulas)


def test_bad_requests_are_refused():
    with pytest.raises(InputError, match="target"):
        small(target=2.0)
    with pytest.raises(InputError, match="order -1"):
        system_report(paper_case(), order=-1)
    with pytest.raises(InputError, match="the suffix"):
        recording_report("missing.unknown")
    with pytest.raises(OSError, match=r"missing\.csv"):
        recording_report("missing.csv")


@pytest.mark.parametrize(
    ("value", "text"), [(0.5, "50 %"), (0.0123, "1.2 %"), (0.00099, "0.099 %"), (9.9e-5, "9.9 × 10⁻⁵"), (0.0, "0")]
)
def test_errors_are_worded_without_prefixes(value, text):
    assert relative(value) == text
