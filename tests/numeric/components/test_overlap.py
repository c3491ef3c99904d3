"""Two modes nearer to each other than about their damping are told from one oscillation, or nothing is claimed."""

from __future__ import annotations

import numpy as np
import pytest

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.components.overlap import apart, two_modes
from ridgeback.numeric.components.separation import separated
from ridgeback.numeric.estimators.estimate import estimate

RATE, OMEGA, RATIO = 400.0, 40 * np.pi, 0.02
T = np.arange(500) / RATE
GUIDE, ALL = np.full(T.size, OMEGA), np.ones(T.size)


def mode(size: float, detuned: float, phase: float) -> Array:
    """A mode whose frequency is so many growth rates above."""
    w, g = OMEGA * (1.0 + RATIO * detuned), RATIO * OMEGA
    return np.asarray(size * np.exp(-g * T) * np.cos(w * T + phase))


def noisy(x: Array) -> Array:
    """Samples in noise of 0.5 %."""
    return x + 0.005 * np.random.default_rng(1).normal(size=T.size)


def test_of_two_modes_that_overlap_nothing_is_claimed() -> None:
    x = noisy(mode(1.0, 0.0, 0.3) + mode(0.5, 0.7, 2.0))
    found = separated(x, RATE, GUIDE, half=40, multiples=None)
    assert found.reason.startswith("two modes overlap within their damping, near 20")


def test_two_modes_further_apart_are_modelled_side_by_side() -> None:
    x = noisy(mode(1.0, 0.0, 0.3) + mode(0.5, 1.6, 2.0))
    found = separated(x, RATE, GUIDE, half=40, multiples=None)
    fine, early = found.models.fine, slice(0, 300)
    off, deviation = np.abs(fine.omega - OMEGA)[early], fine.omega_deviation[early]
    assert found.reason == ""
    assert len(found.tones) == 1
    assert found.tones[0].omega == pytest.approx(OMEGA * (1.0 + 1.6 * RATIO), rel=2e-3)
    assert (off < 1.96 * deviation).mean() > 0.9


@pytest.mark.parametrize("detuned", [0.6, 1.5])
def test_the_two_exponentials_of_a_sum_are_found(detuned: float) -> None:
    found = two_modes(mode(1.0, 0.0, 0.3) + mode(0.5, detuned, 2.0), RATE, OMEGA * 1.005, ALL)
    assert found is not None
    low, high = sorted(found, key=lambda tone: tone.omega)
    assert low.omega == pytest.approx(OMEGA, rel=1e-7)
    assert high.omega == pytest.approx(OMEGA * (1.0 + RATIO * detuned), rel=1e-7)
    assert apart(found)


def test_of_many_samples_two_exponentials_are_found_by_their_envelope() -> None:
    t = np.arange(60_000) / RATE
    g = 4.0 / t[-1]
    x = np.exp(-g * t) * np.cos(OMEGA * t) + 0.5 * np.exp(-0.8 * g * t) * np.cos((OMEGA + 1.2 * g) * t + 1.0)
    found = two_modes(x, RATE, OMEGA + 0.5 * g, np.ones(t.size))
    assert found is not None
    low, high = sorted(found, key=lambda tone: tone.omega)
    assert [low.growth / -g, high.growth / -g] == pytest.approx([1.0, 0.8], abs=1e-3)
    assert [low.amplitude, high.amplitude] == pytest.approx([1.0, 0.5], abs=1e-3)
    assert (high.omega - low.omega) / g == pytest.approx(1.2, abs=1e-3)


@pytest.mark.parametrize(("drag", "bend"), [(1.5, 0.0), (0.0, 0.02)])
def test_one_oscillation_that_is_not_linear_is_not_two(drag: float, bend: float) -> None:
    g = RATIO * OMEGA
    a = 1.0 / ((1.0 + drag) * np.exp(g * T) - drag)
    phase = OMEGA * (T + bend * np.cumsum(a**2) / RATE)
    found = separated(noisy(a * np.cos(phase)), RATE, GUIDE, half=40, multiples=None)
    assert found.reason == ""
    assert found.tones == ()


def rubbed(friction: float, t: Array) -> Array:
    """u'' + F sign(u') + u = 0 from 1 at rest, each half swing about F or -F, until it sticks."""
    swing = np.minimum(np.floor(t / np.pi), np.ceil((1.0 / friction - 1.0) / 2.0))
    size = 1.0 - 2.0 * friction * swing
    turned = np.where(size > friction, t - np.pi * swing, 0.0)
    return np.asarray((-1.0) ** swing * ((size - friction) * np.cos(turned) + friction), dtype=np.float64)


@pytest.mark.parametrize("seed", [1, 2])
def test_one_oscillation_that_dry_friction_brings_to_rest_is_not_two(seed: int) -> None:
    t = np.arange(400) * (40.0 * np.pi / 400)
    x = rubbed(0.016, t + seed) * np.exp(-0.004 * t) + 0.003 * np.random.default_rng(seed).normal(size=t.size)
    found = estimate(x, 400 / (40.0 * np.pi))
    assert found.interval is not None
    assert found.used.tones == ()
