"""Reports as a whole: complete, deterministic apart from times, and honest in their title."""

import csv
import io
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.common.numbers import relative, rounded_down
from ridgeback.common.progress import silent
from ridgeback.common.quantities import amplitude
from ridgeback.compare.motion import motion
from ridgeback.compare.motion.motion import setting
from ridgeback.compare.motion.paper_case import paper_case
from ridgeback.compare.noise import truth
from ridgeback.compare.noise.monte_carlo import truth_of
from ridgeback.compare.report.noise_part import NoisePart, noise_part
from ridgeback.compare.report.provenance import settings_hash
from ridgeback.compare.report.recording_report import recording_report
from ridgeback.compare.report.results import Report
from ridgeback.compare.report.system_report import system_report
from ridgeback.compare.study import derived, truncations
from ridgeback.compare.study.study import ranges
from ridgeback.numeric.estimators.estimate import METHODS
from ridgeback.numeric.recording.recording import Recording
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
    # bound as it is for the motion, and without damping for the study, the code and the timings
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


def test_the_title_is_the_range_of_the_chosen_order(report):
    found = next(item for item in ranges(report.study, 1e-3) if item.order == 6)
    assert report.finding == found
    assert report.title == f"Order 6 stays within 0.10 % up to A = {amplitude(rounded_down(found.up_to, 4), '')}"
    row = np.abs(report.study.relative_error[report.study.orders.index(6)])
    assert (row[report.study.amplitudes <= found.up_to] <= 1e-3).all()
    assert row[report.study.amplitudes > found.up_to][0] > 1e-3


def test_three_cards_and_every_part_is_there(report):
    assert [card.heading for card in report.cards] == ["Range of use", "Worst error", "Cost per value"]
    assert report.derivation.formulas
    assert report.derivation.certificate
    assert set(report.derivation.code) == {"Python", "C"}
    assert report.decay.statements
    assert report.timings
    assert report.recording is None
    assert report.provenance.command == "ridgeback report duffing"


def test_every_estimator_stands_beside_the_others_and_in_noise(report):
    assert {score.method for score in report.estimator_scores} == set(METHODS) - {
        "auto",
        "model-fit",
    }
    for score in report.estimator_scores:
        assert score.failed or score.rms_interior < 0.05, score
    best = next(s for s in report.estimator_scores if s.method == "harmonic-least-squares")
    assert best.rms_interior < 1e-3
    assert 0.0 < best.half_width < 0.01
    loud, quiet = (report.noise.cell("harmonic-least-squares", snr).rms for snr in (10.0, 40.0))
    assert quiet < 0.1 * loud


def test_the_same_request_gives_the_same_report_apart_from_times(report):
    def timeless(item):
        still = tuple(replace(score, seconds=0.0) for score in item.estimator_scores)
        made = replace(item.provenance, command="", seconds={})
        return replace(item, provenance=made, timings=(), cards=item.cards[:2], estimator_scores=still)

    again = small()
    assert repr(timeless(again)) == repr(timeless(report))
    assert again.provenance.settings_hash == report.provenance.settings_hash


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
    scores = list(csv.DictReader(io.StringIO(report.csv["scores.csv"])))
    assert [row["method"] for row in scores] == [score.method for score in report.decay.scores]


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
    assert "ε = 0.5" in report.title
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
