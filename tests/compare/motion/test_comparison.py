"""The paper's case end to end: figures measured independently beforehand, and what must hold by construction."""

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.compare.motion.comparison import compare_motion
from ridgeback.compare.motion.estimate_curves import LEAN, SHORT
from ridgeback.compare.motion.motion import integrate_motion, setting
from ridgeback.compare.motion.paper_case import paper_case
from ridgeback.compare.motion.reconstruction import known_motion
from ridgeback.compare.motion.results import BiasCause
from ridgeback.symbolic.systems.catalogue import find


@pytest.fixture(scope="module")
def paper():
    labels = []
    result = compare_motion(paper_case(), progress=lambda fraction, label: labels.append((fraction, label)))
    fractions = [fraction for fraction, _ in labels]
    assert fractions == sorted(fractions)
    assert all(0 <= fraction <= 1 for fraction in fractions)
    return result


@pytest.fixture(scope="module")
def scores(paper):
    return {score.method: score for score in paper.scores}


def test_the_papers_final_amplitude_and_frequency_range(paper):
    assert paper.amplitudes.energy[-1] / np.pi == pytest.approx(0.659, abs=5e-4)
    smooth = next(curve for curve in paper.curves if curve.name == "averaged-action")
    assert smooth.omega[0] / (2 * np.pi) == pytest.approx(0.798, abs=5e-4)
    assert smooth.omega[-1] / (2 * np.pi) == pytest.approx(1.470, abs=2e-3)


def test_two_integrators_agree(paper):
    assert len(paper.integrators) in (2, 3)  # a third where heyoka is installed
    assert 0 < paper.disagreement < 1e-7


def test_the_amplitude_passes_through_the_turning_points(paper):
    at = paper.amplitudes.turning_time
    up = paper.amplitudes.turning_value > 0
    found = np.interp(at[up], paper.amplitudes.time, paper.amplitudes.energy)
    np.testing.assert_allclose(found, paper.amplitudes.turning_value[up], rtol=1e-6)


def test_the_model_of_the_paper_ripples_and_averaging_removes_it(scores):
    assert scores["closed-form"].rms_interior == pytest.approx(1.9e-3, rel=0.1)
    assert abs(scores["closed-form"].mean_interior) < 1e-4
    assert scores["averaged-action"].rms_interior < 0.1 * scores["closed-form"].rms_interior
    assert scores["closed-form"].rms_end < scores["closed-form"].rms_interior < scores["closed-form"].rms_start


def test_the_full_wigner_peak_lies_low_and_a_window_cures_it(scores):
    assert scores["wigner"].rms_interior == pytest.approx(9.5e-3, rel=0.05)
    assert scores["wigner"].mean_interior < -5e-3
    assert scores["pseudo-wigner"].rms_interior == pytest.approx(4.8e-4, rel=0.15)
    assert scores["pseudo-wigner-corrected"].rms_interior < 2e-5
    assert scores["harmonic-least-squares"].rms_interior < 5e-5


def test_expansions_converge_towards_the_exact_backbone_at_the_same_amplitude(paper):
    rows = {row.method: row for row in paper.budget}
    errors = [rows[f"lindstedt-{order}"].truncation for order in (4, 20)]
    assert errors[0] > 10 * errors[1]
    assert rows["series-3"].truncation > rows["series-20"].truncation > rows["closed-form"].truncation == 0


def test_the_budget_closes(paper):
    for row in paper.budget:
        parts = [part for part in (row.truncation, row.averaging, row.estimator) if part is not None]
        assert row.total <= sum(parts) + row.closure + 1e-12
        if row.estimator is None:
            # what is left of a model is the product of its two parts, which may peak together
            assert row.closure <= 3 * row.truncation * max(row.averaging, 1e-12) + 1e-12
        else:
            assert row.closure <= max(0.05 * row.total, 3e-5)


def test_the_reference_is_better_than_what_is_held_against_it_and_the_definitions_limit_is_said(paper):
    rows = {row.method: row for row in paper.budget}
    best = rows["pseudo-wigner-corrected"]
    assert best.reference < best.total < best.definition
    assert "turning points" in best.note
    assert "turning points" not in rows["wigner"].note


def test_statements_cover_the_nine_figures_with_their_curves(paper):
    assert [statement.figure for statement in paper.statements] == list(range(1, 10))
    known = (*paper.curves, *paper.harmonics)
    for statement in paper.statements:
        assert statement.measured
        assert all(any(curve is other for other in known) for curve in statement.curves)
    assert paper.wigner_bias.cause is BiasCause.CURVATURE
    assert paper.wigner_bias.fundamental_only == pytest.approx(paper.wigner_bias.measured, rel=0.1)
    text = {statement.figure: statement.measured for statement in paper.statements}
    assert "0.659 π" in text[1]
    assert "ripples 2.00 times per cycle" in text[4]
    assert "curvature, not harmonics" in text[7]
    assert "slip" in text[9]


def test_harmonics_are_multiples_and_the_raw_peak_is_not(paper):
    curves = {curve.name: curve for curve in paper.harmonics}
    reference = np.interp
    inside = (paper.time >= 2) & (paper.time <= 18)
    truth = reference(
        paper.time, paper.reference.time[paper.reference.valid], paper.reference.omega[paper.reference.valid]
    )

    def error(name):
        curve = curves[name]
        keep = inside & curve.valid
        return np.sqrt(np.mean((curve.omega[keep] / (3 * truth[keep]) - 1) ** 2))

    assert error("harmonic-3") < 1e-3
    assert error("harmonic-3-raw") > 0.05


def test_models_of_the_signal_improve_with_components_and_time(paper):
    made = paper.reconstruction
    assert made.rms_multicomponent < 0.25 * made.rms_single < 0.25
    difference = np.abs(made.single - made.signal)
    assert difference[paper.time > 18].max() < difference[paper.time < 2].max()


def test_every_curve_is_scored_once(paper):
    assert sorted(score.method for score in paper.scores if not score.failed) == sorted(c.name for c in paper.curves)


def test_planes_are_levels_below_their_maximum(paper):
    for image in (paper.spectrogram_u, paper.spectrogram_velocity):
        assert image.level_db.shape == (image.omega.size, image.time.size)
        assert image.level_db.max() == pytest.approx(0.0, abs=1e-12)
        assert image.level_db.min() >= image.floor_db


def test_the_wigner_plane_keeps_its_sign_and_peaks_at_the_fundamental(paper):
    """Half-way both signs are there (fringes), and the largest value lies on the reference to a few per cent."""
    plane = paper.wigner_u
    assert plane.values.shape == (plane.omega.size, plane.time.size)
    assert np.abs(plane.values).max() == pytest.approx(1.0, abs=1e-12)
    assert plane.values.min() < -0.05
    middle = int(np.argmin(np.abs(plane.time - 10.0)))
    found = plane.omega[int(np.argmax(plane.values[:, middle]))]
    reference = np.interp(10.0, paper.reference.time, paper.reference.omega)
    assert found == pytest.approx(reference, rel=0.03)


def test_multiple_scales_follows_a_small_decay():
    chosen = setting(find("damped-pendulum"), initial=(0.8, 0.0), duration=80.0, rate=4.0)
    result = compare_motion(chosen, orders=(2, 8), recipes=())
    scores = {score.method: score for score in result.scores}
    assert scores["multiple-scales-8"].rms_interior < 5e-6  # the fundamental amplitude needs no energy: no ripple
    assert scores["lindstedt-8"].rms_interior < 1e-3


def test_a_limit_cycle_is_followed_into_its_orbit():
    chosen = setting(find("van-der-pol").with_parameters({"eps": "0.3"}), initial=(0.3, 0.0), duration=80.0, rate=4.0)
    result = compare_motion(chosen, orders=(2, 12), recipes=())
    assert result.amplitudes.averaged is None
    assert result.amplitudes.energy[-1] == pytest.approx(2.0, abs=0.01)
    late = result.time > 65
    best = next(curve for curve in result.curves if curve.name == "lindstedt-12")
    known = late & result.reference.valid
    np.testing.assert_allclose(result.reference.omega[known], best.omega[known], rtol=1e-6)
    assert 4 not in [statement.figure for statement in result.statements]


def test_an_asymmetric_well_has_an_offset_and_even_harmonics():
    chosen = setting(find("damped-helmholtz-duffing"), initial=(0.3, 0.0), duration=100.0, rate=5.0)
    result = compare_motion(chosen, orders=(2, 4), recipes=SHORT)
    assert "harmonic-2" in {curve.name for curve in result.harmonics}
    assert "mean offset" in result.statements[1].measured
    scores = {score.method: score for score in result.scores}
    assert not [name for name in scores if name.startswith("series")]
    assert scores["closed-form"].rms_interior < 2e-3


def test_an_estimate_that_fails_is_kept_with_its_reason():
    chosen = setting(find("damped-pendulum"), initial=(1.0, 0.0), duration=34.0, rate=2.0)
    result = compare_motion(chosen, orders=(2,), recipes=LEAN)
    failed = [score for score in result.scores if score.failed]
    assert all(score.rms_interior is None for score in failed)
    assert len(result.scores) >= 13


def test_too_short_a_motion_is_refused():
    with pytest.raises(InputError, match="longer duration"):
        integrate_motion(setting(find("pendulum"), initial=(1.0, 0.0), duration=12.0, rate=8.0))
    with pytest.raises(InputError, match="duration -1"):
        setting(find("pendulum"), duration=-1.0)


@pytest.mark.parametrize("initial", [(2.0, 0.0), (0.5, 1.2), (-0.3, -1.0)], ids=["peak", "rising", "falling"])
def test_the_known_motion_is_the_real_one_to_first_order_in_the_damping(initial):
    motion = integrate_motion(setting(find("damped-pendulum"), initial=initial, duration=60.0, rate=6.0), digits=None)
    known = known_motion(motion)
    apart = np.sqrt(np.mean((known.signal - motion.trajectory.u) ** 2) / np.mean(motion.trajectory.u**2))
    assert apart < 0.05
    turned = np.sqrt(
        np.mean((known.velocity - motion.trajectory.velocity) ** 2) / np.mean(motion.trajectory.velocity**2)
    )
    assert turned < 0.05


@pytest.mark.parametrize("duration", [20.0, 47.3, 200.0])
def test_a_duration_that_is_asked_for_is_what_is_followed(duration):
    chosen = setting(find("damped-pendulum"), duration=duration)
    assert chosen.rate * duration == pytest.approx(round(chosen.rate * duration / 8) * 8, abs=1e-9)
    assert 32 / (2 * np.pi) <= chosen.rate < 32 / (2 * np.pi) + 8 / duration
    if duration == 47.3:
        assert integrate_motion(chosen, digits=None).time[-1] == pytest.approx(duration, abs=1e-9)
