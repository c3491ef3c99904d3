from __future__ import annotations

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.backbone.backbone import along_models, backbone
from ridgeback.numeric.backbone.curve import Crowding, Points, assemble, pooled
from ridgeback.numeric.estimators.estimate import METHODS, estimate
from ridgeback.numeric.harmonics.signal_model import SignalModels
from ridgeback.numeric.harmonics.spline_fit import fit_on
from ridgeback.numeric.tracking.choices import Choices, Scope
from ridgeback.numeric.tracking.track import Track

RATE = 32.0
T = np.arange(1921) / RATE
A = 2.0 * np.exp(-0.04 * T)
OMEGA = 8.0 - 0.3 * A**2  # a softening backbone, omega0 = 8 - 0.3 a^2
PHASE = 8.0 * T - 0.3 * 4.0 * (1.0 - np.exp(-0.08 * T)) / 0.08
CLEAN = A * np.cos(PHASE) + 0.02 * A**3 * np.cos(3 * PHASE) + 0.5


def test_softening_backbone_and_constant_damping_are_recovered() -> None:
    found = backbone(estimate(CLEAN, RATE, start=3.0), CLEAN, RATE)
    assert found.definition == "fundamental"
    assert found.offset == pytest.approx(0.5, abs=0.02)
    assert np.abs(found.amplitude - 2.0 * np.exp(-0.04 * (found.time - 3.0))).max() < 2e-3
    assert np.abs(found.omega - (8.0 - 0.3 * found.amplitude**2)).max() < 5e-3
    assert np.abs(found.growth_rate + 0.04).max() < 2e-3
    assert np.all(np.diff(found.curve_amplitude) > 0)
    assert np.abs(found.curve_omega - (8.0 - 0.3 * found.curve_amplitude**2)).max() < 1e-2
    assert "mean" in found.notes[0]


def test_points_of_a_bin_count_by_their_precision() -> None:
    """Of omega; and a deviation of nothing counts as a billionth of it, so that all do."""
    rng = np.random.default_rng(3)
    a, omega, sd = np.linspace(1.0, 2.0, 16), 8.0 + rng.normal(size=16), rng.uniform(0.1, 2.0, 16)
    flat = np.full(16, 0.1)
    found = assemble(
        Points(a, a, flat, omega, sd, -flat, flat), crowding=Crowding(1.0, 1.0), offset=0.0, settings={}, notes=()
    )
    means = [np.average(omega[i : i + 4], weights=sd[i : i + 4] ** -2) for i in range(0, 16, 4)]
    assert found.curve_omega == pytest.approx(means)


def test_of_a_model_points_count_where_a_quarter_of_the_cycle_round_them_is_clean() -> None:
    """A cycle has 32 samples here, a point lies at every eighth."""
    t = np.arange(640) / RATE
    turned = 2 * np.pi * t
    x = np.cos(turned) + 0.01 * np.random.default_rng(1).normal(size=t.size)
    coarse, fine = (fit_on(x, t, turned, np.ones(t.size), np.linspace(0.0, t[-1], n), ()) for n in (4, 6))
    track = Track(t, fine.omega, np.ones(t.size, dtype=np.bool_), "model", used=Choices(scope=Scope.GLOBAL))
    models = SignalModels(fine, fine, coarse)

    def times(lost: int) -> list[float]:
        exclude = np.zeros(t.size, dtype=np.bool_)
        exclude[320 - lost // 2 : 320 + lost // 2] = True
        return along_models(models, track, 0.0, exclude).points.time.tolist()

    assert times(0) == times(20) == (np.arange(4, 640, 8) / RATE).tolist()
    around = {int(i) for i in range(4, 640, 8) if np.count_nonzero(abs(np.arange(304, 336) - i + 0.5) < 16) > 24}
    assert sorted(set(times(0)) - set(times(32))) == [i / RATE for i in sorted(around)]
    assert around


@pytest.mark.parametrize("method", [m for m in METHODS if m != "auto"])
def test_every_track_serves(method: str) -> None:
    found = backbone(estimate(CLEAN, RATE, method=method), CLEAN, RATE)
    expected = 8.0 - 0.3 * found.curve_amplitude**2
    coarse = method == "wigner"  # its curvature bias is left in
    assert np.median(np.abs(found.curve_omega / expected - 1.0)) < (1e-2 if coarse else 3e-3)


def test_bands_cover_the_truth_in_noise() -> None:
    inside_omega, inside_growth = [], []
    for seed in range(4):
        x = CLEAN + 0.05 * np.random.default_rng(seed).normal(size=T.size)
        found = backbone(estimate(x, RATE, bias=False), x, RATE)
        expected = 8.0 - 0.3 * found.curve_amplitude**2
        inside_omega.append(np.abs(found.curve_omega - expected) < 2 * found.curve_omega_sd)
        inside_growth.append(np.abs(found.curve_growth_rate + 0.04) < 2 * found.curve_growth_rate_sd)
    assert np.mean(np.concatenate(inside_omega)) > 0.85
    assert np.mean(np.concatenate(inside_growth)) > 0.85
    assert np.median(found.curve_omega_sd) < 0.1


def test_points_in_the_noise_are_left_out_and_counted() -> None:
    x = 2.0 * np.exp(-0.15 * T) * np.cos(8.0 * T) + 0.05 * np.random.default_rng(1).normal(size=T.size)
    found = backbone(estimate(x, RATE, band=(6.0, 10.0)), x, RATE)
    assert found.amplitude.min() > 5 * 0.005
    assert any("not 5 times above noise" in note for note in found.notes)


def test_rows_carry_the_names_of_their_columns() -> None:
    row = backbone(estimate(CLEAN, RATE), CLEAN, RATE).rows()[0]
    assert list(row) == [
        "amplitude",
        "amplitude_standard_deviation",
        "omega_rad_s",
        "frequency_hz",
        "omega_standard_deviation_rad_s",
        "growth_rate_per_s",
        "growth_rate_standard_deviation_per_s",
        "growth_rate_low_95_per_s",
        "growth_rate_high_95_per_s",
        "damping_ratio",
        "damping_ratio_standard_deviation",
    ]
    assert row["frequency_hz"] == pytest.approx(row["omega_rad_s"] / (2 * np.pi))


def test_the_bands_are_not_much_wider_than_the_errors_either() -> None:
    off_omega, off_growth = [], []
    for seed in range(4):
        x = CLEAN + 0.05 * np.random.default_rng(seed).normal(size=T.size)
        found = backbone(estimate(x, RATE, method="pseudo-wigner", bias=False), x, RATE)
        off_omega.append((found.curve_omega - (8.0 - 0.3 * found.curve_amplitude**2)) / found.curve_omega_sd)
        off_growth.append((found.curve_growth_rate + 0.04) / found.curve_growth_rate_sd)
    for off in (np.concatenate(off_omega), np.concatenate(off_growth)):
        assert 0.4 < np.sqrt(np.mean(off**2)) < 1.4


def test_pooling_counts_independent_values_only() -> None:
    rng = np.random.default_rng(0)
    a, values, deviations = np.linspace(1.0, 2.0, 400), 3.0 + 0.2 * rng.normal(size=400), np.full(400, 0.1)
    mean, deviation = pooled(a, values, deviations, np.ones(400), 4.0)
    assert mean == pytest.approx(values.mean())
    assert deviation == pytest.approx(0.2 / np.sqrt(100.0), rel=0.1)  # the scatter, twice what is stated
    assert pooled(a, values, 3 * deviations, np.ones(400), 4.0)[1] == pytest.approx(0.03)  # what is stated
    sloping = values + 5.0 * a
    assert pooled(a, sloping, deviations, np.ones(400), 4.0)[1] == pytest.approx(deviation)  # a slope is no scatter
    assert pooled(a[:2], values[:2], deviations[:2], np.ones(2), 4.0)[1] >= 0.1  # both share one window


def test_a_record_without_clear_points_is_refused() -> None:
    rng = np.random.default_rng(3)
    x = 0.02 * np.cos(8.0 * T[:200]) + rng.normal(size=200)
    with pytest.raises(InputError, match=r"clear of the noise|valid values|have a peak in the band"):
        backbone(estimate(x, RATE, band=(7.0, 9.0)), x, RATE)
