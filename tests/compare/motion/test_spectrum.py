"""Order analysis and ripple on signals whose harmonics are known although their frequency moves."""

import numpy as np
import pytest

from ridgeback.compare.motion.order_analysis import orders, ripple
from ridgeback.compare.motion.wigner_bias import predicted_bias
from ridgeback.numeric.estimators.estimate import estimate


def chirp(t):
    return 2 * np.pi * (1.0 * t + 0.02 * t**2)


def crossings(cycles):
    """Times at which the phase is -pi/2 + 2 pi n: the cosine rises through zero."""
    phase = (np.arange(1, cycles) - 0.25) * 2 * np.pi
    return (-1 + np.sqrt(1 + 4 * 0.02 * phase / (2 * np.pi))) / 0.04


def test_harmonics_of_a_chirp_are_separated_at_constant_phase():
    def signal(t):
        return np.cos(chirp(t)) + 0.1 * np.cos(3 * chirp(t)) + 0.01 * np.sin(5 * chirp(t)) + 0.3

    found = orders(signal, crossings(30))
    assert found.level_db(3) == pytest.approx(-20, abs=0.05)
    assert found.level_db(5) == pytest.approx(-40, abs=0.05)
    assert found.level_db(2) < -80
    assert found.share[0] / found.share[1] == pytest.approx(2 * 0.3**2, rel=0.05)


def test_ripple_is_counted_per_cycle_although_the_cycle_shortens():
    found = ripple(lambda t: 1 + 0.1 * t + 0.003 * np.cos(2 * chirp(t)), crossings(30))
    assert found.per_cycle == pytest.approx(2.0, abs=0.02)
    assert found.amplitude == pytest.approx(0.003, rel=0.05)


def test_the_curvature_formula_is_met_by_the_wigner_peak_of_a_weakly_curved_chirp():
    t = np.arange(1281) / 64.0
    bend = 0.002
    omega = 2 * np.pi * 1.5 + 0.05 * t + 0.5 * bend * (t - 10) ** 2
    phase = 2 * np.pi * 1.5 * t + 0.025 * t**2 + bend * (t - 10) ** 3 / 6
    track = estimate(np.cos(phase), 64.0, method="wigner", bias=False)
    inside = (t > 6) & (t < 14)
    measured = (track.omega - omega)[inside]
    expected = predicted_bias(t, omega)[inside]
    assert np.mean(measured) == pytest.approx(np.mean(expected), rel=0.1)
