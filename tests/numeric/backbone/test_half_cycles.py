"""Half cycles against closed forms: frequency, turning points and decrement, with their scatter in noise."""

from __future__ import annotations

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.backbone.half_cycles import decrements, half_cycles

RATE = 40.0
T = np.arange(2400) / RATE
OMEGA, MU = 7.5, 0.04


def decay(offset: float = 0.0, phase: float = 0.3) -> np.ndarray:
    return 2.0 * np.exp(-MU * T) * np.cos(OMEGA * T + phase) + offset


@pytest.mark.parametrize("offset", [0.0, 0.7])
def test_a_linear_decay_is_recovered_whatever_its_offset(offset: float) -> None:
    found = half_cycles(decay(offset), RATE, start=3.0)
    assert np.abs(found.omega - OMEGA).max() < 2e-4
    assert np.abs(found.growth_rate[1:-1] + MU).max() < 1e-4
    assert np.isnan(found.growth_rate[[0, -1]]).all()
    # A turning point of a decay lies before the top of its envelope: A cos(atan(mu / omega)) there.
    expected = 2.0 * np.exp(-MU * (found.time - 3.0))
    assert np.abs(found.amplitude / expected - 1.0).max() < 3e-4
    assert found.definition == "peak"
    assert set(found.side.tolist()) == {-1.0, 1.0}
    assert np.all(np.diff(found.time) > 0)


def test_the_duffing_backbone_in_peak_amplitude() -> None:
    """A slowly decaying u = a cos(phi) with omega = 6 + 0.5 a^2: each half cycle lies on the curve."""
    a = 1.5 * np.exp(-0.03 * T)
    phase = 6.0 * T + 0.5 * 2.25 * (1 - np.exp(-0.06 * T)) / 0.06
    found = half_cycles(a * np.cos(phase), RATE)
    curve = found.backbone()
    assert curve.definition == "peak"
    expected = 6.0 + 0.5 * curve.curve_amplitude**2
    assert np.abs(curve.curve_omega / expected - 1.0).max() < 2e-3
    assert np.abs(curve.curve_growth_rate + 0.03).max() < 1e-3


def test_standard_deviations_are_those_of_repeated_noise() -> None:
    sigma, runs = 0.02, []
    for seed in range(30):
        noise = sigma * np.random.default_rng(seed).standard_normal(800)
        runs.append(half_cycles(decay()[:800] + noise, RATE))
    first = slice(2, 40)
    for value, deviation in (("omega", "omega_sd"), ("amplitude", "amplitude_sd"), ("growth_rate", "growth_rate_sd")):
        seen = np.std([getattr(r, value)[first] for r in runs], axis=0)
        said = np.mean([getattr(r, deviation)[first] for r in runs], axis=0)
        assert np.median(seen / said) == pytest.approx(1.0, abs=0.12), value


def test_the_bands_of_its_backbone_are_as_wide_as_the_errors() -> None:
    frequency, growth_rate = [], []
    for seed in range(12):
        x = decay() + 0.02 * np.random.default_rng(seed).standard_normal(T.size)
        curve = half_cycles(x, RATE).backbone()
        frequency.append((curve.curve_omega - OMEGA) / curve.curve_omega_sd)
        growth_rate.append((curve.curve_growth_rate + MU) / curve.curve_growth_rate_sd)
    for off in (np.concatenate(frequency), np.concatenate(growth_rate)):
        assert 0.6 < np.sqrt(np.mean(off**2)) < 1.25
        assert 0.9 < np.mean(np.abs(off) < 1.96) <= 1.0


def test_an_asymmetric_signal_alternates_in_frequency_and_not_in_damping() -> None:
    a = np.exp(-MU * T)
    x = a * np.cos(OMEGA * T) + 0.1 * a**2 * np.cos(2 * OMEGA * T)
    found = half_cycles(x, RATE)
    up, down = found.omega[found.side > 0][5:20], found.omega[found.side < 0][5:20]
    assert abs(np.mean(up) - np.mean(down)) > 0.1
    assert 2 / (1 / np.mean(up) + 1 / np.mean(down)) == pytest.approx(OMEGA, rel=1e-3)
    # |p| = a (1 + 0.1 s a) on side s, and the decrement compares the neighbours, on the other side.
    own, other = np.exp(-MU * found.time), -0.1 * found.side
    expected = -MU * (1 + other * own / (1 + other * own))
    assert np.abs(found.growth_rate - expected)[2:-2].max() < 5e-4


def test_the_decrement_of_an_exponential_is_exact() -> None:
    at = np.array([0.0, 0.4, 1.1, 1.5])
    growth_rate, _ = decrements(at, np.exp(-0.3 * at) * [1, -1, 1, -1], np.zeros(4))
    assert growth_rate[1:-1] == pytest.approx([-0.3, -0.3], rel=1e-12)


def test_too_few_crossings_or_all_in_noise_are_refused() -> None:
    with pytest.raises(InputError, match=r"cycles of its strongest component|zero crossings"):
        half_cycles(np.cos(0.5 * T[:200]), RATE)
    found = half_cycles(decay(), RATE)
    with pytest.raises(InputError, match="0 half cycles are clear of the noise and of clipped or stuck samples"):
        found.backbone(np.ones(found.time.size, dtype=bool))


def test_rows_carry_names_and_units() -> None:
    row = half_cycles(decay(), RATE).rows()[3]
    assert row["frequency_hz"] == pytest.approx(OMEGA / (2 * np.pi), rel=1e-4)
    assert set(row) >= {"time_s", "omega_rad_s", "amplitude", "growth_rate_per_s", "side"}


def test_nothing_is_claimed_of_crossings_of_a_sum() -> None:
    hum = 0.2 * np.cos(1.12 * OMEGA * T + 1.0)
    found = half_cycles(decay() + hum + 0.005 * np.random.default_rng(1).normal(size=T.size), RATE)
    assert "lies beside the oscillation" in str(found.no_interval)
    assert np.isnan(found.omega_sd).all()
    assert np.isnan(found.amplitude_sd).all()
    with pytest.raises(InputError, match="lies beside the oscillation"):
        found.backbone()


def test_a_rest_before_the_release_is_left_out() -> None:
    rest = int(4.3 * RATE)
    x = np.concatenate([np.full(rest, 1.0), np.exp(-MU * T) * np.cos(OMEGA * T)])
    x += 0.003 * np.random.default_rng(1).normal(size=x.size)
    found = half_cycles(x, RATE, start=-1.0)
    assert found.no_interval is None
    assert found.time[0] > 3.2
    off = (found.amplitude - np.exp(-MU * (found.time - 3.3))) / found.amplitude_sd
    assert np.mean(np.abs(off) < 1.96) > 0.85
    assert found.backbone().notes[0].startswith("Of t = 3.3")
