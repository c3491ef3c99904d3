"""Several backbones in one: weights, scatter between runs, and what a single run keeps."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.numeric.backbone.backbone import Backbone, backbone
from ridgeback.numeric.backbone.combined import combine, random_effects
from ridgeback.numeric.estimators.estimate import estimate

RATE = 32.0
T = np.arange(1600) / RATE


def curve(omega: float, sd: float, low: float, high: float, definition: str = "fundamental") -> Backbone:
    a = np.linspace(low, high, 12)
    flat = np.full(12, sd)
    along = dict.fromkeys(
        ("time", "amplitude", "amplitude_sd", "omega", "omega_sd", "growth_rate", "growth_rate_sd"), a
    )
    return Backbone(
        **along,
        curve_amplitude=a,
        curve_omega=omega - 0.1 * a**2,
        curve_omega_sd=flat,
        curve_amplitude_sd=flat,
        curve_growth_rate=-0.05 * np.ones(12),
        curve_growth_rate_sd=flat,
        offset=0.0,
        definition=definition,
    )


def test_equal_runs_average_as_the_root_of_their_number() -> None:
    found = combine([curve(8.0, 0.01, 0.1, 1.0) for _ in range(4)], list("abcd"))
    assert np.abs(found.omega - (8.0 - 0.1 * found.amplitude**2)).max() < 1e-9
    assert np.abs(found.omega_sd - 0.005).max() < 1e-12
    assert np.all(found.omega_between == 0.0)
    assert found.runs.tolist() == [4.0] * 12


def test_weights_are_those_of_precision() -> None:
    found = combine([curve(8.0, 0.01, 0.1, 1.0), curve(8.001, 0.02, 0.1, 1.0)], ["a", "b"])
    middle = 8.0 + 0.001 / (1 + 4) - 0.1 * found.amplitude**2
    assert np.abs(found.omega - middle).max() < 1e-9


def test_disagreement_beyond_the_errors_is_scatter_between_runs() -> None:
    """Many runs with a known scatter tau beside a known error s: both are found again."""
    rng = np.random.default_rng(2)
    tau, s = 0.05, 0.02
    values = 8.0 + tau * rng.standard_normal((400, 20)) + s * rng.standard_normal((400, 20))
    mean, deviation, between = random_effects(values, np.full(values.shape, s))
    assert np.mean(between) == pytest.approx(tau, rel=0.05)
    assert np.mean(deviation) == pytest.approx(np.hypot(tau, s) / 20.0, rel=0.05)
    assert np.std(mean) == pytest.approx(np.mean(deviation), rel=0.4)


def test_where_one_run_reaches_it_stands_alone_and_says_so() -> None:
    found = combine([curve(8.0, 0.01, 0.1, 0.5), curve(8.0, 0.01, 0.3, 1.0)], ["a", "b"])
    alone = found.runs == 1
    assert alone.any()
    assert (~alone).any()
    assert np.isnan(found.omega_between[alone]).all()
    assert np.isfinite(found.omega_between[~alone]).all()
    assert found.omega_sd[alone] == pytest.approx(0.01)


def test_a_gap_between_ranges_gives_no_row() -> None:
    found = combine([curve(8.0, 0.01, 0.1, 0.2), curve(8.0, 0.01, 0.9, 1.0)], ["a", "b"])
    assert not ((found.amplitude > 0.21) & (found.amplitude < 0.89)).any()


def test_definitions_are_not_mixed() -> None:
    with pytest.raises(InputError, match="backbones of fundamental and peak cannot be combined"):
        combine([curve(8.0, 0.01, 0.1, 1.0), curve(8.0, 0.01, 0.1, 1.0, "peak")], ["a", "b"])


@given(st.lists(st.tuples(st.floats(-5, 5), st.floats(1e-3, 2)), min_size=1, max_size=6))
@settings(deadline=None, max_examples=100)
def test_the_mean_lies_among_the_values_and_no_error_shrinks_below_the_best_mean(
    runs: list[tuple[float, float]],
) -> None:
    values, deviations = (np.array(column)[:, None] for column in zip(*runs, strict=True))
    mean, deviation, _ = random_effects(values, deviations)
    assert values.min() - 1e-9 <= mean[0] <= values.max() + 1e-9
    assert deviation[0] >= 1.0 / np.sqrt(np.sum(1.0 / deviations**2)) * (1 - 1e-12)


def test_runs_of_one_oscillator_give_one_backbone() -> None:
    curves = []
    for seed, start in enumerate((2.0, 1.5, 2.5)):
        a = start * np.exp(-0.04 * T)
        phase = 8.0 * T - 0.3 * start**2 * (1.0 - np.exp(-0.08 * T)) / 0.08
        x = a * np.cos(phase) + 0.02 * np.random.default_rng(seed).standard_normal(T.size)
        curves.append(backbone(estimate(x, RATE, method="harmonic-least-squares"), x, RATE))
    found = combine(curves, ["1", "2", "3"])
    inside = found.runs > 1
    assert np.abs(found.omega - (8.0 - 0.3 * found.amplitude**2))[inside].max() < 0.03
    assert np.abs(found.growth_rate + 0.04)[inside].max() < 0.01
    assert set(found.rows()[0]) >= {"amplitude", "omega_between_runs_rad_s", "growth_rate_between_runs_per_s", "runs"}


def test_clipped_windows_are_left_out_of_a_backbone_and_counted() -> None:
    a = 2.0 * np.exp(-0.04 * T)
    x = np.clip(a * np.cos(8.0 * T), -1.2, 1.2)
    flat = np.abs(x) >= 1.2
    track = estimate(x, RATE, method="harmonic-least-squares")
    plain, clean = backbone(track, x, RATE), backbone(track, x, RATE, exclude=flat)
    last = T[np.flatnonzero(flat)[-1]]
    assert clean.time.min() > last
    assert np.abs(clean.amplitude / (2.0 * np.exp(-0.04 * clean.time)) - 1).max() < 5e-3
    assert np.abs(plain.amplitude / (2.0 * np.exp(-0.04 * plain.time)) - 1).max() > 5e-2
    assert any("clipped or stuck samples in their window" in note for note in clean.notes)


@pytest.mark.parametrize("unit", [1e-6, 1.0, 1e6])
def test_no_run_speaks_of_amplitudes_that_it_did_not_have(unit: float) -> None:
    spans = [(unit * low, unit * high) for low, high in ((0.1, 0.57), (0.33, 1.2))]
    found = combine([curve(8.0, 0.01, *span) for span in spans], ["a", "b"])
    inside = [(found.amplitude > low) & (found.amplitude < high) for low, high in spans]
    assert found.runs[1:-1].tolist() == np.sum(inside, axis=0)[1:-1].tolist()
    assert set(found.runs.tolist()) == {1.0, 2.0}


@pytest.mark.parametrize("unit", [1e-6, 1e6])
def test_another_unit_is_another_unit_throughout(unit: float) -> None:
    """Also where a run is absent and where deviations are nothing."""
    values = np.array([[1.0, 2.0, 0.5], [1.5, np.nan, 0.5], [1.1, 2.5, np.nan]])
    for deviations in (np.full((3, 3), 0.1), np.zeros((3, 3))):
        for whole, part in zip(
            random_effects(values, deviations), random_effects(unit * values, unit * deviations), strict=True
        ):
            assert np.allclose(part, unit * whole, rtol=1e-9, atol=0.0)
