"""A recording made from a known oscillator: its backbone is found again, with honest bands."""

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.compare.binding.bind import bind
from ridgeback.compare.recording.backbone_fit import fit_backbone, formula_of
from ridgeback.compare.recording.recording import compare_recording
from ridgeback.compare.report.recording_report import recording_report
from ridgeback.compare.report.recording_summary import recording_cards, recording_sentences, recording_title
from ridgeback.numeric.motion.trajectory import integrate
from ridgeback.numeric.recording.recording import Recording
from ridgeback.symbolic.systems.catalogue import find

RATE = 20.0


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    """A damped Duffing oscillator with k = 6 rad/s and a little seeded noise, written as a user would."""
    oscillator = find("damped-duffing-hardening").with_parameters({"k": 6, "eps": 8, "mu": "0.06"})
    run = integrate(bind(oscillator), (1.0, 0.0), duration=30.0, rate=RATE)
    noisy = run.u + 1e-3 * np.random.default_rng(7).standard_normal(run.u.size)
    file = tmp_path_factory.mktemp("recording") / "decay.csv"
    rows = "".join(f"{t:.4f},{u:.9f}\n" for t, u in zip(run.time, noisy, strict=True))
    file.write_text("time_s,position [mm]\n" + rows)
    return file


@pytest.fixture(scope="module")
def found(path):
    oscillator = find("duffing-hardening").with_parameters({"k": 6, "eps": 8})
    return compare_recording(path, methods=("harmonic-least-squares", "pseudo-wigner"), oscillator=oscillator)


def test_the_backbone_is_that_of_the_oscillator(found):
    """omega = k + 3 eps a^2 / (8 k) - 15 eps^2 a^4 / (256 k^3) in the fundamental amplitude."""
    a = found.backbone_amplitude
    expected = 6 + 3 * 8 * a**2 / 48 - 15 * 64 * a**4 / (256 * 216)
    inside = a > 0.2
    np.testing.assert_allclose(found.backbone_omega[inside], expected[inside], rtol=3e-3)
    off = np.abs(found.backbone_omega - expected) / found.backbone_omega_sd
    assert np.median(off[inside]) < 4


def test_the_growth_rate_is_found(found):
    inside = found.backbone_amplitude > 0.2
    np.testing.assert_allclose(found.growth_rate[inside], -0.06, rtol=0.12)


def test_theory_is_overlaid_at_the_measured_amplitude(found):
    (theory,) = found.theory
    measured = np.interp(theory.time, found.curves[0].time, found.curves[0].omega)
    middle = theory.valid & (theory.time > 3) & (theory.time < 20)
    np.testing.assert_allclose(theory.omega[middle], measured[middle], rtol=3e-3)


def test_sources_and_mutual_distances_are_told(found, path):
    assert found.source == path.name
    assert len(found.sha256) == 64
    assert found.column == "position [mm]"
    assert any("distance of the other tracks" in note for note in found.notes)


def test_the_fit_gives_back_its_coefficients_and_their_uncertainty():
    rng = np.random.default_rng(3)
    a = np.linspace(0.1, 1.0, 24)
    sigma = np.full(24, 1e-3)
    off = []
    for _ in range(60):
        fit = fit_backbone(a, 5 + 0.4 * a**2 + sigma * rng.standard_normal(24), sigma)
        off.append((fit.coefficients[0] - 5) / fit.deviations[0])
    assert np.sqrt(np.mean(np.square(off))) == pytest.approx(1.0, abs=0.35)
    assert formula_of(fit).left == r"\omega_0(a)"


def test_too_few_points_are_not_fitted():
    assert fit_backbone(np.array([1.0, 2.0]), np.array([1.0, 1.0]), np.array([0.1, 0.1])) is None


def test_a_method_that_fails_is_named_and_all_failing_is_an_error(path):
    result = compare_recording(path, methods=("nonsense", "pseudo-wigner"))
    assert result.chosen == "pseudo-wigner"
    assert any("nonsense" in note for note in result.notes)
    with pytest.raises(InputError, match="no estimator succeeded"):
        compare_recording(path, methods=("nonsense",))


def test_the_report_states_what_was_found(path):
    report = recording_report(path, command="ridgeback report decay.csv", trials=2)
    assert report.title.endswith("hardening")
    assert report.decay is None
    assert len(report.cards) == 3
    assert report.provenance.input_hash == report.recording.sha256
    assert report.csv["backbone.csv"].startswith("amplitude,omega,omega_standard_deviation")
    assert report.identification.best.omega[-1] > report.identification.best.omega[0]
    assert report.summary[0].startswith("What made it: ")
    assert report.noise.trials == 2


def beside(other: np.ndarray, seed: int) -> Recording:
    """A damped oscillation at 20 Hz with another motion beside it, in a little noise."""
    t = np.arange(1200) / 400.0
    noise = 0.01 * np.random.default_rng(seed).normal(size=t.size)
    return Recording.from_arrays(np.exp(-0.4 * t) * np.cos(40 * np.pi * t) + other + noise, 400.0)


def test_the_backbone_of_a_report_is_that_of_one_mode_and_its_growth_rate_holds() -> None:
    t = np.arange(1200) / 400.0
    found = compare_recording(
        beside(0.4 * np.exp(-0.5 * t) * np.cos(43.2 * np.pi * t), 1), methods=("harmonic-least-squares",)
    )
    assert found.doubt == ""
    assert abs(found.amplitude[0] - np.exp(-0.4 * found.amplitude_time[0])) < 0.02
    assert np.mean(np.abs(found.growth_rate + 0.4) < 3.0 * found.growth_rate_sd) > 0.8
    assert np.median(found.growth_rate_sd) < 0.01


def test_a_report_claims_no_uncertainty_where_no_model_of_one_oscillation_holds_and_says_so_first() -> None:
    t = np.arange(1200) / 400.0
    blow = np.where(t < 1.5, 0.0, 0.8 * np.exp(-0.4 * (t - 1.5)) * np.sin(40 * np.pi * t))
    found = compare_recording(beside(blow, 2), methods=("harmonic-least-squares",))
    assert found.doubt.startswith("No uncertainty is claimed: ")
    assert np.isnan(found.backbone_omega_sd).all()
    assert np.isnan(found.growth_rate_sd).all()
    assert recording_sentences(found, None)[0] == f"{found.doubt}."
    assert recording_title(found).endswith("no uncertainty is claimed")
    shown = [value for card in recording_cards(found) for _, value in card.rows]
    assert not any("±" in value or "nan" in value for value in shown)


@pytest.mark.parametrize(("limit", "hum", "words"), [(9.0, 0.05, "a steady tone at 2.307"), (0.6, 0.0, "clipped")])
def test_what_was_taken_off_and_left_out_is_among_the_findings(limit, hum, words):
    time = np.arange(900) / 15.0
    x = np.exp(-0.06 * time) * np.cos(12.6 * time) + hum * np.cos(14.5 * time)
    x = np.clip(x + 2e-3 * np.random.default_rng(3).standard_normal(900), -limit, limit)
    found = compare_recording(Recording.from_arrays(x, 15.0), methods=("harmonic-least-squares",))
    assert words in " ".join(recording_sentences(found, None))
