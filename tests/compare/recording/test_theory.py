"""A named oscillator's backbone over a measured one: the right one agrees, a wrong one differs, none is said to be."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from ridgeback.compare.recording.theory import Agreement, exact_at, over_curve, over_measured
from ridgeback.numeric.backbone.backbone import backbone
from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.symbolic.systems.catalogue import find

RATE = 32.0


@pytest.fixture(scope="module")
def measured():
    """A cosine of 2 rad/s with a little seeded noise, decaying slowly: linear with k = 2."""
    time = np.arange(2400) / RATE
    noise = np.random.default_rng(5).normal(scale=2e-3, size=time.size)
    x = np.exp(-0.01 * time) * np.cos(2.0 * time) + noise
    return backbone(estimate(x, RATE, method="harmonic-least-squares"), x, RATE)


def test_the_right_oscillator_agrees_and_a_wrong_one_differs(measured):
    right = over_measured(find("linear").with_parameters({"k": "2"}), measured)
    wrong = over_measured(find("linear").with_parameters({"k": "2.1"}), measured)
    assert right.agreement is Agreement.AGREES
    assert "within 2 of its standard deviations" in right.sentence()
    assert wrong.agreement is Agreement.DIFFERS
    assert wrong.mean == pytest.approx(2 / 2.1 - 1, abs=1e-4)
    assert "they differ" in wrong.sentence()


def test_where_no_deviation_is_known_nothing_is_judged(measured):
    found = over_measured(find("linear").with_parameters({"k": "2.1"}), measured, known=False)
    assert found.agreement is Agreement.UNTOLD
    assert found.mean == pytest.approx(2 / 2.1 - 1, abs=1e-4)
    assert "deviations" not in found.sentence()
    assert "differ" not in found.sentence()


def test_a_theory_that_has_no_such_orbits_says_so(measured):
    """The softening Duffing oscillator with a weak spring has its separatrix far below the measured amplitudes."""
    small = find("duffing-softening").with_parameters({"k": "2", "eps": "-400"})
    found = over_measured(small, measured)
    assert found.agreement is Agreement.UNCOVERED
    assert "at none of the measured amplitudes" in found.sentence()


def test_the_pendulum_at_its_fundamental_amplitude():
    """omega0 = 1 - a^2/16 + a^4/1024 with the amplitude of the first harmonic."""
    omega, inside = exact_at(find("pendulum"), np.array([0.2, 0.5]))
    expected = 1 - np.array([0.2, 0.5]) ** 2 / 16 + np.array([0.2, 0.5]) ** 4 / 1024
    assert inside.all()
    np.testing.assert_allclose(omega, expected, atol=2e-5)


def test_a_curve_that_crosses_the_measured_one_does_not_agree():
    """The mean of the differences is 0, each of them ten deviations."""
    amplitude = np.linspace(0.1, 1.0, 10)
    omega = 2.0 + 0.02 * np.sign(amplitude - 0.55)
    found = over_curve(find("linear").with_parameters({"k": "2"}), amplitude, omega, np.full(10, 0.002))
    assert found.mean == pytest.approx(0.0, abs=1e-12)
    assert found.deviations == pytest.approx(10.0)
    assert found.agreement is Agreement.DIFFERS


def test_a_pendulum_in_degrees_is_told_from_one_in_radians(measured):
    pendulum = find("pendulum").with_parameters({"k": "2"})
    degrees = replace(measured, curve_amplitude=2.0 * measured.curve_amplitude / measured.curve_amplitude.max())
    assert over_measured(pendulum, degrees).sentence().endswith("they differ; an angle in degrees needs --unit deg.")
    assert "--unit" not in over_measured(pendulum, replace(degrees, units="rad")).sentence()
    assert "--unit" not in over_measured(pendulum.with_parameters({"k": "3"}), degrees).sentence()
