from __future__ import annotations

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.estimators.zero_crossing import crossing_samples, full_cycles, interpolate


def test_crossing_times_converge_with_the_sixth_power_of_the_step() -> None:
    errors = []
    for rate in (8.0, 16.0):
        t = np.arange(int(10 * rate)) / rate
        x = np.sin(2 * np.pi * t + 0.3)
        crossings = interpolate(x, crossing_samples(x, 0.1)).at / rate
        nearest = (np.round(2 * crossings + 0.3 / np.pi) - 0.3 / np.pi) / 2
        errors.append(np.abs(crossings - nearest).max())
    assert 5.0 < np.log2(errors[0] / errors[1]) < 7.5


def test_rising_and_falling_cycles_keep_apart_when_the_wave_is_not_centred() -> None:
    t = np.arange(640) / 64.0
    time, omega, _ = full_cycles(np.cos(2 * np.pi * 1.5 * t) + 0.4, 64.0, hysteresis=0.1, noise=0.0)
    assert np.abs(omega / (2 * np.pi) - 1.5).max() < 1e-5
    assert np.all(np.diff(time) > 0)


def test_deviation_is_noise_over_slope() -> None:
    rate, noise, f = 64.0, 0.01, 1.0
    t = np.arange(640) / rate
    rng = np.random.default_rng(2)
    found = [
        full_cycles(np.cos(2 * np.pi * f * t) + noise * rng.normal(size=t.size), rate, hysteresis=0.1, noise=noise)
        for _ in range(40)
    ]
    spread = np.std([omega[4] for _, omega, _ in found])
    claimed = np.median([deviation[4] for _, _, deviation in found])
    assert claimed == pytest.approx(2 * np.pi * f**2 * np.sqrt(2) * noise / (2 * np.pi * f), rel=0.05)
    assert 0.6 < spread / claimed < 1.4


def test_chatter_in_noise_counts_once() -> None:
    x = np.array([-1, -0.9, -0.1, 0.1, -0.1, 0.1, 0.9, 1, 0.9, 0.05, -0.05, 0.05, -0.9, -1.0])
    assert crossing_samples(x, 0.5).tolist() == [3, 10]


def test_less_than_a_cycle_is_refused() -> None:
    with pytest.raises(InputError, match="a full cycle needs 3"):
        full_cycles(np.linspace(-1.0, 1.0, 20), 1.0, hysteresis=0.01, noise=0.0)
