"""Bilinear oscillators against closed forms, a general quadrature, a general integrator, and themselves."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.numeric.motion.bilinear import (
    Bilinear,
    as_dynamics,
    bilinear_frequency,
    bilinear_waveform,
    potential,
    restoring,
)
from ridgeback.numeric.motion.bilinear_motion import bilinear_motion
from ridgeback.numeric.motion.cycle_frequency import cycle_frequency, is_symmetric
from ridgeback.numeric.motion.trajectory import integrate
from ridgeback.numeric.orbits.period import exact_frequency

OSCILLATORS = (
    Bilinear(1.0, 2.0, 0.5, 0.02),
    Bilinear(2.0, 0.7, 0.3, 0.01),
    Bilinear(1.0, 3.0, 0.0, 0.05),
    Bilinear(1.0, 2.5, 0.4, 0.03, symmetric=True),
    Bilinear(1.0, 1.5, 0.4, 0.03, preload=0.3),
)
IDS = ("stop", "soft", "two halves", "two stops", "preloaded stop")
CONTINUOUS = OSCILLATORS[:-1]
frequencies = st.floats(0.3, 3.0)


@pytest.mark.parametrize(("u", "v"), [(0.4, 0.5), (0.4, -0.5), (0.4, 0.0), (0.2, 0.3), (0.9, -0.3)])
def test_the_mirrored_motion_of_two_stops_is_the_mirror_image(u: float, v: float) -> None:
    """Also from the stops themselves, inwards and outwards."""
    stops = Bilinear(1.0, 2.5, 0.4, 0.03, symmetric=True)
    there, back = (bilinear_motion(stops, (side * u, side * v), duration=9.0, rate=4.0) for side in (1.0, -1.0))
    assert np.abs(there.u + back.u).max() < 1e-12
    assert np.abs(there.velocity + back.velocity).max() < 1e-12


@pytest.mark.parametrize("oscillator", CONTINUOUS, ids=IDS[:-1])
def test_frequency_is_that_of_the_quadrature(oscillator: Bilinear) -> None:
    """Its midpoint rule converges only like a power of the nodes across the corner: agreement to 2e-6."""
    peaks = np.linspace(0.6, 2.0, 5)
    table = exact_frequency(as_dynamics(oscillator), peaks, tolerance=1e-7)
    assert np.allclose(bilinear_frequency(oscillator, peaks), table.omega, rtol=2e-6)


@given(k1=frequencies, k2=frequencies, peak=st.floats(1e-3, 1e3))
@settings(deadline=None, max_examples=40)
def test_two_half_planes_have_the_harmonic_mean_at_every_amplitude(k1: float, k2: float, peak: float) -> None:
    expected = 2 * k1 * k2 / (k1 + k2)
    assert bilinear_frequency(Bilinear(k1, k2), peak) == pytest.approx(expected, rel=1e-14)
    # a switch far below the amplitude is as good as none
    assert bilinear_frequency(Bilinear(k1, k2, 1e-9 * peak), peak) == pytest.approx(expected, rel=1e-7)


@pytest.mark.parametrize("symmetric", [False, True])
@pytest.mark.parametrize("preload", [0.0, 0.25])
def test_frequency_leaves_k_as_the_expansion_at_the_stop_says(symmetric: bool, preload: float) -> None:
    """Exponent 1/2 with a preload (not differentiable), 3/2 without, and the coefficient by hand."""
    oscillator = Bilinear(1.0, 2.0, 0.5, symmetric=symmetric, preload=preload)
    assert np.all(bilinear_frequency(oscillator, [0.0, 0.2, 0.5]) == 1.0)
    x = np.array([1e-4, 1e-6])
    rise = bilinear_frequency(oscillator, 0.5 * (1 + x)) - 1.0
    exponent = 0.5 if preload else 1.5
    assert math.log10(rise[0] / rise[1]) / 2 == pytest.approx(exponent, abs=5e-3)
    q = preload / 0.5
    one = q / (math.pi * math.sqrt(1 + q)) if preload else (4 - 1) / (3 * math.pi)
    assert rise[1] / (2 * x[1]) ** exponent == pytest.approx((1 + symmetric) * one, rel=5e-3)


@pytest.mark.parametrize("oscillator", OSCILLATORS, ids=IDS)
def test_waveform_conserves_energy_and_is_even(oscillator: Bilinear) -> None:
    phase = np.linspace(0, math.pi, 2001)
    u = bilinear_waveform(oscillator, [1.3], phase)[0]
    omega = float(bilinear_frequency(oscillator, 1.3))
    velocity = np.gradient(u, phase, edge_order=2) * omega
    energy = 0.5 * velocity**2 + potential(oscillator, u)
    assert np.allclose(energy[2:-2], potential(oscillator, 1.3), rtol=1e-3)
    assert np.allclose(bilinear_waveform(oscillator, [1.3], -phase)[0], u, atol=1e-14)


@pytest.mark.parametrize("oscillator", OSCILLATORS, ids=IDS)
def test_potential_integrates_the_force(oscillator: Bilinear) -> None:
    u, step = np.linspace(-1.93, 2.0, 14), 1e-5
    slope = (potential(oscillator, u + step) - potential(oscillator, u - step)) / (2 * step)
    assert np.allclose(slope, restoring(oscillator, u), atol=1e-9)


@pytest.mark.parametrize("oscillator", OSCILLATORS, ids=IDS)
def test_motion_agrees_with_a_general_integrator(oscillator: Bilinear) -> None:
    """DOP853 does not see the corner (1e-7), and still less the jump of a preload (1e-5); its steps shrink there."""
    close = 1e-5 if oscillator.preload else 1e-7
    start = (1.2, -0.3)
    closed = bilinear_motion(oscillator, start, duration=40.0, rate=16.0)
    general = integrate(as_dynamics(oscillator), start, duration=40.0, rate=16.0, rtol=1e-11)
    assert np.abs(closed.u - general.u).max() < close
    assert np.abs(closed.velocity - general.velocity).max() < 3 * close
    for name in ("crossings", "turnings"):
        ours, theirs = getattr(closed, name), getattr(general, name)
        assert ours.time.size == theirs.time.size
        assert np.abs(ours.time - theirs.time).max() < 3 * close
    assert np.array_equal(closed.crossings.rising, general.crossings.rising)


def test_motion_between_equal_stiffnesses_is_the_damped_sine() -> None:
    k, mu = 2.0, 0.1
    run = bilinear_motion(Bilinear(k, k, 0.4, mu), (1.0, -mu), duration=60.0, rate=20.0)
    w = math.sqrt(k * k - mu * mu)
    assert np.abs(run.u - np.exp(-mu * run.time) * np.cos(w * run.time)).max() < 2e-13
    assert np.allclose(np.diff(run.crossings.time), math.pi / w, rtol=1e-12)


@pytest.mark.parametrize("oscillator", OSCILLATORS, ids=IDS)
def test_undamped_motion_has_the_exact_period_and_waveform(oscillator: Bilinear) -> None:
    free = Bilinear(oscillator.inner, oscillator.outer, oscillator.switch, 0.0, oscillator.symmetric)
    omega = float(bilinear_frequency(free, 1.1))
    run = bilinear_motion(free, (1.1, 0.0), duration=50 * 2 * math.pi / omega, rate=7.0)
    peaks = run.turnings.time[run.turnings.value > 0]
    assert peaks[-1] / (peaks.size - 1) == pytest.approx(2 * math.pi / omega, rel=1e-13)
    assert np.abs(run.u - bilinear_waveform(free, [1.1], omega * run.time)[0]).max() < 1e-11


@given(k1=frequencies, k2=frequencies, s=st.floats(0.0, 1.5), mu=st.floats(0.0, 0.1), v=st.floats(-2.0, 2.0))
@settings(deadline=None, max_examples=25)
def test_pieces_join_and_energy_never_grows(k1: float, k2: float, s: float, mu: float, v: float) -> None:
    oscillator = Bilinear(k1, k2, s, mu)
    run = bilinear_motion(oscillator, (0.7, v), duration=30.0, rate=50.0)
    inside = run.steps[1:-1]
    before, after = run.at(np.nextafter(inside, 0.0)), run.at(inside)
    assert np.allclose(before[0], after[0], atol=1e-11)
    assert np.allclose(before[1], after[1], atol=1e-11)
    energy = 0.5 * run.velocity**2 + potential(oscillator, run.u)
    assert np.all(np.diff(energy) <= 1e-12 * energy[0])


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ((0.0, 1.0), "k1 = 0"),
        ((1.0, math.inf), "k2 = inf"),
        ((1.0, 1.0, -0.1), "switch = -0.1"),
        ((1.0, 1.0, 0.0, 0.0, True), "above 0 when symmetric"),
        ((1.0, 2.0, 0.0, 1.0), "mu = 1"),
        ((1.0, 2.0, 0.5, 0.0, False, -1.0), "preload = -1"),
    ],
)
def test_unusable_numbers_are_refused(values: tuple[float, ...], said: str) -> None:
    with pytest.raises(InputError, match=said):
        Bilinear(*values)


def test_unusable_amplitude_is_refused() -> None:
    with pytest.raises(InputError, match="peak amplitude -1"):
        bilinear_frequency(Bilinear(1.0, 2.0), [0.5, -1.0])


def test_a_stop_that_is_met_far_out_makes_the_oscillator_asymmetric() -> None:
    one_sided = Bilinear(2 * np.pi, 4 * np.pi, 1.5, mu=0.03)
    run = bilinear_motion(one_sided, (4.0, 0.0), duration=20.0, rate=24.0)
    dynamics = as_dynamics(one_sided)
    assert is_symmetric(dynamics)
    assert not is_symmetric(dynamics, largest=4.0)
    found = cycle_frequency(run, dynamics=dynamics).at(run.time)
    low, high = bilinear_frequency(one_sided, [run.turnings.value[-2:].max(), 4.0])
    assert np.nanmin(found) == pytest.approx(low, rel=0.01)
    assert np.nanmax(found) == pytest.approx(high, rel=0.01)
