from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.estimators.higher_harmonics import harmonic_track, raw_harmonic_peak
from ridgeback.numeric.signal.local_line import local_line
from ridgeback.numeric.signal.windows import window
from ridgeback.numeric.tracking.track import Track

Source = Callable[..., Any]


@lru_cache
def fundamental(samples: bytes) -> Track:
    return estimate(np.frombuffer(samples), 32.0, bias=False)


@pytest.mark.parametrize("multiple", [1, 3, 5])
@pytest.mark.parametrize("quantity", ["u", "velocity"])
def test_harmonics_of_the_pendulum_are_multiples(pendulum_decay: Source, multiple: int, quantity: str) -> None:
    decay = pendulum_decay()
    x = getattr(decay, quantity)
    track = harmonic_track(x, 32.0, fundamental(x.tobytes()), multiple=multiple).inside()
    assert decay.error(track.time, track.omega, multiple=multiple) < 1e-4


def test_raw_wigner_peak_near_the_third_harmonic_is_wrong(pendulum_decay: Source) -> None:
    decay = pendulum_decay()
    base = fundamental(decay.velocity.tobytes())
    raw = raw_harmonic_peak(decay.velocity, 32.0, base)
    locked = harmonic_track(decay.velocity, 32.0, base)
    wrong, right = (decay.error(track.time, track.omega, multiple=3) for track in (raw, locked))
    assert wrong > 0.03
    assert wrong > 100 * right
    assert "cross terms" in raw.used.why


def test_cross_term_of_one_and_five_stands_where_no_third_harmonic_is() -> None:
    t = np.arange(641) / 32.0
    x = np.cos(2 * np.pi * t) + 0.5 * np.cos(2 * np.pi * 5 * t)
    raw = raw_harmonic_peak(x, 32.0, estimate(x, 32.0))
    middle = slice(200, 440)
    assert np.abs(raw.omega[middle] / (6 * np.pi) - 1.0).min() < 1e-3  # a peak at 3 Hz, of nothing
    locked = harmonic_track(x, 32.0, estimate(x, 32.0), multiple=3)
    assert float(str(locked.settings["amplitude_median"])) < 1e-3


def test_local_line_is_the_weighted_fit_written_out() -> None:
    rng = np.random.default_rng(6)
    c = rng.normal(size=40) + 1j * rng.normal(size=40)
    w = window("blackman", 5)
    value, slope = local_line(c, w, 4.0)
    j = np.arange(-5, 6)
    design = np.stack([np.ones(11), j / 4.0], axis=1)
    root = np.sqrt(w)[:, None]
    expected = np.linalg.lstsq(root * design, root[:, 0] * c[15:26], rcond=None)[0]
    assert np.abs(np.array([value[20], slope[20]]) - expected).max() < 1e-12


def test_deviation_is_that_of_repeated_trials() -> None:
    t = np.arange(641) / 32.0
    phase = 2 * np.pi * (1.0 * t + 0.01 * t * t)
    clean = np.cos(phase) + 0.3 * np.cos(3 * phase)
    base = estimate(clean, 32.0)
    found = []
    for seed in range(12):
        x = clean + 0.03 * np.random.default_rng(seed).normal(size=t.size)
        track = harmonic_track(x, 32.0, base)
        assert track.standard_deviation is not None
        found.append([track.omega[250:400] - 6 * np.pi * (1.0 + 0.02 * t[250:400]), track.standard_deviation[250:400]])
    error, claimed = np.sqrt(np.mean(np.square(found), axis=(0, 2)))
    assert error / claimed == pytest.approx(1.0, abs=0.35)


def test_a_harmonic_below_the_noise_is_not_valid() -> None:
    t = np.arange(641) / 32.0
    third = np.where(t < 10.0, 0.3, 0.001) * np.cos(6 * np.pi * t)
    x = np.cos(2 * np.pi * t) + third + 0.05 * np.random.default_rng(3).normal(size=t.size)
    track = harmonic_track(x, 32.0, estimate(x, 32.0, bias=False), multiple=3)
    assert track.valid[(t > 4.5) & (t < 7.0)].all()
    assert not track.valid[(t > 12.5) & (t < 15.5)].any()


def test_harmonics_that_do_not_exist_are_refused() -> None:
    t = np.arange(641) / 32.0
    x = np.cos(2 * np.pi * t)
    base = estimate(x, 32.0)
    with pytest.raises(InputError, match=r"harmonic 16 reaches 16 .* Nyquist frequency 16; use harmonic 15 or less"):
        harmonic_track(x, 32.0, base, multiple=16)
    with pytest.raises(InputError, match="harmonic 0 is below 1"):
        harmonic_track(x, 32.0, base, multiple=0)
    with pytest.raises(InputError, match="filter_seconds 90 needs"):
        harmonic_track(x, 32.0, base, filter_seconds=90.0)
