"""Studies along motions: the paper's decay by order, noise that does not depend on who computes, crossings."""

from __future__ import annotations

import itertools
import math
from pathlib import Path

import numpy as np
import pytest

from ridgeback.compare.studies.file.reading import plan_of
from ridgeback.compare.studies.measures.decay import DecayTask
from ridgeback.compare.studies.measures.estimated import noisy
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.questions import best_estimator, crossings, decay_error, error_budget
from ridgeback.compare.studies.questions.crossings import Duel, axes_of
from ridgeback.compare.studies.questions.crossings import crossings as crossings_along
from ridgeback.compare.studies.running import tasks_of
from ridgeback.compare.studies.tasks import Finished, Outcome, run

PAPER = """
[study]
ask = ["decay-error", "crossings"]
[[oscillator]]
system = "damped-pendulum"
parameters = { k = 12.566370614359172, mu = 0.01 }
amplitudes = 2.9845130209103035
[grid]
orders = [2, 4, 6, 8, 12, 16, 20, 30, 40]
methods = ["multiple-scales", "lindstedt/action", "series/energy", "averaged-action", "pseudo-wigner"]
[signal]
duration = 20
rate = 64
"""
NOISE = """
[study]
ask = "best-estimator"
[[oscillator]]
system = "damped-linear"
amplitudes = 1
[grid]
methods = ["zero-crossing", "hilbert", "linear"]
[signal]
periods = 12
samples_per_period = 16
snr_db = [inf, 20, 40]
trials = 7
seed = 5
"""


ODD = """
[study]
ask = "decay-error"
[[oscillator]]
system = "van-der-pol"
parameters = { eps = 0.3 }
amplitudes = 1
[[oscillator]]
system = "damped-pendulum"
amplitudes = 2
[grid]
orders = [0, 4]
methods = [
    "lindstedt/energy", "lindstedt/action", "series/energy", "pade/energy", "averaged-action", "closed-form/energy",
    "harmonic-least-squares/global",
]
[signal]
periods = 12
samples_per_period = 16
"""


def blocks(plan: Plan) -> list[Finished]:
    return [Finished(task, run(task)) for task in tasks_of(plan)]


@pytest.fixture(scope="module")
def paper() -> tuple[Plan, list[Finished]]:
    plan = plan_of(PAPER)
    return plan, blocks(plan)


def test_a_method_that_a_motion_has_no_use_for_says_why() -> None:
    """A limit cycle has one frequency, whatever its energy; what goes by energy, or is of a pendulum, it refuses."""
    found: dict[tuple[object, ...], Outcome] = {
        (block.task.system.name, at[0], at[4]): outcome
        for block in blocks(plan_of(ODD))
        for at, outcome in block.rows()
    }
    reasons = {key: outcome for key, outcome in found.items() if isinstance(outcome, str)}
    vdp, pendulum = "van-der-pol", "damped-pendulum"
    assert reasons == {
        **{(vdp, "series/energy", n): f"{vdp} is no pendulum; the series (14) is of k^2 sin(u)" for n in (0, 4)},
        **{(vdp, "pade/energy", n): f"{vdp} has no A(t) from the energy: fit only" for n in (0, 4)},
        (vdp, "averaged-action", None): f"{vdp} has no averaged action",
        (vdp, "closed-form/energy", None): f"{vdp} has no potential, so no frequency for each energy",
        (pendulum, "series/energy", 0): "the series (14) has one term or more",
        (pendulum, "pade/energy", 0): f"{pendulum}: omega0 is constant through order 0; nothing is to be resummed",
    }
    rms = {key: float(outcome[0]) for key, outcome in found.items() if not isinstance(outcome, str)}  # type: ignore[arg-type]
    assert rms[vdp, "lindstedt/energy", 4] == rms[vdp, "lindstedt/action", 4] < 0.2 * rms[vdp, "lindstedt/energy", 0]
    assert rms[pendulum, "lindstedt/action", 4] < 0.01 * rms[pendulum, "lindstedt/action", 0]
    assert rms[vdp, "harmonic-least-squares/global", None] < 1e-3


def test_errors_along_the_paper_s_decay(paper: tuple[Plan, list[Finished]]) -> None:
    """Multiple scales by order, the expansion at the averaged action, (14) by terms: figures found independently."""
    found = decay_error.answer(*paper)
    errors = {(row["method"], row["order"]): row["rms"] for row in found.rows()}
    scales = {2: 0.316, 4: 0.117, 6: 0.085, 8: 0.0578, 12: 0.0275, 16: 0.0137}
    for order, expected in scales.items():
        assert errors["multiple-scales", order] == pytest.approx(expected, rel=0.01)
    for order, expected in {20: 7.2e-4, 30: 2.1e-4, 40: 1.4e-4}.items():
        assert errors["lindstedt/action", order] == pytest.approx(expected, rel=0.02)
    assert errors["pseudo-wigner", None] == pytest.approx(4.6e-4, rel=0.02)
    assert errors["averaged-action", None] == pytest.approx(1.28e-4, rel=0.02)
    growth = [row["growth_rms"] for row in found.rows() if row["method"] == "multiple-scales"]
    assert all(later < 0.8 * earlier for earlier, later in itertools.pairwise(growth[:6]))
    assert found.failed == 0


def test_the_expansion_passes_pseudo_wigner_between_orders_20_and_30(paper: tuple[Plan, list[Finished]]) -> None:
    rows = crossings.answer(*paper).rows()
    mine = [row for row in rows if row["expansion"] == "lindstedt/action" and row["axis"] == "order"]
    assert [(row["below"], row["above"], row["ahead_above"], row["settled"]) for row in mine] == [
        (20.0, 30.0, "expansion", True)
    ]


def test_the_growth_rate_of_a_linear_oscillator_is_exact() -> None:
    """a'/a = -mu: multiple scales has it at every order, and the reference finds it from the energy."""
    plan = plan_of(NOISE.replace('"best-estimator"', '"decay-error"').replace('"linear"]', '"multiple-scales"]'))
    rows = decay_error.answer(plan, blocks(plan)).rows()
    growth = [row["growth_rms"] for row in rows if row["method"] == "multiple-scales"]
    assert max(growth) < 1e-3  # mu^2: energy at a zero crossing has the damping in its phase


def test_trials_are_the_same_records_in_any_blocks() -> None:
    plan = plan_of(NOISE)
    noisy_tasks = [t for t in tasks_of(plan) if isinstance(t, DecayTask) and t.snr_db == 20.0]
    assert [(t.first, t.last) for t in noisy_tasks] == [(0, 5), (5, 7)]
    one = DecayTask(**{**vars(noisy_tasks[0]), "first": 5, "last": 7})
    assert run(one) == run(noisy_tasks[1])
    x = np.sin(np.arange(64.0))
    assert not np.array_equal(noisy(x, 20.0, 5, 0), noisy(x, 20.0, 5, 1))
    assert not np.array_equal(noisy(x, 20.0, 5, 0), noisy(x, 20.0, 6, 0))


def test_the_best_estimator_is_named_with_those_that_are_as_good() -> None:
    plan = plan_of(NOISE)
    found = best_estimator.answer(plan, blocks(plan))
    assert [row["snr_db"] for row in found.rows()] == [math.inf, 20.0, 40.0]
    assert all(row["best"] in ("zero-crossing", "hilbert") for row in found.rows())
    assert all(row["rms"] <= (row["next_rms"] or math.inf) for row in found.rows())


def test_a_method_that_an_oscillator_does_not_allow_is_a_reason() -> None:
    plan = plan_of(NOISE.replace('"best-estimator"', '"decay-error"').replace('"linear"]', '"series/energy"]'))
    reasons = {o for block in blocks(plan) for o in block.outcomes if isinstance(o, str)}
    assert reasons == {"damped-linear is no pendulum; the series (14) is of k^2 sin(u)"}


@pytest.mark.parametrize(("ratios", "expected"), [((1.0, -1.0, -2.0), [1.5]), ((-1.0, 3.0, -1.0), [1.25, 2.75])])
def test_crossings_lie_where_the_ratio_is_zero(ratios: tuple[float, ...], expected: list[float]) -> None:
    duels = [Duel("s", {"order": float(i), "mu": 0.1}, "e", "w", r, True) for i, r in enumerate(ratios, start=1)]
    assert axes_of(duels) == ["order"]
    assert [crossing.at for crossing in crossings_along(duels, "order")] == pytest.approx(expected)


def test_the_figure_of_crossings_has_one_order_for_each_amplitude_pair_and_noise() -> None:
    """Other axes stand at the first of their values, which the title says; the last overtaking counts."""
    ratios = {1.0: (1.0, -1.0, 1.0, -1.0), 2.0: (1.0, 1.0, 1.0, -1.0)}
    duels = [
        Duel("s", {"amplitude": a, "duration": d, "snr_db": n, "mu": 0.1, "order": float(i)}, "e", "w", r, True)
        for a, line in ratios.items()
        for d, n in itertools.product((20.0, 40.0), (math.inf, 20.0))
        for i, r in enumerate(line, start=1)
    ]
    picture = crossings.drawing(list(crossings_along(duels, "order")), "mine")
    assert picture.title == "mine: duration = 20, mu = 0.1"
    assert [stroke.label for stroke in picture.strokes] == ["e, w", "e, w, 20 dB"]
    assert all((list(stroke.x), list(stroke.y)) == ([1.0, 2.0], [4.0, 4.0]) for stroke in picture.strokes)


def test_an_order_from_which_an_expansion_does_not_stay_ahead_is_not_drawn() -> None:
    """Ahead at 2 and behind again at 3: nothing; another oscillator's parameters are its own."""
    lines = {("s", "mu"): (1.0, -1.0, 1.0), ("other", "eps"): (1.0, -1.0, -1.0)}
    duels = [
        Duel(system, {"amplitude": 1.0, name: 0.1, "snr_db": math.inf, "order": float(i)}, "e", "w", r, True)
        for (system, name), line in lines.items()
        for i, r in enumerate(line, start=1)
    ]
    picture = crossings.drawing(list(crossings_along(duels, "order")), "mine")
    assert picture.title == "mine: eps = 0.1"
    assert [(list(stroke.x), list(stroke.y)) for stroke in picture.strokes] == [([1.0], [2.0])]


def test_a_study_of_motions_resumes_to_the_same_bytes(tmp_path: Path) -> None:
    from ridgeback.interface.studies import run_study

    file = tmp_path / "noise.toml"
    file.write_text(NOISE, encoding="utf-8")
    first = list(run_study(file).rows())
    again = list(run_study(file, store=tmp_path / "again.db").rows())
    assert first == again
    assert len(first) == 1 + 2 + 2 * 2 * 7


def test_the_budget_of_a_prediction_adds_up() -> None:
    """k = 3, mu = 0.3: the slow flow and (3) hold mu^2, so averaging is not charged for it."""
    text = PAPER.replace("k = 12.566370614359172, mu = 0.01", "k = 3, mu = 0.3").replace("2.9845130209103035", "2")
    methods = 'methods = ["multiple-scales", "linear", "lindstedt/action"]\n'
    text = text.replace('["decay-error", "crossings"]', '"error-budget"').replace("rate = 64", "rate = 16")
    plan = plan_of("\n".join(methods if line.startswith("methods") else line for line in text.splitlines()))
    rows = error_budget.answer(plan, blocks(plan)).rows()
    for row in rows:
        assert row["rms"] <= row["truncation"] + row["averaging"] + row["closure"] + 1e-15
        assert row["closure"] <= 4.0 * row["truncation"] * max(row["averaging"], row["floor"]) + 1e-15
    averaging = {row["method"]: row["averaging"] for row in rows}
    assert averaging["multiple-scales"] < 3e-4
    assert averaging["lindstedt/action"] == pytest.approx(5.2e-3, rel=0.05)


def test_a_bilinear_oscillator_goes_through_by_its_energy_integral() -> None:
    """Each side is linear, so omega0 = 2 / (1 / sqrt(k1) + 1 / sqrt(k2)) at every amplitude."""
    plan = plan_of("""
[study]
ask = "decay-error"
[[oscillator]]
name = "bilinear"
equation = "u'' + 2*mu*u' + k1*max(u, 0) + k2*min(u, 0) = 0"
parameters = { mu = 0.005, k1 = 1, k2 = 4 }
amplitudes = 0.5
[grid]
orders = [2, 4]
methods = ["energy-integral/action", "energy-integral/energy", "averaged-action", "lindstedt/action"]
[signal]
periods = 12
samples_per_period = 16
""")
    found = decay_error.answer(plan, blocks(plan))
    assert found.failed == 2  # Lindstedt's recursion needs a force that is analytic at rest
    assert len(found.rows()) == 5
    assert all(row["rms"] < 5e-5 for row in found.rows())
