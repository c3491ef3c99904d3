"""Small functions of the compare room where there is nothing to compare: a reason or nothing, never a number."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from importlib.metadata import EntryPoint
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.common.progress import silent
from ridgeback.compare.benchmark import verdict
from ridgeback.compare.benchmark.account import Account
from ridgeback.compare.benchmark.contenders import Row
from ridgeback.compare.benchmark.ways import formulas, outsiders
from ridgeback.compare.benchmark.ways.own_correction import corrected
from ridgeback.compare.benchmark.ways.slow_flows import powers_of
from ridgeback.compare.binding import generated_code
from ridgeback.compare.binding.programs import Finished
from ridgeback.compare.drift import comparison as drift
from ridgeback.compare.identification import fits, fitting
from ridgeback.compare.identification.sample_fit import strongest_line
from ridgeback.compare.motion.error_budget import _estimate_row, _model_row, estimator_error
from ridgeback.compare.motion.error_norms import distance
from ridgeback.compare.motion.estimate_curves import Outcome, along, attempt
from ridgeback.compare.motion.harmonics.folding import folding
from ridgeback.compare.motion.harmonics.overtones import slope
from ridgeback.compare.motion.paper_statements import WIGNER, Evidence, _cause
from ridgeback.compare.motion.results import Curve, Score
from ridgeback.compare.recording.backbone_fit import BackboneFit
from ridgeback.compare.recording.measurement import size_columns
from ridgeback.compare.recording.planes import plane_of
from ridgeback.compare.recording.samples import NAMES, sample
from ridgeback.compare.report.drift import drift_report
from ridgeback.compare.report.naming import start_line
from ridgeback.compare.report.recording_summary import recording_sentences
from ridgeback.compare.report.several import study_report
from ridgeback.compare.report.system_report import _amplitudes
from ridgeback.compare.studies.measures import backbone, cost, decay, estimated, predicted, reach
from ridgeback.compare.studies.questions import best_estimator, crossings, error_budget, grids, motions, observed_order
from ridgeback.compare.studies.questions.motions import Pooled
from ridgeback.compare.studies.systems import System
from ridgeback.compare.study import derivation
from ridgeback.compare.study.atlas import over_power
from ridgeback.symbolic.codegen import form_of
from ridgeback.symbolic.expansion.each_side import energy_on_each_side
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator
from tests.reports import synthetic
from tests.reports.synthetic_motion import make_case

TIME = np.arange(10.0)
NOWHERE = np.zeros(10, dtype=np.bool_)
NAN = np.full(10, np.nan)
STUB: Any = SimpleNamespace
PENDULUM = System("p", "pendulum")
OWN = "u'' + exp(u) - 1 + u**5 = 0"
BARE = STUB(amplitude=TIME, standard_deviation=None, interval=None, time=TIME)
UNSEEN = STUB(omega=NAN, time=TIME, start=0.0, valid=NOWHERE)


@dataclass(frozen=True)
class Tracked:
    """As much of a track as its bias needs."""

    omega: np.ndarray
    time: np.ndarray
    start: float
    valid: np.ndarray


def curve(valid: np.ndarray = NOWHERE) -> Curve:
    return Curve("x", "x", "estimate", TIME, TIME + 1.0, valid)


def of(equation: str, small: str | None = None, **values: Any) -> Oscillator:
    made = Oscillator.from_equation(equation, parameters=values)
    return made if small is None else replace(made, small=small)


def pooled(**more: Any) -> Pooled:
    usual = dict.fromkeys(Pooled.__dataclass_fields__)
    usual |= {"system": PENDULUM, "amplitude": 1.0, "duration": 9.0, "snr_db": 20.0, "method": "x", "failures": 0}
    return Pooled(**{**usual, "coverage": 1.0, **more})  # type: ignore[arg-type]


# --- what is refused, and nothing for nothing ---


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (lambda: along(UNSEEN, TIME[:3]).tolist(), pytest.approx([np.nan] * 3, nan_ok=True)),
        (lambda: powers_of(of("u'' - eps**2*(1 - u**2)*u' + u = 0", "eps", eps=1)), None),
        (lambda: powers_of(of("u'' - eps*(1 - u**2)*u' + u + u**3 = 0", "eps", eps=1)), None),
        (lambda: strongest_line(np.ones(64), 1.0), (None, 0.0)),
        (lambda: slope(curve(), 0.0, 9.0), None),
        (lambda: slope(curve(~NOWHERE), 0.0, 9.0), pytest.approx(1.0)),
        (lambda: distance(curve(), curve()), None),
        (lambda: _estimate_row(STUB(time=TIME), Outcome(STUB(), None, "no"), None, print), None),
        (lambda: BackboneFit(np.array([2.0, -0.5]), np.zeros(2), 1.0)(np.array([2.0])).tolist(), [0.0]),
        (
            lambda: sorted(size_columns(STUB(amplitude=TIME, standard_deviation=None, interval=None, time=TIME), TIME)),
            ["amplitude"],
        ),
        (lambda: backbone._values(np.nan, 1.0, 0.0), "the formula has no finite value there"),
        (lambda: backbone.series_of(PENDULUM, "multiple-scales", 4).amplitude, "fundamental"),  # type: ignore[union-attr]
        (
            lambda: decay.errors_of(STUB(reference=TIME, inside=NOWHERE), STUB(omega=TIME), 0.0),
            "it gives no value on the interior of this motion",
        ),
        (lambda: predicted.exact_for(STUB(motion=STUB(has_backbone=True, averaged=None)), "averaged-action"), None),
        (lambda: reach.ReachTask(PENDULUM, "lindstedt", 2, (), (1.0, 2.0))._range([1e-9, "refused"], 1e-3), (1.0, 0)),
        (lambda: reach.ReachTask(PENDULUM, "lindstedt", 2, (), (1.0, 2.0))._range(["refused"], 1e-3), "refused"),
        (lambda: reach.ReachTask(PENDULUM, "lindstedt", 2, (), (1.0, 2.0))._range([-1e-9, 1.0], 1e-3), (1.0, 0)),
        (lambda: observed_order.theoretical(STUB(system=PENDULUM, method="minimax", orders=(2,)), 2), None),
        (lambda: best_estimator.best_of([pooled(rms=None)])["best"], "none"),
        (lambda: list(crossings.duels_of([pooled(rms=None)])), []),
        (lambda: list(error_budget.sentences([pooled()])), []),
        (lambda: study_report._spread(STUB(rows=lambda: []), {}), ""),
        (lambda: list(study_report._files(STUB(answers=(), cells=10**9))), []),
        (lambda: list(study_report._files(STUB(answers=(), cells=0, rows=lambda: []))), []),
        (lambda: derivation.harmonic_table(energy_integral(find("pendulum"), 2)), None),
    ],
)
def test_nothing_comes_of_nothing(value: Callable[[], object], expected: object) -> None:
    assert value() == expected


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: plane_of(STUB(track=None, recording=STUB(label="first"))), "first: there is no track"),
        (lambda: reach.ReachTask(PENDULUM, "lindstedt", 2, (), (4.0,))._excess(4.0, 1e-3), "4"),
        (lambda: cost.CostTask(PENDULUM, "series/numpy", (0,), (1.0,))._formula(0), "has one term or more"),
        (lambda: cost.CostTask(System("d", "duffing"), "series/numpy", (3,), (1.0,))._formula(3), "no pendulum"),
        (
            lambda: cost.CostTask(System("d", equation=OWN), "closed-form/numpy", (), (1.0,))._formula(None),
            "closed form",
        ),
        (lambda: over_power(energy_on_each_side(of("u'' + u + sign(u)*sqrt(abs(u)) = 0"), 2)), "no limits are read"),
    ],
)
def test_what_cannot_be_compared_is_refused(call: Callable[[], object], said: str) -> None:
    with pytest.raises(InputError, match=said):
        call()


@pytest.mark.parametrize("module", [grids, motions])
def test_a_block_of_another_measure_is_our_own_fault(module: Any) -> None:
    with pytest.raises(TypeError, match="is no task"):
        module.task_of(STUB(task=1))


# --- contenders ---


def test_contenders_that_another_distribution_or_machine_does_not_give(monkeypatch: pytest.MonkeyPatch) -> None:
    class Point(EntryPoint):
        def load(self) -> object:
            return 1

    with pytest.raises(InputError, match="is a int, not a function of samples and rate"):
        outsiders._called(Point("own", "elsewhere:own", "ridgeback.estimators"), TIME, 1.0)
    monkeypatch.setattr(formulas, "is_smooth", lambda *_: False)
    with pytest.raises(InputError, match="not smooth enough"):
        formulas.fitted(find("pendulum"), STUB(), Fraction(1), 2)


def test_an_estimate_that_fails_on_what_it_describes_keeps_its_bias() -> None:
    t = np.arange(64) / 8.0
    track: Any = Tracked(np.full(64, 6.0), t, 0.0, np.ones(64, dtype=np.bool_))
    blind: Any = Tracked(np.full(64, np.nan), t, 0.0, np.zeros(64, dtype=np.bool_))
    assert corrected(track, lambda _: blind, np.cos(6.0 * t), 8.0).omega.tolist() == [6.0] * 64


def test_a_program_that_fails_or_hangs(monkeypatch: pytest.MonkeyPatch) -> None:
    form = form_of(energy_integral(find("pendulum"), 2))
    outcomes = iter([Finished(1, "first\nlast line\n"), Finished(3, ""), None])
    monkeypatch.setattr(generated_code, "finished", lambda *_, **__: next(outcomes))
    assert generated_code.check(form, "python").detail.endswith("last line")
    assert generated_code.check(form, "python").detail.endswith("exit code 3")
    with pytest.raises(TimeoutError, match="no end within"):
        generated_code.check(form, "python")
    monkeypatch.setattr(generated_code, "tool_of", lambda _: None)
    assert generated_code.check(form, "julia").state == "skipped"


def test_what_a_flow_needs_and_a_motion_without_energy() -> None:
    row = Row("flow", "", "slow-flow", order=4, largest=0.1)
    assert verdict._limit(row).startswith("it needs no trajectory, only the equation and its start; its largest error")
    told = list(Account(None, STUB(headline=lambda: "components"), folding((3,), 1.0, 64.0), "s").sentences())
    assert told[0] == "components"
    assert len(told) == 2


# --- drifts ---


@pytest.mark.parametrize("slow", [True, False])
def test_a_drift_without_cycles_claims_no_error(slow: bool) -> None:
    adiabatic = STUB(is_slow=slow, action=np.array([1.0, 1.0]))
    found = STUB(
        adiabatic=adiabatic,
        rate=0.2,
        max_error=None,
        rms_error=None,
        expected_error=None,
        frozen_error=None,
        disagreement=1e-9,
    )
    assert len(drift.sentences(found)) == 1
    assert ("too few cycles" in drift_report.drift_title(found)) is slow
    assert ("not slow" in drift_report.drift_title(found)) is not slow
    assert ("counts as slow" in drift_report.findings(found)[0]) is not slow
    assert drift_report._ratio(found) is None


# --- motions and recordings ---


def test_rows_of_the_budget_without_a_value(monkeypatch: pytest.MonkeyPatch) -> None:
    from ridgeback.compare.motion import error_budget as budget

    monkeypatch.setattr(budget, "relative_error", lambda *_: NAN)
    monkeypatch.setattr(budget, "_interior", lambda _, __, values: values)
    assert _model_row(STUB(reference=None), curve()) is None
    outcome = Outcome(STUB(name="x", label="x", bare=STUB(velocity=False)), STUB())
    monkeypatch.setattr(Outcome, "curve", property(lambda self: None if self.track is None else curve()))
    monkeypatch.setattr(budget, "_sampled", lambda *_: curve())
    assert _estimate_row(STUB(reference=None, time=TIME), outcome, None, print) is None
    monkeypatch.setattr(budget, "attempt", lambda *_, **__: Outcome(STUB(), None, "too short"))
    known = STUB(velocity=TIME, signal=TIME)
    assert estimator_error(STUB(trajectory=STUB(rate=1.0)), outcome, known) is None


def test_a_recipe_that_is_refused_says_why(monkeypatch: pytest.MonkeyPatch) -> None:
    from ridgeback.compare.motion import estimate_curves

    def refused(*_: object, **__: object) -> None:
        raise InputError("too short")

    monkeypatch.setattr(estimate_curves, "run", refused)
    outcome = attempt(STUB(name="x", label="X"), TIME, 1.0)
    assert (outcome.curve, outcome.failed) == (None, "too short")


def test_a_wigner_error_without_a_known_motion_has_no_cause() -> None:
    score = Score(WIGNER, "Wigner", "estimate", 9.5e-3, None, None, None, None)
    evidence = Evidence(STUB(), {}, {WIGNER: score}, STUB(), STUB(), None)
    assert _cause(evidence) == "Against the cycle frequency the error is 0.95 % rms."
    assert evidence.rms("other") == "no value"


def test_a_sample_recording_shows_itself() -> None:
    found = sample(NAMES[0])
    assert found.headline().startswith(f"{found.name}: ")
    assert "value" in found.own_units()
    assert found.picture().strokes[0].y is found.recording.values


def test_words_of_a_start_and_of_a_recording_of_which_nothing_is_known() -> None:
    case = replace(make_case(), initial=(0.5, 0.25), unit="m")
    assert start_line(case) == "from θ = 0.5 m, θ′ = 0.25"
    found = synthetic.make_recording()
    assert recording_sentences(found, None) == ()
    assert "What made it" in recording_sentences(found, replace(synthetic.make_identification(), prediction=None))[0]


# --- identification ---


def test_no_class_that_could_be_fitted_is_a_refusal_with_every_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(name: str, *_: object) -> None:
        raise InputError(f"{name} diverged")

    monkeypatch.setattr(fits, "best_with", refused)
    with pytest.raises(InputError, match="no candidate could be fitted: duffing diverged; pendulum diverged"):
        fits.rank(STUB(), ("duffing", "pendulum"), (STUB(),), "bic", silent)


def test_a_fit_that_does_not_start_is_never_the_best(monkeypatch: pytest.MonkeyPatch) -> None:
    data = STUB(kept=np.ones(9, dtype=np.bool_))
    lost = fitting.failed(STUB(), data, np.zeros(3))
    assert np.isinf(lost.sum_of_squares)
    monkeypatch.setattr(fitting, "refined", lambda *_: lost)
    monkeypatch.setattr(fitting, "backbone_cost", lambda *_: (np.inf, np.zeros(3)))
    model = STUB(groups=((1.0, 2.0),), name="own")
    assert fitting.starts(model, data) == []
    with pytest.raises(InputError, match="own: no starting value led to a fit"):
        fitting.fit(model, data)


# --- reports ---


@pytest.mark.parametrize(("own", "top"), [(0.5, None), (40.0, 60.0)])
def test_amplitudes_of_a_limit_cycle_reach_beyond_its_own_strength(own: float, top: float | None) -> None:
    from ridgeback.compare.report.system_report import BEYOND, CYCLE_STRENGTHS

    case = STUB(parameters={"eps": own})
    motion = STUB(energy_peak=np.ones(1), setting=STUB(case=lambda: case, oscillator=STUB(small="eps")))
    grid = _amplitudes(motion, STUB(expansion=STUB(variable="eps")))
    assert grid[-1] == pytest.approx(CYCLE_STRENGTHS[-1] if top is None else BEYOND * own)


@pytest.mark.parametrize(("radius", "start", "top"), [(None, 1.0, "beyond"), (2.0, 1.0, "radius")])
def test_amplitudes_without_a_separatrix(radius: float | None, start: float, top: str) -> None:
    from ridgeback.compare.report.system_report import BEYOND

    limits = STUB(radius=radius)
    derived = STUB(expansion=STUB(variable="A"), undamped=STUB(limit=None), limits=limits)
    grid = _amplitudes(STUB(energy_peak=np.array([start])), derived)
    assert grid[-1] == pytest.approx(BEYOND * start if top == "beyond" else max(BEYOND * start, 1.5 * 2.0))


def test_outside_estimators_and_own_bias_in_studies(monkeypatch: pytest.MonkeyPatch) -> None:
    case = STUB(motion=STUB(trajectory=STUB(rate=8.0)), time=TIME)
    seen = STUB(omega=np.full(10, 2.0), time=TIME, start=0.0, valid=~NOWHERE)
    monkeypatch.setattr(estimated, "OUTSIDERS", {"theirs": lambda *_: seen})
    assert estimated.estimated(case, "theirs", TIME).tolist() == [2.0] * 10
    monkeypatch.setattr(estimated, "_plain", lambda *_, **__: seen)
    monkeypatch.setattr(
        estimated, "corrected", lambda track, *_: STUB(omega=track.omega + 1, time=TIME, valid=~NOWHERE)
    )
    assert estimated.estimated(case, f"wigner/{estimated.OWN_BIAS}", TIME).tolist() == [3.0] * 10
