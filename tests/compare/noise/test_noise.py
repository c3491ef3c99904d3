"""Noise studies: seeded, the same on any executor, honest about failures, and the flagship at the Cramer-Rao bound."""

from __future__ import annotations

import json
import math
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.compare.noise.monte_carlo import attempt, judged, monte_carlo, noisy, truth_of
from ridgeback.compare.noise.results import NoiseStudy, Trial, cell_of, read_study
from ridgeback.compare.noise.truth import Truth, oscillator_truth, paper_truth, recording_truth
from ridgeback.numeric.tracking.track import Track
from ridgeback.symbolic.systems.catalogue import find


@pytest.fixture(scope="module")
def paper() -> Truth:
    return paper_truth()


@pytest.fixture(scope="module")
def small(paper: Truth) -> NoiseStudy:
    return monte_carlo(paper, methods=("pseudo-wigner", "hilbert"), snr_db=(10.0, 40.0), trials=6, intervals=False)


def test_harmonic_least_squares_is_efficient(paper: Truth) -> None:
    """At most 1.2 times the bound from 0 to 30 dB; an unbiased estimator that beat it would show a wrong bound.

    At 0 dB the model of the whole record may be a polynomial of low degree, whose bias exceeds the lower bound of its
    few parameters, and which errs less than the unbiased local fit all the same.
    """
    methods = ("harmonic-least-squares/local", "harmonic-least-squares/global")
    study = monte_carlo(paper, methods=methods, snr_db=(0.0, 20.0, 30.0), trials=6, intervals=False)
    rms = {(cell.method, cell.snr_db): cell.rms for cell in study.cells}
    assert rms["harmonic-least-squares/global", 0.0] < rms["harmonic-least-squares/local", 0.0]
    for cell in study.cells:
        assert cell.ratio is not None
        assert cell.ratio_sd is not None
        if (cell.method, cell.snr_db) == ("harmonic-least-squares/global", 0.0):
            continue
        assert cell.ratio - 2 * cell.ratio_sd < 1.2, cell
        assert cell.ratio + 3 * cell.ratio_sd > 0.95, cell
        assert cell.outliers == cell.failures == 0


def test_trials_depend_on_the_seed_alone(paper: Truth, small: NoiseStudy) -> None:
    with ProcessPoolExecutor(1) as pool:
        spread = monte_carlo(
            paper, methods=("hilbert", "pseudo-wigner"), snr_db=(40.0,), trials=6, intervals=False, executor=pool
        )
    for method in small.methods:
        assert spread.cell(method, 40.0) == small.cell(method, 40.0)
    other = monte_carlo(paper, methods=("hilbert",), snr_db=(40.0,), trials=2, seed=2, intervals=False)
    assert other.cell("hilbert", 40.0).rms != small.cell("hilbert", 40.0).rms


def test_noise_has_the_size_that_the_ratio_says(paper: Truth) -> None:
    noise = np.concatenate([noisy(paper, 7.0, 3, trial) - paper.x for trial in range(40)])
    assert 10 * math.log10(np.var(paper.x) / np.var(noise)) == pytest.approx(7.0, abs=0.12)
    assert abs(np.corrcoef(noise[:-1], noise[1:])[0, 1]) < 4 / math.sqrt(noise.size)


def test_study_passes_through_json(small: NoiseStudy) -> None:
    assert read_study(json.loads(json.dumps(small.as_dict(), allow_nan=False))) == small
    assert [row["method"] for row in small.rows()] == ["pseudo-wigner"] * 2 + ["hilbert"] * 2
    assert [cell.snr_db for cell in small.of("hilbert")] == [10.0, 40.0]


def test_an_interrupted_study_keeps_what_was_done(paper: Truth) -> None:
    def interrupt(fraction: float, _: str) -> None:
        if fraction >= 0.5:
            raise KeyboardInterrupt

    study = monte_carlo(paper, methods=("hilbert",), snr_db=(20.0,), trials=10, intervals=False, progress=interrupt)
    assert not study.complete
    assert study.cells[0].trials == 5
    whole = monte_carlo(paper, methods=("hilbert",), snr_db=(20.0,), trials=5, intervals=False)
    assert study.cells == whole.cells
    with pytest.raises(KeyboardInterrupt):
        monte_carlo(paper, methods=("hilbert",), snr_db=(0.0, 20.0), trials=2, intervals=False, progress=interrupt)


def test_coverage_is_that_of_the_interval_with_its_bias(paper: Truth) -> None:
    cell = monte_carlo(paper, methods=("hilbert",), snr_db=(30.0,), trials=2).cells[0]
    assert cell.coverage is not None
    track = attempt(paper, noisy(paper, 30.0, 1, 0), "hilbert", {})
    assert isinstance(track, Track)
    one = judged(paper, track).covered
    assert one is not None
    keep = track.valid & paper.zone.interior(track.time)
    assert one == np.mean(track.interval.holds(paper.omega_at(track.time))[keep])  # type: ignore[union-attr]


def test_cell_is_made_of_its_trials() -> None:
    errors = [0.01, 0.02, 0.3, 0.02]
    trials = [Trial(e * e, -e, 0.9 + 0.1 * (e < 0.1), 5) for e in errors] + [Trial(reason="refused: too short")]
    cell = cell_of("x", 3.0, trials, {(5, 3): 0.1}, noise=0.1)
    mean_square = sum(e * e for e in errors) / 4
    assert cell.rms == pytest.approx(math.sqrt(mean_square))
    assert cell.bias == pytest.approx(-sum(errors) / 4)
    assert cell.ratio == pytest.approx(cell.rms / 0.01)
    assert cell.rms_sd == pytest.approx(np.std([e * e for e in errors], ddof=1) / 2 / 2 / cell.rms)
    assert (cell.outliers, cell.failures, cell.reason) == (1, 1, "refused: too short")
    assert cell.typical == pytest.approx(0.02)
    assert cell.coverage == pytest.approx(0.975)
    nothing = cell_of("x", 3.0, trials[-1:], {})
    assert nothing.rms is None
    assert nothing.failures == 1


def test_a_trial_without_an_estimate_has_its_reason(paper: Truth) -> None:
    """A study by model-fit needs an oscillator; a record may be too short; a track may be nowhere valid."""
    unnamed = attempt(replace(paper, oscillator=None), paper.x, "model-fit", {})
    assert judged(paper, unnamed).reason.startswith("model-fit needs an oscillator; name it and its free parameters")
    short = attempt(paper, paper.x[:9], "hilbert", {})
    assert isinstance(short, InputError)
    assert judged(paper, short).reason == str(short)
    track = attempt(paper, paper.x, "hilbert", {})
    assert isinstance(track, Track)
    nowhere = replace(track, valid=np.zeros(track.time.size, dtype=np.bool_))
    assert judged(paper, nowhere).reason == "hilbert: no valid sample in the interior"
    assert judged(paper, track).reason == ""


def test_truth_of_a_recording_is_its_smooth_model() -> None:
    t = np.arange(900) / 30.0
    omega = 2 * np.pi * (1.5 + 0.01 * t)
    clean = (1 + 0.02 * t) * np.cos(2 * np.pi * (1.5 * t + 0.005 * t**2)) + 0.4
    rough = clean + 0.02 * np.random.default_rng(5).standard_normal(t.size)
    truth = recording_truth(rough, 30.0, start=2.0)
    inside = truth.zone.interior(truth.signal.time)
    np.testing.assert_allclose(truth.omega[inside], omega[inside], rtol=3e-3)
    assert np.sqrt(np.mean((truth.x - clean) ** 2)) < 0.01
    slope = np.gradient(truth.signal.phase, 1 / 30.0)
    np.testing.assert_allclose(slope[inside], truth.omega[inside], rtol=1e-3)
    assert truth_of(rough, 30.0).x.size == 900


def test_truth_of_what_is_held_and_released_is_that_of_its_motion() -> None:
    t = np.arange(900) / 20.0
    motion = np.where((t >= 4.1) & (t < 40.0), np.exp(-0.004 * (t - 4.1)) * np.cos(5.969 * (t - 4.1)), 0.0)
    held = np.where(t < 4.1, 1.0, motion) + 0.003 * np.random.default_rng(6).standard_normal(t.size)
    truth = recording_truth(held, 20.0)
    assert truth.x.size < t.size
    first = round(float(truth.signal.time[0]) * 20.0)
    assert 80 <= first <= 90
    assert np.abs(truth.x - held[first : first + truth.x.size]).max() < 0.02


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"methods": ("guess",)}, "method 'guess' is unknown"),
        ({"methods": ("wigner/local",)}, "method 'wigner/local' is unknown"),
        ({"methods": ()}, "0 values of method"),
        ({"snr_db": (3.0, 3.0)}, "2 values of ratio"),
        ({"snr_db": (math.nan,)}, "ratio nan dB"),
        ({"trials": 1}, "1 trials are not between 2"),
        ({"trials": 50_000, "budget_seconds": 1.0, "intervals": False}, "over the budget of 1 s; use at most"),
        ({"source": np.ones(50)}, "without their sampling rate"),
    ],
)
def test_what_cannot_be_studied_is_refused(paper: Truth, change: dict[str, object], message: str) -> None:
    request: dict[str, object] = {"source": paper, "methods": ("pseudo-wigner",), "snr_db": (20.0,), "trials": 2}
    with pytest.raises(InputError, match=message):
        monte_carlo(**{**request, **change})  # type: ignore[arg-type]


def test_a_cell_that_was_not_tried_is_not_there(small: NoiseStudy) -> None:
    assert small.cell("hilbert", 40.0).method == "hilbert"
    with pytest.raises(KeyError, match="hilbert"):
        small.cell("hilbert", 7.0)


def test_a_record_without_a_whole_cycle_is_no_truth() -> None:
    with pytest.raises(InputError, match=r"use a longer duration|longer"):
        oscillator_truth(find("pendulum"), (1.0, 0.0), duration=3.0, rate=32.0)
