"""Whether there is an oscillation: noise is not taken for one, a tone at 0 dB and a sweep in noise are found."""

from __future__ import annotations

import numpy as np
import pytest

from ridgeback.numeric.backbone.half_cycles import half_cycles
from ridgeback.numeric.estimators.amplitude import estimate_amplitude
from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.signal.presence import FALSE_ALARM, parts_of, presence


def coloured(size: int, slope: float, rng: np.random.Generator) -> np.ndarray:
    frequency = np.fft.rfftfreq(4 * size)
    frequency[0] = frequency[1]
    shape = frequency ** (-0.5 * slope)
    spectrum = shape * (rng.standard_normal(frequency.size) + 1j * rng.standard_normal(frequency.size))
    return np.fft.irfft(spectrum)[size : 2 * size]


@pytest.mark.parametrize("slope", [0.0, 1.0, 2.0])
@pytest.mark.parametrize(("size", "records"), [(200, 400), (700, 150), (5000, 20)])
def test_noise_is_taken_for_noise(size: int, records: int, slope: float) -> None:
    """At 1 in 1000 at most: two or more of 400 would be seen once in 15 seeds; the large trial is a benchmark."""
    rng = np.random.default_rng(7)
    found = [presence(coloured(size, slope, rng), 1.0) for _ in range(records)]
    assert sum(one.found for one in found) <= 1
    assert np.mean([one.probability <= 0.1 for one in found]) <= 0.1


@pytest.mark.parametrize(("size", "cycles"), [(200, 10.0), (200, 60.3), (500, 10.5), (5000, 12.0)])
@pytest.mark.parametrize("decay", [0.0, 1.0])
def test_a_tone_at_0_db_is_found_in_95_of_100(size: int, cycles: float, decay: float) -> None:
    rng, t = np.random.default_rng(11), np.arange(size) / size
    found = 0
    for _ in range(100):
        x = np.exp(-decay * t) * np.cos(2 * np.pi * cycles * t + rng.uniform(0.0, 2 * np.pi))
        x += np.sqrt(np.mean(x**2)) * rng.standard_normal(size)
        seen = presence(x, float(size))
        found += seen.found and abs(seen.omega / (2 * np.pi * cycles) - 1.0) < 0.2
    assert found >= 95


@pytest.mark.parametrize("noise", [0.0, 0.5])
def test_a_frequency_that_sweeps_over_an_octave_is_found(noise: float) -> None:
    rng, t = np.random.default_rng(3), np.arange(640) / 32.0
    for _ in range(10):
        x = np.cos(2 * np.pi * (0.9 * t + 0.03 * t**2)) + noise * rng.standard_normal(t.size)
        assert presence(x, 32.0).found


def test_the_probability_is_uniform_on_no_account_too_small() -> None:
    """The formula bounds the rate at every level, not only at the one that is asked for; short records included."""
    rng = np.random.default_rng(5)
    for size in (16, 40, 127):
        p = np.array([presence(rng.standard_normal(size), 1.0).probability for _ in range(600)])
        for level in (0.3, 0.1, 0.03):
            assert np.mean(p <= level) <= level + 3.0 * np.sqrt(level / p.size)


@pytest.mark.parametrize("size", [128, 129, 513])
def test_every_ordinate_lies_below_the_nyquist_frequency(size: int) -> None:
    """At it an ordinate has one degree of freedom, and not two."""
    views = list(parts_of(np.random.default_rng(1).standard_normal(size)))
    for frequency, ratio, _ in views:
        assert frequency.max() < 0.5 - 1e-9
        assert ratio.shape[1] == frequency.size
    assert len(views) == (2 if size < 256 else 4)


def test_a_peak_outside_the_limits_does_not_count() -> None:
    rng, t = np.random.default_rng(2), np.arange(1000) / 50.0
    x = np.cos(30.0 * t) + 0.5 * rng.standard_normal(t.size)
    assert presence(x, 50.0, limits=(25.0, 35.0), whole=False).found
    assert not presence(x, 50.0, limits=(60.0, 90.0), whole=False).found


@pytest.mark.parametrize("method", ["auto", "pseudo-wigner", "hilbert", "zero-crossing"])
def test_nothing_of_white_noise_is_vouched_for(method: str) -> None:
    for seed in range(3):
        x = np.random.default_rng(seed).standard_normal(600)
        track = estimate(x, 20.0, method=method)
        assert not track.valid.any()
        assert track.interval is None
        assert track.presence.probability > FALSE_ALARM
        assert track.settings["noise_probability"] == track.presence.probability
        assert "noise alone" in track.no_interval


def test_neither_are_half_cycles_and_amplitudes() -> None:
    x = np.random.default_rng(1).standard_normal(600)
    halves = half_cycles(x, 20.0)
    assert np.isnan(halves.omega_sd).all()
    with pytest.raises(ValueError, match="no oscillation stands out of the noise"):
        halves.backbone()
    given = estimate_amplitude(np.cos(9.0 * np.arange(600) / 20.0) + 0.1 * x, 20.0)
    assert given.valid.all()
    judged = given.held_against(presence(x, 20.0))
    assert not judged.valid.any()
    assert judged.interval is None


def test_where_one_frequency_counts_its_own_tail_is_the_probability() -> None:
    """(1 - R^2)^m, R^2 the share of the squares that a line takes at the highest frequency looked at, m = (N - 3)/2."""
    for seed in range(5):
        x = np.random.default_rng(seed).standard_normal(24)
        x -= x.mean()
        highest = 23 / 24  # of the Nyquist frequency: the bins are N apart from 0 to it, both ends left out
        turning = np.exp(1j * np.pi * highest * np.arange(24))
        share = 2.0 * np.abs(turning @ x) ** 2 / (24 * (x @ x))
        found = presence(x, 2.0, limits=(2 * np.pi * (highest + 1 / 24), 9.0), whole=False)
        assert found.probability == pytest.approx((1.0 - share) ** 10.5, rel=1e-9)
        assert found.omega == pytest.approx(2 * np.pi * highest)
